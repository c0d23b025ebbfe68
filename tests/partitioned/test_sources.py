"""What is read: files in their order, columns by name or by what the file says, geometries, row groups."""

import struct

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from stereodel import lonlat_to_xyz
from stereodel.partitioned.kinds import source_of
from stereodel.partitioned.places import Places, find_places, wkb_places
from stereodel.partitioned.sources import paths_of, read, some
from tests.partitioned.answers import differences, in_memory, serially, write_points
from tests.partitioned.sets import LONLAT, XYZ, rows_of


def of(path, columns=None, surface="sphere", latitude="spherical"):
    return source_of(path, "auto", columns, surface, latitude, (), ())


def points_of(source):
    return np.concatenate([np.concatenate(list(read(file, source.places, 0, file.rows))) for file in source.files])


def test_files_and_names(tmp_path):
    """A folder at any depth, a pattern, a list, a file; names relative to what they share."""
    for name in ("b.parquet", "a/2.parquet", "a/1.pq", "a/_metadata.parquet", ".x/c.parquet", "notes.txt"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        write_points(path.parent, XYZ, np.eye(3), 1)
        (path.parent / "000.parquet").rename(path)
    assert [name for _, name in paths_of(tmp_path)] == ["a/1.pq", "a/2.parquet", "b.parquet"]
    assert [name for _, name in paths_of(str(tmp_path / "*" / "?.p*"))] == ["1.pq", "2.parquet"]
    listed = [tmp_path / "b.parquet", tmp_path / "a" / "1.pq"]
    assert [name for _, name in paths_of(listed)] == ["b.parquet", "a/1.pq"]
    assert [name for _, name in paths_of(listed[0])] == ["b.parquet"]
    assert len(points_of(of(tmp_path))) == 9
    for missing in (tmp_path / "none", tmp_path / "*.csv", [tmp_path / "none.parquet"]):
        with pytest.raises(FileNotFoundError, match=r"is no file, folder or pattern of Parquet files"):
            paths_of(missing)
    with pytest.raises(ValueError, match="source names a file twice"):
        paths_of([listed[0], listed[0]])
    (tmp_path / "notes.txt").write_text("a note")
    with pytest.raises(ValueError, match=r"notes\.txt is not a Parquet file"):
        of(tmp_path / "notes.txt")


@pytest.mark.parametrize(
    ("names", "surface", "columns", "found"),
    [
        (["id", "lat", "lon"], "sphere", None, ("lonlat", ("lon", "lat"))),
        (["decimalLongitude", "Latitude", "n"], "sphere", None, ("lonlat", ("decimalLongitude", "Latitude"))),
        (["x", "y"], "sphere", None, ("lonlat", ("x", "y"))),
        (["X", "y", "z"], "sphere", None, ("xyz", ("X", "y", "z"))),
        (["x", "y", "z", "lon", "lat"], "sphere", None, ("lonlat", ("lon", "lat"))),
        (["ra", "dec"], "sphere", ("ra", "dec"), ("lonlat", ("ra", "dec"))),
        (["y", "x"], "plane", None, ("xy", ("x", "y"))),
        (["east", "north"], "plane", ("east", "north"), ("xy", ("east", "north"))),
    ],
)
def test_columns_by_name(names, surface, columns, found):
    schema = pa.schema([(name, pa.float64()) for name in names])
    places = find_places(schema, columns, surface, "spherical")
    assert (places.form, places.names) == found


@pytest.mark.parametrize(
    ("surface", "columns", "message"),
    [
        ("sphere", None, "no column looks like the longitude; .*the columns are 'a', 'b'"),
        ("plane", None, "no columns are named x and y; name two with columns=, the columns are 'a', 'b'"),
        ("sphere", ("a", "c"), "columns has 'c', which is not one of the columns 'a', 'b'"),
        ("plane", ("a",), r"columns has 1 names, but on the plane a place has \(x, y\)"),
        ("sphere", ("a", "b", "a", "b"), r"has 4 names, but on the sphere .*\(longitude, latitude\) or \(x, y, z\)"),
    ],
)
def test_columns_that_are_not_there(surface, columns, message):
    schema = pa.schema([("a", pa.float64()), ("b", pa.float64())])
    with pytest.raises(ValueError, match=message):
        find_places(schema, columns, surface, "spherical")


def test_a_column_that_a_later_file_lacks(tmp_path):
    write_points(tmp_path, LONLAT, np.zeros((4, 2)), 2)
    write_points(tmp_path / "other", ("lon", "breadth"), np.ones((2, 2)), 1)
    (tmp_path / "other" / "000.parquet").rename(tmp_path / "002.parquet")
    with pytest.raises(ValueError, match=r"002\.parquet: there is no column 'lat', which the first file has"):
        points_of(of(tmp_path))


@pytest.mark.parametrize("kind", [pa.float64(), pa.float32(), pa.int16(), pa.decimal128(25, 2)])
def test_kinds_of_numbers(tmp_path, kind):
    values = {"lon": pa.array([10, 20, 30]).cast(kind), "lat": pa.array([-5, 0, 40]).cast(kind)}
    pq.write_table(pa.table(values), tmp_path / "a.parquet")
    assert np.array_equal(points_of(of(tmp_path)), lonlat_to_xyz([[10, -5], [20, 0], [30, 40]]))


def test_row_groups_one_by_one(tmp_path):
    _, rows = rows_of("airports", 500)
    write_points(tmp_path, LONLAT, rows, 1, row_group_size=37)
    source = of(tmp_path)
    (file,) = source.files
    assert [len(part) for part in read(file, source.places, 30, 120)] == [7, 37, 37, 9]
    assert np.array_equal(np.concatenate(list(read(file, source.places, 30, 120))), lonlat_to_xyz(rows[30:120]))


def test_a_sample_is_spread_evenly(tmp_path):
    """Over the rows of few groups, in terms of which a bad row is told, too."""
    lat = np.linspace(-90, 90, 1000)
    write_points(tmp_path, LONLAT, np.column_stack([np.zeros(1000), lat]), 1, row_group_size=50)
    source = of(tmp_path)
    (file,) = source.files
    z = np.concatenate(list(some(file, source.places, 200, 800, 60, 100)))[:, 2]
    found = np.searchsorted(np.sin(np.radians(lat)), z - 1e-9)
    assert 50 <= len(found) <= 75
    assert found.min() >= 200
    assert found.max() < 800
    assert np.diff(found).max() <= 20
    few = np.concatenate(list(some(file, source.places, 0, 1000, 40, 4)))[:, 2]
    assert len(few) == pytest.approx(40, abs=8)
    assert np.ptp(few) > 1.3


def wkb(x, y, kind=1, order=1):
    return struct.pack("<BIdd" if order else ">BIdd", order, kind, x, y)


@pytest.mark.parametrize(
    ("cells", "message"),
    [
        ([wkb(1, 2), None], "row 2: a Point is needed, not no geometry"),
        ([wkb(1, 2), wkb(1, 2, kind=2)], "row 2: a Point is needed, not another geometry"),
        ([wkb(1, 2), wkb(1, 2, order=0)], "row 2: a Point is needed, not another geometry"),
        ([b"\x01\x04\x00\x00\x00\x00\x00\x00\x00"], "row 1: a Point is needed, not another geometry"),
    ],
)
def test_geometries_that_are_no_points(cells, message):
    with pytest.raises(ValueError, match=message):
        wkb_places(pa.array(cells, pa.binary()))


def test_points_in_binary():
    cells = pa.array([wkb(1, 2), wkb(3, 4, 1001) + bytes(8), wkb(-5, 6)], pa.binary())
    assert wkb_places(cells).tolist() == [[1, 2], [3, 4], [-5, 6]]
    assert wkb_places(cells.slice(1, 1)).tolist() == [[3, 4]]
    assert wkb_places(cells.slice(0, 0)).shape == (0, 2)


@pytest.mark.parametrize("encoding", ["WKB", "geoarrow"])
@pytest.mark.parametrize("crs", ["EPSG:4326", "OGC:CRS84", "EPSG:3857", None])
def test_geoparquet(tmp_path, encoding, crs):
    geopandas = pytest.importorskip("geopandas")
    _, rows = rows_of("airports", 200)
    frame = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*rows.T), crs=None if crs is None else 4326)
    frame = frame if crs is None else frame.to_crs(crs)
    frame.to_parquet(tmp_path / "a.parquet", geometry_encoding=encoding, schema_version="1.1.0")
    source = of(tmp_path)
    assert source.places == Places(
        "wkb" if encoding == "WKB" else "point", ("geometry",), "sphere", "spherical", source.places.crs
    )
    assert (source.places.crs is None) == (crs != "EPSG:3857")
    assert np.allclose(points_of(source), lonlat_to_xyz(rows), rtol=0, atol=1e-12 if crs == "EPSG:3857" else 0)
    if crs is None:
        plane = of(tmp_path, surface="plane")
        assert np.array_equal(points_of(plane), rows)


def test_geoparquet_is_triangulated(tmp_path):
    geopandas = pytest.importorskip("geopandas")
    columns, rows = rows_of("airports", 300)
    (tmp_path / "points").mkdir()
    frame = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*rows.T), crs=4326)
    frame.to_parquet(tmp_path / "points" / "a.geoparquet", row_group_size=50)
    run = serially(tmp_path / "points", tmp_path / "out", partition=100)
    assert differences(run, in_memory(columns, rows)) == []
    assert (tmp_path / "out" / "rows" / "a.geoparquet").exists()


def test_other_kinds_are_refused(tmp_path):
    with pytest.raises(ValueError, match="kind is 'csv', but must be one of"):
        source_of(tmp_path, "csv", None, "sphere", "spherical", (), ())
