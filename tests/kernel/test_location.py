"""The kernel's location and nearest points, against asking every triangle and every point."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import HullInsertion, _kernel
from stereodel import _kernel_probe as probe
from stereodel.predicates import orient2d
from stereodel.predicates.integers import sign_of_roots
from stereodel.predicates.rays import ray
from stereodel.triangulation.topology import neighbors_of

PLANE, SPHERE = 2, 3
BOTH = pytest.mark.parametrize("width", [PLANE, SPHERE])
GRID_POINT = st.tuples(st.integers(-3, 3), st.integers(-3, 3))
HALF_POINT = st.tuples(st.integers(-8, 8), st.integers(-8, 8)).map(lambda p: (p[0] / 2, p[1] / 2))
DIRECTION = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)


@dataclass
class Arrays:
    """A triangulation as the kernel's functions take it."""

    points: np.ndarray
    simplices: np.ndarray
    neighbors: np.ndarray
    closing: np.ndarray | None
    duplicates: np.ndarray

    @classmethod
    def of(cls, points):
        """From the paper's insertion."""
        points = np.array(points, dtype=float)
        hull = HullInsertion(points, spatial=True)
        hull.run()
        return cls.closed(points, hull.simplices, neighbors_of(hull.simplices), hull.duplicates)

    @classmethod
    def large(cls, points):
        triangulate = _kernel.plane.triangulate if points.shape[1] == PLANE else _kernel.sphere.triangulate
        return cls.closed(points, *triangulate(points)[:3])

    @classmethod
    def closed(cls, points, simplices, neighbors, duplicates):
        closing = None
        if points.shape[1] == SPHERE:
            closing = probe.turn(*(points[simplices[:, k]] for k in range(3))) <= 0
        return cls(points, simplices, neighbors, closing, duplicates)

    @property
    def space(self):
        return _kernel.plane if self.points.shape[1] == PLANE else _kernel.sphere

    def find(self, queries, workers=1):
        queries = np.array(queries, dtype=float)
        return self.space.find_simplex(self.points, self.simplices, self.neighbors, queries, self.closing, workers)

    def nearest(self, queries, workers=1):
        queries = np.array(queries, dtype=float)
        if not len(self.simplices):
            return self.nearest_flat(queries, workers)
        return self.space.nearest(self.points, self.simplices, self.neighbors, queries, self.closing, workers)

    def nearest_flat(self, queries, workers):
        order = self.space.flat_order(self.points)
        return self.space.nearest_flat(self.points, order, self.duplicates, queries, 1, workers)[:, 0]

    def sides(self, triangles, queries):
        """Signs (3, k) of the sides of the triangles' edges on which the queries lie, one triangle a query."""
        side = orient2d if self.closing is None else probe.turn
        corners = self.points[self.simplices[triangles]]
        return np.array([side(corners[:, k - 2], corners[:, k - 1], queries) for k in range(3)])

    def lowest_holder(self, query):
        """The lowest triangle that holds a query, by asking all."""
        triangles = np.arange(len(self.simplices))
        queries = np.broadcast_to(np.array(query, dtype=float), (len(triangles), self.points.shape[1]))
        holds = (self.sides(triangles, queries) >= 0).all(axis=0)
        if self.closing is not None:
            holds &= ~self.closing
        return int(np.flatnonzero(holds)[0]) if holds.any() else -1


def squares(points, query):
    return [sum((Fraction(x) - Fraction(y)) ** 2 for x, y in zip(p, query, strict=True)) for p in points]


def lowest_nearest(points, query):
    """The lowest of the nearest points, in exact arithmetic."""
    if len(query) == PLANE:
        distances = squares(points, query)
        return distances.index(min(distances))
    best, q = 0, ray(query)
    rays = [ray(p) for p in points]
    dots = [sum(a * b for a, b in zip(q[:3], r[:3], strict=True)) for r in rays]
    for k in range(1, len(points)):
        if sign_of_roots([(dots[k], rays[best][3]), (-dots[best], rays[k][3])]) > 0:
            best = k
    return best


def prove_find(arrays, queries):
    assert arrays.find(queries).tolist() == [arrays.lowest_holder(q) for q in queries]


