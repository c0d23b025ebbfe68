"""Diagonals of cocircular polygons by the tie rule: the triangulation of slightly displaced points, integers only.

Each point is displaced infinitesimally, the first one in the order by far the most. If the displacement carries points
out of the hull, the first point sees the whole polygon and is joined to all other corners. If it carries them in, the
first point sinks below the rest and is cut off as an ear; then the next one of what remains, down to a triangle.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from stereodel._arrays import BoolArray, IntArray
from stereodel.triangulation.cells import Cycles, Indices
from stereodel.triangulation.topology import canonical


def triangulate_polygons(cycles: Cycles, rank: Indices, outward: BoolArray) -> IntArray:
    """Triangles (m, 3) of counterclockwise polygons, each beginning with its lowest index, in lexicographic order.

    Parameters
    ----------
    cycles : Cycles
        Polygons of three or more sites.
    rank : (n,) array of int
        Place of each site in the order of the tie rule.
    outward : (c,) array of bool
        Whether the displacement carries the points of a polygon out of the hull.
    """
    lengths = np.diff(cycles.offsets)
    plain = cycles.offsets[:-1][lengths == 3]
    triangles = [cycles.members[plain[:, None] + np.arange(3)]]
    for k in np.flatnonzero(lengths > 3).tolist():
        polygon = cycles.members[cycles.offsets[k] : cycles.offsets[k + 1]].tolist()
        places = rank[polygon].tolist()
        triangles.append(np.array(_fan(polygon, places) if outward[k] else _ears(polygon, places)))
    return canonical(np.concatenate(triangles))


def _fan(polygon: Sequence[int], places: Sequence[int]) -> list[tuple[int, int, int]]:
    first = min(range(len(polygon)), key=places.__getitem__)
    apex, *others = [*polygon[first:], *polygon[:first]]
    return [(apex, a, b) for a, b in pairwise(others)]


def _ears(polygon: Sequence[int], places: Sequence[int]) -> list[tuple[int, int, int]]:
    n = len(polygon)
    before, after = [k - 1 for k in range(n)], [(k + 1) % n for k in range(n)]
    before[0] = n - 1
    triangles = []
    for k in sorted(range(n), key=places.__getitem__)[: n - 2]:
        a, b = before[k], after[k]
        triangles.append((polygon[a], polygon[k], polygon[b]))
        after[a], before[b] = b, a
    return triangles
