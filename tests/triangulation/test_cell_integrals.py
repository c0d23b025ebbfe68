"""Areas and centroids of cells: against exact arithmetic and many digits, by what they add up to, and by symmetry."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from mpmath import mp, mpf, workdps

from stereodel import PlanarVoronoi, SphericalVoronoi, _kernel
from tests import sets
from tests.exact import cross, dot, minus, norm, times, turn, unit
from tests.examples import examples
from tests.kernel.stages import third_by_day
from tests.spaces import SPHERE

GENERAL = np.array([[2, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3  # an orthogonal matrix: no axis is special
# The angle between the first and the sixth is a right one.
RIGHT_ANGLE = np.array(
    [[2, -1, 0], [-1, -2, 2], [0, 0, 1], [0, 2, 2], [2, 1, -2], [1, 2, -1], [1, -2, 0], [-2, 0, 0], [-1, 2, 0]], float
)

# The sphere ----------------------------------------------------------------------------------------------------------


def cell_in_many_digits(points, diagram, site):
    """Area by the turns of the boundary, the integral of x by its sides, both of the exact ridges; and the size."""
    start, end = diagram.region_offsets[site : site + 2]
    p = unit(points[site])
    edges = [minus(unit(points[j]), p) for j in diagram.region_neighbors[start:end]]
    inside = [times(-1, unit(edge)) for edge in edges]
    corners = [unit(cross(edges[k - 1], edges[k])) for k in range(len(edges))]
    turned, total = mpf(0), [mpf(0)] * 3
    for k in range(len(edges)):
        m, n = inside[k - 1], inside[k]
        turned += mp.atan2(norm(cross(m, n)), dot(m, n))
        side = turn(corners[k], corners[(k + 1) % len(edges)], n)
        total = [x + side * y / 2 for x, y in zip(total, n, strict=True)]
    return 2 * mp.pi - turned, total, max(norm(minus(corner, p)) for corner in corners)


def lune(points, diagram, site):
    """The cell of a site on a great circle: half the angles to both neighbours, from pole to pole."""
    north, p = unit(diagram.vertices[0]), unit(points[site])
    start = diagram.region_offsets[site]
    before, after = (unit(points[j]) for j in diagram.region_neighbors[start : start + 2])
    west, east = turn(before, p, north), turn(p, after, north)
    quarter = (east - west) / 4
    along = times(mp.sin(quarter), cross(north, p))
    return west + east, [x + y for x, y in zip(times(mp.cos(quarter), p), along, strict=True)], mpf(2)


def assert_cells_of_the_sphere(points, digits):
    """Areas within 1e-13 of themselves, centroids within 1e-12 of the cell's size, but for the rounding of either."""
    points = np.asarray(points, dtype=float)
    diagram = SphericalVoronoi(points)
    areas, centroids = diagram.areas(), diagram.centroids()
    assert abs(areas.sum() - 4 * np.pi) < 1e-13
    cell = cell_in_many_digits if diagram._dimension == 2 else lune
    with workdps(digits):
        for site in np.flatnonzero(diagram.point_region == np.arange(len(points))).tolist():
            area, total, size = cell(points, diagram, site)
            assert abs(mpf(areas[site]) - area) <= 1e-13 * area + mpf(2) ** -1074
            if norm(total) < 1e-9 and area > 1:
                continue  # of half the sphere: any point of it is as good
            for found, right in zip(centroids[site].tolist(), unit(total), strict=True):
                assert abs(mpf(found) - right) <= 1e-12 * size + 2.0**-51 * abs(right)


def clusters_of_clusters(_):
    """And single sites: neighbours from 1e-14 to 1 apart."""
    rng = np.random.default_rng(5)
    points = [rng.normal(size=3) for _ in range(4)]
    for size in (1e-2, 1e-5, 1e-8, 1e-11, 1e-14):
        points += [sets.unit(points[-1]) + size * rng.normal(size=3) for _ in range(5)]
    return points


