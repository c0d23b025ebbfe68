"""The command `stereodel`, also as ``python -m stereodel``; without its libraries it says how to get them."""

from __future__ import annotations

import os
import signal
from typing import Any, NoReturn

from stereodel._extras import MissingExtraError

INTERRUPTED = 128 + signal.SIGINT
"""As a shell reports a program that SIGINT ended."""


def main() -> None:
    """Run the command."""
    own = signal.getsignal(signal.SIGINT)
    if own is signal.default_int_handler:  # and not ignored, as in the background
        signal.signal(signal.SIGINT, _leave)
    try:
        from stereodel.cli import app
        from stereodel.cli.failures import interrupt
    except MissingExtraError as error:
        raise SystemExit(f"error: {error}") from None
    if own is not signal.default_int_handler:
        app(prog_name="stereodel")
        return
    signal.signal(signal.SIGINT, interrupt)
    try:
        app(prog_name="stereodel")
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # what was written is written


def _leave(number: int, frame: Any) -> NoReturn:
    """End at once: nothing is begun yet, and an exception would come out of an import as another one."""
    os.write(2, b"interrupted; nothing was written\n")
    os._exit(INTERRUPTED)


if __name__ == "__main__":
    main()
