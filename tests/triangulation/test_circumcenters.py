"""Circumcentres against rational arithmetic and several hundred digits: slivers, needles, any size and any ratio."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from mpmath import workdps

from stereodel import _kernel
from tests import sets
from tests.exact import doubles, minus, norm, normal_of
from tests.exact import mp as vector
from tests.spaces import PLANE, SPHERE

ONE = np.arange(3, dtype=np.int32)[None]
FINITE = st.floats(allow_nan=False, allow_infinity=False)
ULP = 2.0**-53


def center_of(space, triangle):
    return space.kernel.circumcenters(np.ascontiguousarray(triangle, dtype=float), ONE)[0]


# The sphere ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [1, 31, 32, 33, 64, 70])
def test_rows_have_the_centres_that_they_have_alone(count):
    # They are taken by blocks; some are needles, which a block leaves to other arithmetic.
    rng = np.random.default_rng(count)
    points = rng.normal(size=(3 * count, 3))
    points[3::15] = points[4::15] * (1 + rng.random((len(points[4::15]), 1)))
    points[3::15, 0] *= 1 + 1e-13
    rows, place = np.arange(3 * count, dtype=np.int32).reshape(-1, 3), rng.permutation(count).astype(np.int32)
    alone = np.array([center_of(SPHERE, points[row]) for row in rows])
    np.testing.assert_array_equal(_kernel.sphere.circumcenters(points, rows), alone)
    np.testing.assert_array_equal(_kernel.sphere.circumcenters(points, rows, place)[place], alone)


def assert_close(triangle, digits, center=None):
    """Length and direction together, within little more than half a unit in the last place; the exact centre."""
    with workdps(digits):
        exact = normal_of(*np.asarray(triangle, dtype=float).tolist())
        center = center_of(SPHERE, triangle) if center is None else center
        assert norm(minus(vector(center), exact)) < 1.3e-16
        return doubles(exact)


@pytest.mark.parametrize("bits", [20, 28, 30, 33, 36, 39, 41, 42, 43, 44, 46, 50, 52, 60])
def test_needles(bits):
    """Two corners 2^-bits apart and one far away, which is the first, the second or the third."""
    rng = np.random.default_rng(bits)
    for turn in range(3):
        for _ in range(4):
            far, near, step = rng.normal(size=(3, 3))
            if bits > 50:  # the step is exact where it is along other axes
                near, step = np.array([1.0, 0.0, 0.0]), step * [0.0, 1.0, 1.0]
            pair = np.array([near, near + step * 2.0**-bits])
            if bits <= 50:
                pair *= rng.uniform(0.5, 2.0, size=(2, 1))
            triangle = np.roll(np.vstack([far, pair]), turn, axis=0) * 2.0 ** rng.integers(-300, 300, size=(3, 1))
            assert_close(triangle, 120)


@pytest.mark.parametrize("bits", range(40, 140, 3))
@pytest.mark.parametrize("bend", [0.0, 0.3, 1.5])
def test_three_close_directions_in_a_row(bits, bend):
    """On a circle that is tangent to the y axis: its tilt is told by what is of third order in their distance."""
    y = np.array([1.0, 3.0, -2.0]) * 2.0**-bits
    triangle = np.column_stack([np.ones(3), y, bend * y * y]) * [[1.3], [1.7], [1.1]]
    exact = assert_close(triangle, 300)
    if bits > 45:  # integers decide, and round each component once
        assert center_of(SPHERE, triangle).tolist() == [x if abs(x) > 1e-290 else 0.0 for x in exact]


def test_a_sliver_of_a_few_units_in_the_last_place():
    """Three directions of the great circle with the normal (1, −2, 1), 2⁻⁵² apart: double-double sees noise alone."""
    assert_close(np.array([1.0, 1, 1]) + np.arange(3)[:, None] * np.array([1, 0, -1]) * 2.0**-52, 60)


@pytest.mark.parametrize("one", sets.of("needle"))
def test_centres_of_a_triangulation_are_those_of_its_triangles(one):
    points = one.drawn(60)
    space = PLANE if points.shape[1] == 2 else SPHERE
    triangulation = space.delaunay(points)
    alone = [center_of(space, corners) for corners in points[triangulation.simplices]]
    assert np.array_equal(triangulation.circumcenters, alone)


def hard_directions(rng):
    kind = rng.integers(7)
    noise = rng.normal(size=(3, 3))
    if kind == 0:  # components of any size
        return noise * 10.0 ** rng.uniform(-300, 300, (3, 3))
    if kind == 1:  # exact zeros and nearly opposite corners
        return rng.integers(-4, 5, (3, 3)) + np.array([[0, 0, 0], [0, 0, 0], [2.0**-48, 0, 0]])
    if kind == 2:  # differences of the least doubles
        return np.array([1.0, 0, 0]) + rng.integers(-5, 6, (3, 3)) * [0, 5e-324, 5e-324]
    if kind == 3:  # one great circle, but for the last bits
        noise[2] = noise[0] * rng.random() + noise[1] * rng.random()
        return noise
    if kind == 4:  # a cluster
        return [1.0, 0.7, 0.3] * rng.integers(1, 9, (3, 1)) + noise * 10.0 ** -rng.uniform(0, 17)
    if kind == 5:  # a cluster of subnormal differences, which lengths that are no powers of two would round
        return np.array([0.7, 0, 0]) * rng.uniform(1, 3, (3, 1)) + noise * [0, 1, 1] * 10.0 ** -rng.uniform(300, 323)
    return np.array([1.0, 0, 0]) + noise * 10.0 ** rng.uniform(-320, -10, (3, 3))


def test_hard_triangles_of_the_sphere(rng):
    for _ in range(150):
        triangle = np.asarray(hard_directions(rng), dtype=float)
        if triangle.any(axis=1).all() and len(set(SPHERE.names(triangle))) == 3:
            assert_close(triangle, 2800)


def test_components_of_a_normal_are_right_in_themselves_where_integers_decide():
    """A great circle nearly in the plane z = 0: its axis leans by less than any difference of unit vectors shows."""
    for lean in (1e-40, 1e-200, 1e-310, 5e-324):
        triangle = np.array([[3.0, 1.0, 0.0], [6.0, 2.0, lean], [1.0, 3.0, lean]])
        assert center_of(SPHERE, triangle).tolist() == assert_close(triangle, 1400)


def test_components_that_are_exactly_zero():
    """Without any product: known at once, whatever the lengths. By cancellation: the lengths tell, to many bits."""
    flat = np.array([[3.0, 1.0, 0.0], [-3.0, -1.0, 0.0], [1.0, 3.0, 0.0]])
    for turn in range(3):
        for axes in ([0, 1, 2], [1, 2, 0], [2, 0, 1]):
            center = center_of(SPHERE, np.roll(flat, turn, axis=0)[:, axes])
            assert np.abs(center).tolist() == np.eye(3)[axes.index(2)].tolist()
    # Mirror images at the plane y = 0, of lengths without a root, around a circle that is nearly flat.
    for lean in (1e-30, 1e-200, 5e-324):
        triangle = np.array([[1.0, 0.0, lean], [-1.0, 2.0, 0.0], [-1.0, -2.0, 0.0]])
        assert center_of(SPHERE, triangle).tolist() == assert_close(triangle, 1400)


@pytest.mark.parametrize("turn", range(3))
def test_equal_directions_have_no_circumcentre(turn):
    triangle = np.roll([[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [1.0, 0.0, 0.0]], turn, axis=0)
    with pytest.raises(ValueError, match=r"^triangles: two corners of the same direction"):
        center_of(SPHERE, triangle)


# The plane -----------------------------------------------------------------------------------------------------------


def exact_center(triangle):
    """Centre and radius squared, as fractions; None for three points on one line."""
    a, b, c = ([Fraction(float(x)) for x in p] for p in triangle)
    d, e = minus(b, a), minus(c, a)
    dd, ee, divisor = d[0] ** 2 + d[1] ** 2, e[0] ** 2 + e[1] ** 2, 2 * (d[0] * e[1] - d[1] * e[0])
    if divisor == 0:
        return None
    offset = (e[1] * dd - d[1] * ee) / divisor, (d[0] * ee - e[0] * dd) / divisor
    return [a[0] + offset[0], a[1] + offset[1]], max(map(abs, offset))


def nearest(number):
    try:
        return float(number)
    except OverflowError:
        return np.inf if number > 0 else -np.inf


def assert_right(triangle):
    """Within half a unit in the last place and a little more, of the centre's larger coordinate or of its radius."""
    exact = exact_center(triangle)
    if exact is None:
        with pytest.raises(ValueError, match=r"^triangles: three corners on one line"):
            center_of(PLANE, triangle)
        return
    center, size = exact
    scale = max(size, *map(abs, center))
    for got, x in zip(center_of(PLANE, triangle).tolist(), center, strict=True):
        if not np.isfinite(got) or abs(x) > Fraction(np.finfo(float).max):
            assert got == nearest(x)
        else:
            assert abs(Fraction(got) - x) <= scale * Fraction(ULP * 1.01) + Fraction(5e-324) / 2


