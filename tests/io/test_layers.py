"""Layers of maps: what frames hold comes through Arrow into every file, and progress is told truly."""

import io

import geopandas
import numpy as np
import pandas as pd
import pyogrio
import pytest
import shapely

from stereodel import SphericalVoronoi
from stereodel.io import from_geodataframe, read_points, to_geodataframe, write
from stereodel.io.formats import map_rows as module
from stereodel.io.formats.map_rows import MapRows

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
    assert from_geodataframe(named).columns["code"].tolist() == ["u", "q", "k"]
    assert from_geodataframe(named.geometry).columns["code"].tolist() == ["u", "q", "k"]
    back = to_geodataframe(
        SphericalVoronoi.from_lonlat(from_geodataframe(named).lonlat), columns=from_geodataframe(named).columns
    )
    assert back["code"].tolist() == ["u", "q", "k"]
    assert list(from_geodataframe(frame[frame["v"] > 1]).columns) == ["v"]


def test_levels_of_an_index_and_names_that_are_taken():
    levels = pd.MultiIndex.from_tuples([("a", 1), ("b", 2), ("c", 3)], names=["v", None])
    frame = geopandas.GeoDataFrame({"v": [7, 8, 9]}, geometry=POINTS, crs=4326).set_index(levels)
    with pytest.warns(UserWarning, match="'v' is written as 'v_1'"):
        columns = from_geodataframe(frame).columns
    assert {name: values.tolist() for name, values in columns.items()} == {
        "v_1": ["a", "b", "c"],
        "level_1": [1, 2, 3],
        "v": [7, 8, 9],
    }


def test_geometries_beside_others_are_text(tmp_path):
    frame = geopandas.GeoDataFrame({"other": geopandas.GeoSeries(POINTS)}, geometry=POINTS.buffer(1), crs=4326)
    write(tmp_path / "a.gpkg", frame)
    assert geopandas.read_file(tmp_path / "a.gpkg")["other"].tolist() == [point.wkt for point in POINTS]


def test_one_kind_of_geometry_in_a_layer(monkeypatch, tmp_path):
    """Block by block, also in blocks of geometries of one part alone."""
    monkeypatch.setattr(module, "ROWS", 1)
    lines = np.array([shapely.LineString([(0, 0), (1, 1)]), shapely.MultiLineString([[(0, 0), (1, 0)]]), None])
    layer = MapRows({}, module.packed(np.array([*lines[:2], shapely.LineString()])))
    assert layer.kinds == ["LineString", "MultiLineString"]
    assert layer.has_several
    assert not layer.take(slice(0, 1)).has_several
    _, batches = layer.batches(several=True)
    binary = np.array([batch.column(0)[0].as_py() for batch in batches], dtype=object)
    assert binary[2] is None
    assert [line.wkt for line in module.unpacked(binary[:2])] == [
        "MULTILINESTRING ((0 0, 1 1))",
        "MULTILINESTRING ((0 0, 1 0))",
    ]
    write(tmp_path / "a.fgb", MapRows({"n": np.arange(2)}, layer.binary[:2], "EPSG:4326"))
    assert pyogrio.read_info(tmp_path / "a.fgb")["geometry_type"] == "MultiLineString"


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
    assert len(told) == 10
    assert told == sorted(told)
    assert 0 < told[0][1] < 0.2 * 8008
    assert told[-1] == ("reading", 8008, 8008)


def test_cells_are_the_same_in_blocks_of_any_size(monkeypatch):
    """And by any number of threads; also where chords are halved, since cells are narrow."""
    rng = np.random.default_rng(9)
    lonlat = np.concatenate([rng.uniform(-85, 85, (60, 2)), [[10, 89.9999], [170, 89.9998], [20, 0], [20, 1e-7]]])
    diagram = SphericalVoronoi.from_lonlat(lonlat)
    told = []
    expected = to_geodataframe(diagram)
    monkeypatch.setattr("stereodel.io.maps.tiles.BLOCK", 5)
    monkeypatch.setattr("stereodel.io.maps.tiles.thread_count", lambda workers, size: 3)
    write(io.BytesIO(), diagram, format="geojson")
    found = module.unpacked(tiles_of(diagram, lambda *said: told.append(said)))
    assert shapely.equals_identical(found, np.asarray(expected.geometry)).all()
    assert told[-1][1] == told[-1][2] == len(told)
    assert told == sorted(told)


def tiles_of(diagram, progress):
    from stereodel.io.maps.rows_of import rows_of

    return rows_of(diagram, progress=progress).binary
