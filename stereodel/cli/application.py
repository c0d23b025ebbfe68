"""The application in which the commands are registered, and what they say while they work."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup

import stereodel
from stereodel._interrupts import stop_if_interrupted
from stereodel._tasks.progress import Progress
from stereodel._tasks.progress import reporting as on_terminal
from stereodel.cli.failures import told_plainly


class Command(TyperCommand):
    """A command whose flags have no type in its help, as they take no value."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Arguments and options, with that for help."""
        return _without_types(super().get_params(ctx))


class Commands(TyperGroup):
    """Command group that reports failures as one line and an exit code."""

    def get_params(self, ctx: Any) -> list[Any]:
        """As those of `Command`."""
        return _without_types(super().get_params(ctx))

    def invoke(self, ctx: Any) -> Any:
        """Run the chosen command."""
        with told_plainly():
            return super().invoke(ctx)


def _without_types(parameters: list[Any]) -> list[Any]:
    for parameter in parameters:
        if getattr(parameter, "is_flag", False):
            parameter.metavar = ""
    return parameters


app = typer.Typer(
    cls=Commands,
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="markdown",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"stereodel {stereodel.__version__}")
        raise typer.Exit


@app.callback(
    epilog="Exit codes: 0 done, 1 nothing to do or a library is missing, 2 wrong usage or input, 130 interrupted."
)
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Delaunay triangulations and Voronoi diagrams of points on the Earth and in the plane."""


@contextmanager
def reporting(what: str = "") -> Iterator[Progress]:
    """Show on a terminal how far the work is, as one stage of this name or as the stages that the library names.

    Scripts and logs contain none of it. It is where a command stops whose interruption was lost on the way.
    """
    stop_if_interrupted()
    with on_terminal() as shown:

        def told(stage: str, done: int, of: int) -> None:
            stop_if_interrupted()
            shown(what or stage, done, of)

        if what:
            told(what, 0, 0)
        yield told
    stop_if_interrupted()


def say(what: str) -> None:
    """Report what was done, on terminals only."""
    if sys.stderr.isatty():
        typer.echo(what, err=True)
