"""Circles and bubbles on the sphere (Figure 3)."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.sphere import SphereCircle, angular_distance, lonlat_to_xyz

mpmath.mp.dps = 60

LONLAT = st.tuples(st.floats(-180, 180), st.floats(-89, 89))
RADII = st.one_of(st.floats(0.01, 179.99), st.floats(-13, -2).map(lambda k: 10.0**k))


@given(LONLAT, RADII)
def test_radius_survives_however_small(center, radius):
    circle = SphereCircle.around(center, radius)
    assert circle.angular_radius == pytest.approx(radius, rel=1e-14)
    assert (circle.center == lonlat_to_xyz(center)).all()


@given(LONLAT, st.floats(1e-6, 179.9))
def test_sample_lies_on_the_circle_counterclockwise(center, radius):
    circle = SphereCircle.around(center, radius)
    points = circle.sample(7)
    assert angular_distance(points, circle.center) == pytest.approx(radius, abs=1e-13)
    turning = np.cross(points - circle.center, np.roll(points, -1, axis=0) - circle.center) @ circle.normal
    assert (turning > 0).all()
    # It starts due south.
    assert points[0, 2] == pytest.approx(np.sin(np.radians(center[1] - radius)), abs=1e-14)


@given(LONLAT, st.floats(-14, 2).map(lambda k: 10.0**k), st.permutations([0.3, 2.0, 4.4]))
def test_through_three_points(center, radius, turns):
    normal = lonlat_to_xyz(center)
    across = np.linalg.svd(normal[None])[2][1:]
    across[1] *= np.sign(np.linalg.det([normal, *across]))
    size = np.radians(radius)
    points = [np.cos(size) * normal + np.sin(size) * (np.cos(t) * across[0] + np.sin(t) * across[1]) for t in turns]
    circle = SphereCircle.through(*points)
    a, b, c = (unit_mp(p) for p in points)
    axis = cross_mp(sub_mp(b, a), sub_mp(c, a))
    length = mpmath.sqrt(sum(v * v for v in axis))
    truth = [v / length for v in axis]
    cosine = sum(u * v for u, v in zip(truth, a, strict=True))
    assert max(abs(mpmath.mpf(float(g)) - v) for g, v in zip(circle.normal, truth, strict=True)) < 2.0**-52
    assert abs(circle.radius / mpmath.sqrt(1 - cosine**2) - 1) < 2.0**-51
    assert abs(circle.offset - cosine) < 2.0**-52
    # Counterclockwise seen from the tip of the normal.
    assert np.linalg.det([points[1] - points[0], points[2] - points[0], circle.normal]) >= 0


def unit_mp(v):
    length = mpmath.sqrt(sum(mpmath.mpf(float(x)) ** 2 for x in v))
    return [mpmath.mpf(float(x)) / length for x in v]


def sub_mp(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def cross_mp(a, b):
    return [a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3] for k in range(3)]


@given(LONLAT, RADII, LONLAT)
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
    assert SphereCircle((0, 90), 0.0).contains([[1, 0, 0], [3, -4, 0], [1, 1, 1e-300], [1, 1, -1e-20]]).tolist() == [
        True,
        True,
        True,
        False,
    ]


def test_storing_twice_changes_nothing():
    rng = np.random.default_rng(5)
    for normal in rng.normal(size=(100, 3)):
        circle = SphereCircle(normal, 0.25)
        again = SphereCircle(circle.normal, circle.offset, circle.radius)
        assert again == circle
        assert hash(again) == hash(circle)
    assert SphereCircle((1, 0, 0), 0.5) != SphereCircle((1, 0, 0), 0.25)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: SphereCircle((1, 0, 0), 1.0), "offset is 1.0: the circle is a point"),
        (lambda: SphereCircle((1, 0, 0), 1.5), r"offset is 1.5, outside \[-1, 1\]"),
        (lambda: SphereCircle((1, 0, 0), 0.5, 0.5), "radius is 0.5, but offset 0.5 belongs to radius 0.866"),
        (lambda: SphereCircle((0, 0, 0), 0.5), "normal is the zero vector"),
        (lambda: SphereCircle.around((0, 0), 0.0), "angular_radius is 0.0"),
        (lambda: SphereCircle.around((0, 0), 180.0), "angular_radius is 180.0"),
        (lambda: SphereCircle.through((1, 0, 0), (3, 0, 0), (0, 1, 0)), "two of them are the same point"),
        (lambda: SphereCircle((1, 0, 0), 0.0).contains([0, 0, 0]), "xyz is the zero vector"),
        (lambda: SphereCircle((1, 0, 0), 0.0).sample(0), "n is 0"),
    ],
)
def test_bad_input(call, message):
    with pytest.raises(ValueError, match=message):
        call()
