"""How vector files look in programs of others, and where that is not our picture of the same page."""

import re

import numpy as np
import pypdfium2

from stereodel.render.rows import LabelLayer

DPI = 600
"""Pixels per inch of all pictures: what vector files hold is no finer in print."""

TILE = 16
"""Side of the tiles whose means are compared, pixels: programs smooth edges in ways of their own, which evens out."""

EDGES, TYPE, EVEN, SHADED = 18.0, 20.0, 2.5, 6.0
"""Levels of 255 by which the mean of a tile may differ. Found in all figures, at most: where there are edges, 15; where
there is type, which matplotlib moves to whole pixels, 18; in one colour 2, where several lie one over the other; on
pages with balls, whose light is a gradient in files, 5."""

EVENLY = 6
"""Levels between the pixels of a tile, at most, where there is light and no edge."""


def by_chromium(browser, file, shape):
    """The pixels that a browser shows of an SVG file which is as large as a picture of that shape."""
    height, width = shape[:2]
    text, found = re.subn(
        r'(<svg[^>]*) width="[^"]*" height="[^"]*"',
        rf'\1 width="{width}" height="{height}"',
        file.read_text(encoding="utf-8"),
        count=1,
    )
    assert found == 1
    larger = file.with_suffix(".large.svg")
    larger.write_text(text, encoding="utf-8")
    return browser(larger, width, height)


def by_pdfium(file, shape):
    """The pixels that PDFium shows of the one page of a PDF file; it rounds sides up."""
    height, width = shape[:2]
    with pypdfium2.PdfDocument(file) as document:
        (page,) = document
        picture = page.render(scale=DPI / 72).to_numpy()[..., ::-1]
    return picture[:height, :width] if np.abs(np.subtract(picture.shape, shape)).max() <= 1 else picture


def disagreements(page, ours, theirs, even_limit=EVEN):
    """Where the picture of a page is another one in a file, a line for each kind of place; empty where it is the same.

    Parameters
    ----------
    page : Page
    ours, theirs : (h, w, 3) uint8 array
        As `page.pixels` draws it, and as another program shows the file.
    even_limit : float
        Of tiles in one colour.
    """
    if ours.shape != theirs.shape:
        return [f"{theirs.shape[1]} × {theirs.shape[0]} pixels, expected {ours.shape[1]} × {ours.shape[0]}"]
    with_type = tiled(LabelLayer(page, ours.shape[1]).rows()[..., 3:], np.max)[..., 0] > 0
    apart = np.abs(tiled(ours, np.sum) - tiled(theirs, np.sum)).max(axis=-1) / TILE**2
    spread = np.maximum(*((tiled(p, np.max) - tiled(p, np.min)).max(axis=-1) for p in (ours, theirs)))
    even = ~with_type & (spread <= EVENLY)
    lit = any(getattr(item, "ball", None) for item in page.items)
    kinds = {
        "type": (with_type, TYPE),
        "edges": (~with_type & ~even, EDGES),
        "light": (even & lit, SHADED),
        "one colour": (even & (not lit), even_limit),
    }
    wrong = []
    for kind, (where, limit) in kinds.items():
        found = np.where(where, apart, 0.0)
        if found.max() > limit:
            row, column = np.unravel_index(found.argmax(), found.shape)
            place = f"at column {TILE * column}, row {TILE * row}"
            wrong.append(f"{kind}: up to {found.max():.1f} levels apart {place}, {(found > limit).sum()} tiles")
    return wrong


def tiled(picture, reduce):
    """What becomes of the tiles of a picture (h, w, k), (rows, columns, k); what is left at two edges falls away."""
    rows, columns = (side // TILE for side in picture.shape[:2])
    whole = picture[: rows * TILE, : columns * TILE].astype(np.int32)
    strips = reduce(whole.reshape(rows, TILE, columns * TILE, -1), axis=1)
    return reduce(strips.reshape(rows, columns, TILE, -1), axis=2)
