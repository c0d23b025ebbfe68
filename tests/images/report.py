"""One HTML sheet for what the picture tests found: expected, actual and difference side by side, in a single file.

Tests may run in several processes. Each failure is a file of its own in `parts`, and whoever adds or removes one puts
the sheet together again; so the sheet shows what fails now, whoever ran it.
"""

from __future__ import annotations

import base64
import html
import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import imageio.v3 as iio
import numpy as np

from stereodel._arrays import Pixels
from stereodel._files import replacing
from tools.baselines import Case, Store
from tools.image import PIXEL_LEVELS, levels_apart, read_picture

STYLE: Final = """
body { font: 15px/1.4 sans-serif; margin: 2em; }
figure { display: inline-block; margin: 0 1em 1em 0; vertical-align: top; }
img { border: 1px solid #ccc; max-width: 30vw; }
li { font-family: monospace; }
"""


@dataclass(frozen=True, eq=False)
class Failure:
    """A picture that is not what was stored.

    Parameters
    ----------
    name : str
        Of the figure, or of a frame of an animation.
    messages : tuple of str
        What is wrong, a line each.
    expected, actual : (h, w, 3) uint8 arrays, optional
    """

    name: str
    messages: tuple[str, ...] = ()
    expected: Pixels | None = None
    actual: Pixels | None = None

    @classmethod
    def of(cls, store: Store, case: Case, messages: Iterable[str]) -> Failure:
        """The messages about a case, with the stored picture and that of today."""
        path = store.folder / f"{case.name}.png"
        return cls(case.name, tuple(messages), read_picture(path) if path.is_file() else None, case.picture)


def report_failure(failure: Failure, folder: str | os.PathLike[str]) -> Path:
    """Put a failure into the sheet `index.html` of a folder, in place of an older one of that name.

    Returns
    -------
    Path
        The sheet.
    """
    parts = Path(folder) / "parts"
    parts.mkdir(parents=True, exist_ok=True)
    _write(parts / f"{failure.name}.html", _section(failure))
    return _assemble(Path(folder))


def withdraw_failure(name: str, folder: str | os.PathLike[str]) -> None:
    """Take a failure out of the sheet, if it is there."""
    part = Path(folder) / "parts" / f"{name}.html"
    if part.exists():
        part.unlink(missing_ok=True)
        _assemble(Path(folder))


def difference_picture(expected: Pixels, actual: Pixels) -> Pixels:
    """Where two pictures differ: red beyond `PIXEL_LEVELS`, orange below, over the expected one in pale gray.

    Pictures of different shapes are compared in their common upper left corner.
    """
    height, width = np.minimum(expected.shape[:2], actual.shape[:2])
    expected, actual = expected[:height, :width, :3], actual[:height, :width, :3]
    levels = levels_apart(expected, actual)
    gray = (191 + expected.mean(axis=-1) / 4).astype(np.uint8)
    picture = np.stack([gray, gray, gray], axis=-1)
    picture[levels > 0] = (240, 160, 0)
    picture[levels > PIXEL_LEVELS] = (220, 0, 0)
    return picture


def _assemble(folder: Path) -> Path:
    """Write the sheet from its parts, again until no other process has changed them meanwhile."""
    head = f'<meta charset="utf-8"><title>Pictures that changed</title>\n<style>{STYLE}</style>'
    sheet, seen = folder / "index.html", None
    while seen != (found := _parts(folder)):
        seen = found
        body = "\n".join(found.values()) or "<p>None.</p>"
        _write(sheet, f'<!doctype html>\n<html lang="en">{head}\n<h1>Pictures that changed</h1>\n{body}\n</html>\n')
    return sheet


def _parts(folder: Path) -> dict[str, str]:
    found = {}
    for part in sorted((folder / "parts").glob("*.html")):
        try:
            found[part.name] = part.read_text(encoding="utf-8")
        except FileNotFoundError:  # withdrawn by another process since it was listed
            continue
    return found


def _write(target: Path, text: str) -> None:
    with replacing(target) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _section(failure: Failure) -> str:
    lines = "\n".join(f"<li>{html.escape(message)}</li>" for message in failure.messages)
    pictures = {"expected": failure.expected, "actual": failure.actual}
    if failure.expected is not None and failure.actual is not None:
        pictures["difference"] = difference_picture(failure.expected, failure.actual)
    shown = "\n".join(_picture(what, pixels) for what, pixels in pictures.items() if pixels is not None)
    return f"<h2>{html.escape(failure.name)}</h2>\n<ul>{lines}</ul>\n{shown}"


def _picture(caption: str, pixels: Pixels) -> str:
    data = base64.b64encode(iio.imwrite("<bytes>", pixels, extension=".png", plugin="pillow")).decode()
    return (
        f'<figure><img alt="{caption}" src="data:image/png;base64,{data}"><figcaption>{caption}</figcaption></figure>'
    )
