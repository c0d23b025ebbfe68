"""The kernel's planar predicates, stage by stage, against Python integers."""

import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import HullInsertion, PlanarDelaunay
from stereodel import _kernel_probe as probe
from tests import sets
from tests.kernel.stages import Predicates, third_by_day
from tests.reference import incircle_integer, incircle_tie, orient2d_integer, sign, to_integers
from tests.spaces import PLANE

FINITE = st.floats(allow_nan=False, allow_infinity=False)


def in_integers(oracle):
    def of(*points):
        flat = to_integers([x for p in points for x in p])
        return oracle(*[tuple(flat[k : k + 2]) for k in range(0, len(flat), 2)])

    return of


def distances_integer(q, a, b):
    (qx, qy), (ax, ay), (bx, by) = q, a, b
    return sign((ax - qx) ** 2 + (ay - qy) ** 2 - (bx - qx) ** 2 - (by - qy) ** 2)


PREDICATES = Predicates(
    orient2d=(probe.orient2d, in_integers(orient2d_integer), 3),
    incircle=(probe.incircle, in_integers(incircle_integer), 4),
    distances=(probe.compare_distances, in_integers(distances_integer), 3),
)
EVERY = pytest.mark.parametrize("name", PREDICATES)
check = PREDICATES.check


def on_a_circle(count, seed):
    """Four points of one circle each, rounded: signs of incircle far below what the coordinates suggest."""
    rng = np.random.default_rng(seed)
    angle = rng.uniform(0, 2 * np.pi, size=(4, count))
    center, radius = rng.uniform(-1, 1, size=(count, 2)), rng.uniform(0.1, 10, size=(count, 1))
    return center + radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def on_a_line(count, seed):
    rng = np.random.default_rng(seed)
    start, direction = rng.normal(size=(2, count, 2))
    return start + rng.uniform(-3, 3, size=(4, count, 1)) * direction


def around_a_point(count, seed):
    """A point and others at one distance from it, rounded."""
    rng = np.random.default_rng(seed)
    angle = rng.uniform(0, 2 * np.pi, size=(3, count))
    radius = rng.uniform(0.1, 10, size=(count, 1))
    center = rng.uniform(-1, 1, size=(1, count, 2))
    return np.concatenate([center, center + radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)])


NEAR = pytest.mark.parametrize("near", [on_a_circle, on_a_line, around_a_point])
OWN = {"orient2d": on_a_line, "incircle": on_a_circle, "distances": around_a_point}


@EVERY
@pytest.mark.parametrize("spread", [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-14, 1e-15])
def test_clusters(rng, name, spread):
    shares, _ = check(name, rng.uniform(-1, 1, size=2) + spread * rng.normal(size=(4, 400, 2)))
    assert shares["filter"] < (0.01 if spread > 1e-13 else 0.7)


@EVERY
@NEAR
def test_near_degenerate(name, near):
    """What doubles leave open, twice the precision decides, but for exact zeros."""
    shares, truth = check(name, near(600, 2))
    assert shares["double_double"] <= (truth == 0).mean()
    assert shares["filter"] > 0.5 or near is not OWN[name]


@EVERY
def test_around_a_tie(rng, name):
    """Neighbours of an exactly degenerate position by the last bits, at every scale of the last bits."""
    base = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]] if name == "incircle" else [[12.0, 12.0]] * 4)
    if name == "orient2d":
        base = base + np.array([[0, 0], [4, 4], [12, 12], [0, 0]])
    steps = rng.integers(-3, 4, size=(4, 900, 2)) * 2.0 ** rng.integers(-52, -20, size=(1, 900, 1))
    shares, truth = check(name, base[:, None] + steps)
    assert {-1, 0, 1} <= set(truth.tolist())
    assert shares["double_double"] <= (truth == 0).mean() + 0.05


@EVERY
@NEAR
@pytest.mark.parametrize("exponent", third_by_day([-252, -259, -262, -265, -268, -350, -516, -525, -529, -532, -536]))
def test_where_products_underflow(name, near, exponent):
    """Products keep a few bits only, and the signs of what is left are wrong more often than not."""
    check(name, near(150, 9) * 2.0**exponent)


@EVERY
@NEAR
@pytest.mark.parametrize("scale", [5e-324, 1e-300, 1e-200, 1e200, 1e300])
def test_at_another_scale(name, near, scale):
    """What leaves the range of doubles is decided by twice the precision all the same."""
    points = near(150, 10) * scale if scale > 1e-323 else np.round(near(150, 10) * 2**40) * scale
    shares, truth = check(name, points)
    assert shares["filter"] == 1
    assert shares["double_double"] <= (truth == 0).mean()


