"""Rounds: the stars of some points in the triangulation of all points, from those nearby that were read.

A round triangulates points and asks which stars are final: those of whose triangles no closed empty bubble touches the
box of a block that was not read. The other stars are done again with the blocks that their bubbles touch, deepest
first and twice as many each time, in a triangulation of their own; at least one more block is read each time, so this
ends. Ties are decided by the points of the tied circle alone, and these lie in the closed bubble, as equal points do:
all of them were read when a star is final.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices, LongArray
from stereodel.partitioned.index import Index
from stereodel.triangulation import PlanarDelaunay, SphericalDelaunay

REACH: Final = 0.15
"""What is read beside own blocks at first: what is nearer than so much of the smaller block's diagonal."""

SKELETON: Final = 8192
"""At most so many far points are among those of the first round, one of a block: so that no bubble is large."""

BUDGET: Final = 0.2
"""How many more points the second round may read, in terms of the own ones; each later one twice as many."""

LEAST_BUDGET: Final = 4096
"""How many it may read at least."""


@dataclass
class Reading:
    """What the rounds of a partition read: rounds, points in all of them, and in the largest."""

    rounds: int = 0
    read: int = 0
    largest: int = 0

    def add(self, count: int) -> None:
        """Note a round with so many points."""
        self.rounds += 1
        self.read += count
        self.largest = max(self.largest, count)


def triangulation(points: FloatArray) -> SphericalDelaunay | PlanarDelaunay:
    """Of points of the plane (n, 2), or of directions (n, 3), in the worker's own thread."""
    return PlanarDelaunay(points, workers=1) if points.shape[1] == 2 else SphericalDelaunay(points, workers=1)


@dataclass(frozen=True, eq=False)
class Round:
    """Stars that are final.

    mesh: triangulation of the points read.
    numbers, (n,) array of int64: numbers of its points.
    final, (n,) array of bool: own points whose stars are final in this round, and in none before; of duplicates all
    together.
    """

    mesh: SphericalDelaunay | PlanarDelaunay
    numbers: LongArray
    final: BoolArray


@dataclass
class Rounds:
    """The rounds of some points.

    limit: points that may be read at once.
    name: what the points are, for messages.
    """

    index: Index
    limit: int
    name: str
    reading: Reading = field(default_factory=Reading)

    def of_part(self, part: int) -> Iterator[Round]:
        """Rounds until the stars of all points of a partition are final.

        Raises MemoryError where that takes more than `limit` points at once.
        """
        index = self.index
        own = np.flatnonzero(index.part == part)
        size = int(index.sizes[own].sum())
        step = max(1, -(-len(index) // SKELETON))
        alone = np.arange(len(index)) % step == 0  # of these one point is known
        read = self._around(own, np.zeros(len(index), dtype=np.bool_))
        touched, pending, budget = np.zeros_like(read), None, LEAST_BUDGET
        while pending is None or len(pending):
            mesh, numbers, block = self._mesh(read, alone & ~read, pending)
            kept = np.arange(len(numbers))
            kept[mesh.duplicates[:, 0]] = mesh.duplicates[:, 1]
            here = np.flatnonzero(index.part[block] == part if pending is None else np.isin(numbers, pending))
            wanted = np.zeros(len(numbers), dtype=np.bool_)
            wanted[kept[here]] = True
            is_open, depth = self._open(mesh, wanted, ~read)
            final = np.zeros(len(numbers), dtype=np.bool_)
            final[here] = ~is_open[kept[here]]
            yield Round(mesh, numbers, final)
            left = here[~final[here]]
            pending = numbers[left]
            if len(pending):
                around = block[mesh.simplices[is_open[mesh.simplices].any(axis=1)].ravel()]
                core = np.unique(np.concatenate([around, block[left]]))
                alone |= depth > 0
                budget = 2 * max(budget, int(BUDGET / 2 * size))
                deepest = np.argsort(-depth, kind="stable")[: np.count_nonzero(depth)]
                before = np.cumsum(index.sizes[deepest]) - index.sizes[deepest]
                touched[deepest[before <= budget]] = True
                read = self._around(core[read[core]], touched)

    def _around(self, core: Indices, touched: BoolArray) -> BoolArray:
        """Blocks to read: those around which stars are wanted, those that bubbles touched, and those near the first."""
        read = touched.copy()
        read[core] = True
        return read | self.index.near(core, REACH, ~read)

    def _mesh(
        self, read: BoolArray, alone: BoolArray, pending: LongArray | None
    ) -> tuple[SphericalDelaunay | PlanarDelaunay, LongArray, Indices]:
        """The triangulation of what is read, the numbers of its points and their blocks."""
        count = int(self.index.sizes[read].sum()) + int(np.count_nonzero(alone))
        if count > self.limit:
            star = "some stars" if pending is None else f"the star of point {pending[0]}"
            raise MemoryError(
                f"{self.name}: {star} may need {count} points at once, more than limit={self.limit}; "
                "give a higher limit, or smaller partitions"
            )
        points, numbers, block = self.index.read(np.flatnonzero(read), np.flatnonzero(alone))
        self.reading.add(count)
        return triangulation(points), numbers, block

    def _open(
        self, mesh: SphericalDelaunay | PlanarDelaunay, wanted: BoolArray, unread: BoolArray
    ) -> tuple[BoolArray, FloatArray]:
        """Wanted points whose stars are not final, and how deep their bubbles reach into blocks that were not read."""
        if mesh.dimension < 2:  # all on one line so far: any other point will do
            return wanted & unread.any(), unread.astype(np.float64)
        index, faces = self.index, mesh.simplices
        if isinstance(mesh, PlanarDelaunay):
            hull = mesh.convex_hull
            faces = np.concatenate([faces, np.column_stack([hull, np.full(len(hull), -1, dtype=np.int32)])])
        touching, depth = index.space.open_bubbles(
            mesh.points, faces, index.lows, index.highs, index.levels, index.counts(unread), wanted
        )
        is_open = np.zeros(len(wanted) + 1, dtype=np.bool_)  # the last one for edges of the hull
        is_open[faces[touching]] = True
        return is_open[:-1] & wanted, depth
