"""Threads of a call, and what `workers=` means everywhere."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, TypeVar

from stereodel._arrays import as_workers
from stereodel.constants import POINTS_WORTH_THREADS

Task = TypeVar("Task")
Result = TypeVar("Result")


def thread_count(workers: Any, size: int) -> int:
    """Threads for a task of `size` points: as many as `workers` says, -1 for all processors, None by the size."""
    chosen = as_workers(workers)
    if chosen is None and size < POINTS_WORTH_THREADS:
        return 1
    if chosen is None or chosen == -1:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return chosen


def in_order(job: Callable[[Task], Result], tasks: Iterable[Task], threads: int) -> Iterator[Result]:
    """Results of a job for each task, in order, made by so many threads; no more than these are waiting.

    For jobs whose time goes to libraries that release the interpreter's lock, as NumPy and GEOS do. Where the system
    gives no thread, this one does them, some perhaps a second time: jobs have no effects but their results.

    >>> list(in_order(abs, range(-3, 2), threads=2))
    [3, 2, 1, 0, 1]
    """
    if threads == 1:
        yield from map(job, tasks)
        return
    waiting: deque[Future[Result]] = deque()
    with ThreadPoolExecutor(threads) as pool:
        try:
            for task in tasks:
                if len(waiting) == threads:
                    yield waiting.popleft().result()
                try:
                    waiting.append(pool.submit(job, task))
                except RuntimeError:  # no thread could be started
                    waiting.append(Future())
                    waiting[-1].set_result(job(task))
            while waiting:
                yield waiting.popleft().result()
        finally:
            pool.shutdown(wait=True, cancel_futures=True)
