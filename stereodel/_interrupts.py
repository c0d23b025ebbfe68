"""Interruptions before a command runs. Nothing heavy is imported here, as the module precedes the libraries."""

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
