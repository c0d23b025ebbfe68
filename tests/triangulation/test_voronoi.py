"""Voronoi diagrams of plane and sphere: what their arrays promise, by their defining property, against SciPy."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import spatial

from stereodel import PlanarVoronoi, SphericalVoronoi, _kernel
from stereodel.triangulation.diagram import polygons
from tests import sets
from tests.spaces import BOTH, PLANE, space_of

GRID = sets.grid(5, 4)
INNER = (GRID > 0).all(axis=1) & (GRID < [4, 3]).all(axis=1)
SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
PLAIN = sets.of("sphere", without=("cluster", "needle", "sizes"))
# Half-spaces with rims in planes through the centre, along each axis.
ROLLED = {
    f"{name} {k} {sign}": np.roll(sets.sphere(name).points * [1, 1, sign], k, axis=1)
    for name in ("closed hemisphere", "rim and pole")
    for k in range(3)
    for sign in (1, -1)
}
SHAPES = [pytest.param(case.values[0].drawn(60), id=case.id) for case in PLAIN]
SHAPES = [shape for shape in SHAPES if len(shape.values[0]) > 1]
SHAPES += [pytest.param(points, id=name) for name, points in ROLLED.items()]
SHAPES += [pytest.param(np.array([[1, 0, 0], [-1, 1e-9, 0], [0, 1, 0]]), id="nearly antipodal")]


def rotated(cycle):
    start = cycle.index(min(cycle))
    return cycle[start:] + cycle[:start]


def expected_numbers(around):
    """Vertices in the order of their three lowest sites, and of those with the same first the counterclockwise one."""
    lowest = [sorted(cycle)[:3] for cycle in around]
    turn = [rotated([s for s in cycle if s in low]) != low for cycle, low in zip(around, lowest, strict=True)]
    return sorted(range(len(around)), key=lambda v: (lowest[v], turn[v]))


def check_diagram(triangulation, diagram):
    """Everything that the arrays promise one another, and the triangles."""
    around = polygons(*diagram._cells())
    assert expected_numbers(around) == list(range(len(around)))
    assert all(rotated(cycle) == cycle for cycle in around)
    owner = {}
    for t, corners in enumerate(triangulation.simplices.tolist()):
        assert set(corners) <= set(around[diagram.simplex_vertex[t]])
        owner.setdefault(int(diagram.simplex_vertex[t]), []).append(t)
    assert all(len(around[v]) == len(triangles) + 2 for v, triangles in owner.items())
    steps = {}
    for site, (a, b) in enumerate(pairwise(diagram.region_offsets.tolist())):
        region, beyond = diagram.region_indices[a:b].tolist(), diagram.region_neighbors[a:b].tolist()
        assert len(set(region)) == len(region)
        assert region == rotated(region) if region else site in triangulation.duplicates[:, 0]
        assert region == diagram.regions[site]
        for k in range(len(region)):
            steps[site, beyond[k], region[k]] = region[(k + 1) % len(region)]
            if region[k] >= 0:
                cycle = around[region[k]]
                assert cycle[cycle.index(site) - 1] == beyond[k]
    # Each ridge is passed twice, once in each direction.
    assert all(steps[other, site, end] == start for (site, other, start), end in steps.items())
    ridges = sorted((i, j, start, end) for (i, j, start), end in steps.items() if i < j)
    assert np.column_stack([diagram.ridge_points, diagram.ridge_vertices]).tolist() == [list(r) for r in ridges]


@pytest.mark.parametrize("one", sets.of(without=("flat",)))
def test_arrays_of_every_set(one):
    points = one.points
    triangulation = space_of(points).delaunay(points)
    check_diagram(triangulation, space_of(points).voronoi(triangulation))


@BOTH
@given(data=st.data())
def test_round_trip_with_ties(space, data):
    """Of diagrams of points, of a triangulation, and of one that was changed; most vertices have several triangles."""
    points = data.draw(space.points(2, min_size=1, max_size=24))
    direct, diagram = space.triangulated(points), space.voronoi(points)
    again = diagram.delaunay()
    assert again.simplices.tolist() == direct.simplices.tolist()
    assert again.neighbors.tolist() == direct.neighbors.tolist()
    assert again.duplicates.tolist() == direct.duplicates.tolist()
    if direct.dimension == 2:
        check_diagram(direct, diagram)
    direct.remove(data.draw(st.lists(st.integers(0, len(points) - 1), max_size=3)))
    direct.insert(points[:2])
    diagram = space.voronoi(direct)
    assert diagram.delaunay().simplices.tolist() == direct.simplices.tolist()
    if direct.dimension == 2:
        assert diagram.vertices[diagram.simplex_vertex] == pytest.approx(direct.circumcenters, rel=1e-12, abs=1e-12)


@BOTH
@given(data=st.data())
def test_order_turns_and_tie_rule_do_not_matter(space, data):
    """A quarter turn, or other axes, reverses the order of the points: other diagonals are taken."""
    points = data.draw(space.points(2, min_size=1, max_size=14))
    points = points[np.unique(space.names(points), return_index=True)[1]]
    order = np.array(data.draw(st.permutations(range(len(points)))), dtype=int)
    none = np.eye(space.width)
    turn = data.draw(st.sampled_from([none, np.roll(none, 1, axis=0) * ([1, -1] if space is PLANE else 1)]))
    first, second = space.voronoi(points), space.voronoi(points[order] @ turn)
    assert len(first.vertices) == len(second.vertices)
    edges = {frozenset(pair) for pair in order[second.ridge_points].tolist()}
    assert edges == {frozenset(pair) for pair in first.ridge_points.tolist()}
    assert [len(first.regions[k]) for k in order] == [len(r) for r in second.regions]
    assert first.areas()[order] == pytest.approx(second.areas(), abs=1e-13)


@pytest.mark.parametrize("points", SHAPES)
def test_ridges_are_the_places_with_two_nearest_sites(points):
    """And areas add up to the sphere."""
    diagram, units = SphericalVoronoi(points), sets.unit(points)
    tree = spatial.cKDTree(units)
    for (i, j), arc in zip(diagram.ridge_points[::3].tolist(), diagram.ridge_arcs()[::3], strict=True):
        places = arc.sample(5)[1:4]
        distance = tree.query(places)[0]
        own = np.linalg.norm(places[:, None] - units[[i, j]], axis=2)
        assert own == pytest.approx(np.column_stack([distance, distance]), abs=1e-14)
        if arc.angle_rad > 1e-8:
            left = np.cross(places[1], arc.sample(5)[3] - places[1])
            assert left @ (units[i] - units[j]) > 0
    kept = diagram.point_region == np.arange(len(points))
    for radius in (1.0, 6371.0):
        areas = diagram.areas(radius=radius)
        assert areas.sum() == pytest.approx(4 * np.pi * radius**2, rel=1e-14)
        assert ((areas > 0) == kept).all()


@pytest.mark.parametrize(
    "points",
    [
        *SHAPES,
        *(pytest.param(sets.plane(n).points, id=f"plane {n}") for n in ("random", "lattice", "disc and two far")),
    ],
)
def test_vertices_are_circumcentres_of_their_simplices(points):
    triangulation = space_of(points).delaunay(points)
    diagram = space_of(points).voronoi(triangulation)
    centers = diagram.vertices[diagram.simplex_vertex][:, None]
    if space_of(points) is PLANE:
        distance = np.linalg.norm(points[triangulation.simplices] - centers, axis=2)
        assert np.ptp(distance, axis=1) == pytest.approx(0, abs=1e-9 * distance.max())
        return
    units = sets.unit(points)
    assert np.linalg.norm(diagram.vertices, axis=1) == pytest.approx(1, abs=4e-16)
    height = (units[triangulation.simplices] * centers).sum(axis=2)
    assert np.ptp(height, axis=1) == pytest.approx(0, abs=1e-14)
    assert (height[:, 0] >= (centers[:, 0] @ units.T).max(axis=1) - 1e-14).all()


@pytest.mark.parametrize("shift", [0.0, 2.0**40])
def test_a_grid_has_one_vertex_in_each_square(shift):
    diagram = PlanarVoronoi(GRID + shift)
    assert len(diagram.vertices) == 4 * 3
    ridges = diagram.vertices[diagram.ridge_vertices[(diagram.ridge_vertices >= 0).all(axis=1)]]
    assert (np.linalg.norm(ridges[:, 0] - ridges[:, 1], axis=1) == 1).all()
    assert diagram.areas()[INNER].tolist() == [1.0] * 6
    assert np.isinf(diagram.areas()[~INNER]).all()
    assert diagram.areas(radius=3)[INNER].tolist() == [9.0] * 6


@pytest.mark.parametrize(("points", "vertices", "degree"), [(sets.AXES, 8, 4), (sets.CUBE, 6, 3)])
def test_exactly_cocircular_facets_share_a_vertex(points, vertices, degree):
    diagram = SphericalVoronoi(points * np.arange(1, len(points) + 1)[:, None])
    assert len(diagram.vertices) == vertices
    assert [len(r) for r in diagram.regions] == [degree] * len(points)
    assert len(diagram.ridge_points) == 12
    assert diagram.areas() == pytest.approx(4 * np.pi / len(points), rel=1e-15)


def test_a_ridge_shorter_than_the_doubles_resolve_is_an_arc_and_no_circle():
    diagram = SphericalVoronoi([[1, 1e-25, 0], [0, 1, 0], [0, 0, 1], [2, 2, -1], [-1, -1, -1]])
    lengths = np.linalg.norm(np.diff(diagram.vertices[diagram.ridge_vertices], axis=1)[:, 0], axis=1)
    assert (lengths == 0).sum() == 1
    assert all(arc.angle_rad <= np.pi for arc in diagram.ridge_arcs())
    assert diagram.areas().sum() == pytest.approx(4 * np.pi, rel=1e-14)


@pytest.mark.parametrize("points", [sets.plane("random").points, GRID, GRID[::4] * [1, 0], GRID[[0, 5]]])
def test_segments_are_the_places_with_two_nearest_sites(points):
    diagram = PlanarVoronoi(points)
    bounds = np.array([-0.3, -0.1, 1.2, 0.8]) * points.max()
    segments, ridge = diagram.segments(bounds)
    assert (segments >= bounds[:2] - 1e-12).all()
    assert (segments <= bounds[2:] + 1e-12).all()
    t = np.random.default_rng(0).random((len(segments), 1))
    places = segments[:, 0] * (1 - t) + segments[:, 1] * t
    distance, sites = spatial.cKDTree(points).query(places, k=2)
    assert distance[:, 0] == pytest.approx(distance[:, 1], abs=1e-12)
    assert np.sort(sites, axis=1).tolist() == diagram.ridge_points[ridge].tolist()
    # Site i on the left of start → end, seen from the middle of the two sites.
    i, j = diagram.ridge_points[ridge].T
    along, across = segments[:, 1] - segments[:, 0], points[i] - points[j]
    assert (along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0] > 0).all()


def test_ridges_inside_the_rectangle_end_in_vertices_exactly():
    diagram = PlanarVoronoi(np.random.default_rng(0).random((100, 2)))
    segments, ridge = diagram.segments((-1, -1, 2, 2))
    bounded = (diagram.ridge_vertices[ridge] >= 0).all(axis=1)
    ends = diagram.vertices[diagram.ridge_vertices[ridge[bounded]]]
    inside = ((ends > -1) & (ends < 2)).all(axis=(1, 2))
    assert inside.sum() > 200
    assert (segments[bounded][inside] == ends[inside]).all()


def test_every_visible_ridge_is_there():
    points = np.random.default_rng(8).random((120, 2))
    diagram = PlanarVoronoi(points)
    segments, ridge = diagram.segments((0.2, 0.3, 0.7, 0.6))
    x, y = np.meshgrid(np.linspace(0.2, 0.7, 400), np.linspace(0.3, 0.6, 400), indexing="ij")
    owner = spatial.cKDTree(points).query(np.column_stack([x.ravel(), y.ravel()]))[1].reshape(400, 400)
    changes = {tuple(sorted(p)) for p in zip(owner[1:].ravel(), owner[:-1].ravel(), strict=True) if p[0] != p[1]}
    assert changes <= {tuple(p) for p in diagram.ridge_points[ridge].tolist()}
    assert len(segments) >= len(changes)


def test_a_very_far_vertex_does_not_disturb_the_picture():
    diagram = PlanarVoronoi(np.array([[0, 0], [1, 2.0**-50], [2, 0], [1, 3]]))
    segments, ridge = diagram.segments((-1, -1, 3, 2))
    places = dict(zip(map(tuple, diagram.ridge_points[ridge].tolist()), segments.tolist(), strict=True))
    assert places[0, 1] == [pytest.approx([0.5, -1.0]), pytest.approx([0.5, 1.5], abs=1e-12)]


def test_a_cell_with_a_vertex_at_infinity_has_no_finite_area():
    diagram = PlanarVoronoi([[-1e200, -1e200], [0, 5e-324], [1e200, 1e200], [-1e200, 1e200]])
    assert -1 not in diagram.regions[1]
    assert diagram.areas().tolist() == [np.inf] * 4


@BOTH
def test_duplicates_have_empty_regions_and_arrays_are_kept(space):
    points = np.vstack([GRID[:6], GRID[:2]]) if space is PLANE else np.vstack([sets.AXES, sets.AXES[:2] * 5])
    diagram = space.voronoi(points)
    points[0] = 9
    assert diagram.regions[6:] == [[], []]
    assert diagram.point_region.tolist() == [0, 1, 2, 3, 4, 5, 0, 1]
    assert diagram.areas()[6:].tolist() == [0, 0]
    assert diagram.region_offsets.tolist()[-3:] == [len(diagram.region_indices)] * 3
    assert (diagram.points[0] < 2).all()
    for array in (diagram.vertices, diagram.ridge_points):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


@BOTH
@pytest.mark.parametrize("kind", ["lattice", pytest.param("random", marks=pytest.mark.thorough)])
def test_threads_and_pieces_of_work_do_not_matter(rng, space, kind):
    points = space.lattice(rng, 40, 12_000) if kind == "lattice" else space.random(rng, 9000)
    direct, one, two = space.delaunay(points), space.voronoi(points, workers=1), space.voronoi(points, workers=2)
    check_diagram(direct, one)
    for name in ("vertices", "region_indices", "region_offsets", "region_neighbors", "ridge_points", "ridge_vertices"):
        assert np.array_equal(getattr(one, name), getattr(two, name)), name
    assert np.array_equal(one.delaunay().simplices, direct.simplices)
    assert np.array_equal(two.delaunay().simplices, direct.simplices)


# The kernel's arrays --------------------------------------------------------------------------------------------------


def listed(offsets, members):
    members = members.tolist()
    return [members[a:b] for a, b in pairwise(offsets.tolist())]


@pytest.mark.parametrize(
    ("simplices", "across"),
    [([[0, 1, 2], [0, 2, 3]], [[-1, 1, -1], [-1, -1, 0]]), ([[0, 1, 3], [1, 2, 3]], [[1, -1, -1], [-1, 0, -1]])],
)
def test_a_square_is_one_vertex_whatever_its_diagonal(simplices, across):
    offsets, vertices, neighbors, order, simplex_vertex, rank, sites, row_vertex = _kernel.plane.voronoi(
        SQUARE, np.array(simplices, dtype=np.int32), np.array(across, dtype=np.int32)
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


def test_an_order_that_is_not_that_of_the_diagram_is_refused():
    diagram, number = PlanarVoronoi(SQUARE), np.int32
    arrays = diagram.points, *diagram._cells()
    for vertex, rank in (([0], None), ([0, 1], None), ([0, -1], None), ([0, 0], [0, 2]), ([0, 0], [0, -1])):
        ranks = None if rank is None else np.array(rank, number)
        with pytest.raises(ValueError, match="simplex_vertex: not that of the diagram"):
            _kernel.plane.delaunay_of(*arrays, np.array(vertex, number), ranks)
    with pytest.raises(ValueError, match="same length"):
        _kernel.plane.delaunay_of(*arrays, np.zeros(2, number), np.zeros(1, number))