@EVERY
@pytest.mark.parametrize("per", [1, 2])
def test_coordinates_of_any_size(rng, name, per):
    """Points or coordinates of their own sizes; whole multiples have ties."""
    check(name, rng.normal(size=(4, 300, 2)) * 10.0 ** rng.uniform(-300, 300, size=(4, 300, per)))
    sizes = rng.choice([2.0**-1074, 1e-310, 1e-200, 1e-100, 1e-16, 1.0, 3.0, 1e16, 1e100, 1e200, 1e307], (4, 700, per))
    check(name, sizes * rng.integers(-3, 4, size=(4, 700, 2)))


def test_two_pairs_far_apart(rng):
    """Pairs that are 1e-200 close: cocircular but for one bit."""
    a, c = rng.normal(size=(2, 200, 2)) * 1e-200
    far = np.array([0.0, 1.0])
    points = np.stack([a, a * [-1, 1], c * [1, 0] + far, c * [-1, 0] + far])
    assert not check("incircle", points)[1].any()
    points[0, :, 0] = np.nextafter(points[0, :, 0], 1)
    assert check("incircle", points)[1].all()


@given(*[PLANE.places(4)] * 4, st.sampled_from([1.0, 0.1, 2.0**-1074, 1e-100, 1e100]))
def test_small_integers(a, b, c, d, unit):
    for name in PREDICATES:
        check(name, np.array([a, b, c, d], dtype=float)[:, None] * unit)


@given(st.lists(st.tuples(FINITE, FINITE), min_size=4, max_size=4))
def test_any_doubles(points):
    for name in PREDICATES:
        check(name, np.array(points)[:, None])


# By number, with ties ------------------------------------------------------------------------------------------------


def decided(points, numbers):
    """in_circle as the oracle has it: exact, ties displaced, a repeated number outside."""
    if numbers[3] in numbers[:3].tolist():
        return 0
    four = [points[k] for k in numbers]
    return int((in_integers(incircle_integer)(*four) or in_integers(incircle_tie)(*four)) > 0)


GRIDS = {
    "integers": sets.grid(5, 5),
    "tenths": 0.1 * sets.grid(5, 5),
    "large": sets.grid(4, 4) + [2.0**40, -(2.0**40)],
    "circle": [[x, y] for x, y in itertools.product(range(-7, 8), repeat=2) if x * x + y * y in (25, 50)],
    "random": np.random.default_rng(7).normal(size=(20, 2)),
}


@pytest.mark.parametrize("grid", GRIDS)
def test_by_number_with_ties(rng, grid):
    points = np.array(GRIDS[grid], dtype=float)
    numbers = rng.integers(len(points), size=(1500, 4)).astype(np.int32)
    numbers = numbers[[len(set(row[:3])) == 3 for row in numbers.tolist()]]
    numbers = numbers[probe.orient_numbered(points, numbers[:, :3].copy())[0] > 0]
    assert len(numbers) > 300
    signs, tally = probe.incircle_numbered(points, numbers, True)
    assert signs.tolist() == [decided(points.tolist(), row) for row in numbers]
    undisplaced, other_tally = probe.incircle_numbered(points, numbers, False)
    distinct = np.array([row[3] not in row[:3].tolist() for row in numbers])
    assert tally[3] == (undisplaced[distinct] == 0).sum()
    assert other_tally[0] >= tally[0] >= tally[2]
    if grid in ("integers", "large"):
        assert tally[2] == other_tally[2] == 0, "on a grid of small numbers doubles are exact"


def test_collinear_by_number():
    points = 0.1 * sets.grid(7, 7)
    numbers = np.array(list(itertools.permutations(range(0, 49, 3), 3)), dtype=np.int32)
    signs, tally = probe.orient_numbered(points, numbers)
    assert signs.tolist() == [in_integers(orient2d_integer)(*points[row].tolist()) for row in numbers]
    assert tally[3] == (signs == 0).sum() > 0


def test_a_grid_too_large_for_doubles():
    """Triangles of twice the area one whose products have up to 66 bits."""
    fibonacci = [1, 1]
    while fibonacci[-1] < 2**33:
        fibonacci.append(fibonacci[-2] + fibonacci[-1])
    points = np.array([[0, 0], *itertools.pairwise(fibonacci)], dtype=float)
    numbers = np.array([[0, k, k + 1] for k in range(1, len(points) - 1)], dtype=np.int32)
    truth = [orient2d_integer(*points[row].astype(int).tolist()) for row in numbers]
    assert probe.common_granularity(points) == 1
    assert probe.orient_numbered(points, numbers)[0].tolist() == truth
    assert {-1, 1} == set(truth)


