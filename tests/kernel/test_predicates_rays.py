"""The kernel's predicates on directions, stage by stage, against Python integers and roots."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import _kernel_probe as probe
from tests.kernel.stages import OPEN, Predicates, third_by_day
from tests.reference import bubble_ray, compare_component, compare_directions, ray, sign_of_roots, turn_ray
from tests.sets import unit as normalised
from tests.spaces import SPHERE, dot

SPREADS = [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-13, 1e-14, 1e-15]


def of_rays(oracle):
    return lambda *vectors: oracle(*map(ray, vectors))


def angles_ray(q, a, b):
    return sign_of_roots(((dot(q, b), a[3]), (-dot(q, a), b[3])))


PREDICATES = Predicates(
    bubble=(probe.bubble, of_rays(bubble_ray), 4),
    turn=(probe.turn, of_rays(turn_ray), 3),
    angles=(lambda *v, unit, stage: probe.compare_angles(*v, stage=stage), of_rays(angles_ray), 3),
    component=(
        lambda a, b, unit, stage: probe.compare_component(a, b, 1, unit=unit, stage=stage),
        of_rays(lambda a, b: compare_component(a, b, 1)),
        2,
    ),
)
EVERY = pytest.mark.parametrize("name", PREDICATES)


def check(name, vectors, unit=None):
    """As lengths are; `unit`: whether they are taken to be one."""
    if unit is None:
        unit = all(probe.all_unit(v) for v in np.ascontiguousarray(vectors[: PREDICATES[name][2]]))
    return PREDICATES.check(name, vectors, unit=unit)


def cluster(spread, count=120, seed=0):
    rng = np.random.default_rng(seed)
    return normalised(rng.normal(size=3)) + spread * rng.normal(size=(4, count, 3))


def on_a_circle(spread, count=120, seed=1):
    """Four directions of one circle each, rounded."""
    rng = np.random.default_rng(seed)
    frames = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
    angle = rng.uniform(0, 2 * np.pi, size=(4, count, 1))
    return normalised(frames[:, 0] + spread * (np.cos(angle) * frames[:, 1] + np.sin(angle) * frames[:, 2]))


def off_length(vectors, seed=2):
    """Lengths as far from one as vectors may be that are taken as they stand."""
    rng = np.random.default_rng(seed)
    changed = vectors * (1 + rng.choice([-1, 1], size=(*vectors.shape[:-1], 1)) * 0.6 * 2.0**-49)
    assert all(probe.all_unit(v) for v in changed)
    return changed


def any_length(vectors, seed=3):
    return vectors * np.random.default_rng(seed).uniform(0.5, 1e6, size=(*vectors.shape[:-1], 1))


def allowance(name, spread):
    """The cosines of angles in the smallest clusters agree in all digits of the third stage."""
    return 0.8 if name == "angles" and spread < 1e-13 else 0.0


@EVERY
@pytest.mark.parametrize("spread", third_by_day(SPREADS))
@pytest.mark.parametrize("change", [normalised, off_length, any_length])
def test_clusters(name, spread, change):
    """And four of one circle each, rounded."""
    shares, truth = check(name, change(normalised(cluster(spread))))
    if change is normalised and name in ("bubble", "turn") and spread > 2e-13:
        assert shares["filter"] < 0.01
    assert shares["double_double"] <= (truth == 0).mean() + allowance(name, spread)
    shares, truth = check(name, change(on_a_circle(spread)))
    assert shares["double_double"] <= (truth == 0).mean() + allowance(name, spread)


@pytest.mark.parametrize("spread", SPREADS)
@pytest.mark.parametrize("change", [normalised, off_length])
def test_side_of_a_plane(spread, change):
    """Never wrong, however close and however cocircular the points are; mostly told where they are 1e-6 apart."""
    for vectors in (cluster(spread), on_a_circle(spread)):
        vectors = change(normalised(vectors))
        truth = np.array([of_rays(bubble_ray)(*row) for row in vectors.transpose(1, 0, 2).tolist()])
        signs = probe.bubble_plane(*vectors)
        assert ((signs == truth) | (signs == OPEN)).all()
    if spread >= 1e-6:
        assert (probe.bubble_plane(*change(normalised(cluster(spread)))) == OPEN).mean() < 0.1


@pytest.mark.parametrize("spread", [2.0**-17.5, 2.0**-16, 2.0**-12, 2.0**-5])
@pytest.mark.parametrize("change", [normalised, off_length])
def test_where_the_plane_with_lengths_hardly_tells(spread, change):
    """Twice the precision begins with the side of the plane down to 2^-18: many circles, on both sides of its bound."""
    shares, truth = check("bubble", change(on_a_circle(spread, count=3000)))
    assert shares["double_double"] <= (truth == 0).mean()


def test_what_stays_open_is_little():
    """Row P6: cocircular up to rounding, the curvature form alone decides the more, the smaller the circle."""
    shares = [check("bubble", on_a_circle(spread))[0]["filter"] for spread in (1.0, 1e-3, 1e-6)]
    assert shares[0] > 0.6 > 0.4 > shares[1] > 0.01 > shares[2]


# Sets of fours that no stage may get wrong, whatever it leaves open ---------------------------------------------------


def beside_an_axis(spread):
    """Near an axis small components resolve directions far below 1e-16; the long component makes the lengths differ."""
    rng = np.random.default_rng(9)
    for steps in (0, 3):
        angle = rng.uniform(0, 2 * np.pi, size=(4, 200))
        long = 1 + 2.0**-52 * rng.integers(-steps, steps + 1, size=(4, 200))
        vectors = np.stack([spread * np.cos(angle), spread * np.sin(angle), long], axis=-1)
        yield from ((vectors, True), (vectors, False), (np.roll(vectors * 3, 1, axis=-1), None))


def in_line_beside_an_axis(exponent):
    """Great circles through three directions next to an axis, rounded."""
    rng = np.random.default_rng(18)
    start, direction = rng.normal(size=(2, 150, 2))
    vectors = np.ones((4, 150, 3))
    vectors[..., :2] = (start + rng.uniform(-3, 3, size=(4, 150, 1)) * direction) * 2.0**exponent
    yield from ((vectors, True), (vectors, False))


def closer_than_their_low_parts_tell(rise):
    """Three directions of the plane 3x = y, two of them the same or closer than 1e-34."""
    k = np.arange(1.0, 201.0)[:, None]
    vectors = np.stack([k * [1, 3, 0], (k[::-1] + 2) * [1, 3, rise], (k + 4) * [1, 3, 5]])
    yield np.concatenate([vectors, vectors[:1] + np.array([0, 1, 0])]), None


def mixed_exponents(_):
    rng = np.random.default_rng(11)
    sizes = rng.choice([5e-324, 1e-310, 1e-200, 1e-100, 1e-16, 1.0, 3.0, 1e16, 1e100, 1e200, 1e307], (4, 200, 3))
    vectors = sizes * rng.integers(-3, 4, size=(4, 200, 3))
    vectors[(vectors == 0).all(axis=-1)] = 1.0
    yield vectors, None


def one_long_component(_):
    """Lengths near one, the other components of any size: the first stages meet underflow."""
    rng = np.random.default_rng(12)
    sizes = 2.0 ** rng.integers(-1074, -1, size=(4, 400, 3)) * rng.integers(-3, 4, size=(4, 400, 3))
    sizes[..., 0] = rng.choice([1.0, 1.0 + 2.0**-52, 1.0 - 2.0**-53], size=(4, 400))
    vectors = np.minimum(sizes, 1.5)
    vectors[..., 1:] = np.clip(vectors[..., 1:], -(2.0**-27), 2.0**-27)
    yield from ((vectors, True), (vectors, False))


def short_integers(bits):
    """Of equal lengths, of lengths with a common root, and of any."""
    rng = np.random.default_rng(22)
    vectors = rng.integers(-(2**bits), 2**bits, size=(4, 300, 3)).astype(float)
    vectors[1, ::2] = vectors[0, ::2] * [-1, 1, 1]
    vectors[3, ::4] = 2 * vectors[2, ::4] * [-1, 1, 1]
    vectors[(vectors == 0).all(axis=-1)] = 1.0
    yield from ((vectors * scale, None) for scale in (1.0, 2.0**-1050, 2.0**480, 2.0**600))


REGIMES = [
    *((beside_an_axis, s) for s in (1e-8, 1e-14, 1e-17, 1e-18, 1e-20, 1e-22, 1e-26, 1e-40, 1e-90, 1e-200, 1e-310)),
    *((in_line_beside_an_axis, e) for e in (-30, -60, -120, -249, -262, -266, -268, -300, -515, -525, -532)),
    *((closer_than_their_low_parts_tell, rise) for rise in (0.0, 1e-25, 1e-34, 1e-40, 1e-60)),
    (mixed_exponents, 0),
    (one_long_component, 0),
    *((short_integers, bits) for bits in (3, 8, 15, 16, 17)),
]


@pytest.mark.parametrize(("regime", "size"), third_by_day(REGIMES), ids=lambda v: getattr(v, "__name__", str(v)))
@EVERY
def test_no_stage_is_wrong(name, regime, size):
    for vectors, unit in regime(size):
        check(name, vectors, unit)


def test_two_that_are_the_same_turn_nowhere():
    k = np.arange(1.0, 201.0)[:, None]
    assert not check("turn", np.stack([k * [1, 3, 0], (k + 4) * [1, 3, 5], 3 * (k + 4) * [1, 3, 5]]))[1].any()


@pytest.mark.parametrize("steps", [1, 4])
def test_lengths_decide(rng, steps):
    """On a circle about an axis, so small that the squares of the lengths' differences decide the sign."""
    angle = rng.uniform(0, 2 * np.pi, size=(4, 800))
    radius = 2.0 ** rng.integers(-60, -44, size=800) * (1 + 2.0**-30 * rng.normal(size=(4, 800)))
    long = 1 + 2.0**-52 * rng.integers(-steps, steps + 1, size=(4, 800))
    vectors = np.stack([radius * np.cos(angle), radius * np.sin(angle), long], axis=-1)
    shares, _ = check("bubble", vectors, unit=True)
    assert shares["filter"] > 0.5 > shares["double_double"]
    check("bubble", vectors, unit=False)


