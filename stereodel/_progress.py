"""Progress of long work: bars on a terminal, by rich, and occasional lines elsewhere for films."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Final

from stereodel._extras import of_extra

PAUSE: Final = 10.0
"""Seconds between two lines."""


@contextmanager
def on_terminal(*columns: str) -> Iterator[Any]:
    """Rich's progress on standard error with columns of these kinds; None where that is not a terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    with of_extra("film"):  # the command has its own door
        from rich import progress
        from rich.console import Console

    text = progress.TextColumn("{task.description}", markup=False)
    found = [text if kind == "Text" else getattr(progress, f"{kind}Column")() for kind in columns]
    with progress.Progress(*found, console=Console(stderr=True), transient=True) as shown:
        yield shown


@contextmanager
def counting(what: str, total: int, *, shown: bool) -> Iterator[Callable[[], None]]:
    """Report steps of `what`, such as "drawing", on standard error, by a function that counts one more of `total`."""
    if not shown or total == 0:
        yield lambda: None
        return
    with on_terminal("Text", "Bar", "MofNComplete", "TimeElapsed", "TimeRemaining") as progress:
        if progress is None:
            yield _Lines(what, total)
        else:
            task = progress.add_task(what, total=total)
            yield lambda: progress.advance(task)


class _Lines:
    """Counts steps and prints occasional lines, and one at the end."""

    def __init__(self, what: str, total: int) -> None:
        self.what, self.total, self.done = what, total, 0
        self.begin = self.said = time.monotonic()

    def __call__(self) -> None:
        self.done += 1
        now = time.monotonic()
        if self.done == self.total or now - self.said >= PAUSE:
            self.said = now
            print(f"{self.what} {self.done}/{self.total} ({now - self.begin:.0f} s)", file=sys.stderr, flush=True)
