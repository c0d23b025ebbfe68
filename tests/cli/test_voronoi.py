"""`stereodel voronoi` and `stereodel triangulate`: areas of the cells, triangles, and tables in every format."""

import json

import geopandas
import numpy as np
import pytest
from typer.testing import CliRunner

from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay, lonlat_to_xyz
from stereodel.cli import app
from stereodel.cli.options import TABLES
from stereodel.earth import AUTHALIC_RADIUS_KM
from stereodel.io import read_points


@pytest.mark.parametrize(("unit", "whole"), [("km2", 4 * np.pi * AUTHALIC_RADIUS_KM**2), ("sr", 4 * np.pi)])
def test_areas_add_up_to_the_sphere(run, rows, unit, whole):
    table = rows(run("voronoi", "cities.csv", "-o", "-", "--area-unit", unit))
    assert [row["name"] for row in table] == ["Quito", "Lagos", "Ulm", "Kyoto", "Perth"]
    assert sum(float(row[f"area_{unit}"]) for row in table) == pytest.approx(whole, rel=1e-12)


def test_one_point_has_the_whole_earth_and_a_duplicate_nothing(folder, run, rows):
    (folder / "same.csv").write_text("lon,lat\n180,10\n-180,10\n", encoding="utf-8")
    areas = [float(row["area_sr"]) for row in rows(run("voronoi", "same.csv", "-o", "-", "--area-unit", "sr"))]
    assert areas == [pytest.approx(4 * np.pi), 0.0]


def test_plane(folder, run, rows):
    (folder / "plane.csv").write_text("x,y\n0,0\n-2,0\n2,0\n0,2\n0,-2\n", encoding="utf-8")
    areas = [row["area"] for row in rows(run("voronoi", "plane.csv", "--plane", "x", "y", "-o", "-"))]
    assert areas == ["4", "", "", "", ""]
    run("voronoi", "plane.csv", "--plane", "x", "y", "-o", "cells.parquet")
    cells = geopandas.read_parquet(folder / "cells.parquet")
    assert cells.crs is None
    assert cells.geometry[0].area == pytest.approx(4)


@pytest.mark.parametrize("kind", ["geojson", "geojsonl", "parquet", "gpkg", "shp"])
def test_shapes_tile_the_map(folder, run, kind):
    run("voronoi", "cities.csv", "-o", f"cells.{kind}", "--max-segment", 10)
    read = geopandas.read_parquet if kind == "parquet" else geopandas.read_file
    cells = read(folder / f"cells.{kind}")
    assert list(cells.columns) == ["lon", "lat", "row", "name", "people", "area_km2", "geometry"]
    assert cells["name"].tolist() == ["Quito", "Lagos", "Ulm", "Kyoto", "Perth"]
    assert cells.is_valid.all()
    assert sum(shape.area for shape in cells.geometry) == pytest.approx(360 * 180)
    places = read_points("cities.csv").lonlat
    assert cells.contains(geopandas.GeoSeries(geopandas.points_from_xy(*places.T), crs="EPSG:4326")).all()
    if kind == "geojson":  # its RFC wants outer rings counterclockwise, and WGS84 without a member "crs"
        assert "crs" not in json.loads((folder / "cells.geojson").read_text())
        assert all(shape.exterior.is_ccw for shape in cells.explode().geometry)


def test_cells_on_land_and_in_the_polygons_of_a_file(folder, run, rows):
    whole = rows(run("voronoi", "cities.csv", "-o", "-"))
    parts = rows(run("voronoi", "cities.csv", "--clip", "land", "-o", "-"))
    run("voronoi", "cities.csv", "--clip", "land", "-o", "land.gpkg")
    cells = geopandas.read_file(folder / "land.gpkg")
    # Two runs: sums of NumPy 2.0 depend on where in memory the values lie.
    assert [float(row["area_km2"]) for row in parts] == pytest.approx(cells["area_km2"].tolist(), rel=1e-14)
    assert all(0 < float(part["area_km2"]) < float(row["area_km2"]) for part, row in zip(parts, whole, strict=True))
    assert cells["area_km2"].sum() == pytest.approx(1.47e8, rel=0.01)
    square = {"type": "Polygon", "coordinates": [[[9, 47], [11, 47], [11, 49], [9, 49], [9, 47]]]}
    (folder / "square.geojson").write_text(json.dumps(square), encoding="utf-8")
    found = rows(run("voronoi", "cities.csv", "--clip", "square.geojson", "-o", "-"))
    assert [row["name"] for row in found if float(row["area_km2"]) > 0] == ["Ulm"]


def corners(rows, text):
    return np.array([[int(row[name]) for name in row] for row in rows(text)])


