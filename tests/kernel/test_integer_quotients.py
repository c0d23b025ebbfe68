"""Quotients and roots of large integers, rounded: the end of every exact construction."""

import math
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel import _kernel_probe as probe
from tests.kernel.long_integers import digits, integers


def nearest(numerator, denominator, exponent):
    """Python rounds quotients of integers to the nearest double, ties to even."""
    try:
        return float(Fraction(numerator, denominator) * Fraction(2) ** exponent)
    except OverflowError:
        return math.inf if (numerator > 0) == (denominator > 0) else -math.inf


def rounded(numerator, denominator, exponent):
    return probe.round_quotient(digits(numerator), digits(denominator), exponent)


SIZES = integers(60, 1) | integers(200, 1) | integers(3000, 1)
SIGN = st.sampled_from([-1, 1])


@given(SIZES, SIZES, SIGN, SIGN, st.integers(-1200, 1200))
def test_quotients_are_rounded_once(numerator, denominator, sign, other_sign, exponent):
    numerator, denominator = sign * numerator, other_sign * denominator
    assert rounded(numerator, denominator, exponent) == nearest(numerator, denominator, exponent)


@given(st.integers(2**52, 2**53), SIZES, SIGN, st.integers(-1, 1), st.integers(-1140, 980))
@example(2**53 - 1, 1, 1, 0, 971)  # half a unit above the largest double: infinite
@example(2**53 - 1, 3**200, 1, -1, 971)
@example(2**52, 1, -1, 0, -1127)  # half of the least double: zero
@example(2**52, 3**200, -1, 1, -1127)
def test_ties_go_to_even(mantissa, denominator, sign, step, exponent):
    """A double, half a unit and a little more or less, at any place: those of subnormals are further up."""
    numerator = sign * ((2 * mantissa + 1) * denominator + step)
    assert rounded(numerator, denominator, exponent - 1) == nearest(numerator, denominator, exponent - 1)


@given(st.integers(1, 2**12), st.integers(1, 20), st.integers(0, 2))
def test_subnormal_ties(count, bits, step):
    numerator = ((count << bits) + (1 << bits - 1)) * 3 + step - 1
    assert rounded(numerator, 3, -1074 - bits) == nearest(numerator, 3, -1074 - bits)


def test_zero_has_no_sign():
    assert math.copysign(1, rounded(0, -3, 0)) == 1
    assert math.copysign(1, rounded(-1, 3, -2000)) == 1
    assert rounded(-1, 3, 10**9) == -math.inf
    with pytest.raises(ValueError, match="denominator"):
        rounded(1, 0, 0)


@given(SIZES, st.integers(0, 900), st.integers(54, 600))
@example(2**59 - 1, 0, 54)
@example(2**60 - 1, 0, 4000)
def test_roots(number, shift, bits):
    assert probe.root_is_close(digits(number << shift), bits)
    assert probe.root_is_close(digits(number * number), bits)


def test_roots_need_a_positive_number():
    for number in (0, -4):
        with pytest.raises(ValueError, match="positive"):
            probe.root_is_close(digits(number), 64)