def hard_points(rng):
    kind = rng.integers(7)
    noise = rng.normal(size=(3, 2))
    if kind == 0:  # coordinates of any size
        return noise * 10.0 ** rng.uniform(-320, 300, (3, 2))
    if kind == 1:  # subnormal
        return rng.integers(-9, 10, (3, 2)) * 5e-324
    if kind == 2:  # flat, of any size
        noise[2] = noise[0] + (noise[1] - noise[0]) * rng.random()
        return np.ldexp(noise, rng.integers(-1070, 1000))
    if kind == 3:  # distances of any size
        return noise * 10.0 ** rng.uniform(-320, 300, (3, 1))
    if kind == 4:  # small integers and their multiples
        return rng.integers(-5, 6, (3, 2)) * 10.0 ** rng.integers(-300, 300)
    if kind == 5:  # centres that overflow
        return np.array([[0, 0], [1e200, 5e-324], [2e200, 0]]) * rng.uniform(0.5, 2, (3, 2))
    return noise[0] * (1 + noise * 2.0 ** -rng.integers(1, 53))


def test_hard_triangles_of_the_plane(rng):
    for _ in range(2000):
        assert_right(hard_points(rng)[rng.permutation(3)])


@example((4.87894612224509e-106, 5.821812258650955e-179), (0.0, 323494778360.0), (4.87894612224509e-106, 0.0))
@example((1e-20, 3e-20), (1 / 3, 1 / 3), (2 / 3, 2 / 3))  # double-double cancels
@given(*[st.tuples(FINITE, FINITE)] * 3)
def test_any_triangle_of_the_plane(a, b, c):
    assert_right([a, b, c])


def test_what_integers_decide_is_rounded_once(rng):
    """Flat to the last bits, of a size that doubles hold."""
    for _ in range(200):
        triangle = rng.normal(size=(3, 2))
        triangle[2] = triangle[0] + (triangle[1] - triangle[0]) * rng.random()
        exact = exact_center(triangle)
        if exact is not None:
            assert center_of(PLANE, triangle).tolist() == pytest.approx(
                [nearest(x) for x in exact[0]], rel=2.1 * ULP, abs=0
            )
