"""The predicates on arrays: any doubles, shapes, threads, what is refused, flat regions, each stage of orient3d."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import _kernel, in_bubble, incircle, orient2d, orient3d
from stereodel import _kernel_probe as probe
from tests import sets
from tests.exact import fractions, volume
from tests.kernel.stages import OPEN, shares_of
from tests.reference import bubble_ray, incircle_integer, orient2d_integer, ray, sign

PREDICATES = {
    "orient2d": (orient2d, _kernel.plane.turn, 2, "abc"),
    "incircle": (incircle, _kernel.plane.in_circle, 2, "abcd"),
    "orient3d": (orient3d, _kernel.orient3d, 3, "abcd"),
    "in_bubble": (in_bubble, _kernel.sphere.in_circle, 3, "abcp"),
}
EACH = pytest.mark.parametrize("name", PREDICATES)
ORIENT3D = ("all", "filter", "double_double", "exact")


def points_for(name, count, seed=0):
    """Points of which many are in special position."""
    _, _, width, names = PREDICATES[name]
    return np.random.default_rng(seed).integers(1, 6, size=(len(names), count, width)).astype(float)


@EACH
def test_rows_and_single_points_agree(name):
    predicate, kernel, _, _ = PREDICATES[name]
    points = points_for(name, 60)
    expected = [predicate(*row) for row in zip(*(p.tolist() for p in points), strict=True)]
    assert {-1, 0, 1} == set(expected)
    assert all(type(sign) is int for sign in expected)
    assert predicate(*points).tolist() == kernel(*points).tolist() == expected


@EACH
def test_leading_shapes_are_broadcast(name):
    predicate, _, width, _ = PREDICATES[name]
    points = points_for(name, 12, seed=2)
    first = points[0].reshape(4, 3, 1, width)
    result = predicate(first, *(p[:5] for p in points[1:]))
    assert (result.shape, result.dtype) == ((4, 3, 5), np.int8)
    assert result[2, 1].tolist() == predicate(first[2, 1], *(p[:5] for p in points[1:])).tolist()
    assert predicate(first[:0], *(p[0] for p in points[1:])).shape == (0, 3, 1)
    with pytest.raises(ValueError, match="broadcast"):
        predicate(*(p[: 3 + k] for k, p in enumerate(points)))


@EACH
def test_threads_do_not_matter(name):
    _, kernel, _, _ = PREDICATES[name]
    points = points_for(name, 5000, seed=4) + np.random.default_rng(5).random((1, 5000, 1)) * 2.0**-50
    assert (kernel(*points) == kernel(*points, workers=3)).all()


ANY = st.floats(allow_nan=False, allow_infinity=False)
SMALL = st.integers(-3, 3).map(float)


@given(st.lists((st.tuples(ANY, ANY, ANY) | st.tuples(SMALL, SMALL, SMALL)).filter(any), min_size=4, max_size=4))
def test_any_doubles(four):
    flat = [p[:2] for p in four]
    assert orient2d(*flat[:3]) == orient2d_integer(*fractions(four[:3]))
    assert incircle(*flat) == incircle_integer(*fractions(flat))
    assert in_bubble(*four) == bubble_ray(*map(ray, four))
    truth, rows = exact_volume(*four), np.array(four)[:, None]
    assert orient3d(*four) == truth
    shares_of(np.array([truth]), lambda stage: probe.orient3d(*rows, stage=stage), ORIENT3D)


@pytest.mark.parametrize("spread", [1.0, 1e-3, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14])
def test_the_curvature_form_decides_where_flatness_defeats_the_plain_one(rng, spread):
    """Row P6: the filter leaves next to nothing open, while below 1e-8 the plain determinant is a coin."""
    a, b, c, p = rng.normal(size=3) + spread * rng.normal(size=(4, 2000, 3))
    signs = probe.bubble(a, b, c, p, stage="filter" if spread > 1e-14 else "double_double")
    assert (signs == OPEN).mean() < 2e-3
    if spread <= 1e-10:
        a, b, c, p = map(sets.unit, (a, b, c, p))
        plain = np.linalg.det(np.stack([b - a, c - a, p - a], axis=1))
        assert 0.2 < (np.sign(plain) != signs).mean() < 0.8


@pytest.mark.parametrize("bad", [[np.nan, 0], [0, np.inf, 1], [1, 2, 3, 4], "ab", [1j, 0]])
@EACH
def test_bad_points_are_named(name, bad):
    predicate, _, width, names = PREDICATES[name]
    with pytest.raises((ValueError, TypeError), match=rf"^{names[-1]}"):
        predicate(*np.eye(4)[: len(names) - 1, :width] + 1, bad)


# The stages of orient3d ----------------------------------------------------------------------------------------------


def exact_volume(*points):
    return sign(volume(*fractions(points)))


def stages(points):
    return {stage: probe.orient3d(*points, stage=stage) for stage in ORIENT3D}


@pytest.mark.parametrize("exponent", [-1074, -700, -400, -30, 0, 300, 900])
@pytest.mark.parametrize("flatness", [1.0, 1e-8, 1e-14, 1e-17, 1e-25, 1e-33, 0.0])
def test_no_stage_of_orient3d_is_wrong(rng, exponent, flatness):
    a, b, c = rng.normal(size=(3, 25, 3))
    s, t = rng.random((2, 25, 1))
    d = a + (b - a) * s + (c - a) * t + flatness * rng.normal(size=(25, 3))
    points = np.ldexp(np.stack([a, b, c, d]), exponent)
    truth = np.array([exact_volume(*row) for row in zip(*points.tolist(), strict=True)])
    shares_of(truth, lambda stage: probe.orient3d(*points, stage=stage), ORIENT3D)


def test_the_stages_of_orient3d_decide_what_is_theirs(rng):
    points = rng.normal(size=(4, 2000, 3))
    assert (stages(points)["filter"] == OPEN).mean() < 0.001
    flat = points.copy()
    flat[3] = flat[:3].mean(axis=0)
    assert (stages(flat)["filter"] == OPEN).mean() > 0.5
    assert (stages(flat)["double_double"] == OPEN).mean() < 0.01


def test_double_double_leaves_exact_zeros_to_integers(rng):
    """Whole numbers of 40 to 53 bits: the last digits of products of three are rounded away."""
    a, u, v = rng.integers(-(2**40), 2**40, size=(3, 300, 3))
    k, m = rng.integers(-(2**10), 2**10, size=(2, 300, 1))
    signs = stages([p.astype(float) for p in (a, a + u, a + v, a + k * u + m * v)])
    assert not signs["all"].any()
    assert not signs["exact"].any()
    assert set(signs["filter"].tolist()) | set(signs["double_double"].tolist()) <= {0, OPEN}


def test_products_that_underflow_decide_nothing():
    """Beside 2^700 counts what rounds to zero: 3·7 − 4·5 in units of 2^-1076, a quarter of the least double."""
    unit = 2.0**-538
    a, b = np.zeros((1, 3)), np.array([[2.0**700, 2.0**690, 0.0]])
    c, d = unit * np.array([[4.0, 3.0, 4.0]]), unit * np.array([[0.0, 5.0, 7.0]])
    assert exact_volume(*(p[0].tolist() for p in (a, b, c, d))) == 1
    assert [signs[0] for signs in stages((a, b, c, d)).values()] == [1, OPEN, OPEN, 1]
