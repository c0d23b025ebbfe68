"""Combinatorics of diagrams: what the kernel makes of triangles, against sorting by angle."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stereodel import _kernel
from stereodel.triangulation import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi
from stereodel.triangulation.diagram import polygons

SQUARE_POINTS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
DIRECTIONS = st.lists(st.tuples(*[st.integers(-2, 2)] * 3).filter(any), min_size=3, max_size=24)
PLACES = st.lists(st.tuples(*[st.integers(0, 4)] * 2), min_size=3, max_size=24)


def listed(offsets, members):
    members = members.tolist()
    return [members[a:b] for a, b in pairwise(offsets.tolist())]


def rotated(cycle):
    start = cycle.index(min(cycle))
    return cycle[start:] + cycle[:start]


@pytest.mark.parametrize("simplices", [[[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]])
def test_a_square_is_one_vertex_whatever_its_diagonal(simplices):
    rows = np.array(simplices, dtype=np.int32)
    across = {0: [[-1, 1, -1], [-1, -1, 0]], 1: [[1, -1, -1], [-1, 0, -1]]}[simplices[0][2] == 3]
    offsets, vertices, neighbors, order, simplex_vertex, rank, sites, row_vertex = _kernel.plane.voronoi(
        SQUARE_POINTS, rows, np.array(across, dtype=np.int32)
    )
    assert listed(offsets, vertices) == [[-1, 0]] * 4
    assert listed(offsets, neighbors) == [[1, 3], [2, 0], [3, 1], [0, 2]]
    assert sorted(order.tolist()) == [0, 1, 2, 3]
    assert simplex_vertex.tolist() == [0, 0]
    assert rank.tolist() == [0, 1]
    assert sites.tolist() == [[0, 1, 2]]
    assert row_vertex.tolist() == [0]
    points, ends = _kernel.voronoi_ridges(offsets, vertices, neighbors, 1)
    assert points.tolist() == [[0, 1], [0, 3], [1, 2], [2, 3]]
    # The ridge between 0 and 1 comes in from below, that between 0 and 3 leaves to the left: site 0 is on the left.
    assert ends.tolist() == [[-1, 0], [0, -1], [-1, 0], [-1, 0]]
    assert polygons(offsets, vertices, neighbors, 1) == [[0, 1, 2, 3]]


def test_two_triangles_that_share_all_edges():
    diagram = SphericalVoronoi(np.eye(3))
    assert diagram.regions == [[0, 1]] * 3
    assert diagram.region_neighbors.tolist() == [2, 1, 0, 2, 1, 0]
    assert polygons(*diagram._cells()) == [[0, 1, 2], [0, 2, 1]]


def expected_numbers(triangulation, around):
    """Vertices in the order of their three lowest sites, and of those with the same first the counterclockwise one."""
    lowest = [sorted(cycle)[:3] for cycle in around]
    turn = [rotated([s for s in cycle if s in low]) != low for cycle, low in zip(around, lowest, strict=True)]
    return sorted(range(len(around)), key=lambda v: (lowest[v], turn[v]))


def check_diagram(triangulation, diagram):
    """Everything that the arrays promise one another, and the triangles."""
    around = polygons(*diagram._cells())
    assert expected_numbers(triangulation, around) == list(range(len(around)))
    assert all(rotated(cycle) == cycle for cycle in around)
    owner = {}
    for t, corners in enumerate(triangulation.simplices.tolist()):
        assert set(corners) <= set(around[diagram.simplex_vertex[t]])
        owner.setdefault(int(diagram.simplex_vertex[t]), []).append(t)
    assert all(len(around[v]) == len(triangles) + 2 for v, triangles in owner.items())
    steps = {}
    cells = list(pairwise(diagram.region_offsets.tolist()))
    for site, (a, b) in enumerate(cells):
        region, beyond = diagram.region_indices[a:b].tolist(), diagram.region_neighbors[a:b].tolist()
        assert len(set(region)) == len(region)
        assert region == rotated(region) if region else site in triangulation.duplicates[:, 0]
        for k in range(len(region)):
            steps[site, beyond[k], region[k]] = region[(k + 1) % len(region)]
            if region[k] >= 0:
                cycle = around[region[k]]
                assert cycle[cycle.index(site) - 1] == beyond[k]
    # Each ridge is passed twice, once in each direction.
    assert all(steps[other, site, end] == start for (site, other, start), end in steps.items())
    ridges = sorted((i, j, start, end) for (i, j, start), end in steps.items() if i < j)
    assert np.column_stack([diagram.ridge_points, diagram.ridge_vertices]).tolist() == [list(r) for r in ridges]


@settings(deadline=None, max_examples=60)
@given(PLACES)
def test_diagrams_of_the_plane_with_ties(points):
    triangulation = PlanarDelaunay(points)
    if triangulation.dimension == 2:
        check_diagram(triangulation, PlanarVoronoi(triangulation))


@settings(deadline=None, max_examples=60)
@given(DIRECTIONS)
def test_diagrams_of_the_sphere_with_ties(points):
    triangulation = SphericalDelaunay(points)
    if triangulation.dimension == 2:
        check_diagram(triangulation, SphericalVoronoi(triangulation))


@pytest.mark.parametrize("diagram", [PlanarVoronoi, SphericalVoronoi])
def test_threads_and_pieces_of_work_do_not_matter(diagram):
    rng = np.random.default_rng(0)
    width = 2 if diagram is PlanarVoronoi else 3
    points = rng.integers(-60, 61, size=(20_000, width)).astype(float)
    points = points[points.any(axis=1)]
    one, two = diagram(points, workers=1), diagram(points, workers=2)
    check_diagram((PlanarDelaunay if width == 2 else SphericalDelaunay)(points), one)
    for name in ("vertices", "region_indices", "region_offsets", "region_neighbors", "ridge_points", "ridge_vertices"):
        assert np.array_equal(getattr(one, name), getattr(two, name)), name
    assert np.array_equal(one.delaunay().simplices, two.delaunay().simplices)


PLANE = PlanarDelaunay, PlanarVoronoi
SPHERE = SphericalDelaunay, SphericalVoronoi


@settings(deadline=None, max_examples=150)
@given(st.one_of(st.tuples(st.just(PLANE), PLACES), st.tuples(st.just(SPHERE), DIRECTIONS)), st.data())
def test_triangles_have_one_order_everywhere(case, data):
    """Of diagrams of points, of a triangulation, and of one that was changed; most vertices have several triangles."""
    (triangulate, diagram_of), points = case
    direct, diagram = triangulate(points), diagram_of(points)
    again = diagram.delaunay()
    assert again.simplices.tolist() == direct.simplices.tolist()
    assert again.neighbors.tolist() == direct.neighbors.tolist()
    direct.remove(data.draw(st.lists(st.integers(0, len(points) - 1), max_size=3)))
    direct.insert(points[:2])
    diagram = diagram_of(direct)
    assert diagram.delaunay().simplices.tolist() == direct.simplices.tolist()
    if direct.dimension == 2:
        centers = direct.circumcenters
        assert diagram.vertices[diagram.simplex_vertex] == pytest.approx(centers, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize(("triangulate", "diagram_of", "width"), [(*PLANE, 2), (*SPHERE, 3)])
def test_the_order_of_many_triangles(triangulate, diagram_of, width, workers):
    rng = np.random.default_rng(1)
    lattice = rng.integers(1, 40, size=(12_000, width)).astype(float)
    for points in (rng.normal(size=(9_000, width)), lattice):
        direct = triangulate(points)
        assert np.array_equal(diagram_of(points, workers=workers).delaunay().simplices, direct.simplices)


def test_an_order_that_is_not_that_of_the_diagram_is_refused():
    diagram = PlanarVoronoi(SQUARE_POINTS)
    arrays, number = (diagram.points, *diagram._cells()), np.int32
    for vertex, rank in (([0], None), ([0, 1], None), ([0, -1], None), ([0, 0], [0, 2]), ([0, 0], [0, -1])):
        with pytest.raises(ValueError, match="simplex_vertex: not that of the diagram"):
            _kernel.plane.delaunay_of(
                *arrays, np.array(vertex, number), None if rank is None else np.array(rank, number)
            )
    with pytest.raises(ValueError, match="same length"):
        _kernel.plane.delaunay_of(*arrays, np.zeros(2, number), np.zeros(1, number))


def test_wrong_arrays_are_refused():
    diagram = SphericalVoronoi(np.vstack([np.eye(3), -np.eye(3)]))
    offsets, vertices, neighbors, count = diagram._cells()
    for wrong in (
        (offsets[:-1], vertices, neighbors, count),
        (offsets, vertices, neighbors[1:], count),
        (offsets, vertices, neighbors, count - 1),
        (offsets, vertices, np.roll(neighbors, 1), count),
        (offsets[::-1].copy(), vertices, neighbors, count),
    ):
        with pytest.raises(ValueError, match=r"not those of a Voronoi diagram|same length"):
            _kernel.sphere.delaunay_of(diagram.points, *wrong, diagram.simplex_vertex)
    for order in ([0, 1, 2, 3, 4, 4], [0, 6], [-1], [0, 1]):
        with pytest.raises(ValueError, match=r"a second time|out of range|each site with entries once"):
            _kernel.sphere.cell_areas(diagram.points, *diagram._cells(), np.array(order, dtype=np.int32))
    with pytest.raises(ValueError, match="out of range"):
        _kernel.sphere.voronoi(np.eye(3), np.array([[0, 1, 3]], dtype=np.int32), np.full((1, 3), -1, dtype=np.int32))
    with pytest.raises(ValueError, match="same length"):
        _kernel.sphere.voronoi(np.eye(3), np.array([[0, 1, 2]], dtype=np.int32), np.zeros((0, 3), dtype=np.int32))
    apart = np.full((8, 3), -1, dtype=np.int32)  # as if each triangle were alone
    with pytest.raises(ValueError, match="neighbors do not fit the simplices"):
        _kernel.sphere.voronoi(diagram.points, SphericalDelaunay(diagram.points).simplices, apart)
    rows = np.array([[0, 1, 2], [0, 2, 1]], dtype=np.int32)
    for place in ([0, 0], [0, 2], [0], [-1, 0]):
        with pytest.raises(ValueError, match=r"a second time|out of range|must be a permutation"):
            _kernel.sphere.circumcenters(np.eye(3), rows, np.array(place, dtype=np.int32))
    with pytest.raises(ValueError, match="out of range"):
        _kernel.sphere.circumcenters(np.eye(3), np.array([[0, 1, 3]], dtype=np.int32))
