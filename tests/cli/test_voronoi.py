"""`stereodel voronoi`: areas of the cells."""

import json

import geopandas
import numpy as np
import pytest

from stereodel import lonlat_to_xyz
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
    radius, height = AUTHALIC_RADIUS_KM, np.diff(lonlat_to_xyz([[0, 47], [0, 49]], latitude="authalic")[:, 2])[0]
    assert float(found[2]["area_km2"]) == pytest.approx(np.radians(2) * height * radius**2, rel=1e-3)
