"""What ends a command early, as one line on stderr and an exit code."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

import typer

NOTHING_TO_DO: Final = 1
WRONG_INPUT: Final = 2
INTERRUPTED: Final = 128 + 2
"""As a shell reports a program that SIGINT ended."""
BROKEN_PIPE: Final = 1
"""As rich and Python's own documentation have it."""


class NothingToDoError(Exception):
    """The input is right, but there is nothing to write."""


@contextmanager
def told_plainly() -> Iterator[None]:
    """Turn errors that a user can mend into a message and an exit code; others pass with their traceback."""
    try:
        yield
    except BrokenPipeError:
        # Python flushes stdout once more on its way out, and would complain there.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise typer.Exit(BROKEN_PIPE) from None
    except KeyboardInterrupt as reason:
        typer.echo(str(reason) or "interrupted; nothing was written", err=True)
        raise typer.Exit(INTERRUPTED) from None
    except NothingToDoError as reason:
        typer.echo(str(reason), err=True)
        raise typer.Exit(NOTHING_TO_DO) from None
    except MemoryError:
        typer.echo("error: not enough memory for so many points", err=True)
        raise typer.Exit(WRONG_INPUT) from None
    except (OSError, ValueError, ImportError) as error:
        typer.echo(f"error: {_in_one_line(error)}", err=True)
        raise typer.Exit(WRONG_INPUT) from None


def _in_one_line(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror and error.filename is not None:
        return f"{os.fspath(error.filename)}: {error.strerror}"
    return " ".join(str(error).split()) or type(error).__name__
