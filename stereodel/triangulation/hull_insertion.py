"""The paper's pseudo-code: points one at a time, visible facets replaced by a fan over their horizon.

The sites answer what a point sees by the kernel's exact signs, ties decided; one engine serves plane and sphere.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, IntArray, as_plane_or_sphere, read_only
from stereodel._spaces import surface_of
from stereodel.triangulation.sites import GHOST, SITES, InsertionSites, end_with
from stereodel.triangulation.topology import Edge, Facet, as_rows


@dataclass(frozen=True, eq=False)
class InsertionStep:
    """One point's insertion.

    Attributes
    ----------
    inserted : int
        Index of the point.
    visible : (k, 3) array of int32
        Facets that the point sees from outside, counterclockwise; they have been removed.
    horizon : (h, 2) array of int32
        Boundary of the facets that it sees, one counterclockwise cycle of directed edges; h = k + 2.
    new : (h, 3) array of int32
        Facets that join the horizon to the point.

    Notes
    -----
    In the plane -1 is the ghost vertex at infinity.
    """

    inserted: int
    visible: IntArray
    horizon: IntArray
    new: IntArray


class HullInsertion:
    """Incremental hull of directions, or Delaunay triangulation of the plane, one point at a time.

    Iterating inserts: each step finds the facets that the next point sees, removes them and joins their horizon to the
    point. The first three points that span start the surface; duplicates are passed over.

    Parameters
    ----------
    points : (n, 2) or (n, 3) array_like
        Points of the plane, where the projection pole is a ghost vertex, index -1; or directions of any length.

    Attributes
    ----------
    points : (n, 2) or (n, 3) array
    start : tuple of int
        The points of the first surface; fewer than three if all lie on one line (one great circle).

    Raises
    ------
    ValueError, TypeError
        For values that are not finite real numbers, zero vectors, or other shapes.

    Notes
    -----
    The paper (row P14) takes the sphere's centre for a point inside and compares signs with it; the first hulls hardly
    ever hold the centre. Facets are oriented counterclockwise seen from outside the hull instead: p sees a b c if and
    only if det(b−a, c−a, p−a) > 0 on the exact unit vectors. Ties are decided by displacing points, in an order of the
    points themselves: none is ever hidden, the facets that a point sees form a tree, and the result depends only on
    the set of points.

    The first visible facet is found by a visibility walk in the triangulation as the pole sees it, which ends
    because the triangulation is a regular one (H. Edelsbrunner, "An acyclicity theorem for cell complexes in d
    dimensions", 1990).

    Examples
    --------
    >>> hull = HullInsertion([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])
    >>> [step] = hull
    >>> step.inserted, step.visible.tolist(), len(step.horizon)
    (3, [[2, 1, 0]], 3)
    >>> hull.facets.tolist()
    [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]
    """

    def __init__(self, points: npt.ArrayLike) -> None:
        array = as_plane_or_sphere(points)
        self.surface = surface_of(array)
        self._sites = SITES[self.surface]()
        # Each directed edge u → v belongs to one facet, u v w counterclockwise; the one across it is that of v → u.
        self._apex: dict[Edge, int] = {}
        self._first: dict[object, int] = {}
        self._duplicates: list[Edge] = []
        self._waiting: deque[int] = deque()
        self._near: Facet | None = None
        self.points: FloatArray = array[:0]
        self.start: tuple[int, ...] = ()
        self._append(array)

    def extend(self, points: npt.ArrayLike) -> None:
        """Append points; iterate (or `run`) to insert them."""
        self._append(self.surface.as_points(points, "lonlat_to_xyz"))

    def run(self) -> None:
        """Insert all pending points, without a record of the steps."""
        for point in self._take():
            self._insert(point)

    def __iter__(self) -> Iterator[InsertionStep]:
        for point in self._take():
            visible, horizon = self._insert(point)
            new = [(u, v, point) for u, v in horizon]
            yield InsertionStep(point, *(read_only(as_rows(r, w)) for r, w in ((visible, 3), (horizon, 2), (new, 3))))

    @property
    def facets(self) -> IntArray:
        """The current surface, (m, 3) int32: counterclockwise seen from outside, smallest index first, rows in order.

        In the plane facets with -1 lie beyond the edges of the convex hull.
        """
        rows = [(u, v, w) for (u, v), w in self._apex.items() if u < v and u < w]
        return as_rows(sorted(rows), 3)

    @property
    def simplices(self) -> IntArray:
        """The facets without a ghost, (m, 3)."""
        facets = self.facets
        return facets[facets[:, 0] != GHOST]

    @property
    def duplicates(self) -> IntArray:
        """Pairs [dropped, kept] of equal points (directions), (k, 2) int32; the lowest index is kept."""
        return as_rows(self._duplicates, 2)

    @property
    def dimension(self) -> int:
        """-1 without points, 0 for one, 1 on one line (one great circle), 2 otherwise."""
        return len(self.start) - 1

    @property
    def inconclusive(self) -> dict[str, int]:
        """Number of exact ties, by the name "exact"; displacement decides them."""
        return {"exact": self._sites.ties}

    def _append(self, array: FloatArray) -> None:
        size = len(self.points)
        self.points = read_only(np.concatenate([self.points, array]))
        self._sites.extend(self.points[size:])
        kept = {p: self._first.setdefault(self._sites.keys[p], p) for p in range(size, len(self.points))}
        self._duplicates += [(p, first) for p, first in kept.items() if p != first]
        self._waiting += [p for p, first in kept.items() if p == first]
        if len(self.start) < 3:
            self._begin()

    def _begin(self) -> None:
        """Start the surface once three points span; until then all wait."""
        self.start = tuple(spanning_points(self._sites, list(self._waiting)))
        if len(self.start) < 3:
            return
        for facet in self._sites.begin(*self.start):
            self._add(*facet)
            self._near = self._near or facet
        self._waiting = deque(p for p in self._waiting if p not in self.start)

    def _take(self) -> Iterator[int]:
        """Points to insert; one that was handed out no longer waits, so that iterating may stop and go on."""
        while self._near and self._waiting:
            yield self._waiting.popleft()

    def _add(self, u: int, v: int, w: int) -> None:
        self._apex[u, v], self._apex[v, w], self._apex[w, u] = w, u, v

    def _insert(self, point: int) -> tuple[list[Facet], list[Edge]]:
        visible, horizon = self._conflict(point)
        for u, v, w in visible:
            del self._apex[u, v], self._apex[v, w], self._apex[w, u]
        for u, v in horizon:
            self._add(u, v, point)
        self._near = (*horizon[-1], point)
        return visible, horizon

    def _conflict(self, p: int) -> tuple[list[Facet], list[Edge]]:
        """Facets that p sees and the cycle of edges around them, by depth-first search from one of them.

        No facet is reached twice: a second way to one would close a ring around a vertex and hide it.
        """
        sees, apex = self._sites.sees, self._apex
        a, b, c = self._locate(p)
        visible, horizon = [(a, b, c)], []
        border = [(c, a), (b, c), (a, b)]
        while border:
            u, v = border.pop()
            w = apex[v, u]
            if sees(v, u, w, p):
                visible.append((v, u, w))
                border += [(w, v), (u, w)]
            else:
                horizon.append((u, v))
        return visible, horizon

    def _locate(self, p: int) -> Facet:
        """A facet that p sees: the one in which it lies as seen from the pole, or one at the pole."""
        assert self._near is not None
        beyond, apex, pole = self._sites.beyond, self._apex, self._sites.pole
        a, b, c = self._near
        while True:
            if pole in (a, b, c):
                a, b, c = end_with(pole, a, b, c)
                if self._sites.sees(a, b, c, p):
                    return a, b, c
                a, b, c = b, a, apex[b, a]
                continue
            for u, v in ((b, c), (c, a), (a, b)):  # the edge just crossed comes last
                if beyond(u, v, p):
                    a, b, c = v, u, apex[v, u]
                    break
            else:
                return a, b, c


def spanning_points(sites: InsertionSites, distinct: Sequence[int]) -> list[int]:
    """The first points in the given order that span: none, one, two on one line (great circle), or three.

    One less than their number is the dimension of the set. Two antipodal directions count as two although they lie on
    many great circles.
    """
    if len(distinct) < 3:
        return list(distinct)
    first = distinct[0]
    second = next(p for p in distinct[1:] if sites.independent(first, p))
    third = (p for p in distinct[1:] if sites.turn(first, second, p))
    return [first, second, *([p] if (p := next(third, None)) is not None else [])]
