"""From a page to a file or an array, one way for every picture.

    page → triangles → rows of pixels → labels over them → encoder

Stages are streamed: after the triangles, each consumes and produces rows from the top, so that a picture is drawn,
labelled and written a few rows at a time and memory does not grow with the square of its width. SVG and PDF are written
from the page itself, except regions in very many colours, which they hold as images. They have the page's size and
contain no date, version or random identifier: the same page always gives the same bytes.

`stereodel.drawing.Page` loads this module when it is saved or drawn, which enters its functions in `OUTPUTS`.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final

import numpy as np

from stereodel._arrays import Pixels
from stereodel._files import replacing
from stereodel.drawing.page import Page
from stereodel.drawing.page.fonts import missing_characters, warn_of_missing
from stereodel.drawing.page.lengths import as_width, pixel_height, print_pixels
from stereodel.drawing.page.page import OUTPUTS
from stereodel.render.gl import OpenGLError
from stereodel.render.pdf import pdf
from stereodel.render.png import png_chunks
from stereodel.render.rows import PixelDigest, Renderer, bare_rows, labelled
from stereodel.render.svg import svg

ENDINGS: Final = (".png", ".svg", ".pdf")

BAND: Final = 256
"""Rows in a block of a picture with transparent background."""

FINEST_DPI: Final = 600
"""Largest resolution of images in vector files in pixels per inch: no press reproduces more."""


def draw_page(page: Page, *, size: int | None, text: bool, renderer: Renderer, platform: str | None) -> Pixels:
    """Implementation of `Page.pixels`."""
    shown, width = page if text else page.without_labels(), as_width(page, size)
    warn_of_missing(missing_characters(shown.labels))
    picture = np.empty((pixel_height(page, width), width, 3), dtype=np.uint8)
    top = 0
    for rows in labelled(bare_rows(shown, width, renderer, platform), shown, width):
        picture[top : top + len(rows)] = rows
        top += len(rows)
    return picture


def save_page(
    page: Page,
    *paths: str | os.PathLike[str],
    size: int | None,
    text: bool,
    renderer: Renderer,
    platform: str | None = None,
    transparent: bool = False,
) -> tuple[int, str]:
    """Implementation of `Page.save`, for several files of one picture; images shared by them are drawn once.

    Returns width of the picture in pixels; hash of its pixels without text, empty where there is no opaque PNG.
    """
    files = [(Path(path), Path(path).suffix.lower()) for path in paths]
    for target, kind in files:
        if kind not in ENDINGS:
            raise ValueError(f"path must end in {', '.join(ENDINGS[:-1])} or {ENDINGS[-1]}, got {target.name!r}")
    shown, width, digest = page if text else page.without_labels(), as_width(page, size), ""
    warn_of_missing(missing_characters(shown.labels))
    try:
        pictures = region_pictures(page, width, platform) if any(kind != ".png" for _, kind in files) else []
        for target, kind in files:
            if kind == ".png" and transparent:
                _write_see_through(shown, target, width, renderer, platform)
            elif kind == ".png":
                digest = _write_png(shown, target, width, renderer, platform)
            else:
                save_vector(_without_ground(shown) if transparent else shown, target, pictures=pictures)
    except OpenGLError as error:
        raise OpenGLError(f"{error}; .svg and .pdf of lines and plain fills need no OpenGL") from error
    return width, digest


def region_pictures(page: Page, width: int, platform: str | None = None) -> list[Pixels]:
    """An image of each item with too many colours for a vector file."""
    size = min(width, print_pixels(page, FINEST_DPI))
    alone = [replace(page, items=(item,)) for item in page.pictured]
    return [draw_page(part, size=size, text=False, renderer="gl", platform=platform) for part in alone]


def _write_png(page: Page, target: Path, width: int, renderer: Renderer, platform: str | None) -> str:
    """Write a page as PNG and return the hash of its pixels without text."""
    digest = PixelDigest((pixel_height(page, width), width, 3))
    write_png(digest.passed(bare_rows(page, width, renderer, platform)), page, target, width)
    return str(digest)


def _without_ground(page: Page) -> Page:
    return replace(page, background=(*page.background[:3], 0.0))


def _write_see_through(page: Page, target: Path, width: int, renderer: Renderer, platform: str | None) -> None:
    """Write a page as PNG with transparent background: colour and opacity follow from pictures on two backgrounds."""
    white, black = (
        draw_page(replace(page, background=(*ground, 1.0)), size=width, text=True, renderer=renderer, platform=platform)
        for ground in ((1.0, 1.0, 1.0), (0.0, 0.0, 0.0))
    )
    texts = {"Title": page.title, "Description": page.description}
    rows = (unmixed(white[top : top + BAND], black[top : top + BAND]) for top in range(0, len(white), BAND))
    with replacing(target) as temporary, temporary.open("wb") as file:
        file.writelines(png_chunks(rows, width, len(white), page_width=page.width, texts=texts, channels=4))


def unmixed(white: Pixels, black: Pixels) -> Pixels:
    """Pixels (..., 4), not premultiplied, from their composites on white and on black, (..., 3).

    >>> half = unmixed(np.array([[255, 127, 127]], dtype=np.uint8), np.array([[128, 0, 0]], dtype=np.uint8))
    >>> half.tolist()
    [[255, 0, 0, 128]]
    """
    through = np.sum(white.astype(np.int32) - black, axis=-1, keepdims=True)
    opacity = np.clip(255 - (through + 1) // 3, 0, 255)
    # Rounding must not make a colour brighter than white.
    color = np.minimum((255 * black.astype(np.int32) + opacity // 2) // np.maximum(opacity, 1), 255)
    found: Pixels = np.concatenate([np.where(opacity > 0, color, 0), opacity], axis=-1).astype(np.uint8)
    return found


def write_png(rows: Iterable[Pixels], page: Page, target: Path, width: int) -> None:
    """Write rows of a picture `width` pixels wide as PNG, with the labels of its page over them."""
    lettered, texts = labelled(rows, page, width), {"Title": page.title, "Description": page.description}
    with replacing(target) as temporary, temporary.open("wb") as file:
        file.writelines(png_chunks(lettered, width, pixel_height(page, width), page_width=page.width, texts=texts))


def save_vector(page: Page, path: str | os.PathLike[str], *, pictures: Sequence[Pixels] = ()) -> Path:
    """Write a page as SVG or PDF, by the extension, with an image of the whole page for each of `page.pictured`.

    ValueError if the extension is not .svg or .pdf, or the number of images is wrong; OSError if the file cannot be
    written.
    """
    target = Path(path)
    match target.suffix.lower():
        case ".svg":
            data = svg(page, pictures).encode()
        case ".pdf":
            data = pdf(page, pictures)
        case _:
            raise ValueError(f"path must end in .svg or .pdf, got {target.name!r}")
    with replacing(target) as temporary:
        temporary.write_bytes(data)
    return target


OUTPUTS.update(save_page=save_page, draw_page=draw_page)
