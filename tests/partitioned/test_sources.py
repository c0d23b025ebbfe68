"""What is read: files in their order, columns by name or by what the file says, geometries, row groups."""

import json
import os
import struct

import geopandas
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from stereodel import lonlat_to_xyz
from stereodel.partitioned.files import PointColumns, find_columns, paths_of, read, sampled
from stereodel.partitioned.plan import source_of
from tests.partitioned.answers import differences, in_memory, rows_of, serially, write_points
from tests.refused import refused
from tests.sets import LONLAT, XY, XYZ


def of(path, columns=None, surface="sphere", latitude="spherical"):
    return source_of(path, "auto", columns, surface, latitude, (), ())


def points_of(source):
    return np.concatenate([np.concatenate(list(read(file, source.columns, 0, file.rows))) for file in source.files])


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
    os.symlink(listed[0], tmp_path / "link.parquet")
    os.link(listed[0], tmp_path / "second.parquet")
    for twice in ([listed[0], listed[0]], [listed[0], tmp_path / "link.parquet"], tmp_path):
        with pytest.raises(ValueError, match=r"source names a file twice, as .*b\.parquet and .*\.parquet; its"):
            of(twice)
    (tmp_path / "notes.txt").write_text("a note")
    with pytest.raises(ValueError, match=r"notes\.txt is not a Parquet file"):
        of(tmp_path / "notes.txt")


