"""Which boxes a closed bubble touches: the kernel's answer against exact numbers."""

from fractions import Fraction
from math import isqrt

import numpy as np
import pytest

from stereodel import _kernel
from stereodel._spaces import space_of
from stereodel.interpolation import LinearInterpolator, NaturalNeighborInterpolator
from tests import sets, spaces
from tests.exact import cross, dot, minus

DIGITS = 400
"""Binary ones behind the point, of unit vectors."""
ZERO = 380
"""A form below 2 ** -ZERO is zero: it is off by some 2 ** -395."""


def axis_minima(square, linear, low, high):
    """Times four and the square where that is positive: the form's least values along each axis."""
    if square > 0:
        ends = [(2 * square * low[k] + g, 2 * square * high[k] + g) for k, g in enumerate(linear)]
        return [(max(a, 0) + min(b, 0)) ** 2 - g * g for (a, b), g in zip(ends, linear, strict=True)]
    return [min(s * (square * s + g) for s in (low[k], high[k])) for k, g in enumerate(linear)]


def form(normal, b, c):
    """D and G of differences from the pivot."""
    bb, cc, nb, nc = dot(b, b), dot(c, c), cross(normal, b), cross(normal, c)
    return dot(normal, cross(b, c)), [bb * x - cc * y for x, y in zip(nc, nb, strict=True)]


def touches_in_plane(a, b, c, low, high):
    a, b, c, low, high = ([Fraction(float(x)) for x in p] for p in (a, b, c, low, high))
    square, linear = form((0, 0, 1), [*minus(b, a), 0], [*minus(c, a), 0])
    return sum(axis_minima(square, linear[:2], minus(low, a), minus(high, a))) <= 0


def fixed(x):
    n, d = float(x).as_integer_ratio()
    return (n << DIGITS) // d


def unit(point):
    v = [Fraction(float(x)) for x in point]
    scale = Fraction(4**DIGITS) / dot(v, v)
    return [(1 if x > 0 else -1) * isqrt(int(x * x * scale)) for x in v]


def touches_on_sphere(a, b, c, low, high):
    """In integers, times powers of 2 ** DIGITS: the third for D, the fifth for the form."""
    a, b, c = unit(a), unit(b), unit(c)
    square, linear = form(a, minus(b, a), minus(c, a))
    value = sum(axis_minima(square, linear, minus(map(fixed, low), a), minus(map(fixed, high), a)))
    zero = 1 << (5 * DIGITS - ZERO)
    return value <= (4 * square * zero if square > 0 else zero)


def ask(points, faces, low, high):
    """Which faces may touch one box."""
    space = space_of(points)
    tree = space.box_tree(np.array([low], float), np.array([high], float))
    return space.open_bubbles(points, np.array(faces, np.int32), *tree, np.ones(1, np.int32))[0]


def counterclockwise(points):
    x, y = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    flip = x[:, 0] * y[:, 1] < x[:, 1] * y[:, 0]
    points[flip] = points[flip][:, [0, 2, 1]]
    return points


def test_a_million_pairs_of_integers_in_the_plane(rng):
    """Near the origin and far from it, large and tiny: circles through a corner or along a side of a box are many."""
    for scale, offset in ((1.0, 0.0), (1.0, 2.0**40), (2.0**-300, 2.0**40), (2.0**300, 0.0)):
        corners = counterclockwise(rng.integers(-30, 31, (500, 3, 2)))
        faces = np.arange(1500, dtype=np.int32).reshape(-1, 3)
        b, c = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        square = b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]
        keep = square > 0
        faces, corners, b, c, square = faces[keep], corners[keep], b[keep], c[keep], square[keep]
        bb, cc = (b * b).sum(axis=1), (c * c).sum(axis=1)
        linear = np.column_stack([cc * b[:, 1] - bb * c[:, 1], bb * c[:, 0] - cc * b[:, 0]])
        points = (np.ascontiguousarray(corners.reshape(-1, 2)) + offset) * scale
        faces = np.arange(len(points), dtype=np.int32).reshape(-1, 3)
        touched = 0
        for low in rng.integers(-60, 61, (550, 2)):
            high = low + rng.integers(0, 20, 2)
            ends = [2 * square[:, None] * (x - corners[:, 0]) + linear for x in (low, high)]
            nearest = np.maximum(ends[0], 0) + np.minimum(ends[1], 0)
            truth = (nearest**2 - linear**2).sum(axis=1) <= 0
            assert np.array_equal(ask(points, faces, (low + offset) * scale, (high + offset) * scale), truth)
            touched += truth.sum()
        assert 0.02 < touched / truth.size / 550 < 0.98


