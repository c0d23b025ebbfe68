"""Diagrams without triangles, on a line or a great circle: against fractions and mpmath, at all scales."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, workdps

from stereodel import PlanarVoronoi, SphericalVoronoi, _kernel
from stereodel.triangulation.diagram import polygons
from tests import sets
from tests.exact import cross, doubles, fractions, minus, turn, unit
from tests.spaces import PLANE, SPHERE


def exact_axis(points, order):
    """Along vertex 0, from all products of neighbours that are less than a half-turn apart."""
    p = fractions(points[order].tolist())
    if len(p) == 2 and not any(cross(*p)):
        shortest = min(range(3), key=lambda k: abs(p[0][k]))
        return unit(cross(p[0], [Fraction(int(k == shortest)) for k in range(3)]))
    products = [cross(p[0], p[1])] if len(p) == 2 else [cross(p[k - 1], p[k]) for k in range(len(p))]
    products = [v for v in products if any(v)]
    k = next(k for k in range(3) if products[0][k])
    # At most one step is longer than a half-turn, and then all others point along the axis.
    return unit(max(([v for v in products if v[k] * s > 0] for s in (-1, 1)), key=len)[0])


def check_circle(points):
    """All that the documents promise of directions of one great circle, at least two different ones."""
    points = np.asarray(points, dtype=float)
    names = SPHERE.names(points).tolist()
    diagram, kept = SphericalVoronoi(points), sorted(map(names.index, set(names)))
    order = _kernel.sphere.flat_order(points).tolist()
    assert sorted(order) == kept
    assert order[0] == kept[0]
    assert len(kept) < 3 or order.index(kept[1]) < order.index(kept[2])
    assert np.array_equal(diagram.vertices[0], -diagram.vertices[1])
    with workdps(700):
        axis = exact_axis(points, order)
        assert diagram.vertices[0].tolist() == pytest.approx(doubles(axis), rel=1e-15, abs=1e-300)
        around = [turn(points[order[0]], points[k], axis) for k in order]
        assert all(a < b for a, b in pairwise(around))
        steps = [b - a for a, b in pairwise([*around, around[0] + 2 * mp.pi])]
        expected = [float(steps[k - 1] + steps[k]) for k in range(len(order))]
    assert diagram.areas()[order] == pytest.approx(expected, rel=1e-15, abs=0)
    assert diagram.areas().sum() == pytest.approx(4 * np.pi, rel=1e-15)
    check_cells(diagram, order, kept)
    centroids = diagram.centroids()
    assert np.isnan(centroids).any(axis=1).tolist() == [k not in order for k in range(len(points))]
    for i, k in enumerate(order):
        p = sets.unit(points[k] / np.abs(points[k]).max())
        quarter = float(steps[i] - steps[i - 1]) / 4
        expected = np.cos(quarter) * p + np.sin(quarter) * np.cross(diagram.vertices[0], p)
        assert centroids[k] == pytest.approx(expected, abs=1e-15)


def check_cells(diagram, order, kept):
    assert diagram.regions == [[0, 1] if k in kept else [] for k in range(len(diagram.points))]
    before = {k: order[i - 1] for i, k in enumerate(order)}
    after = {before[k]: k for k in order}
    assert diagram.region_neighbors.tolist() == [n for k in kept for n in (before[k], after[k])]
    ridges = sorted(tuple(sorted(step)) for step in zip(order, [*order[1:], order[0]], strict=True))
    assert list(map(tuple, diagram.ridge_points.tolist())) == ridges
    assert diagram.simplex_vertex.shape == (0,)
    if len(order) > 2:
        assert polygons(*diagram._cells()) == [order, [order[0], *order[:0:-1]]]


@given(
    st.lists(PLANE.places(3).filter(any), min_size=1, max_size=9),
    st.sampled_from([((1, 0, 0), (0, 1, 0)), ((1, 2, 2), (2, 1, -2)), ((0, 3, 1), (1, 0, 0)), ((-1, 1, 1), (1, 1, 1))]),
)
def test_small_integers_of_a_great_circle(pairs, plane):
    points = np.array(pairs) @ np.array(plane)
    if len(set(SPHERE.names(points).tolist())) > 1:
        check_circle(points)


@pytest.mark.parametrize("gap", [1e-3, 2.0**-10, 2.0**-25, 1e-9, 2.0**-45, 1e-17, 1e-40, 1e-150, 1e-300])
def test_gaps_of_every_size(gap):
    """Directions that get closer and closer, on both sides of a coordinate axis, and one opposite."""
    check_circle([[1, gap, 0], [1, 0, 0], [1, -3 * gap, 0], [-1, 0, 0], [2, 2 * gap, 0], [1, gap * (1 + 2**-50), 0]])
    check_circle([[0, gap, 5], [0, 3 * gap, 5]])
    # Products of very different size; in a plane where no component is zero the axis has them, too.
    check_circle([[1, gap, 0], [1, 1, 0], [gap, 1, 0], [-1, 1, 0]])
    check_circle([[1, 1, 1], [1 + gap, 1, 1], [-1, -1, -1]])


@pytest.mark.parametrize("scale", [1e300, 1e-300, 5e-324])
def test_lengths_of_every_size(scale):
    check_circle([[scale, 0, 0], [1, 1, 0], [0, 1e-200, 0], [-3e200, 7e180, 0]])


def test_components_that_no_double_holds_together():
    """The product of two directions of which one component is 1e-600 of the others."""
    check_circle([[1e300, 1e-300, 0], [1e300, 2e-300, 0], [-1e300, 5e-324, 0]])
    areas = SphericalVoronoi([[1e300, 5e-324, 0], [1e300, 1e-323, 0]]).areas()
    assert areas.tolist() == [2 * np.pi] * 2


@pytest.mark.parametrize(
    ("p", "axis"),
    [
        ([1, 0, 0], [0, 0, 1]),
        ([0, 0, 1], [0, 1, 0]),
        ([0, 0, -2], [0, -1, 0]),
        ([0, 2, 0], [0, 0, -1]),
        ([3, 2, 1], [2, -3, 0]),
        ([3, -1, 2], [-2, 0, 3]),
        ([1, 1, 1], [0, 1, -1]),
    ],
)
def test_an_antipodal_pair_has_the_axis_of_the_reference(p, axis):
    diagram = SphericalVoronoi([p, [-x for x in p]])
    assert diagram.vertices[0] == pytest.approx(np.array(axis) / np.linalg.norm(axis), abs=2e-16)
    assert diagram.ridge_points.tolist() == [[0, 1], [0, 1]]
    check_circle([p, [-2 * x for x in p], p])


def test_none_and_one():
    empty = SphericalVoronoi([])
    assert (empty.vertices.shape, empty.regions, empty.areas().tolist()) == ((0, 3), [], [])
    one = SphericalVoronoi([[0, 3, 4], [0, 6, 8]])
    assert one.vertices.shape == (0, 3)
    assert one.regions == [[], []]
    assert one.areas(radius=2).tolist() == [16 * np.pi, 0]
    assert one.centroids()[0] == pytest.approx([0, 0.6, 0.8], abs=1e-16)
    assert np.isnan(one.centroids()[1]).all()
    assert one.point_region.tolist() == [0, 0]
    assert one.ridge_points.shape == one.ridge_vertices.shape == (0, 2)
    assert one.ridge_arcs() == []


@given(st.lists(st.integers(-4, 4), max_size=9), st.sampled_from([(1, 0), (0, 1), (-2, 3), (1e-320, 1e300)]))
def test_strips(places, step):
    points = np.array(places, dtype=float)[:, None] * np.array(step)
    diagram = PlanarVoronoi(points if len(points) else [])
    kept = [k for k, x in enumerate(places) if x not in places[:k]]
    along = sorted(kept, key=lambda k: tuple(points[k]))
    assert _kernel.plane.flat_order(points.reshape(-1, 2)).tolist() == along
    assert diagram.regions == [[-1] if k in kept else [] for k in range(len(places))]
    assert diagram.region_neighbors.tolist() == [-1] * len(kept)
    assert diagram.ridge_points.tolist() == sorted(sorted(pair) for pair in pairwise(along))
    assert diagram.ridge_vertices.tolist() == [[-1, -1]] * max(len(kept) - 1, 0)
    assert diagram.areas().tolist() == [np.inf if k in kept else 0.0 for k in range(len(places))]
    assert diagram.vertices.shape == (0, 2)
    assert diagram.delaunay().simplices.shape == (0, 3)


@pytest.mark.parametrize("scale", [1.0, 2.0**600, 2.0**-520, 2.0**-536, 2.0**-1060])
@pytest.mark.parametrize("axis", range(3))
def test_order_of_directions_that_differ_by_roundings(axis, scale):
    """Multiples of one vector, rounded: products that agree in double, overflow or underflow."""
    rng = np.random.default_rng(axis)
    pairs = np.outer(rng.uniform(1, 2, 60), [1.0, 0.7]) * scale
    points = np.insert(pairs, axis, 0.0, axis=1)
    slopes = [Fraction(y) / Fraction(x) for x, y in pairs.tolist()]
    kept = [k for k, slope in enumerate(slopes) if slope not in slopes[:k]]
    expected = sorted(kept, key=slopes.__getitem__)
    for checked in (False, True):
        order = _kernel.sphere.flat_order(points, checked).tolist()
        assert order[0] == kept[0]
        assert order.index(kept[1]) < order.index(kept[2])
        start = order.index(expected[0])
        around = order[start:] + order[:start]
        assert around in (expected, [expected[0], *expected[:0:-1]])


def about_one_direction(size):
    """Pairs of every length; one of 53 bits, 2⁻¹⁰⁴ apart."""
    rng = np.random.default_rng(0)
    p, q = rng.integers(1, 9, size=(2, 20, 1)) * [1.0, 3.0, 0.0] + rng.normal(size=(2, 20, 1)) * [0, 0, size]
    p[0], q[0] = [3 * 2.0**50 + 7, 1, 0], [3 * 2.0**51 + 15, 2, 0]
    return p, q


def beside_each_other(size):
    """Around the change from one formula to the other, and far beyond, whatever the lengths."""
    rng = np.random.default_rng(int(-np.log2(size)))
    p = rng.normal(size=(30, 3))
    p[:, 2] = 0.0
    q = p + size * np.column_stack([np.zeros((30, 2)), rng.normal(size=30)])
    q[15:] *= 2.0 ** rng.integers(-300, 300, size=(15, 1)) if size > 1e-100 else 1.0
    return p, q


def closest_integers(bits):
    """Neighbours in a Farey sequence, about 2^(-2 bits) apart, in a plane where no component helps."""
    rng = np.random.default_rng(bits)
    pairs = []
    for _ in range(20):
        c = int(rng.integers(2 ** (bits - 1), 2**bits)) | 1
        d = int(rng.integers(2, c // 2)) * 2 + 1
        if np.gcd(c, d) == 1:
            a = pow(d, -1, c)  # a d = 1 modulo c
            pairs.append(((a, (a * d - 1) // c), (c, d)))
    plane = np.array([[1, 2, 2], [2, 1, -2]], dtype=object)
    return tuple(np.array([np.array(pair[k], dtype=object) @ plane for pair in pairs], dtype=float) for k in (0, 1))


@pytest.mark.parametrize(
    ("make", "size"),
    [
        *((about_one_direction, size) for size in (1e-10, 1e-14, 1e-15, 1e-25, 1e-100)),
        *((beside_each_other, 2.0**-k) for k in (40, 43, 44, 45, 55, 62)),
        *((beside_each_other, size) for size in (1e-20, 1e-60, 1e-300)),
        *((closest_integers, bits) for bits in (18, 20, 21, 22, 23, 25, 28, 31, 36, 42, 48, 50)),
    ],
)
def test_planes_between_close_directions(make, size):
    p, q = make(size)
    with workdps(700):
        for a, b, normal in zip(p.tolist(), q.tolist(), _kernel.sphere.bisector_normals(p, q), strict=True):
            assert normal == pytest.approx(doubles(unit(minus(unit(a), unit(b)))), abs=1.2e-16)
