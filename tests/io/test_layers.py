"""Rows of maps: what frames hold comes through Arrow into every file, names that are taken, progress, binary."""

import io
import json
import warnings

import geopandas
import numpy as np
import pandas as pd
import pyogrio
import pytest
import shapely

from stereodel import PlanarVoronoi, SphericalVoronoi
from stereodel.io import PointTable, RenamedColumnWarning, read_points, to_geodataframe, write
from stereodel.io.formats import map_rows as module
from stereodel.io.formats import wkb
from stereodel.io.rows_of import rows_of

POINTS = geopandas.points_from_xy([10.0, -78.5, 135.8], [48.4, -0.2, 35.0])


@pytest.mark.parametrize("kind", ["gpkg", "fgb"])
def test_columns_that_only_frames_have(tmp_path, kind):
    columns = {"half": np.array([0.5, np.nan, 2.0], dtype=np.float16), "kind": pd.Categorical(["a", "b", "a"])}
    write(tmp_path / f"a.{kind}", geopandas.GeoDataFrame(columns, geometry=POINTS, crs=4326))
    found = geopandas.read_file(tmp_path / f"a.{kind}")
    found = found.iloc[np.argsort(found.geometry.x)]  # as FlatGeobuf has its own order
    assert found["half"].isna().tolist() == [True, False, False]
    assert found["half"].tolist()[1:] == [0.5, 2.0]
    assert found["kind"].tolist() == ["b", "a", "a"]


@pytest.mark.parametrize("kind", ["gpkg", "fgb", "geojson", "parquet"])
def test_an_index_that_says_something_is_kept(tmp_path, kind):
    frame = geopandas.GeoDataFrame({"v": [1, 2, 3]}, geometry=POINTS, crs=4326)
    named = frame.set_index(pd.Index(["u", "q", "k"], name="code"))
    write(tmp_path / f"a.{kind}", named)
    table = read_points(tmp_path / f"a.{kind}")
    assert sorted(table.columns["code"].tolist()) == ["k", "q", "u"]
    assert read_points(named).columns["code"].tolist() == ["u", "q", "k"]
    assert read_points(named.geometry).columns["code"].tolist() == ["u", "q", "k"]
    back = to_geodataframe(SphericalVoronoi.from_lonlat(read_points(named).lonlat), columns=read_points(named).columns)
    assert back["code"].tolist() == ["u", "q", "k"]
    assert list(read_points(frame[frame["v"] > 1]).columns) == ["v"]


def test_levels_of_an_index_and_names_that_are_taken():
    levels = pd.MultiIndex.from_tuples([("a", 1), ("b", 2), ("c", 3)], names=["v", None])
    frame = geopandas.GeoDataFrame({"v": [7, 8, 9]}, geometry=POINTS, crs=4326).set_index(levels)
    with pytest.warns(UserWarning, match="'v' is written as 'v_1'"):
        columns = read_points(frame).columns
    expected = {"v_1": ["a", "b", "c"], "level_1": [1, 2, 3], "v": [7, 8, 9]}
    assert {name: values.tolist() for name, values in columns.items()} == expected


def test_geometries_beside_others_are_text(tmp_path):
    frame = geopandas.GeoDataFrame({"other": geopandas.GeoSeries(POINTS)}, geometry=POINTS.buffer(1), crs=4326)
    write(tmp_path / "a.gpkg", frame)
    assert geopandas.read_file(tmp_path / "a.gpkg")["other"].tolist() == [point.wkt for point in POINTS]


PARTS = [shapely.Point(1, 2), shapely.LineString([(0, 0), (1, 1)]), shapely.box(0, 0, 1, 1)]
WHOLES = [shapely.MultiPoint(PARTS[:1]), shapely.MultiLineString(PARTS[1:2]), shapely.MultiPolygon(PARTS[2:])]


@pytest.mark.parametrize(("part", "whole"), list(zip(PARTS, WHOLES, strict=True)))
def test_one_kind_of_geometry_in_a_layer(monkeypatch, tmp_path, part, whole):
    """Block by block, also in blocks of geometries of one part alone."""
    monkeypatch.setattr(module, "ROWS", 1)
    frame = geopandas.GeoDataFrame(geometry=[part, whole, None, part], crs=4326)
    write(tmp_path / "a.gpkg", frame)
    assert pyogrio.read_info(tmp_path / "a.gpkg")["geometry_type"] == whole.geom_type
    found = geopandas.read_file(tmp_path / "a.gpkg").geometry
    assert found[2] is None
    assert [found[k].wkt for k in (0, 1, 3)] == [whole.wkt] * 3