def triangles_on_sphere(rng, n, size):
    """Of neighbours `size` radians apart, half of them seen from behind: their bubbles are all but a small one."""
    corners = sets.directions(rng, n)[:, None] + size * rng.normal(size=(n, 3, 3))
    corners = sets.unit(corners)
    corners[::5, 2] = corners[::5, 1] + (corners[::5, 0] - corners[::5, 1]) * 1e-7  # slivers
    return corners


def ball(a, b, c):
    """Centre and radius of a triangle's bubble, rounded."""
    n = a / np.linalg.norm(a)
    b, c = b - a, c - a
    d = n @ np.cross(b, c)
    g = (b @ b) * np.cross(n, c) - (c @ c) * np.cross(n, b)
    return a - g / (2 * d), np.linalg.norm(g) / abs(2 * d), d


def beside(rng, center, radius, outside, size):
    """A box that touches a ball from outside, or from inside, with a corner or a side, but for a few last digits."""
    n = len(center)
    towards = rng.normal(size=n)
    if rng.random() < 0.3:
        towards[rng.integers(n)] = 0.0
    towards /= np.linalg.norm(towards)
    touch = center + radius * towards
    touch += rng.integers(-3, 4, n) * np.spacing(touch)
    far = touch + (1 if outside else -1) * size * np.where(towards == 0, 1, np.sign(towards))
    near = np.where(towards == 0, touch - size, touch)
    return np.minimum(near, far), np.maximum(near, far)


@pytest.mark.parametrize("size", [1.0, 1e-3, 1e-7, 1e-11, 1e-15])
def test_boxes_beside_bubbles_of_the_sphere(rng, size):
    """The answer is that of exact numbers; vectors of other lengths have the same."""
    found, truth = [], []
    for corners in triangles_on_sphere(rng, 150, size):
        with np.errstate(divide="ignore", invalid="ignore"):
            center, radius, d = ball(*corners)
        if not (np.isfinite(center).all() and 0 < radius < 1e6):
            center, radius = corners[0], size
        low, high = beside(rng, center, radius, d > 0, size)
        face = np.array([[0, 1, 2]])
        found.append(ask(corners, face, low, high)[0])
        truth.append(touches_on_sphere(*corners, low, high))
        longer = np.ldexp(corners, rng.integers(-900, 900, (3, 1)))
        assert ask(longer, face, low, high)[0] == found[-1]
    assert found == truth
    assert 0.1 < np.mean(truth) < 0.9


@pytest.mark.parametrize("scale", [1.0, 1e-120, 1e100])
def test_boxes_beside_circles_of_the_plane(rng, scale):
    found, truth = [], []
    for size in 10.0 ** rng.uniform(-12, 3, 400):
        corners = counterclockwise(rng.normal(size=(1, 2)) + size * rng.normal(size=(1, 3, 2)))[0] * scale
        b, c = corners[1:] - corners[0]
        d = 2 * (b[0] * c[1] - b[1] * c[0]) / scale / scale
        bb, cc = b @ b / scale, c @ c / scale
        to_center = np.array([c[1] * bb - b[1] * cc, b[0] * cc - c[0] * bb]) / d / scale
        low, high = beside(rng, corners[0] + to_center, np.linalg.norm(to_center / scale) * scale, True, size * scale)
        found.append(ask(corners, [[0, 1, 2]], low, high)[0])
        truth.append(touches_in_plane(*corners, low, high))
    assert found == truth
    assert 0.1 < np.mean(truth) < 0.9


def test_boxes_beyond_the_range_of_products():
    """Where squares overflow, numbers with exponents of their own decide."""
    points, faces = np.array([[0, 0], [1, 0], [0, 1.0]]), [[0, 1, 2], [1, 2, -1], [2, 0, -1]]
    assert ask(points, faces, [1e200, 1e200], [2e200, 3e250]).tolist() == [False, True, False]
    assert ask(points, faces, [-1e200, 1e-300], [-5e-324, 0.9]).tolist() == [True, False, True]
    assert ask(points, faces, [-1e300, -1e300], [1e300, 1e300]).all()
    assert ask(points * 1e-300, faces, [-2e200, 1], [-1e200, 9e199]).tolist() == [False, False, True]
    assert ask(points, faces, [np.nan, 0], [3, np.inf]).all()


