"""Point sets as the insertion engine asks them: which facets does a point see, ties decided.

One engine serves plane and sphere. Circles stay circles under stereographic projection, so a planar triangulation is a
hull whose pole is a ghost vertex, and a hull is a planar triangulation whose pole is one of its own points.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterator

from stereodel._arrays import FloatArray
from stereodel._spaces import PLANE, SPHERE, PlaneOrSphere
from stereodel.predicates.integers import to_integers
from stereodel.predicates.plane import (
    filter_coordinates,
    incircle_filter,
    incircle_integer,
    orient2d_filter,
    orient2d_integer,
)
from stereodel.predicates.rays import Ray, bubble_filter, bubble_ray, ray, turn_ray, units
from stereodel.predicates.ties import Point, bubble_tie, incircle_tie
from stereodel.triangulation.topology import Facet

GHOST = -1
"""The plane's point at infinity as a vertex."""


class _Sites:
    """Points by number, with the signs that the engine needs.

    keys: one hashable value for each point, equal exactly for equal points.
    pole: vertex from which the surface is seen as a planar triangulation.
    inconclusive: counts of "filter", tests that floating point left open, and "exact", ties that displacement decided.
    """

    keys: list[Hashable]
    pole: int
    _exact_signs: Callable[..., Iterator[int]]
    """The exact sign of the sidedness test of four points, then that after displacement, each made when asked."""

    def __init__(self) -> None:
        self.keys = []
        self.inconclusive: Counter[str] = Counter(filter=0, exact=0)

    def _is_inside(self, value: float, bound: float, *four: int) -> bool:
        """Whether the sidedness test of four points is positive: by its value in doubles if that exceeds the bound."""
        if abs(value) > bound:
            return value > 0
        self.inconclusive["filter"] += 1
        signs = self._exact_signs(*four)
        sign = next(signs)
        if sign == 0:
            self.inconclusive["exact"] += 1
            sign = next(signs)
        return sign > 0


class PlaneSites(_Sites):
    """Points of the plane; the pole is the ghost, takes part in no displacement and wins every tie."""

    pole = GHOST

    def __init__(self) -> None:
        super().__init__()
        self._floats: list[tuple[float, ...]] = []
        self._coordinates: list[float] = []
        self._integers: list[Point] = []

    def extend(self, points: FloatArray) -> None:
        """Append points (k, 2)."""
        self._floats += map(tuple, filter_coordinates(points).tolist())
        self._coordinates += points.ravel().tolist()
        self.keys += map(tuple, (points + 0.0).tolist())  # −0 becomes 0

    def begin(self, a: int, b: int, c: int) -> list[Facet]:
        """The first surface, of three points that `turn`: the triangle, and a ghost facet beyond each of its edges."""
        if self.turn(a, b, c) < 0:
            b, c = c, b
        return [(a, b, c), (b, a, GHOST), (c, b, GHOST), (a, c, GHOST)]

    def sees(self, a: int, b: int, c: int, p: int) -> bool:
        """Whether p sees the facet, inside its circle; if it has a ghost, beyond its edge or within the open edge."""
        if c == GHOST:
            return self._sees_edge(a, b, p)
        if a == GHOST:
            return self._sees_edge(b, c, p)
        if b == GHOST:
            return self._sees_edge(c, a, p)
        floats = self._floats
        value, bound = incircle_filter(floats[a], floats[b], floats[c], floats[p])
        return self._is_inside(value, bound, a, b, c, p)

    def _exact_signs(self, *four: int) -> Iterator[int]:
        points = [self._exact()[i] for i in four]
        yield incircle_integer(*points)
        yield incircle_tie(*points)

    def _sees_edge(self, u: int, v: int, p: int) -> bool:
        sign = self.turn(u, v, p)
        if sign == 0:
            self.inconclusive["exact"] += 1
            low, middle, high = (self._coordinates[2 * i : 2 * i + 2] for i in (u, p, v))
            return low < middle < high or high < middle < low
        return sign > 0

    def beyond(self, u: int, v: int, p: int) -> bool:
        """Whether p lies strictly to the right of the edge u → v: the ghost takes part in no displacement."""
        return self.turn(v, u, p) > 0

    def turn(self, a: int, b: int, c: int) -> int:
        """Orientation of three points, exactly; 0 on one line."""
        floats = self._floats
        value, bound = orient2d_filter(floats[a], floats[b], floats[c])
        if value > bound:
            return 1
        if value < -bound:
            return -1
        self.inconclusive["filter"] += 1
        points = self._exact()
        return orient2d_integer(points[a], points[b], points[c])

    def independent(self, a: int, b: int) -> bool:
        """Two distinct points always span a line."""
        return True

    def _exact(self) -> list[Point]:
        """All points as integers of one scale, made when first needed."""
        if 2 * len(self._integers) != len(self._coordinates):
            flat = to_integers(self._coordinates)
            self._integers = list(zip(flat[::2], flat[1::2], strict=True))
        return self._integers


class RaySites(_Sites):
    """Directions; the pole is the first vertex of the first surface."""

    def __init__(self) -> None:
        super().__init__()
        self._units: list[tuple[float, ...]] = []
        self._rays: list[Ray] = []

    def extend(self, points: FloatArray) -> None:
        """Append non-zero vectors (k, 3)."""
        self._units += map(tuple, units(points).tolist())
        rays = [ray(vector) for vector in points.tolist()]
        self._rays += rays
        self.keys += rays

    def begin(self, a: int, b: int, c: int) -> list[Facet]:
        """The first surface, the triangle from both sides: any further point, displaced, sees exactly one of them."""
        self.pole = a
        return [(a, b, c), (a, c, b)]

    def sees(self, a: int, b: int, c: int, p: int) -> bool:
        """Whether p sees the facet from outside: whether it lies in its bubble."""
        four = self._units
        value, bound = bubble_filter(four[a], four[b], four[c], four[p])
        return self._is_inside(value, bound, a, b, c, p)

    def _exact_signs(self, *four: int) -> Iterator[int]:
        rays = [self._rays[i] for i in four]
        yield bubble_ray(*rays)
        yield bubble_tie(*rays)

    def beyond(self, u: int, v: int, p: int) -> bool:
        """Whether p is beyond an edge, seen from the pole: would see the facet that joins it, reversed, to the pole."""
        return self.sees(v, u, self.pole, p)

    def turn(self, a: int, b: int, c: int) -> int:
        """Orientation of three directions, exactly; 0 on one great circle."""
        return turn_ray(self._rays[a], self._rays[b], self._rays[c])

    def independent(self, a: int, b: int) -> bool:
        """Whether two different directions are not opposite."""
        return self._rays[a][:3] != tuple(-x for x in self._rays[b][:3])


InsertionSites = PlaneSites | RaySites
SITES: dict[PlaneOrSphere, type[PlaneSites | RaySites]] = {PLANE: PlaneSites, SPHERE: RaySites}
