"""How vector files look in programs of others, and where that is not our picture of the same page."""

import re

import numpy as np
import pypdfium2

from stereodel.render.pixel_rows import LabelLayer

DPI = 600
"""Pixels per inch of all pictures: what vector files hold is no finer in print."""

TILE = 16
"""Side of the tiles whose means are compared, pixels: programs smooth edges in ways of their own, which evens out."""

LARGE = {"type": 20.0, "edges": 12.0, "light": 4.5, "one colour": 1.5}
"""Levels of 255 by which the mean of a tile may differ on a page of few and large items: matplotlib moves type to whole
pixels, and the light of a ball is a gradient in files. Found are 16, 9, 4 and 1; lines a twentieth wider make 18."""

FIGURES = {"type": 40.0, "edges": 32.0, "light": 6.5, "one colour": 2.5}
"""The same of figures. Found are 32, 25, 5 and 2: PDFium has darker hairlines and small type, and colours lie over one
another."""

EVENLY = 6
"""Levels between the pixels of a tile, at most, where there is light and no edge."""


def by_chromium(browser, file, shape):
    """The pixels that a browser shows of an SVG file which is as large as a picture of that shape."""
    height, width = shape[:2]
    said, size = r'(<svg[^>]*) width="[^"]*" height="[^"]*"', rf'\1 width="{width}" height="{height}"'
    text, found = re.subn(said, size, file.read_text(encoding="utf-8"), count=1)
    assert found == 1
    larger = file.with_suffix(".large.svg")
    larger.write_text(text, encoding="utf-8")
    return browser(larger, width, height)


def by_pdfium(file, shape, dpi=DPI):
    """The pixels that PDFium shows of the one page of a PDF file; it rounds sides up."""
    height, width = shape[:2]
    with pypdfium2.PdfDocument(file) as document:
        (page,) = document
        picture = page.render(scale=dpi / 72).to_numpy()[..., ::-1]
    return picture[:height, :width] if np.abs(np.subtract(picture.shape, shape)).max() <= 1 else picture


def disagreements(page, ours, theirs, limits=FIGURES):
    """Where the picture of a page is another one in a file, a line for each kind of place; empty where it is the same.

    ours, theirs: (h, w, 3), as `page.pixels` draws it, and as another program shows the file.
    """
    if ours.shape != theirs.shape:
        return [f"{theirs.shape[1]} × {theirs.shape[0]} pixels, expected {ours.shape[1]} × {ours.shape[0]}"]
    with_type = tiled(LabelLayer(page, ours.shape[1]).rows()[..., 3:], np.max)[..., 0] > 0
    apart = np.abs(tiled(ours, np.sum) - tiled(theirs, np.sum)).max(axis=-1) / TILE**2
    spread = np.maximum(*((tiled(p, np.max) - tiled(p, np.min)).max(axis=-1) for p in (ours, theirs)))
    even = ~with_type & (spread <= EVENLY)
    lit = any(getattr(item, "ball", None) for item in page.items)
    kinds = {"type": with_type, "edges": ~with_type & ~even, "light": even & lit, "one colour": even & (not lit)}
    wrong = []
    for kind, where in kinds.items():
        found, limit = np.where(where, apart, 0.0), limits[kind]
        if found.max() > limit:
            row, column = np.unravel_index(found.argmax(), found.shape)
            place = f"at column {TILE * column}, row {TILE * row}"
            wrong.append(f"{kind}: up to {found.max():.1f} levels apart {place}, {(found > limit).sum()} tiles")
    return wrong


def tiled(picture, reduce):
    """What becomes of the tiles of a picture (h, w, k), (rows, columns, k); what is left at two edges falls away."""
    rows, columns = (side // TILE for side in picture.shape[:2])
    strips = picture[: rows * TILE, : columns * TILE].reshape(rows, TILE, columns, TILE, -1)
    # Strip by strip: a poster has gigabytes of pixels as integers that sums fit into.
    return np.stack([reduce(reduce(strip.astype(np.int32), axis=2), axis=0) for strip in strips])