def beside_an_axis(size):
    """Directions (1, y, z) are as close as doubles allow: differences of any size, not only those of unit vectors."""
    yz = np.random.default_rng(7).normal(size=(12, 2)) * size
    return np.vstack([np.column_stack([np.ones(12), yz]), [[-1, 0, 0.1], [0, 1, 0]]])


def of_any_length(size):
    """Lengths differ by far more than the directions do."""
    rng = np.random.default_rng(4)
    points = np.column_stack([np.ones(10), rng.normal(size=(10, 2)) * size]) * rng.uniform(1, 1000, size=(10, 1))
    return np.vstack([points, [[-1, 0, 0.1], [0, 1, 0]]])


def curve(ratio, n):
    """Of ever smaller spacing: cells as long as the curve so far and as flat as its next step."""
    z = ratio ** -np.arange(float(n))
    return np.column_stack([z * z, np.ones(n), z])


def tiny_curve(size):
    """Of which areas are below the least of doubles."""
    t = 10.0 ** -np.arange(12.0)
    return np.vstack([np.column_stack([np.ones(12), size * t, size * t * t]), [[-1, 0, 0.1], [0, 1, 0]]])


def meridians(width):
    """Long thin cells from pole to pole."""
    return [[1, 0, 0], [1, width, 0], [1, -1.3 * width, 0], [0, 0, 1], [0, 0, -1], [-1, 0.1, 0.2]]


def meridians_nearly(width):
    """And with a middle that hardly moves."""
    return [[1, 0, 0], [1, width, 0], [1, -1.3 * width, width * width], [1, 2.4 * width, 0], [-1, 0.1, 0.2]]


def thin(length, width):
    """All neighbours nearer than a right angle: what is measured in doubles elsewhere."""
    across = [[1, 0, 0], [1, width, 0], [1, -1.3 * width, 0]]
    ends = [[1, 0, length], [1, 0.3 * length, -length], [1, length, length], [1, -length, 0.5 * length], [-1, 0.1, 0.2]]
    return np.vstack([across, ends])


def antipodes(gap, near, far):
    rng = np.random.default_rng(8)
    axis, others = rng.normal(size=3), rng.normal(size=(4, 3))
    bends = gap * rng.normal(size=(8, 3))
    return np.vstack([bends[:near] + axis, *([axis] if not near else []), bends[4 : 4 + far] - axis, others])


def bent_axis(off):
    """Two sites at the ends of an axis, bent by `off`, and others on one side of it: a ridge in the far half."""
    return np.array([[1, 0, 0], [-1, off, 0], [0, 1, 0.1], [0.1, 0.2, -1], [0, 1, 0.2]])


def pair(size):
    """Two that share a cell evenly, however close they are."""
    wide = [[1.0, 1e-6, 1e-6], [1.0, -1e-6, 1e-6], [1.0, 0.0, -1e-6], [-1.0, 0.0, 0.0]]
    return [[1.0, size, 0.0], [1.0, -size, 0.0], *wide]


def components(seed):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(12, 3)) * np.exp(rng.uniform(-300, 300, size=(12, 3)))


