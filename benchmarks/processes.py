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
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

SECONDS = 60.0
"""A call that takes longer ends the engine."""

BYTES = 8 << 30
"""So does a process that holds more."""

STARTUP = 180.0
"""Seconds for starting and reading the points."""

COUNTING = 30.0
"""Seconds beside the calls, for counting what came out and giving memory back."""

_LOOK = 0.2


class StoppedError(Exception):
    """The engine passed a limit or failed; the text says which."""


@dataclass(frozen=True)
class Answer:
    """What an engine says about some calls: seconds of each, vertices, triangles, growth of peak memory in bytes."""

    seconds: list[float]
    points: int
    triangles: int
    peak: int
    extra: dict[str, Any]


class Engine:
    """One engine with its points.

    Parameters
    ----------
    command : list of str
        Program and arguments; the conversation goes through its standard input and output.
    """

    def __init__(self, command: list[str]) -> None:
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

    def run(self, calls: int = 1, word: str = "run") -> Answer:
        """Ask for some calls; a StoppedError when they pass a limit, after which the engine is gone."""
        try:
            self._process.stdin.write(f"{word} {calls}\n".encode())
            answer = self._listen(COUNTING + SECONDS * calls)
            if max(answer["seconds"]) > SECONDS:
                raise StoppedError(f"over {SECONDS:.0f} s")
            if answer["peak"] > BYTES:
                raise StoppedError(f"over {BYTES >> 30} GB")
        except (StoppedError, BrokenPipeError) as error:
            self.close()
            raise StoppedError(str(error)) from error
        known = {name: answer.pop(name) for name in ("seconds", "points", "triangles", "peak")}
        return Answer(**known, extra=answer)

    def _listen(self, limit: float) -> dict[str, Any]:
        """The next answer; the process is looked at while it works. Lines that are none are a library's own words."""
        end = time.monotonic() + limit
        while not (line := self._line(end)).startswith("{"):
            pass
        return json.loads(line)

    def _line(self, end: float) -> str:
        # Not `readline`: a line that Python has read ahead would not wake `select`.
        while b"\n" not in self._heard:
            if select.select([self._process.stdout], [], [], _LOOK)[0]:
                heard = os.read(self._process.stdout.fileno(), 1 << 16)
                if not heard:
                    raise StoppedError(self._last_words())
                self._heard += heard
            elif time.monotonic() > end:
                raise StoppedError(f"over {SECONDS:.0f} s")
            elif resident(self._process.pid) > 1.25 * BYTES:  # its points and libraries are not part of the limit
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
        if self._errors.closed:
            return
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout, self._errors):
            stream.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def resident(pid: int) -> int:
    """Resident memory of a process, bytes; 0 when it is gone."""
    try:
        status = Path(f"/proc/{pid}/status").read_text(encoding="utf-8")
    except OSError:
        return 0
    return sum(1024 * int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS:"))