@pytest.mark.parametrize("size", [1.0, 1e-5, 1e-12])
def test_boxes_beside_discs_of_the_sphere(rng, size):
    found, truth = [], []
    for center, rim in triangles_on_sphere(rng, 150, size)[:, :2]:
        low, high = beside(rng, center, np.linalg.norm(rim - center), True, size)
        tree = _kernel.sphere.box_tree(low[None].copy(), high[None].copy())
        disc = center[None].copy(), rim[None].copy()
        found.append(_kernel.sphere.open_discs(*disc, *tree, np.ones(1, np.int32))[0][0])
        q, p = unit(center), unit(rim)
        nearest = [
            max(a, 0) + min(b, 0) for a, b in zip(minus(map(fixed, low), q), minus(map(fixed, high), q), strict=True)
        ]
        truth.append(dot(nearest, nearest) - dot(minus(p, q), minus(p, q)) <= 1 << (2 * DIGITS - ZERO))
    assert found == truth
    assert 0.1 < np.mean(truth) < 0.9


def test_discs_are_closed():
    center, rim = np.array([[0.0, 0.0]] * 3), np.array([[3.0, 4.0], [3.0, 4.0], [3.0, np.nextafter(4, 0)]])
    for turned in (1, -1):
        for low, touched in (([0.0, 5.0], [True, True, False]), ([0.0, np.nextafter(5, 6)], [False] * 3)):
            box = np.sort([np.array(low) * turned, np.array([9.0, 9.0]) * turned], axis=0)
            tree = space_of(center).box_tree(box[:1].copy(), box[1:].copy())
            assert space_of(center).open_discs(center, rim, *tree, np.ones(1, np.int32))[0].tolist() == touched


def test_faces_of_points_that_do_not_matter_are_not_looked_at():
    points = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 1, -1], [2, 3, -1]], np.int32)
    space = space_of(points)
    tree = space.box_tree(np.array([[-9.0, -9.0]]), np.array([[9.0, 9.0]]))
    for wanted, answer in (((1,), [1, 0, 1, 0]), ((3,), [0, 1, 0, 1]), ((0, 2), [1, 1, 1, 1]), ((), [0, 0, 0, 0])):
        mask = np.isin(np.arange(4), wanted)
        is_open, depth = space.open_bubbles(points, faces, *tree, np.ones(1, np.int32), mask)
        assert is_open.astype(int).tolist() == answer
        assert (depth > 0).all() == bool(wanted)
        assert not space.open_bubbles(points, faces, *tree, np.zeros(1, np.int32), mask)[0].any()


@pytest.mark.parametrize("kind", [LinearInterpolator, NaturalNeighborInterpolator])
@spaces.BOTH
def test_a_hidden_point_changes_open_targets_alone(rng, space, kind):
    """That parts agree with all points, on every set, tests/partitioned shows; here, that little else is told open."""
    points, queries, values = space.random(rng, 30), space.random(rng, 40), rng.normal(size=31)
    mesh = space.delaunay(points)
    before, changed, told = kind(mesh, values[:30])(queries), 0, 0
    for hidden in rng.normal(size=(100, 1, space.width)):
        after = kind(space.delaunay(np.concatenate([points, hidden])), values)(queries)
        differs = ~np.isclose(before, after, rtol=1e-9, atol=0, equal_nan=True)
        tree = space.kernel.box_tree(*space.kernel.blocks(hidden, 1)[2:])
        arrays = mesh.points, mesh.simplices, mesh.neighbors, queries
        closing = mesh.closing if space.width == 3 else None
        natural = kind is NaturalNeighborInterpolator
        is_open, _ = space.kernel.open_targets(*arrays, *tree, np.ones(1, np.int32), closing, natural)
        assert not (differs & ~is_open).any()
        changed, told = changed + differs.sum(), told + is_open.sum()
    assert 0.01 * 4000 < changed <= told < 0.6 * 4000
