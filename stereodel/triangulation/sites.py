"""Point sets as the insertion engine asks them: which facets does a point see, ties decided.

One engine serves plane and sphere. Circles stay circles under stereographic projection, so a planar triangulation is a
hull whose pole is a ghost vertex, and a hull is a planar triangulation whose pole is one of its own points. All signs
are the kernel's, exact; only what decides an exact zero is worked out here.

That is displacement without end, ordered by the points themselves (H. Edelsbrunner, E. P. Mücke, "Simulation of
simplicity", ACM Transactions on Graphics 9 (1990), with this order in place of the indices). Plane: the heights x² + y²
grow by ε, the more the earlier the point stands in lexicographic order. Sphere: directions move outward, p̂(1 + ε), in
the same way; four points of a great circle, which that does not separate, take second, smaller displacements along x,
then y, then z. A zero is therefore decided by the first point, in that order, whose cofactor is not zero. No order of
input changes a triangulation, and points in strictly convex position stay so: nothing is hidden, no zero is left.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from fractions import Fraction
from functools import cmp_to_key
from typing import Any

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._spaces import PLANE, SPHERE, PlaneOrSphere
from stereodel.triangulation.topology import Facet

GHOST = -1
"""The plane's point at infinity as a vertex."""


def end_with(last: int, a: int, b: int, c: int) -> Facet:
    """The same facet, `last` as its third vertex."""
    if c == last:
        return a, b, c
    return (b, c, a) if a == last else (c, a, b)


class _Sites:
    """Points by number, with the signs that the engine needs.

    keys: one hashable value for each point, equal exactly for equal points.
    pole: vertex from which the surface is seen as a planar triangulation.
    ties: how many exact zeros displacement has decided.
    """

    pole: int
    _kernel: Any
    _key: Callable[..., Hashable]  # of the coordinates of a point
    _compare: Callable[..., int]  # of two points, in the order of displacement: negative where the first comes before
    _tie: Callable[..., int]  # sign of the cofactor of the point before three others of a circle, were it the first

    def __init__(self) -> None:
        self.keys: list[Any] = []
        self.ties = 0
        self._rows: list[FloatArray] = []

    def extend(self, points: FloatArray) -> None:
        """Append points (k, width), which nobody changes."""
        self._rows += [points[k : k + 1] for k in range(len(points))]
        self.keys += map(self._key, points.tolist())

    def turn(self, a: int, b: int, c: int) -> int:
        """Orientation of three points, exactly; 0 on one line or great circle."""
        rows = self._rows
        return int(self._kernel.turn(rows[a], rows[b], rows[c])[0])

    def sees(self, a: int, b: int, c: int, p: int) -> bool:
        """Whether p sees the facet from outside: lies in its circle, after displacement if it lies on it."""
        rows = self._rows
        sign = int(self._kernel.in_circle(rows[a], rows[b], rows[c], rows[p])[0])
        if sign == 0:
            self.ties += 1
            four = a, b, c, p
            first = four.index(min(four, key=cmp_to_key(self._compare)))
            sign = (-1) ** first * self._tie(*four[:first], *four[first + 1 :])
        return sign > 0


class PlaneSites(_Sites):
    """Points of the plane; the pole is the ghost, takes part in no displacement and wins every tie."""

    pole, _kernel = GHOST, PLANE.kernel

    def begin(self, a: int, b: int, c: int) -> list[Facet]:
        """The first surface, of three points that `turn`: the triangle, and a ghost facet beyond each of its edges."""
        if self.turn(a, b, c) < 0:
            b, c = c, b
        return [(a, b, c), (b, a, GHOST), (c, b, GHOST), (a, c, GHOST)]

    def sees(self, a: int, b: int, c: int, p: int) -> bool:
        """The same; if the facet has a ghost, whether p lies beyond its edge or within the open edge."""
        if GHOST not in (a, b, c):
            return super().sees(a, b, c, p)
        u, v, _ = end_with(GHOST, a, b, c)
        sign = self.turn(u, v, p)
        if sign == 0:
            self.ties += 1
            low, middle, high = (self.keys[i] for i in (u, p, v))
            return bool(low < middle < high or high < middle < low)
        return sign > 0

    def beyond(self, u: int, v: int, p: int) -> bool:
        """Whether p lies strictly to the right of the edge u → v: the ghost takes part in no displacement."""
        return self.turn(v, u, p) > 0

    def independent(self, a: int, b: int) -> bool:
        """Two distinct points always span a line."""
        return True

    def _key(self, point: list[float]) -> Hashable:
        return point[0] + 0.0, point[1] + 0.0  # −0 becomes 0

    def _compare(self, a: int, b: int) -> int:
        return (self.keys[a] > self.keys[b]) - (self.keys[a] < self.keys[b])

    def _tie(self, a: int, b: int, c: int) -> int:
        # Three points of a circle are not collinear: the first point always decides.
        return self.turn(a, b, c)


class RaySites(_Sites):
    """Directions; the pole is the first vertex of the first surface."""

    _kernel = SPHERE.kernel

    def begin(self, a: int, b: int, c: int) -> list[Facet]:
        """The first surface, the triangle from both sides: any further point, displaced, sees exactly one of them."""
        self.pole = a
        return [(a, b, c), (a, c, b)]

    def beyond(self, u: int, v: int, p: int) -> bool:
        """Whether p is beyond an edge, seen from the pole: would see the facet that joins it, reversed, to the pole."""
        return self.sees(v, u, self.pole, p)

    def independent(self, a: int, b: int) -> bool:
        """Whether two different directions are not opposite."""
        return bool(self.keys[a] != tuple(-x for x in self.keys[b]))

    def _key(self, point: list[float]) -> Hashable:
        largest = Fraction(max(map(abs, point)))
        return tuple(Fraction(x) / largest for x in point)

    def _compare(self, a: int, b: int) -> int:
        return int(self._kernel.compare(self._rows[a], self._rows[b])[0])

    def _tie(self, a: int, b: int, c: int) -> int:
        # The test is minus the determinant with rows (x̂, ŷ, ẑ, 1); moving p̂ to p̂(1 + ε) is, up to a positive factor of
        # its row, moving the 1 to 1 − ε. Three points of a small circle are independent, so the first point decides.
        if sign := -self.turn(a, b, c):
            return sign
        # On a great circle the cofactor of column k is, up to (−1)^k, the area of the triangle of the others seen along
        # axis k: the normal's component, on the side from which they are counterclockwise. In the bubble of the three
        # on that side the direction of the axis lies where that is positive.
        for axis in np.eye(3)[:, None]:
            if sign := -int(self._kernel.in_circle(*(self._rows[i] for i in (a, b, c)), axis)[0]):
                return sign
        raise ArithmeticError("three of the four directions are the same")


InsertionSites = PlaneSites | RaySites
SITES: dict[PlaneOrSphere, type[PlaneSites | RaySites]] = {PLANE: PlaneSites, SPHERE: RaySites}
