"""SphericalDelaunay: every triangulation ends in check_delaunay and has 2n − 4 facets."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from stereodel.predicates import in_bubble
from stereodel.sphere import lonlat_to_xyz
from stereodel.triangulation import PlanarDelaunay, SphericalDelaunay, check_delaunay
from stereodel.triangulation.topology import canonical

SMALL = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)
OCTAHEDRON = np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
CUBE = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
CUBE_GRID = np.array([p for p in itertools.product(range(-3, 4), repeat=3) if max(map(abs, p)) == 3], dtype=float)
EQUATOR = np.array([[s * x, r * y, 0] for x, y in ((3, 4), (4, 3), (12, 5)) for s in (1, -1) for r in (1, -1)]) / 1.0
SMALL_CIRCLE = np.array([[3, 4], [4, 3], [0, 5], [-5, 0], [-3, -4], [4, -3]]) @ np.eye(2, 3) + [0.0, 0.0, 2.0]
TILT = np.array([[1, 2, 2], [2, 1, -2], [2, -2, 1]], dtype=float)  # three times a rotation
GRATICULE = lonlat_to_xyz([[lon, lat] for lon in range(-180, 181, 20) for lat in range(-90, 91, 15)])
ICOSAHEDRON = lonlat_to_xyz(
    [[0, 90], [0, -90]] + [[72 * k + 36 * (s < 0), s * np.degrees(np.arctan(0.5))] for s in (1, -1) for k in range(5)]
)
TIED = {
    "octahedron": OCTAHEDRON,
    "cube": CUBE,
    "cube and octahedron": np.vstack([CUBE, OCTAHEDRON]),
    "cube grid": CUBE_GRID,
    "half of the cube grid": CUBE_GRID[CUBE_GRID[:, 2] >= 0],
    "other half": CUBE_GRID[CUBE_GRID[:, 0] >= 0],
    "tilted half": CUBE_GRID[CUBE_GRID[:, 2] >= 0] @ TILT,
    "small circle": SMALL_CIRCLE,
    "tilted small circle": SMALL_CIRCLE @ TILT,
    "two small circles": np.vstack([SMALL_CIRCLE, SMALL_CIRCLE * [1, 1, -3]]),
    "equator and pole": np.vstack([EQUATOR, [[0, 0, 1]]]),
    "equator and both poles": np.vstack([EQUATOR, OCTAHEDRON[4:]]),
    "tilted equator and pole": np.vstack([EQUATOR, [[0, 0, 1]]]) @ TILT,
    "equator and one point": np.vstack([EQUATOR, [[2, 3, -1]]]),
    "two great circles": np.vstack([EQUATOR, EQUATOR[:, [2, 0, 1]]]),
    "graticule": GRATICULE,
    "icosahedron": ICOSAHEDRON,
}
# Exact rotations: signed permutations of the axes with determinant 1.
TURNS = [
    np.array(m)
    for p in itertools.permutations(np.eye(3))
    for s in itertools.product((1, -1), repeat=3)
    if np.linalg.det(m := np.array(p) * np.array(s)[:, None]) > 0
]


def checked(points, **options):
    triangulation = SphericalDelaunay(points, **options)
    check_delaunay(triangulation)
    if triangulation.dimension == 2:
        assert len(triangulation) == 2 * (len(triangulation.points) - len(triangulation.duplicates)) - 4
        assert (triangulation.neighbors >= 0).all()
    return triangulation


def rows(simplices, names=None):
    simplices = np.asarray(simplices) if names is None else np.asarray(names)[simplices]
    return canonical(simplices.reshape(-1, 3)).tolist()


def names_of_directions(points):
    """One number for each direction of integer vectors, the same in any order of input."""
    integers = np.asarray(points).astype(int)
    return np.unique(integers // np.gcd.reduce(integers, axis=1)[:, None], axis=0, return_inverse=True)[1].ravel()


def firm_edges(triangulation, names):
    """Edges that are not diagonals of a polygon on one circle."""
    points, simplices, neighbors = triangulation.points, triangulation.simplices, triangulation.neighbors
    firm = set()
    for k in range(3):
        edges = np.delete(simplices, k, axis=1)
        # The other triangle's corners are those of the edge and the one wanted.
        opposite = simplices[neighbors[:, k]].sum(axis=1) - edges.sum(axis=1)
        signs = in_bubble(*np.moveaxis(points[simplices], 1, 0), points[opposite])
        firm |= {frozenset(edge) for edge in names[edges[signs != 0]].tolist()}
    return firm


def test_random_points_against_scipy():
    points = np.random.default_rng(0).normal(size=(1000, 3))
    triangulation = checked(points)
    expected = ConvexHull(points / np.linalg.norm(points, axis=1)[:, None]).simplices
    assert {frozenset(f) for f in triangulation.simplices.tolist()} == {frozenset(f) for f in expected.tolist()}
    assert not triangulation.closing.any()
    assert triangulation.convex_hull.shape == (0, 2)


@pytest.mark.parametrize("name", TIED)
def test_ties_do_not_depend_on_the_order(name):
    points = TIED[name]
    triangulation = checked(points)
    kept = np.arange(len(points))
    kept[triangulation.duplicates[:, 0]] = triangulation.duplicates[:, 1]
    rng = np.random.default_rng(7)
    for _ in range(5):
        order = rng.permutation(len(points))
        shuffled = checked(points[order])
        assert rows(shuffled.simplices, kept[order]) == rows(triangulation.simplices)


@given(st.lists(SMALL, max_size=12))
def test_small_integers(points):
    """Duplicates, opposite points, small and great circles together."""
    checked(np.array(points, dtype=float).reshape(-1, 3))


@given(st.lists(SMALL, min_size=3, max_size=12), st.randoms(use_true_random=False))
def test_the_order_of_input_does_not_matter(points, random):
    shuffled = random.sample(points, len(points))
    first, second = checked(points), checked(shuffled)
    assert rows(first.simplices, names_of_directions(points)) == rows(second.simplices, names_of_directions(shuffled))


@given(st.lists(SMALL, min_size=4, max_size=10), st.sampled_from(TURNS))
def test_exact_rotations_keep_all_but_diagonals(points, turn):
    points, names = np.array(points, dtype=float), names_of_directions(points)
    assert firm_edges(checked(points @ turn), names) == firm_edges(checked(points), names)


@given(st.lists(SMALL, min_size=3, max_size=8), st.lists(st.integers(0, 7), max_size=6), st.data())
def test_repetition_and_length_change_no_simplex(points, repeated, data):
    twice = np.array(points + [points[k % len(points)] for k in repeated], dtype=float)
    factors = data.draw(st.lists(st.sampled_from([1.0, 3.0, 2.0**-1070, 2.0**900]), min_size=len(twice)))
    longer = twice * np.array(factors[: len(twice)])[:, None]
    assert rows(checked(longer).simplices) == rows(checked(points).simplices)


@pytest.mark.parametrize("spread", [1e-3, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-15])
def test_tight_clusters(spread):
    """Hulls of rounded vectors lose points below 1e-8; rays lose none."""
    rng = np.random.default_rng(1)
    cluster = rng.normal(size=3) + spread * rng.normal(size=(120, 3))
    triangulation = checked(cluster)
    assert len(triangulation.duplicates) == 0
    assert triangulation.closing.any()


def test_a_tight_cluster_is_a_planar_triangulation():
    """At 1e-9 the sphere is flat to 1e-9 of the cluster: the tangent plane has the same triangles."""
    offsets = np.random.default_rng(2).normal(size=(150, 2)) * 2.0**-30
    points = np.column_stack([offsets, np.ones(150)])
    triangulation = checked(points)
    assert rows(triangulation.simplices[~triangulation.closing]) == rows(PlanarDelaunay(offsets).simplices)


def test_one_city_seen_from_the_globe():
    rng = np.random.default_rng(3)
    city = lonlat_to_xyz([2.35, 48.85]) + 1e-10 * rng.normal(size=(150, 3))
    triangulation = checked(np.vstack([rng.normal(size=(150, 3)), city]))
    assert not triangulation.closing.any()


def test_the_nearest_doubles_are_different_points():
    base = np.array([0.6, 0.64, 0.48])
    points = np.array([base + np.spacing(base) * np.array(s) for s in itertools.product((-1, 0, 1), repeat=3)])
    triangulation = checked(np.vstack([points, -points]))
    assert len(triangulation.duplicates) == 0


def test_closing_facets_of_a_cap():
    rng = np.random.default_rng(4)
    cap = [0, 0, 1] + 0.3 * rng.normal(size=(50, 3)) * [1, 1, 0]
    triangulation = checked(cap)
    a, b, c = np.moveaxis(cap[triangulation.simplices], 1, 0)
    assert np.array_equal(triangulation.closing, np.linalg.det(np.stack([a, b, c], axis=1)) <= 0)
    hull = triangulation.convex_hull
    assert len(hull) == triangulation.closing.sum() + 2
    assert sorted(hull[:, 0]) == sorted(hull[:, 1])
    for u, v in hull.tolist():  # all points lie to the left
        assert (
            np.linalg.det(np.stack([np.broadcast_to(cap[u], cap.shape), [cap[v]] * 50, cap], axis=1)) > -1e-15
        ).all()


def test_a_facet_through_the_centre_is_closing():
    triangulation = checked(TIED["equator and pole"])
    assert triangulation.closing.sum() == len(EQUATOR) - 2
    assert len(triangulation.convex_hull) == len(EQUATOR)
    assert not checked(TIED["equator and both poles"]).closing.any()


def test_a_small_circle_has_two_sides():
    triangulation = checked(SMALL_CIRCLE)
    assert triangulation.closing.sum() == len(SMALL_CIRCLE) - 2 == len(triangulation) / 2
    three = checked(np.eye(3))
    assert three.simplices.tolist() == [[0, 1, 2], [0, 2, 1]]
    assert three.closing.tolist() == [False, True]
    assert three.neighbors.tolist() == [[1, 1, 1], [0, 0, 0]]


def test_circumcenters_see_their_corners_alike():
    rng = np.random.default_rng(5)
    for points in (rng.normal(size=(40, 3)), [0, 0, 1] + 1e-9 * rng.normal(size=(40, 3))):
        triangulation = checked(points)
        centers = triangulation.circumcenters
        np.testing.assert_allclose(np.linalg.norm(centers, axis=1), 1.0, rtol=1e-15)
        units = points / np.linalg.norm(points, axis=1)[:, None]
        cosines = np.einsum("ik,ijk->ij", centers, units[triangulation.simplices])
        np.testing.assert_allclose(cosines, cosines[:, :1] @ np.ones((1, 3)), atol=1e-15)
        assert (cosines[~triangulation.closing] > 0).all()
        assert (cosines[triangulation.closing] <= 1e-15).all()


@pytest.mark.parametrize(
    ("points", "dimension"),
    [
        ([], -1),
        ([[0, 0, 5]], 0),
        ([[0, 0, 5], [0, 0, 1e-300]], 0),
        ([[1, 0, 0], [0, 1, 0]], 1),
        ([[1, 0, 0], [-1, 0, 0]], 1),
        ([[1, 0, 0], [-1, 0, 0], [0, 1, 0]], 1),
        (EQUATOR, 1),
        (EQUATOR @ TILT, 1),
        (np.eye(3), 2),
        ([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 1, 1e-300]], 2),
    ],
)
def test_small_and_flat_sets(points, dimension):
    triangulation = checked(points)
    assert triangulation.dimension == dimension
    if dimension < 2:
        shapes = [triangulation.simplices.shape, triangulation.neighbors.shape, triangulation.circumcenters.shape]
        assert shapes == [(0, 3)] * 3
        assert triangulation.edges.shape == triangulation.convex_hull.shape == (0, 2)
        assert triangulation.closing.shape == (0,)


def test_duplicates_are_equal_directions():
    points = np.array([[1, 2, 3], [2, 4, 6], [1, 2, 3 + 1e-15], [1, 0, 0], [5e-324, 0, -0.0], [0, 1, 0]])
    assert checked(points).duplicates.tolist() == [[1, 0], [4, 3]]


STAGES = ("filter", "curvature", "double_double", "exact")


def test_inconclusive_counts():
    assert checked(np.random.default_rng(6).normal(size=(200, 3))).inconclusive == dict.fromkeys(STAGES, 0)
    assert checked(CUBE).inconclusive["exact"] >= 6
    nearly = checked(GRATICULE).inconclusive
    assert nearly["filter"] > nearly["exact"]


@given(st.lists(SMALL, max_size=8), st.lists(SMALL, max_size=6))
def test_insert_equals_a_fresh_build(assert_same, old, new):
    triangulation = SphericalDelaunay(old)
    triangulation.insert(new)
    assert_same(triangulation, checked(old + new))


def test_closing_facets_are_asked_anew_after_a_change():
    triangulation = SphericalDelaunay(CUBE_GRID[CUBE_GRID[:, 2] >= 0])
    assert triangulation.closing.any()
    assert (triangulation.find_simplex(-OCTAHEDRON[4:5]) == -1).all()
    triangulation.insert(OCTAHEDRON)
    assert not triangulation.closing.any()
    assert (triangulation.find_simplex(OCTAHEDRON) >= 0).all()


@given(st.lists(SMALL, min_size=1, max_size=10), st.data())
def test_remove_equals_a_fresh_build(assert_same, points, data):
    indices = data.draw(st.lists(st.integers(0, len(points) - 1), max_size=5))
    triangulation = SphericalDelaunay(points)
    triangulation.remove(indices)
    assert_same(triangulation, checked([p for k, p in enumerate(points) if k not in indices]))


def test_lonlat():
    """Repeated poles and ±180 are duplicates; 2n − 4 for what remains."""
    lonlat = [[lon, lat] for lon in range(-180, 181, 30) for lat in range(-90, 91, 30)]
    triangulation = SphericalDelaunay.from_lonlat(lonlat)
    check_delaunay(triangulation)
    assert len(lonlat) - len(triangulation.duplicates) == 12 * 5 + 2
    assert np.array_equal(triangulation.points, lonlat_to_xyz(lonlat))


@pytest.mark.parametrize(
    ("latitude", "expected"), [("spherical", 45.0), ("geodetic", 44.80758), ("authalic", 44.87170)]
)
def test_latitudes_of_the_ellipsoid(latitude, expected):
    triangulation = SphericalDelaunay.from_lonlat([[0, 45], [10, 0], [0, 90]], latitude=latitude, workers=2)
    z = triangulation.points[:, 2]
    np.testing.assert_allclose(np.degrees(np.arcsin(z[0])), expected, atol=1e-5)
    assert z[1:].tolist() == [0.0, 1.0]


@pytest.mark.parametrize(
    ("bad", "error", "message"),
    [
        ([[0, 0, 0]], ValueError, r"points\[0\] is the zero vector"),
        ([[0, 0, np.nan]], ValueError, r"points\[0, 2\] is nan"),
        ([[0, 1]], ValueError, r"points must have shape \(n, 3\), got \(1, 2\)"),
        ([["a", "b", "c"]], TypeError, "points must hold real numbers"),
    ],
)
def test_refused_input(bad, error, message):
    with pytest.raises(error, match=message):
        SphericalDelaunay(bad)


@pytest.mark.parametrize(
    ("lonlat", "options", "message"),
    [
        ([[0, 91]], {}, r"lonlat\[0, 1\] is latitude 91"),
        ([[0, 0, 1]], {}, r"lonlat must have shape \(n, 2\)"),
        ([[np.inf, 0]], {}, r"lonlat\[0, 0\] is inf"),
        ([[0, 0]], {"latitude": "flat"}, "latitude"),
    ],
)
def test_refused_lonlat(lonlat, options, message):
    with pytest.raises(ValueError, match=message):
        SphericalDelaunay.from_lonlat(lonlat, **options)
