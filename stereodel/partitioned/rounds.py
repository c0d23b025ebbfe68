"""Rounds: answers about all points, computed from those nearby that were read.

A round triangulates some of the points and finds which answers are final: those that rest on closed empty bubbles, or
discs, that touch the box of no block that was not read. The others are sought again with the blocks that theirs touch,
deepest first and twice as many each time; at least one more block is read each time, so this ends. Ties are decided by
the points of the tied circle alone, and these lie in the closed bubble, as equal points do: all of them were read when
an answer is final.

The index is all that a worker knows beforehand: boxes of all blocks in a tree, and one point of each.
"""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Generator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, Final, Generic, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import BoolArray, FloatArray, Indices, IntArray, LongArray
from stereodel._spaces import space_of, surface_of
from stereodel.partitioned.store import Store, check, load, save, sums
from stereodel.triangulation import PlanarDelaunay, SphericalDelaunay

SKELETON: Final = 8192
"""At most so many far points are among those of the first round, one of a block: so that no bubble is large."""

LEAST_BUDGET: Final = 8192
"""Points that the first round after those that are read at first may add at least; later ones twice as many."""

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
                rows = slice(int(starts[0]), int(starts[-1]))
                points.append(np.array(place[rows]))  # in memory: what is checked stays so
                numbers.append(np.array(number[rows]))
                found = sums(starts - rows.start, points[-1], numbers[-1])
                check(self.sums[here], found, self._store.path("points", part, "points"))
        block = np.concatenate([np.repeat(blocks, self.sizes[blocks]), alone])
        row = np.concatenate([*numbers, self.numbers[alone]])
        return Sample(np.concatenate([*points, self.points[alone]]), row.astype(np.int64), block)


def _runs(labels: npt.NDArray[Any]) -> list[tuple[int, int]]:
    """Where stretches of equal labels begin and end."""
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(labels)) + 1, [len(labels)]])
    return [(int(a), int(b)) for a, b in pairwise(bounds) if a < b]


T = TypeVar("T")
Mesh = SphericalDelaunay | PlanarDelaunay


def triangulation(points: FloatArray) -> Mesh:
    """Of points of the plane (n, 2), or of directions (n, 3), in the worker's own thread."""
    return surface_of(points).delaunay(points, workers=1)


Verdict = tuple[T, Indices, FloatArray, BoolArray, int]
"""Answers that are final; what has none yet, how deep its bubbles reach into each block that was not read, the blocks
around it, which are read again, and how many points the first deepest blocks may have.
"""


@dataclass
class Rounds(ABC, Generic[T]):
    """The rounds of one task; a subclass says what is computed."""

    index: Index
    limit: int  # points that may be read at once
    sizes: list[int] = field(default_factory=list, kw_only=True)  # points of each round

    @abstractmethod
    def decide(self, sample: Sample, pending: Indices, unread: BoolArray) -> Verdict[T]:
        """What some of the points decide."""

    def answers(self, pending: Indices, read: BoolArray, room: int) -> Generator[T, None, tuple[Indices, int]]:
        """Final answers, round by round; what needs more points at once than there is room for, and how many.

        pending: rows or numbers, as `decide` takes them.
        read: blocks that are read at first.
        """
        index = self.index
        alone = np.arange(len(index)) % max(1, -(-len(index) // SKELETON)) == 0  # of these one point is read
        touched, budget = np.zeros(len(index), dtype=np.bool_), 0
        while len(pending):
            # Read are all points of some blocks, and one point each of those that are known to matter less.
            one = alone & ~read
            count = int(index.sizes[read].sum()) + int(np.count_nonzero(one))
            if count > room:
                return pending, count
            self.sizes.append(count)
            sample = index.read(np.flatnonzero(read), np.flatnonzero(one))
            answers, pending, depth, core, least = self.decide(sample, pending, ~read)
            yield answers
            # Of a block that a bubble touches one point is read from now on. If nothing is read whole, that may do.
            new = (depth > 0) & ~alone
            alone |= new
            if new.any() and not read.any():
                continue
            # The deepest ones are read whole, within a budget that doubles: never again are they left out.
            budget = 2 * budget or max(LEAST_BUDGET, least)
            deepest = np.argsort(-depth, kind="stable")[: np.count_nonzero(depth)]
            before = np.cumsum(index.sizes[deepest]) - index.sizes[deepest]
            touched[deepest[before <= budget]] = True
            read = touched | core
        return pending, 0


def clock() -> FloatArray:
    """Seconds that passed, and those of the processor."""
    return np.array([time.perf_counter(), time.process_time()])


def measured(sizes: Sequence[int], began: FloatArray) -> dict[str, Any]:
    """What the rounds of a task read, and the seconds that it took."""
    seconds, cpu = (clock() - began).tolist()
    rounds = {"rounds": len(sizes), "read": sum(sizes), "largest": max(sizes, default=0)}
    return rounds | {"seconds": seconds, "cpu": cpu}
