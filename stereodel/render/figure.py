"""Figures: a named picture, from its geometry to its three files."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from stereodel.drawing.page import Page
from stereodel.render.save import bare_rows, mosaic_pictures, write_png
from stereodel.render.script import run_script
from stereodel.render.sizes import as_width, pixel_height

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
            Width in pixels; by default that of print at 300 dpi, 2008 for 17 cm. Large ones are better saved.
        text : bool
            Whether labels are drawn.
        """
        from stereodel.render.text import with_labels

        page = self.page()
        width = as_width(page, size)
        bare = np.empty((pixel_height(page, width), width, 3), dtype=np.uint8)
        for top, rows in bare_rows(page, width, renderer=self.renderer):
            bare[top : top + len(rows)] = rows
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
        from stereodel.render.vector import save_vector

        begun = time.perf_counter()
        page = self.page()
        width = as_width(page, size)
        folder = Path(out)
        folder.mkdir(parents=True, exist_ok=True)
        shown = page if text else page.without_labels()
        files = [folder / f"{self.name}.{kind}" for kind in ("png", "svg", "pdf")]
        digest = write_png(page, files[0], width=width, text=text, renderer=self.renderer)
        mosaics = mosaic_pictures(page, width)
        for file in files[1:]:
            save_vector(shown, file, mosaics=mosaics)
        WRITTEN.append(files[0])
        return {
            "figure": self.name,
            "files": [file.name for file in files],
            "renderer": self.renderer,
            "size": width,
            "pixel_hash": digest,
            "seconds": round(time.perf_counter() - begun, 3),
        }

    def main(self, argv: Sequence[str] | None = None) -> None:
        """Run as a script: write the files, say where; what goes wrong becomes a message and exit code 1."""
        run_script(self, argv, source=self.draw, kind="PNG, SVG and PDF", usual_size="17 cm at 300 dpi")
