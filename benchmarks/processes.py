"""Engines in processes of their own: started with a file of points, asked to triangulate, stopped at the limits.

The conversation is one line each way: the engine says `{"version": …}` when its points are in memory; for "run K" it
triangulates K times and answers with the seconds of each call, measured inside, and the growth of its peak memory.
"""

from __future__ import annotations

import json
import os
import re
import select
import subprocess
import tempfile
import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Self

import psutil

SECONDS = 60.0
"""A call that takes longer ends the engine."""

BYTES = 8 << 30
"""So does a process that holds more."""

STARTUP = 180.0
"""Seconds for starting and reading the points."""

COUNTING = 30.0
"""Seconds beside the calls, for counting what came out and giving memory back."""

LOOK = 0.1
"""Seconds between two looks at memory and disk."""


class StoppedError(Exception):
    """The engine passed a limit or failed; the text says which."""


class Engine:
    """One engine with its points: `command` is a program with arguments, which converses as is said above."""

    def __init__(self, command: Sequence[str]) -> None:
        self._errors = tempfile.TemporaryFile("w+")  # noqa: SIM115 — closed by `close`
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors, bufsize=0
        )
        self._heard = b""
        try:
            self.version: str = self._listen(STARTUP)["version"]
        except StoppedError:
            self.close()
            raise

    def run(self, calls: int = 1, word: str = "run") -> dict[str, Any]:
        """Ask for some calls; a StoppedError when they pass a limit.

        The answer has `seconds` of each, `points` and `triangles`, growth of `peak` memory in bytes, and more.
        """
        with suppress(BrokenPipeError):  # it has ended, and its last words are heard
            self._process.stdin.write(f"{word} {calls}\n".encode())
        answer = self._listen(COUNTING + SECONDS * calls)
        if max(answer["seconds"]) > SECONDS:
            raise StoppedError(f"over {SECONDS:.0f} s")
        if answer["peak"] > BYTES:
            raise StoppedError(f"over {BYTES >> 30} GB")
        return answer

    def _listen(self, limit: float) -> dict[str, Any]:
        """The next answer; the process is looked at while it works. Lines that are none are a library's own words."""
        end = time.monotonic() + limit
        while not (line := self._line(end)).startswith("{"):
            pass
        return json.loads(line)

    def _line(self, end: float) -> str:
        # Not `readline`: a line that Python has read ahead would not wake `select`.
        while b"\n" not in self._heard:
            if select.select([self._process.stdout], [], [], LOOK)[0]:
                heard = os.read(self._process.stdout.fileno(), 1 << 16)
                if not heard:
                    raise StoppedError(self._last_words())
                self._heard += heard
            elif time.monotonic() > end:
                raise StoppedError(f"over {SECONDS:.0f} s")
            # Its points and libraries are not part of the limit.
            elif psutil.Process(self._process.pid).memory_info().rss > 1.25 * BYTES:
                raise StoppedError(f"over {BYTES >> 30} GB")
        line, self._heard = self._heard.split(b"\n", 1)
        return line.decode("utf-8", "replace")

    def _last_words(self) -> str:
        code = self._process.wait()
        self._errors.seek(0)
        text = self._errors.read()
        if "heap out of memory" in text:  # node, which is started with the same limit
            return f"over {BYTES >> 30} GB"
        # Node ends what it says of an error with its own version.
        lines = [line for line in text.strip().splitlines() if line and not line.startswith(("Node.js v", "    at "))]
        # Folders of one machine are of no use in the results.
        return re.sub(r"(?:/[\w.+-]+)+/", "", lines[-1])[:200] if lines else f"ended with code {code}"

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout, self._errors):
            stream.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Watch(threading.Thread):
    """The peaks of the memory of child processes and of the bytes in a folder, and the seconds of processors."""

    def __init__(self, folder: Path) -> None:
        super().__init__(daemon=True)
        self._folder, self._ended = folder, threading.Event()
        self._most: dict[int, tuple[float, ...]] = {}
        self._disk = 0

    def __enter__(self) -> Self:
        self._began, self._cpu_before = time.perf_counter(), time.process_time()
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.wall = time.perf_counter() - self._began
        self._ended.set()
        self.join()
        self.driver = time.process_time() - self._cpu_before

    def run(self) -> None:
        """Look again and again."""
        while not self._ended.wait(LOOK):
            for child in psutil.Process().children(recursive=True):
                with suppress(psutil.Error):  # it has ended
                    memory, clock = child.memory_info(), child.cpu_times()
                    now = memory.rss, memory.rss - memory.shared, clock.user + clock.system
                    self._most[child.pid] = tuple(map(max, now, self._most.get(child.pid, now)))
            self._disk = max(self._disk, size_of(self._folder))

    def found(self) -> dict[str, float]:
        """Seconds of wall and processors, megabytes of the largest process with and without pages of files, disk."""
        whole, own, cpu = zip((0, 0, self.driver), *self._most.values(), strict=True)
        return {
            "wall": self.wall,
            "cpu": sum(cpu),
            "rss_mb": max(whole) / 2**20,
            "own_mb": max(own) / 2**20,
            "scratch_bytes": self._disk,
        }


def size_of(folder: Path) -> int:
    """Bytes of the files of a folder; files and folders may vanish meanwhile."""
    total = 0
    for place, _, names in os.walk(folder):
        for name in names:
            with suppress(FileNotFoundError):
                total += (Path(place) / name).stat().st_size
    return total
