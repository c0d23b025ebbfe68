"""Proof that a triangulation is Delaunay, by a checker that shares no code with the engines.

Local tests alone prove nothing: a great icosahedron is a closed manifold with V − E + F = 2, and all its edges are
locally convex. `check_delaunay` therefore certifies three things, each exactly:

1. the simplices form one oriented manifold (sphere: closed; plane: with a boundary) that uses every kept point, with
   Euler's formula;
2. every edge is locally Delaunay: neither opposite corner lies inside the other triangle's circle;
3. single cover. Plane: every triangle is counterclockwise and the boundary one convex cycle that turns once. Sphere:
   the same after projection from one vertex v, where a triangle a b c is counterclockwise if and only if v is outside
   its bubble, circles stay circles, and the boundary is the link of v.

From 3 the projected triangles tile a convex polygon once, and for a tiling 2 implies empty circles (B. Delaunay, "Sur
la sphère vide", 1934). Turning once is counted by local maxima along a direction: a locally convex closed polygon has
one for each turn.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import gcd
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, LongArray, SignArray, as_plane_or_sphere
from stereodel.triangulation.validate_mesh import (
    InvalidTriangulation,
    Mesh,
    as_simplices,
    build_mesh,
    check_manifold,
    check_neighbors,
    link_of,
)
from stereodel.triangulation.validate_signs import PlaneSigns, SphereSigns, ray_integers

__all__ = ["DelaunayCertificate", "InvalidTriangulation", "check_delaunay"]


@dataclass(frozen=True)
class DelaunayCertificate:
    """The counts of `check_delaunay`.

    Attributes
    ----------
    surface : {"plane", "sphere"}
    points, duplicates, simplices, edges : int
        Distinct points, points that repeat an earlier one, triangles, edges.
    ties : int
        Edges whose two triangles lie on one circle: either diagonal is Delaunay there.
    exact_tests : int
        Tests that the float filter left open and integers decided.
    """

    surface: Literal["plane", "sphere"]
    points: int
    duplicates: int
    simplices: int
    edges: int
    ties: int
    exact_tests: int


def check_delaunay(
    points: Any,
    simplices: npt.ArrayLike | None = None,
    *,
    duplicates: npt.ArrayLike | None = None,
    neighbors: npt.ArrayLike | None = None,
) -> DelaunayCertificate:
    """Prove that a triangulation of the plane or the sphere is Delaunay, or report where it is not.

    Parameters
    ----------
    points : (n, 2) or (n, 3) array_like, or a triangulation
        Points of the plane, or directions of space (lengths do not matter). An object with `points`, `simplices` and,
        optionally, `duplicates` and `neighbors`, such as `PlanarDelaunay`, provides all four arguments.
    simplices : (m, 3) array_like of int
        Corners of each triangle, counterclockwise (sphere: seen from outside).
    duplicates : (k, 2) array_like of int, optional
        Pairs [dropped, kept] to check. Whether given or not, of equal points (sphere: of equal directions) the
        one with the lowest index must be used.
    neighbors : (m, 3) array_like of int, optional
        `neighbors[t, k]`, the triangle opposite corner k or -1, to check.

    Returns
    -------
    DelaunayCertificate
        Counts; any diagonals of cocircular polygons are accepted and counted as ties.

    Raises
    ------
    InvalidTriangulation
        Naming the first simplex, edge or point that is wrong. A `ValueError`.

    Notes
    -----
    All signs are those of exact arithmetic on the given doubles; on the sphere, on the rays through them. Points all
    on one line (one great circle) must have no simplices. Points on one small circle form a closed two-sided polygon.

    Examples
    --------
    >>> check_delaunay([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]]).ties
    1
    >>> check_delaunay([[0, 0], [1, 0], [3, 3], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    Traceback (most recent call last):
    ...
    stereodel.triangulation.validate_mesh.InvalidTriangulation: edge (2, 0): point 3 lies inside the circle of simplex 0
    """
    if simplices is None:
        duplicates = getattr(points, "duplicates", None) if duplicates is None else duplicates
        neighbors = getattr(points, "neighbors", None) if neighbors is None else neighbors
        simplices, points = points.simplices, points.points
    array = as_plane_or_sphere(points)
    kept_by = first_occurrences(array)
    _check_duplicates(kept_by, duplicates)
    kept = np.flatnonzero(kept_by == np.arange(len(array)))
    triangles = as_simplices(simplices, len(array))
    signs = SphereSigns(array) if array.shape[1] == 3 else PlaneSigns(array)
    edges = ties = 0
    if len(triangles) == 0:
        _check_flat(signs, kept)
    else:
        mesh = build_mesh(triangles, len(array))
        if neighbors is not None:
            check_neighbors(mesh, neighbors)
        ties = _check_plane(mesh, signs, kept) if isinstance(signs, PlaneSigns) else _check_sphere(mesh, signs, kept)
        edges = len(mesh.inner) + len(mesh.boundary)
    counts = len(kept), len(array) - len(kept), len(triangles), edges, ties
    return DelaunayCertificate(signs.surface, *counts, signs.exact_tests)


def first_occurrences(points: FloatArray) -> LongArray:
    """For each point the lowest index of an equal one; in space, of one with the same direction.

    A quotient x/max is the rounding of a real number that depends on the direction alone: equal directions have equal
    keys. Different directions with one key (closer than half an ulp) are distinguished by integers.
    """
    # Equal keys stand next to each other when sorted, by index within a key (the sort is stable): all take the first.
    in_space = points.shape[1] == 3
    keys = (points / np.abs(points).max(axis=1, keepdims=True) if in_space else points) + 0.0  # −0 becomes 0
    order = np.lexsort(keys.T[::-1])
    starts = np.ones(len(points), dtype=bool)
    starts[1:] = (keys[order[1:]] != keys[order[:-1]]).any(axis=1)
    kept = np.empty(len(points), dtype=np.int64)
    kept[order] = order[np.maximum.accumulate(np.where(starts, np.arange(len(points)), 0))]
    if in_space:  # within groups of one key same direction means same integers after division by their gcd
        shared = np.flatnonzero(np.bincount(kept, minlength=len(kept))[kept] > 1)
        seen: dict[tuple[int, ...], int] = {}
        for index, ray in zip(shared.tolist(), ray_integers(points[shared]).tolist(), strict=True):
            divisor = gcd(*ray)
            kept[index] = seen.setdefault(tuple(k // divisor for k in ray), index)
    return kept


def _check_duplicates(kept_by: LongArray, duplicates: npt.ArrayLike | None) -> None:
    if duplicates is None:
        return
    dropped = np.flatnonzero(kept_by != np.arange(len(kept_by)))
    expected = {(int(i), int(kept_by[i])) for i in dropped}
    rows = np.asarray(duplicates)
    if rows.shape != (0,) and rows.shape[1:] != (2,):
        raise InvalidTriangulation(f"duplicates must have shape (k, 2), got {rows.shape}")
    given = {(int(i), int(k)) for i, k in rows.reshape(-1, 2)}
    if wrong := given ^ expected:
        i, k = min(wrong)
        raise InvalidTriangulation(
            f"duplicates is wrong about [{i}, {k}]: the pairs are [point, first one equal to it]"
        )


def _check_flat(signs: PlaneSigns | SphereSigns, kept: LongArray) -> None:
    """No simplices are right only for points all on one line (plane) or one great circle (sphere)."""
    if len(kept) < 3:
        return
    base = kept[:2]
    if isinstance(signs, SphereSigns):  # the second point must not be the antipode of the first
        a, b = ray_integers(signs.points[base])
        base = base if any(a[i - 2] * b[i - 1] != a[i - 1] * b[i - 2] for i in range(3)) else kept[[0, 2]]
    rows = np.column_stack([np.broadcast_to(base, (len(kept), 2)), kept])
    off = signs.turn(rows) if isinstance(signs, PlaneSigns) else signs.side(rows)
    if off.any():
        point = kept[int(np.argmax(off != 0))]
        raise InvalidTriangulation(f"there are no simplices, but points {base[0]}, {base[1]} and {point} span one")


def _check_plane(mesh: Mesh, signs: PlaneSigns, kept: LongArray) -> int:
    positive = signs.turn(mesh.simplices) > 0
    if not positive.all():
        t = int(np.argmin(positive))
        raise InvalidTriangulation(f"simplex {t} = {mesh.simplices[t].tolist()} is not counterclockwise")
    check_manifold(mesh, kept, euler=1)
    _check_convex_boundary(mesh, signs)
    inner = mesh.inner
    rows = np.column_stack([mesh.simplices[inner // 3], mesh.apex[mesh.twin[inner]]])
    return _check_edges(mesh, inner, signs.circle(rows))


def _check_edges(mesh: Mesh, inner: LongArray, inside: SignArray) -> int:
    """Refuse an opposite corner inside a circle; return the number of ties."""
    if (inside > 0).any():
        h = int(inner[np.argmax(inside > 0)])
        raise InvalidTriangulation(
            f"edge {mesh.edge(h)}: point {mesh.apex[mesh.twin[h]]} lies inside the circle of simplex {h // 3}"
        )
    return int((inside == 0).sum())


def _check_convex_boundary(mesh: Mesh, signs: PlaneSigns) -> None:
    """Never turning right, one local maximum in lexicographic order over all boundary cycles together.

    The fans have been checked: each boundary point has one boundary edge in and one out.
    """
    boundary = mesh.boundary
    origin, target = mesh.origin[boundary], mesh.target[boundary]
    following = np.empty(len(signs.points), dtype=np.int64)
    following[origin] = target
    after = following[target]
    right = signs.turn(np.column_stack([origin, target, after])) < 0
    if right.any():
        raise InvalidTriangulation(f"the boundary is not convex at point {target[np.argmax(right)]}")
    rises, falls = _rises(signs.points, origin, target), ~_rises(signs.points, target, after)
    if (rises & falls).sum() != 1:
        raise InvalidTriangulation("the boundary is not a single cycle that turns once")


def _rises(points: FloatArray, a: LongArray, b: LongArray) -> BoolArray:
    """Whether b follows a in lexicographic order."""
    p, q = points[a], points[b]
    return (q[:, 0] > p[:, 0]) | ((q[:, 0] == p[:, 0]) & (q[:, 1] > p[:, 1]))


def _check_sphere(mesh: Mesh, signs: SphereSigns, kept: LongArray) -> int:
    if len(mesh.boundary):
        h = int(mesh.boundary[0])
        raise InvalidTriangulation(f"edge {mesh.edge(h)} belongs to simplex {h // 3} only: the surface is not closed")
    check_manifold(mesh, kept, euler=2)
    inner = mesh.inner
    # The edge's own end is the base of the filter's differences: they stay short where the triangles are small.
    rows = np.column_stack([mesh.origin[inner], mesh.target[inner], mesh.apex[inner], mesh.apex[mesh.twin[inner]]])
    inside = signs.bubble(rows)
    ties = _check_edges(mesh, inner, inside)
    if ties == len(inner):
        _check_two_sided(mesh, signs)
    else:
        _check_folds(mesh, signs, inner[inside == 0])
        degree = np.bincount(mesh.apex)
        _check_single_cover(mesh, signs, int(np.argmin(np.where(degree > 0, degree, len(mesh.apex)))))
    return ties


def _check_folds(mesh: Mesh, signs: SphereSigns, tied: LongArray) -> None:
    """Two triangles of one plane must face the same way: det[a, b, c] tells, or `facing` if the centre is in it."""
    first, second = mesh.simplices[tied // 3], mesh.simplices[mesh.twin[tied] // 3]
    folded = signs.side(first) != signs.side(second)
    great = np.flatnonzero(signs.side(first) == 0)
    folded[great] |= (signs.facing(first[great]) != signs.facing(second[great])).any(axis=1)
    if folded.any():
        h = int(tied[np.argmax(folded)])
        raise InvalidTriangulation(f"edge {mesh.edge(h)}: its simplices lie in one plane, one folded onto the other")


def _check_single_cover(mesh: Mesh, signs: SphereSigns, vertex: int) -> None:
    """In the projection from one vertex, whichever, the triangles without it tile a convex polygon once."""
    away = np.flatnonzero((mesh.simplices != vertex).all(axis=1))
    rows = np.column_stack([mesh.simplices[away], np.full(len(away), vertex)])
    sees = signs.bubble(rows) > 0
    if sees.any():
        t = int(away[np.argmax(sees)])
        raise InvalidTriangulation(f"point {vertex} lies in the bubble of simplex {t} = {mesh.simplices[t].tolist()}")
    link = link_of(mesh, vertex)
    # Two independent vectors orthogonal to the point: along one of them the link is not flat.
    x, y, z = ray_integers(signs.points[vertex])
    a, b, c = along = np.array([-y, x, 0] if x or y else [-z, 0, 0], dtype=object)
    across = np.array([y * c - z * b, z * a - x * c, x * b - y * a], dtype=object)
    first, second = (signs.progress(link, vertex, way) for way in (along, across))
    steps = first if first.any() else second
    steps = steps[steps != 0]
    if ((steps > 0) & (np.roll(steps, -1) < 0)).sum() != 1:
        raise InvalidTriangulation(f"the simplices around point {vertex} do not turn once: the sphere is covered twice")


def _check_two_sided(mesh: Mesh, signs: SphereSigns) -> None:
    """All points on one circle: both sides triangulate the same convex polygon.

    On a small circle det[a, b, c] tells the side of a triangle. Seen from one point of the circle the others lie within
    a half-turn, so a cycle along which the angle grows turns once and is the polygon.
    """
    side = signs.side(mesh.simplices)
    if not side.all():
        raise InvalidTriangulation("all points lie on one great circle, which must have no simplices")
    outer = np.repeat(side > 0, 3)
    rim = np.flatnonzero(outer & ~outer[mesh.twin])
    base = int(mesh.origin[rim].min()) if len(rim) else 0
    touching = (mesh.origin[rim] == base) | (mesh.target[rim] == base)
    rest = rim[~touching]
    grows = signs.side(np.column_stack([np.full(len(rest), base), mesh.origin[rest], mesh.target[rest]])) > 0
    if touching.sum() != 2 or not grows.all():
        raise InvalidTriangulation("the points lie on one circle, but its two sides do not meet in one convex polygon")
