"""Sums of square roots of large integers: the end of every exact decision."""

from decimal import Decimal, localcontext

import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import _kernel_probe as probe
from tests.kernel.long_integers import digits, integers
from tests.reference import sign_of_roots


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