def prove_nearest(arrays, queries):
    points, rows = arrays.points.tolist(), np.array(queries, dtype=float).tolist()
    assert arrays.nearest(queries).tolist() == [lowest_nearest(points, q) for q in rows]


def random_points(width, rng, size):
    return rng.random((size, PLANE)) if width == PLANE else rng.normal(size=(size, SPHERE))


@given(st.lists(GRID_POINT, min_size=3, max_size=20), st.lists(HALF_POINT, min_size=1, max_size=25))
def test_in_the_plane_on_edges_and_vertices(points, queries):
    arrays = Arrays.of(points)
    prove_find(arrays, queries)


@given(st.lists(DIRECTION, min_size=3, max_size=20), st.lists(DIRECTION, min_size=1, max_size=25))
def test_on_the_sphere_on_edges_and_vertices(points, queries):
    arrays = Arrays.of(points)
    prove_find(arrays, queries)


@given(st.lists(GRID_POINT, min_size=1, max_size=20), st.lists(HALF_POINT, min_size=1, max_size=25))
def test_nearest_in_the_plane_with_ties(points, queries):
    arrays = Arrays.of(points)
    prove_nearest(arrays, queries)


@given(st.lists(DIRECTION, min_size=1, max_size=20), st.lists(DIRECTION, min_size=1, max_size=25))
def test_nearest_on_the_sphere_with_ties(points, queries):
    arrays = Arrays.of(points)
    prove_nearest(arrays, queries)


@BOTH
def test_every_number_of_queries_takes_the_same_answers(width):
    """Few are compared with landmarks, more pass them along a curve, many need none."""
    rng = np.random.default_rng(0)
    arrays = Arrays.large(random_points(width, rng, 20_000))
    queries = random_points(width, rng, 9000) * 1.1
    found, nearest = arrays.find(queries), arrays.nearest(queries)
    for size in (0, 1, 16, 17, 100, 2000):
        assert np.array_equal(arrays.find(queries[:size]), found[:size])
        assert np.array_equal(arrays.nearest(queries[:size]), nearest[:size])
    for workers in (2, 3, 8):
        assert np.array_equal(arrays.find(queries, workers), found)
        assert np.array_equal(arrays.nearest(queries, workers), nearest)


@BOTH
def test_queries_lie_where_they_are_found(width):
    rng = np.random.default_rng(1)
    arrays = Arrays.large(random_points(width, rng, 3000))
    queries = random_points(width, rng, 3000)
    if width == PLANE:
        queries = 1.2 * queries - 0.1
    found = arrays.find(queries)
    inside = found >= 0
    assert (arrays.sides(found[inside], queries[inside]) >= 0).all()
    if width == PLANE:
        hull = np.argwhere(arrays.neighbors < 0)
        beyond = np.zeros(len(queries), dtype=bool)
        for t, k in hull:
            u, v = arrays.points[arrays.simplices[t, [k - 2, k - 1]]]
            beyond |= orient2d(u, v, queries) < 0
        assert np.array_equal(inside, ~beyond)
    else:
        assert inside.all()


@BOTH
def test_points_are_found_in_their_lowest_triangle(width):
    rng = np.random.default_rng(2)
    points = rng.integers(-9, 10, size=(400, width)).astype(float)
    points = points[points.any(axis=1)]
    arrays = Arrays.large(points)
    open_rows = np.flatnonzero(~arrays.closing) if width == SPHERE else np.arange(len(arrays.simplices))
    lowest = {}
    for t in open_rows[::-1]:
        lowest.update(dict.fromkeys(arrays.simplices[t].tolist(), int(t)))
    used = sorted(lowest)
    assert arrays.find(points[used]).tolist() == [lowest[v] for v in used]
    assert arrays.nearest(points[used]).tolist() == used


