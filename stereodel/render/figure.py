"""Figures: a named picture, from its geometry to its three files."""

from __future__ import annotations

import argparse
import inspect
import os
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Literal

import imageio.v3 as iio
import numpy as np
import numpy.typing as npt

from stereodel.render.page import Page
from stereodel.render.style import PRINT_DPI

Geometry = Mapping[str, Any]
Pixels = npt.NDArray[np.uint8]

WRITTEN: list[Path] = []
"""PNG files that this process wrote, in order; the gallery shows them."""

LARGEST_SIZE = 20_000
"""Pixels across beyond which a picture is surely a mistake."""


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
    title : str, optional

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
    title: str = ""

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
        files += [save_vector(shown, folder / f"{self.name}.{kind}") for kind in ("svg", "pdf")]
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
        options = self._parser().parse_args(sys.argv[1:] if argv is None else argv)
        try:
            record = self.save(options.out, size=options.size, text=options.text)
        except (OSError, RuntimeError, ValueError) as error:
            raise SystemExit(f"{self.name}: {error}") from None
        print(f"{self.name}: {', '.join(record['files'])} in {options.out} ({record['seconds']:.1f} s)")

    def _bare(self, page: Page, size: int | None) -> Pixels:
        """The picture without text, which is what its hash is taken of; labels are laid over it."""
        width = round(page.width / 72 * PRINT_DPI) if size is None else size
        if self.renderer == "agg":
            from stereodel.render.vector import rasterize

            return rasterize(page, size=width, text=False)
        from stereodel.render.raster import render

        return render(page, size=width, text=False)

    def _parser(self) -> argparse.ArgumentParser:
        parser = argparse.ArgumentParser(description=f"Draw {self.title or self.name} as PNG, SVG and PDF.")
        parser.add_argument("--out", type=Path, default=self._default_out(), help="folder to write to (%(default)s)")
        parser.add_argument("--size", type=_pixel_count, help="width of the PNG in pixels (17 cm at 300 dpi)")
        parser.add_argument("--text", action=argparse.BooleanOptionalAction, default=True, help="draw the labels")
        return parser

    def _default_out(self) -> Path:
        """`out` beside the folder of the script that defines `draw`, whatever the current folder."""
        draw = self.draw.func if isinstance(self.draw, partial) else self.draw
        return Path(inspect.getfile(draw)).resolve().parent.parent / "out"


def save_png(picture: Pixels, path: str | os.PathLike[str], *, page_width: float) -> Path:
    """Write pixels (h, w, 3) as a PNG that knows its print width, `page_width` points; never half a file."""
    target = Path(path)
    dpi = picture.shape[1] / (page_width / 72)
    temporary = target.with_name(f".{target.name}.{os.getpid()}.tmp")
    try:
        iio.imwrite(temporary, picture, extension=".png", plugin="pillow", dpi=(dpi, dpi))
        os.replace(temporary, target)
    finally:
        temporary.unlink(missing_ok=True)
    return target


def _pixel_count(text: str) -> int:
    """A width in pixels from the command line."""
    try:
        size = int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of pixels") from None
    if not 1 <= size <= LARGEST_SIZE:
        raise argparse.ArgumentTypeError(f"{size} pixels is outside 1 to {LARGEST_SIZE}")
    return size
