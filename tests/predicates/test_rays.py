"""in_bubble and its relatives on rays, against arithmetic of several hundred digits."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from mpmath import mp, mpf, workdps

from stereodel import _kernel_probe as probe
from stereodel.predicates import in_bubble
from tests import sets
from tests.exact import cross, dot, minus, unit
from tests.kernel.stages import OPEN
from tests.reference import bubble_ray, compare_directions, ray, turn_ray
from tests.spaces import SPHERE

SPREADS = [1.0, 1e-3, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-15]
SMALL = SPHERE.places(6)


def bubble(a, b, c, p):
    a, *others = map(unit, (a, b, c, p))
    u, v, w = (minus(other, a) for other in others)
    return dot(u, cross(v, w))


def turn(a, b, c):
    return dot(unit(a), cross(unit(b), unit(c)))


def sign_of(value, zero="1e-250"):
    zero = mpf(zero)
    return 0 if abs(value) < zero else int(mp.sign(value))


def cluster(spread, count=60, seed=0):
    rng = np.random.default_rng(seed)
    return rng.normal(size=3) + spread * rng.normal(size=(4, count, 3))


@given(SMALL, SMALL, SMALL, SMALL)
def test_small_integers(a, b, c, p):
    """Ties and parallel vectors are frequent here."""
    with workdps(300):
        assert in_bubble(a, b, c, p) == sign_of(bubble(a, b, c, p))
        assert turn_ray(ray(a), ray(b), ray(c)) == sign_of(turn(a, b, c))


@pytest.mark.parametrize("spread", SPREADS)
def test_clusters(spread):
    vectors = cluster(spread)
    with workdps(150):
        assert in_bubble(*vectors).tolist() == [sign_of(bubble(*four), 0) for four in vectors.swapaxes(0, 1)]


@pytest.mark.parametrize("spread", SPREADS[:-1])
def test_the_curvature_form_decides_where_flatness_defeats_the_plain_one(spread):
    """Row P6: the filter leaves next to nothing open, while below 1e-8 the plain determinant is a coin."""
    a, b, c, p = cluster(spread, count=2000)
    signs = probe.bubble(a, b, c, p, stage="filter" if spread > 1e-14 else "double_double")
    assert (signs == OPEN).mean() < 2e-3
    if spread <= 1e-10:
        a, b, c, p = map(sets.unit, (a, b, c, p))
        plain = np.linalg.det(np.stack([b - a, c - a, p - a], axis=1))
        assert 0.2 < (np.sign(plain) != signs).mean() < 0.8


def test_ties_of_one_circle():
    circle = [(x, y, 7) for x, y in ((3, 4), (4, 3), (5, 0), (0, 5), (-3, 4), (4, -3), (-5, 0))]
    for four in itertools.permutations(circle, 4):
        assert bubble_ray(*map(ray, four)) == 0
    tilted = np.array(circle) @ sets.TILT
    assert not in_bubble(*tilted[:4])
    nudged = tilted[3] + [0.0, 0.0, 2.0**-40]
    with workdps(60):
        assert in_bubble(*tilted[:3], nudged) == sign_of(bubble(*tilted[:3], nudged), 0) != 0


@given(SMALL, SMALL, SMALL)
def test_the_order_of_directions(a, b, c):
    with workdps(60):
        steps = [sign_of(x - y, "1e-50") for x, y in zip(unit(a), unit(b), strict=True)]
    expected = next((step for step in steps if step), 0)
    assert compare_directions(ray(a), ray(b)) == expected == -compare_directions(ray(b), ray(a))
    if compare_directions(ray(a), ray(b)) <= 0 and compare_directions(ray(b), ray(c)) <= 0:
        assert compare_directions(ray(a), ray(c)) <= 0


def test_the_order_sees_what_doubles_cannot():
    assert compare_directions(ray([1.0, 1e-200, 0.0]), ray([1.0, 0.0, 0.0])) == -1
    assert compare_directions(ray([-0.0, 1.0, 5e-324]), ray([0.0, 1.0, 0.0])) == -1
    assert compare_directions(ray([0.0, 2.0, -0.0]), ray([-0.0, 3.0, 0.0])) == 0


def test_extreme_components():
    a, b, c = [1.0, 0.0, 0.0], [1.0, 5e-324, 0.0], [1.0, 0.0, 5e-324]
    assert in_bubble(a, b, c, [1.0, 5e-324, 5e-324]) == -in_bubble(a, c, b, [1.0, 5e-324, 5e-324])
    with workdps(2500):
        for p in ([1.0, 1e-323, 0.0], [1.0, 5e-324, 5e-324], [1e300, -1e-10, 0.0], [-1.0, 0.0, 0.0]):
            assert in_bubble(a, b, c, p) == sign_of(bubble(a, b, c, p), "1e-2400")


@pytest.mark.parametrize("bad", [[0, 0, 0], [np.nan, 0, 1], [1, 2], [[0, 0, 1], [0, 0, 0]]])
def test_bad_directions_are_named(bad):
    with pytest.raises(ValueError, match=r"^p"):
        in_bubble([1, 0, 0], [0, 1, 0], [0, 0, 1], bad)
