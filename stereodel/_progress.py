"""Progress of long work on a terminal, by rich."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from stereodel._extras import of_extra


@contextmanager
def on_terminal(extra: str, *columns: str) -> Iterator[Any]:
    """Rich's progress on standard error with columns of these kinds; None where that is not a terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    with of_extra(extra):
        from rich import progress
        from rich.console import Console

    text = progress.TextColumn("{task.description}", markup=False)
    found = [text if kind == "Text" else getattr(progress, f"{kind}Column")() for kind in columns]
    with progress.Progress(*found, console=Console(stderr=True), transient=True) as shown:
        yield shown
