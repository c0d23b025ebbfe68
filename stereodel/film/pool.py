"""Tasks done in several processes at once, on `concurrent.futures`.

The processes are spawned and not forked, because OpenGL contexts do not survive a fork. Each place has an executor of
one process, so that when a process dies it is known with which task, and the others go on. Three things are as a
command wants them, and not as executors have them by themselves:

* Processes do not import the program's main script unless what they do is defined there: a film of the library's own
  objects needs no guard around the call that makes it.
* Ctrl-C is for the process that started them, which then ends them whatever they do; an executor would wait.
* They end when the process that started them does, killed or not; an executor's would wait for tasks for ever.
"""

from __future__ import annotations

import os
import pickle
import runpy
import signal
import sys
import threading
import traceback
import types
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from itertools import chain
from multiprocessing import parent_process
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, Literal

Work = Callable[[Any], Any]

MainScript = tuple[Literal["module", "path"], str]
"""The name of the module that `python -m` runs, or the path of a file."""


@dataclass(frozen=True)
class Done:
    """What became of a task.

    Parameters
    ----------
    result : object
        What the work returned; None after an error.
    error : str
        One line that says what went wrong; empty when nothing did. Text, because not every exception can be sent.
    trace : str
        The traceback of the error, where there is one.
    """

    result: Any = None
    error: str = ""
    trace: str = ""


def attempt(work: Work, task: Any) -> Done:
    """Do a task in this process."""
    try:
        return Done(work(task))
    except Exception as error:
        return _failed(error)


def in_processes(
    work: Work, tasks: Sequence[Any], *, jobs: int, lifetime: int | None = None
) -> Iterator[tuple[int, Done]]:
    """Do tasks in other processes; give the number of each, and what became of it, as they are done.

    When the iterator is closed or the program interrupted, all processes are ended at once.

    Parameters
    ----------
    work : callable
        task → result; pickled once for each process.
    tasks : sequence
        Gone through twice, and none is kept: they may be made when they are asked for.
    jobs : int
        Processes at once.
    lifetime : int, optional
        Tasks that a process does before another takes its place.

    Raises
    ------
    TypeError
        If `work` or a task is defined in an interactive session.
    """
    orders = _orders(work, map(pickle.dumps, tasks))
    waiting = enumerate(map(pickle.dumps, tasks))
    places = [_Place(orders, lifetime) for _ in range(min(jobs, len(tasks)))]
    running: dict[Future[Done], tuple[int, _Place]] = {}
    try:
        for place, (number, task) in zip(places, waiting, strict=False):
            running[place.submit(task)] = number, place
        while running:
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                number, place = running.pop(future)
                done = place.outcome(future)
                for next_number, task in waiting:  # the next one, if there is one, before anybody waits
                    running[place.submit(task)] = next_number, place
                    break
                yield number, done
    finally:
        for place in places:
            place.end()


class _Place:
    """Where one process after another does one task after another."""

    def __init__(self, orders: bytes, lifetime: int | None) -> None:
        self._orders, self._lifetime, self._done = orders, lifetime, 0
        self._start()

    def _start(self) -> None:
        self._context = _Context()
        self._executor = ProcessPoolExecutor(1, self._context, initializer=_prepare, initargs=(self._orders,))

    def submit(self, task: bytes) -> Future[Done]:
        """Have a task done, by a new process where the last one has done its share or is dead."""
        if self._done == self._lifetime:
            self.end()
            self._start()
            self._done = 0
        self._done += 1
        return self._executor.submit(_do, task)

    def outcome(self, future: Future[Done]) -> Done:
        """What became of a task that ended, one way or the other."""
        try:
            return future.result()
        except BrokenProcessPool:
            codes = []
            for process in self._context.started:
                process.join()
                codes.append(process.exitcode)
            self.end()
            self._start()
            return Done(error=f"its process ended with code {codes[-1]}")

    def end(self) -> None:
        """End the process, whatever it does."""
        for process in self._context.started:
            process.kill()
        self._executor.shutdown(cancel_futures=True)


class _Process(SpawnProcess):
    """A process that does not import the main script of the one that starts it."""

    starting = threading.Lock()

    def start(self) -> None:
        """Start it, while the main module does not say where it comes from."""
        with self.starting:
            main = vars(sys.modules["__main__"])
            told: dict[str, Any] = {name: main.pop(name) for name in ("__spec__", "__file__") if name in main}
            main["__spec__"] = None
            try:
                super().start()
            finally:
                main.update(told)


class _Context(SpawnContext):
    """Makes processes and remembers them."""

    def __init__(self) -> None:
        self.started: list[_Process] = []

    def Process(self, *args: Any, **kwargs: Any) -> _Process:  # type: ignore[override]
        """A new one, as executors ask for it."""
        process = _Process(*args, **kwargs)
        self.started.append(process)
        return process


# What happens in the process that asks


def _orders(work: Work, tasks: Iterable[bytes]) -> bytes:
    """What a process must know before its first task."""
    pickled = pickle.dumps(work)
    # A function or class of the main script is pickled under this name.
    main_script = None
    if any(b"__main__" in data for data in chain([pickled], tasks)):
        main_script = main_script_here()
        if main_script is None:
            raise TypeError(
                "draw or the shots are defined in an interactive session, which other processes cannot import; "
                "put them into a module, or draw with jobs=1"
            )
    return pickle.dumps((main_script, pickled))


def main_script_here() -> MainScript | None:
    """How to import the main script elsewhere; None in interactive sessions, and where a program runs it as text."""
    script = sys.modules["__main__"]
    if script.__spec__ is not None and script.__spec__.name != "__main__":
        return "module", script.__spec__.name
    path = getattr(script, "__file__", None)
    return None if path is None else ("path", path)


def refuse_in_import() -> None:
    """A RuntimeError while a process imports the main script: it would start others, which would start others."""
    if _importing_main:
        raise RuntimeError(
            "the main script makes a film while a process that draws frames imports it; "
            'put the call under `if __name__ == "__main__":`'
        )


# What happens in the process that is asked

_importing_main = False
_work: Work | Done = Done(error="nothing was ordered")
"""What this process does, or why it cannot do it: what an executor's process knows, it knows by its module."""


def _prepare(orders: bytes) -> None:
    """Take orders; what goes wrong is the answer to each task."""
    global _work
    # Ctrl-C reaches all processes of a terminal, but the one that started this one decides what it means.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    # A thread of llvmpipe for each core would be as many threads too many as there are other processes.
    os.environ.setdefault("LP_NUM_THREADS", "1")
    try:
        main_script, pickled = pickle.loads(orders)
        if main_script:
            _import_main(main_script)
        _work = pickle.loads(pickled)
    except Exception as error:
        _work = _failed(error)


def _do(task: bytes) -> Done:
    if isinstance(_work, Done):
        return _work
    work = _work
    return attempt(lambda pickled: work(pickle.loads(pickled)), task)


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _import_main(script: MainScript) -> None:
    """Make what the main script defines known under the names that pickles have for it, as multiprocessing does."""
    global _importing_main
    main = types.ModuleType("__mp_main__")
    sys.modules["__main__"] = sys.modules["__mp_main__"] = main
    kind, name = script
    run = runpy.run_module if kind == "module" else runpy.run_path
    _importing_main = True
    try:
        main.__dict__.update(run(name, run_name="__mp_main__"))
    finally:
        _importing_main = False


def _failed(error: Exception) -> Done:
    return Done(None, f"{type(error).__name__}: {error}", "".join(traceback.format_exception(error)))
