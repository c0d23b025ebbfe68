"""GeoDataFrames: rows, columns, options, the plane, lines, contours; and the way back from points."""

import io
import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi, check_delaunay
from stereodel.earth import AUTHALIC_RADIUS_KM
from stereodel.interpolation import contours
from stereodel.io import read_points, to_geodataframe, write
from stereodel.sphere import angular_distance, lonlat_to_xyz
from tests import sets
from tests.examples import examples

SPHERE = sets.sphere("random").drawn(40)
PLANE = sets.plane("random").drawn(40) * (3, 2)
BOUNDS = (0.5, 0.25, 2.5, 1.5)
MESHES = [SphericalVoronoi(SPHERE), SphericalDelaunay(SPHERE), PlanarVoronoi(PLANE), PlanarDelaunay(PLANE)]


def test_columns_of_each_kind():
    kinds = {
        "cells": ["point", "area", "geometry"],
        "triangles": ["triangle", "a", "b", "c", "area", "geometry"],
        "edges": ["a", "b", "length", "geometry"],
        "ridges": ["a", "b", "length", "geometry"],
        "sites": ["point", "geometry"],
    }
    assert {what: list(to_geodataframe(SphericalVoronoi(SPHERE), what=what)) for what in kinds} == kinds
    for mesh, first in zip(MESHES, ("point", "triangle", "point", "triangle"), strict=True):
        assert next(iter(to_geodataframe(mesh))) == first
    for mesh in (SphericalVoronoi([]), SphericalDelaunay(np.zeros((0, 3))), PlanarVoronoi([]), PlanarDelaunay([])):
        assert not any(len(to_geodataframe(mesh, what=what)) for what in kinds)


@pytest.mark.parametrize(
    "points",
    [
        SPHERE,
        PLANE,
        SPHERE * (1, 0, 1),  # strips between the poles of a great circle, whose polygons overlap by rounding
        np.vstack([np.eye(3), -np.eye(3)]),
        lonlat_to_xyz([[0, 90 - 1e-9], [1, 90], [120, 90 - 2e-9], [-100, 90 - 1e-9]]),
    ],
)
def test_dissolved_cells(points):
    """Valid, the same as Shapely's overlay, and nothing of the map is lost; equal values are one, and so are gaps."""
    diagram = (PlanarVoronoi if points.shape[1] == 2 else SphericalVoronoi)(points)
    values = np.array([[1, 1.0, "1", None, float("nan")][k % 5] for k in range(len(points))], dtype=object)
    cells = to_geodataframe(diagram, columns={"v": values})
    found = to_geodataframe(diagram, columns={"v": values, "w": values}, dissolve="v")
    assert list(found) == ["point", "cells", "area", "v", "geometry"]
    assert found.is_valid.all()
    assert found["v"].tolist() == [1, "1", None][: len(found)]
    assert found["point"].tolist() == [0, 2, 3][: len(found)]
    of = [{1: 0, "1": 1, None: 2}[None if value != value else value] for value in cells["v"]]
    assert found["cells"].tolist() == np.bincount(of).tolist()
    for k, shape in enumerate(found.geometry):
        chosen = cells[np.array(of) == k]
        assert found["area"][k] == math.fsum(chosen["area"])
        overlay = shapely.union_all(np.asarray(chosen.geometry))
        assert shapely.area(shapely.symmetric_difference(shape, overlay)) < 1e-9 * shapely.area(overlay)


def test_dissolving_in_a_table_and_by_nothing():
    diagram, columns = SphericalVoronoi(np.vstack([SPHERE[:3], SPHERE[:1]])), {"v": ["a", "b", "a", "c"]}
    stream = io.BytesIO()
    write(stream, diagram, format="csv", columns=columns, dissolve="v", radius=2.0)
    table = [line.split(",") for line in stream.getvalue().decode().split()]
    assert [(row[0], row[1], row[3]) for row in table] == [("point", "cells", "v"), ("0", "2", "a"), ("1", "1", "b")]
    assert float(table[1][2]) == math.fsum(4 * to_geodataframe(diagram)["area"][[0, 2]])
    for options in ({"dissolve": "w"}, {"what": "sites", "dissolve": "v"}):
        for ask in (to_geodataframe, lambda *args, **given: write(io.BytesIO(), *args, format="csv", **given)):
            with pytest.raises(ValueError, match=r"dissolve is .*, but it is for"):
                ask(diagram, columns=columns, **options)


