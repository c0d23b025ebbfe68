"""orient2d, incircle and orient3d against rational arithmetic."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.predicates import incircle, orient2d, orient3d
from tests.reference import sign

FINITE = st.floats(allow_nan=False, allow_infinity=False)
SCALES = [1.0, 1e150, 1e-150, 2.0**-1074, 2.0**-1040, 1e-300]


def determinant(rows):
    if len(rows) == 1:
        return rows[0][0]
    minors = ([row[:k] + row[k + 1 :] for row in rows[1:]] for k in range(len(rows)))
    return sum((-1) ** k * rows[0][k] * determinant(m) for k, m in enumerate(minors))


def orient2d_oracle(*points):
    return determinant([[*map(Fraction, p), Fraction(1)] for p in points])


def incircle_oracle(*points):
    rows = [list(map(Fraction, p)) for p in points]
    return determinant([[x, y, x * x + y * y, Fraction(1)] for x, y in rows])


def orient3d_oracle(*points):
    return -determinant([[*map(Fraction, p), Fraction(1)] for p in points])


@given(st.lists(st.tuples(FINITE, FINITE, FINITE), min_size=4, max_size=4))
def test_any_doubles(four):
    flat = [p[:2] for p in four]
    assert orient2d(*flat[:3]) == sign(orient2d_oracle(*flat[:3]))
    assert incircle(*flat) == sign(incircle_oracle(*flat))
    assert orient3d(*four) == sign(orient3d_oracle(*four))


@pytest.mark.parametrize("scale", SCALES)
def test_orientation_on_the_grid_where_doubles_fail(scale):
    """Points one ulp apart about 0.5, seen from a line through 12 and 24 (Kettner and others, 2008)."""
    steps = np.arange(-8, 8) * 2.0**-53
    a = np.stack(np.meshgrid(0.5 + steps, 0.5 + steps), axis=-1).reshape(-1, 2) * scale
    b, c = np.array([12.0, 12.0]) * scale, np.array([24.0, 24.0]) * scale
    expected = [sign(orient2d_oracle(p, b, c)) for p in a.tolist()]
    assert orient2d(a, b, c).tolist() == expected
    assert orient2d(b, c, a).tolist() == expected
    assert orient2d(c, b, a).tolist() == [-s for s in expected]


@pytest.mark.parametrize("scale", [1.0, 2.0**498, 2.0**-498])
def test_incircle_near_a_circle_and_on_it(scale):
    on_circle = np.array([[3, 4], [5, 0], [-4, 3], [0, -5], [-3, -4], [4, -3], [-5, 0]], dtype=float) * scale
    a, b, c, *others = on_circle
    for d in others:
        nudges = np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]]) * np.spacing(4 * scale)
        expected = [sign(incircle_oracle(a, b, c, p)) for p in (d + nudges).tolist()]
        assert incircle(a, b, c, d + nudges).tolist() == expected
        assert expected[0] == 0
        assert incircle(b, a, c, d + nudges).tolist() == [-s for s in expected]


@pytest.mark.parametrize("bad", [[np.nan, 0], [0, np.inf], [1, 2, 3], "ab", [1j, 0]])
def test_bad_points_are_named(bad):
    with pytest.raises((ValueError, TypeError), match=r"^c"):
        orient2d([0, 0], [1, 0], bad)
    with pytest.raises((ValueError, TypeError), match=r"^d"):
        incircle([0, 0], [1, 0], [0, 1], bad)
