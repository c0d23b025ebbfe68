"""The application in which the commands are registered."""

from __future__ import annotations

from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup

import stereodel
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
