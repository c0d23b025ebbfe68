"""Ball arithmetic: what a ball holds against fractions and many digits, and what it leaves open."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import _kernel_probe as probe

NUMBER = st.floats(allow_nan=False, allow_infinity=False)
NEAR = st.builds(lambda m, e: float(m) * 2.0**e, st.integers(-8, 8), st.integers(-300, 40))


def evaluate(values, formula):
    """The same in exact numbers: fractions, as no formula here divides by zero."""
    stack, values = [], list(values)
    for symbol in formula:
        if symbol == "v":
            stack.append(Fraction(values.pop(0)))
        else:
            b, a = stack.pop(), stack.pop()
            stack.append(a + b if symbol == "+" else a - b if symbol == "-" else a * b if symbol == "*" else a / b)
    return stack.pop()


def ball(values, formula):
    """Middle and radius as fractions."""
    hi, lo, radius, power = probe.evaluate_balls(list(map(float, values)), formula)
    scale = Fraction(2) ** power
    return (Fraction(hi) + Fraction(lo)) * scale, Fraction(radius) * scale


FORMULAS = ["vv+", "vv-", "vv*", "vv*vv*-", "vv*vv*-vv*vv*-*", "vv-vv-*vv-vv-*-", "vv+v-", "vv+v-v+v*"]
FORMULAS += ["vv*vv*+vv*-vv-*vv*vv*+vv*-+", "vv*v*v*v*v*v*v*v*v*v*v*"]


@pytest.mark.parametrize("formula", FORMULAS)
@given(data=st.data())
def test_polynomials_lie_in_their_balls(formula, data):
    kind, count = data.draw(st.sampled_from([NUMBER, NEAR])), formula.count("v")
    values = data.draw(st.lists(kind, min_size=count, max_size=count))
    truth = evaluate(values, formula)
    middle, radius = ball(values, formula)
    assert abs(truth - middle) <= radius
    assert truth == 0 or middle or radius


@pytest.mark.parametrize("formula", FORMULAS)
def test_balls_are_small(rng, formula):
    """Of numbers of one size, up to what cancels: thirty operations lose no more than a few units of the last place."""
    for values in rng.uniform(1, 2, size=(40, formula.count("v"))) * 2.0 ** rng.integers(-1000, 1000, size=(40, 1)):
        permanent = evaluate(abs(values), formula.replace("-", "+"))
        assert ball(values, formula)[1] <= permanent * Fraction(2) ** -97


@given(NUMBER | NEAR, NUMBER | NEAR, NUMBER | NEAR, NUMBER | NEAR)
def test_quotients_lie_in_their_balls(a, b, c, d):
    """Of sums, whose parts may differ by any power of two."""
    if Fraction(c) + Fraction(d) != 0:
        truth = (Fraction(a) + Fraction(b)) / (Fraction(c) + Fraction(d))
        middle, radius = ball([a, b, c, d], "vv+vv+/")
        assert abs(truth - middle) <= radius
        assert ball([c, d], "vv+")[1] > 0 or radius <= abs(truth) * Fraction(2) ** -100


def test_a_quotient_by_what_may_be_zero_tells_nothing():
    tiny = [1.0, 1.0, 2.0**-150, 1.0, 2.0**-150, 1.0]
    _, radius = ball(tiny, "vv*v*v+v-v-")  # 2^-150 in a ball that holds zero
    assert radius > 0
    _, radius = ball([1.0, *tiny], "vvv*v*v+v-v-/")
    assert radius > 2**1000


def test_zero_is_proved_by_exact_products(rng):
    """p q - q p and the like of doubles: no radius is left, whatever the exponents."""
    for a, b in rng.normal(size=(50, 2)) * 10.0 ** rng.uniform(-300, 300, size=(50, 2)):
        assert ball([a, b, b, a], "vv*vv*-") == (0, 0)
        assert ball([a, b, a, np.nextafter(b, 1e308)], "vv*vv*-")[1] > 0


@pytest.mark.parametrize("exponent", [0, -500, -950, -1000, -1040, -1060, -1074])
def test_quotients_that_underflow_know_that(exponent):
    """A quotient of a small number by a large one may be subnormal: brought up again, it is off by as much."""
    for a, b in ((1.0, 3.0), (5.0, 7.0), (1.1, 1.7)):
        small, large = a * 2.0 ** (exponent // 2), b * 2.0 ** (exponent // 2 - exponent)
        middle, radius = probe.bounded_quotient(small, large, -exponent)
        exact = Fraction(small) / Fraction(large) * 2**-exponent
        assert abs(Fraction(middle) - exact) <= Fraction(radius) + Fraction(2) ** -53 * abs(exact)
