"""Cells in partitions: the polygons of all points at once, in files that others open."""

import duckdb
import geopandas
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import shapely

from stereodel import PlanarVoronoi, SphericalVoronoi, lonlat_to_xyz
from stereodel.io import to_geodataframe
from stereodel.partitioned import triangulate
from stereodel.partitioned.executors import Here


def files(folder, columns, count=3):
    """Points dealt out to files, so that none is compact; rows of all in the order of files."""
    size = len(next(iter(columns.values())))
    order = np.concatenate([np.arange(size)[k::count] for k in range(count)])
    folder.mkdir()
    for k in range(count):
        pq.write_table(pa.table({name: values[k::count] for name, values in columns.items()}), folder / f"{k}.parquet")
    return {name: values[order] for name, values in columns.items()}


def run(folder, columns, **options):
    ordered = files(folder / "points", columns)
    found = triangulate(folder / "points", folder / "out", cells=True, executor=Here(), **options)
    return ordered, found


def on_sphere(size, seed=3):
    rng = np.random.default_rng(seed)
    return {"lon": rng.uniform(-180, 180, size), "lat": np.degrees(np.arcsin(rng.uniform(-1, 1, size)))}


def same(run, frame):
    table = run.cells().to_table().sort_by("point")
    assert table["point"].to_pylist() == frame["point"].tolist()
    assert table["area"].to_pylist() == frame["area"].tolist()
    expected = shapely.to_wkb(frame.geometry.to_numpy(), byte_order=1, flavor="iso")
    assert table["geometry"].to_pylist() == expected.tolist()


def test_cells_of_the_sphere_are_those_of_all_points(tmp_path):
    """With duplicates, whose cell is that of the first; and with latitudes of the ellipsoid."""
    places = on_sphere(1500)
    places["lon"][700:720], places["lat"][700:720] = places["lon"][:20], places["lat"][:20]
    ordered, found = run(tmp_path, places, partition=300, latitude="authalic")
    assert found.statistics["partitions"] > 3
    diagram = SphericalVoronoi.from_lonlat(np.column_stack([ordered["lon"], ordered["lat"]]), latitude="authalic")
    same(found, to_geodataframe(diagram))
    assert sum(shapely.area(shapely.from_wkb(found.cells().to_table()["geometry"].to_pylist()))) == pytest.approx(64800)


def test_cells_of_the_plane_are_cut_to_the_rectangle_of_all_points(tmp_path):
    rng = np.random.default_rng(5)
    ordered, found = run(
        tmp_path, {"x": rng.normal(size=900), "y": rng.normal(size=900)}, partition=200, surface="plane"
    )
    same(found, to_geodataframe(PlanarVoronoi(np.column_stack([ordered["x"], ordered["y"]]))))


@pytest.mark.parametrize("size", [1, 2, 40])
def test_cells_of_one_great_circle(tmp_path, size):
    places = {"lon": np.linspace(-170, 160, size), "lat": np.zeros(size)}
    ordered, found = run(tmp_path, places, partition=10)
    same(found, to_geodataframe(SphericalVoronoi(lonlat_to_xyz(np.column_stack([ordered["lon"], ordered["lat"]])))))


def test_others_open_them(tmp_path):
    """GeoPandas knows the coordinate system; DuckDB joins cells and rows by the number of the point."""
    run(tmp_path, on_sphere(600), partition=200)
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


def test_without_asking_there_are_none(tmp_path):
    files(tmp_path / "points", on_sphere(50))
    triangulate(tmp_path / "points", tmp_path / "out", executor=Here())
    assert not (tmp_path / "out" / "cells").exists()


def test_columns_to_keep(tmp_path):
    places = on_sphere(400)
    ordered = files(tmp_path / "points", places | {"name": np.array([f"p{k}" for k in range(400)])})
    found = triangulate(tmp_path / "points", tmp_path / "out", keep=("name",), partition=100, executor=Here())
    table = found.rows().to_table()
    assert table.schema.names[:2] == ["name", "area"]
    assert table["name"].to_pylist() == ordered["name"].tolist()
    for name, message in {"nme": "keep has 'nme', which is not one of the columns 'lon', 'lat', 'name'"}.items():
        with pytest.raises(ValueError, match=message):
            triangulate(tmp_path / "points", tmp_path / "other", keep=(name,))
    renamed = pq.read_table(tmp_path / "points" / "0.parquet").rename_columns(["lon", "lat", "area"])
    pq.write_table(renamed, tmp_path / "area.parquet")
    with pytest.raises(ValueError, match="column 'area' cannot be kept: results have that name"):
        triangulate(tmp_path / "area.parquet", tmp_path / "other", keep=("area",))
