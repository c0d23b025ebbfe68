"""The command `stereodel`, also as ``python -m stereodel``; without its libraries a part of it works."""

from __future__ import annotations

import signal
import sys

import stereodel
from stereodel._extras import MissingExtraError
from stereodel._tasks.interrupts import leave


def main() -> None:
    """Run the command; what works on NumPy alone are the help, the version and the doctor."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # and not ignored, as in the background
        signal.signal(signal.SIGINT, leave)
    try:
        from stereodel.cli import app
    except MissingExtraError as error:
        from stereodel import _doctor

        given = sys.argv[1:]
        if given == ["--version"]:
            print(f"stereodel {stereodel.__version__}")
        elif given == ["doctor"]:
            _doctor.command()
        elif given in ([], ["-h"], ["--help"]):
            print(_doctor.usage())
            raise SystemExit(0 if given else 2) from None
        else:
            raise SystemExit(f"error: {error}") from None
    else:
        app(prog_name="stereodel")


if __name__ == "__main__":
    main()