ANTIPODAL = [1e-3, 1e-6, 1e-12, 1e-14, 1e-15, 3e-16, 1e-17, 1e-30, 0.0]
GAPS = [1.0, *10.0 ** -np.arange(3.0, 17, 2), 1e-14, 5e-15, 1e-20]
MANY = {
    150: [
        *(
            (lambda s: SPHERE.cluster(np.random.default_rng(0), s, 25), s)
            for s in (1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15)
        ),
        (clusters_of_clusters, None),
        *((bent_axis, off) for off in ANTIPODAL),
        *((lambda off: bent_axis(off) @ GENERAL, off) for off in ANTIPODAL),
        *((lambda s: thin(*s), s) for s in ((0.8, 1e-4), (0.8, 1e-6), (0.8, 1e-8), (1e-4, 1e-9), (1e-4, 1e-14))),
        *((lambda s: thin(*s) @ GENERAL, s) for s in ((0.8, 1e-4), (0.8, 1e-6), (0.8, 1e-8), (1e-4, 1e-9))),
        *((lambda g: [[1, 2, 3], [1.1, 2, 3], [-1, -2, -3 - g], [-1, -2 - 1.5 * g, -3]], gap) for gap in GAPS),
        *((lambda g: antipodes(g, 0, 1), gap) for gap in GAPS),
        *((lambda g: antipodes(g, 4, 4), gap) for gap in GAPS),
    ],
    350: [(meridians, width) for width in (1e-3, 1e-5, 3e-7, 1e-12, 5e-18, 1e-100)],
    500: [
        *((meridians_nearly, width) for width in (1e-3, 1e-5, 3e-7, 1e-12, 5e-18, 1e-100)),
        *((of_any_length, size) for size in (1e-20, 1e-33, 1e-38, 1e-100)),
    ],
    700: [(lambda s: curve(*s), s) for s in ((10.0, 16), (1e2, 14), (1e5, 12), (1e10, 10), (1e20, 8))],
    900: [
        *((beside_an_axis, size) for size in (1e-30, 1e-100, 1e-250)),
        *((tiny_curve, size) for size in (1e-150, 1e-200, 1e-250)),
        *((lambda s: [[1, s, 0], [1, -s, 0], [1, 0, 2 * s]], s) for s in (1e-3, 1e-8, 1e-13, 1e-150, 1e-300)),
        *(
            (lambda g: [[1, 0, 0], [1, g, 0], [1, 3 * g, 0], [0, 1, 0], [-1, 0, 0]], g)
            for g in (0.1, 1e-8, 1e-20, 1e-250)
        ),
    ],
    1800: [*((components, seed) for seed in (0, 1)), *((pair, size) for size in (1e-14, 1e-120, 1e-200, 5e-324))],
}


@pytest.mark.parametrize(
    ("digits", "make", "size"),
    third_by_day([(digits, *case) for digits, cases in MANY.items() for case in cases]),
    ids=lambda value: getattr(value, "__name__", str(value)),
)
def test_cells_of_the_sphere_against_many_digits(digits, make, size):
    assert_cells_of_the_sphere(make(size), digits)


@given(SPHERE.points(2, min_size=2, max_size=20))
@example(RIGHT_ANGLE)
@examples(0.4)
def test_cells_of_small_integer_directions(points):
    """Ties, hemispheres, great circles, antipodes: areas add up, and so do the integrals of x, to zero."""
    if len(set(SPHERE.names(points).tolist())) > 1:
        assert_cells_of_the_sphere(points, 40)


EXPONENTS = st.one_of(st.integers(-3, 3), st.integers(-60, 60), st.integers(-1074, 1020))
COMPONENT = st.builds(lambda m, e: float(np.ldexp(m, e)), st.integers(-7, 7), EXPONENTS)


def assert_they_share_the_sphere(vectors):
    diagram = SphericalVoronoi(vectors)
    areas, centroids = diagram.areas(), diagram.centroids()
    assert (areas >= 0).all()
    assert abs(areas.sum() - 4 * np.pi) < 1e-13
    kept = diagram.point_region == np.arange(len(vectors))
    assert np.linalg.norm(centroids[kept], axis=1) == pytest.approx(1, abs=5e-16)


@given(st.lists(st.tuples(COMPONENT, COMPONENT, COMPONENT).filter(any), min_size=2, max_size=9))
@example([(0.0, 0.0, 1.0), (0.0, 1.0, -0.5), (6.525304467998525e-55, 0.0, 1.0)])  # near lunes, one of half the sphere
def test_directions_of_any_components_share_the_sphere(vectors):
    assert_they_share_the_sphere(vectors)


# The plane -----------------------------------------------------------------------------------------------------------