def test_own_columns_follow_their_points():
    points = np.vstack([SPHERE[:4], SPHERE[:2], SPHERE[4:]])
    names = np.array([f"site {k}" for k in range(len(points))])
    frame = to_geodataframe(SphericalVoronoi(points), columns={"name": names})
    assert len(frame) == len(SPHERE)
    assert (frame["name"] == names[frame["point"]]).all()
    assert not set(frame["point"]) & {4, 5}


def test_crs_and_units():
    frame = to_geodataframe(SphericalVoronoi(SPHERE), radius=AUTHALIC_RADIUS_KM)
    assert frame.crs == "EPSG:4326"
    assert frame["area"].sum() == pytest.approx(510065621.7, abs=1)
    assert to_geodataframe(PlanarVoronoi(PLANE), crs="EPSG:3035").crs == "EPSG:3035"
    assert to_geodataframe(PlanarVoronoi(PLANE)).crs is None


def test_lengths():
    frame = to_geodataframe(SphericalDelaunay(SPHERE), what="edges", radius=AUTHALIC_RADIUS_KM)
    a, b = SPHERE[frame["a"]], SPHERE[frame["b"]]
    assert np.allclose(frame["length"], np.radians(angular_distance(a, b)) * AUTHALIC_RADIUS_KM, rtol=1e-14)
    ridges = to_geodataframe(SphericalVoronoi([[0, 0, 1], [0, 0, -1]]), what="ridges")
    assert ridges["length"].tolist() == pytest.approx([np.pi, np.pi])


def test_lines_are_short_steps_along_great_circles():
    triangulation = SphericalDelaunay(SPHERE)
    edges = to_geodataframe(triangulation, what="edges")
    assert edges.is_valid.all()
    assert {"LineString", "MultiLineString"} == set(edges.geom_type)
    for a, b, line in zip(edges["a"], edges["b"], edges.geometry, strict=True):
        normal = np.cross(SPHERE[a], SPHERE[b])
        ends = []
        for part in shapely.get_parts(line):
            xyz = lonlat_to_xyz(shapely.get_coordinates(part))
            assert np.abs(xyz @ normal).max() < 1e-14 * np.linalg.norm(normal) + 1e-15
            assert angular_distance(xyz[:-1], xyz[1:]).max() < 1 + 1e-9
            ends += [xyz[0], xyz[-1]]
        assert angular_distance(ends[0], SPHERE[a]) < 1e-13
        assert angular_distance(ends[-1], SPHERE[b]) < 1e-13
        assert all(angular_distance(*pair) < 1e-13 for pair in zip(ends[1:-1:2], ends[2::2], strict=True))


def test_a_line_over_the_pole_and_along_the_180th_meridian():
    diagram = SphericalVoronoi([[0, 1, 0], [0, -1, 0]])
    lines = to_geodataframe(diagram, what="ridges").geometry
    coordinates = shapely.get_coordinates(lines.values)
    assert set(np.round(coordinates[:, 0], 12)) == {0.0, 180.0}
    assert sum(line.length for line in lines) == pytest.approx(360)


def assert_fills(frame, box):
    area = (box[2] - box[0]) * (box[3] - box[1])
    assert frame.is_valid.all()
    assert frame.geometry.area.sum() == pytest.approx(area, rel=1e-9)
    union = shapely.union_all(frame.geometry.values, grid_size=1e-11)  # GEOS loses cells with corners closer than that
    assert shapely.area(union) == pytest.approx(area, rel=1e-9)
    assert shapely.is_ccw(shapely.get_exterior_ring(shapely.get_parts(frame.geometry.values))).all()