@pytest.mark.parametrize("kind", ["parquet", "fgb", "gpkg", "geojson"])
def test_progress_is_the_share_of_rows(tmp_path, monkeypatch, kind):
    monkeypatch.setattr(module, "ROWS", 7)
    told = []
    lonlat = np.random.default_rng(2).uniform(-80, 80, (30, 2))
    write(tmp_path / f"a.{kind}", SphericalVoronoi.from_lonlat(lonlat), progress=lambda *said: told.append(said))
    assert told == [("writing", rows, 30) for rows in (7, 14, 21, 28, 30)]


def test_progress_of_reading(monkeypatch):
    monkeypatch.setattr("stereodel.io.formats.delimited.BLOCK", 100)
    told = []
    read_points(io.StringIO("lon,lat\n" + "1.5,2.5\n" * 1000), progress=lambda *said: told.append(said))
    assert len(told) == 11
    assert told == sorted(told)
    assert 0 < told[0][1] < 0.2 * 8008
    assert told[-1] == ("reading", 8008, 8008)


def test_cells_are_the_same_in_blocks_of_any_size(rng, monkeypatch):
    """And by any number of threads; also where chords are halved, since cells are narrow."""
    lonlat = np.concatenate([rng.uniform(-85, 85, (60, 2)), [[10, 89.9999], [170, 89.9998], [20, 0], [20, 1e-7]]])
    diagram = SphericalVoronoi.from_lonlat(lonlat)
    told = []
    expected = to_geodataframe(diagram)
    monkeypatch.setattr("stereodel.io.maps.tiles.BLOCK", 5)
    monkeypatch.setattr("stereodel.io.maps.tiles.thread_count", lambda workers, size: 3)
    write(io.BytesIO(), diagram, format="geojson")
    found = module.unpacked(rows_of(diagram, progress=lambda *said: told.append(said)).binary)
    assert shapely.equals_identical(found, np.asarray(expected.geometry)).all()
    assert told[-1][1] == told[-1][2] == len(told)
    assert told == sorted(told)


# Names that are taken

LONLAT = np.array([[10.0, 48.4], [-78.5, -0.2], [135.8, 35.0], [115.9, -32.0]])
TAKEN = {
    "lon": [99.0, 98.0, 97.0, 96.0],
    "lon_1": [9, 9, 9, 7],
    "LAT": [88.0, 87.0, 86.0, 85.0],
    "area": [1, 2, 3, 4],
    "point": [5, 6, 7, 8],
    "geometry": ["a", "b", "c", "d"],
    "fid": [4, 4, 4, 4],
    "geom": [1, 1, 1, 2],
    "name": ["Ulm", "Quito", "Kyoto", "Perth"],
    "Name": ["U", "Q", "K", "P"],
}
FORMATS = ("csv", "geojson", "geojsonl", "parquet", "gpkg", "fgb")


def kept(columns):
    """What columns hold, whatever they are called: no name, no order, no type."""
    return sorted(sorted(map(plain, np.asarray(values).tolist())) for values in columns.values())


def plain(value):
    """A value as text, whole numbers without a fraction."""
    return f"{value:g}" if isinstance(value, int | float) else str(value)


@pytest.mark.parametrize("kind", FORMATS)
def test_tables_keep_their_places_and_columns(tmp_path, kind):
    path = tmp_path / f"table.{kind}"
    for columns in (TAKEN, *({name: values} for name, values in TAKEN.items() if kind in ("gpkg", "csv"))):
        table = PointTable(LONLAT, columns)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            write(path, table)
        found = read_points(path, **({"lon": "lon", "lat": "lat"} if kind == "csv" else {}))
        order = np.argsort(found.lonlat[:, 0])  # FlatGeobuf has its own
        assert np.array_equal(found.lonlat[order], LONLAT[np.argsort(LONLAT[:, 0])])
        assert kept(found.columns) == kept(table.columns)
        assert any(each.category is RenamedColumnWarning for each in said) == (list(found.columns) != list(columns))


