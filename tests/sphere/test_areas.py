"""Solid angles against l'Huilier's formula in many digits and against each other."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.sphere import angular_distance, lonlat_to_xyz, solid_angle
from tests.exact import distance, mp, normalized
from tests.strategies import LONLAT


def l_huilier(a, b, c):
    """Unsigned area of a triangle, sides from chords."""
    corners = [normalized(mp(v)) for v in (a, b, c)]
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
