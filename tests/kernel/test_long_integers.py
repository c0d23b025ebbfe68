"""Integers of many digits: quotients and roots, rounded, and signs of sums of roots: the end of what is exact."""

import math
from decimal import Decimal, localcontext
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel import _kernel_probe as probe
from tests.reference import sign_of_roots

BASE = 2**30
"""That of the kernel's limbs."""


def digits(number):
    """The highest first, all with the sign of the number."""
    size, sign, out = abs(number), -1 if number < 0 else 1, []
    while size:
        out.insert(0, sign * (size % BASE))
        size //= BASE
    return out


def integers(bits, least=0):
    """Of any length, and where carries run through whole limbs."""
    power = st.builds(lambda e, d: 2**e + d, st.integers(0, bits), st.integers(-2, 2))
    return st.integers(least, 2**bits) | power.filter(lambda n: n >= least)


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


def kernel_sign(terms):
    return probe.sign_of_roots([(digits(c), digits(n)) for c, n in terms])


def terms(bits):
    return st.lists(
        st.tuples(st.builds(lambda n, s: s * n, integers(bits), st.sampled_from([-1, 1])), integers(bits)), max_size=4
    )


@given(terms(8) | terms(70) | terms(3000))
def test_sums_of_any_numbers(sum_of_roots):
    assert kernel_sign(sum_of_roots) == sign_of_roots(sum_of_roots)


@given(
    st.lists(st.tuples(st.integers(-6, 6), st.sampled_from([0, 1, 2, 3, 4, 8, 9, 12, 18, 27])), max_size=4),
    st.integers(0, 2500),
)
def test_sums_that_vanish(sum_of_roots, exponent):
    """√8 = 2√2 and the like: zeros that no merging of equal radicands shows, also beyond the inline storage."""
    scaled = [(c << exponent, n << 2 * exponent) for c, n in sum_of_roots]
    assert kernel_sign(scaled) == sign_of_roots(sum_of_roots)


@given(integers(400), integers(400), integers(400), st.integers(-1, 1))
def test_nearly_vanishing(a, b, c, step):
    """√a + √b against the nearest multiple of √c, rounded to 2^-200."""
    if not c:
        return
    with localcontext() as context:
        context.prec = 500
        ratio = int((Decimal(a).sqrt() + Decimal(b).sqrt()) / Decimal(c).sqrt() * 2**200) + step
    near = [(2**200, a), (2**200, b), (-ratio, c)]
    assert kernel_sign(near) == sign_of_roots(near)
    assert kernel_sign([*near, (1, 7)]) == sign_of_roots([*near, (1, 7)])
    assert kernel_sign([*near[::-1], (-1, 1)]) == sign_of_roots([*near, (-1, 1)])


def test_too_many_terms():
    with pytest.raises(ValueError, match="four"):
        kernel_sign([(1, 2)] * 5)
