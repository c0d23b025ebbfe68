"""Angles of vectors by the kernel: relatively accurate, against many digits, and the signs of zeros."""

import mpmath
import numpy as np
import pytest

from stereodel import _kernel

BOUND = 3.1 * 2.0**-53


def assert_close(y, x):
    angles = _kernel.vector_angles(np.ascontiguousarray(y, dtype=float), np.ascontiguousarray(x, dtype=float))
    with mpmath.workprec(200):
        for b, a, angle in zip(y, x, angles.tolist(), strict=True):
            exact = mpmath.atan2(mpmath.mpf(float(b)), mpmath.mpf(float(a)))
            # Half the least subnormal number where the angle is one.
            assert abs(mpmath.mpf(angle) - exact) <= BOUND * abs(exact) + mpmath.mpf(2) ** -1075


@pytest.mark.parametrize("exponent", [0, -1000, 960, -1030])
def test_angles_of_all_sizes_and_directions(exponent):
    rng = np.random.default_rng(exponent % 7)
    x, y = rng.normal(size=(2, 300)) * 2.0 ** rng.uniform(-30, 30, (2, 300))
    assert_close(np.ldexp(y, exponent), np.ldexp(x, exponent))


def test_angles_near_breakpoints():
    """Quotients next to multiples of 1/64, to 1/16, to the end of the short series, and to 1."""
    quotients = np.concatenate([np.arange(1, 65) / 64, 2.0 ** -np.arange(1.0, 12.0)])
    close = np.concatenate([np.nextafter(quotients, 0), quotients, np.nextafter(quotients, 2), quotients * (1 - 1e-9)])
    for x, y in ((1.0, close), (-1.0, close), (1.0, -close), (-1.0, -close)):
        assert_close(y, np.full(len(close), x))
        assert_close(np.full(len(close), x), y)
    # Subtraction and division of what is not a power of two.
    assert_close(close * (1 / 3), np.full(len(close), 1 / 3))


def test_angles_where_the_error_is_largest(rng):
    """Beside 3/32, which is not a power of two, far from it: the product with it rounds beside the smallest angle."""
    greater = rng.uniform(4 / 3, 1.34, 3000)
    assert_close(greater * rng.uniform(0.0781, 0.0785, 3000), greater)


def test_angles_of_the_ends_of_the_range():
    least, most = 5e-324, np.finfo(float).max
    sizes = [least, 3 * least, 2.2e-308, 1e-300, 1.0, 1e300, most]
    x, y = (part.ravel() for part in np.meshgrid([*sizes, *(-s for s in sizes)], [*sizes, *(-s for s in sizes)]))
    assert_close(y, x)


def test_signs_of_zeros_are_those_of_the_standard():
    zeros = np.array([0.0, -0.0, 1.0, -1.0])
    x, y = (part.ravel() for part in np.meshgrid(zeros, zeros))
    ours, theirs = _kernel.vector_angles(y, x), np.arctan2(y, x)
    assert np.array_equal(ours, theirs)
    assert np.array_equal(np.signbit(ours), np.signbit(theirs))
