"""Voronoi diagrams of the sphere: against SciPy, by their defining property, and in degenerate cases."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import spatial

from stereodel import _kernel
from stereodel.sphere import lonlat_to_xyz
from stereodel.triangulation.planar_voronoi import PlanarVoronoi
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay
from stereodel.triangulation.spherical_voronoi import SphericalVoronoi

GOLDEN = (1 + np.sqrt(5)) / 2
OCTAHEDRON = np.vstack([np.eye(3), -np.eye(3)])
CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
DODECAHEDRON = np.vstack(
    [CUBE] + [np.roll([[0, a / GOLDEN, b * GOLDEN] for a in (1, -1) for b in (1, -1)], k, axis=1) for k in range(3)]
)
GRATICULE = lonlat_to_xyz(
    [[lon, lat] for lon in range(-180, 180, 30) for lat in range(-60, 61, 30)] + [[0, 90], [0, -90]]
)
# Pythagorean points of the equator and of two smaller circles: a half-space with its rim in a plane through the centre.
BOWL = np.array([[3, 4, 0], [-4, 3, 0], [-3, -4, 0], [4, -3, 0], [5, 0, 0], [2, 1, 2], [-1, 2, 2], [1, -2, 2]], float)
CIRCLES = {
    "great": np.array([[3, 4, 0], [-4, 3, 0], [-3, -4, 0], [4, -3, 0], [12, 5, 0]], dtype=float),
    "tilted great": np.array([[1, -1, 0], [0, 3, -3], [-2, 0, 2], [5, -4, -1]], dtype=float),
    "small": np.array([[3, 4, 1], [-4, 3, 1], [-3, -4, 1], [4, -3, 1], [5, 0, 1]], dtype=float),
    "tilted small": np.array([[3, 4, 1], [-4, 3, 1], [-3, -4, 1], [4, -3, 1]])
    @ [[2, 1, 2], [-2, 2, 1], [1, 2, -2]]
    / 1.0,
    "meridian": np.array([[0, 3, 4], [0, -3, -4], [0, 4, -3], [0, -4, 3], [0, 5, 0]], dtype=float),
    "half": np.array([[3, 4, 0], [4, 3, 0], [12, 5, 0]], dtype=float),
    "nearly antipodal": np.array([[1, 0, 0], [-1, 1e-9, 0], [0, 1, 0]]),
}
SETS = {
    "random": np.random.default_rng(0).normal(size=(150, 3)),
    "cap": np.random.default_rng(1).normal(size=(60, 3)) * 0.1 + [0, 0, 1],
    "octahedron": OCTAHEDRON,
    "cube": CUBE,
    "dodecahedron": DODECAHEDRON,
    "graticule": GRATICULE,
    **{f"bowl {k} {sign}": np.roll(BOWL * [1, 1, sign], k, axis=1) for k in range(3) for sign in (1, -1)},
    "tilted bowl": BOWL @ [[2, 1, 2], [-2, 2, 1], [1, 2, -2]],
    "three": np.eye(3),
    "pair": np.array([[1, 2, 2], [0, -1, 0.5]]),
    "antipodes": np.array([[1, 2, 2], [-2, -4, -4]], dtype=float),
    **CIRCLES,
}
ONE = np.arange(3, dtype=np.int32)[None]
VECTORS = st.tuples(*[st.integers(-2, 2)] * 3).filter(any)


def units(points):
    return points / np.linalg.norm(points, axis=-1, keepdims=True)


def rows(simplices):
    return {tuple(np.roll(s, -int(np.argmin(s)))) for s in simplices.tolist()}


@pytest.mark.parametrize("name", ["random", "octahedron", "cube"])
def test_against_scipy(name):
    points = units(SETS[name])
    ours, theirs = SphericalVoronoi(points), spatial.SphericalVoronoi(points)
    theirs.sort_vertices_of_regions()
    distance, match = spatial.cKDTree(theirs.vertices).query(ours.vertices)
    assert distance.max() < 1e-12
    if name == "random":
        assert {frozenset(match[r].tolist()) for r in ours.regions} == {frozenset(r) for r in theirs.regions}
    assert ours.areas() == pytest.approx(theirs.calculate_areas(), abs=1e-12)


@pytest.mark.parametrize(("points", "vertices", "degree"), [(OCTAHEDRON, 8, 4), (CUBE, 6, 3)])
def test_exactly_cocircular_facets_share_a_vertex(points, vertices, degree):
    diagram = SphericalVoronoi(points * np.arange(1, len(points) + 1)[:, None])
    assert len(diagram.vertices) == vertices
    assert [len(r) for r in diagram.regions] == [degree] * len(points)
    assert len(diagram.ridge_points) == 12
    assert diagram.areas() == pytest.approx(4 * np.pi / len(points), rel=1e-15)


@pytest.mark.parametrize("name", SETS)
def test_areas_sum_to_the_sphere(name):
    diagram = SphericalVoronoi(SETS[name])
    assert diagram.areas().sum() == pytest.approx(4 * np.pi, rel=1e-14)
    assert (diagram.areas() > 0).all()
    assert diagram.areas(radius=6371.0).sum() == pytest.approx(4 * np.pi * 6371**2, rel=1e-14)


@pytest.mark.parametrize("name", SETS)
def test_ridges_are_the_places_with_two_nearest_sites(name):
    points = SETS[name]
    diagram = SphericalVoronoi(points)
    tree = spatial.cKDTree(units(points))
    for (i, j), arc in zip(diagram.ridge_points.tolist(), diagram.ridge_arcs(), strict=True):
        places = arc.sample(5)[1:4]
        distance = tree.query(places)[0]
        own = np.linalg.norm(places[:, None] - units(points)[[i, j]], axis=2)
        assert own == pytest.approx(np.column_stack([distance, distance]), abs=1e-14)
        if arc.angle_rad > 1e-8:
            left = np.cross(places[1], arc.sample(5)[3] - places[1])
            assert left @ (units(points)[i] - units(points)[j]) > 0


@pytest.mark.parametrize("name", SETS)
def test_regions_are_counterclockwise_around_their_site(name):
    diagram = SphericalVoronoi(SETS[name])
    starts = {}
    for (i, j), (a, b) in zip(diagram.ridge_points.tolist(), diagram.ridge_vertices.tolist(), strict=True):
        starts[i, a], starts[j, b] = b, a
    for site, region in enumerate(diagram.regions):
        assert region[0] == min(region)
        assert [starts[site, v] for v in region] == region[1:] + region[:1]


@pytest.mark.parametrize("name", SETS)
def test_vertices_are_circumcentres_of_their_simplices(name):
    triangulation = SphericalDelaunay(SETS[name])
    diagram = SphericalVoronoi(triangulation)
    assert np.linalg.norm(diagram.vertices, axis=1) == pytest.approx(1, abs=4e-16)
    corners = units(SETS[name])[triangulation.simplices]
    height = (corners * diagram.vertices[diagram.simplex_vertex][:, None]).sum(axis=2)
    assert np.ptp(height, axis=1) == pytest.approx(0, abs=1e-14)
    assert (height[:, 0] >= (diagram.vertices[diagram.simplex_vertex] @ units(SETS[name]).T).max(axis=1) - 1e-14).all()


@pytest.mark.parametrize("name", CIRCLES)
def test_sites_on_one_circle_have_two_vertices(name):
    points = CIRCLES[name]
    diagram = SphericalVoronoi(points)
    n = len(points)
    assert diagram.regions == [[0, 1]] * n
    assert len(diagram.ridge_points) == n
    assert (diagram.vertices[0] == -diagram.vertices[1]).all()
    height = units(points) @ diagram.vertices[0]
    assert np.ptp(height) == pytest.approx(0, abs=1e-15)
    a, b, c = units(points)[:3]
    assert np.cross(b - a, c - a) @ diagram.vertices[0] > 0


def test_no_points_and_one_point():
    empty = SphericalVoronoi(np.zeros((0, 3)))
    assert (empty.regions, len(empty.areas()), empty.vertices.shape) == ([], 0, (0, 3))
    one = SphericalVoronoi([[0, 0, 2], [0, 0, 1]])
    assert one.regions == [[], []]
    assert one.areas(radius=2).tolist() == [16 * np.pi, 0]
    assert one.point_region.tolist() == [0, 0]
    assert one.ridge_points.shape == one.ridge_vertices.shape == (0, 2)
    assert one.ridge_arcs() == []


def test_two_points_have_two_half_circles():
    diagram = SphericalVoronoi([[2, 0, 0], [0, 3, 0]])
    assert diagram.vertices.tolist() == [[0, 0, 1], [0, 0, -1]]
    assert diagram.ridge_points.tolist() == [[0, 1], [0, 1]]
    assert diagram.ridge_vertices.tolist() == [[0, 1], [1, 0]]
    middles = {tuple(np.round(arc.sample(3)[1], 12)) for arc in diagram.ridge_arcs()}
    assert middles == {(0.707106781187, 0.707106781187, 0), (-0.707106781187, -0.707106781187, 0)}
    assert diagram.areas() == pytest.approx(2 * np.pi, rel=1e-15)


@pytest.mark.parametrize(
    ("p", "axis"), [((0, 0, 1), (0, 1, 0)), ((0, 2, 0), (0, 0, -1)), ((3, -1, 2), (-2, 0, 3)), ((1, 1, 1), (0, 1, -1))]
)
def test_antipodal_pair_has_the_documented_axis(p, axis):
    diagram = SphericalVoronoi([p, [-2 * x for x in p]])
    assert diagram.vertices[0] == pytest.approx(units(np.array(axis, dtype=float)), abs=1e-15)
    assert diagram.regions == [[0, 1], [0, 1]]
    assert [arc.angle_rad for arc in diagram.ridge_arcs()] == pytest.approx([np.pi, np.pi])


@pytest.mark.parametrize("size", [1e-6, 1e-10, 1e-12])
def test_a_cluster_looks_like_the_plane(size):
    """Cells inside a cluster are those of the plane, up to its curvature, to all digits however small they are."""
    xy = np.random.default_rng(0).random((80, 2)) - 0.5
    points = np.column_stack([xy * size, np.ones(80)])
    sphere, plane = SphericalVoronoi(points), PlanarVoronoi(points[:, :2])
    inner = np.isfinite(plane.areas()) & (plane.areas() < 0.05 * size**2)
    assert inner.sum() > 30
    assert sphere.areas()[inner] == pytest.approx(plane.areas()[inner], rel=1e-11, abs=0)
    assert sphere.areas().sum() == pytest.approx(4 * np.pi, rel=1e-14)


def unit_of_many_digits(vector):
    vector = mpmath.matrix(vector)
    return vector / mpmath.norm(vector)


@pytest.mark.parametrize("size", [1e-10, 1e-14, 1e-15, 1e-25, 1e-100])
def test_normals_of_ridges_between_close_sites(size):
    """Pairs of every length about one direction, against 400 digits; and one of 53 bits, 2⁻¹⁰⁴ apart."""
    rng = np.random.default_rng(0)
    p, q = rng.integers(1, 9, size=(2, 20, 1)) * [1.0, 3.0, 0.0] + rng.normal(size=(2, 20, 1)) * [0, 0, size]
    p[0], q[0] = [3 * 2.0**50 + 7, 1, 0], [3 * 2.0**51 + 15, 2, 0]
    with mpmath.workdps(400):
        for a, b, normal in zip(p.tolist(), q.tolist(), _kernel.sphere.bisector_normals(p, q), strict=True):
            exact = unit_of_many_digits(unit_of_many_digits(a) - unit_of_many_digits(b))
            assert normal == pytest.approx([float(x) for x in exact], abs=1.2e-16)


@pytest.mark.parametrize("size", [1.0, 1e-8, 1e-12, 1e-15, 1e-40])
def test_circumcentres_of_clusters(size):
    """Well-shaped triangles, and slivers along a great circle, against 200 digits."""
    rng = np.random.default_rng(3)
    slivers = [[1, 0, 0], [1, size, 0], [1, 3 * size, size * size]]
    for triangle in [units(np.array([0, 0, 1]) + size * rng.normal(size=(3, 3))), np.array(slivers)]:
        if len(np.unique(triangle, axis=0)) < 3:
            continue
        with mpmath.workdps(400):
            a, b, c = (mpmath.matrix(p.tolist()) / mpmath.norm(mpmath.matrix(p.tolist())) for p in triangle)
            d, e = b - a, c - a
            normal = mpmath.matrix([d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]])
            exact = [float(x) for x in normal / mpmath.norm(normal)]
        assert _kernel.sphere.circumcenters(triangle, ONE)[0] == pytest.approx(exact, abs=1.2e-16)


def test_circumcentre_of_a_sliver_of_a_few_units_in_the_last_place():
    """Three directions of the great circle with the normal (1, −2, 1), 2⁻⁵² apart: double-double sees noise alone."""
    step = np.array([1, 0, -1]) * 2.0**-52
    triangle = np.array([1.0, 1, 1]) + np.arange(3)[:, None] * step
    expected = -np.array([1, -2, 1]) / np.sqrt(6)
    assert _kernel.sphere.circumcenters(triangle, ONE)[0] == pytest.approx(expected, abs=1.2e-16)


def test_a_ridge_shorter_than_the_doubles_resolve_is_an_arc_and_no_circle():
    diagram = SphericalVoronoi([[1, 1e-25, 0], [0, 1, 0], [0, 0, 1], [2, 2, -1], [-1, -1, -1]])
    lengths = np.linalg.norm(np.diff(diagram.vertices[diagram.ridge_vertices], axis=1)[:, 0], axis=1)
    assert (lengths == 0).sum() == 1
    assert all(arc.angle_rad <= np.pi for arc in diagram.ridge_arcs())
    assert diagram.areas().sum() == pytest.approx(4 * np.pi, rel=1e-14)


def test_duplicates_have_empty_regions():
    diagram = SphericalVoronoi(np.vstack([OCTAHEDRON, OCTAHEDRON[2] * 5]))
    assert diagram.regions[6] == []
    assert diagram.point_region.tolist() == [0, 1, 2, 3, 4, 5, 2]
    assert diagram.areas()[6] == 0


@pytest.mark.parametrize("name", SETS)
def test_round_trip(name):
    direct = SphericalDelaunay(SETS[name])
    again = SphericalVoronoi(direct).delaunay()
    assert rows(again.simplices) == rows(direct.simplices)


@settings(deadline=None, max_examples=150)
@given(st.lists(VECTORS, min_size=1, max_size=16))
def test_round_trip_with_ties(vectors):
    """Small integer vectors: most of their facets are polygons, some in planes through the centre."""
    direct = SphericalDelaunay(vectors)
    again = SphericalVoronoi(direct).delaunay()
    assert rows(again.simplices) == rows(direct.simplices)
    assert again.duplicates.tolist() == direct.duplicates.tolist()


@settings(deadline=None, max_examples=60)
@given(st.lists(VECTORS, min_size=3, max_size=14), st.randoms(use_true_random=False), st.integers(0, 2))
def test_permutation_and_rotation_do_not_matter(vectors, random, turn):
    points = np.array([v for k, v in enumerate(vectors) if not any(parallel(v, w) for w in vectors[:k])], dtype=float)
    order = list(range(len(points)))
    random.shuffle(order)
    first, second = SphericalVoronoi(points), SphericalVoronoi(np.roll(points[order], turn, axis=1))
    assert len(first.vertices) == len(second.vertices)
    edges = {frozenset(order[k] for k in pair) for pair in second.ridge_points.tolist()}
    assert edges == {frozenset(pair) for pair in first.ridge_points.tolist()}
    assert [len(first.regions[k]) for k in order] == [len(r) for r in second.regions]
    assert first.areas()[order] == pytest.approx(second.areas(), abs=1e-13)


def parallel(v, w):
    return not np.cross(v, w).any() and np.dot(v, w) > 0


def test_arrays_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        SphericalVoronoi(CUBE).ridge_points[0] = 1
