"""Captions: the title and description of a script, and their typesetting below its picture."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel.drawing.label import label_box
from stereodel.drawing.page import Fill, Label, Page
from stereodel.drawing.page_styles import StyledDraw
from stereodel.drawing.style import BLACK, LABEL_SIZE, WHITE

TITLE_SIZE: Final = 11.0
"""Type size of the title in points."""

LEADING: Final = 1.3
"""Line spacing in units of type size."""

MARGIN: Final = 12.0
"""Margin around a caption in points."""

DARK: Final = 0.5
"""Luma of the background below which type on it is white."""


def script_of(function: Callable[..., Any], name: str) -> Path | None:
    """The script that draws a picture: the file of its name in the folder of its drawing function.

    None for pictures without a script: from the command line, a session, or a program with another name.
    """
    inner = function
    while isinstance(inner, partial | StyledDraw):
        inner = inner.func if isinstance(inner, partial) else inner.draw
    try:
        script = Path(inspect.getfile(inner)).with_name(f"{name}.py")
    except (TypeError, OSError):
        return None
    return script if script.is_file() else None


def caption_of(script: Path) -> tuple[str, str]:
    """Title and description of a script: the first line of its docstring, and the paragraphs below its underline."""
    return parted(ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or "")


def parted(docstring: str) -> tuple[str, str]:
    r"""Title and description of a docstring, as plain text.

    >>> parted("Figure 1: A ball\n================\n\nRound, as\nballs are.\n\nChosen by us: its size.")
    ('Figure 1: A ball', 'Round, as balls are.\n\nChosen by us: its size.')
    """
    title, _, rest = re.sub("``(.+?)``", "“\\1”", docstring).partition("\n")
    rest = re.sub(r"\A\s*([=\-~^])\1+\s*$", "", rest, count=1, flags=re.MULTILINE)
    paragraphs = [" ".join(part.split()) for part in re.split(r"\n\s*\n", rest)]
    return title.strip(), "\n\n".join(filter(None, paragraphs))


def captioned(page: Page) -> Page:
    """A page with its title and description below the picture; its width is unchanged, its height grows as needed.

    >>> page = Page((0.0, 2.0, 0.0, 1.0), width=200.0, title="A title", description="A line " * 12)
    >>> taller = captioned(page)
    >>> taller.width, [label.text for label in taller.labels]
    (200.0, ['A title', 'A line A line A line A line A line A line A line', 'A line A line A line A line A line'])
    """
    if not page.title and not page.description:
        return page
    red, green, blue, _ = page.background
    ink = WHITE if 0.299 * red + 0.587 * green + 0.114 * blue < DARK else BLACK
    left, right, bottom, top = page.extent
    unit, room = page.points_per_unit, page.width - 2 * MARGIN
    paragraphs = [(text, LABEL_SIZE) for text in page.description.split("\n\n") if text]
    if page.title:
        paragraphs.insert(0, (page.title, TITLE_SIZE))
    labels, depth = [], MARGIN
    for text, size in paragraphs:
        for line in _broken(text, size, room):
            depth += LEADING * size
            anchor = (left + MARGIN / unit, bottom - depth / unit)
            label = Label(line, anchor, align="left", valign="baseline", size=size, color=ink, name="caption")
            labels.append(replace(label, formulas=False))
        depth += (LEADING - 1) * size
    low = bottom - (depth + MARGIN) / unit
    corners = np.array([(left, low), (right, low), (right, bottom), (left, bottom), (left, low)])
    # Items that extend below the page must not show through the caption.
    ground = Fill((np.linspace(corners[:-1], corners[1:], 4, axis=1),), (red, green, blue, 1.0), "caption-ground")
    return replace(page, extent=(left, right, low, top), items=(*page.items, ground, *labels))


def _broken(text: str, size: float, room: float) -> Iterator[str]:
    """Lines no longer than `room`; a longer word gets a line of its own."""
    line = ""
    for word in text.split():
        longer = f"{line} {word}".strip()
        if line and _width(longer, size) > room:
            yield line
            longer = word
        line = longer
    yield line


def _width(text: str, size: float) -> float:
    """Width of a line in points."""
    low, high = label_box(Label(text, (0.0, 0.0), size=size, formulas=False), 1.0)
    return float(high[0] - low[0])
