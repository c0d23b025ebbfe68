"""Voronoi diagrams of the plane: against SciPy, by their defining property, and in degenerate cases."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Voronoi, cKDTree

from stereodel import _kernel
from stereodel.triangulation.planar_delaunay import PlanarDelaunay
from stereodel.triangulation.planar_voronoi import PlanarVoronoi

GRID = np.array([[x, y] for x in range(5) for y in range(4)], dtype=float)
SMALL_SETS = st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4)), min_size=1, max_size=14)


def random_points(n, seed=0):
    return np.random.default_rng(seed).random((n, 2))


def rows(simplices):
    return {tuple(np.roll(s, -int(np.argmin(s)))) for s in simplices.tolist()}


def cells_by_coordinates(diagram):
    """Each region as a cycle of vertex coordinates that begins with the least one, infinity first."""
    vertices = [tuple(v) for v in diagram.vertices.tolist()]
    cells = []
    for region in diagram.regions:
        cell = [(-np.inf, -np.inf) if v < 0 else vertices[v] for v in region]
        start = cell.index(min(cell)) if cell else 0
        cells.append(tuple(cell[start:] + cell[:start]))
    return cells


def test_against_scipy():
    points = random_points(300)
    ours, theirs = PlanarVoronoi(points), Voronoi(points)
    assert [list(p) for p in sorted(map(tuple, np.sort(theirs.ridge_points).tolist()))] == ours.ridge_points.tolist()
    distance, match = cKDTree(theirs.vertices).query(ours.vertices)
    assert distance.max() < 1e-9
    assert len(np.unique(match)) == len(theirs.vertices)
    for i, region in enumerate(ours.regions):
        named = sorted(-1 if v < 0 else int(match[v]) for v in region)
        assert named == sorted(theirs.regions[theirs.point_region[i]])


def test_regions_are_counterclockwise_and_convex():
    diagram = PlanarVoronoi(random_points(200, seed=3))
    assert (diagram.areas() > 0).all()
    for region in diagram.regions:
        corners = diagram.vertices[[v for v in region if v >= 0]]
        steps = np.roll(corners, -1, axis=0) - corners if region[0] >= 0 else np.diff(corners, axis=0)
        turns = steps[:-1, 0] * steps[1:, 1] - steps[:-1, 1] * steps[1:, 0]
        assert (turns > 0).all()
        assert region.count(-1) <= 1


def test_a_grid_has_one_vertex_in_each_square():
    diagram = PlanarVoronoi(GRID)
    assert len(diagram.vertices) == 4 * 3
    ridges = diagram.vertices[diagram.ridge_vertices[(diagram.ridge_vertices >= 0).all(axis=1)]]
    assert (np.linalg.norm(ridges[:, 0] - ridges[:, 1], axis=1) == 1).all()
    inner = (GRID > 0).all(axis=1) & (GRID < [4, 3]).all(axis=1)
    assert diagram.areas()[inner].tolist() == [1.0] * 6
    assert np.isinf(diagram.areas()[~inner]).all()
    assert diagram.areas(radius=3)[inner].tolist() == [9.0] * 6


def test_areas_far_from_the_origin():
    inner = (GRID > 0).all(axis=1) & (GRID < [4, 3]).all(axis=1)
    assert PlanarVoronoi(GRID + 2.0**40).areas()[inner].tolist() == [1.0] * 6


def test_vertices_are_numbered_by_their_three_lowest_sites():
    triangulation = PlanarDelaunay(random_points(60, seed=5))
    order = np.lexsort(np.sort(triangulation.simplices, axis=1).T[::-1])
    assert PlanarVoronoi(triangulation).simplex_vertex[order].tolist() == list(range(len(order)))


def test_simplex_vertex_is_the_circumcentre():
    triangulation = PlanarDelaunay(np.vstack([GRID, random_points(50, seed=1) * 4]))
    diagram = PlanarVoronoi(triangulation)
    corners = triangulation.points[triangulation.simplices]
    centre = diagram.vertices[diagram.simplex_vertex][:, None]
    distance = np.linalg.norm(corners - centre, axis=2)
    assert np.ptp(distance, axis=1) == pytest.approx(0, abs=1e-11)


@pytest.mark.parametrize("points", [random_points(120, seed=7), GRID, GRID[::4] * [1, 0], GRID[[0, 5]]])
def test_segments_are_the_places_with_two_nearest_sites(points):
    diagram = PlanarVoronoi(points)
    bounds = np.array([-0.3, -0.1, 1.2, 0.8]) * points.max()
    segments, ridge = diagram.segments(bounds)
    assert (segments >= bounds[:2] - 1e-12).all()
    assert (segments <= bounds[2:] + 1e-12).all()
    t = np.random.default_rng(0).random((len(segments), 1))
    places = segments[:, 0] * (1 - t) + segments[:, 1] * t
    distance, sites = cKDTree(points).query(places, k=2)
    assert distance[:, 0] == pytest.approx(distance[:, 1], abs=1e-12)
    assert np.sort(sites, axis=1).tolist() == diagram.ridge_points[ridge].tolist()
    # Site i on the left of start → end, seen from the middle of the two sites.
    i, j = diagram.ridge_points[ridge].T
    along, across = segments[:, 1] - segments[:, 0], points[i] - points[j]
    assert (along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0] > 0).all()


def test_ridges_inside_the_rectangle_end_in_vertices_exactly():
    diagram = PlanarVoronoi(random_points(100))
    segments, ridge = diagram.segments((-1, -1, 2, 2))
    bounded = (diagram.ridge_vertices[ridge] >= 0).all(axis=1)
    ends = diagram.vertices[diagram.ridge_vertices[ridge[bounded]]]
    inside = ((ends > -1) & (ends < 2)).all(axis=(1, 2))
    assert inside.sum() > 200
    assert (segments[bounded][inside] == ends[inside]).all()


def test_every_visible_ridge_is_there():
    points = random_points(120, seed=8)
    diagram = PlanarVoronoi(points)
    segments, _ = diagram.segments((0.2, 0.3, 0.7, 0.6))
    x, y = np.meshgrid(np.linspace(0.2, 0.7, 400), np.linspace(0.3, 0.6, 400), indexing="ij")
    owner = cKDTree(points).query(np.column_stack([x.ravel(), y.ravel()]))[1].reshape(400, 400)
    changes = {tuple(sorted(p)) for p in zip(owner[1:].ravel(), owner[:-1].ravel(), strict=True) if p[0] != p[1]}
    assert changes <= {tuple(p) for p in diagram.ridge_points[diagram.segments((0.2, 0.3, 0.7, 0.6))[1]].tolist()}
    assert len(segments) >= len(changes)


@pytest.mark.parametrize("bounds", [(0, 1, 2), (1, 0, 0, 1), (0, 1, 1, 1)])
def test_segments_refuse_an_empty_rectangle(bounds):
    with pytest.raises(ValueError, match=r"bounds .*\(xmin, ymin, xmax, ymax\)"):
        PlanarVoronoi(GRID).segments(bounds)


def test_a_very_far_vertex_does_not_disturb_the_picture():
    points = np.array([[0, 0], [1, 2.0**-50], [2, 0], [1, 3]])
    segments, ridge = PlanarVoronoi(points).segments((-1, -1, 3, 2))
    places = dict(zip(map(tuple, PlanarVoronoi(points).ridge_points[ridge].tolist()), segments.tolist(), strict=True))
    assert places[0, 1] == [pytest.approx([0.5, -1.0]), pytest.approx([0.5, 1.5], abs=1e-12)]


@pytest.mark.parametrize("points", [np.zeros((0, 2)), [[3, 4]], [[0, 0], [2, 1]], [[2, 2], [0, 0], [1, 1], [2, 2]]])
def test_points_on_one_line_have_strips(points):
    diagram = PlanarVoronoi(points)
    n = len(points)
    different = len(np.unique(np.asarray(points), axis=0))
    assert diagram.vertices.shape == (0, 2)
    assert diagram.regions == [[-1]] * different + [[]] * (n - different)
    assert diagram.ridge_vertices.tolist() == [[-1, -1]] * max(different - 1, 0)
    assert diagram.areas().tolist() == [np.inf] * different + [0.0] * (n - different)
    assert diagram.delaunay().simplices.shape == (0, 3)
    assert diagram.simplex_vertex.shape == (0,)


def test_strips_join_neighbours_along_the_line():
    diagram = PlanarVoronoi([[5, 5], [1, 1], [3, 3], [-2, -2]])
    assert diagram.ridge_points.tolist() == [[0, 2], [1, 2], [1, 3]]
    assert PlanarVoronoi([[4, 5], [4, 1], [4, 3]]).ridge_points.tolist() == [[0, 2], [1, 2]]


def test_duplicates_have_empty_regions():
    diagram = PlanarVoronoi(np.vstack([GRID[:6], GRID[:2]]))
    assert diagram.regions[6:] == [[], []]
    assert diagram.point_region.tolist() == [0, 1, 2, 3, 4, 5, 0, 1]
    assert diagram.areas()[6:].tolist() == [0, 0]
    assert diagram.region_offsets.tolist()[-3:] == [len(diagram.region_indices)] * 3


def test_arrays_cannot_be_changed_and_input_is_not():
    points = GRID.copy()
    diagram = PlanarVoronoi(points)
    points[0] = 9
    with pytest.raises(ValueError, match="read-only"):
        diagram.vertices[0] = 1


@settings(deadline=None, max_examples=60)
@given(SMALL_SETS, st.randoms(use_true_random=False))
def test_permutation_and_tie_rule_do_not_matter(points, random):
    points = list(dict.fromkeys(points))
    order = list(range(len(points)))
    random.shuffle(order)
    first, second = PlanarVoronoi(points), PlanarVoronoi([points[k] for k in order])
    mirrored = PlanarVoronoi([(-x, y) for x, y in points])  # other diagonals, since the order of points is reversed
    assert [cells_by_coordinates(first)[k] for k in order] == cells_by_coordinates(second)
    assert {(-x, y) for x, y in mirrored.vertices.tolist()} == {tuple(v) for v in first.vertices.tolist()}
    assert mirrored.ridge_points.tolist() == first.ridge_points.tolist()


@settings(deadline=None, max_examples=100)
@given(SMALL_SETS)
def test_round_trip_with_ties(points):
    direct = PlanarDelaunay(points)
    again = PlanarVoronoi(direct).delaunay()
    assert rows(again.simplices) == rows(direct.simplices)
    assert again.duplicates.tolist() == direct.duplicates.tolist()


def test_round_trip_of_a_large_polygon():
    # Integer points of the circle of radius 5·13: 36 sites around one vertex.
    points = [(x, y) for x in range(-65, 66) for y in range(-65, 66) if x * x + y * y == 65 * 65]
    direct = PlanarDelaunay(points)
    diagram = PlanarVoronoi(direct)
    assert diagram.vertices.tolist() == [[0, 0]]
    assert rows(diagram.delaunay().simplices) == rows(direct.simplices)


ONE = np.arange(3, dtype=np.int32)[None]


def center_of(triangle):
    return _kernel.plane.circumcenters(triangle, ONE)[0]


def exact_circumcenter(triangle):
    """Rounded once."""
    a, b, c = [[Fraction(x) for x in p] for p in triangle.tolist()]
    d, e = [b[k] - a[k] for k in (0, 1)], [c[k] - a[k] for k in (0, 1)]
    dd, ee, area = d[0] ** 2 + d[1] ** 2, e[0] ** 2 + e[1] ** 2, 2 * (d[0] * e[1] - d[1] * e[0])
    return [float(a[0] + (e[1] * dd - d[1] * ee) / area), float(a[1] + (d[0] * ee - e[0] * dd) / area)]


@pytest.mark.parametrize("shape", [1.0, 1e-3, 1e-9, 1e-14, 0.0])
@pytest.mark.parametrize("exponent", [-900, -30, 0, 400])
def test_circumcentres_of_any_shape(shape, exponent):
    rng = np.random.default_rng(0)
    for _ in range(10):
        triangle = np.column_stack([rng.random(3), rng.random() + shape * rng.random(3)])
        triangle[2, 1] += 2.0**-40
        triangle = np.ldexp(triangle, exponent)
        exact = exact_circumcenter(triangle)
        assert center_of(triangle) == pytest.approx(exact, rel=2.0**-52, abs=0)


def test_circumcentre_where_double_double_cancels():
    triangle = np.array([[1e-20, 3e-20], [1 / 3, 1 / 3], [2 / 3, 2 / 3]])
    assert center_of(triangle).tolist() == exact_circumcenter(triangle)


def test_a_circumcentre_near_zero_is_rounded_once():
    angle = np.random.default_rng(1).random((20, 3)) * 2 * np.pi
    for triangle in np.stack([np.cos(angle) + 1e-6, np.sin(angle) - 2e-6], axis=-1):
        exact = exact_circumcenter(triangle)
        assert center_of(triangle) == pytest.approx(exact, rel=2.0**-52, abs=0)


def test_a_cell_with_a_vertex_at_infinity_has_no_finite_area():
    diagram = PlanarVoronoi([[-1e200, -1e200], [0, 5e-324], [1e200, 1e200], [-1e200, 1e200]])
    assert -1 not in diagram.regions[1]
    assert diagram.areas().tolist() == [np.inf] * 4


def test_a_circumcentre_beyond_the_range_of_doubles_is_infinite():
    triangle = np.array([[[0, 0], [1e200, 5e-324], [2e200, 0]]])
    assert center_of(triangle[0]).tolist() == [1e200, -np.inf]
