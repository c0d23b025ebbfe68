"""Executors: who computes the tasks of a pass, where the caller names nobody, and results as they come."""

from __future__ import annotations

import multiprocessing
import os
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor, as_completed
from types import TracebackType
from typing import Any, Final, Self, TypeVar

from stereodel._threads import end_with_parent, thread_count

T = TypeVar("T")
R = TypeVar("R")

PAUSE: Final = 0.5
"""Seconds in which a server of processes that the system ended is gone."""

ATTEMPTS: Final = 3
"""How often in a row, with no task done between, processes are replaced when the system ended one of them."""


class Here(Executor):
    """Computes each task at once, in the process and thread that submits it."""

    def submit(self, function: Callable[..., T], /, *arguments: Any, **named: Any) -> Future[T]:
        """The result, or the error, of a call."""
        future: Future[T] = Future()
        try:
            future.set_result(function(*arguments, **named))
        except Exception as error:
            future.set_exception(error)
        return future


class Crew:
    """An executor of the caller, or processes of this machine, one for each processor, which end with the run.

    executor: what has its `submit`.
    tasks: number of tasks of the largest pass; a single task is computed in this process.
    """

    def __init__(self, executor: Executor | None, tasks: int) -> None:
        self._own = executor is None
        self._count = max(1, min(tasks, thread_count(-1, 0)))
        self._executor = self._started() if executor is None else executor

    def _started(self) -> Executor:
        if self._count == 1:
            return Here()
        # A process that was copied from one with threads may hang forever: none is copied so, on any system.
        kind = "spawn" if os.name == "nt" else "forkserver"
        return ProcessPoolExecutor(
            self._count,
            mp_context=multiprocessing.get_context(kind),
            initializer=end_with_parent,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._own:
            self._executor.shutdown(wait=True, cancel_futures=True)

    def results(self, function: Callable[[T], R], tasks: Iterable[T]) -> Iterator[R]:
        """Results of a function as they are done, in any order.

        Processes of our own that the system ended are replaced, and their tasks done again. After an error of a task
        those that wait are not begun.
        """
        left, attempts = set(tasks), ATTEMPTS
        while left:
            try:
                for task, result in self._once(function, sorted(left)):  # type: ignore[type-var]
                    left.remove(task)
                    attempts = ATTEMPTS
                    yield result
            except (BrokenExecutor, ConnectionError, EOFError) as error:
                attempts -= 1
                of_server = not isinstance(error, BrokenExecutor)  # which starts processes
                if of_server and self._own and not attempts:
                    raise RuntimeError("what starts processes has ended; call again, and the run goes on") from error
                if not self._own or not attempts:
                    raise
                time.sleep(PAUSE if of_server else 0)
                self._executor.shutdown(wait=True, cancel_futures=True)
                self._executor = self._started()

    def _once(self, function: Callable[[T], R], tasks: Iterable[T]) -> Iterator[tuple[T, R]]:
        if isinstance(self._executor, Here):  # no task before its turn
            yield from ((task, function(task)) for task in tasks)
            return
        futures = {self._executor.submit(function, task): task for task in tasks}
        try:
            for future in as_completed(futures):
                yield futures[future], future.result()
        finally:
            for future in futures:
                future.cancel()
