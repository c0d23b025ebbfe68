"""What a command says while it works: on a terminal alone, so that scripts and logs see nothing of it."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

import typer

PIECE = 100_000
"""Rows between two signs of progress."""


@contextmanager
def stage(what: str) -> Iterator[None]:
    """Show what is being done, and for how long, until it is done."""
    if not sys.stderr.isatty():
        yield
        return
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        progress.add_task(what, total=None)
        yield


def in_pieces(size: int, what: str) -> Iterator[slice]:
    """Slices that make up `size` rows, with a bar that says how many are done."""
    slices = [slice(start, start + PIECE) for start in range(0, size, PIECE)]
    if not sys.stderr.isatty() or len(slices) < 2:
        yield from slices
        return
    from rich.console import Console
    from rich.progress import track

    yield from track(slices, what, console=Console(stderr=True), transient=True)


def say(what: str) -> None:
    """Tell a person what was done."""
    if sys.stderr.isatty():
        typer.echo(what, err=True)
