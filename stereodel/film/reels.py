"""Reels: the frames of a moving picture in order, read one at a time, and how long each is shown."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Protocol

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_floats, as_frame

Pixels = npt.NDArray[np.uint8]


class Reel(Protocol):
    """Pictures (h, w, 3) by number; a list is one, and so is a folder of files that are read when asked for."""

    def __len__(self) -> int:
        """How many there are."""

    def __getitem__(self, number: int, /) -> Pixels:
        """One of them."""


def frames_of(reel: Reel) -> Iterator[Pixels]:
    """All pictures in order, one in memory at a time; a ValueError where one has another size than the first."""
    shape: tuple[int, ...] = ()
    for number in range(len(reel)):
        picture = as_frame(reel[number], f"reel[{number}]")
        shape = shape or picture.shape
        if picture.shape != shape:
            raise ValueError(
                f"frame {number} has {picture.shape[1]} by {picture.shape[0]} pixels and differs from the first with "
                f"{shape[1]} by {shape[0]}; give all frames one size"
            )
        yield picture


def frame_seconds(seconds: float | Sequence[float], count: int) -> FloatArray:
    """How long each of `count` frames is shown, (count,), from one number for all or one for each.

    Raises
    ------
    ValueError
        For another number of entries, or a time that is not positive.

    Examples
    --------
    >>> frame_seconds(0.5, 3).tolist()
    [0.5, 0.5, 0.5]
    """
    times = as_floats(seconds, "seconds")
    if times.ndim and times.shape != (count,):
        raise ValueError(f"seconds has {times.size} entries for {count} frames; give one number, or one for each")
    if (times <= 0).any():
        raise ValueError(f"seconds must be positive, got {times.min()}")
    return np.broadcast_to(times, (count,))


def whole_ticks(seconds: FloatArray, per_second: int) -> list[int]:
    """Times in whole ticks of a clock, so that the sum of the first n is the best there is for every n.

    Examples
    --------
    >>> whole_ticks(np.full(6, 1 / 30), 100)
    [3, 4, 3, 3, 4, 3]
    """
    ends = np.floor(np.cumsum(seconds) * per_second + 0.5).astype(np.int64)
    return [int(tick) for tick in np.diff(ends, prepend=0)]
