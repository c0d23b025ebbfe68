"""Crew: tasks in processes of this machine, or in an executor that the caller gives.

`concurrent.futures` does the work, by an executor of one process for each place: when a process dies its task is
known and tried again, and it holds no lock of queues that others share. Processes are spawned, because neither OpenGL
contexts nor threads survive a fork. They import the program's main script only if their work is defined there, so that
calls need no guard around them; and they end at once after Ctrl-C, and when the process that started them ends or dies.
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
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, as_completed, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from multiprocessing import parent_process
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, Final, Generic, Literal, NoReturn, Self, TypeVar

from stereodel._tasks.threads import thread_count

T = TypeVar("T")
R = TypeVar("R")

ATTEMPTS: Final = 3
"""How often a task is begun whose process dies, as the system ends processes when memory is short for a moment."""


class TaskError(RuntimeError):
    """A process that died, or an error that cannot be sent from one process to another, in words."""


@dataclass(frozen=True)
class Outcome(Generic[R]):
    """What a task returned, or its error; that of another process has its traceback there as a note."""

    result: R | None = None
    error: Exception | None = None

    def value(self) -> R:
        """The result; raises the error."""
        if self.error is not None:
            raise self.error
        return self.result  # type: ignore[return-value]

    @property
    def message(self) -> str:
        """The error in one line; empty without one."""
        if self.error is None or isinstance(self.error, TaskError):
            return str(self.error or "")
        return f"{type(self.error).__name__}: {self.error}"


class Crew:
    """Who does tasks: processes that begin when they are needed and end with the crew, or an executor.

    jobs: number of processes, by default one for each processor; with one job, or for one task, all is done here.
    lifetime: number of tasks after which a process is replaced.
    executor: does all tasks instead, such as that of a client of Dask; it is the caller's to end.
    Raises RuntimeError in a process that imports the main script, as that would start processes without end.
    """

    def __init__(
        self, jobs: int | None = None, *, lifetime: int | None = None, executor: Executor | None = None
    ) -> None:
        if _importing_main:
            raise RuntimeError(
                "the main script starts processes while one of these imports it; put the call under "
                '`if __name__ == "__main__":`'
            )
        self._jobs = thread_count(-1, 0) if jobs is None else jobs
        self._lifetime, self._executor = lifetime, executor
        self._places: list[_Place] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: object) -> None:
        """End the processes; after an error when they have done what they do, after Ctrl-C at once."""
        if kind is None or issubclass(kind, Exception):
            wait([place.task for place in self._places])
        for place in self._places:
            place.end()

    def each(self, work: Callable[[T], R], tasks: Sequence[T]) -> Iterator[tuple[int, Outcome[R]]]:
        """Number and outcome of each task as it ends.

        work: function of a task; pickled once for each process.
        tasks: iterated twice without keeping any item, so tasks may be made on access.
        Raises TypeError if work or a task is defined in an interactive session.
        """
        count = min(len(tasks), self._jobs)
        if self._executor is not None:
            numbers = {self._executor.submit(_attempt_there, work, task): number for number, task in enumerate(tasks)}
            try:
                for future in as_completed(numbers):
                    yield numbers[future], _outcome(future)
            finally:
                for future in numbers:
                    future.cancel()
        elif count <= 1:
            yield from ((number, _attempt(work, task)) for number, task in enumerate(tasks))
        else:
            orders = _orders(work, tasks)
            self._places += [_Place(self._lifetime) for _ in range(count - len(self._places))]
            yield from self._here(orders, tasks, self._places[:count])

    def _here(self, orders: bytes, tasks: Sequence[Any], places: list[_Place]) -> Iterator[tuple[int, Outcome[Any]]]:
        waiting = iter(range(len(tasks)))
        running: dict[Future[Any], tuple[_Place, int, int]] = {}

        def begin(place: _Place, number: int, attempt: int = 1) -> None:
            running[place.begin(orders, pickle.dumps(tasks[number]))] = place, number, attempt

        for place, number in zip(places, waiting, strict=False):
            begin(place, number)
        while running:
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                place, number, attempt = running.pop(future)
                outcome = place.outcome()
                if outcome is None and attempt < ATTEMPTS:
                    begin(place, number, attempt + 1)
                    continue
                if outcome is None:
                    outcome = Outcome(error=TaskError(place.death))
                if outcome.error is not None:
                    yield number, outcome  # the caller says whether others are begun
                for following in waiting:
                    begin(place, following)
                    break
                if outcome.error is None:
                    yield number, outcome


def _outcome(future: Future[Outcome[Any]]) -> Outcome[Any]:
    """What a task gave, or an error on the way to it or back."""
    try:
        return future.result()
    except Exception as error:
        return Outcome(error=error)


class _Place:
    """A place of one process after another, which do tasks one at a time."""

    task: Future[Outcome[Any]]  # the last one that was begun
    death = ""  # how the last process that died did

    def __init__(self, lifetime: int | None) -> None:
        self._lifetime = lifetime
        self._renew()
        self.task = Future()
        self.task.set_result(Outcome())

    def _renew(self) -> None:
        self._context, self._orders, self._begun = _RecordingContext(), b"", 0
        self._executor = ProcessPoolExecutor(1, self._context, initializer=_begin)

    def begin(self, orders: bytes, task: bytes) -> Future[Outcome[Any]]:
        """Begin a task, in a new process if the last one has reached its lifetime; give it its work if it is other."""
        try:
            if self._begun == self._lifetime:
                self.end()
                self._renew()
            if self._orders != orders:
                self._executor.submit(_take, orders)
                self._orders = orders
            self._begun += 1
            self.task = self._executor.submit(_do, task)
        except (BrokenProcessPool, OSError) as error:  # it died while it waited, or while it was started
            self.task = Future()
            self.task.set_exception(BrokenProcessPool(str(error)))
        return self.task

    def outcome(self) -> Outcome[Any] | None:
        """Outcome of the task, which has ended; None, and a new process, if that died."""
        error = self.task.exception()
        if not isinstance(error, BrokenProcessPool):
            return _outcome(self.task)
        # The executor's thread joins the process. If this thread did so too, the one that came second could find
        # the process gone and its exit code not yet stored.
        self._executor.shutdown()
        started = self._context.started
        ended = f"ended with code {started[-1].exitcode}" if started else f"could not begin: {error}"
        self.death = f"its process {ended}"
        self._renew()
        return None

    def end(self) -> None:
        """End the process at once."""
        for process in self._context.started:
            process.kill()
        self._executor.shutdown(cancel_futures=True)


class _RecordingContext(SpawnContext):
    """A context that keeps the processes that were started."""

    def __init__(self) -> None:
        self.started: list[_Process] = []

    def Process(self, *args: Any, **kwargs: Any) -> _Process:  # type: ignore[override]
        """A new process for an executor."""
        return _Process(self.started, *args, **kwargs)


class _Process(SpawnProcess):
    """A process that does not import the main script of its parent."""

    starting = threading.Lock()

    def __init__(self, started: list[_Process], *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._note = started.append

    def start(self) -> None:
        """Start the process while the origin of the main module is hidden."""
        with self.starting:
            main, note = vars(sys.modules["__main__"]), vars(self).pop("_note")  # which is not sent
            origin: dict[str, Any] = {name: main.pop(name) for name in ("__spec__", "__file__") if name in main}
            main["__spec__"] = None
            try:
                super().start()
            finally:
                main.update(origin)
            note(self)


# In the parent process

MainScript = tuple[Literal["module", "path"], str]
"""The name of the module that `python -m` runs, or the path of a file."""


def _orders(work: Callable[[Any], Any], tasks: Sequence[Any]) -> bytes:
    """The work, and how to import the main script if that is needed, as bytes."""
    pickled, main_script = pickle.dumps(work), None
    # A function or class of the main script is pickled under this name.
    if b"__main__" in pickled or any(b"__main__" in pickle.dumps(task) for task in tasks):
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


# In any process


def _attempt(work: Callable[[T], R], task: T) -> Outcome[R]:
    try:
        return Outcome(work(task))
    except Exception as error:
        return Outcome(error=error)


def _attempt_there(work: Callable[[T], R], task: T) -> Outcome[R]:
    """The outcome for another process."""
    outcome = _attempt(work, task)
    return outcome if outcome.error is None else Outcome(error=_sendable(outcome.error))


def _sendable(error: Exception) -> Exception:
    """An error that survives the way to another process, with its traceback as a note."""
    error.add_note("".join(traceback.format_exception(error)))
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        plain = TaskError(Outcome(error=error).message)
        plain.add_note(error.__notes__[-1])
        return plain
    return error


# In the child process

_importing_main = False
_work: Callable[[Any], Any]
"""The work of this process; an executor's process keeps its state in the module."""


def _begin() -> None:
    """End when the parent ends, even if killed, and leave interruptions to it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    # llvmpipe would start a thread for each core in every process, which is too many.
    os.environ.setdefault("LP_NUM_THREADS", "1")


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _take(orders: bytes) -> None:
    """Take up work; an error becomes the outcome of each task."""
    global _work
    main_script, pickled = pickle.loads(orders)
    try:
        if main_script:
            _import_main(main_script)
        _work = pickle.loads(pickled)
    except Exception as error:
        failure = error

        def _work(task: Any) -> NoReturn:
            raise failure


def _do(task: bytes) -> Outcome[Any]:
    return _attempt_there(lambda pickled: _work(pickle.loads(pickled)), task)


def _import_main(script: MainScript) -> None:
    """Import the main script under the module names that pickles use for it, as multiprocessing does.

    Unlike `multiprocessing.spawn.prepare`, which leaves out a package's ``__main__``.
    """
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
