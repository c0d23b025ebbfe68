"""Ragged arrays: rows of different lengths, the container of lines, rings, chains and loops.

Row i is ``values[offsets[i]:offsets[i + 1]]``. Operations act on all rows at once, by index arithmetic on the offsets;
no other module of this package needs a loop over rows.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, Indices


class Rows:
    """Records as arrays of one length, the fields of a dataclass."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    def take(self, chosen: Indices | BoolArray) -> Self:
        """Some of them."""
        return type(self)(*(getattr(self, name)[chosen] for name in self.__dataclass_fields__))

    @classmethod
    def joined(cls, *parts: Self) -> Self:
        """Those of all parts."""
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in cls.__dataclass_fields__))


@dataclass(frozen=True, eq=False)
class Ragged:
    """Values (n, ...) in rows, offsets (m + 1,)."""

    values: npt.NDArray[Any]
    offsets: Indices

    @classmethod
    def of(cls, rows: Sequence[npt.NDArray[Any]], like: npt.NDArray[Any] | None = None) -> Ragged:
        """From a sequence of rows; `like` gives the shape of a value in case there are no rows."""
        nothing = [] if like is None else [like[:0]]
        return cls(np.concatenate([*nothing, *rows]), offsets_of([len(row) for row in rows]))

    @classmethod
    def grouped(cls, values: npt.NDArray[Any], row: Indices, count: int) -> Ragged:
        """From values and their row indices, in order; rows without values are empty."""
        return cls(values, offsets_of(np.bincount(row, minlength=count)))

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __iter__(self) -> Iterator[npt.NDArray[Any]]:
        return iter(np.split(self.values, self.offsets[1:-1]) if len(self) else [])

    @property
    def sizes(self) -> Indices:
        """Values of each row, (m,)."""
        return np.diff(self.offsets)

    @property
    def row(self) -> Indices:
        """The row of each value, (n,)."""
        return np.repeat(np.arange(len(self)), self.sizes)

    @property
    def following(self) -> Indices:
        """The index of the next value in the row, cyclically."""
        after = np.arange(1, len(self.values) + 1)
        held = self.sizes > 0
        after[self.offsets[1:][held] - 1] = self.offsets[:-1][held]
        return after

    def take(self, rows: Indices | BoolArray) -> Ragged:
        """Some of the rows, in the order given."""
        chosen = np.arange(len(self))[rows]
        sizes = self.sizes[chosen]
        return Ragged(self.values[spans(self.offsets[chosen], sizes)], offsets_of(sizes))

    def kept(self, values: BoolArray) -> Ragged:
        """The rows with only the selected values."""
        return Ragged(self.values[values], np.concatenate([[0], np.cumsum(values)])[self.offsets])

    def inserted(self, places: Indices, values: npt.NDArray[Any]) -> Ragged:
        """The rows with additional values (k, ...) inserted before those at `places` (k,), in order."""
        offsets = self.offsets + np.searchsorted(places, self.offsets)
        return Ragged(np.insert(self.values, places, values, axis=0), offsets)

    def reversed(self, chosen: BoolArray) -> Ragged:
        """The rows, some of them backwards."""
        start = np.where(chosen, self.offsets[1:] - 1, self.offsets[:-1])
        return Ragged(self.values[spans(start, self.sizes, np.where(chosen, -1, 1))], self.offsets)

    def rotated(self, first: Indices) -> Ragged:
        """Each row rotated to start at one of its values, as for closed rings; `first` (m,) are positions in rows."""
        sizes = self.sizes
        turned = spans(np.zeros_like(sizes), sizes) + np.repeat(first, sizes)
        base, size = np.repeat(self.offsets[:-1], sizes), np.repeat(sizes, sizes)
        return Ragged(self.values[base + turned % np.maximum(size, 1)], self.offsets)


def thinned(lines: Ragged, spacing: float) -> Ragged:
    """Lines in the plane without points closer along the line than `spacing`; endpoints are kept.

    A removed point is less than `spacing` from a point that is kept.
    """
    points = lines.values
    if len(points) == 0:
        return lines
    step = np.zeros(len(points))
    step[1:] = np.hypot(*(points[1:] - points[:-1]).T)
    step[lines.offsets[:-1]] = 0.0
    cell = np.floor(np.cumsum(step) / spacing)
    kept = np.ones(len(points), dtype=bool)
    kept[1:] = cell[1:] != cell[:-1]
    kept[lines.offsets[:-1]] = True
    kept[lines.offsets[1:] - 1] = True
    return lines.kept(kept)


def offsets_of(sizes: npt.ArrayLike) -> Indices:
    """Offsets of rows of given sizes."""
    return np.concatenate([[0], np.cumsum(np.asarray(sizes, dtype=np.intp))]).astype(np.intp)


def spans(starts: Indices, sizes: Indices, step: Indices | int = 1) -> Indices:
    """The integers start, start + step, … of several ranges, concatenated."""
    origins = np.repeat(starts - (np.cumsum(sizes) - sizes) * step, sizes)
    return origins + np.arange(len(origins)) * (step if isinstance(step, int) else np.repeat(step, sizes))


def cycles(successor: Indices) -> Ragged:
    """The cycles of a permutation, each starting at its smallest member."""
    # By pointer doubling: after k rounds each has the smallest of the 2ᵏ members ahead of it as its leader; the cycle
    # is cut before the last one, and the distance to the cut is found in the same way.
    leader, jump = np.arange(len(successor)), successor
    for _ in range(len(successor).bit_length()):
        leader, jump = np.minimum(leader, leader[jump]), jump[jump]
    last = successor == leader
    ahead, jump = np.where(last, 0, 1), np.where(last, np.arange(len(successor)), successor)
    for _ in range(len(successor).bit_length()):
        ahead, jump = ahead + ahead[jump], jump[jump]
    order = np.lexsort((-ahead, leader))
    _, sizes = np.unique(leader, return_counts=True)
    return Ragged(order, offsets_of(sizes))
