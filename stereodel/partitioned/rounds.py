"""Rounds: answers about all points, computed from those nearby that were read.

A round triangulates some of the points and finds which answers are final: those that rest on closed empty bubbles, or
discs, that touch the box of no block that was not read. The others are sought again with the blocks that theirs touch,
deepest first and twice as many each time; at least one more block is read each time, so this ends. Ties are decided by
the points of the tied circle alone, and these lie in the closed bubble, as equal points do: all of them were read when
an answer is final.
"""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Generator, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Generic, NamedTuple, TypeVar

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices
from stereodel.partitioned.index import Index, Sample
from stereodel.triangulation import PlanarDelaunay, SphericalDelaunay

SKELETON: Final = 8192
"""At most so many far points are among those of the first round, one of a block: so that no bubble is large."""

LEAST_BUDGET: Final = 8192
"""Points that the first round after those that are read at first may add at least; later ones twice as many."""

T = TypeVar("T")
Mesh = SphericalDelaunay | PlanarDelaunay


def triangulation(points: FloatArray) -> Mesh:
    """Of points of the plane (n, 2), or of directions (n, 3), in the worker's own thread."""
    return PlanarDelaunay(points, workers=1) if points.shape[1] == 2 else SphericalDelaunay(points, workers=1)


class Verdict(NamedTuple, Generic[T]):
    """What a round decides."""

    answers: T  # that are final
    pending: Indices  # what has no final answer yet
    depth: FloatArray  # how deep its bubbles reach into each block that was not read
    core: BoolArray  # blocks around it, which are read again
    budget: int  # points that the first deepest blocks may have


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