def test_triangles_of_the_sphere(folder, run, rows):
    places = rows((folder / "cities.csv").read_text())
    points = lonlat_to_xyz([(float(row["lon"]), float(row["lat"])) for row in places])
    found = corners(rows, run("triangulate", "cities.csv", "-o", "-")) - 1
    assert found.tolist() == SphericalDelaunay(points).simplices.tolist()
    check_delaunay(points, found.astype(np.int32))


def test_edges_in_the_plane(folder, run, rows):
    points = np.random.default_rng(1).integers(0, 9, (20, 2)).astype(float)
    np.savetxt(folder / "grid.csv", points, delimiter=",", header="lon,lat", comments="")  # names of any kind
    found = corners(rows, run("triangulate", "grid.csv", "--plane", "lon", "lat", "--edges", "-o", "-"))
    assert (found - 1).tolist() == PlanarDelaunay(points).edges.tolist()


def test_the_far_side_is_left_out(folder, run, rows):
    (folder / "four.csv").write_text("lon,lat\n0,0\n9,0\n0,9\n3,3\n", encoding="utf-8")
    found = corners(rows, run("triangulate", "four.csv", "-o", "-"))
    assert {frozenset(row) for row in found.tolist()} == {frozenset(row) for row in ((1, 2, 4), (2, 3, 4), (1, 3, 4))}


@pytest.mark.parametrize(
    ("kind", "options", "what"),
    [("geojson", [], "Polygon"), ("parquet", ["--edges"], "LineString"), ("gpkg", ["--edges"], "LineString")],
)
def test_shapes(folder, run, rows, kind, options, what):
    run("triangulate", "cities.csv", "-o", f"out.{kind}", *options)
    read = geopandas.read_parquet if kind == "parquet" else geopandas.read_file
    frame = read(folder / f"out.{kind}")
    found = frame.drop(columns="geometry").to_numpy()
    expected = corners(rows, run("triangulate", "cities.csv", "-o", "-", *options))
    assert sorted(found.tolist()) == sorted(expected.tolist())
    assert frame.is_valid.all()
    assert set(frame.geom_type) <= {what, f"Multi{what}"}
    assert frame.crs.to_epsg() == 4326


@pytest.mark.parametrize("kind", [kind for kind in TABLES if kind != "shp"])
def test_pipes_hold_the_same(folder, run, kind):
    """What one command writes to stdout, the next one reads from stdin."""
    first = CliRunner().invoke(app, ["nearest", "cities.csv", "--of", "cities.csv", "-o", "-", "--format", kind])
    options = ["nearest", "-", "--of", "cities.csv", "-o", "out.csv", "--keep", "people"]
    assert CliRunner().invoke(app, options, input=first.stdout_bytes).exit_code == 0
    found = read_points("out.csv").columns["site_people"].tolist()
    assert sorted(found) == sorted(read_points("cities.csv").columns["people"].tolist())


@pytest.mark.parametrize(
    ("command", "kind"),
    [
        (["voronoi", "plane.csv"], "gpkg"),
        (["triangulate", "plane.csv"], "parquet"),
        (["contour", "plane.csv", "--value", "v", "--levels", "1.5"], "geojson"),
        (["nearest", "plane.csv", "--of", "plane.csv"], "parquet"),
        (["interpolate", "plane.csv", "--value", "v", "--at", "plane.csv"], "gpkg"),
        (["nearest", "plane.csv", "--of", "plane.csv"], "geojson"),
    ],
)
def test_a_plane_keeps_its_coordinate_system(folder, run, command, kind):
    lines = ["e,n,v", "570000,5360000,1", "580000,5360000,2", "575000,5370000,3", "576000,5364000,2"]
    (folder / "plane.csv").write_text("\n".join(lines), encoding="utf-8")
    run(*command, "--plane", "e", "n", "--crs", "EPSG:25832", "-o", f"out.{kind}")
    read = geopandas.read_parquet if kind == "parquet" else geopandas.read_file
    frame = read(folder / f"out.{kind}")
    if kind == "geojson":  # which is in degrees
        assert frame.crs.to_epsg() == 4326
        frame = frame.to_crs("EPSG:25832")
    assert frame.crs.to_epsg() == 25832
    assert 560_000 < frame.total_bounds[0] < 580_000
    assert "--crs is 'EPSG:0'" in run(*command, "--plane", "e", "n", "--crs", "EPSG:0", "-o", "b.gpkg", code=2)


def test_other_endings_of_formats(folder, run):
    run("nearest", "cities.csv", "--of", "cities.csv", "-o", "out.json")
    run("nearest", "cities.csv", "--of", "cities.csv", "-o", "out.geoparquet")
    assert len(read_points("out.json")) == len(read_points("out.geoparquet")) == 5
