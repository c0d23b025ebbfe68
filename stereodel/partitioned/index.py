"""The index: boxes of all blocks in a tree, and one point of each, which is all that a worker knows beforehand."""

from __future__ import annotations

from itertools import pairwise
from typing import Any, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import BoolArray, FloatArray, Indices, IntArray, LongArray
from stereodel._spaces import space_of
from stereodel.partitioned.store import Store, check, load, save, sums

COLUMNS: Final = ("lows", "highs", "levels", "part", "first", "last", "points", "numbers", "sums")


class Sample(NamedTuple):
    """Some of all points, (n, width), their numbers and their blocks."""

    points: FloatArray
    numbers: LongArray
    blocks: Indices

    def sorted(self) -> Sample:
        """The same in the order of numbers, as points are in memory."""
        order = np.argsort(self.numbers)
        return Sample(self.points[order], self.numbers[order], self.blocks[order])


class Index:
    """What a worker knows of all points; its pages are shared by the workers of a machine."""

    lows: FloatArray  # boxes of the blocks, in the order of partitions, then those of the tree above them
    highs: FloatArray
    levels: LongArray  # the first node of each level
    part: IntArray  # the partition of each block
    first: LongArray  # its first row there
    last: LongArray  # the row after its last
    points: FloatArray  # one point of each block
    numbers: npt.NDArray[np.integer]
    sums: npt.NDArray[np.uint32]  # CRC-32 of its points and their numbers

    def __init__(self, store: Store) -> None:
        self._store = store
        for name in COLUMNS:
            setattr(self, name, load(store.folder("blocks") / name))
        self.sizes: LongArray = self.last - self.first
        self.space = space_of(self.points)

    @staticmethod
    def build(store: Store, parts: list[int]) -> dict[str, Any]:
        """Write the index, of the blocks of all partitions; how many there are."""
        found = [np.asarray(store.load("points", part, "blocks")) for part in parts]
        blocks = np.concatenate(found)
        lows, highs, levels = space_of(blocks["point"]).box_tree(
            np.ascontiguousarray(blocks["low"]), np.ascontiguousarray(blocks["high"])
        )
        part = np.repeat(np.array(parts, dtype=np.int32), [len(part) for part in found])
        columns = (lows, highs, levels, part, *(blocks[name] for name in ("first", "last", "point", "number", "sum")))
        for name, column in zip(COLUMNS, columns, strict=True):
            save(store.folder("blocks") / name, column)
        return {"blocks": len(blocks)}

    def __len__(self) -> int:
        return len(self.part)

    def near(self, blocks: Indices, reach: float, unread: BoolArray) -> BoolArray:
        """Which of the blocks that were not read are near others: nearer than `reach` diagonals of the smaller box."""
        chosen = np.zeros(len(self), dtype=np.bool_)
        chosen[blocks] = True
        return self.space.near_blocks(chosen, reach, *self.tree(unread))

    def tree(self, unread: BoolArray) -> tuple[FloatArray, FloatArray, LongArray, IntArray]:
        """The boxes, as the kernel takes them, and how many of the chosen blocks are below each."""
        return self.lows, self.highs, self.levels, _kernel.unread_counts(unread, self.levels)

    def read(self, blocks: Indices, alone: Indices) -> Sample:
        """All points of some blocks, and one of each of others: as blocks lie, near points next to one another."""
        points: list[Any] = []
        numbers: list[Any] = []
        for begin, end in _runs(self.part[blocks]):
            part = int(self.part[blocks[begin]])
            place, number = (self._store.load("points", part, name, checked=False) for name in ("points", "numbers"))
            own = blocks[begin:end]
            for low, high in _runs(own - np.arange(len(own))):
                here = own[low:high]
                starts = np.append(self.first[here], self.last[here[-1]])
                check(self.sums[here], sums(starts, place, number), self._store.path("points", part, "points"))
                rows = slice(int(starts[0]), int(starts[-1]))
                points.append(place[rows])
                numbers.append(number[rows])
        block = np.concatenate([np.repeat(blocks, self.sizes[blocks]), alone])
        row = np.concatenate([*numbers, self.numbers[alone]])
        return Sample(np.concatenate([*points, self.points[alone]]), row.astype(np.int64), block)


def _runs(labels: npt.NDArray[Any]) -> list[tuple[int, int]]:
    """Where stretches of equal labels begin and end."""
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1, [len(labels)]])
    return [(int(a), int(b)) for a, b in pairwise(bounds) if a < b]