@pytest.mark.parametrize(
    ("names", "surface", "columns", "found"),
    [
        (["id", "lat", "lon"], "sphere", None, ("lonlat", ("lon", "lat"))),
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
    places = find_columns(schema, columns, surface, "spherical")
    assert (places.form, places.names) == found


A_AND_B = pa.schema([("a", pa.float64()), ("b", pa.float64())])
test_columns_that_are_not_there = refused(
    ("sphere", None, "no column looks like the longitude; .*the columns are 'a', 'b'"),
    ("plane", None, "no columns are named x and y; name two with columns=, the columns are 'a', 'b'"),
    ("sphere", ("a", "c"), "columns has 'c', which is not one of the columns 'a', 'b'"),
    ("plane", ("a",), r"columns has 1 names, but on the plane a place has \(x, y\)"),
    ("sphere", ("a", "b", "a", "b"), r"has 4 names, but on the sphere .*\(longitude, latitude\) or \(x, y, z\)"),
    call=lambda surface, columns: find_columns(A_AND_B, columns, surface, "spherical"),
)


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


NUMBERS = [1, 2, 3, 4]
REFUSED = {
    "booleans": pa.array([True, False, True, True]),
    "dates": pa.array(NUMBERS, pa.date32()),
    "times of day": pa.array(NUMBERS, pa.time64("us")),
    "time stamps": pa.array(NUMBERS, pa.timestamp("ns")),
    "durations": pa.array(NUMBERS, pa.duration("s")),
    "bytes": pa.array([b"1"] * 4),
    "text": pa.array(["1"] * 4),
    "text of few kinds": pa.array(["1"] * 4).dictionary_encode(),
    "nothing": pa.nulls(4),
    "lists": pa.array([[1]] * 4),
    **{str(kind): pa.array([2**53, 2, 2**53 + 1, 2**62 + 1], kind) for kind in (pa.int64(), pa.uint64())},
}


@pytest.mark.parametrize("columns", [LONLAT, XYZ, XY])
@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_number_is_no_coordinate(tmp_path, name, columns):
    """As degenerate.md says of columns of tables; NumPy would convert most of them, and round whole numbers."""
    for wrong in columns:
        values = {column: REFUSED[name] if column == wrong else pa.array(NUMBERS) for column in columns}
        pq.write_table(pa.table(values), tmp_path / "a.parquet", row_group_size=2)
        source = of(tmp_path / "a.parquet", columns, surface="plane" if columns == XY else "sphere")
        error, message = TypeError, rf"a\.parquet: the column '{wrong}' holds .*, not numbers"
        if "int" in name:
            error, message = ValueError, rf"a\.parquet: row 3: the \w+ {2**53 + 1} is not a double \(and 1 more"
            message = "latitude" if wrong == "lat" else message
        with pytest.raises(error, match=message):
            points_of(source)
    for kind in (pa.float64(), pa.int64(), pa.decimal128(9, 2)):  # and no advice that cannot be taken
        values = {column: pa.array([1, None], kind) for column in XY}
        pq.write_table(pa.table(values), tmp_path / "a.parquet")
        with pytest.raises(ValueError, match=r"row 2: the x is missing; leave such rows out$"):
            points_of(of(tmp_path, surface="plane"))


@pytest.mark.parametrize("cell", [2**53 + 1, True, b"1", None])
def test_values_and_targets_are_numbers_too(tmp_path, cell):
    """The same door for values that are interpolated, where all may be missing, and for targets."""
    _, rows = rows_of("airports", 50)
    value = pa.array([cell] + [None] * (len(rows) - 1))
    (tmp_path / "points").mkdir()
    pq.write_table(pa.table({"lon": rows[:, 0], "lat": rows[:, 1], "value": value}), tmp_path / "points" / "a.parquet")
    pq.write_table(pa.table({"lon": value, "lat": rows[:, 1]}), tmp_path / "targets.parquet")
    run = serially(tmp_path / "points", tmp_path / "out", index=True)
    error = ValueError if cell == 2**53 + 1 else TypeError
    with pytest.raises(error, match=r"targets\.parquet: "):
        run.nearest(tmp_path / "targets.parquet", tmp_path / "nearest")
    if cell is None:
        found = run.interpolate(tmp_path / "points", tmp_path / "values", "value")
        assert np.isnan(found.rows().to_table()["value"].to_numpy()).all()
        return
    message = "row 1: the value 9007199254740993 is" if error is ValueError else "the column 'value' holds"
    with pytest.raises(error, match=rf"a\.parquet: {message}"):
        run.interpolate(tmp_path / "points", tmp_path / "values", "value")


def wkb(x, y, kind=1, order=1):
    return struct.pack("<BIdd" if order else ">BIdd", order, kind, x, y)


BINARY = pa.binary()
PAIR, WRONG_PAIR = (pa.struct([("x", kind), ("y", pa.float64())]) for kind in (pa.float64(), pa.timestamp("s")))
GEOMETRIES = [
    (PAIR, [{"x": 1, "y": 2}, {"x": 3, "y": 4}], None, ""),
    (BINARY, [wkb(1, 2), wkb(3, 4, 1001) + bytes(8)], None, ""),
    (PAIR, [{"x": 1, "y": 2}, None], ValueError, "row 2: the x is missing; leave such rows out"),
    (BINARY, [wkb(1, 2), None], ValueError, "row 2: a Point is needed, not another geometry"),
    (BINARY, [wkb(1, 2), wkb(1, 2, kind=2)], ValueError, "row 2: a Point is needed, not another geometry"),
    (BINARY, [wkb(1, 2), wkb(1, 2, order=0)], ValueError, "row 2: a Point is needed, not another geometry"),
    (BINARY, [bytes([1, 4, *bytes(8)])], ValueError, "row 1: a Point is needed, not another geometry"),
    (pa.list_(pa.float64()), [[1, 2], [3, 4]], TypeError, "'g' are list<.*>, not points"),
    (WRONG_PAIR, [{"x": 1, "y": 2}] * 2, TypeError, r"the column 'g\.x' holds timestamp"),
    (pa.int64(), [1, 2], TypeError, "'g' are int64, not points"),
    (pa.string(), ["a" * 21], TypeError, "'g' are string, not WKB"),
    (pa.int32(), [1], TypeError, "'g' are int32, not WKB"),
    (pa.float64(), [None], TypeError, "'g' are double, not WKB"),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "cells", "error", "message"), GEOMETRIES)
def test_points_of_structures_and_binary(tmp_path, kind, cells, error, message):
    encoding = "WKB" if kind == BINARY or "WKB" in message else "point"
    geo = {"primary_column": "g", "columns": {"g": {"encoding": encoding}}}
    table = pa.table({"g": pa.array(cells, kind)}).replace_schema_metadata({"geo": json.dumps(geo)})
    pq.write_table(table, tmp_path / "a.parquet")
    source = of(tmp_path, surface="plane")
    if error is not None:
        with pytest.raises(error, match=message):
            points_of(source)
        return
    assert points_of(source).tolist() == [[1, 2], [3, 4]]
    (file,) = source.files
    assert next(read(file, source.columns, 1, 2)).tolist() == [[3, 4]]


def test_columns_to_keep_have_one_type(tmp_path):
    write_points(tmp_path, LONLAT, np.zeros((4, 2)), 2)
    for name, ids in (("000", [1, 2]), ("001", [1.5, 2])):
        table = pq.read_table(tmp_path / f"{name}.parquet").append_column("id", pa.array(ids))
        pq.write_table(table, tmp_path / f"{name}.parquet")
    with pytest.raises(ValueError, match=r"keep has 'id', which is int64 in .*000\.parquet, but double in .*001\.parq"):
        source_of(tmp_path, "auto", None, "sphere", "spherical", ["id"], ())
    write_points(tmp_path, LONLAT, np.zeros((2, 2)), 1)
    with pytest.raises(
        ValueError, match=r"keep has 'id', which is not one of the columns 'lon', 'lat' of .*000\.parquet"
    ):
        source_of(tmp_path, "auto", None, "sphere", "spherical", "id", ())


def test_a_sample_is_spread_evenly(tmp_path):
    """Over the rows of few groups, in terms of which a bad row is told, too."""
    lat = np.linspace(-90, 90, 1000)
    write_points(tmp_path, LONLAT, np.column_stack([np.zeros(1000), lat]), 1, row_group_size=50)
    source = of(tmp_path)
    (file,) = source.files
    z = np.concatenate(list(sampled(file, source.columns, 200, 800, 60, 100)))[:, 2]
    found = np.searchsorted(np.sin(np.radians(lat)), z - 1e-9)
    assert 50 <= len(found) <= 75
    assert found.min() >= 200
    assert found.max() < 800
    assert np.diff(found).max() <= 20


@pytest.mark.parametrize(
    ("encoding", "crs"),
    [("WKB", "EPSG:4326"), ("WKB", "EPSG:3857"), ("geoarrow", "OGC:CRS84"), ("geoarrow", "EPSG:3857"), ("WKB", None)],
)
def test_geoparquet(tmp_path, encoding, crs):
    columns, rows = rows_of("airports", 200)
    (tmp_path / "points").mkdir()
    path = tmp_path / "points" / "a.geoparquet"
    frame = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*rows.T), crs=None if crs is None else 4326)
    frame = frame if crs is None else frame.to_crs(crs)
    frame.to_parquet(path, geometry_encoding=encoding, schema_version="1.1.0", row_group_size=50)
    source = of(path)
    form = "wkb" if encoding == "WKB" else "point"
    assert source.columns == PointColumns(form, ("geometry",), "sphere", "spherical", source.columns.crs)
    assert (source.columns.crs is None) == (crs != "EPSG:3857")
    assert np.allclose(points_of(source), lonlat_to_xyz(rows), rtol=0, atol=1e-12 if crs == "EPSG:3857" else 0)
    if crs is None:
        assert np.array_equal(points_of(of(path, surface="plane")), rows)
        run = serially(path.parent, tmp_path / "out", partition=100)
        assert differences(run, in_memory(columns, rows)) == []
        assert (run.folder / "rows" / "a.geoparquet").exists()


def test_other_kinds_are_refused(tmp_path):
    with pytest.raises(ValueError, match="kind is 'csv', but must be one of"):
        source_of(tmp_path, "csv", None, "sphere", "spherical", (), ())
