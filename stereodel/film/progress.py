"""Progress of a film: a bar on a terminal, occasional lines elsewhere."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Final

from stereodel._extras import of_extra

PAUSE: Final = 10.0
"""Seconds between two lines."""


@contextmanager
def counting(what: str, total: int, *, shown: bool) -> Iterator[Callable[[], None]]:
    """Report steps of `what`, such as "drawing", on standard error, by a function that counts one more of `total`."""
    if not shown or total == 0:
        yield lambda: None
    elif sys.stderr.isatty():
        with _bar(what, total) as count:
            yield count
    else:
        yield _Lines(what, total)


@contextmanager
def _bar(what: str, total: int) -> Iterator[Callable[[], None]]:
    with of_extra("film"):
        from rich.console import Console
        from rich.progress import (
            BarColumn,
            MofNCompleteColumn,
            Progress,
            TextColumn,
            TimeElapsedColumn,
            TimeRemainingColumn,
        )

    columns = (TextColumn(what), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
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
