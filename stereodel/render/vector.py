"""Files that hold lines instead of pixels: the door to SVG and PDF.

They have the page's size, and carry no date, no version and no random identifier: the same page always gives the same
bytes.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from stereodel._arrays import Pixels
from stereodel._files import replacing
from stereodel.drawing.page import Page
from stereodel.render.pdf import pdf
from stereodel.render.svg import svg


def save_vector(page: Page, path: str | os.PathLike[str], *, pictures: Sequence[Pixels] = ()) -> Path:
    """Write a page as SVG or PDF, as the ending of `path` says; `Page.save` makes the pictures that it needs.

    Parameters
    ----------
    page : Page
    path : path-like
        An existing file is replaced, when the new one is complete.
    pictures : sequence of (h, w, 3) uint8 arrays
        A picture of the whole page for each of `page.pictured`, of which the part inside the regions is shown.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        For an ending other than .svg and .pdf, and for another number of pictures than are needed.
    OSError
        Where the file cannot be written.
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
