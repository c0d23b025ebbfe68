"""Pages as files: PNG of any size, SVG and PDF.

A PNG is drawn and written some rows at a time, so that memory does not grow with the square of its width.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Final, Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import as_choice
from stereodel._files import replacing
from stereodel.drawing.page import Mosaic, Page
from stereodel.render.digest import PixelDigest
from stereodel.render.png import PngWriter
from stereodel.render.sizes import as_width, pixel_height, print_pixels

Pixels = npt.NDArray[np.uint8]

ENDINGS: Final = (".png", ".svg", ".pdf")

FINEST_DPI: Final = 600
"""Pixels per inch, at most, of what vector files hold as pictures: no press shows more."""


def save_page(
    page: Page,
    path: str | os.PathLike[str],
    *,
    size: int | None = None,
    text: bool = True,
    platform: str | None = None,
) -> Path:
    """Write a page as PNG, SVG or PDF, as the ending of `path` says.

    Lines, dots and type are measured in points: more pixels show the same page finer. A poster with thinner lines is
    a page with more points, ``dataclasses.replace(page, width=...)``.

    Parameters
    ----------
    page : Page
    path : path-like
        Written under a temporary name in the same folder first; an existing file is replaced.
    size : int, optional
        Width in pixels of a PNG, at most 65 535; by default that of print at 300 dpi, 2008 for 17 cm.
    text : bool
        Whether labels are drawn.
    platform : {"osmesa", "egl"}, optional
        See `stereodel.render.gl`.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        For another ending, and for a size that is out of range.
    OSError
        Where the file cannot be written; where there is no OpenGL, which a PNG needs, and cells in vector files.

    Notes
    -----
    A PNG 16 384 pixels wide and high is drawn in less than a gigabyte; at once, its pixels alone would take that much.

    Examples
    --------
    >>> import tempfile
    >>> from stereodel.drawing import Scene, View
    >>> page = Page((-1.1, 1.1, -1.1, 1.1), Scene().layout(View(0, 0)))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_page(page, Path(folder, "ball.png"), size=50).stat().st_size > 1000
    True
    """
    target = Path(path)
    kind = target.suffix.lower()
    if kind not in ENDINGS:
        raise ValueError(f"path must end in {', '.join(ENDINGS[:-1])} or {ENDINGS[-1]}, got {target.name!r}")
    from stereodel.render.gl import OpenGLError
    from stereodel.render.vector import save_vector

    shown, width = page if text else page.without_labels(), as_width(page, size)
    try:
        if kind == ".png":
            write_png(shown, target, width=width, platform=platform)
            return target
        return save_vector(shown, target, mosaics=mosaic_pictures(page, width, platform=platform))
    except OpenGLError as error:
        raise OSError(f"{error}; .svg and .pdf of lines and plain fills need no OpenGL") from error


def write_png(
    page: Page,
    target: Path,
    *,
    width: int,
    text: bool = True,
    renderer: Literal["gl", "agg"] = "gl",
    platform: str | None = None,
) -> str:
    """Write a page as PNG, `width` pixels wide, and return the hash of its pixels without text."""
    from stereodel.render.text import LabelLayer

    height = pixel_height(page, width)
    digest = PixelDigest((height, width, 3))
    layer = LabelLayer(page if text else page.without_labels(), width)
    with replacing(target) as temporary, temporary.open("wb") as file:
        writer = PngWriter(file, width, height, page_width=page.width)
        for top, rows in bare_rows(page, width, renderer=renderer, platform=platform):
            digest.add(rows)
            writer.write(layer.over(rows, top))
        writer.finish()
    return str(digest)


def bare_rows(
    page: Page, width: int, *, renderer: Literal["gl", "agg"] = "gl", platform: str | None = None
) -> Iterator[tuple[int, Pixels]]:
    """A picture of a page without its labels, from the top: the number of a row, and rows (k, width, 3) from it on."""
    if as_choice(renderer, ("gl", "agg"), "renderer") == "agg":
        from stereodel.render import vector

        bands = vector.bands(page.without_labels(), width)
    else:
        from stereodel.render import raster

        bands = raster.bands(page, width, platform=platform)
    top = 0
    for rows in bands:
        yield top, rows
        top += len(rows)


def mosaic_pictures(page: Page, width: int, *, platform: str | None = None) -> list[Pixels]:
    """A picture of each mosaic alone, for the vector files, which cannot hold so many triangles."""
    mosaics = [item for item in page.items if isinstance(item, Mosaic)]
    if not mosaics:
        return []
    from stereodel.render.raster import render

    size = min(width, print_pixels(page, FINEST_DPI))
    return [render(replace(page, items=(mosaic,)), size=size, text=False, platform=platform) for mosaic in mosaics]


def save_png(picture: Pixels, path: str | os.PathLike[str], *, page_width: float) -> Path:
    """Write pixels (h, w, 3) as a PNG that knows its print width, `page_width` points; never half a file."""
    target = Path(path)
    height, width = picture.shape[:2]
    with replacing(target) as temporary, temporary.open("wb") as file:
        writer = PngWriter(file, width, height, page_width=page_width)
        writer.write(picture)
        writer.finish()
    return target
