"""Figures: a named picture, from its geometry to its three files."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import imageio.v3 as iio
import numpy as np
import numpy.typing as npt

from stereodel._files import replacing
from stereodel.render.page import Mosaic, Page
from stereodel.render.script import run_script
from stereodel.render.style import PRINT_DPI

Geometry = Mapping[str, Any]
Pixels = npt.NDArray[np.uint8]

WRITTEN: list[Path] = []
"""PNG files that this process wrote, in order; the gallery shows them."""


@dataclass(frozen=True)
class Figure:
    """A figure: what it shows, how it is laid out on a page, and how the page becomes files.

    Parameters
    ----------
    name : str
        Stem of the files.
    geometry : callable
        () → named arrays: everything that the picture shows, computed by the library.
    draw : callable
        (geometry) → `Page`.
    renderer : {"gl", "agg"}
        What makes the PNG: OpenGL for globes, matplotlib for the plane.

    Examples
    --------
    >>> figure = Figure("empty", dict, lambda geometry: Page((0.0, 2.0, 0.0, 1.0), width=144.0), renderer="agg")
    >>> figure.pixels(size=40).shape
    (20, 40, 3)
    """

    name: str
    geometry: Callable[[], Geometry]
    draw: Callable[[Any], Page]
    renderer: Literal["gl", "agg"] = "gl"

    def __post_init__(self) -> None:
        if self.renderer not in ("gl", "agg"):
            raise ValueError(f'renderer must be "gl" or "agg", got {self.renderer!r}')

    def page(self) -> Page:
        """The picture before any renderer sees it."""
        return self.draw(self.geometry())

    def pixels(self, *, size: int | None = None, text: bool = True) -> Pixels:
        """The picture, (height, width, 3), rows from the top.

        Parameters
        ----------
        size : int, optional
            Width in pixels; by default that of print at 300 dpi, 2008 for 17 cm.
        text : bool
            Whether labels are drawn.
        """
        from stereodel.render.vector import with_labels

        page = self.page()
        bare = self._bare(page, size)
        return with_labels(bare, page) if text else bare

    def save(self, out: str | os.PathLike[str], *, size: int | None = None, text: bool = True) -> dict[str, Any]:
        """Write NAME.png, NAME.svg and NAME.pdf into a folder.

        Parameters
        ----------
        out : path-like
            The folder; made when it is missing.
        size, text
            As for `pixels`; `text` holds for the vector files too.

        Returns
        -------
        dict
            figure, files, renderer, size, pixel_hash (of the picture without text) and seconds.

        Raises
        ------
        OSError
            When the folder cannot be made or written to.
        """
        from stereodel.render.image import pixel_hash
        from stereodel.render.vector import save_vector, with_labels

        begun = time.perf_counter()
        folder = Path(out)
        folder.mkdir(parents=True, exist_ok=True)
        page = self.page()
        bare = self._bare(page, size)
        picture = with_labels(bare, page) if text else bare
        shown = page if text else page.without_labels()
        files = [save_png(picture, folder / f"{self.name}.png", page_width=page.width)]
        mosaics = mosaic_pictures(page, picture.shape[1])
        files += [save_vector(shown, folder / f"{self.name}.{kind}", mosaics=mosaics) for kind in ("svg", "pdf")]
        WRITTEN.append(files[0])
        return {
            "figure": self.name,
            "files": [file.name for file in files],
            "renderer": self.renderer,
            "size": picture.shape[1],
            "pixel_hash": pixel_hash(bare),
            "seconds": round(time.perf_counter() - begun, 3),
        }

    def main(self, argv: Sequence[str] | None = None) -> None:
        """Run as a script: write the files, say where; what goes wrong becomes a message and exit code 1."""
        run_script(self, argv, source=self.draw, kind="PNG, SVG and PDF", usual_size="17 cm at 300 dpi")

    def _bare(self, page: Page, size: int | None) -> Pixels:
        """The picture without text, which is what its hash is taken of; labels are laid over it."""
        width = round(page.width / 72 * PRINT_DPI) if size is None else size
        if self.renderer == "agg":
            from stereodel.render.vector import rasterize

            return rasterize(page, size=width, text=False)
        from stereodel.render.raster import render

        return render(page, size=width, text=False)


def mosaic_pictures(page: Page, width: int) -> list[Pixels]:
    """A picture of each mosaic alone, for the vector files, which cannot hold so many triangles."""
    mosaics = [item for item in page.items if isinstance(item, Mosaic)]
    if not mosaics:
        return []
    from stereodel.render.raster import render

    return [render(replace(page, items=(mosaic,)), size=width, text=False) for mosaic in mosaics]


def save_png(picture: Pixels, path: str | os.PathLike[str], *, page_width: float) -> Path:
    """Write pixels (h, w, 3) as a PNG that knows its print width, `page_width` points; never half a file."""
    target = Path(path)
    dpi = picture.shape[1] / (page_width / 72)
    with replacing(target) as temporary:
        iio.imwrite(temporary, picture, extension=".png", plugin="pillow", dpi=(dpi, dpi))
    return target
