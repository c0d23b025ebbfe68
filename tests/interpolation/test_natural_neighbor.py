"""Natural neighbour interpolation, against areas from clipped polygons and from diagrams with and without the query."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import SphericalVoronoi
from stereodel.interpolation import NaturalNeighborInterpolator
from tests.exact import area, fractions, nearer

GRID_POINT = st.tuples(st.integers(-4, 4), st.integers(-4, 4))
INNER_POINT = st.tuples(st.integers(-15, 15), st.integers(-15, 15)).map(lambda p: (p[0] / 8, p[1] / 8))
CORNERS = [(-4, -5), (5, -4), (4, 5), (-5, 4)]


def sibson(points, query):
    """Weights in rational arithmetic; the query must lie within the hull, and be none of the points."""
    exact, (at,) = fractions(points), fractions([query])
    far = Fraction(10) ** 9
    cell = [(-far, -far), (far, -far), (far, far), (-far, far)]
    for p in exact:
        cell = nearer(cell, at, p)
    areas = []
    for p in exact:
        part = cell
        for other in exact:
            part = nearer(part, p, other) if other != p else part
        areas.append(area(part))
    return [a / sum(areas) for a in areas]


@given(st.lists(GRID_POINT, max_size=7, unique=True), INNER_POINT)
def test_weights_are_those_of_exact_areas(points, query):
    """Whole points, many on common circles, within four that keep the query's cell small."""
    points = CORNERS + [p for p in points if max(map(abs, p)) < 4 and p != query]
    found = NaturalNeighborInterpolator(points, np.eye(len(points)))(query)
    assert np.allclose(found, np.array([float(w) for w in sibson(points, query)]), rtol=0, atol=1e-13)


@pytest.mark.parametrize("shift", [0.0, 3.0])
@pytest.mark.parametrize("n", [4, 5, 12, 60])
def test_weights_on_the_sphere_are_the_change_of_the_diagram(n, shift, rng):
    """Areas of Voronoi cells before and after the query became a point; with a shift, of points of a hemisphere."""
    points = rng.normal(size=(n, 3)) + [0.0, 0.0, shift]
    function = NaturalNeighborInterpolator(points, np.eye(n))
    before = SphericalVoronoi(points).areas()
    asked = 0
    for query in rng.normal(size=(200, 3)) + [0.0, 0.0, shift]:
        if function.triangulation.find_simplex(query) >= 0 and asked < 20:
            asked += 1
            after = SphericalVoronoi(np.vstack([points, query])).areas()
            assert np.allclose(function(query), (before - after[:-1]) / after[-1], rtol=0, atol=1e-11)
    assert asked > 3


def test_linear_functions_of_the_plane_far_from_the_origin(rng):
    points = 1e3 + rng.random((200, 2))
    queries = 1e3 + 0.2 + 0.6 * rng.random((100, 2))
    function = NaturalNeighborInterpolator(points, points - 1e3)
    assert np.allclose(function(queries), queries - 1e3, rtol=0, atol=1e-12)
    assert np.allclose(function.gradient(queries), np.eye(2), rtol=0, atol=1e-9)


def test_linear_on_the_hull_of_the_plane():
    function = NaturalNeighborInterpolator([[0, 0], [4, 0], [4, 4], [0, 4], [2, 1]], [0.0, 1.0, 7.0, 3.0, 5.0])
    assert function([[3, 0], [4, 1], [0, 3]]).tolist() == [0.75, 2.5, 2.25]
    assert np.allclose(function([[3, 1e-9], [3, 1e-13], [3, 1e-18], [3, 1e-300]]), 0.75, rtol=0, atol=1e-6)
    assert np.isnan(function.gradient([[3, 0], [2, 1]])).all()
    assert np.isnan(function([3, -1e-300]))


def test_thin_hulls(rng):
    """Circles a million times as large as the set, at its nearly straight sides."""
    x = np.sort(rng.random(60))
    points = np.column_stack([x, 1e-7 * x * (1 - x)])
    points = np.vstack([points, np.column_stack([x, 0.01 + 1e-7 * rng.random(60)])])
    queries = np.column_stack([rng.uniform(0.2, 0.8, 100), rng.uniform(0.002, 0.008, 100)])
    function = NaturalNeighborInterpolator(points, points)
    assert np.allclose(function(queries), queries, rtol=0, atol=1e-8)
