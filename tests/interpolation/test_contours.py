"""Contours: topology from comparisons alone, orientation, ties, rings on the sphere."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay
from stereodel.interpolation import LinearInterpolator, contours
from tests import sets
from tests.interpolation.known import known

GRID = sets.grid(5, 5)
SMALL_VALUES = st.lists(st.integers(-2, 2).map(float), min_size=25, max_size=25)


def on_hull(triangulation, point):
    hull = triangulation.points[triangulation.convex_hull]
    d, e = hull[:, 1] - hull[:, 0], point - hull[:, 0]
    t = np.clip(np.einsum("ij,ij->i", d, e) / np.einsum("ij,ij->i", d, d), 0, 1)[:, None]
    return np.linalg.norm(e - t * d, axis=1).min() < 1e-12


def test_points_lie_on_the_level_of_the_linear_function(make_points, rng):
    points, values = make_points(rng, 300), rng.random(300)
    function = LinearInterpolator(points, values)
    check_delaunay(function.triangulation)
    for contour in contours(function.triangulation, values, [0.3, 0.7]):
        inner = function(contour.points)
        assert np.allclose(inner[np.isfinite(inner)], contour.level, rtol=0, atol=1e-12)


def test_higher_values_lie_on_the_left(make_points, rng):
    points = make_points(rng, 2000)
    function = LinearInterpolator(points, known(points))
    for contour in contours(points, known(points), np.linspace(-1, 2, 7)):
        start, end = contour.points[:-1], contour.points[1:]
        middle, along = (start + end) / 2, end - start
        left = np.cross(middle, along) if points.shape[1] == 3 else np.column_stack([-along[:, 1], along[:, 0]])
        sides = np.sign(np.einsum("ij,ij->i", function.gradient(middle), left))
        lengths = np.linalg.norm(along, axis=1)
        assert (sides[(lengths > 1e-9) & np.isfinite(sides)] > 0).all()


@given(SMALL_VALUES, st.integers(-2, 2))
def test_ties_neither_break_nor_double_a_contour(values, level):
    """On whole values at whole levels: rings close, ends lie on the hull, and no piece of line is drawn twice."""
    triangulation = PlanarDelaunay(GRID)
    found = contours(triangulation, values, level)
    for contour in found:
        assert len(contour.points) >= 2
        assert (contour.points[1:] != contour.points[:-1]).any(axis=1).all()
        ends = contour.points[[0, -1]]
        assert contour.closed == np.array_equal(*ends) or on_hull(triangulation, ends[0])
        if not contour.closed:
            assert on_hull(triangulation, ends[0])
            assert on_hull(triangulation, ends[1])
    pieces = Counter(
        (tuple(a), tuple(b)) for c in found for a, b in zip(c.points[:-1].tolist(), c.points[1:].tolist(), strict=True)
    )
    assert max(pieces.values(), default=1) == 1


@given(SMALL_VALUES)
def test_a_tie_is_as_a_value_just_above(values):
    """The rule for ties: contours of a level run as those of one a little lower."""
    tied = contours(GRID, values, 0.0)
    lower = contours(GRID, values, -1e-9)
    near = [[tuple(np.round(p, 6) + 0.0) for p in c.points.tolist()] for c in lower]
    merged = [[p for p, q in zip(chain, [None, *chain], strict=False) if p != q] for chain in near]
    assert [[tuple(np.round(p, 6) + 0.0) for p in c.points.tolist()] for c in tied] == [
        chain for chain in merged if len(chain) > 1
    ]


def test_rings_of_the_sphere(rng):
    """A parallel around each pole, counterclockwise around the higher values at the north pole."""
    points = rng.normal(size=(3000, 3))
    heights = points[:, 2] / np.linalg.norm(points, axis=1)
    found = contours(points, heights, [-0.9, 0.0, 0.9])
    assert [c.level for c in found] == [-0.9, 0.0, 0.9]
    for contour in found:
        assert contour.closed
        assert np.array_equal(contour.points[0], contour.points[-1])
        assert np.allclose(np.linalg.norm(contour.points, axis=1), 1.0, rtol=0, atol=1e-15)
        assert np.allclose(contour.points[:, 2], contour.level, atol=0.01)
        turn = np.cross(contour.points[:-1], contour.points[1:])[:, 2].sum()
        assert turn == pytest.approx(2 * np.pi * (1 - contour.level**2), rel=0.02)


def test_a_hemisphere_ends_contours_at_its_hull():
    points = sets.sphere("half").points
    (contour,) = contours(points, points[:, 1], 0.0)
    assert not contour.closed
    hull = SphericalDelaunay(points).convex_hull
    turns = np.cross(points[hull[:, 0]], points[hull[:, 1]])
    assert (np.abs(contour.points[[0, -1]] @ turns.T).min(axis=1) < 1e-15).all()


def test_unknown_values_end_contours(rng):
    values = GRID[:, 0].copy()
    values[12] = np.nan  # in the middle
    found = contours(GRID, values, 1.5)
    assert [c.closed for c in found] == [False, False]
    assert all(np.isfinite(c.points).all() for c in found)


@pytest.mark.parametrize("one", sets.of("flat", "few"))
def test_no_triangles_no_contours(one):
    assert contours(one.points, np.arange(float(len(one.points))), 0.5) == []


def test_large_values():
    (contour,) = contours([[0, 0], [2, 0], [0, 2]], [-1.7e308, 1.7e308, -1.7e308], 0.0)
    assert contour.points.tolist() == [[1.0, 1.0], [1.0, 0.0]]
