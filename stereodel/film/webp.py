"""Animated WebP, by Pillow: small, in true colours, not lossless."""

from __future__ import annotations

from typing import Any, BinaryIO, Final

from PIL import Image

from stereodel._arrays import FloatArray
from stereodel.film.reels import Reel, frames_of, whole_ticks

QUALITY: Final = 90
"""Of 100: thin coloured lines keep their colour."""


def write_webp(reel: Reel, file: BinaryIO, seconds: FloatArray) -> None:
    """Write frames as an animated WebP that loops for ever; times are kept in milliseconds."""
    if len(reel) == 1:
        Image.fromarray(reel[0]).save(file, format="webp", quality=QUALITY)
        return
    ticks = whole_ticks(seconds, 1000)
    _OneAtATime(reel).save(file, format="webp", save_all=True, duration=ticks, loop=0, quality=QUALITY, method=4)


class _OneAtATime(Image.Image):
    """A picture of many frames for Pillow, which asks for them in order and keeps none."""

    def __init__(self, reel: Reel) -> None:
        super().__init__()
        self.n_frames = len(reel)
        self._frames = frames_of(reel)
        self._number = -1
        self.seek(0)

    def seek(self, frame: int) -> None:
        """Go to the next frame; those before it are gone, and Pillow's return to the first changes nothing."""
        if frame > self._number:
            shown = Image.fromarray(next(self._frames))
            self.im, self._mode, self._size, self._number = shown.im, shown.mode, shown.size, frame

    def tell(self) -> int:
        """The number of the frame that is shown."""
        return self._number

    def load(self) -> Any:
        """The pixels, which are there already."""
        return self.im.pixel_access(self.readonly)
