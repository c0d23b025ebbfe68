"""Parallel tasks in processes, on `concurrent.futures`.

Processes are spawned, not forked, because OpenGL contexts do not survive a fork. Each place has an executor with one
process, so that when a process dies its task is known and the others continue. Three things differ from the default
behaviour of executors:

* Processes import the program's main script only if their work is defined there, so a film of the library's
  own objects needs no guard around the call that makes it.
* Ctrl-C goes to the process that started them, which terminates them at once; an executor would wait.
* They end when the process that started them ends, even if killed; an executor's would wait for tasks forever.
"""

from __future__ import annotations

import os
import pickle
import runpy
import sys
import threading
import traceback
import types
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from itertools import chain
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, Literal

from stereodel._threads import end_with_parent

Work = Callable[[Any], Any]

MainScript = tuple[Literal["module", "path"], str]
"""The name of the module that `python -m` runs, or the path of a file."""


@dataclass(frozen=True)
class Done:
    """Outcome of a task.

    result: the return value; None after an error.
    error: error message in one line; empty on success. It is text because not every exception can be pickled.
    trace: traceback of the error, if any.
    """

    result: Any = None
    error: str = ""
    trace: str = ""


def attempt(work: Work, task: Any) -> Done:
    """Run a task in this process."""
    try:
        return Done(work(task))
    except Exception as error:
        return _failed(error)


def in_processes(
    work: Work, tasks: Sequence[Any], *, jobs: int, lifetime: int | None = None
) -> Iterator[tuple[int, Done]]:
    """Run tasks in other processes; yields the number and outcome of each as it finishes.

    When the iterator is closed or the program interrupted, all processes are terminated at once.

    work: function of a task that returns its result; pickled once for each process.
    tasks: iterated twice without keeping any item, so tasks may be created on access.
    jobs: number of processes.
    lifetime: number of tasks after which a process is replaced.
    Raises TypeError if `work` or a task is defined in an interactive session.
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
                for next_number, task in waiting:  # submit the next task, if any, before waiting
                    running[place.submit(task)] = next_number, place
                    break
                yield number, done
    finally:
        for place in places:
            place.end()


class _Place:
    """A slot in which successive processes run tasks one at a time."""

    def __init__(self, orders: bytes, lifetime: int | None) -> None:
        self._orders, self._lifetime, self._done = orders, lifetime, 0
        self._start()

    def _start(self) -> None:
        self._context = _Context()
        self._executor = ProcessPoolExecutor(1, self._context, initializer=_prepare, initargs=(self._orders,))

    def submit(self, task: bytes) -> Future[Done]:
        """Submit a task, to a new process if the last one has reached its lifetime or died."""
        if self._done == self._lifetime:
            self.end()
            self._start()
            self._done = 0
        self._done += 1
        return self._executor.submit(_do, task)

    def outcome(self, future: Future[Done]) -> Done:
        """Outcome of a finished task."""
        try:
            return future.result()
        except BrokenProcessPool:
            # The executor's thread joins the process. If this thread did so too, the one that came second could find
            # the process gone and its exit code not yet stored.
            self._executor.shutdown()
            code = self._context.started[-1].exitcode
            self._start()
            return Done(error=f"its process ended with code {code}")

    def end(self) -> None:
        """Terminate the process."""
        for process in self._context.started:
            process.kill()
        self._executor.shutdown(cancel_futures=True)


class _Process(SpawnProcess):
    """A process that does not import the main script of its parent."""

    starting = threading.Lock()

    def start(self) -> None:
        """Start the process while the origin of the main module is hidden."""
        with self.starting:
            main = vars(sys.modules["__main__"])
            told: dict[str, Any] = {name: main.pop(name) for name in ("__spec__", "__file__") if name in main}
            main["__spec__"] = None
            try:
                super().start()
            finally:
                main.update(told)


class _Context(SpawnContext):
    """A context that keeps the processes it creates."""

    def __init__(self) -> None:
        self.started: list[_Process] = []

    def Process(self, *args: Any, **kwargs: Any) -> _Process:  # type: ignore[override]
        """A new process for an executor."""
        process = _Process(*args, **kwargs)
        self.started.append(process)
        return process


# In the parent process


def _orders(work: Work, tasks: Iterable[bytes]) -> bytes:
    """Initialisation data for a process, as bytes."""
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
    """How to import the main script elsewhere; None in interactive sessions, or if a program runs it as text."""
    script = sys.modules["__main__"]
    if script.__spec__ is not None and script.__spec__.name != "__main__":
        return "module", script.__spec__.name
    path = getattr(script, "__file__", None)
    return None if path is None else ("path", path)


def refuse_in_import() -> None:
    """Raise RuntimeError while a process imports the main script, as it would start processes recursively."""
    if _importing_main:
        raise RuntimeError(
            "the main script makes a film while a process that draws frames imports it; "
            'put the call under `if __name__ == "__main__":`'
        )


# In the child process

_importing_main = False
_work: Work | Done = Done(error="nothing was ordered")
"""The work of this process, or the error that prevents it; an executor's process keeps its state in the module."""


def _prepare(orders: bytes) -> None:
    """Initialise the process; an error becomes the outcome of each task."""
    global _work
    end_with_parent()
    # llvmpipe would start a thread for each core in every process, which is too many.
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


def _import_main(script: MainScript) -> None:
    """Import the main script under the module names that pickles use for it, as multiprocessing does."""
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
