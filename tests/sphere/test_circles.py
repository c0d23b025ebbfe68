"""Circles and bubbles on the sphere (Figure 3)."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.sphere import SphereCircle, angular_distance, lonlat_to_xyz
from tests.exact import cross, dot, mp, normalized
from tests.strategies import BETWEEN_POLES, decades

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
    a, b, c = (normalized(mp(p)) for p in points)
    truth = normalized(cross(*([x - y for x, y in zip(p, a, strict=True)] for p in (b, c))))
    cosine = dot(truth, a)
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
    assert SphereCircle((0, 90), 0.0).contains([[1, 0, 0], [3, -4, 0], [1, 1, 1e-300], [1, 1, -1e-20]]).tolist() == [
        True,
        True,
        True,
        False,
    ]