@pytest.mark.parametrize("spread", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
def test_clusters_on_the_sphere(spread):
    rng = np.random.default_rng(3)
    center = rng.normal(size=3)
    points = np.vstack([center + spread * rng.normal(size=(60, 3)), rng.normal(size=(3, 3))])
    arrays = Arrays.of(points)
    queries = np.vstack([center + spread * rng.normal(size=(40, 3)), rng.normal(size=(10, 3)), -points[:5]])
    prove_find(arrays, queries)
    prove_nearest(arrays, queries)


@pytest.mark.parametrize("lift", [0.0, 0.3, -0.2])
def test_sets_within_a_hemisphere_or_nearly(lift):
    """Queries around the rim, beyond it and at the antipodes; with lift 0 some points lie on a great circle."""
    rng = np.random.default_rng(4)
    points = rng.integers(-4, 5, size=(50, 3)).astype(float)
    points[:, 2] = np.abs(points[:, 2]) + 10 * lift
    points = points[points.any(axis=1)]
    arrays = Arrays.of(points)
    assert arrays.closing.any() == (lift >= 0)
    rim = np.column_stack([rng.integers(-5, 6, size=(60, 2)), rng.integers(-1, 2, size=60)])
    queries = np.vstack([-points, points, rim[rim.any(axis=1)], rng.normal(size=(30, 3))])
    prove_find(arrays, queries)
    prove_nearest(arrays, queries)


@BOTH
@pytest.mark.parametrize("size", [5e-324, 1e-310, 1e-150, 1e150, 1e307])
def test_coordinates_of_any_size(width, size):
    rng = np.random.default_rng(5)
    points = rng.integers(-9, 10, size=(40, width)) * size
    points = points[points.any(axis=1)]
    arrays = Arrays.of(points)
    queries = np.vstack([points, rng.integers(-11, 12, size=(30, width)) * size])
    queries = queries[queries.any(axis=1)]
    prove_find(arrays, queries)
    prove_nearest(arrays, queries)


def test_the_length_of_a_queried_direction_does_not_matter():
    rng = np.random.default_rng(6)
    arrays = Arrays.of(rng.normal(size=(60, 3)))
    queries = rng.normal(size=(50, 3))
    for factor in (2.0**-900, 0.125, 3.0, 2.0**900):
        assert np.array_equal(arrays.find(queries * factor), arrays.find(queries))
        assert np.array_equal(arrays.nearest(queries * factor), arrays.nearest(queries))


def test_components_of_very_different_size():
    tiny = 1e-300
    points = [[1, tiny, 0], [1, 0, tiny], [1, -tiny, -tiny], [-1, 0, 0]]
    arrays = Arrays.of(points)
    queries = [[1, 0, 0], [1e300, 0.5, 0.1], [1, 0, 5e-324], [1, -tiny / 4, 0], [1e-8, 1e-307, 0], [-1, 0, 0]]
    prove_find(arrays, queries)
    prove_nearest(arrays, queries)


def test_a_query_that_no_power_of_two_brings_near_length_one():
    """Its second component would become subnormal and lose digits: it would then lie on the edge between y = 3 tiny."""
    tiny = 5e-324
    arrays = Arrays.of([[1, 3 * tiny, -1], [1, 3 * tiny, 1], [1, 2, 0], [1, -2, 0]])
    queries = [[2.0**1000, k / 4 * 2.0**-74, 0] for k in range(8, 17)]  # k / 4 tiny of the first component
    found = arrays.find(queries)
    assert found.tolist() == [arrays.lowest_holder(q) for q in queries]
    assert np.count_nonzero(found == found[0]) in (4, 5)


@pytest.mark.parametrize("radius", [0.3, 1e-6])
@pytest.mark.parametrize("of_length_one", [False, True])
def test_nearest_on_a_circle_of_rounded_directions(radius, of_length_one):
    """Their distances from the middle differ by less than those are rounded."""
    rng = np.random.default_rng(12)
    for query in rng.normal(size=(6, 3)):
        axis = query / np.linalg.norm(query)
        across = np.linalg.svd(axis[None])[2][1:]
        angle = rng.random(150) * 2 * np.pi
        points = axis + radius * np.column_stack([np.cos(angle), np.sin(angle)]) @ across
        points /= np.linalg.norm(points, axis=1, keepdims=True)
        around = [q * (1 if of_length_one else 3) for q in (axis, axis + 1e-16, np.nextafter(axis, 2))]
        prove_nearest(Arrays.large(points), around)


def test_unit_vectors_that_are_almost_equally_near():
    """Points mirrored in a plane, and queries on it or an ulp beside it."""
    rng = np.random.default_rng(7)
    points = rng.normal(size=(30, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    mirrored = np.vstack([points, points * [1, 1, -1]])
    arrays = Arrays.of(mirrored)
    queries = rng.normal(size=(60, 3))
    queries[:, 2] = rng.choice([0.0, 1e-17, -1e-17, 1e-300], size=60)
    unit = queries / np.linalg.norm(queries, axis=1, keepdims=True)
    for some in (queries, unit):
        prove_nearest(arrays, some)


@BOTH
def test_the_center_of_many_cocircular_points(width):
    """All are equally near; the walk reaches the lowest along the circle."""
    triples = [(a, b) for a in range(-85, 86) for b in range(-85, 86) if a * a + b * b == 85 * 85]
    circle = np.array(triples, dtype=float)[np.random.default_rng(8).permutation(len(triples))]
    points, center = np.vstack([circle + 200, circle]), [0, 0]
    if width == SPHERE:
        points, center = np.column_stack([np.vstack([circle, circle]), np.repeat([-7, 40], len(circle))]), [0, 0, 1]
    arrays = Arrays.of(points)
    assert len(circle) == 36
    assert arrays.nearest([center]).tolist() == [36]


@BOTH
@pytest.mark.parametrize("ring", [5, 60, 400])
@pytest.mark.parametrize("size", [1.0, 1e-5, 1e-11])
def test_around_a_hub(width, ring, size):
    """A point with many neighbours; queries nearest to it, to the ring, and between."""
    rng = np.random.default_rng(13)
    angle = rng.random(ring) * 2 * np.pi
    circle = size * np.column_stack([np.cos(angle), np.sin(angle)]) * (1 + 0.1 * rng.random((ring, 1)))
    around = size * rng.normal(size=(60, 2))
    if width == PLANE:
        points, queries = np.vstack([circle, [[0, 0]]]), around
    else:
        points = np.vstack([np.column_stack([circle, np.ones(ring)]), [[0, 0, 1]], [[0, 0, -1]]])
        points /= np.linalg.norm(points, axis=1, keepdims=True)
        queries = np.column_stack([around, np.ones(60)])
    arrays = Arrays.large(points)
    prove_find(arrays, queries)
    prove_nearest(arrays, queries)


@BOTH
def test_far_outside(width):
    rng = np.random.default_rng(9)
    points = rng.random((100, width)) + (0 if width == PLANE else 1)
    arrays = Arrays.of(points)
    queries = 1000 * rng.normal(size=(80, width))
    prove_nearest(arrays, queries)


@pytest.mark.parametrize(
    "points",
    [
        [[1, 2]],
        [[1, 2], [1, 2], [0, 0]],
        [[0, 0], [3, 3], [1, 1], [2, 2]],
        [[1, 0, 0]],
        [[2, 0, 0], [1, 0, 0]],
        [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [3, 3, 0]],
    ],
    ids=str,
)
def test_without_triangles(points):
    arrays = Arrays.of(points)
    queries = np.random.default_rng(10).integers(-3, 4, size=(40, len(points[0]))).astype(float)
    queries = queries[queries.any(axis=1)]
    assert (arrays.find(queries) == -1).all()
    prove_nearest(arrays, queries)


def test_wrong_input():
    arrays = Arrays.of(np.random.default_rng(11).random((9, 2)))
    with pytest.raises(ValueError, match="same length"):
        _kernel.plane.find_simplex(arrays.points, arrays.simplices, arrays.neighbors[1:], arrays.points)
    with pytest.raises(ValueError, match="no triangles"):
        _kernel.plane.nearest(arrays.points, arrays.simplices[:0], arrays.neighbors[:0], arrays.points)


def test_wrong_order_of_a_line():
    points, none = np.array([[0.0, 0.0], [1.0, 0.0]]), np.zeros((0, 2), dtype=np.int32)
    for order, message in (([], "must hold a point"), ([0, 2], "out of range"), ([-1, 1], "out of range")):
        with pytest.raises(ValueError, match=message):
            _kernel.plane.nearest_flat(points, np.array(order, dtype=np.int32), none, points, 1)
    with pytest.raises(ValueError, match="every point"):
        _kernel.plane.nearest_flat(points, np.array([1], dtype=np.int32), none, points, 2)
    for k in (0, 3):
        with pytest.raises(ValueError, match="k must be"):
            _kernel.plane.nearest_flat(points, np.array([0, 1], dtype=np.int32), none, points, k)
