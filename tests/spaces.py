"""Plane and sphere as one table: each with the kernel's door, the public one, and what exact numbers say.

@BOTH
@given(data=st.data())
def test_…(space, data):
    points = data.draw(space.points(limit=3, min_size=3))
    triangulation = space.triangulated(points)   # valid, or the test fails
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import cmp_to_key
from types import ModuleType

import numpy as np
import pytest
from hypothesis import strategies as st

from stereodel import HullInsertion, PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi, _kernel
from stereodel.predicates import orient2d, orient3d
from stereodel.triangulation import check_delaunay
from stereodel.triangulation.sites import PlaneSites, RaySites
from tests.reference import ray, sign_of_roots


@dataclass(frozen=True)
class Space:
    name: str
    width: int
    kernel: ModuleType
    delaunay: type
    voronoi: type

    def __str__(self):
        return self.name

    def places(self, limit):
        """Small whole numbers: equal, collinear and cocircular ones, on the sphere also opposite ones."""
        place = st.tuples(*[st.integers(-limit, limit)] * self.width)
        return place if self.width == 2 else place.filter(any)

    def points(self, limit, **sizes):
        return st.lists(self.places(limit), **sizes).map(self.array)

    def queries(self, limit, **sizes):
        """At small whole numbers, and in the plane in the middle between them."""
        return self.points(2 * limit, **sizes).map(lambda rows: rows / 2)

    def array(self, rows):
        return np.array(rows, dtype=float).reshape(-1, self.width)

    def random(self, rng, n):
        return rng.normal(size=(n, self.width))

    def lattice(self, rng, limit, n):
        """Whole numbers at random, none of them the zero vector."""
        points = rng.integers(-limit, limit + 1, size=(n, self.width)).astype(float)
        return points[points.any(axis=1)]

    def cluster(self, rng, spread, n):
        return np.array([0.3, -0.5, 0.8])[: self.width] + spread * rng.normal(size=(n, self.width))

    def on_grid(self, xy):
        """Points of the plane, or directions that have them as gnomonic images."""
        points = np.asarray(xy, dtype=float)
        return points if self.width == 2 else np.insert(points, 2, 4.0, axis=1)

    def triangulated(self, points, **options):
        """By the public class, and proved."""
        triangulation = self.delaunay(points, **options)
        check_delaunay(triangulation)
        if self.width == 3 and triangulation.dimension == 2:
            assert len(triangulation) == 2 * (len(triangulation.points) - len(triangulation.duplicates)) - 4
            assert (triangulation.neighbors >= 0).all()
        return triangulation

    def place(self, point):
        """Exact numbers that equal points share, and directions of any length."""
        return ray(point)[:3] if self.width == 3 else tuple(map(Fraction, point))

    def names(self, points):
        """One number for each different place, the same in any order of input."""
        places = [self.place(p) for p in np.asarray(points, dtype=float).tolist()]
        number = {place: k for k, place in enumerate(sorted(set(places)))}
        return np.array([number[place] for place in places], dtype=int)

    def distance_key(self, points, query):
        """Sorts numbers of points by exact distance or angle, equally near ones by number."""
        if self.width == 2:
            exact = [Fraction(x) for x in query]
            squares = [sum((Fraction(x) - y) ** 2 for x, y in zip(p, exact, strict=True)) for p in points]
            return lambda k: (squares[k], k)
        q, rays = ray(query), [ray(p) for p in points]
        dots = [dot(q, r) for r in rays]

        def compare(a, b):
            return sign_of_roots(((dots[b], rays[a][3]), (-dots[a], rays[b][3]))) or a - b

        return cmp_to_key(compare)

    def sides(self, a, b, queries):
        """On which sides of edges queries lie."""
        return orient2d(a, b, queries) if self.width == 2 else turn(a, b, queries)

    def lowest_holder(self, points, simplices, query):
        """The lowest triangle that holds a query, boundary included, by asking all; on the sphere, not closing ones."""
        corners = points[simplices]
        queries = np.broadcast_to(np.asarray(query, dtype=float), corners[:, 0].shape)
        holds = np.all([self.sides(corners[:, k - 2], corners[:, k - 1], queries) >= 0 for k in range(3)], axis=0)
        if self.width == 3:
            holds &= turn(*np.moveaxis(corners, 1, 0)) > 0
        return int(np.flatnonzero(holds)[0]) if holds.any() else -1


def turn(a, b, c):
    """On which side of the great circle from direction a to b each c lies."""
    return orient3d(np.zeros_like(a), a, b, c)


PLANE = Space("plane", 2, _kernel.plane, PlanarDelaunay, PlanarVoronoi)
SPHERE = Space("sphere", 3, _kernel.sphere, SphericalDelaunay, SphericalVoronoi)
SPACES = [PLANE, SPHERE]
BOTH = pytest.mark.parametrize("space", SPACES, ids=str)


def space_of(points):
    return PLANE if np.shape(points)[-1] == 2 else SPHERE


def dot(a, b):
    return sum(x * y for x, y in zip(a[:3], b[:3], strict=True))


def canonical(simplices):
    """The same triangles and orientations, (m, 3), smallest index first in each row, rows in lexicographic order."""
    turns = (np.argmin(simplices, axis=1)[:, None] + np.arange(3)) % 3
    turned = np.take_along_axis(np.asarray(simplices, dtype=np.int32), turns, axis=1)
    return np.ascontiguousarray(turned[np.lexsort(turned.T[::-1])])


def rows(simplices, names=None):
    """Triangles by the names of their corners, in an order that depends on nothing else."""
    simplices = np.asarray(simplices) if names is None else np.asarray(names)[simplices]
    return canonical(simplices.reshape(-1, 3)).tolist()


def asked(points):
    """Sites of the readable engine."""
    sites = PlaneSites() if points.shape[1] == 2 else RaySites()
    sites.extend(points)
    return sites


def readable(points):
    """The paper's insertion, run to its end: the reference of the kernel."""
    engine = HullInsertion(np.ascontiguousarray(points, dtype=float))
    engine.run()
    return engine
