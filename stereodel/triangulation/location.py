"""Which triangle holds a query, which point is nearest: exact, for many queries at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, IntArray
from stereodel.constants import UNIT_ROUNDOFF
from stereodel.predicates.integers import sign_of_roots, to_integers
from stereodel.predicates.plane import orient2d_signs
from stereodel.predicates.rays import difference, ray, turn_filter, turn_ray, units
from stereodel.predicates.staged import SignArray, columns, decide

Indices = npt.NDArray[np.integer]
Side = Callable[[Indices, Indices, Indices], SignArray]
"""Side of each query on the directed edge between two points: 1 left, −1 right, 0 on the line (great circle)."""
Closer = Callable[[int, int, int], bool]
"""Whether a query lies strictly closer to the first point than to the second."""

_ENTRIES_AT_ONCE = 2**20  # of the matrix of distances: 8 MB for each of its arrays
_LANDMARKS = 32  # a walk starts at the best of so many triangles


def plane_side(points: FloatArray, queries: FloatArray) -> Side:
    """`Side` of queries in the plane."""
    return lambda u, v, q: orient2d_signs(points[u], points[v], queries[q])


def ray_side(points: FloatArray, queries: FloatArray) -> Side:
    """`Side` of queried directions."""
    point_units, query_units = units(points), units(queries)

    def side(u: Indices, v: Indices, q: Indices) -> SignArray:
        value, bound = turn_filter(*(columns(x) for x in (point_units[u], point_units[v], query_units[q])))
        return decide(value, bound, lambda k: turn_ray(*map(ray, (points[u[k]], points[v[k]], queries[q[k]]))))

    return side


def landmarks(centers: FloatArray, candidates: Indices, queries: FloatArray) -> Indices:
    """For each query the best of a few triangles to start from; where floating point errs the walk is only longer."""
    chosen = candidates[np.linspace(0, len(candidates) - 1, _LANDMARKS).astype(np.intp)]
    with np.errstate(over="ignore", invalid="ignore"):
        places = centers[chosen]
        best = np.argmin((places**2).sum(axis=1) - 2 * queries @ places.T, axis=1)
    result: Indices = chosen[best]
    return result


def walk(simplices: IntArray, neighbors: IntArray, side: Side, start: Indices) -> IntArray:
    """Triangle of each query, starting from `start`; -1 for those that leave through an edge without neighbour.

    All queries step at once, each across the first edge that it lies strictly to the right of. In a Delaunay
    triangulation no query ever comes back (H. Edelsbrunner, 1990). On the sphere the same follows from the hull: the
    functions n·x/d that are 1 on the plane n·x = d of a facet with d > 0 grow along the walk.
    """
    current = np.array(start, dtype=np.int32)
    active = np.arange(len(current))
    while active.size:
        moving = np.zeros(len(active), dtype=np.bool_)
        here = current[active]
        for k in range(3):
            rest = np.flatnonzero(~moving)
            u, v = (simplices[here[rest], (k + j) % 3] for j in (1, 2))
            across = rest[side(u, v, active[rest]) < 0]
            current[active[across]] = neighbors[here[across], k]
            moving[across] = True
        active = active[moving]
        active = active[current[active] >= 0]
    return current


def lowest_containing(
    simplices: IntArray, neighbors: IntArray, lowest_at: IntArray, side: Side, found: IntArray
) -> IntArray:
    """The lowest triangle that holds each query, given one that does: another one does on edges and vertices only."""
    result = found.copy()
    inside = np.flatnonzero(found >= 0)
    corners = simplices[found[inside]]
    on_edge = np.column_stack([side(corners[:, k - 2], corners[:, k - 1], inside) == 0 for k in range(3)])
    count = on_edge.sum(axis=1)
    edge, vertex = np.flatnonzero(count == 1), np.flatnonzero(count == 2)
    across = neighbors[found[inside[edge]], np.argmax(on_edge[edge], axis=1)]
    result[inside[edge]] = np.where(across >= 0, np.minimum(across, found[inside[edge]]), found[inside[edge]])
    result[inside[vertex]] = lowest_at[corners[vertex, np.argmin(on_edge[vertex], axis=1)]]
    return result


def nearest_in_plane(points: FloatArray, queries: FloatArray) -> IntArray:
    """Row of the nearest point for each query, the lowest if several are.

    A squared distance takes a difference (which counts twice), a square and a sum: four roundings, so the nearest is
    among those within a factor 1 + 16u of the least one, and 2⁻¹⁰⁰⁰ where squares underflow; integers choose from
    these.
    """

    def near(part: FloatArray) -> npt.NDArray[np.bool_]:
        with np.errstate(over="ignore", invalid="ignore"):
            delta = part[:, None] - points[None]
            squares = delta[..., 0] ** 2 + delta[..., 1] ** 2
        least: FloatArray = squares.min(axis=1, keepdims=True)
        return squares <= least * (1 + 16 * UNIT_ROUNDOFF) + 2.0**-1000

    def closer(q: int, a: int, b: int) -> bool:
        flat = to_integers([*queries[q].tolist(), *points[a].tolist(), *points[b].tolist()])
        to_a, to_b = ((flat[k] - flat[0]) ** 2 + (flat[k + 1] - flat[1]) ** 2 for k in (2, 4))
        return to_a < to_b

    return _choose(near, closer, len(points), queries)


def nearest_on_sphere(points: FloatArray, queries: FloatArray) -> IntArray:
    """Row of the nearest direction for each query, the lowest if several are.

    A chord is the root of a sum of squared components, each relatively off by two roundings and absolutely by 2⁻¹⁰⁰
    (see `predicates.rays`), and takes three more: the nearest is among those within a factor 1 + 16u and 2⁻⁹⁷ of the
    least chord. Among these the largest cosine q·a/|a| decides, compared exactly.
    """
    point_units = columns(units(points)[None])

    def near(part: FloatArray) -> npt.NDArray[np.bool_]:
        delta = difference(columns(units(part)[:, None]), point_units)
        chords = np.sqrt(delta[0] ** 2 + delta[1] ** 2 + delta[2] ** 2)
        least: FloatArray = chords.min(axis=1, keepdims=True)
        return chords <= least * (1 + 16 * UNIT_ROUNDOFF) + 2.0**-97

    def closer(q: int, a: int, b: int) -> bool:
        query, one, other = (ray(v.tolist()) for v in (queries[q], points[a], points[b]))
        cosines = [sum(x * y for x, y in zip(query[:3], p[:3], strict=True)) for p in (one, other)]
        return sign_of_roots(((cosines[0], other[3]), (-cosines[1], one[3]))) > 0

    return _choose(near, closer, len(points), queries)


def _choose(
    near: Callable[[FloatArray], npt.NDArray[np.bool_]], closer: Closer, size: int, queries: FloatArray
) -> IntArray:
    """Candidates from the matrix of distances, part by part; the exact comparison where more than one is left."""
    result = np.empty(len(queries), dtype=np.int32)
    rows = max(1, _ENTRIES_AT_ONCE // size)
    for first in range(0, len(queries), rows):
        candidates = near(queries[first : first + rows])
        result[first : first + rows] = np.argmax(candidates, axis=1)
        for row in np.flatnonzero(candidates.sum(axis=1) > 1).tolist():
            best, *others = np.flatnonzero(candidates[row]).tolist()
            for other in others:
                best = other if closer(first + row, other, best) else best
            result[first + row] = best
    return result
