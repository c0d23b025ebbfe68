"""The command `stereodel`, also as ``python -m stereodel``; without its libraries it says how to get them."""

from __future__ import annotations

import signal

from stereodel._extras import MissingExtraError
from stereodel._interrupts import leave


def main() -> None:
    """Run the command."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # and not ignored, as in the background
        signal.signal(signal.SIGINT, leave)
    try:
        from stereodel.cli import app
    except MissingExtraError as error:
        raise SystemExit(f"error: {error}") from None
    app(prog_name="stereodel")


if __name__ == "__main__":
    main()
