"""Animations of the gallery: pages one after another as a looping GIF small enough for a page of the web."""

from __future__ import annotations

import io
import os
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._files import replacing
from stereodel.drawing.page import Page
from stereodel.film.gif import write_gif
from stereodel.film.reels import frame_seconds
from stereodel.render.digest import pixel_hash
from stereodel.render.figure import WRITTEN, Pixels
from stereodel.render.script import run_script

SIZE: Final = 480
"""Width of an animation in pixels."""

LARGEST_FILE: Final = 3_000_000
"""Bytes that a file of the gallery may have; `save_pictures` and `Film` know no limit."""

COLORS: Final = (255, 128, 64, 32)
"""Sizes of the palette that all frames share, of which the first is taken that makes the file small enough."""


@dataclass(frozen=True)
class Animation:
    """A moving picture.

    Parameters
    ----------
    name : str
        Stem of the file.
    frames : callable
        () → pages, or functions () → page that draw them when they are wanted; all of one extent and width.
    seconds : float or sequence of float
        How long a frame is shown, or each frame; a GIF keeps hundredths.
    size : int
        Width in pixels.
    platform : {"osmesa", "egl"}, optional
        See `stereodel.render.gl`.

    Examples
    --------
    >>> animation = Animation("nothing", lambda: [Page((0.0, 2.0, 0.0, 1.0))] * 3, seconds=0.1, size=40)
    >>> [picture.shape for picture in animation.pictures()]
    [(20, 40, 3), (20, 40, 3), (20, 40, 3)]
    """

    name: str
    frames: Callable[[], Iterable[Page | Callable[[], Page]]]
    seconds: float | Sequence[float] = 0.08
    size: int = SIZE
    platform: str | None = None

    def pictures(self, *, size: int | None = None, text: bool = True) -> list[Pixels]:
        """All frames as pixels, (h, w, 3) each; a ValueError if there is none or they differ in size."""
        from stereodel.render.raster import render

        width = self.size if size is None else size
        drawn = [render(drawn_page(f), size=width, text=text, platform=self.platform) for f in self.frames()]
        if not drawn:
            raise ValueError(f"frames of {self.name!r} gave no page")
        if len({picture.shape for picture in drawn}) > 1:
            raise ValueError(f"frames of {self.name!r} differ in shape; give all pages one extent")
        return drawn

    def save(self, out: str | os.PathLike[str], *, size: int | None = None, text: bool = True) -> dict[str, Any]:
        """Write NAME.gif into a folder.

        Parameters
        ----------
        out : path-like
            The folder; made when it is missing.
        size : int, optional
            Width in pixels.
        text : bool
            Whether labels are drawn.

        Returns
        -------
        dict
            figure, files, renderer, size, frames, pixel_hash (of all frames as drawn) and seconds.

        Raises
        ------
        OSError
            When the folder cannot be made or written to.
        """
        begun = time.perf_counter()
        folder = Path(out)
        folder.mkdir(parents=True, exist_ok=True)
        pictures = self.pictures(size=size, text=text)
        file = save_gif(pictures, folder / f"{self.name}.gif", self._durations(len(pictures)))
        WRITTEN.append(file)
        return {
            "figure": self.name,
            "files": [file.name],
            "renderer": "gl",
            "size": pictures[0].shape[1],
            "frames": len(pictures),
            "pixel_hash": pixel_hash(np.stack(pictures)),
            "seconds": round(time.perf_counter() - begun, 3),
        }

    def main(self, argv: Sequence[str] | None = None) -> None:
        """Run as a script: write the file, say where; what goes wrong becomes a message and exit code 1."""
        run_script(self, argv, source=self.frames, kind="a looping GIF", usual_size=f"{self.size}")

    def _durations(self, count: int) -> list[float]:
        seconds = [self.seconds] * count if isinstance(self.seconds, (int, float)) else list(self.seconds)
        if len(seconds) != count:
            raise ValueError(f"seconds of {self.name!r} has {len(seconds)} entries for {count} frames")
        return seconds


def drawn_page(frame: Page | Callable[[], Page]) -> Page:
    """The page of a frame, drawn now if it was left for later."""
    return frame if isinstance(frame, Page) else frame()


def save_gif(pictures: Sequence[Pixels], path: str | os.PathLike[str], seconds: Sequence[float]) -> Path:
    """Write pictures of one size as a GIF of at most `LARGEST_FILE` bytes that loops for ever; never half a file.

    Raises
    ------
    ValueError
        If the file would be larger with the smallest palette.
    """
    target = Path(path)
    for colors in COLORS:
        data = io.BytesIO()
        write_gif(pictures, data, frame_seconds(seconds, len(pictures)), colors=colors)
        if data.tell() <= LARGEST_FILE:
            break
    else:
        raise ValueError(f"{target.name} would have {data.tell()} bytes; give fewer frames or a smaller size")
    with replacing(target) as temporary:
        temporary.write_bytes(data.getvalue())
    return target
