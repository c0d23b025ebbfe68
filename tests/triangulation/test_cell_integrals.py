"""Areas and centroids of cells: against exact arithmetic and many digits, by what they add up to, and by symmetry."""

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy import spatial

from stereodel import _kernel
from stereodel.triangulation import PlanarVoronoi, SphericalDelaunay, SphericalVoronoi, check_delaunay

GENERAL = np.array([[2, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3  # an orthogonal matrix: no axis is special
SIZES = [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15]
# The angle between the first and the sixth is a right one.
RIGHT_ANGLE = [
    (2, -1, 0),
    (-1, -2, 2),
    (0, 0, 1),
    (0, 2, 2),
    (2, 1, -2),
    (1, 2, -1),
    (1, -2, 0),
    (-2, 0, 0),
    (-1, 2, 0),
]


def units(points):
    return points / np.linalg.norm(points, axis=-1, keepdims=True)


def cluster(size, n=25, seed=0):
    """Points about (0.6, 0, 0.8), with coordinates that are doubles like any others."""
    spread = np.random.default_rng(seed).normal(size=(n, 3))
    return np.array([0.6, 0.0, 0.8]) + size * spread


def as_matrix(vector):
    return mpmath.matrix([mpmath.mpf(float(x)) for x in vector])


def mp_cross(a, b):
    return mpmath.matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def mp_dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def mp_unit(vector):
    return vector / mpmath.sqrt(mp_dot(vector, vector))


def angle_between(a, b, about):
    """From a to b, counterclockwise, in [0, 2π)."""
    angle = mpmath.atan2(mp_dot(about, mp_cross(a, b)), mp_dot(a, b))
    return angle if angle >= 0 else angle + 2 * mpmath.pi


def cell_in_many_digits(points, diagram, site):
    """Area by the turns of the boundary, and the integral of x by its sides, both of the exact ridges."""
    start, end = diagram.region_offsets[site : site + 2]
    p = mp_unit(as_matrix(points[site]))
    others = [mp_unit(as_matrix(points[j])) for j in diagram.region_neighbors[start:end]]
    inside = [mp_unit(p - q) for q in others]
    corners = [mp_unit(mp_cross(others[k - 1] - p, others[k] - p)) for k in range(len(others))]
    turned = mpmath.mpf(0)
    total = mpmath.matrix(3, 1)
    for k in range(len(others)):
        m, n = inside[k - 1], inside[k]
        turned += mpmath.atan2(mpmath.norm(mp_cross(m, n)), mp_dot(m, n))
        total += angle_between(corners[k], corners[(k + 1) % len(others)], inside[k]) * inside[k] / 2
    return 2 * mpmath.pi - turned, total


@pytest.mark.parametrize("size", SIZES)
def test_cells_of_the_sphere_against_many_digits(size):
    """Inner cells of the cluster and the outer ones, which reach round the sphere."""
    points = cluster(size)
    diagram = SphericalVoronoi(points)
    areas, centroids = diagram.areas(), diagram.centroids()
    with mpmath.workdps(150):
        for site in range(len(points)):
            if len(diagram.regions[site]) == 0:
                continue
            area, total = cell_in_many_digits(points, diagram, site)
            assert abs(areas[site] / area - 1) < 2e-13
            exact = np.array([float(x) for x in mp_unit(total)])
            assert centroids[site] == pytest.approx(exact, abs=1e-12)


def test_sizes_of_every_kind_in_one_diagram():
    """Clusters of clusters, and single sites: neighbours from 1e-14 to 1 apart."""
    rng = np.random.default_rng(5)
    points = [rng.normal(size=3) for _ in range(4)]
    for size in (1e-2, 1e-5, 1e-8, 1e-11, 1e-14):
        points += [units(points[-1]) + size * rng.normal(size=3) for _ in range(5)]
    points = np.array(points)
    diagram = SphericalVoronoi(points)
    check_delaunay(diagram.delaunay())
    with mpmath.workdps(150):
        for site in range(len(points)):
            area, total = cell_in_many_digits(points, diagram, site)
            assert abs(diagram.areas()[site] / area - 1) < 2e-13
            assert diagram.centroids()[site] == pytest.approx([float(x) for x in mp_unit(total)], abs=1e-12)


@pytest.mark.parametrize("size", [1e-30, 1e-100, 1e-250])
def test_clusters_beside_an_axis(size):
    """Directions (1, y, z) are as close as doubles allow: differences of any size, not only those of unit vectors."""
    yz = np.random.default_rng(7).normal(size=(12, 2)) * size
    points = np.vstack([np.column_stack([np.ones(12), yz]), [[-1, 0, 0.1], [0, 1, 0]]])
    diagram = SphericalVoronoi(points)
    areas, centroids = diagram.areas(), diagram.centroids()
    with mpmath.workdps(800):
        for site in range(len(points)):
            area, total = cell_in_many_digits(points, diagram, site)
            assert float(area) == pytest.approx(areas[site], rel=2e-13, abs=0)
            assert centroids[site] == pytest.approx([float(x) for x in mp_unit(total)], abs=1e-12)


def assert_cells_of_the_sphere(points, digits):
    """Areas within 1e-13 of themselves, centroids within 1e-12 of the cell's size, but for the rounding of either."""
    points = np.asarray(points, dtype=float)
    diagram = SphericalVoronoi(points)
    areas, centroids = diagram.areas(), diagram.centroids()
    assert abs(areas.sum() - 4 * np.pi) < 1e-13
    with mpmath.workdps(digits):
        for site in np.flatnonzero(diagram.point_region == np.arange(len(points))).tolist():
            area, total = cell_in_many_digits(points, diagram, site)
            assert abs(mpmath.mpf(areas[site]) - area) <= 1e-13 * area + mpmath.mpf(2) ** -1074
            centroid, size = mp_unit(total), reach(points, diagram, site)
            for k in range(3):
                error = abs(mpmath.mpf(centroids[site, k]) - centroid[k])
                assert error <= 1e-12 * size + 2.0**-51 * abs(centroid[k])


def reach(points, diagram, site):
    """From a site to the farthest corner of its cell."""
    start, end = diagram.region_offsets[site : site + 2]
    p = mp_unit(as_matrix(points[site]))
    edges = [mp_unit(as_matrix(points[j])) - p for j in diagram.region_neighbors[start:end]]
    return max(mpmath.norm(mp_unit(mp_cross(edges[k - 1], edges[k])) - p) for k in range(len(edges)))


@pytest.mark.parametrize(("ratio", "n"), [(10.0, 16), (1e2, 14), (1e5, 12), (1e10, 10), (1e20, 8)])
def test_curves_of_ever_smaller_spacing_on_the_sphere(ratio, n):
    """Cells as long as the curve so far and as flat as its next step."""
    z = ratio ** -np.arange(float(n))
    assert_cells_of_the_sphere(np.column_stack([z * z, np.ones(n), z]), 700)


def test_four_points_from_1_to_1e_60():
    z = 10.0 ** -np.array([0.0, 20, 40, 60])
    areas = SphericalVoronoi(np.column_stack([z * z, np.ones(4), z])).areas()
    assert abs(areas.sum() - 4 * np.pi) < 1e-14
    assert areas[0] == pytest.approx(2 * np.pi, rel=1e-9)


@pytest.mark.parametrize("gap", [1.0, *10.0 ** -np.arange(3.0, 17, 2), 1e-14, 5e-15, 1e-20])
def test_beside_near_antipodes(gap):
    rng = np.random.default_rng(8)
    axis, others = rng.normal(size=3), rng.normal(size=(4, 3))
    bends = gap * rng.normal(size=(8, 3))
    assert_cells_of_the_sphere([[1, 2, 3], [1.1, 2, 3], [-1, -2, -3 - gap], [-1, -2 - 1.5 * gap, -3]], 100)
    assert_cells_of_the_sphere(np.vstack([axis, bends[:1] - axis, others]), 100)
    assert_cells_of_the_sphere(np.vstack([bends[:4] + axis, bends[4:] - axis, others]), 100)


@pytest.mark.parametrize("width", [1e-3, 1e-5, 3e-7, 1e-12, 5e-18, 1e-100])
def test_long_thin_cells(width):
    """From pole to pole, or nearly so, and with a middle that hardly moves."""
    meridians = [[1, 0, 0], [1, width, 0], [1, -1.3 * width, 0]]
    assert_cells_of_the_sphere([*meridians, [0, 0, 1], [0, 0, -1], [-1, 0.1, 0.2]], 350)
    assert_cells_of_the_sphere(
        [*meridians[:2], [1, -1.3 * width, width * width], [1, 2.4 * width, 0], [-1, 0.1, 0.2]], 500
    )


@pytest.mark.parametrize(("length", "width"), [(0.8, 1e-4), (0.8, 1e-6), (0.8, 1e-8), (1e-4, 1e-9), (1e-4, 1e-14)])
def test_thin_cells_of_any_length(length, width):
    """All neighbours nearer than a right angle: what is measured in doubles elsewhere."""
    across = [[1, 0, 0], [1, width, 0], [1, -1.3 * width, 0]]
    ends = [[1, 0, length], [1, 0.3 * length, -length], [1, length, length], [1, -length, 0.5 * length], [-1, 0.1, 0.2]]
    assert_cells_of_the_sphere(np.vstack([across, ends]), 150)
    assert_cells_of_the_sphere(np.vstack([across, ends]) @ GENERAL, 150)


@pytest.mark.parametrize("size", [1e-20, 1e-33, 1e-38, 1e-100])
def test_clusters_of_vectors_of_any_length(size):
    """Lengths differ by far more than the directions do."""
    rng = np.random.default_rng(4)
    points = np.column_stack([np.ones(10), rng.normal(size=(10, 2)) * size]) * rng.uniform(1, 1000, size=(10, 1))
    assert_cells_of_the_sphere(np.vstack([points, [[-1, 0, 0.1], [0, 1, 0]]]), 450)


@pytest.mark.parametrize("size", [1e-150, 1e-200, 1e-250])
def test_curves_of_which_areas_are_below_the_least_of_doubles(size):
    t = 10.0 ** -np.arange(12.0)
    curve = np.column_stack([np.ones(12), size * t, size * t * t])
    assert_cells_of_the_sphere(np.vstack([curve, [[-1, 0, 0.1], [0, 1, 0]]]), 900)


@pytest.mark.parametrize("seed", [0, 1])
def test_components_of_any_size_on_the_sphere(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(12, 3)) * np.exp(rng.uniform(-300, 300, size=(12, 3)))
    assert_cells_of_the_sphere(points, 1800)


def test_many_components_of_any_size():
    rng = np.random.default_rng(3)
    diagram = SphericalVoronoi(rng.normal(size=(250, 3)) * np.exp(rng.uniform(-300, 300, size=(250, 3))))
    areas = diagram.areas()
    assert (areas >= 0).all()
    assert abs(areas.sum() - 4 * np.pi) < 1e-13
    assert np.linalg.norm(diagram.centroids(), axis=1) == pytest.approx(1, abs=4e-16)


@pytest.mark.parametrize("gap", [0.1, 1e-8, 1e-20, 1e-160, 1e-250])
def test_lunes_of_any_width(gap):
    """On a great circle, by the turn from each site to the next; the pair's own cells beside all others'."""
    points = np.array([[1, 0, 0], [1, gap, 0], [1, 3 * gap, 0], [0, 1, 0], [-1, 0, 0]])
    areas = SphericalVoronoi(points).areas()
    with mpmath.workdps(300):
        at = [mpmath.atan2(mpmath.mpf(y), mpmath.mpf(x)) for x, y in points[:, :2].tolist()]
        expected = [at[k + 1] - at[k - 1] + (2 * mpmath.pi if k == 0 else 0) for k in range(4)]
        expected = [*expected, at[0] - at[3] + 2 * mpmath.pi]
        for area, exact in zip(areas.tolist(), expected, strict=True):
            assert abs(area / exact - 1) < 1e-14


EXPONENTS = st.one_of(st.integers(-3, 3), st.integers(-60, 60), st.integers(-1074, 1020))
COMPONENT = st.builds(lambda m, e: float(np.ldexp(m, e)), st.integers(-7, 7), EXPONENTS)


@settings(deadline=None, max_examples=100)
@given(st.lists(st.tuples(COMPONENT, COMPONENT, COMPONENT).filter(any), min_size=2, max_size=9))
@example([(0.0, 0.0, 1.0), (0.0, 1.0, -0.5), (6.525304467998525e-55, 0.0, 1.0)])  # near lunes, one of half the sphere
def test_directions_of_any_components_share_the_sphere(vectors):
    diagram = SphericalVoronoi(vectors)
    areas, centroids = diagram.areas(), diagram.centroids()
    assert (areas >= 0).all()
    assert abs(areas.sum() - 4 * np.pi) < 1e-13
    kept = diagram.point_region == np.arange(len(vectors))
    assert np.linalg.norm(centroids[kept], axis=1) == pytest.approx(1, abs=5e-16)


def exact_planar_cell(points, diagram, site):
    """Area and centroid as fractions, from circumcentres as fractions."""
    start, end = diagram.region_offsets[site : site + 2]
    p = [Fraction(x) for x in points[site].tolist()]
    others = [
        [Fraction(x) - y for x, y in zip(points[j].tolist(), p, strict=True)]
        for j in diagram.region_neighbors[start:end]
    ]
    corners = []
    for k in range(len(others)):
        (ax, ay), (bx, by) = others[k - 1], others[k]
        aa, bb, twice = ax * ax + ay * ay, bx * bx + by * by, 2 * (ax * by - ay * bx)
        corners.append(((by * aa - ay * bb) / twice, (ax * bb - bx * aa) / twice))
    pieces = [(a, b, a[0] * b[1] - a[1] * b[0]) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    doubled = sum(piece[2] for piece in pieces)
    centroid = [p[i] + sum((a[i] + b[i]) * w for a, b, w in pieces) / (3 * doubled) for i in (0, 1)]
    return doubled / 2, centroid


@pytest.mark.parametrize(
    ("size", "flat"), [(1e150, 1), (1.0, 1), (1e-6, 1), (1e-12, 1), (1e-14, 1), (1.0, 1e-9), (1e-6, 1e-6)]
)
def test_cells_of_the_plane_against_fractions(size, flat):
    rng = np.random.default_rng(2)
    points = np.array([0.6, 0.8]) + size * rng.normal(size=(40, 2)) * [1, flat]
    diagram = PlanarVoronoi(points)
    areas, centroids = diagram.areas(), diagram.centroids()
    bounded = 0
    for site in range(len(points)):
        if not diagram.regions[site] or diagram.regions[site][0] < 0:
            continue
        area, centroid = exact_planar_cell(points, diagram, site)
        assert areas[site] == pytest.approx(float(area), rel=1e-13, abs=0)
        scale = np.abs(points - points[site]).max()
        assert centroids[site] == pytest.approx([float(x) for x in centroid], rel=4e-16, abs=1e-13 * scale)
        bounded += 1
    assert bounded > 5


def assert_cells_of_the_plane(points):
    """Areas within 1e-12 of themselves, centroids within 1e-12 of the cell's size, but for the rounding of either."""
    points = np.asarray(points, dtype=float)
    diagram = PlanarVoronoi(points)
    areas, centroids = diagram.areas(), diagram.centroids()
    bounded = 0
    for site in range(len(points)):
        if not diagram.regions[site] or diagram.regions[site][0] < 0:
            continue
        area, centroid = exact_planar_cell(points, diagram, site)
        if np.isinf(areas[site]):
            assert area > Fraction(np.finfo(float).max)
            continue
        assert abs(Fraction(areas[site]) - area) <= area / 10**12 + Fraction(1, 2**1074)
        start, end = diagram.region_offsets[site : site + 2]
        others = points[diagram.region_neighbors[start:end]]
        size = max(abs(Fraction(x) - Fraction(y)) for q in others for x, y in zip(q, points[site], strict=True)) / 2
        for k in (0, 1):
            error = abs(Fraction(centroids[site, k]) - centroid[k])
            assert error <= size / 10**12 + abs(centroid[k]) / 2**51 + Fraction(1, 2**1073)
        bounded += 1
    return bounded


@pytest.mark.parametrize(
    ("ratio", "power", "n"), [(10.0, 2, 40), (10.0, 3, 40), (1e5, 2, 20), (1e5, 3, 16), (1e20, 2, 6)]
)
def test_curves_of_ever_smaller_spacing_in_the_plane(ratio, power, n):
    x = ratio ** -np.arange(float(n))
    frame = [[0, -5], [3, 3], [-3, 3]]
    assert assert_cells_of_the_plane(np.vstack([np.column_stack([x, x**power]), frame])) == n


def test_components_of_any_size_in_the_plane():
    rng = np.random.default_rng(1)
    points = rng.choice([-1, 1], size=(60, 2)) * np.exp(rng.uniform(-300, 300, size=(60, 2)))
    assert assert_cells_of_the_plane(points) > 40


@settings(deadline=None, max_examples=100)
@given(st.lists(st.tuples(COMPONENT, COMPONENT), min_size=4, max_size=12))
def test_points_of_any_components_in_the_plane(points):
    assert_cells_of_the_plane([(x / 2**40, y / 2**40) for x, y in points])


def test_a_bounded_cell_beside_a_point_of_1e_100():
    """Its area is finite, and so is its centroid; a cell of 4.5e-60 keeps its size."""
    z = 10.0 ** -np.arange(0.0, 101, 20)
    diagram = PlanarVoronoi(np.vstack([np.column_stack([z, z * z]), [[0, -5], [3, 3], [-3, 3]]]))
    assert diagram.areas()[1] == pytest.approx(6.125, rel=1e-9)
    assert diagram.areas()[4] == pytest.approx(4.5e-60, rel=1e-9)
    assert np.isfinite(diagram.centroids()[1]).all()


@pytest.mark.parametrize("exponent", [-520, -400, 400, 500])
def test_cells_of_the_plane_of_any_size(exponent):
    points = np.array([[0, 0], [2, 0], [0, 2], [-2, 0], [0, -4]])
    diagram = PlanarVoronoi(np.ldexp(points.astype(float), exponent))
    assert diagram.areas()[0] == np.ldexp(6.0, 2 * exponent)
    assert diagram.centroids()[0].tolist() == [0, np.ldexp(-0.5, exponent)]


def test_what_has_no_centroid():
    square = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 1], [1, 1]]
    centroids = PlanarVoronoi(square).centroids()
    assert np.isnan(centroids[[0, 1, 2, 3, 5]]).all()
    assert centroids[4].tolist() == [1, 1]
    assert np.isnan(PlanarVoronoi([[0, 0], [1, 1], [3, 3]]).centroids()).all()
    assert PlanarVoronoi(np.zeros((0, 2))).centroids().shape == (0, 2)
    assert SphericalVoronoi(np.zeros((0, 3))).centroids().shape == (0, 3)
    one = SphericalVoronoi([[0, 3, 4], [0, 6, 8]]).centroids()
    assert one[0].tolist() == pytest.approx([0, 0.6, 0.8])
    assert np.isnan(one[1]).all()


@pytest.mark.parametrize("n", [2000, 50_000])
@pytest.mark.parametrize("spread", [np.inf, 0.5, 1e-6, 1e-12])
def test_areas_add_up(n, spread):
    rng = np.random.default_rng(1)
    points = rng.normal(size=(n, 3)) * min(spread, 1.0) + (np.isfinite(spread) * np.array([0.6, 0, 0.8]))
    areas = SphericalVoronoi(points).areas()
    assert abs(np.sum(areas) - 4 * np.pi) < 1e-12
    assert (areas[areas != 0] > 0).all()


SMALL = st.lists(st.tuples(*[st.integers(-2, 2)] * 3).filter(any), min_size=1, max_size=20)


@settings(deadline=None, max_examples=150)
@given(SMALL)
@example(RIGHT_ANGLE)
def test_cells_of_small_integer_directions(vectors):
    """Ties, hemispheres, great circles, antipodes: areas add up, and so do the integrals of x, to zero."""
    diagram = SphericalVoronoi(vectors)
    areas, centroids = diagram.areas(), diagram.centroids()
    kept = np.flatnonzero(diagram.point_region == np.arange(len(vectors)))
    assert areas.sum() == pytest.approx(4 * np.pi, rel=1e-14)
    assert (areas[kept] > 0).all()
    assert np.linalg.norm(centroids[kept], axis=1) == pytest.approx(1, abs=4e-16)
    if len(kept) == 1:
        return
    with mpmath.workdps(40):
        points = np.array(vectors, dtype=float)
        for site in kept.tolist():
            area, total = (cell_in_many_digits if diagram._dimension == 2 else lune)(points, diagram, site)
            assert float(area) == pytest.approx(areas[site], rel=1e-14)
            if mpmath.norm(total) > 1e-9:
                assert centroids[site] == pytest.approx([float(x) for x in mp_unit(total)], abs=1e-14)


def lune(points, diagram, site):
    """The cell of a site on a great circle: half the angles to both neighbours, from pole to pole."""
    north = mp_unit(as_matrix(diagram.vertices[0]))
    p = mp_unit(as_matrix(points[site]))
    start = diagram.region_offsets[site]
    before, after = (mp_unit(as_matrix(points[j])) for j in diagram.region_neighbors[start : start + 2])
    west, east = angle_between(before, p, north), angle_between(p, after, north)
    turn = (east - west) / 4
    return west + east, p * mpmath.cos(turn) + mp_cross(north, p) * mpmath.sin(turn)


NEARLY_ANTIPODAL = [1e-3, 1e-6, 1e-12, 1e-14, 1e-15, 3e-16, 1e-17, 1e-30, 0.0]


@pytest.mark.parametrize("off", NEARLY_ANTIPODAL)
@pytest.mark.parametrize("turn", [np.eye(3), GENERAL])
def test_nearly_antipodal_neighbours(off, turn):
    """Two sites at the ends of an axis, bent by `off`, and others on one side of it: a ridge in the far half."""
    points = np.array([[1, 0, 0], [-1, off, 0], [0, 1, 0.1], [0.1, 0.2, -1], [0, 1, 0.2]]) @ turn
    diagram = SphericalVoronoi(points)
    assert [0, 1] in diagram.ridge_points.tolist()
    areas, centroids = diagram.areas(), diagram.centroids()
    assert areas.sum() == pytest.approx(4 * np.pi, rel=1e-14)
    with mpmath.workdps(150):
        for site in range(len(points)):
            area, total = cell_in_many_digits(points, diagram, site)
            assert float(area) == pytest.approx(areas[site], rel=1e-14)
            assert centroids[site] == pytest.approx([float(x) for x in mp_unit(total)], abs=1e-14)


def test_regular_solids():
    octahedron = np.vstack([np.eye(3), -np.eye(3)])
    diagram = SphericalVoronoi(octahedron)
    assert diagram.areas() == pytest.approx(2 * np.pi / 3, rel=1e-15)
    assert diagram.centroids() == pytest.approx(octahedron, abs=1e-16)


def test_centroids_of_many_sites_agree_with_sampling():
    points = units(np.random.default_rng(3).normal(size=(40, 3)))
    samples = units(np.random.default_rng(4).normal(size=(200_000, 3)))
    owner = spatial.cKDTree(points).query(samples)[1]
    means = np.array([units(samples[owner == k].mean(axis=0)) for k in range(40)])
    assert SphericalVoronoi(points).centroids() == pytest.approx(means, abs=0.03)


@pytest.mark.parametrize("shift", [0.0, 1e3, 2.0**30])
def test_translated_cells_keep_their_areas(shift):
    points = np.random.default_rng(0).integers(0, 2**20, size=(300, 2)) / 2.0**20
    still, moved = PlanarVoronoi(points), PlanarVoronoi(points + shift)
    finite = np.isfinite(still.areas())
    assert moved.areas()[finite] == pytest.approx(still.areas()[finite], rel=1e-13)


def test_the_way_a_triangulation_is_made_does_not_change_areas():
    points = np.random.default_rng(0).normal(size=(400, 3))
    triangulation = SphericalDelaunay(points[:300])
    triangulation.insert(points[300:])
    assert np.array_equal(SphericalVoronoi(triangulation).areas(), SphericalVoronoi(points).areas())


def integrals_of_first(points):
    """Area and centroid of the first point's cell, whose neighbours are all others, counterclockwise."""
    others = len(points) - 1
    cells = {
        "points": np.ascontiguousarray(points),
        "offsets": np.concatenate([[0], np.full(others + 1, others)]),
        "vertices": np.zeros(others, dtype=np.int32),
        "neighbors": np.arange(1, others + 1, dtype=np.int32),
        "vertex_count": 1,
        "order": np.zeros(1, dtype=np.int32),
    }
    space = _kernel.plane if points.shape[1] == 2 else _kernel.sphere
    return space.cell_areas(**cells)[0], space.cell_centroids(**cells)[0]


@pytest.mark.parametrize("share", [0.3, 0.7, 1.3])
@pytest.mark.parametrize("n", [40_000, 100_000])
def test_additions_count_in_a_cell_of_many_ridges_in_the_plane(n, share):
    """To a large area each of n neighbours in an arc about the site adds less than a unit in its last place."""
    angle = np.pi + np.linspace(-0.5, 0.5, n)
    near = np.sqrt(32 * share * 2.0**-53 * n) * np.column_stack([np.cos(angle), np.sin(angle)])
    others = np.vstack([[[0.1, -2], [2, 0.1], [-0.1, 2]], near])
    before = np.roll(others, 1, axis=0)
    across = others - before
    double = before[:, 0] * others[:, 1] - before[:, 1] * others[:, 0]
    areas = [
        (a * a).sum(axis=1) * (b * across).sum(axis=1) / (8 * double) * sign
        for a, b, sign in ((before, others, 1), (others, before, -1))
    ]
    expected = math.fsum(np.concatenate(areas))
    assert integrals_of_first(np.vstack([np.zeros(2), others]))[0] == pytest.approx(expected, rel=5e-16, abs=0)


@pytest.mark.parametrize("distance", [1e-9, 0.1, 0.6])
def test_additions_count_in_a_cell_of_many_ridges_on_the_sphere(distance):
    """Neighbours all around the pole: a regular polygon, up to the rounding of sites, which is of both signs."""
    n = 70_000
    angle = 2 * np.pi * np.arange(n) / n
    around = np.sin(2 * distance) * np.column_stack([np.cos(angle), np.sin(angle)])
    points = np.vstack([[0, 0, 1], np.column_stack([around, np.full(n, np.cos(2 * distance))])])
    area, centroid = integrals_of_first(points)
    with mpmath.workdps(60):
        half = mpmath.pi / n
        expected = 2 * n * (half - mpmath.asin(mpmath.cos(distance) * mpmath.sin(half)))
    assert area == pytest.approx(float(expected), rel=1e-15, abs=0)
    assert np.abs(centroid - [0, 0, 1]).max() < 1e-15 * distance