def scattered(count, seed, low=-300, high=300):
    """Components of any size, each by itself: what the first stages cannot hold."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(4, count, 3)) * 10.0 ** rng.uniform(low, high, size=(4, count, 3))


def towards_the_axes(count, seed):
    """Small components of every size beside a one, along different axes in a row."""
    vectors = scattered(count, seed, -300, -1)
    axis = np.random.default_rng(seed).integers(3, size=(4, count))
    np.put_along_axis(vectors, axis[..., None], 1.0, axis=-1)
    return vectors


@EVERY
@pytest.mark.parametrize("make", [scattered, towards_the_axes])
def test_components_of_any_size(name, make):
    shares, _ = check(name, make(150, 19))
    assert shares["double_double"] > 0.1 or name == "angles"


def test_components_of_any_size_four_on_a_circle():
    """Mirror images, and these moved by one unit in the last place of a component that is far below the others."""
    vectors = towards_the_axes(100, 20)
    vectors[1] = vectors[0] * [-1, 1, 1]
    vectors[3] = vectors[2] * [-1, 1, 1]
    assert not check("bubble", vectors)[1].any()
    vectors[3] = np.where(np.abs(vectors[3]) < 1, np.nextafter(vectors[3], 2), vectors[3])
    assert check("bubble", vectors)[1].all()


@pytest.mark.parametrize("bits", [10, 17, 30, 43, 50])
def test_great_circles_of_integers(rng, bits):
    """Three and four directions of one plane, and one of them moved by one unit."""
    multiples = rng.integers(-(2 ** (bits - 3)), 2 ** (bits - 3), size=(4, 120, 2))
    vectors = (multiples @ np.array([[1, 2, 3], [3, -1, 1]])).astype(float)
    for name in ("turn", "bubble"):
        for scale in (1.0, 2.0**-900, 2.0**400, 3.0 if bits < 50 else 1.0):
            assert not check(name, vectors * scale)[1].any()
    vectors[2] += rng.integers(-1, 2, size=(120, 3))
    for name in ("turn", "bubble"):
        assert (check(name, vectors)[1] != 0).mean() > 0.8


def test_almost_integers(rng):
    """All components but one are multiples of a unit; that one is off by half of it, or by any less."""
    vectors = rng.integers(-(2**15), 2**15, size=(4, 200, 3)).astype(float)
    vectors[0] = vectors[1] + vectors[2]
    vectors[3] = vectors[1] - vectors[2]
    assert not check("bubble", vectors)[1].any()
    vectors[0, :, 0] += 2.0 ** -rng.integers(1, 38, size=200)
    for name in ("turn", "bubble"):
        assert check(name, vectors)[1].any()


@given(*[SPHERE.places(3)] * 4, st.tuples(*[st.integers(-1000, 1000)] * 4))
def test_small_integers(a, b, c, p, exponents):
    """Ties and parallel vectors are frequent here."""
    vectors = np.array([a, b, c, p], dtype=float)[:, None] * 2.0 ** np.array(exponents)[:, None, None]
    for name in PREDICATES:
        check(name, vectors)


NUMBER = st.floats(allow_nan=False, allow_infinity=False)


@given(st.lists(st.tuples(NUMBER, NUMBER, NUMBER).filter(any), min_size=4, max_size=4))
def test_any_doubles(vectors):
    for name in PREDICATES:
        check(name, np.array(vectors)[:, None])


def pythagorean():
    """Rational points of the sphere, as integer vectors and as the nearest doubles to length one."""
    points = [(1, 2, 2), (2, 3, 6), (1, 4, 8), (4, 4, 7), (2, 6, 9), (6, 6, 7), (0, 3, 4)]
    vectors = np.concatenate([np.roll(np.array(points, dtype=float), k, axis=1) for k in range(3)])
    return np.concatenate([vectors * s for s in ([1, 1, 1], [-1, 1, 1], [1, -1, 1], [1, 1, -1], [-1, -1, 1])])


def test_by_number_and_the_tally(rng):
    vectors = np.concatenate([normalised(pythagorean()), on_a_circle(1e-3, 20).reshape(-1, 3)])
    numbers = np.array([rng.choice(len(vectors), 4, replace=False) for _ in range(1500)], dtype=np.int32)
    rows = [np.ascontiguousarray(vectors[numbers[:, k]]) for k in range(4)]
    truth = np.array([of_rays(bubble_ray)(*row) for row in vectors[numbers].tolist()])
    stages = {stage: probe.bubble(*rows, stage=stage) for stage in ("filter", "double_double")}
    for lengths, unit in ((1.0, True), (2.0, False)):
        signs, tally = probe.bubble_numbered(vectors * lengths, numbers, False)
        assert signs.tolist() == truth.tolist()
        assert tally[3] == (truth == 0).sum() > 0
        if unit:
            left = stages["filter"] == OPEN
            assert tally[1:3] == (left.sum(), (left & (stages["double_double"] == OPEN)).sum())


@pytest.mark.parametrize("length", [1e-300, 1e-3, 0.6, 1.0, 1.9, 1e3, 1e300])
@pytest.mark.parametrize("unit", [True, False])
def test_queries_of_any_length(rng, length, unit):
    vectors = on_a_circle(1e-6, 100).reshape(-1, 3) * (1 if unit else 3)
    numbers = np.array([rng.choice(len(vectors), 2, replace=False) for _ in range(300)], dtype=np.int32)
    steps = 1e-16 * rng.normal(size=(300, 3)) * rng.integers(0, 2, size=(300, 1))
    queries = (vectors[numbers[:, 0]] + 3 * vectors[numbers[:, 1]] + steps) / 4 * length
    queries[::3] = vectors[numbers[::3, 0]] * -1
    queries[1::3] = rng.normal(size=(100, 3)) * length
    truth = [of_rays(turn_ray)(*vectors[row].tolist(), q) for row, q in zip(numbers, queries.tolist(), strict=True)]
    assert probe.turn_queries(vectors, numbers, queries).tolist() == truth


def test_the_order_of_directions(rng):
    vectors = np.concatenate(
        [pythagorean(), 7 * pythagorean(), np.eye(3), -np.eye(3), [[1, 1e-200, 0], [1, 0, 5e-324]]]
    )
    vectors = np.concatenate([vectors, normalised(vectors), np.nextafter(normalised(vectors), 1)])
    a, b = vectors[rng.integers(len(vectors), size=(2, 2000))]
    b[::2] = a[::2] * rng.choice([[1, 1, 1], [1, -1, 1], [1, 1, -1], [2, 2, 2]], size=1000)
    truth = [of_rays(compare_directions)(u, v) for u, v in zip(a.tolist(), b.tolist(), strict=True)]
    assert probe.compare_directions(a, b).tolist() == truth
    assert {-1, 0, 1} == set(truth)
    units = np.array([probe.all_unit(u[None]) and probe.all_unit(v[None]) for u, v in zip(a, b, strict=True)])
    assert units.sum() > 100
    assert probe.compare_directions(a[units], b[units], unit=True).tolist() == np.array(truth)[units].tolist()


def test_which_lengths_are_one():
    vectors = normalised(np.random.default_rng(17).normal(size=(1000, 3)))
    assert probe.all_unit(vectors)
    for factor in (1 + 0.6 * 2.0**-49, 1 - 0.6 * 2.0**-49):
        assert probe.all_unit(vectors * factor) is True
    for factor in (1 + 1.2 * 2.0**-49, 1 - 1.2 * 2.0**-49, 0.0, np.nan, np.inf, 1e300):
        assert not any(probe.all_unit(v[None] * factor) for v in vectors)
    assert not probe.all_unit(np.concatenate([vectors, [[0.0, 0.0, 1.0 + 2.0**-48]], vectors]))
