"""Frames drawn in several processes at once.

The processes are started anew and not forked, because OpenGL contexts do not survive a fork. They do not import the
program's main script, as those of multiprocessing do, unless what they draw is defined there: a film of the library's
own objects needs no guard around the call that makes it.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue
from typing import IO, Any, Final, cast

from stereodel.film.worker import DRAWS_FRAMES, Answer, MainScript, attempt, main

FRAMES: Final = 32
"""Frames that a process draws before another takes its place, so that what graphics libraries keep does not add up."""

Task = tuple[int, Any, Path]
"""Number of the frame, what it shows, and the file to write."""


class FrameError(RuntimeError):
    """A frame could not be drawn; the message has its number, and a note the traceback from where it was drawn."""


def draw_all(store: Callable[[Any, Path], None], tasks: Sequence[Task], jobs: int) -> Iterator[int]:
    """Draw frames into files, and give the number of each when it is done.

    Parameters
    ----------
    store : callable
        (shot, path) draws what a frame shows into a file; pickled once for each process.
    tasks : sequence of Task
    jobs : int
        Processes; with 1, or a single task, frames are drawn in this one.

    Raises
    ------
    FrameError
        For the first frame that fails; those that were done are kept.
    """
    if min(jobs, len(tasks)) <= 1:
        for number, shot, path in tasks:
            yield _done(number, attempt(store, shot, path))
        return
    orders = _orders(store, tasks)
    workers = [_Worker(orders) for _ in range(min(jobs, len(tasks)))]
    threads = ThreadPoolExecutor(len(workers))
    try:
        free: SimpleQueue[_Worker] = SimpleQueue()
        for worker in workers:
            free.put(worker)
        futures = {threads.submit(_in_turn, free, task): task[0] for task in tasks}
        for future in as_completed(futures):
            yield _done(futures[future], future.result())
    finally:
        threads.shutdown(wait=False, cancel_futures=True)
        for _ in range(2):  # again, because a thread may just have begun another process
            for worker in workers:
                worker.stop()
            threads.shutdown()


def _in_turn(free: SimpleQueue[_Worker], task: Task) -> Answer:
    """Let the next worker that is free do a task."""
    worker = free.get()
    try:
        return worker.ask(task)
    finally:
        free.put(worker)


def _done(number: int, answer: Answer) -> int:
    message, trace = answer
    if message:
        error = FrameError(f"frame {number}: {message}")
        error.add_note(trace)
        raise error
    return number


class _Worker:
    """A process that draws one frame after another; it ends when this one does, whatever ends it."""

    def __init__(self, orders: bytes) -> None:
        self._orders = orders
        self._start()

    def _start(self) -> None:
        # A thread of llvmpipe for each core would be as many threads too many as there are other workers.
        environment = {"LP_NUM_THREADS": "1", **os.environ, DRAWS_FRAMES: "1"}
        environment["PYTHONPATH"] = os.pathsep.join(filter(None, sys.path))
        command = [sys.executable, "-c", f"from {main.__module__} import main; main()"]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)
        self._requests = cast(IO[bytes], self._process.stdin)
        self._answers = cast(IO[bytes], self._process.stdout)
        self._unsent, self._drawn = self._orders, 0

    def ask(self, task: Task) -> Answer:
        """Have a frame drawn."""
        if self._drawn == FRAMES:
            self.stop()
            self._start()
        try:
            self._requests.write(self._unsent + pickle.dumps(task[1:]))
            self._requests.flush()
            self._unsent, self._drawn = b"", self._drawn + 1
            answer: Answer = pickle.load(self._answers)
        except (EOFError, OSError, pickle.UnpicklingError):
            code = self._process.wait()
            return f"the process that drew it ended with code {code}; what was finished is kept", ""
        return answer

    def stop(self) -> None:
        """End the process, whatever it does; the file that it writes has a temporary name."""
        self._process.kill()
        self._process.wait()
        for stream in (self._requests, self._answers):
            with suppress(OSError):  # what was still to be sent
                stream.close()


def _orders(store: Callable[[Any, Path], None], tasks: Sequence[Task]) -> bytes:
    """What a worker must know before the first task."""
    drawing = pickle.dumps(store)
    # A function or class of the main script is pickled under this name.
    main_script = _main_script() if any(b"__main__" in data for data in (drawing, pickle.dumps(tasks))) else None
    return pickle.dumps((sys.argv, main_script, drawing))


def _main_script() -> MainScript:
    """How to import the main script elsewhere."""
    script = sys.modules["__main__"]
    if script.__spec__ is not None:
        return "module", script.__spec__.name
    path = getattr(script, "__file__", None)
    if path is None:
        raise TypeError(
            "draw or the shots are defined in an interactive session, which other processes cannot import; "
            "put them into a module, or draw with jobs=1"
        )
    return "path", path


def refuse_in_worker() -> None:
    """A RuntimeError in a process that draws frames: it would start others, which would start others."""
    if os.environ.get(DRAWS_FRAMES):
        raise RuntimeError(
            "the main script makes a film while a process that draws frames imports it; "
            'put the call under `if __name__ == "__main__":`'
        )
