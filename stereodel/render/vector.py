"""Vector files: SVG and PDF.

They have the page's size and contain no date, version or random identifier: the same page always gives the same bytes.
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
