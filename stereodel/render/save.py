"""From a page to a file or an array, one way for every picture.

    page → triangles → rows of pixels → labels over them → encoder

Stages are streamed, each a few rows at a time from the top, so that memory does not grow with the square of the width.
SVG and PDF are written from the page itself, except regions in very many colours, which they hold as images. They
contain no date, version or random identifier: the same page always gives the same bytes.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final

import numpy as np

from stereodel._arrays import Pixels
from stereodel._tasks.whole_files import replacing, write_whole
from stereodel.drawing.page import Page
from stereodel.drawing.page.fonts import missing_characters, warn_of_missing
from stereodel.render.gl import OpenGLError
from stereodel.render.pixel_rows import PixelDigest, Renderer, bare_rows, labelled, png_chunks
from stereodel.render.vector.pdf import pdf
from stereodel.render.vector.svg import svg

ENDINGS: Final = (".png", ".svg", ".pdf")

BAND: Final = 256
"""Rows in a block of a picture with transparent background."""


def draw_page(page: Page, *, size: int | None, text: bool, renderer: Renderer) -> Pixels:
    """Implementation of `Page.pixels`."""
    shown, width = page if text else page.without_labels(), page.pixels_across(size)
    warn_of_missing(missing_characters(shown.labels))
    picture = np.empty((page.pixels_up(width), width, 3), dtype=np.uint8)
    top = 0
    for rows in labelled(bare_rows(shown, width, renderer), shown, width):
        picture[top : top + len(rows)] = rows
        top += len(rows)
    return picture


def save_page(
    page: Page,
    *paths: str | os.PathLike[str],
    size: int | None,
    text: bool,
    renderer: Renderer,
    transparent: bool = False,
) -> tuple[int, str]:
    """Implementation of `Page.save`, for several files of one picture; images shared by them are drawn once.

    Returns width of the picture in pixels; hash of its pixels without text, empty where there is no opaque PNG.
    """
    files = [(Path(path), Path(path).suffix.lower()) for path in paths]
    for target, kind in files:
        if kind not in ENDINGS:
            raise ValueError(f"path must end in {', '.join(ENDINGS[:-1])} or {ENDINGS[-1]}, got {target.name!r}")
    shown, width, digest = page if text else page.without_labels(), page.pixels_across(size), ""
    clear = replace(shown, background=(*page.background[:3], 0.0)) if transparent else shown
    warn_of_missing(missing_characters(shown.labels))
    try:
        pictures = region_pictures(page, width) if any(kind != ".png" for _, kind in files) else []
        for target, kind in files:
            if kind != ".png":
                save_vector(clear, target, pictures=pictures)
            elif transparent:
                write_png(_see_through(shown, width, renderer), shown, target, width, channels=4)
            else:
                passed = PixelDigest((page.pixels_up(width), width, 3))
                rows = passed.passed(bare_rows(shown, width, renderer))
                write_png(labelled(rows, shown, width), shown, target, width)
                digest = str(passed)
    except OpenGLError as error:
        raise OpenGLError(f"{error}; .svg and .pdf of lines and plain fills need no OpenGL") from error
    return width, digest


def region_pictures(page: Page, width: int) -> list[Pixels]:
    """An image of each item with too many colours for a vector file."""
    size = min(width, page.pixels_in_print(dpi=600))  # no press reproduces more
    alone = [replace(page, items=(item,)) for item in page.pictured]
    return [draw_page(part, size=size, text=False, renderer="gl") for part in alone]


def _see_through(page: Page, width: int, renderer: Renderer) -> Iterable[Pixels]:
    """Rows (k, width, 4) on a transparent background, not premultiplied, which follow from white and black ones."""
    white, black = (
        draw_page(replace(page, background=(*ground, 1.0)), size=width, text=True, renderer=renderer)
        for ground in ((1.0, 1.0, 1.0), (0.0, 0.0, 0.0))
    )
    for top in range(0, len(white), BAND):
        on_white, on_black = (picture[top : top + BAND].astype(np.int32) for picture in (white, black))
        through = np.sum(on_white - on_black, axis=-1, keepdims=True)
        opacity = np.clip(255 - (through + 1) // 3, 0, 255)
        # Rounding must not make a colour brighter than white.
        color = np.minimum((255 * on_black + opacity // 2) // np.maximum(opacity, 1), 255)
        yield np.concatenate([np.where(opacity > 0, color, 0), opacity], axis=-1).astype(np.uint8)


def write_png(rows: Iterable[Pixels], page: Page, target: Path, width: int, channels: int = 3) -> None:
    """Write the rows of a picture of a page, `width` pixels wide, as PNG."""
    texts, height = {"Title": page.title, "Description": page.description}, page.pixels_up(width)
    with replacing(target) as temporary, temporary.open("wb") as file:
        file.writelines(png_chunks(rows, width, height, page_width=page.width, texts=texts, channels=channels))


def save_vector(page: Page, path: str | os.PathLike[str], *, pictures: Sequence[Pixels] = ()) -> Path:
    """Write a page as SVG or PDF, by the extension, with an image of the whole page for each of `page.pictured`."""
    target = Path(path)
    write_whole(target, (pdf if target.suffix.lower() == ".pdf" else svg)(page, pictures))
    return target
