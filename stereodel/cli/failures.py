"""Failures of commands, reported as one line on stderr and an exit code."""

from __future__ import annotations

import os
import re
import signal
import sys
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Final

import typer

from stereodel._interrupts import INTERRUPTED, interrupt, leave, signals
from stereodel.io.formats.names import DataWarning

NOTHING_TO_DO: Final = 1
MISSING: Final = 1
WRONG_INPUT: Final = 2
BROKEN_PIPE: Final = 1
"""Exit code after a closed pipe, as in rich and Python's documentation."""


OPTIONS: Final = {
    "lon": "--lon",
    "lat": "--lat",
    "layer": "--layer-name",
    "crs": "--crs",
    "levels": "--levels",
    "magnification": "--magnify",
    "size": "--size",
    "style": "--style",
    "width": "--width",
    "skip_missing": "--skip-missing",
    "max_segment": "--max-segment",
    "latitude": "--latitude",
    "angular_radius": "--angular-radius",
}
"""Arguments of the library that messages name, and the corresponding options."""


class NothingToDoError(Exception):
    """The input is valid, but there is nothing to write."""


@contextmanager
def told_plainly() -> Iterator[None]:
    """Turn errors that a user can fix into a message and an exit code; others pass with their traceback.

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
        typer.echo(f"error: {in_options(_in_one_line(error))}", err=True)
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


def in_options(message: str, options: Mapping[str, str] = OPTIONS) -> str:
    """A message with options in place of arguments. Names of columns, which follow a row number, are left unchanged.

    >>> in_options("no column looks like the latitude; say which with lat=, the columns are 'a', 'b'")
    "no column looks like the latitude; say which with --lat, the columns are 'a', 'b'"
    >>> in_options("max_segment is 0.0, but must be above 0")
    '--max-segment is 0.0, but must be above 0'
    >>> in_options("lon and lat are both the column 'x'")
    "--lon and --lat are both the column 'x'"
    >>> in_options("levels[1] is nan; every value must be a finite number")
    '--levels is nan; every value must be a finite number'
    >>> in_options("a.csv: row 2: size is missing; leave such rows out with skip_missing=True")
    'a.csv: row 2: size is missing; leave such rows out with --skip-missing'
    """
    names = "|".join(options)
    advised = rf"(?<=with )(?P<advised>{names})\b(?:=True|=False|=)?"
    wrong = rf"(?:^|(?<=: )|(?<=and ))(?P<wrong>{names})(?:\[[\d, ]*\])?(?= (?:is|are|has|must|and)\b)"

    def option(found: re.Match[str]) -> str:
        of_a_row = re.search(r"row \d+: $", message[: found.start()])
        return found[0] if of_a_row else options[found["advised"] or found["wrong"]]

    return re.sub(f"{advised}|{wrong}", option, message)


@contextmanager
def naming_options(**options: str) -> Iterator[None]:
    """Make errors within the context name other options than those of `OPTIONS`, such as ``lon="--of-lon"``."""
    try:
        yield
    except ValueError as error:
        raise ValueError(in_options(str(error), options)) from error


def _in_one_line(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror and error.filename is not None:
        return f"{os.fspath(error.filename)}: {error.strerror}"
    return " ".join(str(error).split()) or type(error).__name__