def test_a_permanent_that_underflows_proves_nothing():
    """Without a common grid (the granularity is out of range) a zero of products that underflow is no zero."""
    points = np.array([[0.0, 0.0], [1e-200, 0.0], [0.0, 1e-200], [3e-200, 5e-200]])
    assert probe.common_granularity(points) == 0
    assert probe.orient_numbered(points, np.array([[0, 1, 2]], dtype=np.int32))[0] == [1]
    assert probe.incircle_numbered(points, np.array([[0, 1, 2, 3]], dtype=np.int32), False)[0] == [-1]


VALUE = st.builds(
    lambda m, e: float(m) * 2.0**e, st.integers(-(2**53), 2**53), st.integers(-300, 250) | st.integers(-3, 3)
)


@given(st.lists(st.tuples(VALUE, VALUE), max_size=5))
def test_granularity(points):
    points = PLANE.array(points)
    granularity = probe.common_granularity(points)
    if granularity:
        assert 2.0**-240 <= granularity <= 2.0**240
        quotients = [Fraction(x) / Fraction(granularity) for x in points.ravel().tolist()]
        assert all(q.denominator == 1 for q in quotients)
        assert granularity == 2.0**240 or any(q.numerator % 2 for q in quotients)
    else:
        assert any(x and (Fraction(x) / Fraction(2) ** -240).denominator > 1 for x in points.ravel().tolist())


@pytest.mark.parametrize("bits", [50, 51, 52, 53])
def test_granularity_of_long_numbers(bits):
    """A large number after a round one: its last bit counts unless doubles of its size have none so small."""
    for first in (2.0, 4.0, 8.0):
        assert probe.common_granularity(np.array([[first, 2.0**bits - 1]])) == 1
        assert probe.common_granularity(np.array([[first, 2.0**53 + 2]])) == 2


@given(st.integers(2**40, 2**50), st.permutations(range(12)), st.integers(-1, 1), st.integers(0, 1))
def test_the_last_digits_of_large_integers_on_a_circle(size, order, change, axis):
    """Ties, and values that a change by one leaves tiny beside the permanent."""
    circle = sorted({(s * x, t * y) for x, y in ((3, 4), (4, 3), (5, 0), (0, 5)) for s in (1, -1) for t in (1, -1)})
    quad = np.array([circle[k] for k in order[:4]], dtype=float) * size
    quad[3, axis] += change
    exact = incircle_integer(*[[int(x) for x in p] for p in quad.tolist()])
    for scale in (1.0, 2.0**-30, 2.0**20):
        signs, _ = probe.incircle_numbered(quad * scale, np.array([[0, 1, 2, 3]], dtype=np.int32), False)
        assert signs.tolist() == [exact]


def circle_of_integers(*more):
    """256 integer points of one circle, twice as many with each of `more`, so large that doubles hold no products."""
    factors = [complex(2, 1), complex(3, 2), complex(4, 1), complex(5, 2), complex(6, 1), complex(5, 4), *more]
    choices = [(f, f.conjugate()) for f in factors]
    numbers = [u * np.prod(choice) for choice in itertools.product(*choices) for u in (1, 1j, -1, -1j)]
    return np.array([[z.real, z.imag] for z in numbers]) * (1 if more else 2.0**33 + 1)


@pytest.mark.parametrize("moved", [0, 5, 128])
def test_circles_are_remembered_without_harm(moved):
    """Of one circle, with a few points beside it, or half of them on another one that the first filter cannot tell."""
    points = np.random.default_rng(13).permutation(circle_of_integers())
    points[:moved, 0] += 1
    found = PlanarDelaunay(points)
    assert found.inconclusive["double_double"] > 3 * len(points)
    reference = HullInsertion(points)
    reference.run()
    assert sorted(found.simplices.tolist()) == sorted(reference.simplices.tolist())


@pytest.mark.thorough
@pytest.mark.parametrize("moved", [0, 100])
def test_circles_are_remembered_from_task_to_task(moved):
    """So many points that there are several tasks: whatever one has left to the next, in any order, for any threads."""
    circle = circle_of_integers(complex(7, 2), complex(6, 5), complex(8, 3), complex(8, 5), complex(9, 4))
    assert len(np.unique(circle, axis=0)) == len(circle) == 8192
    circle[:moved, 0] += 1
    found = []
    for seed, workers in ((1, 1), (1, 2), (2, 1)):
        order = np.random.default_rng(seed).permutation(len(circle) + 500) % len(circle)  # some points twice
        triangulation = PlanarDelaunay(circle[order], workers=workers)
        assert len(triangulation.duplicates) == 500
        assert triangulation.inconclusive["double_double"] > 3 * len(circle)
        corners = np.sort(order[triangulation.simplices], axis=1)
        found.append((corners[np.lexsort(corners.T)].tolist(), triangulation.inconclusive))
    assert found[0] == found[1]
    assert found[0][0] == found[2][0]
    if not moved:
        assert len(found[0][0]) == len(circle) - 2
