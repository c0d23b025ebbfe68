"""The graphs of nearness against their definitions, their nesting, and what must not change them."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay, lonlat_to_xyz
from stereodel.graphs import (
    gabriel_graph,
    minimum_spanning_tree,
    relative_neighborhood_graph,
    urquhart_graph,
)

FROM_THE_INSIDE = (minimum_spanning_tree, relative_neighborhood_graph, urquhart_graph, gabriel_graph)
GRID_POINT = st.tuples(st.integers(-3, 3), st.integers(-3, 3))
DIRECTION = st.tuples(*[st.integers(-2, 2)] * 3).filter(any)


def triangulate(points):
    triangulation = (PlanarDelaunay if points.shape[1] == 2 else SphericalDelaunay)(points)
    check_delaunay(triangulation)
    return triangulation


def pairs(edges):
    assert edges.dtype == np.int32
    assert edges.shape[1:] == (2,)
    assert not edges.flags.writeable
    return list(map(tuple, edges.tolist()))


def prove_nesting(triangulation):
    """Each graph is a part of the next; the last one of the triangulation's edges, if there are triangles."""
    graphs = [set(pairs(graph(triangulation))) for graph in FROM_THE_INSIDE]
    if triangulation.dimension == 2:
        graphs.append(set(pairs(triangulation.edges)))
    assert all(one <= other for one, other in pairwise(graphs))


def prove(points, definitions):
    """All four are what their definitions say, sorted."""
    points = np.asarray(points, dtype=float)
    triangulation, exact = triangulate(points), definitions.Exact(points)
    assert pairs(gabriel_graph(triangulation)) == definitions.gabriel(exact)
    assert pairs(relative_neighborhood_graph(triangulation)) == definitions.relative(exact)
    assert pairs(minimum_spanning_tree(triangulation)) == definitions.spanning_tree(exact)
    if triangulation.dimension == 2:
        assert pairs(urquhart_graph(triangulation)) == definitions.urquhart(exact, triangulation)
    else:
        assert pairs(urquhart_graph(triangulation)) == definitions.gabriel(exact)
    prove_nesting(triangulation)


@given(st.lists(GRID_POINT, min_size=1, max_size=14))
def test_plane_with_ties_and_duplicates(definitions, points):
    prove(points, definitions)


@given(st.lists(DIRECTION, min_size=1, max_size=10))
def test_sphere_with_ties_and_duplicates(definitions, points):
    prove(points, definitions)


def test_awkward_sets_of_the_plane(plane_set, definitions):
    prove(plane_set, definitions)


def test_awkward_sets_of_the_sphere(sphere_set, definitions):
    prove(sphere_set, definitions)


@pytest.mark.parametrize("spread", [1.0, 1e-6, 1e-12, 1e-15])
def test_clusters_on_the_sphere(spread, definitions):
    rng = np.random.default_rng(1)
    points = np.array([0.3, -0.5, 0.8]) + spread * rng.normal(size=(14, 3))
    prove(points, definitions)
    prove(points / np.linalg.norm(points, axis=1)[:, None], definitions)


def test_graticule(definitions):
    lon, lat = np.meshgrid(np.arange(0, 360, 90), [-90, -30, 0, 30])
    prove(lonlat_to_xyz(np.stack([lon, lat], axis=-1).reshape(-1, 2)), definitions)


@pytest.mark.parametrize("size", [3, 8])
def test_uneven_clusters_in_the_plane(size, definitions):
    """Long edges between clusters: the searches in their lunes meet many points."""
    rng = np.random.default_rng(size)
    centres = rng.random((size, 2))
    prove(centres[rng.integers(0, size, 26)] + 1e-3 * rng.normal(size=(26, 2)), definitions)


def test_hub():
    """Points around one: half of the spokes are edges of the Urquhart graph, few have empty lunes."""
    rng = np.random.default_rng(2)
    angle = rng.uniform(0, 2 * np.pi, 3000)
    radius = rng.uniform(1, 1 + 1e-9, 3000)
    points = np.vstack([[0, 0], radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])])
    triangulation = triangulate(points)
    spokes = [np.count_nonzero(graph(triangulation)[:, 0] == 0) for graph in FROM_THE_INSIDE]
    assert spokes[0] == 1
    assert 1 <= spokes[1] <= 6 < 900 < spokes[2] < spokes[3]
    prove_nesting(triangulation)


@pytest.mark.parametrize("width", [2, 3])
@pytest.mark.parametrize("graph", FROM_THE_INSIDE)
def test_order_of_points_and_threads_change_nothing(graph, width):
    rng = np.random.default_rng(3)
    points = rng.integers(-12, 13, size=(600, width)).astype(float)
    points = points[points.any(axis=1)]
    order = rng.permutation(len(points))
    first, second = (PlanarDelaunay if width == 2 else SphericalDelaunay)(points), points[order]

    def places(points, edges):
        return sorted(sorted(points[k].tolist() for k in edge) for edge in edges)

    def unit(points):
        return points / np.gcd.reduce(points.astype(int), axis=1)[:, None] if width == 3 else points

    assert places(unit(points), graph(first)) == places(unit(second), graph(second))
    assert np.array_equal(graph(first), graph(first, workers=3))


@given(st.lists(GRID_POINT, min_size=3, max_size=14, unique=True), st.integers(1, 3))
def test_quarter_turns_change_nothing_that_ties_do_not_decide(points, turns):
    points = np.array(points, dtype=float)
    turned = points @ np.linalg.matrix_power(np.array([[0.0, 1.0], [-1.0, 0.0]]), turns)
    for graph in (gabriel_graph, relative_neighborhood_graph):
        assert pairs(graph(points)) == pairs(graph(turned))


@pytest.mark.parametrize("graph", FROM_THE_INSIDE)
@pytest.mark.parametrize("length", [2.0**-900, 2.0**900])
def test_lengths_of_directions_do_not_matter(graph, length):
    """On a great circle too, where a step may be longer than a third of it."""
    circle = lonlat_to_xyz([(0, 0), (100, 0), (220, 0)])
    for points in (circle, lonlat_to_xyz([(0, 0), (100, 0), (220, 10), (40, 60), (50, -70)])):
        np.testing.assert_array_equal(graph(length * points), graph(points))


def test_points_or_triangulation():
    points = np.random.default_rng(4).normal(size=(50, 3))
    for graph in FROM_THE_INSIDE:
        assert np.array_equal(graph(points), graph(SphericalDelaunay(points)))
    with pytest.raises(ValueError, match="points must have shape"):
        gabriel_graph(np.zeros((4, 5)))
    with pytest.raises(ValueError, match="workers"):
        gabriel_graph(points, workers=0)


def test_after_changes():
    rng = np.random.default_rng(5)
    triangulation = PlanarDelaunay(rng.random((300, 2)))
    triangulation.insert(rng.random((5, 2)))
    triangulation.remove([1, 2, 3])
    for graph in FROM_THE_INSIDE:
        assert np.array_equal(graph(triangulation), graph(triangulation.points))