def exact_planar_cell(points, diagram, site):
    """Area, centroid and size as fractions, from circumcentres as fractions."""
    start, end = diagram.region_offsets[site : site + 2]
    p = [Fraction(x) for x in points[site].tolist()]
    others = [minus(map(Fraction, points[j].tolist()), p) for j in diagram.region_neighbors[start:end]]
    corners = []
    for k in range(len(others)):
        (ax, ay), (bx, by) = others[k - 1], others[k]
        aa, bb, twice = ax * ax + ay * ay, bx * bx + by * by, 2 * (ax * by - ay * bx)
        corners.append(((by * aa - ay * bb) / twice, (ax * bb - bx * aa) / twice))
    pieces = [(a, b, a[0] * b[1] - a[1] * b[0]) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    doubled = sum(piece[2] for piece in pieces)
    centroid = [p[i] + sum((a[i] + b[i]) * w for a, b, w in pieces) / (3 * doubled) for i in (0, 1)]
    return doubled / 2, centroid, max(abs(x) for other in others for x in other) / 2


def assert_cells_of_the_plane(points, digits=12):
    """Areas within 1e-12 of themselves, centroids within 1e-12 of the cell's size, but for the rounding of either."""
    points = np.asarray(points, dtype=float)
    diagram = PlanarVoronoi(points)
    areas, centroids = diagram.areas(), diagram.centroids()
    bounded = 0
    for site in range(len(points)):
        if not diagram.regions[site] or diagram.regions[site][0] < 0:
            continue
        area, centroid, size = exact_planar_cell(points, diagram, site)
        if np.isinf(areas[site]):
            assert area > Fraction(np.finfo(float).max)
            continue
        assert abs(Fraction(areas[site]) - area) <= area / 10**digits + Fraction(1, 2**1074)
        for found, right in zip(centroids[site].tolist(), centroid, strict=True):
            assert abs(Fraction(found) - right) <= size / 10**digits + abs(right) / 2**51 + Fraction(1, 2**1073)
        bounded += 1
    return bounded


@pytest.mark.parametrize(
    ("size", "flat"), [(1e150, 1), (1.0, 1), (1e-6, 1), (1e-12, 1), (1e-14, 1), (1.0, 1e-9), (1e-6, 1e-6)]
)
def test_cells_of_the_plane_against_fractions(rng, size, flat):
    assert assert_cells_of_the_plane([0.6, 0.8] + size * rng.normal(size=(40, 2)) * [1, flat], digits=13) > 5


@pytest.mark.parametrize(
    ("ratio", "power", "n"), [(10.0, 2, 40), (10.0, 3, 40), (1e5, 2, 20), (1e5, 3, 16), (1e20, 2, 6)]
)
def test_curves_of_ever_smaller_spacing_in_the_plane(ratio, power, n):
    x = ratio ** -np.arange(float(n))
    frame = [[0, -5], [3, 3], [-3, 3]]
    assert assert_cells_of_the_plane(np.vstack([np.column_stack([x, x**power]), frame])) == n


@given(st.lists(st.tuples(COMPONENT, COMPONENT), min_size=4, max_size=12))
def test_points_of_any_components_in_the_plane(points):
    assert_cells_of_the_plane([(x / 2**40, y / 2**40) for x, y in points])


def test_what_has_no_centroid():
    centroids = PlanarVoronoi([[0, 0], [2, 0], [2, 2], [0, 2], [1, 1], [1, 1]]).centroids()
    assert np.isnan(centroids[[0, 1, 2, 3, 5]]).all()
    assert centroids[4].tolist() == [1, 1]
    assert np.isnan(PlanarVoronoi([[0, 0], [1, 1], [3, 3]]).centroids()).all()
    assert PlanarVoronoi(np.zeros((0, 2))).centroids().shape == (0, 2)
    assert SphericalVoronoi(np.zeros((0, 3))).centroids().shape == (0, 3)


# Cells of many ridges ------------------------------------------------------------------------------------------------


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
    ends = (before, others, 1), (others, before, -1)
    areas = [(a * a).sum(axis=1) * (b * across).sum(axis=1) / (8 * double) * sign for a, b, sign in ends]
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
    with workdps(60):
        half = mp.pi / n
        expected = 2 * n * (half - mp.asin(mp.cos(distance) * mp.sin(half)))
    assert area == pytest.approx(float(expected), rel=1e-15, abs=0)
    assert np.abs(centroid - [0, 0, 1]).max() < 1e-15 * distance
