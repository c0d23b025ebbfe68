"""The command `stereodel`, also as ``python -m stereodel``; without its libraries a part of it works."""

from __future__ import annotations

import ast
import re
import signal
import sys
from pathlib import Path

import stereodel
from stereodel._extras import MissingExtraError
from stereodel._interrupts import leave


def main() -> None:
    """Run the command."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # and not ignored, as in the background
        signal.signal(signal.SIGINT, leave)
    try:
        from stereodel.cli import app
    except MissingExtraError as error:
        _without_libraries(sys.argv[1:], str(error))
    else:
        app(prog_name="stereodel")


def _without_libraries(arguments: list[str], missing: str) -> None:
    """What works on NumPy alone: the version, the doctor, and a list of all commands."""
    if arguments == ["--version"]:
        print(f"stereodel {stereodel.__version__}")
    elif arguments == ["doctor"]:
        from stereodel._doctor import command

        command()
    elif arguments in ([], ["-h"], ["--help"]):
        rows = "\n".join(f"  {name:12} {said}" for name, said in _commands())
        print(f"Usage: stereodel [--version] COMMAND\n\n{rows}\n\nHere only doctor works: {missing}")
    else:
        raise SystemExit(f"error: {missing}")


def _commands() -> list[tuple[str, str]]:
    """Each command and what it does, by the docstrings of modules that cannot be imported."""
    package = Path(__file__).parent
    heads = [ast.get_docstring(ast.parse(path.read_bytes())) or "" for path in sorted(package.glob("cli/*.py"))]
    from stereodel import _doctor

    found = (re.match(r"`stereodel (\w+)`: (.*)", head) for head in [*heads, _doctor.__doc__ or ""])
    return [(each[1], each[2]) for each in found if each]


if __name__ == "__main__":
    main()
