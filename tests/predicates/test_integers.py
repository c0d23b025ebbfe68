"""Integers and sums of roots, against 300-digit arithmetic."""

from fractions import Fraction
from math import gcd

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf, workdps

from stereodel.predicates.integers import primitive, sign, sign_of_roots, to_integers

COEFFICIENT = st.integers(-(10**20), 10**20)
TERMS = st.lists(st.tuples(COEFFICIENT, st.integers(1, 10**30)), max_size=4)
FINITE = st.floats(allow_nan=False, allow_infinity=False)


def sign_by_digits(terms):
    """Four roots of such sizes differ by more than 1e-280 unless they are equal."""
    with workdps(320):
        total = mp.fsum(c * mp.sqrt(mpf(n)) for c, n in terms)
        return 0 if abs(total) < mpf(10) ** -290 else int(mp.sign(total))


@given(TERMS)
def test_sums_of_roots(terms):
    assert sign_of_roots(terms) == sign_by_digits(terms)


@given(COEFFICIENT, st.integers(1, 10**6), st.integers(1, 10**6), st.integers(1, 10**6), st.integers(-1, 1))
def test_sums_of_roots_that_cancel(c, n, k, m, nudge):
    """c√(nk²) and ck√n are one number; so are the roots of n and m on both sides."""
    terms = [(c, n * k * k), (-c * k + nudge, n), (k, m), (-k, m)]
    assert sign_of_roots(terms) == nudge
    assert sign_of_roots([(c, n * k * k), (c, m), (-c * k, n), (-c, m)]) == 0


@pytest.mark.parametrize(
    ("terms", "expected"),
    [
        ([], 0),
        ([(0, 2), (0, 3)], 0),
        ([(1, 2), (1, 3), (-1, 10)], -1),  # 3.1463 against 3.1623
        ([(1, 2), (1, 3), (-1, 5), (-1, 1)], -1),
        ([(99, 9802), (-9801, 1), (-1, 1)], -1),
        ([(2, 2), (-1, 8), (1, 3)], 1),  # a half that is zero: 2√2 = √8
        ([(2, 2), (-1, 8), (1, 5), (-1, 3)], 1),
        ([(1, 10**60 + 1), (-(10**30), 1)], 1),
    ],
)
def test_known_signs(terms, expected):
    assert sign_of_roots(terms) == expected
    assert sign_of_roots([(-c, n) for c, n in terms]) == -expected


@given(st.lists(FINITE, min_size=1, max_size=6))
def test_integers_are_one_multiple(values):
    integers = to_integers(values)
    scale = next((Fraction(i) / Fraction(v) for i, v in zip(integers, values, strict=True) if v), Fraction(1))
    assert scale > 0
    assert [Fraction(v) * scale for v in values] == integers


@given(st.tuples(FINITE, FINITE, FINITE).filter(any))
def test_primitive_vectors(vector):
    integers = primitive(vector)
    assert gcd(*integers) == 1
    assert [sign(x) for x in integers] == [sign(x) for x in vector]
    (x, y, z), (u, v, w) = (map(Fraction, t) for t in (vector, integers))
    assert x * v == y * u
    assert y * w == z * v
    assert x * w == z * u
