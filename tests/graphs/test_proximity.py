"""The graphs of nearness against their definitions, their nesting, and what must not change them."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import lonlat_to_xyz
from stereodel.graphs import (
    gabriel_graph,
    hull,
    minimum_spanning_tree,
    relative_neighborhood_graph,
    urquhart_graph,
)
from stereodel.triangulation import delaunay
from tests import sets
from tests.examples import examples
from tests.graphs import definitions
from tests.spaces import BOTH, PLANE, SPHERE, space_of

FROM_THE_INSIDE = (minimum_spanning_tree, relative_neighborhood_graph, urquhart_graph, gabriel_graph)


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


def prove(points):
    """All four are what their definitions say, sorted."""
    points = np.asarray(points, dtype=float)
    triangulation, exact = space_of(points).triangulated(points), definitions.Exact(points)
    assert pairs(gabriel_graph(triangulation)) == definitions.gabriel(exact)
    assert pairs(relative_neighborhood_graph(triangulation)) == definitions.relative(exact)
    assert pairs(minimum_spanning_tree(triangulation)) == definitions.spanning_tree(exact)
    if triangulation.dimension == 2:
        assert pairs(urquhart_graph(triangulation)) == definitions.urquhart(exact, triangulation)
    else:
        assert pairs(urquhart_graph(triangulation)) == definitions.gabriel(exact)
    prove_nesting(triangulation)


@BOTH
@given(data=st.data())
@examples(0.6)
def test_ties_and_duplicates(space, data):
    prove(data.draw(space.points(3 if space is PLANE else 2, min_size=1, max_size=12)))


@pytest.mark.parametrize("one", sets.of("few"))
def test_awkward_sets(one):
    prove(one.points[:18])


@pytest.mark.parametrize("spread", [1.0, 1e-6, 1e-12, 1e-15])
def test_clusters_on_the_sphere(spread):
    points = SPHERE.cluster(np.random.default_rng(1), spread, 14)
    prove(points)
    prove(sets.unit(points))


def test_graticule():
    lon, lat = np.meshgrid(np.arange(0, 360, 90), [-90, -30, 0, 30])
    prove(lonlat_to_xyz(np.stack([lon, lat], axis=-1).reshape(-1, 2)))


@pytest.mark.parametrize("size", [3, 8])
def test_uneven_clusters_in_the_plane(size):
    """Long edges between clusters: the searches in their lunes meet many points."""
    rng = np.random.default_rng(size)
    centres = rng.random((size, 2))
    prove(centres[rng.integers(0, size, 26)] + 1e-3 * rng.normal(size=(26, 2)))


def test_hub(rng):
    """Points around one: half of the spokes are edges of the Urquhart graph, few have empty lunes."""
    angle = rng.uniform(0, 2 * np.pi, 3000)
    radius = rng.uniform(1, 1 + 1e-9, 3000)
    points = np.vstack([[0, 0], radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])])
    triangulation = PLANE.triangulated(points)
    spokes = [np.count_nonzero(graph(triangulation)[:, 0] == 0) for graph in FROM_THE_INSIDE]
    assert spokes[0] == 1
    assert 1 <= spokes[1] <= 6 < 900 < spokes[2] < spokes[3]
    prove_nesting(triangulation)


@BOTH
@pytest.mark.parametrize("graph", FROM_THE_INSIDE)
def test_order_of_points_and_threads_change_nothing(rng, graph, space):
    points = space.lattice(rng, 12, 600)
    order, names = rng.permutation(len(points)), space.names(points)

    def places(names, edges):
        return sorted(map(sorted, names[edges].tolist()))

    triangulation = space.delaunay(points)
    assert places(names, graph(triangulation)) == places(names[order], graph(points[order]))
    assert np.array_equal(graph(triangulation), graph(triangulation, workers=3))


@BOTH
def test_workers_are_those_of_the_triangulation_of_points_too(space, monkeypatch):
    asked = []
    monkeypatch.setattr(delaunay, "thread_count", lambda workers, size: asked.append(workers) or 1)
    points = space.lattice(np.random.default_rng(3), 12, 600)
    for graph in (*FROM_THE_INSIDE, hull):
        graph(points, workers=2)
        graph(space.delaunay(points, workers=3), workers=2)
        assert asked.count(3) == 1  # of the one that was given
        assert set(asked) == {2, 3}
        asked.clear()


@pytest.mark.parametrize("graph", FROM_THE_INSIDE)
@pytest.mark.parametrize("length", [2.0**-900, 2.0**900])
def test_lengths_of_directions_do_not_matter(graph, length):
    """On a great circle too, where a step may be longer than a third of it."""
    circle = lonlat_to_xyz([(0, 0), (100, 0), (220, 0)])
    for points in (circle, lonlat_to_xyz([(0, 0), (100, 0), (220, 10), (40, 60), (50, -70)])):
        np.testing.assert_array_equal(graph(length * points), graph(points))
