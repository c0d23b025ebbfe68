"""Interruptions of the command. Nothing heavy is imported here, as the module precedes the libraries."""

from __future__ import annotations

import os
import signal
from typing import Any, Final, NoReturn

INTERRUPTED: Final = 128 + signal.SIGINT
"""Exit code of a program that SIGINT ended, by the convention of shells."""


def leave(number: int, frame: Any) -> NoReturn:
    """Handler of SIGINT until a command runs: end the process at once, as nothing has begun.

    An exception would come out of an import as another one, and Typer ends without a message when it parses arguments.
    """
    os.write(2, b"interrupted; nothing was written\n")
    os._exit(INTERRUPTED)


signals: list[int] = []
"""Interruptions while a command ran, whatever became of their exceptions."""


def interrupt(number: int, frame: Any) -> NoReturn:
    """Handler of SIGINT while a command runs: Python's default, and the interruption is recorded.

    An interrupted import of a library may raise another exception, which is then treated as an interruption.
    """
    signals.append(number)
    raise KeyboardInterrupt


def stop_if_interrupted() -> None:
    """Interrupt again if an interruption was lost: some libraries swallow exceptions while they are imported."""
    if signals:
        raise KeyboardInterrupt