@pytest.mark.parametrize("one", sets.of("plane", without=["sizes"])[1:])
def test_cells_of_the_plane_fill_the_bounds(one):
    """Of those that are asked for, and of the usual ones, which hold all points."""
    points, diagram = one.drawn(60), PlanarVoronoi(one.drawn(60))
    frame = to_geodataframe(diagram, bounds=BOUNDS)
    assert_fills(frame, BOUNDS)
    for point, cell in zip(frame["point"], frame.geometry, strict=True):
        gaps = np.hypot(*(shapely.get_coordinates(cell)[:, None] - points[None]).T).T
        assert (gaps[:, point] <= gaps.min(axis=1) * (1 + 1e-9) + 1e-9).all()
    frame = to_geodataframe(diagram)
    assert_fills(frame, frame.total_bounds)
    left, _, right, _ = frame.total_bounds
    assert left < points[:, 0].min() <= points[:, 0].max() < right
    assert len(frame) == len(np.unique(points, axis=0))


@examples(0.5)
@given(st.lists(st.tuples(st.integers(-3, 6), st.integers(-3, 6)), min_size=1, max_size=12))
def test_cells_of_grid_points_fill_the_bounds(points):
    """Vertices and ridges on the border of the rectangle, cells that it misses, cells that fill it."""
    assert_fills(to_geodataframe(PlanarVoronoi(points), bounds=(0, 0, 3, 2)), (0, 0, 3, 2))


def test_triangles_and_lines_of_the_plane():
    """And cells that share points."""
    assert shapely.coverage_is_valid(to_geodataframe(PlanarVoronoi(PLANE), bounds=BOUNDS).geometry.values)
    triangulation = PlanarDelaunay(PLANE)
    check_delaunay(triangulation.points, triangulation.simplices)
    triangles = to_geodataframe(triangulation)
    assert np.allclose(triangles["area"], triangles.geometry.area, rtol=1e-12)
    hull = shapely.convex_hull(shapely.multipoints(PLANE))
    assert triangles["area"].sum() == pytest.approx(hull.area)
    edges = to_geodataframe(triangulation, what="edges")
    assert (edges[["a", "b"]].to_numpy() == triangulation.edges).all()
    assert np.allclose(edges["length"], edges.geometry.length)
    ridges = to_geodataframe(triangulation, what="ridges", bounds=BOUNDS)
    assert np.allclose(ridges["length"], ridges.geometry.length)


def test_back_from_sites():
    diagram = SphericalVoronoi(SPHERE)
    for latitude in ("spherical", "geodetic", "authalic"):
        sites = to_geodataframe(diagram, what="sites", latitude=latitude)
        table = read_points(sites.to_crs(3857))
        assert angular_distance(lonlat_to_xyz(table.lonlat, latitude=latitude), SPHERE).max() < 1e-11
        assert table.columns["point"].tolist() == list(range(len(SPHERE)))


AXIS = np.array([0.5, 0.3, 0.8])


@pytest.fixture(scope="module")
def sphere():
    rng = np.random.default_rng(3)
    lonlat = np.column_stack([rng.uniform(-180, 180, 3000), np.degrees(np.arcsin(rng.uniform(-1, 1, 3000)))])
    triangulation = SphericalDelaunay.from_lonlat(lonlat)
    return triangulation, contours(triangulation, lonlat_to_xyz(lonlat) @ AXIS, np.linspace(-0.9, 0.9, 10))


def test_lines_of_the_sphere_are_cut_and_lie_where_the_values_are(sphere):
    _, found = sphere
    frame = to_geodataframe(found, max_segment=1)
    assert frame.crs == "EPSG:4326"
    assert frame["level"].tolist() == [contour.level for contour in found]
    assert frame["closed"].all()
    for level, line in zip(frame["level"], frame.geometry, strict=True):
        places = shapely.get_coordinates(line)
        assert np.abs(lonlat_to_xyz(places) @ AXIS - level).max() < 0.01
        for part in shapely.get_parts(line):
            steps = np.abs(np.diff(shapely.get_coordinates(part), axis=0))
            assert steps[:, 0].max() < 180
    # A large ring about the axis goes round a pole and so across the 180th meridian, where it is cut.
    for line in frame.geometry[frame["level"].abs() < 0.5]:
        ends = [part.coords[k] for part in shapely.get_parts(line) for k in (0, -1)]
        assert {abs(lon) for lon, _ in ends} == {180.0}
