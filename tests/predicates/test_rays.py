"""in_bubble and its relatives on rays, against arithmetic of several hundred digits."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf, workdps

from stereodel import _kernel_probe as probe
from stereodel.predicates import in_bubble
from stereodel.predicates.integers import sign
from stereodel.predicates.rays import (
    bubble_filter,
    bubble_ray,
    compare_directions,
    ray,
    turn_ray,
    units,
)
from stereodel.predicates.staged import columns

SPREADS = [1.0, 1e-3, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-15]
SMALL = st.tuples(*[st.integers(-6, 6)] * 3).filter(any)


def unit(vector):
    vector = [mpf(float(x)) for x in vector]
    length = mp.sqrt(mp.fsum(x * x for x in vector))
    return [x / length for x in vector]


def bubble(a, b, c, p):
    a, *others = map(unit, (a, b, c, p))
    return mp.det(mp.matrix([[x - y for x, y in zip(v, a, strict=True)] for v in others]))


def turn(a, b, c):
    return mp.det(mp.matrix([unit(a), unit(b), unit(c)]))


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
def test_clusters_keep_the_bound_of_the_filter(spread):
    vectors = cluster(spread)
    value, bound = bubble_filter(*(columns(units(v)) for v in vectors))
    signs = in_bubble(*vectors)
    with workdps(150):
        for k in range(vectors.shape[1]):
            truth = 2 * bubble(*vectors[:, k])
            assert abs(mpf(value[k]) - truth) <= bound[k]
            assert signs[k] == sign_of(truth, 0)


@pytest.mark.parametrize("spread", SPREADS[:-1])
def test_the_curvature_form_decides_where_flatness_defeats_the_plain_one(spread):
    """Row P6: the filter leaves next to nothing open, while below 1e-8 the plain determinant is a coin."""
    a, b, c, p = cluster(spread, count=2000)
    value, bound = bubble_filter(*(columns(units(v)) for v in (a, b, c, p)))
    assert (np.abs(value) <= bound).mean() < 2e-3
    if spread <= 1e-10:
        a, b, c, p = (v / np.linalg.norm(v, axis=1)[:, None] for v in (a, b, c, p))
        plain = np.linalg.det(np.stack([b - a, c - a, p - a], axis=1))
        assert 0.2 < (np.sign(plain) != np.sign(value)).mean() < 0.8


def test_ties_of_one_circle():
    circle = [(x, y, 7) for x, y in ((3, 4), (4, 3), (5, 0), (0, 5), (-3, 4), (4, -3), (-5, 0))]
    for four in itertools.permutations(circle, 4):
        assert bubble_ray(*map(ray, four)) == 0
    tilted = np.array(circle) @ np.array([[1, 2, 2], [2, 1, -2], [2, -2, 1]])
    assert not in_bubble(*tilted[:4].astype(float))
    nudged = tilted[3] * (1 + 0.0) + [0.0, 0.0, 2.0**-40]
    with workdps(60):
        assert in_bubble(*tilted[:3], nudged) == sign_of(bubble(*tilted[:3], nudged), 0) != 0


@given(SMALL, SMALL, SMALL, SMALL, st.tuples(*[st.integers(-1000, 1000)] * 4))
def test_lengths_do_not_matter(a, b, c, p, exponents):
    """Multiples of a vector by doubles are other directions if they round; powers of two and small integers do not."""
    scaled = [np.array(v) * 2.0**e for v, e in zip((a, b, c, p), exponents, strict=True)]
    assert in_bubble(*scaled) == in_bubble(a, b, c, p)
    assert in_bubble(np.array(a) * 3, b, np.array(c) * 7, p) == in_bubble(a, b, c, p)


@given(SMALL, SMALL, SMALL, SMALL)
def test_exchanging_two_points_turns_the_sign(a, b, c, p):
    assert in_bubble(b, a, c, p) == -in_bubble(a, b, c, p) == in_bubble(a, b, p, c)


def test_turn_of_arrays():
    vectors = np.array(list(itertools.product((-1.0, 0.0, 1.0, 1e-200), repeat=3))[1:])
    rng = np.random.default_rng(5)
    a, b, c = vectors[rng.integers(len(vectors) - 1, size=(3, 300))]
    a, b, c = (v[np.abs(np.stack([a, b, c])).max(axis=2).min(axis=0) > 0] for v in (a, b, c))
    expected = [sign(int(turn_ray(*map(ray, three)))) for three in zip(a.tolist(), b.tolist(), c.tolist(), strict=True)]
    assert probe.turn(a, b, c).tolist() == expected
    assert {-1, 0, 1} == set(expected)


@given(SMALL, SMALL, SMALL)
def test_the_order_of_directions(a, b, c):
    with workdps(60):
        u, v = unit(a), unit(b)
        expected = next((sign_of(x - y, "1e-50") for x, y in zip(u, v, strict=True) if abs(x - y) > 1e-40), 0)
    assert compare_directions(ray(a), ray(b)) == expected
    assert compare_directions(ray(b), ray(a)) == -expected
    if compare_directions(ray(a), ray(b)) <= 0 and compare_directions(ray(b), ray(c)) <= 0:
        assert compare_directions(ray(a), ray(c)) <= 0


def test_the_order_sees_what_doubles_cannot():
    assert compare_directions(ray([1.0, 1e-200, 0.0]), ray([1.0, 0.0, 0.0])) == -1
    assert compare_directions(ray([-0.0, 1.0, 5e-324]), ray([0.0, 1.0, 0.0])) == -1
    assert compare_directions(ray([0.0, 2.0, -0.0]), ray([-0.0, 3.0, 0.0])) == 0


def test_turns_below_the_error_of_the_unit_vectors():
    """Three directions of the plane 3x = y, two of them closer than their unit vectors are known."""
    k = np.arange(1.0, 41.0)[:, None]
    for rise in (1e-34, 1e-40):
        assert not probe.turn(k * [1, 3, 0], (k[::-1] + 2) * [1, 3, rise], (k + 4) * [1, 3, 5]).any()


def test_the_bounds_hold_where_squares_underflow():
    """The squares of the differences are zero in doubles, the determinants are not."""
    vectors = [[1.0, 0.0, 0.0], [1.0, 1e-170, 0.0], [1.0, 0.0, 1e-170], [1.0, 2e-170, 1e-170]]
    units_of = [columns(units(np.array([v]))) for v in vectors]
    with workdps(1500):
        value, bound = bubble_filter(*units_of)
        assert 0 < abs(2 * bubble(*vectors)) <= bound[0] - abs(value[0])


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
