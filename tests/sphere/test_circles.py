"""Circles and bubbles (Figure 3), arcs, graticules, distances and areas, against many digits."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import SphereArc, SphereCircle, angular_distance, great_circle_points, lonlat_to_xyz, xyz_to_lonlat
from stereodel.sphere import graticule, graticule_patch, meridian, parallel, solid_angle
from tests.exact import distance, dot, normal_of, unit
from tests.strategies import BETWEEN_POLES, LONLAT, decades

RADII = st.one_of(st.floats(0.01, 179.99), decades(-13, -2))


@given(BETWEEN_POLES, RADII)
def test_radius_survives_however_small(center, radius):
    circle = SphereCircle.around(center, radius)
    assert circle.angular_radius == pytest.approx(radius, rel=1e-14)
    assert (circle.center == lonlat_to_xyz(center)).all()


@given(BETWEEN_POLES, st.floats(1e-6, 179.9))
def test_sample_lies_on_the_circle_counterclockwise(center, radius):
    circle = SphereCircle.around(center, radius)
    points = circle.sample(7)
    assert angular_distance(points, circle.center) == pytest.approx(radius, abs=1e-13)
    turning = np.cross(points - circle.center, np.roll(points, -1, axis=0) - circle.center) @ circle.normal
    assert (turning > 0).all()
    # It starts due south.
    assert points[0, 2] == pytest.approx(np.sin(np.radians(center[1] - radius)), abs=1e-14)


@given(BETWEEN_POLES, decades(-14, 2), st.permutations([0.3, 2.0, 4.4]))
def test_through_three_points(center, radius, turns):
    normal = lonlat_to_xyz(center)
    across = np.linalg.svd(normal[None])[2][1:]
    across[1] *= np.sign(np.linalg.det([normal, *across]))
    size = np.radians(radius)
    points = [np.cos(size) * normal + np.sin(size) * (np.cos(t) * across[0] + np.sin(t) * across[1]) for t in turns]
    circle = SphereCircle.through(*points)
    truth = normal_of(*points)
    cosine = dot(truth, unit(points[0]))
    assert max(abs(mpmath.mpf(float(g)) - v) for g, v in zip(circle.normal, truth, strict=True)) < 2.0**-52
    assert abs(circle.radius / mpmath.sqrt(1 - cosine**2) - 1) < 2.0**-51
    assert abs(circle.offset - cosine) < 2.0**-52
    # Counterclockwise seen from the tip of the normal.
    assert np.linalg.det([points[1] - points[0], points[2] - points[0], circle.normal]) >= 0


@given(BETWEEN_POLES, RADII, BETWEEN_POLES)
def test_bubbles(center, radius, point):
    circle = SphereCircle.around(center, radius)
    assert circle.complement.complement == circle
    assert circle.small_bubble.angular_radius <= 90 <= circle.large_bubble.angular_radius
    assert circle.small_bubble.complement == circle.large_bubble
    assert circle.contains(circle.center)
    assert not circle.complement.contains(circle.center)
    inside = angular_distance(lonlat_to_xyz(point), circle.center) - radius
    if abs(inside) > 1e-12:
        assert circle.contains(lonlat_to_xyz(point)) == (inside < 0)
        assert circle.complement.contains(lonlat_to_xyz(point)) == (inside > 0)


@pytest.mark.parametrize("radius", [1e-3, 1e-9, 1e-12, 3e-14, 25.8, 60.0, 154.0, 180 - 1e-9])
def test_contains_resolves_a_tiny_bubble(radius):
    circle = SphereCircle.around((0, 90), radius)
    size = np.tan(np.radians(min(radius, 180 - radius)))
    near, far = (np.array([size * (1 + e), 0, 1 if radius < 90 else -1]) for e in (-1e-10, 1e-10))
    assert circle.contains(near) == (radius < 90)
    assert circle.contains(far) == (radius > 90)


def test_points_of_a_great_circle_count_as_inside():
    places = [[1, 0, 0], [3, -4, 0], [1, 1, 1e-300], [1, 1, -1e-20]]
    assert SphereCircle((0, 90), 0.0).contains(places).tolist() == [True, True, True, False]


@given(BETWEEN_POLES, BETWEEN_POLES)
def test_great_arc(start, end):
    a, b = lonlat_to_xyz(start), lonlat_to_xyz(end)
    if not 1e-9 < angular_distance(a, b) < 180 - 1e-9:
        return
    arc = SphereArc.great(start, end)
    assert np.degrees(arc.length) == pytest.approx(float(angular_distance(a, b)), abs=1e-13)
    center, u, v, sweep_rad = arc.frame()
    assert (center == 0).all()
    assert np.abs(center + u - a).max() < 4e-16
    assert np.abs(np.cos(sweep_rad) * u + np.sin(sweep_rad) * v - b).max() < 1e-15
    assert np.abs(arc.sample(5) - great_circle_points(a, b, 5)).max() < 1e-15
    assert np.linalg.det([u, v, arc.circle.normal]) == pytest.approx(1)


@given(BETWEEN_POLES, st.floats(1e-9, 179.0), st.floats(0, 6.28), st.floats(0.01, 6.28))
def test_arc_of_any_circle(center, radius, first, sweep):
    circle = SphereCircle.around(center, radius)
    middle, u, v, _ = SphereArc.whole(circle).frame()
    start, end = (middle + np.cos(t) * u + np.sin(t) * v for t in (first, first + sweep))
    arc = SphereArc(circle, start, end)
    assert arc.angle_rad == pytest.approx(sweep, abs=1e-15 / circle.radius + 1e-15)
    points = arc.sample(6)
    assert np.abs(points @ circle.normal - circle.offset).max() < 1e-15
    middle, u, v, sweep_rad = arc.frame()
    assert np.abs(middle + np.cos(sweep_rad) * u + np.sin(sweep_rad) * v - end).max() < 2e-15


def test_whole_circle_is_closed():
    circle = SphereCircle.around((20, 30), 40)
    arc = SphereArc.whole(circle)
    assert arc.closed
    assert arc.length == pytest.approx(2 * np.pi * np.sin(np.radians(40)))
    assert (arc.sample(9)[0] == arc.sample(9)[-1]).all()
    assert SphereArc(circle, arc.start, arc.start).closed


def test_great_arc_of_neighbours_one_step_apart():
    a, b = np.array([1.0, 1.0, 0.0]), np.array([1.0, np.nextafter(1, 2), 0.0])
    assert SphereArc.great(a, b).length == pytest.approx(2.0**-53, rel=1e-6)
    assert angular_distance(a, b) == pytest.approx(np.degrees(2.0**-53), rel=1e-6)


@given(st.floats(-180, 179), st.floats(-89, 89))
def test_meridians_and_parallels(lon, lat):
    line = meridian(lon).sample(9)
    assert (line[0] == [0, 0, -1]).all()
    assert (line[-1] == [0, 0, 1]).all()
    inner = xyz_to_lonlat(line[1:-1])
    assert np.abs((inner[:, 0] - lon + 180) % 360 - 180).max() < 1e-12
    assert (np.diff(inner[:, 1]) > 0).all()
    ring = xyz_to_lonlat(parallel(lat).sample(5))
    assert ring[:, 1] == pytest.approx(lat, abs=1e-12)
    assert np.abs(ring[:4, 0] - [0, 90, -180, -90]).max() < 1e-12


@pytest.mark.parametrize(("spacing", "count"), [(10, 36 + 17), (5, 72 + 35), (30, 12 + 5), (60, 6 + 3), (7.5, 48 + 23)])
def test_graticule_counts(spacing, count):
    lines = graticule(spacing)
    assert len(lines) == count
    assert len({line.circle for line in lines}) == count
    latitudes = [line.circle.offset for line in lines if line.closed]
    assert latitudes == pytest.approx([-value for value in reversed(latitudes)], abs=0)
    assert 0.0 in latitudes


@pytest.mark.parametrize(("half_width", "spacing", "lines"), [(8, 2, 9), (8, 1, 17), (1.5, 0.5, 7), (0.3, 0.1, 7)])
def test_graticule_patch(half_width, spacing, lines):
    arcs = graticule_patch((0, 40), half_width, spacing)
    assert len(arcs) == 2 * lines
    for arc in arcs:
        assert np.degrees(arc.angle_rad) == pytest.approx(2 * half_width)
        lonlat = xyz_to_lonlat(arc.sample(5))
        assert np.abs(lonlat - [0, 40]).max() <= half_width + 1e-12
        center, u, v, sweep = arc.frame()
        assert np.abs(center + np.cos(sweep) * u + np.sin(sweep) * v - arc.end).max() < 1e-15
    first_meridian, first_parallel = xyz_to_lonlat(arcs[0].sample(2)), xyz_to_lonlat(arcs[lines].sample(2))
    assert np.abs(first_meridian - [[-half_width, 40 - half_width], [-half_width, 40 + half_width]]).max() < 1e-12
    assert np.abs(first_parallel - [[-half_width, 40 - half_width], [half_width, 40 - half_width]]).max() < 1e-12


def test_great_circle_points_of_many_pairs():
    a = np.array([[1.0, 0, 0], [0, 5.0, 0]])
    points = great_circle_points(a, [0, 0, 1], 4)
    assert points.shape == (2, 4, 3)
    assert np.abs(angular_distance(points[:, :-1], points[:, 1:]) - 30).max() < 1e-13
    assert (great_circle_points(a, a, 3) == [[[1, 0, 0]] * 3, [[0, 1, 0]] * 3]).all()


def l_huilier(a, b, c):
    """Unsigned area of a triangle, sides from chords."""
    corners = [unit(v) for v in (a, b, c)]
    x, y, z = (2 * mpmath.asin(distance(corners[k - 2], corners[k - 1]) / 2) for k in range(3))
    s = (x + y + z) / 2
    product = mpmath.tan(s / 2) * mpmath.tan((s - x) / 2) * mpmath.tan((s - y) / 2) * mpmath.tan((s - z) / 2)
    return 4 * mpmath.atan(mpmath.sqrt(abs(product)))


@given(LONLAT, st.floats(-13, -0.5), st.floats(0.2, 1.3), st.floats(0.3, 2.8))
def test_tiny_triangles_keep_their_digits(center, power, shape, angle):
    a = lonlat_to_xyz(center)
    across = np.linalg.svd(a[None])[2][1:]
    across[1] *= np.sign(np.linalg.det([a, *across]))
    b = a + 10.0**power * across[0]
    c = a + 10.0**power * shape * (np.cos(angle) * across[0] + np.sin(angle) * across[1])
    got, want = float(solid_angle(a, b, c)), l_huilier(a, b, c)
    # Rounded vertices may have turned a triangle of a few ulps.
    if power > -12:
        assert got > 0
        assert abs(got / want - 1) < 1e-13


@given(LONLAT, LONLAT, LONLAT)
def test_signs_and_permutations(p, q, r):
    a, b, c = points = lonlat_to_xyz([p, q, r])
    area = float(solid_angle(a, b, c))
    # Once round a great circle, or with opposite vertices, the sign or the triangle is open.
    if abs(abs(area) - 2 * np.pi) < 1e-9 or (points @ points.T).min() < -1 + 1e-12:
        return
    for vertices in ((b, c, a), (c, a, b)):
        assert float(solid_angle(*vertices)) == pytest.approx(area, abs=1e-14)
    for vertices in ((b, a, c), (a, c, b), (-a, -b, -c)):
        assert float(solid_angle(*vertices)) == pytest.approx(-area, abs=1e-14)


@given(LONLAT, LONLAT, LONLAT, LONLAT)
def test_four_faces_make_a_sphere_or_nothing(p, q, r, s):
    points = lonlat_to_xyz([p, q, r, s])
    # No triangle has opposite vertices for its own.
    if (points @ points.T).min() < -1 + 1e-12:
        return
    a, b, c, d = points
    total = sum(float(solid_angle(*face)) for face in ((a, b, c), (a, c, d), (a, d, b), (b, d, c)))
    assert abs(total / (4 * np.pi) - round(total / (4 * np.pi))) < 1e-12


def test_known_areas():
    octant = solid_angle([1, 0, 0], [0, 1, 0], [0, 0, 1])
    assert octant == pytest.approx(np.pi / 2, rel=1e-15)
    # Nearly a hemisphere: counterclockwise from above is clockwise around the south pole.
    ring = lonlat_to_xyz([[0, -1], [120, -1], [240, -1]])
    assert solid_angle(*ring) == pytest.approx(-float(l_huilier(*ring)), rel=1e-14)
    assert solid_angle(*ring[::-1]) > 1.9 * np.pi
    assert solid_angle(*lonlat_to_xyz([[0, 0], [120, 0], [-120, 0]])) == pytest.approx(2 * np.pi)
    assert solid_angle([1, 0, 0], [1, 0, 0], [0, 1, 0]) == 0
    assert solid_angle(np.eye(3)[:, None], [0, 1, 0], [0, 0, 2]).shape == (3, 1)


@pytest.mark.parametrize("gap", [0.0, 1e-300, 1e-18, 1e-10, 1e-3])
def test_distances_at_both_ends(gap):
    assert angular_distance([1, 0, 0], [1, gap, 0]) == pytest.approx(np.degrees(gap), rel=1e-5)
    assert 180 - angular_distance([1, 0, 0], [-1, gap, 0]) == pytest.approx(np.degrees(gap), rel=1e-5, abs=3e-14)
