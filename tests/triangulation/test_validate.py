"""`check_delaunay` accepts SciPy's hulls, ties of every kind and sets without triangles."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from stereodel.triangulation.validate import (
    InvalidTriangulation,
    check_delaunay,
    first_occurrences,
)
from stereodel.triangulation.validate_mesh import _labels
from tests.triangulation.meshes import (
    CUBE,
    cube_simplices,
    grid,
    hull,
    lifted_grid,
    planar,
    unit_normal,
)


@pytest.fixture(scope="module")
def good():
    points = unit_normal(60)
    return points, hull(points)


@pytest.mark.parametrize("n", [4, 5, 7, 20, 300, 3000])
def test_accepts_hulls_of_scipy(n):
    points = unit_normal(n, seed=n)
    report = check_delaunay(points, hull(points))
    assert (report.surface, report.points, report.simplices, report.edges) == ("sphere", n, 2 * n - 4, 3 * n - 6)


@pytest.mark.parametrize("n", [3, 5, 20, 3000])
def test_accepts_planar_triangulations_of_scipy(n):
    points = np.random.default_rng(n).random((n, 2))
    report = check_delaunay(points, planar(points))
    assert (report.surface, report.points, report.ties) == ("plane", n, 0)


def test_accepts_points_in_a_hemisphere_with_closing_facets():
    points = unit_normal(200) + np.array([0, 0, 1.5])
    points /= np.linalg.norm(points, axis=1)[:, None]
    check_delaunay(points, hull(points))


@pytest.mark.parametrize("scale", [1e-150, 2.0**-30, 1.0, 1e140])
def test_every_diagonal_of_a_grid_is_a_tie(scale):
    points, s = grid(12)
    report = check_delaunay(points * 2.0 ** np.round(np.log2(scale)), s)
    assert report.ties == 11 * 11


def test_lifted_grid_with_its_pole():
    points, s = lifted_grid(8)
    lengths = np.random.default_rng(0).integers(1, 9, len(points))[:, None] * 2.0**-700
    report = check_delaunay(points * lengths, s)
    # one tie in every square, and the star of the pole is one polygon for each side of the grid
    assert report.ties == 7 * 7 + 4 * 6


def test_cube_with_any_diagonals():
    for seed in range(8):
        s = cube_simplices(seed)
        assert check_delaunay(CUBE, s).ties == 6


@pytest.mark.parametrize("axis", [(0, 0, 1), (0, 0, -1), (1, 2, 2)])
def test_small_circle_is_a_two_sided_polygon(axis):
    # 3-4-5 points of the circle at height 1, exactly cocircular as rays, turned to the axis by an exact rotation.
    ring = np.array([[3, 4], [-4, 3], [-3, -4], [4, -3], [5, 0]], dtype=float)
    ring = ring[np.argsort(np.arctan2(ring[:, 1], ring[:, 0]))]
    points = np.column_stack([ring, np.full(5, 1.0)])
    if axis[2] == -1:
        points = points * [1, -1, -1]
    if axis[0] == 1:
        points = points @ np.array([[2, -2, 1], [1, 2, 2], [2, 1, -2]])[[0, 1, 2]].T * [1, 1, 1]
    top = [[0, 1, 2], [0, 2, 3], [0, 3, 4]]
    bottom = [[3, 2, 1], [1, 0, 4], [1, 4, 3]]
    if np.linalg.det(points[[0, 1, 2]]) < 0 and axis[0] == 1:
        points = -points
    report = check_delaunay(points, top + bottom)
    assert report.simplices == 6
    assert report.ties == report.edges == 9
    with pytest.raises(InvalidTriangulation, match="do not meet in one convex polygon"):
        check_delaunay(points[[0, 1, 2, 4, 3]], top + bottom)


def test_three_points_have_two_triangles():
    points = np.eye(3)
    check_delaunay(points, [[0, 1, 2], [0, 2, 1]])
    with pytest.raises(InvalidTriangulation, match="span one"):
        check_delaunay(points, np.zeros((0, 3), int))


def test_equator_and_poles_with_a_great_circle_facet():
    equator = np.array([[3, 4, 0], [-4, 3, 0], [-3, -4, 0], [4, -3, 0]], dtype=float)
    closed = np.vstack([equator, [[0, 0, 1]]])
    roof = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    check_delaunay(closed, [*roof, [2, 1, 0], [0, 3, 2]])
    check_delaunay(closed, [*roof, [3, 2, 1], [1, 0, 3]])
    with pytest.raises(InvalidTriangulation):
        check_delaunay(closed[[0, 2, 1, 3, 4]], [*roof, [2, 1, 0], [0, 3, 2]])


@pytest.mark.parametrize(
    "points",
    [np.zeros((0, 2)), [[1, 2]], [[0, 0], [1, 1], [2, 2], [1, 1]], [[1, 0, 0], [-2, 0, 0], [1, 1, 0], [0, -3, 0]]],
)
def test_flat_sets_have_no_simplices(points):
    assert check_delaunay(points, np.zeros((0, 3), int)).simplices == 0


def test_antipodes_do_not_hide_that_a_set_spans():
    with pytest.raises(InvalidTriangulation, match="points 0, 2 and 3 span one"):
        check_delaunay([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1]], np.zeros((0, 3), int))


def test_great_circle_must_have_no_simplices():
    equator = np.array([[1, 0, 0], [0, 1, 0], [-1, -1, 0]], dtype=float)
    with pytest.raises(InvalidTriangulation, match="great circle"):
        check_delaunay(equator, [[0, 1, 2], [0, 2, 1]])


def test_duplicates_are_derived_and_checked(good):
    points, s = good
    more = np.vstack([points, points[7] * 4.0, points[7]])
    assert check_delaunay(more, s, duplicates=[[60, 7], [61, 7]]).duplicates == 2
    with pytest.raises(InvalidTriangulation, match=r"leaves out \[61, 7\]"):
        check_delaunay(more, s, duplicates=[[60, 7]])
    with pytest.raises(InvalidTriangulation, match=r"lists \[61, 60\]"):
        check_delaunay(more, s, duplicates=[[60, 7], [61, 60]])
    with pytest.raises(InvalidTriangulation, match="point 7 is used by no simplex"):
        check_delaunay(more, np.where(s == 7, 60, s))


@pytest.mark.parametrize(
    ("simplices", "message"),
    [
        ([[0, 1, 3]], "outside 0 to 2"),
        ([[0, 1, -1]], "outside 0 to 2"),
        ([[0, 1, 1]], "a point twice"),
        ([[0.0, 1.0, 2.0]], "must hold integers"),
        ([[0, 1]], "must have shape"),
    ],
)
def test_malformed_simplices(simplices, message):
    with pytest.raises(InvalidTriangulation, match=message):
        check_delaunay([[0, 0], [1, 0], [0, 1]], simplices)


def test_accepts_an_object(good):
    class Triangulation:
        points, simplices = good

    assert check_delaunay(Triangulation()).simplices == 116


@settings(deadline=None, max_examples=40)
@given(st.lists(st.tuples(*[st.integers(-3, 3)] * 3).filter(any), min_size=1, max_size=30), st.data())
def test_first_occurrences_of_directions(vectors, data):
    factors = data.draw(st.lists(st.sampled_from([1.0, 3.0, 0.1, 2.0**-1060]), min_size=30, max_size=30))
    points = np.array([np.array(v) * (f if f != 0.1 else 5.0) for v, f in zip(vectors, factors, strict=False)])
    rays = [tuple(np.array(v) // np.gcd.reduce(v)) for v in vectors]
    assert first_occurrences(points).tolist() == [rays.index(r) for r in rays]


def test_directions_closer_than_an_ulp_are_different():
    points = np.array([[1, 3, 5], [1 + 2.0**-52, 3 + 3 * 2.0**-51, 5], [2, 6, 10]], dtype=float)
    points[1] = [3.0, 9.0 + 2.0**-49, 15.0]
    points = np.vstack([points, [[1e300, 1e-20, 0], [1e300, 2e-20, 0], [-0.0, -1, 0], [0, -1, -0.0]]])
    assert first_occurrences(points).tolist() == [0, 1, 0, 3, 4, 5, 5]
    underflown = [[1e300, 1e-30, 0], [1e300, 2e-30, 0], [1, 0, 0], [2e300, 2e-30, 0]]  # all quotients are (1, 0, 0)
    assert first_occurrences(np.array(underflown)).tolist() == [0, 1, 2, 0]


@given(st.integers(1, 40), st.data())
def test_components_are_those_of_scipy(size, data):
    """Each node has the smallest of its component."""
    edges = data.draw(st.lists(st.tuples(*[st.integers(0, size - 1)] * 2), max_size=2 * size))
    a, b = np.array(edges, dtype=np.int64).reshape(-1, 2).T
    components = connected_components(coo_array((np.ones(len(a)), (a, b)), shape=(size, size)), directed=False)[1]
    smallest = [int(np.flatnonzero(components == component)[0]) for component in components]
    assert _labels(size, a, b).tolist() == smallest


def test_components_of_long_chains_take_few_rounds():
    """A path through nodes in any order; as many rounds as nodes would take minutes."""
    order = np.random.default_rng(1).permutation(200_000)
    assert not _labels(len(order), order[:-1], order[1:]).any()
    assert not _labels(len(order), np.arange(len(order) - 1), np.arange(1, len(order))).any()
