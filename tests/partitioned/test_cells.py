"""Cells in partitions: the polygons of all points at once, in files that others open."""

import duckdb
import geopandas
import numpy as np
import pyarrow.parquet as pq
import pytest
import shapely

from stereodel import PlanarVoronoi, SphericalVoronoi
from stereodel.io import to_geodataframe
from tests.partitioned.answers import rows_of, serially, surface_of, write_points
from tests.sets import LONLAT


@pytest.fixture
def places():
    """Longitudes and latitudes in an order in which no file is compact."""
    return np.random.default_rng(3).permutation(rows_of("airports", 1500)[1])


def run(folder, names, rows, **options):
    write_points(folder / "points", names, rows, 3)
    options = {"cells": True, "columns": names, "surface": surface_of(names)} | options
    return serially(folder / "points", folder / "out", **options)


def same(found, frame):
    """Cells of a run are those of all points at once, by a bit."""
    table = found.cells().to_table().sort_by("point")
    assert table["point"].to_pylist() == frame["point"].tolist()
    assert table["area"].to_pylist() == frame["area"].tolist()
    expected = shapely.to_wkb(frame.geometry.to_numpy(), byte_order=1, flavor="iso")
    assert table["geometry"].to_pylist() == expected.tolist()


def test_cells_of_the_sphere_are_those_of_all_points(tmp_path, places):
    """With duplicates, whose cell is that of the first; and with latitudes of the ellipsoid."""
    places[700:720] = places[:20]
    found = run(tmp_path, LONLAT, places, partition=300, latitude="authalic")
    assert found.statistics["partitions"] > 3
    same(found, to_geodataframe(SphericalVoronoi.from_lonlat(places, latitude="authalic")))
    assert sum(shapely.area(shapely.from_wkb(found.cells().to_table()["geometry"].to_pylist()))) == pytest.approx(64800)


def test_cells_of_the_plane_are_cut_to_the_rectangle_of_all_points(tmp_path):
    columns, rows = rows_of("random", 900, "plane")
    same(run(tmp_path, columns, rows, partition=200), to_geodataframe(PlanarVoronoi(rows)))


@pytest.mark.parametrize("size", [1, 2, 40])
def test_cells_of_one_great_circle(tmp_path, size):
    places = np.column_stack([np.linspace(-170, 160, size), np.zeros(size)])
    same(run(tmp_path, LONLAT, places, partition=10), to_geodataframe(SphericalVoronoi.from_lonlat(places)))


def test_others_open_them(tmp_path, places):
    """GeoPandas knows the coordinate system; DuckDB joins cells and rows by the number of the point."""
    run(tmp_path, LONLAT, places[:600], partition=200)
    part = sorted((tmp_path / "out" / "cells").glob("*.parquet"))[0]
    frame = geopandas.read_parquet(part)
    assert frame.crs == "EPSG:4326"
    assert frame.is_valid.all()
    cells, rows, numbers = (tmp_path / "out" / name for name in ("cells", "rows", "files.parquet"))
    with duckdb.connect() as base:
        area, count = base.execute(f"SELECT sum(area), count(*) FROM '{cells}/*.parquet'").fetchone()
        ((both,),) = base.execute(
            f"""WITH numbered AS (
                SELECT r.area, f.first + r.file_row_number AS point
                FROM read_parquet('{rows}/*.parquet', filename = true, file_row_number = true) r
                JOIN '{numbers}' f ON ends_with(r.filename, '/' || f.rows_file))
            SELECT count(*) FROM numbered JOIN '{cells}/*.parquet' c USING (point) WHERE numbered.area = c.area"""
        ).fetchall()
    assert (count, both) == (600, 600)
    assert area == pytest.approx(4 * np.pi)


def test_columns_to_keep(tmp_path, places):
    rows = np.column_stack([places[:400], np.arange(400)])
    found = run(
        tmp_path, (*LONLAT, "id"), rows, columns=None, surface="sphere", cells=False, keep=("id",), partition=100
    )
    assert not (tmp_path / "out" / "cells").exists()  # as nobody asked
    table = found.rows().to_table()
    assert table.schema.names[:2] == ["id", "area"]
    assert table["id"].to_pylist() == list(range(400))
    renamed = pq.read_table(tmp_path / "points" / "000.parquet").rename_columns(["lon", "lat", "area"])
    pq.write_table(renamed, tmp_path / "area.parquet")
    with pytest.raises(ValueError, match="column 'area' cannot be kept: results have that name"):
        serially(tmp_path / "area.parquet", tmp_path / "other", keep=("area",))
