"""The file formats of moving pictures, by the ending of the file's name."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Final

from stereodel._arrays import FloatArray, as_frame
from stereodel._files import replacing
from stereodel.film.apng import write_apng
from stereodel.film.gif import write_gif
from stereodel.film.mp4 import require_ffmpeg, write_mp4
from stereodel.film.reels import Reel, frame_seconds
from stereodel.film.webp import write_webp

Writer = Callable[[Reel, Path, FloatArray], None]


@dataclass(frozen=True)
class Format:
    """A file format: what writes it and what it cannot hold.

    Parameters
    ----------
    write : callable
        (reel, path, seconds) writes the file.
    largest : int
        Pixels that a side may have.
    shortest : float
        Seconds that a frame is shown at least.
    require : callable
        () raises an ImportError where a library is missing.
    """

    write: Writer
    largest: int
    shortest: float
    require: Callable[[], object] = bool

    def check(self, name: str, sides: Sequence[int], seconds: FloatArray) -> None:
        """A ValueError or ImportError if pictures of these sides, shown so long each, cannot be written to `name`."""
        self.require()
        if max(sides) > self.largest:
            raise ValueError(f"size of {name} is {max(sides)} pixels, but the format has at most {self.largest}")
        # A millionth, because 1/50 as a double may lie below or above.
        if seconds.min() < self.shortest * (1 - 1e-6):
            raise ValueError(
                f"frames of {name} would be shown for {seconds.min():.4f} s each, but the format has at least "
                f"{self.shortest:g} s: at most {1 / self.shortest:g} frames a second"
            )


def _to_file(write: Callable[[Reel, BinaryIO, FloatArray], None]) -> Writer:
    def to_path(reel: Reel, path: Path, seconds: FloatArray) -> None:
        with path.open("wb") as file:
            write(reel, file, seconds)

    return to_path


_APNG: Final = Format(_to_file(write_apng), 2**31 - 1, 1 / 65535)

FORMATS: Final = {
    # Browsers show frames of less than 2/100 s five times as long.
    ".gif": Format(_to_file(write_gif), 65535, 0.02),
    ".png": _APNG,
    ".apng": _APNG,
    ".webp": Format(_to_file(write_webp), 16383, 0.001),
    ".mp4": Format(write_mp4, 16384, 0.001, require_ffmpeg),
}


def format_of(path: str | os.PathLike[str]) -> Format:
    """The format that the ending of a path asks for; a ValueError that lists the endings for another one."""
    ending = Path(path).suffix.lower()
    if ending not in FORMATS:
        raise ValueError(f"path must end in {', '.join(FORMATS)}, got {Path(path).name!r}")
    return FORMATS[ending]


def save_pictures(reel: Reel, path: str | os.PathLike[str], *, seconds: float | Sequence[float] = 0.04) -> Path:
    """Write pictures one after another as a moving picture that loops for ever: GIF, APNG, WebP or MP4.

    Parameters
    ----------
    reel : sequence of (h, w, 3) uint8 arrays
        sRGB, rows from the top, all of one size. Anything with a length and items by number will do: one picture after
        the other is asked for (for a GIF some of them twice), and none is kept.
    path : path-like
        Its ending decides: .gif, .png or .apng, .webp, .mp4. Written under a temporary name first.
    seconds : float or sequence of float
        How long all frames or each of them are shown; in an MP4 all equally long. A GIF keeps hundredths, WebP
        thousandths: the sum of the first n times is the best there is for every n.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError, TypeError
        For another ending, no frames, frames of several sizes, a size or time that the format cannot hold, or pictures
        that are no such arrays.
    ImportError
        For an MP4 without ffmpeg, which comes with ``pip install 'stereodel[video]'``.

    Notes
    -----
    A GIF has 255 colours, chosen from frames spread over the whole film; an APNG is lossless; WebP and MP4 are not.
    An MP4 has an even number of rows and columns: the last one is repeated where a picture's is odd.

    Examples
    --------
    >>> import tempfile
    >>> import numpy as np
    >>> pictures = [np.full((4, 6, 3), level, dtype=np.uint8) for level in (0, 128, 255)]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = save_pictures(pictures, Path(folder, "grays.gif"), seconds=0.5)
    ...     print(file.name, file.read_bytes()[:6])
    grays.gif b'GIF89a'
    """
    target = Path(path)
    kind = format_of(target)
    if len(reel) == 0:
        raise ValueError(f"{target.name} would have no frames; give at least one picture")
    times = frame_seconds(seconds, len(reel))
    kind.check(target.name, as_frame(reel[0], "reel[0]").shape[:2], times)
    with replacing(target) as temporary:
        kind.write(reel, temporary, times)
    return target
