"""Progress of a command, shown on terminals only, so that scripts and logs contain none of it."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import typer

from stereodel.cli.failures import stop_if_interrupted

PIECE = 100_000
"""Number of rows between two updates."""


@contextmanager
def stage(what: str) -> Iterator[None]:
    """Show the current step and its elapsed time until it is done."""
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
    """Show a progress bar; yields a function that takes the fraction done, from 0 to 1."""
    stop_if_interrupted()
    if not sys.stderr.isatty():
        yield lambda share: stop_if_interrupted()
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(what, total=None)  # until the first fraction is known

        def shown(share: float) -> None:
            stop_if_interrupted()
            progress.update(task, total=1.0, completed=share)

        yield shown


@contextmanager
def counts() -> Iterator[Callable[[str, int, int], None]]:
    """Show how many tasks of each pass of the work are done, by the name of the pass."""
    stop_if_interrupted()
    if not sys.stderr.isatty():
        yield lambda name, done, of: stop_if_interrupted()
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        tasks = {}

        def shown(name: str, done: int, of: int) -> None:
            stop_if_interrupted()
            if name not in tasks:
                tasks[name] = progress.add_task(name, total=of)
            progress.update(tasks[name], total=of, completed=done)

        yield shown


def in_pieces(size: int, what: str) -> Iterator[slice]:
    """Slices that make up `size` rows, with a progress bar."""
    with bar(what) as shown:
        for start in range(0, size, PIECE):
            yield slice(start, start + PIECE)
            shown(min(1.0, (start + PIECE) / size))


def say(what: str) -> None:
    """Report what was done, on terminals only."""
    if sys.stderr.isatty():
        typer.echo(what, err=True)
