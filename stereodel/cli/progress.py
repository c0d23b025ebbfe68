"""What a command says while it works: on a terminal alone, so that scripts and logs see nothing of it."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import typer

from stereodel.cli.failures import stop_if_interrupted

PIECE = 100_000
"""Rows between two signs of progress."""


@contextmanager
def stage(what: str) -> Iterator[None]:
    """Show what is being done, and for how long, until it is done."""
    stop_if_interrupted()
    if not sys.stderr.isatty():
        yield
        stop_if_interrupted()
        return
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        progress.add_task(what, total=None)
        yield
    stop_if_interrupted()


@contextmanager
def bar(what: str) -> Iterator[Callable[[float], None]]:
    """Show how much of the work is done, which is told to what is given, as a share from 0 to 1."""
    stop_if_interrupted()
    if not sys.stderr.isatty():
        yield lambda share: stop_if_interrupted()
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(what, total=None)  # until a share is told

        def shown(share: float) -> None:
            stop_if_interrupted()
            progress.update(task, total=1.0, completed=share)

        yield shown


def in_pieces(size: int, what: str) -> Iterator[slice]:
    """Slices that make up `size` rows, with a bar that says how many are done."""
    with bar(what) as shown:
        for start in range(0, size, PIECE):
            yield slice(start, start + PIECE)
            shown(min(1.0, (start + PIECE) / size))


def say(what: str) -> None:
    """Tell a person what was done."""
    if sys.stderr.isatty():
        typer.echo(what, err=True)
