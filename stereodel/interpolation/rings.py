"""The neighbours of points and their neighbours, block by block."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from stereodel._arrays import AnyIndices
from stereodel.curves.ragged import spans
from stereodel.triangulation.dispatch import Triangulation, open_triangles
from stereodel.triangulation.topology import adjacency_of, edges_of

BLOCK = 4096
"""Points in a block, with about 80 000 neighbours of neighbours."""


class Adjacency:
    """The points that an edge joins to each point, as flat arrays."""

    def __init__(self, edges: AnyIndices, size: int) -> None:
        indptr, ends = adjacency_of(edges, size)
        self._ends = ends.astype(np.int64)
        self._starts, self._counts = indptr[:-1].astype(np.int64), np.diff(indptr)

    def around(self, points: AnyIndices) -> tuple[AnyIndices, AnyIndices]:
        """Pairs of a place in `points` and a point joined to the point there."""
        counts = self._counts[points]
        owners = np.repeat(np.arange(len(points)), counts)
        return owners, self._ends[spans(self._starts[points], counts)]


def rings_in_blocks(triangulation: Triangulation) -> Iterator[tuple[AnyIndices, AnyIndices, AnyIndices]]:
    """Points that have triangles, in blocks, with the neighbours of each and their neighbours.

    Yields points (b,), and pairs owners, others (p,): a place in `points`, in order, and a point of the two rings
        around the point there, each once. Edges of triangles that close a set within a hemisphere do not count.
    """
    simplices = triangulation.simplices[open_triangles(triangulation)]
    size = len(triangulation.points)
    adjacency = Adjacency(edges_of(simplices), size)
    used = np.unique(simplices)
    for first in range(0, len(used), BLOCK):
        points = used[first : first + BLOCK]
        owners, ring = adjacency.around(points)
        places, second = adjacency.around(ring)
        # A pair is one number, owner · size + neighbour, so that sorting finds what both rings have twice.
        pairs = np.sort(np.concatenate([owners * size + ring, owners[places] * size + second]))
        owners, others = np.divmod(pairs[np.diff(pairs, prepend=-1) > 0], size)
        apart = others != points[owners]
        yield points, owners[apart], others[apart]
