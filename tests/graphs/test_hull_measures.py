"""Area and perimeter of hulls, and neighbours of all points, against SciPy and known bodies."""

import numpy as np
import pytest
import scipy.spatial

from stereodel import SphericalDelaunay, solid_angle
from stereodel.graphs import hull, hull_area, hull_perimeter
from tests.spaces import BOTH


def test_measures_of_the_plane_are_those_of_scipy(rng):
    for size in (3, 10, 500):
        points = rng.normal(size=(size, 2)) + [3, -1]
        theirs = scipy.spatial.ConvexHull(points)
        assert hull_area(points) == pytest.approx(theirs.volume, rel=1e-12)
        assert hull_perimeter(points) == pytest.approx(theirs.area, rel=1e-12)


@pytest.fixture
def rng():
    return np.random.default_rng(1)


@pytest.mark.parametrize("angular_radius", [0.01, 30, 60, 89])
def test_a_polygon_of_many_corners_is_nearly_its_cap(angular_radius):
    """On the sphere: the area 2π(1 − cos r), the perimeter 360° sin r."""
    lon = np.arange(0, 360, 0.5)
    points = np.column_stack([lon, np.full_like(lon, 90 - angular_radius)])
    cap = np.radians(angular_radius)
    assert hull_area(lonlat=points) == pytest.approx(4 * np.pi * np.sin(cap / 2) ** 2, rel=1e-4)
    assert hull_perimeter(lonlat=points) == pytest.approx(360 * np.sin(cap), rel=1e-4)


def test_area_is_that_of_the_triangles(rng):
    """Those that are not closing; and that of the corners alone."""
    points = rng.normal(size=(60, 3)) + [0, 0, 4]
    triangulation = SphericalDelaunay(points)
    inner = points[triangulation.simplices[~triangulation.closing]]
    expected = solid_angle(*np.moveaxis(inner, 1, 0)).sum()
    assert hull_area(triangulation) == pytest.approx(expected, rel=1e-13)
    assert hull_area(points[hull(triangulation)]) == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize("points", [[], [[1, 2]], [[0, 0], [3, 4], [0, 0]], [[0, 0], [3, 4], [6, 8]]])
def test_lines_of_the_plane_have_no_area(points):
    longest = max((np.hypot(*p) for p in points), default=0) if len(points) > 1 else 0
    assert hull_area(points) == 0
    assert hull_perimeter(points) == pytest.approx(2 * longest)


def test_arcs_have_no_area():
    arc = [[10, 0], [50, 0], [100, 0]]
    assert hull_area(lonlat=arc) == 0
    assert hull_perimeter(lonlat=arc) == pytest.approx(180)


@BOTH
def test_neighbours_of_points_are_the_ends_of_edges(space, rng):
    points = space.random(rng, 80)
    points[7] = points[3]
    triangulation = space.delaunay(points)
    indptr, indices = triangulation.vertex_neighbor_vertices
    assert indptr.dtype == indices.dtype == np.int32
    found = {(k, other) for k in range(80) for other in indices[indptr[k] : indptr[k + 1]].tolist()}
    edges = {tuple(edge) for edge in triangulation.edges.tolist()}
    assert found == edges | {(b, a) for a, b in edges}
    assert len(indices) == 2 * len(edges)
    assert indptr[8] == indptr[7]
    assert all((np.diff(indices[indptr[k] : indptr[k + 1]]) > 0).all() for k in range(80))
    assert not indices.flags.writeable
    triangulation.remove([0])
    assert len(triangulation.vertex_neighbor_vertices[0]) == 80
