"""Sine and cosine of degrees in double-double, against 80 digits."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel._double_double import DoubleDouble
from stereodel.sphere.degrees import angle_degrees, sin_cos_degrees

mpmath.mp.dps = 80

ANGLES = st.one_of(
    st.floats(-720, 720),
    st.floats(-1e300, 1e300),
    st.integers(-16, 16).map(lambda k: np.nextafter(45.0 * k, 1e3)),
)


def exact(value: DoubleDouble, index=()):
    return mpmath.mpf(float(value.hi[index])) + mpmath.mpf(float(value.lo[index]))


@given(ANGLES)
def test_relative_error_below_2_to_minus_101(angle):
    sine, cosine = sin_cos_degrees(np.array(angle))
    turn = mpmath.mpf(float(np.fmod(angle, 360))) * mpmath.pi / 180
    for value, truth in ((sine, mpmath.sin(turn)), (cosine, mpmath.cos(turn))):
        # 80 digits leave an absolute error where the truth is 0.
        assert abs(exact(value) - truth) <= abs(truth) * mpmath.mpf(2) ** -101 + mpmath.mpf(10) ** -57


@pytest.mark.parametrize("quarter", range(-9, 10))
def test_multiples_of_90_are_exact(quarter):
    sine, cosine = sin_cos_degrees(np.array(90.0 * quarter))
    assert (float(sine.hi), float(sine.lo)) == ([0, 1, 0, -1][quarter % 4], 0)
    assert (float(cosine.hi), float(cosine.lo)) == ([1, 0, -1, 0][quarter % 4], 0)


@given(st.floats(-179.999, 180).filter(lambda v: v == 0 or abs(v) > 1e-290), st.floats(1e-3, 1e3))
def test_angle_is_the_inverse(angle, length):
    sine, cosine = sin_cos_degrees(np.array(angle))
    assert abs(angle_degrees(sine * length, cosine * length) - angle) <= np.spacing(abs(angle))


def test_angle_of_the_origin_is_zero():
    zero = DoubleDouble(np.zeros(2))
    assert (angle_degrees(zero, DoubleDouble(np.array([0.0, -0.0]))) == 0).all()
