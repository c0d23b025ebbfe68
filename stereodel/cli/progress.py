"""Progress of a command, shown on terminals only, so that scripts and logs contain none of it."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import typer

from stereodel._interrupts import stop_if_interrupted

PIECE = 100_000
"""Number of rows between two updates."""


@contextmanager
def _shown(*columns: str) -> Iterator[Any]:
    """Rich's progress with columns of these kinds; None where stderr is not a terminal."""
    stop_if_interrupted()
    if sys.stderr.isatty():
        from rich import progress
        from rich.console import Console

        text = progress.TextColumn("{task.description}", markup=False)
        found = [text if kind == "Text" else getattr(progress, f"{kind}Column")() for kind in columns]
        with progress.Progress(*found, console=Console(stderr=True), transient=True) as shown:
            yield shown
    else:
        yield None
    stop_if_interrupted()


@contextmanager
def stage(what: str) -> Iterator[None]:
    """Show the current step and its elapsed time until it is done."""
    with _shown("Spinner", "Text", "TimeElapsed") as progress:
        if progress:
            progress.add_task(what, total=None)
        yield


@contextmanager
def bar(what: str) -> Iterator[Callable[[float], None]]:
    """Show a progress bar; yields a function that takes the fraction done, from 0 to 1."""
    with _shown("Text", "Bar", "TaskProgress", "TimeRemaining") as progress:
        task = progress and progress.add_task(what, total=None)  # until the first fraction is known

        def shown(share: float) -> None:
            stop_if_interrupted()
            if progress:
                progress.update(task, total=1.0, completed=share)

        yield shown


@contextmanager
def counts() -> Iterator[Callable[[str, int, int], None]]:
    """Show how many tasks of each pass of the work are done, by the name of the pass."""
    with _shown("Text", "Bar", "MofNComplete", "TimeElapsed") as progress:
        tasks: dict[str, Any] = {}

        def shown(name: str, done: int, of: int) -> None:
            stop_if_interrupted()
            if progress:
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
