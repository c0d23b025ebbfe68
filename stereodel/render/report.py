"""One HTML sheet for what the picture tests found: expected, actual and difference side by side, in a single file."""

from __future__ import annotations

import base64
import html
import os
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import imageio.v3 as iio

from stereodel.render.image import Pixels, difference_picture

STYLE = """
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
    messages: tuple[str, ...] = field(default=())
    expected: Pixels | None = None
    actual: Pixels | None = None


def write_report(failures: Iterable[Failure], path: str | os.PathLike[str]) -> Path:
    """Write the sheet, pictures embedded; its folder is made, an older sheet replaced.

    Returns
    -------
    Path
        The file.
    """
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    body = "\n".join(_section(failure) for failure in failures)
    head = f'<meta charset="utf-8"><title>Pictures that changed</title>\n<style>{STYLE}</style>'
    page = f'<!doctype html>\n<html lang="en">{head}\n<h1>Pictures that changed</h1>\n{body}\n</html>\n'
    temporary = target.with_name(f".{target.name}.{os.getpid()}.tmp")
    try:
        temporary.write_text(page, encoding="utf-8")
        os.replace(temporary, target)
    finally:
        temporary.unlink(missing_ok=True)
    return target


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
