"""find_simplex and nearest, by the kernel and by the classes, against asking every triangle and every point."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from stereodel import PlanarDelaunay, SphericalDelaunay
from stereodel.triangulation.topology import neighbors_of
from tests import sets
from tests.spaces import BOTH, PLANE, SPHERE, readable, space_of, turn

FINITE = st.floats(allow_nan=False, allow_infinity=False)


def kernel_arrays(points):
    """What the readable engine found, as the kernel's functions take it: points, simplices, neighbors; and closing."""
    simplices = readable(points).simplices
    closing = None
    if points.shape[1] == 3:
        closing = turn(*np.moveaxis(points[simplices], 1, 0)) <= 0
    return (points, simplices, neighbors_of(simplices)), closing


def prove_find(points, queries):
    space = space_of(points)
    points, queries = space.array(points), space.array(queries)
    triangulation = space.triangulated(points)
    wanted = [space.lowest_holder(points, triangulation.simplices, q) for q in queries]
    assert triangulation.find_simplex(queries).tolist() == wanted
    arrays, closing = kernel_arrays(points)
    if len(arrays[1]):
        wanted = [space.lowest_holder(*arrays[:2], q) for q in queries]
        assert space.kernel.find_simplex(*arrays, queries, closing).tolist() == wanted


def prove_nearest(triangulation, queries):
    """For all k: the first k of all points in order, whatever the number of threads; and alone, by the kernel."""
    space = space_of(triangulation.points)
    points, size = triangulation.points.tolist(), len(triangulation.points)
    queries = space.array(queries)
    wanted = [sorted(range(size), key=space.distance_key(points, query)) for query in queries.tolist()]
    assert triangulation.nearest(queries, k=size, workers=2).tolist() == wanted
    for k in {1, 2, size // 2} & set(range(1, size)):
        assert triangulation.nearest(queries, k=k).tolist() == [row[:k] for row in wanted]
    assert triangulation.nearest(queries).tolist() == [row[0] for row in wanted]
    arrays, closing = kernel_arrays(triangulation.points)
    if len(arrays[1]):
        assert space.kernel.nearest(*arrays, queries, closing).tolist() == [row[0] for row in wanted]


def prove_first(points, queries):
    """The nearest alone: for sets that are too large to sort by exact numbers."""
    space, listed = space_of(points), np.asarray(points).tolist()
    queries = space.array(queries)
    wanted = [min(range(len(points)), key=space.distance_key(listed, query)) for query in queries.tolist()]
    assert space.triangulated(points).nearest(queries).tolist() == wanted


def prove(points, queries):
    points = space_of(points).array(points)
    prove_find(points, queries)
    prove_first(points, queries)


@BOTH
@given(data=st.data())
def test_triangles_on_edges_and_vertices(space, data):
    prove_find(
        data.draw(space.points(3, min_size=3, max_size=20)), data.draw(space.queries(4, min_size=1, max_size=25))
    )


@BOTH
@given(data=st.data())
def test_nearest_with_ties_and_duplicates(space, data):
    points = data.draw(space.points(3, min_size=1, max_size=20))
    prove_nearest(space.triangulated(points), data.draw(space.queries(4, min_size=1, max_size=8)))


@pytest.mark.parametrize("one", [case for case in sets.of("few") if case.id not in ("plane none", "sphere none")])
def test_awkward_sets(one):
    points = one.points
    if one.space == "plane":
        queries = [*points, [0.5, 0.5], [1e-3, -1e5], [1.5, 1.5]]
    else:
        queries = [*points, *-points, [0, 0, 1], [1, 2, 3], [1e-12, 0, 1], [-1, 1e-3, 0], [1e200, 1e200, 0]]
    prove_find(points, queries)
    prove_nearest(space_of(points).delaunay(points), queries)


@BOTH
@pytest.mark.parametrize("spread", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
def test_clusters(rng, space, spread):
    points = np.vstack([space.cluster(rng, spread, 60), space.random(rng, 3)])
    prove(points, np.vstack([space.cluster(rng, spread, 40), space.random(rng, 10), -points[:5]]))


@pytest.mark.parametrize("lift", [0.0, 0.3, -0.2])
def test_sets_within_a_hemisphere_or_nearly(rng, lift):
    """Queries around the rim, beyond it and at the antipodes; with lift 0 some points lie on a great circle."""
    points = rng.integers(-4, 5, size=(50, 3)).astype(float)
    points[:, 2] = np.abs(points[:, 2]) + 10 * lift
    points = points[points.any(axis=1)]
    assert SphericalDelaunay(points).closing.any() == (lift >= 0)
    rim = np.column_stack([rng.integers(-5, 6, size=(60, 2)), rng.integers(-1, 2, size=60)])
    prove(points, np.vstack([-points, points, rim[rim.any(axis=1)], rng.normal(size=(30, 3))]))


@BOTH
@pytest.mark.parametrize("size", [5e-324, 1e-310, 1e-150, 1e150, 1e307])
def test_coordinates_of_any_size(rng, space, size):
    points = space.lattice(rng, 9, 40) * size
    prove(points, np.vstack([points, space.lattice(rng, 11, 30) * size]))


def test_a_query_that_no_power_of_two_brings_near_length_one():
    """Its second component would become subnormal and lose digits: it would then lie on the edge between y = 3 tiny."""
    tiny = 5e-324
    points = [[1, 3 * tiny, -1], [1, 3 * tiny, 1], [1, 2, 0], [1, -2, 0]]
    queries = [[2.0**1000, k / 4 * 2.0**-74, 0] for k in range(8, 17)]  # k / 4 tiny of the first component
    prove_find(points, queries)
    found = SphericalDelaunay(points).find_simplex(queries)
    assert np.count_nonzero(found == found[0]) in (4, 5)


@pytest.mark.parametrize("length", range(3, 20))
def test_nearest_below_the_error_of_the_unit_vectors(length):
    """Directions 1e-40 rad apart: the unit vectors themselves are off by 1e-32 or so."""
    points = [[1, 1, 1e-40], [length, length, length * 2e-40]]
    queries = [[7, 7, 7 * 1.9e-40], [5, 5, 5 * 1.1e-40], [11, 11, 0]]
    assert SphericalDelaunay(points).nearest(queries).tolist() == [1, 0, 0]


@pytest.mark.parametrize("radius", [3.0, 0.3, 1e-6])
@pytest.mark.parametrize("of_length_one", [False, True])
@BOTH
def test_nearest_on_a_circle_of_rounded_points(rng, space, radius, of_length_one):
    """Their distances from the middle differ by less than those are rounded."""
    for query in rng.normal(size=(4, space.width)):
        angle = rng.random(150) * 2 * np.pi
        circle = radius * np.column_stack([np.cos(angle), np.sin(angle)])
        if space is PLANE:
            prove_first(query + circle, [query])
            continue
        axis = sets.unit(query)
        points = sets.unit(axis + circle @ np.linalg.svd(axis[None])[2][1:])
        prove_first(points, [q * (1 if of_length_one else 3) for q in (axis, axis + 1e-16, np.nextafter(axis, 2))])


def test_unit_vectors_that_are_almost_equally_near(rng):
    """Points mirrored in a plane, and queries on it or an ulp beside it."""
    points = sets.directions(rng, 30)
    queries = rng.normal(size=(60, 3))
    queries[:, 2] = rng.choice([0.0, 1e-17, -1e-17, 1e-300], size=60)
    prove_first(np.vstack([points, points * [1, 1, -1]]), np.vstack([queries, sets.unit(queries)]))


@BOTH
def test_the_center_of_many_cocircular_points(space):
    """All are equally near; the walk reaches the lowest along the circle."""
    pairs = [(a, b) for a in range(-85, 86) for b in range(-85, 86) if a * a + b * b == 85 * 85]
    circle = np.array(pairs, dtype=float)[np.random.default_rng(8).permutation(len(pairs))]
    points, center = np.vstack([circle + 200, circle]), [0, 0]
    if space is SPHERE:
        points, center = np.column_stack([np.vstack([circle, circle]), np.repeat([-7, 40], len(circle))]), [0, 0, 1]
    assert len(circle) == 36
    assert space.triangulated(points).nearest(center) == 36


@BOTH
@pytest.mark.parametrize("ring", [5, pytest.param(60, marks=pytest.mark.thorough), 400])
@pytest.mark.parametrize("size", [1.0, 1e-5, 1e-11])
def test_around_a_hub(rng, space, ring, size):
    """A point with many neighbours; queries nearest to it, to the ring, and between."""
    angle = rng.random(ring) * 2 * np.pi
    circle = size * np.column_stack([np.cos(angle), np.sin(angle)]) * (1 + 0.1 * rng.random((ring, 1)))
    queries = size * rng.normal(size=(60, 2))
    points = np.vstack([circle, [[0, 0]]])
    if space is SPHERE:
        points = sets.unit(np.vstack([np.insert(points, 2, 1.0, axis=1), [[0, 0, -1]]]))
        queries = np.insert(queries, 2, 1.0, axis=1)
    triangulation = space.triangulated(points)
    wanted = [space.lowest_holder(points, triangulation.simplices, q) for q in queries]
    assert triangulation.find_simplex(queries).tolist() == wanted
    prove_first(points, queries[:: 1 + ring // 100])


@given(st.lists(st.tuples(FINITE, FINITE), min_size=1, max_size=5), st.tuples(FINITE, FINITE))
def test_nearest_of_any_doubles(points, query):
    prove_first(PLANE.array(points), [query])


def test_nearest_where_squares_underflow():
    """As doubles the squared distances are 0 + 0 and 5e-324."""
    assert PlanarDelaunay(np.array([[1.5, 1.5], [1.6, 0.0]]) * 1e-162).nearest([0, 0]) == 1


@BOTH
def test_many_against_a_tree(rng, space):
    points, queries = rng.normal(size=(2, 5000, space.width))
    if space is SPHERE:
        points, queries = sets.unit(points), sets.unit(queries)
    triangulation = space.triangulated(points)
    found = triangulation.nearest(queries, k=40)
    assert np.array_equal(found, cKDTree(points).query(queries, k=40)[1])
    assert np.array_equal(triangulation.nearest(queries), found[:, 0])
    in_shape = triangulation.nearest(queries.reshape(50, 2, 50, space.width), k=7)
    assert np.array_equal(in_shape.reshape(-1, 7), found[:, :7])


SMALL = st.integers(-4, 4)
STEP = st.tuples(SMALL, SMALL).filter(any)
SCALE = st.sampled_from([1.0, 2.0**-30, 2.0**-990, 5e-324, 2.0**500])  # nothing is rounded


@given(st.lists(SMALL, min_size=1, max_size=12), STEP, SCALE, PLANE.queries(4, min_size=1, max_size=6))
def test_points_of_one_line(places, step, scale, queries):
    """Any of them may be equal. Queries at the points and between them are exactly as near to two."""
    points = np.multiply.outer(places, step) * scale
    flat = PLANE.triangulated(points)
    assert flat.dimension == min(len(set(places)), 2) - 1
    prove_nearest(flat, np.vstack([points, points / 2, queries * scale]))


@given(st.lists(STEP, min_size=1, max_size=12), SPHERE.places(3), SPHERE.places(3), SCALE, SPHERE.points(3, max_size=5))
def test_directions_of_one_great_circle(places, u, v, scale, queries):
    """Also opposite ones, equal ones of different length, within half a circle; ends of the axis are as near to all."""
    axis = np.cross(u, v)
    plane = np.array([u, v])[: 2 if axis.any() else 1]
    points = np.array(places)[:, : len(plane)] @ plane
    points = points[points.any(axis=1)]
    if len(points):
        circle = SPHERE.triangulated(points * scale)
        assert circle.dimension < 2
        asked = np.vstack([points, -points, points + points[0], axis, -axis, 1000 * axis + points[0], *queries])
        prove_nearest(circle, asked[asked.any(axis=1)] * scale)


@given(st.integers(1, 40), st.integers(0, 2**32 - 1), st.booleans())
def test_rounded_directions_of_one_great_circle(size, seed, is_short):
    """Doubles of length one around the equator or a small part of it: distances differ by roundings."""
    rng = np.random.default_rng(seed)
    angle = rng.random(size) * (1e-9 if is_short else 2 * np.pi)
    points = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(size)])
    near_axis = rng.normal(size=(3, 3)) * [1e-12, 1e-12, 1]
    queries = np.vstack([points[:3], rng.normal(size=(2, 3)), near_axis, [[0, 0, 1]]])
    prove_nearest(SPHERE.triangulated(points), queries)


@BOTH
def test_many_equal_points_take_no_time(rng, space):
    """Comparing all of them would take minutes: at one place, at two each of a line, at four."""
    equal = space.delaunay(np.ones((100_000, space.width)))
    assert (equal.nearest(rng.normal(size=(20_000, space.width)), k=8) == np.arange(8)).all()
    places = np.arange(100_000) % 50_000
    flat = space.delaunay(np.column_stack([places, np.ones(100_000), np.zeros(100_000)])[:, : space.width])
    assert flat.dimension == 1
    asked = rng.integers(0, 50_000, 20_000)
    assert np.array_equal(flat.nearest(flat.points[asked], k=2), np.column_stack([asked, asked + 50_000]))
    if space is SPHERE:
        assert not flat.nearest(np.tile([0, 0, 1], (20_000, 1))).any()
    corners = np.array([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])[:, : space.width]
    chosen = rng.integers(0, 4, 100_000)
    triangulation = space.delaunay(corners[chosen])
    queries = corners * [1.1, 1, 1][: space.width]
    expected = [np.flatnonzero(chosen == place)[:8] for place in range(4)]
    assert np.array_equal(triangulation.nearest(np.repeat(queries, 500, axis=0), k=8), np.repeat(expected, 500, axis=0))
    assert (triangulation.nearest(np.tile([[0, 0, 1]], (500, 1))[:, : space.width], k=8) == np.arange(8)).all()
    rest = np.flatnonzero(chosen == 0)[:3000]
    assert triangulation.nearest(queries[0], k=3008)[:3000].tolist() == rest.tolist()


def test_after_changes(rng):
    """Of a triangulation, and of a line, whose order is that of the points that are there."""
    triangulation = PlanarDelaunay(rng.integers(0, 12, size=(60, 2)))
    triangulation.insert(rng.integers(0, 12, size=(3, 2)))
    triangulation.remove([5, 17, 30])
    prove_nearest(triangulation, rng.integers(0, 24, size=(10, 2)) / 2)
    line, queries = PlanarDelaunay([[0, 0], [4, 4], [2, 2], [2, 2]]), [[3, 3], [0, 1], [7, 7]]
    for change, dimension in (
        (lambda: line.nearest(queries, k=4), 1),
        (lambda: line.insert([[3, 3], [9, 9]]), 1),
        (lambda: line.remove([2, 4]), 1),
        (lambda: line.insert([[0, 9]]), 2),
        (lambda: line.remove([len(line.points) - 1]), 1),
    ):
        change()
        assert line.dimension == dimension
        prove_nearest(line, queries)


@BOTH
def test_numbers_of_one_query_are_integers_of_python(space):
    triangulation = space.delaunay(space.random(np.random.default_rng(0), 9))
    for method in (triangulation.find_simplex, triangulation.nearest):
        assert method(np.ones((4, space.width))).dtype == np.int32
        assert type(method(np.ones(space.width))) is int
    assert triangulation.nearest(np.ones(space.width), k=np.int64(2)).shape == (2,)


@BOTH
def test_without_points(space):
    none, query = space.delaunay([]), np.ones((1, space.width))
    assert none.find_simplex(query).tolist() == [-1]
