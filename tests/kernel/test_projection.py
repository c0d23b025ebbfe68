"""The kernel's stereographic projection: promised errors against many digits, comparisons against integers."""

import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mpf, workdps

from stereodel import _kernel_probe as probe
from tests import sets
from tests.exact import mp as vector
from tests.exact import norm
from tests.kernel.stages import shares_of
from tests.reference import ray, sign_of_roots
from tests.spaces import SPHERE

POLES = list(itertools.product(range(3), (-1, 1)))
EVERY_POLE = pytest.mark.parametrize(("axis", "sign"), POLES)
SMALL = SPHERE.places(4)


def components(axis, sign):
    """Which components become X and Y."""
    return ((axis + 1) % 3, (axis + 2) % 3) if sign < 0 else ((axis + 2) % 3, (axis + 1) % 3)


def vectors(count=300, seed=0):
    """All over the sphere, close to both poles of each axis, of any length."""
    rng = np.random.default_rng(seed)
    out = rng.normal(size=(count, 3))
    out[::2] *= 10.0 ** rng.uniform(-14, 0, size=(count // 2, 3))
    out[::5] *= 10.0 ** rng.uniform(-200, 200, size=(len(out[::5]), 1))
    return out


def true_image(p, axis, sign):
    p = vector(p)
    w = norm(p) - sign * p[axis]
    return [p[i] / w for i in components(axis, sign)]


def assert_promised(points, axis, sign, digits):
    """Within eight roundoffs, and within 2^-97 as two doubles, or not a number; how many are none."""
    images, fine = probe.project(points, axis, sign), probe.project_double_double(points, axis, sign)
    with workdps(digits):
        for p, image, pair in zip(points.tolist(), images.tolist(), fine.tolist(), strict=True):
            i, j = components(axis, sign)
            if p[i] == p[j] == 0 and sign * p[axis] > 0:
                assert np.isnan(image).all()
                continue
            for k, truth in enumerate(true_image(p, axis, sign)):
                assert np.isnan(image[k]) or abs(mpf(image[k]) - truth) <= 8 * mpf(2) ** -53 * abs(truth)
                value = mpf(pair[2 * k]) + mpf(pair[2 * k + 1])
                assert np.isnan(pair[2 * k]) or abs(value - truth) <= mpf(2) ** -97 * abs(truth)
    return np.isnan(images).mean(), np.isnan(fine).mean()


@EVERY_POLE
def test_the_promised_errors(rng, axis, sign):
    """Where exponents leave the range the answer is NaN or keeps the promise."""
    assert assert_promised(vectors(), axis, sign, 120) == (0, 0)
    sizes = rng.choice([5e-324, 1e-310, 1e-280, 1e-200, 1e-130, 1e-100, 1.0, 1e100, 1e300], size=(200, 3))
    points = sizes * rng.integers(-3, 4, size=(200, 3))
    points[(points == 0).all(axis=1)] = 1.0
    assert 0.05 < assert_promised(points, axis, sign, 1500)[0] < 0.6


@EVERY_POLE
def test_orientation_is_kept(rng, axis, sign):
    """Counterclockwise in the plane is so from outside: minus the bubble test of the three and the pole."""
    a, b, c = rng.normal(size=(3, 300, 3))
    pole = np.zeros((300, 3))
    pole[:, axis] = sign
    images = [probe.project(v, axis, sign) for v in (a, b, c)]
    assert (probe.orient2d(*images) == -probe.bubble(a, b, c, pole)).all()


def projected_order(p, q, axis, sign, coordinate):
    i = components(axis, sign)[coordinate]
    p, q = ray(p), ray(q)
    cross = sign * (q[i] * p[axis] - p[i] * q[axis])
    return sign_of_roots(((p[i], q[3]), (-q[i], p[3]), (cross, 1)))


def line_order(p, axis, sign, coordinate, hi, lo):
    i = components(axis, sign)[coordinate]
    x, y, z, square = ray(p)
    line = Fraction(hi) + Fraction(lo)
    b, e = line.numerator, line.denominator
    return sign_of_roots((((x, y, z)[i] * e + sign * (x, y, z)[axis] * b, 1), (-b, square)))


def check_order(p, q, axis, sign, coordinate):
    truth = [projected_order(u, v, axis, sign, coordinate) for u, v in zip(p.tolist(), q.tolist(), strict=True)]
    return shares_of(np.array(truth), lambda stage: probe.compare_projected(p, q, axis, sign, coordinate, stage=stage))


def check_line(p, axis, sign, coordinate, hi, lo):
    rows = zip(p.tolist(), hi.tolist(), lo.tolist(), strict=True)
    truth = [line_order(v, axis, sign, coordinate, h, low) for v, h, low in rows]
    return shares_of(
        np.array(truth), lambda stage: probe.compare_to_line(p, axis, sign, coordinate, hi, lo, stage=stage)
    )


@EVERY_POLE
@pytest.mark.parametrize("coordinate", [0, 1])
def test_order_of_projected_coordinates(rng, axis, sign, coordinate):
    p = vectors()
    q = p * (1 + 10.0 ** rng.uniform(-17, 0, size=(len(p), 1)) * rng.normal(size=p.shape))
    q[::7] = p[::7] * [[2.0]] * rng.choice([-1, 1], size=(len(q[::7]), 1))
    assert check_order(p, q, axis, sign, coordinate)["double_double"] < 0.3
    assert check_order(p, vectors(seed=4), axis, sign, coordinate)["filter"] < 0.01


@EVERY_POLE
@pytest.mark.parametrize("coordinate", [0, 1])
def test_multiples_of_a_vector_project_alike(axis, sign, coordinate):
    """Exact ties whose roundings differ."""
    p = np.random.default_rng(7).integers(-(2**30), 2**30, size=(200, 3)).astype(float)
    for factor in (3.0, 11.0):
        shares = check_order(p, p * factor, axis, sign, coordinate)
        assert shares["filter"] == shares["double_double"] == 1
    assert (probe.compare_projected(p, 7 * p, axis, sign, coordinate) == 0).all()


@EVERY_POLE
@pytest.mark.parametrize("coordinate", [0, 1])
def test_coordinates_and_lines(rng, axis, sign, coordinate):
    p = vectors()
    fine = probe.project_double_double(p, axis, sign)[:, 2 * coordinate : 2 * coordinate + 2]
    low = fine[:, 1] * (1 + 10.0 ** rng.uniform(-17, 17, size=len(p)) * rng.integers(-1, 2, size=len(p)))
    shares = check_line(p, axis, sign, coordinate, np.ascontiguousarray(fine[:, 0]), low)
    assert 0.9 > shares["filter"] > 0.5 > shares["double_double"] > 0.1
    zeros = np.zeros(len(p))
    assert check_line(p, axis, sign, coordinate, rng.normal(size=len(p)), zeros)["filter"] < 0.01
    check_line(p, axis, sign, coordinate, zeros, zeros)
    check_line(p, axis, sign, coordinate, rng.choice([5e-324, 1e-310, 1e307, 1.0], len(p)), 1e-320 + zeros)


@given(SMALL, SMALL, st.sampled_from(POLES), st.integers(0, 1), st.integers(-1000, 1000), st.integers(-4, 4))
def test_small_integers(p, q, pole, coordinate, exponent, numerator):
    axis, sign = pole
    for v in (p, q):
        if v[axis] * sign > 0 and sum(map(abs, v)) == abs(v[axis]):
            return
    p, q = np.array([p]) * 2.0**exponent, np.array([q], dtype=float)
    check_order(p, q, axis, sign, coordinate)
    check_line(p, axis, sign, coordinate, np.array([numerator / 4]), np.array([0.0]))


@EVERY_POLE
def test_extreme_components(rng, axis, sign):
    sizes = rng.choice([5e-324, 1e-310, 1e-200, 1e-100, 1e-16, 1.0, 1e100, 1e300], size=(2, 150, 3))
    p, q = sizes * rng.choice([-3, -2, -1, 1, 2, 3], size=(2, 150, 3))
    for coordinate in (0, 1):
        check_order(p, q, axis, sign, coordinate)
        check_line(p, axis, sign, coordinate, q[:, 0].copy(), q[:, 1].copy())


@pytest.mark.parametrize("parts", [4.0, 3.0])
def test_rational_points_on_rational_lines(parts):
    """(2X, 2Y, X² + Y² − 1), times anything, projects from the north pole to (Y, X): exact ties."""
    x, y = np.array([[x, y] for x in range(-3, 4) for y in range(-3, 4)], dtype=float).T
    lifted = np.stack([2 * x * parts, 2 * y * parts, x * x + y * y - parts * parts], axis=1)
    x, y = x / parts, y / parts
    first, second = (np.ascontiguousarray(v) for v in np.stack(list(itertools.product(lifted, lifted)), axis=1))
    order = np.sign([b - a for b, a in itertools.product(y, y)])
    assert (probe.compare_projected(first, second, 2, 1, 0) == order).all()
    for k in range(7):
        check_order(lifted, np.roll(lifted, 7 * k, axis=0), 2, 1, 0)
    if parts != 4:
        return
    assert (probe.compare_to_line(lifted, 2, 1, 0, y, 0 * y) == 0).all()
    assert (probe.compare_to_line(lifted, 2, 1, 1, x, 0 * x) == 0).all()
    assert (probe.compare_to_line(lifted, 2, 1, 1, x, 0 * x + 1e-300) == -1).all()


# The first filter: determinants of rounded projected points ----------------------------------------------------------

POLE = (0, -1)


def fours(size, seed, near_ties):
    """Quadruples within `size` of each other, all over the sphere, close to the pole and to its antipode."""
    rng = np.random.default_rng(seed)
    centers = sets.unit(rng.normal(size=(60, 3)))
    centers[:10] = sets.unit([-1, 0, 0] + 10.0 ** rng.uniform(-9, -1, (10, 1)) * rng.normal(size=(10, 3)))
    centers[10:20] = sets.unit([1, 0, 0] + 10.0 ** rng.uniform(-9, -1, (10, 1)) * rng.normal(size=(10, 3)))
    across = sets.unit(np.cross(centers, rng.normal(size=(60, 3))))
    third = np.cross(centers, across)
    angle = 2 * np.pi * rng.random((60, 4)) if near_ties else rng.random((60, 4))
    x, y = (np.cos(angle), np.sin(angle)) if near_ties else rng.normal(size=(2, 60, 4))
    offsets = x[..., None] * across[:, None] + y[..., None] * third[:, None]
    return sets.unit((centers[:, None] + size * offsets).reshape(-1, 3)).reshape(60, 4, 3)


def true_values(quad):
    a, b, c, d = (true_image(p, *POLE) for p in quad)
    turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    rows = [(p[0] - d[0], p[1] - d[1]) for p in (a, b, c)]
    (ax, ay), (bx, by), (cx, cy) = rows
    aa, bb, cc = (x * x + y * y for x, y in rows)
    return turn, aa * (bx * cy - by * cx) + bb * (cx * ay - cy * ax) + cc * (ax * by - ay * bx)


@pytest.mark.parametrize("near_ties", [False, True])
@pytest.mark.parametrize("length", [1.0, 6371.0])
@pytest.mark.parametrize("size", [1.0, 1e-2, 1e-5, 1e-8, 1e-11, 1e-14])
def test_estimates_keep_their_bounds(size, length, near_ties):
    quads = fours(size, 1, near_ties) * length
    estimates = probe.projected_estimates(quads.reshape(-1, 3), *POLE)
    used = 0.0
    with workdps(60):
        for quad, (turn, turn_bound, circle, bound, wide) in zip(quads.tolist(), estimates.tolist(), strict=True):
            true_turn, true_circle = true_values(quad)
            for value, truth, limit in ((turn, true_turn, turn_bound), (circle, true_circle, min(bound, wide))):
                if not np.isnan(value):
                    assert abs(value - truth) <= limit
                    used = max(used, float(abs(value - truth) / limit)) if limit else used
    assert used > 1e-4  # a bound far above all errors would let everything through to the slow stages


@pytest.mark.parametrize("size", [1.0, 1e-3, 1e-6])
def test_what_is_wide_is_decided_without_a_root(size):
    _, _, circle, bound, wide = probe.projected_estimates(fours(size, 2, False).reshape(-1, 3), *POLE)[20:].T
    assert (bound <= wide).all()
    if size > 1e-4:
        assert (np.abs(circle) > wide).mean() > 0.9
    assert (np.abs(circle) > bound).mean() > 0.9


@pytest.mark.parametrize("length", [1.0, 3.0])
def test_projected_points_are_within_eight_roundoffs(length):
    points = np.vstack([fours(s, 3, False).reshape(-1, 3) for s in (1.0, 1e-6, 1e-15)]) * length
    images = probe.projected(points, *POLE)
    with workdps(60):
        for p, image in zip(points.tolist(), images.tolist(), strict=True):
            for value, truth in zip(image, true_image(p, *POLE), strict=True):
                assert np.isnan(value) or abs(value - truth) <= 8 * mpf(2) ** -53 * abs(truth)


def test_coordinates_out_of_range_decide_nothing():
    points = np.array([[1.0, 1e-30, 0.0], [1.0, 0.0, 0.0], [-1.0, 1e-25, 1e-25], [1.0, 1e-20, -1e-20]])
    images = probe.projected(points, *POLE)
    assert np.isnan(images[0, 0])
    assert images[1].tolist() == [0.0, 0.0]
    assert np.isnan(images[2]).all()
    assert np.isfinite(images[3]).all()
    estimates = probe.projected_estimates(points, *POLE)[0]
    assert not (np.abs(estimates[[0, 2]]) > estimates[[1, 3]]).any()
