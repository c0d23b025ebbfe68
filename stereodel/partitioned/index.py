"""The index: boxes of all blocks in a tree, and one point of each, which is all that a worker knows beforehand."""

from __future__ import annotations

from itertools import pairwise
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import BoolArray, FloatArray, Indices, IntArray, LongArray
from stereodel._spaces import space_of
from stereodel.partitioned.shards import check, load, save, sums
from stereodel.partitioned.store import Store

COLUMNS: Final = ("lows", "highs", "levels", "part", "first", "last", "points", "numbers", "sums")


class Index:
    """What a worker knows of all points; its pages are shared by the workers of a machine.

    lows, highs, (nodes, width) arrays: boxes of the blocks, in the order of partitions, then those of the tree above
    them.
    levels, array of int64: the first node of each level.
    part, (blocks,) array of int32: the partition of each block.
    first, last, (blocks,) arrays of int64: its first row there, and the row after its last.
    numbers, (blocks,) array: one point of each block.
    sums, (blocks,) array of uint32: CRC-32 of its points and their numbers.
    sizes, (blocks,) array of int64: number of its points.
    largest: the most of them.
    """

    lows: FloatArray
    highs: FloatArray
    levels: LongArray
    part: IntArray
    first: LongArray
    last: LongArray
    points: FloatArray
    numbers: npt.NDArray[np.integer]
    sums: npt.NDArray[np.uint32]

    def __init__(self, store: Store) -> None:
        self._store = store
        for name in COLUMNS:
            setattr(self, name, load(store.room("blocks") / name))
        self.sizes: LongArray = self.last - self.first
        self.largest = int(self.sizes.max(initial=0))
        self.space = space_of(self.points)

    @staticmethod
    def build(store: Store, parts: list[int]) -> None:
        """Write the index, of the blocks of all partitions."""
        found = [np.asarray(store.load("points", part, "blocks")) for part in parts]
        blocks = np.concatenate(found)
        lows, highs, levels = space_of(blocks["point"]).box_tree(
            np.ascontiguousarray(blocks["low"]), np.ascontiguousarray(blocks["high"])
        )
        part = np.repeat(np.array(parts, dtype=np.int32), [len(part) for part in found])
        columns = (lows, highs, levels, part, *(blocks[name] for name in ("first", "last", "point", "number", "sum")))
        for name, column in zip(COLUMNS, columns, strict=True):
            save(store.room("blocks") / name, column)

    def __len__(self) -> int:
        return len(self.part)

    def counts(self, chosen: BoolArray) -> IntArray:
        """How many of the chosen blocks each node of the tree has."""
        return _kernel.unread_counts(chosen, self.levels)

    def near(self, blocks: Indices, reach: float, unread: BoolArray) -> BoolArray:
        """Which of the blocks that were not read are near others: nearer than `reach` diagonals of the smaller box."""
        chosen = np.zeros(len(self), dtype=np.bool_)
        chosen[blocks] = True
        return self.space.near_blocks(chosen, reach, self.lows, self.highs, self.levels, self.counts(unread))

    def read(self, blocks: Indices, alone: Indices) -> tuple[FloatArray, LongArray, Indices]:
        """All points of some blocks, and one of each of others: as blocks lie, near points next to one another.

        Returns
        -------
        points, numbers, blocks
            The block of each point.
        """
        points: list[Any] = []
        numbers: list[Any] = []
        for begin, end in _runs(self.part[blocks]):
            part = int(self.part[blocks[begin]])
            place, number = (self._store.load("points", part, name, checked=False) for name in ("points", "numbers"))
            own = blocks[begin:end]
            for low, high in _runs(own - np.arange(len(own))):
                here = own[low:high]
                starts = np.append(self.first[here], self.last[here[-1]])
                check(self.sums[here], sums(starts, place, number), self._store.shard("points", part, "points"))
                rows = slice(int(starts[0]), int(starts[-1]))
                points.append(place[rows])
                numbers.append(number[rows])
        block = np.concatenate([np.repeat(blocks, self.sizes[blocks]), alone])
        row = np.concatenate([*numbers, self.numbers[alone]])
        return np.concatenate([*points, self.points[alone]]), row.astype(np.int64), block


def _runs(labels: npt.NDArray[Any]) -> list[tuple[int, int]]:
    """Where stretches of equal labels begin and end."""
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1, [len(labels)]])
    return [(int(a), int(b)) for a, b in pairwise(bounds) if a < b]
