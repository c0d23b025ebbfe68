"""Progress of long work: bars on a terminal, by rich, and elsewhere occasional lines, for those who want them."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from stereodel._extras import of_extra

Progress = Callable[[str, int, int], object]
"""Called with the name of a stage, how much of it is done and how much there is of it, 0 where that is not known."""


@contextmanager
def reporting(*, shown: bool = True, lines: bool = False) -> Iterator[Progress]:
    """A function that shows stages on standard error: bars on a terminal, elsewhere lines or nothing."""
    if not shown or not (lines or sys.stderr.isatty()):
        yield lambda stage, done, of: None
        return
    if not sys.stderr.isatty():
        begin = said = time.monotonic()

        def say(stage: str, done: int, of: int) -> None:
            nonlocal said
            now = time.monotonic()
            if done == of or now - said >= 10:  # now and then, and at the end of each stage
                said = now
                print(f"{stage} {done}/{of} ({now - begin:.0f} s)", file=sys.stderr, flush=True)

        yield say
        return
    with of_extra("film"):  # the command has its own door
        from rich import progress
        from rich.console import Console

    text = progress.TextColumn("{task.description}", markup=False)
    counts = progress.TextColumn("{task.fields[counts]}")
    times = progress.TimeElapsedColumn(), progress.TimeRemainingColumn()
    columns = (text, progress.BarColumn(), progress.TaskProgressColumn(), counts, *times)
    with progress.Progress(*columns, console=Console(stderr=True), transient=True) as bars:
        found: dict[str, Any] = {}

        def show(stage: str, done: int, of: int) -> None:
            state: dict[str, Any] = {"total": of or None, "completed": done, "counts": f"{done}/{of}" if of else ""}
            if stage not in found:
                found[stage] = bars.add_task(stage, counts="")
            bars.update(found[stage], **state)

        yield show