@pytest.mark.parametrize("kind", FORMATS)
def test_cells_keep_everything(tmp_path, kind):
    path = tmp_path / f"cells.{kind}"
    diagram = SphericalVoronoi.from_lonlat(LONLAT)
    with pytest.warns(RenamedColumnWarning):
        write(path, diagram, columns=TAKEN)
    read = {"csv": lambda path: read_points(path).columns, "parquet": geopandas.read_parquet}
    found = read.get(kind, geopandas.read_file)(path)
    columns = {key: np.asarray(found[key]) for key in found if kind == "csv" or key != "geometry"}
    assert np.allclose(np.sort(columns["area"]), np.sort(diagram.areas()), rtol=1e-12)
    for values in TAKEN.values():
        assert sorted(map(plain, values)) in kept(columns)


def test_cells_of_the_plane_keep_their_coordinates(tmp_path):
    diagram = PlanarVoronoi([[0, 0], [4, 0], [0, 4], [4, 4.5]])
    with pytest.warns(RenamedColumnWarning, match="'x' is written as 'x_1' and 'area' as 'area_1'"):
        write(tmp_path / "cells.csv", diagram, columns={"x": [7, 7, 7, 7], "area": [8, 8, 8, 8]})
    found = (tmp_path / "cells.csv").read_text(encoding="utf-8").splitlines()
    assert found[0] == "x,y,area,x_1,area_1"
    assert found[2].startswith("4,0.0,")


def test_shapefiles_say_which_names_they_cut(tmp_path):
    table = PointTable(LONLAT, {"a_very_long_name": [1, 2, 3, 4], "a_very_long_name_too": [5, 6, 7, 8]})
    with pytest.warns(RenamedColumnWarning, match="as long as the format allows"):
        write(tmp_path / "table.shp", table)
    assert kept(read_points(tmp_path / "table.shp").columns) == kept(table.columns)


SHAPES = """
POINT (1 2); POINT Z (1 2 3); POINT M (1 2 3); POINT ZM (1 2 3 4); LINESTRING (0 0, 1 2.5); LINESTRING Z (0 0 9, 1 2 8)
MULTIPOINT (1 2, 3 4); MULTILINESTRING ((0 0, 1 1), (2 2, 3 3, 4 5)); POLYGON ((0 0, 0 1, 1 1, 0 0))
POLYGON ((0 0, 9 0, 9 9, 0 0), (2 1, 3 1, 3 2, 2 1))
POLYGON Z ((0 0 1, 0 5 2, 5 5 3, 0 0 1), (1 2 1, 2 3 1, 1 3 1, 1 2 1))
MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((5 5, 5 6, 6 6, 5 5), (5.1 5.5, 5.3 5.7, 5.1 5.7, 5.1 5.5)))
GEOMETRYCOLLECTION (POINT (5 5), GEOMETRYCOLLECTION (LINESTRING (0 0, 1 1)), POLYGON ((0 0, 0 1, 1 1, 0 0)))
"""


@pytest.mark.parametrize("text", [line.strip() for line in SHAPES.replace("\n", ";").split(";") if line.strip()])
@pytest.mark.parametrize("decimals", [None, 1])
def test_shapes_in_geojson_are_those_of_shapely(text, decimals):
    """Which turns rings, too, and leaves out measures."""
    shape = shapely.orient_polygons(shapely.from_wkt(text))
    expected = json.loads(shapely.to_geojson(shapely.force_2d(shape) if " M " in text else shape))
    (cell,) = module.packed(np.array([shapely.from_wkt(text)]))
    found, end = wkb.as_geojson(cell, decimals)
    assert found == expected
    assert end == len(cell)


def test_numbers_in_geojson_are_read_back_as_they_were():
    numbers = np.random.default_rng(1).normal(size=(500, 2)) * 10.0 ** np.arange(-250, 250)[:, None]
    found = [wkb.as_geojson(cell)[0]["coordinates"] for cell in wkb.points(numbers)]
    assert json.loads(json.dumps(found)) == numbers.tolist()
    assert wkb.as_geojson(wkb.points(np.array([[1.26, -0.04]]))[0], 1)[0]["coordinates"] == [1.3, -0.0]
