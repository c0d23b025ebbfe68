"""The command line that all figure and animation scripts share."""

from __future__ import annotations

import argparse
import inspect
import os
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Protocol

from stereodel.render.sizes import LARGEST_SIZE


class Drawing(Protocol):
    """What a script draws."""

    @property
    def name(self) -> str:
        """Stem of the files."""

    def save(self, out: str | os.PathLike[str], *, size: int | None = None, text: bool = True) -> dict[str, Any]:
        """Write the files into a folder and return a record with "files" and "seconds"."""


def run_script(
    drawing: Drawing, argv: Sequence[str] | None, *, source: Callable[..., Any], kind: str, usual_size: str
) -> None:
    """Write the files and say where; what goes wrong becomes a message and exit code 1.

    Parameters
    ----------
    drawing : Drawing
    argv : sequence of str or None
        Arguments; by default those of the process.
    source : callable
        A function that the script defines; `out` beside the script's folder is where files go by default.
    kind, usual_size : str
        What is drawn and how wide it is by default, for the help.
    """
    parser = argparse.ArgumentParser(description=f"Draw {drawing.name} as {kind}.")
    parser.add_argument("--out", type=Path, default=default_folder(source), help="folder to write to (%(default)s)")
    parser.add_argument("--size", type=pixel_count, help=f"width in pixels ({usual_size})")
    parser.add_argument("--text", action=argparse.BooleanOptionalAction, default=True, help="draw the labels")
    options = parser.parse_args(sys.argv[1:] if argv is None else argv)
    try:
        record = drawing.save(options.out, size=options.size, text=options.text)
    except (OSError, RuntimeError, ValueError) as error:
        raise SystemExit(f"{drawing.name}: {error}") from None
    print(f"{drawing.name}: {', '.join(record['files'])} in {options.out} ({record['seconds']:.1f} s)")


def pixel_count(text: str) -> int:
    """A width in pixels from the command line."""
    try:
        size = int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of pixels") from None
    if not 1 <= size <= LARGEST_SIZE:
        raise argparse.ArgumentTypeError(f"{size} pixels is outside 1 to {LARGEST_SIZE}")
    return size


def default_folder(source: Callable[..., Any]) -> Path:
    """`out` beside the folder of the script that defines a function, whatever the current folder."""
    function = source.func if isinstance(source, partial) else source
    return Path(inspect.getfile(function)).resolve().parent.parent / "out"
