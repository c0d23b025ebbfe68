"""The oracle of exact signs: sums of roots against 300 digits, its tie rules against displacements that are made."""

import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf, workdps

from stereodel import in_bubble
from tests import sets
from tests.exact import cross, dot, unit, volume
from tests.reference import bubble_ray, bubble_tie, compare_directions, incircle_tie, ray, sign, sign_of_roots, turn_ray
from tests.spaces import SPHERE

COEFFICIENT = st.integers(-(10**20), 10**20)
FINITE = st.floats(allow_nan=False, allow_infinity=False)


def sign_by_digits(terms):
    """Four roots of such sizes differ by more than 1e-280 unless they are equal."""
    with workdps(320):
        total = mp.fsum(c * mp.sqrt(mpf(n)) for c, n in terms)
        return 0 if abs(total) < mpf(10) ** -290 else int(mp.sign(total))


@given(st.lists(st.tuples(COEFFICIENT, st.integers(1, 10**30)), max_size=4))
def test_sums_of_roots(terms):
    assert sign_of_roots(terms) == sign_by_digits(terms)


@given(COEFFICIENT, st.integers(1, 10**6), st.integers(1, 10**6), st.integers(1, 10**6), st.integers(-1, 1))
def test_sums_of_roots_that_cancel(c, n, k, m, nudge):
    """c√(nk²) and ck√n are one number; so are the roots of n and m on both sides."""
    terms = [(c, n * k * k), (-c * k + nudge, n), (k, m), (-k, m)]
    assert sign_of_roots(terms) == nudge
    assert sign_of_roots([(c, n * k * k), (c, m), (-c * k, n), (-c, m)]) == 0


SMALL = SPHERE.places(6)


def sign_of(value, zero="1e-250"):
    return 0 if abs(value) < mpf(zero) else int(mp.sign(value))


def bubble(a, b, c, p):
    return volume(*map(unit, (a, b, c, p)))


@given(SMALL, SMALL, SMALL, SMALL)
def test_small_integers(a, b, c, p):
    """Ties and parallel vectors are frequent here."""
    with workdps(300):
        assert bubble_ray(*map(ray, (a, b, c, p))) == sign_of(bubble(a, b, c, p))
        assert turn_ray(ray(a), ray(b), ray(c)) == sign_of(dot(unit(a), cross(unit(b), unit(c))))
        steps = [sign_of(x - y) for x, y in zip(unit(a), unit(b), strict=True)]
    expected = next((step for step in steps if step), 0)
    assert compare_directions(ray(a), ray(b)) == expected == -compare_directions(ray(b), ray(a))
    if compare_directions(ray(a), ray(b)) <= 0 and compare_directions(ray(b), ray(c)) <= 0:
        assert compare_directions(ray(a), ray(c)) <= 0


def test_what_doubles_cannot_see():
    assert compare_directions(ray([1.0, 1e-200, 0.0]), ray([1.0, 0.0, 0.0])) == -1
    assert compare_directions(ray([-0.0, 1.0, 5e-324]), ray([0.0, 1.0, 0.0])) == -1
    assert compare_directions(ray([0.0, 2.0, -0.0]), ray([-0.0, 3.0, 0.0])) == 0
    a, b, c = [1.0, 0.0, 0.0], [1.0, 5e-324, 0.0], [1.0, 0.0, 5e-324]
    with workdps(2500):
        for p in ([1.0, 1e-323, 0.0], [1.0, 5e-324, 5e-324], [1e300, -1e-10, 0.0], [-1.0, 0.0, 0.0]):
            expected = sign_of(bubble(a, b, c, p), "1e-2400")
            assert bubble_ray(*map(ray, (a, b, c, p))) == in_bubble(a, b, c, p) == expected


CIRCLE = [(3, 4), (5, 0), (-4, 3), (0, -5), (-3, -4)]


def lifted_incircle(*points):
    """The incircle determinant with heights x² + y² + ε, the first point in order lifted most."""
    rank = {p: k for k, p in enumerate(sorted(points))}
    rows = [[x, y, x * x + y * y + Fraction(1, 10 ** (20 * rank[x, y] + 20))] for x, y in points]
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = ([p - q for p, q in zip(r, rows[3], strict=True)] for r in rows[:3])
    return sign(az * (bx * cy - by * cx) + bz * (cx * ay - cy * ax) + cz * (ax * by - ay * bx))


def test_the_plane():
    for four in itertools.permutations(CIRCLE, 4):
        assert incircle_tie(*four) == lifted_incircle(*four)


def displaced_bubble(*vectors):
    """in_bubble after p̂(1 + ε) and the much smaller shifts along x, y, z; for the sizes see the comment below."""
    units = [unit(v) for v in vectors]
    rank = {k: order for order, k in enumerate(sorted(range(4), key=units.__getitem__))}

    # Outward steps 1e-200 … 1e-230, shifts 1e-400 … 1e-510: every first-order shift exceeds any product with an outward
    # step (1e-600), so the order of all first-order terms is the order of the rule.
    def moved(k):
        step = 10 * rank[k]
        return [x * (1 + mpf(10) ** (-200 - step)) + mpf(10) ** (-400 - step - 40 * i) for i, x in enumerate(units[k])]

    value = volume(*map(moved, range(4)))
    assert abs(value) > mpf(10) ** -560
    return int(mp.sign(value))


CIRCLES = {
    "small": [(x, y, 12) for x, y in CIRCLE],
    "small, tilted": np.array([(x, y, 12) for x, y in CIRCLE]) @ sets.TILT,
    "equator": [(x, y, 0) for x, y in [*CIRCLE, (3, -4)]],
    "meridian": [(0, x, y) for x, y in CIRCLE],
    "other meridian": [(x, 0, y) for x, y in CIRCLE],
    "great, tilted": np.array([(x, y, 0) for x, y in CIRCLE]) @ sets.TILT,
    "great, roots": [(1, 1, 0), (1, 2, 0), (-1, 3, 0), (1, -1, 0), (-1, -1, 0)],
    "great, through the x axis": [(1, 1, 1), (1, 2, 2), (-1, 3, 3), (1, -1, -1), (-1, -1, -1)],
}


REPEATED = {"small, tilted", "other meridian", "great, tilted", "great, roots"}


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=pytest.mark.thorough if n in REPEATED else ()) for n in CIRCLES]
)
def test_the_sphere(name):
    points = [tuple(map(int, v)) for v in CIRCLES[name]]
    with workdps(700):
        for four in itertools.permutations(points, 4):
            rays = [ray(tuple(map(float, v))) for v in four]
            assert bubble_ray(*rays) == 0
            assert bubble_tie(*rays) == displaced_bubble(*four)
