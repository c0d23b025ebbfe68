"""The application in which the commands are registered: what they say while they work, and how they end."""

from __future__ import annotations

import os
import signal
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Any, Final

import typer
from typer.core import TyperCommand, TyperGroup

import stereodel
from stereodel._doctor import EXIT_CODES, PURPOSE
from stereodel._tasks.interrupts import INTERRUPTED, interrupt, leave, signals, stop_if_interrupted
from stereodel._tasks.progress import Progress
from stereodel._tasks.progress import reporting as on_terminal
from stereodel.io.formats.names import DataWarning, spelling

NOTHING_TO_DO: Final = 1
MISSING: Final = 1
WRONG_INPUT: Final = 2
BROKEN_PIPE: Final = 1
"""Exit code after a closed pipe, as in rich and Python's documentation."""

READING: Final = ("lon", "lat", "plane", "crs", "encoding", "decimal", "skip_rows", "missing", "wrap")
OTHERWISE: Final = {"layer": "--layer-name", "spacing": "--grid", "columns": "--lon", "resume": "--overwrite"}
ARGUMENTS: Final = {
    name: f"--{name.replace('_', '-')}"
    for name in (*READING, "skip_missing", "skip_invalid", "bounds", "max_segment", "keep")
} | OTHERWISE
"""Arguments that messages of `stereodel.io` and `stereodel.partitioned` name, and the corresponding options."""


class NothingToDoError(Exception):
    """The input is valid, but there is nothing to write."""


class _Untyped:
    """A command or group whose help names what is given, and no types of Python, braces or ranges."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Arguments and options, with that for help; flags take no value, and the name of an argument says its own."""
        found: list[Any] = super().get_params(ctx)  # type: ignore[misc]
        for parameter in found:
            if getattr(parameter, "is_flag", False):
                parameter.metavar = ""
            if parameter.param_type_name == "argument":
                parameter.display_type_rich = lambda ctx: None
        return found

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """What follows the command's name in the first line, which is made before the rest."""
        from typer import rich_utils

        rich_utils.RANGE_STRING = ""
        pieces: list[str] = super().collect_usage_pieces(ctx)  # type: ignore[misc]
        return [piece.replace("{", "").replace("}", "") for piece in pieces]


class Command(_Untyped, TyperCommand):
    """A command."""


class Commands(_Untyped, TyperGroup):
    """Command group that reports failures as one line and an exit code."""

    def invoke(self, ctx: Any) -> Any:
        """Run the chosen command."""
        with told_plainly(), spelling(ARGUMENTS):
            return super().invoke(ctx)


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


@app.callback(help=PURPOSE, epilog=EXIT_CODES)
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Without a command."""


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


@contextmanager
def told_plainly() -> Iterator[None]:
    """Turn errors that a user can fix into one line on stderr and an exit code; others pass with their traceback.

    Warnings about data are notes on stderr. In a process of the command, an interruption is an exception within
    the context; after it, when what was written is written, it is ignored.
    """
    own_process = signal.getsignal(signal.SIGINT) is leave
    try:
        if own_process:
            signal.signal(signal.SIGINT, interrupt)
        with warnings.catch_warnings():
            warnings.simplefilter("always", DataWarning)
            show = warnings.showwarning
            warnings.showwarning = lambda message, category, *where: (
                typer.echo(f"note: {message}", err=True)
                if issubclass(category, DataWarning)
                else show(message, category, *where)
            )
            yield
    except BrokenPipeError:
        # Python flushes stdout once more at exit and would report an error there.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise typer.Exit(BROKEN_PIPE) from None
    except KeyboardInterrupt as reason:
        said = "" if reason.__cause__ else str(reason)  # a codec tells its own name, of another interruption
        raise _interrupted(said) from None
    except NothingToDoError as reason:
        typer.echo(str(reason), err=True)
        raise typer.Exit(NOTHING_TO_DO) from None
    except MemoryError:
        typer.echo("error: not enough memory for so many points", err=True)
        raise typer.Exit(WRONG_INPUT) from None
    except Exception as error:
        # Libraries turn an interruption into exceptions of their own: OSError in imports, TypeError in NumPy's strings.
        if signals:
            raise _interrupted() from None
        if not isinstance(error, (OSError, ValueError, ImportError)):
            raise
        typer.echo(f"error: {_in_one_line(error)}", err=True)
        raise typer.Exit(MISSING if isinstance(error, ImportError) else WRONG_INPUT) from None
    finally:
        if own_process:
            signal.signal(signal.SIGINT, signal.SIG_IGN)


def _interrupted(reason: str = "") -> typer.Exit:
    """Report an interruption and return the exit; further interruptions are ignored."""
    if signals:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    typer.echo(reason or "interrupted; nothing was written", err=True)
    return typer.Exit(INTERRUPTED)


def _in_one_line(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror and error.filename is not None:
        return f"{os.fspath(error.filename)}: {error.strerror}"
    return " ".join(str(error).split()) or type(error).__name__
