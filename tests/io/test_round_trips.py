"""What `write` writes of a table, `read_points` reads, for every format and every type of column; or it is an error."""

import datetime as dt
import json
import math
import warnings
import zipfile
from uuid import UUID

import numpy as np
import pandas as pd
import pyarrow as pa
import pyogrio
import pytest

from stereodel.io import PointTable, RenamedColumnWarning, read_points, write

FORMATS = ["csv", "geojson", "geojsonl", "parquet", "gpkg", "fgb", "shp", "kml", "xlsx"]
JSON = {"geojson", "geojsonl"}
DATABASES = {"gpkg", "fgb"}
OF_TEXT = {"csv", "shp", "kml"}
"""Formats in which much is text."""
EAST = dt.timezone(dt.timedelta(hours=2))
LONLAT = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [7.0, 8.0]]


def objects(*values):
    array = np.empty(len(values), dtype=object)
    array[:] = values
    return array


COLUMNS = {
    "truth": np.array([True, False, True, True]),
    "truths": objects(True, None, np.bool_(False), True),
    "int8": np.array([-128, 127, 0, 1], np.int8),
    "int64": np.array([-(2**63), 2**63 - 1, 0, 1]),
    "uint64": np.array([2**64 - 1, 0, 1, 2], np.uint64),
    "huge": objects(2**70 + 1, 1, 2, 3),
    "single": np.array([0.1, -1.5, 7.0, -0.0], np.float32),
    "double": np.array([0.1, -1.5e9, 1 / 3, 2.0]),
    "long": np.array([0.5, -1.5, 7.0, np.nan], np.longdouble),
    "ends": np.array([1.7976931348623157e308, 5e-324, -1e200, 1.0]),
    "zeros": np.array([-0.0, 0.0, 1.0, 2.0]),
    "nan": np.array([np.nan, 1.5, 2.0, 3.0]),
    "infinite": np.array([np.inf, -np.inf, 1.5, np.nan]),
    "text": np.array(["a,b;c", 'say "x"', "two\nlines", "=1+1 # \t'"]),
    "blanks": np.array([" both ", "", "x", "y"]),
    "return": np.array(["a\rb", "c", "\r", "d"]),
    "zero letter": np.array(["a\0b", "c", "d", "e"]),
    "control": np.array(["a\x01b", "c", "d", "e"]),
    "half letter": np.array(["\ud800", "c", "d", "e"]),
    "none": objects("a", None, "c", "d"),
    "mixed": objects(1, "a", None, 2.5),
    "dates": objects(dt.date(2020, 1, 31), dt.date(1900, 1, 1), None, dt.date(9999, 12, 31)),
    "zoned": objects(dt.datetime(2020, 1, 1, 12, 30, tzinfo=EAST), None, dt.datetime(1970, 1, 1, tzinfo=EAST), None),
    "times": np.array(["2020-01-01T00:00:00.125", "NaT", "1970-01-01", "1990-01-01T01:02:03"], "M8[ms]"),
    "instants": np.array(["2020-01-01T00:00:00.123456789", "NaT", "1970-01-01", "1990-01-01T01:02:03"], "M8[ns]"),
    "spans": np.array([1, 2, "NaT", 10**15], "m8[ns]"),
    "bytes": objects(b"\x00\xff", b"ab", None, b"\x0f"),
    "lists": objects([1, 2.5], [np.nan], [[np.inf], {"b": 1}], None),
    "mappings": objects({"a": np.nan}, {"a": [np.inf, 1]}, {"a": {"b": -np.inf}}, None),
    "numpy": objects(np.int64(3), np.float32(0.5), None, np.float64("nan")),
    "ids": objects(UUID(int=5), None, UUID(int=2**100), UUID(int=0)),
    "rows": np.arange(8).reshape(4, 2),
}

REFUSED = {
    "half letter": set(FORMATS),
    "zero letter": DATABASES | {"shp", "kml", "xlsx"},
    "control": {"kml", "xlsx"},
    "return": {"kml", "xlsx"},
    "ends": {"shp", "kml", "xlsx"},
}

NESTED = {
    "lists": [[1, 2.5], [None], [[None], {"b": 1}], None],
    "mappings": [{"a": None}, {"a": [None, 1]}, {"a": {"b": None}}, None],
    "rows": [[0, 1], [2, 3], [4, 5], [6, 7]],
}


def arrow_knows_ids():
    """Older versions of Arrow take no UUIDs for its own."""
    try:
        return pa.array([UUID(int=5)]) is not None
    except pa.ArrowInvalid:
        return False


def expected(name, kind):
    """What docs/files.md says of a column in a format."""
    values = COLUMNS[name].tolist()
    texts = [None if value is None else str(value) for value in values]
    if name in NESTED:
        as_json = [None if value is None else json.dumps(value) for value in NESTED[name]]
        return NESTED[name] if kind in JSON or (kind == "parquet" and name == "rows") else as_json
    if name in ("truth", "truths") and kind == "csv":
        return texts
    if name in ("uint64", "huge") and kind not in JSON | ({"parquet"} if name == "uint64" else set()):
        return texts
    if name == "int64" and kind in ("shp", "kml", "xlsx"):
        return texts
    if (name == "mixed" and kind not in JSON) or (name == "ids" and (kind != "parquet" or not arrow_knows_ids())):
        return texts
    if name == "zeros" and kind in ("gpkg", "xlsx"):
        return [0.0, 0.0, 1.0, 2.0]
    if name == "double" and kind in ("shp", "kml"):
        return [0.1, -1.5e9, 0.333333333333333, 2.0]
    if name == "single" and kind in ("gpkg", "shp", "kml"):
        return [values[0] if kind == "gpkg" else 0.100000001490116, -1.5, 7.0, 0.0 if kind == "gpkg" else -0.0]
    if name == "single" and kind == "xlsx":
        return [0.1000000014901161, *values[1:]]
    if name == "infinite" and kind in JSON | {"csv", "xlsx"}:
        return [None, None, 1.5, None]
    if name == "blanks" and kind == "xlsx":
        return [" both ", None, "x", "y"]
    if name == "blanks" and kind in ("shp", "kml"):
        return ["both", None, "x", "y"]
    if name == "bytes" and kind in JSON | OF_TEXT | {"xlsx"}:
        return ["00FF", "6162", None, "0F"]
    if name == "dates" and (kind == "fgb" or (kind in ("gpkg", "shp") and pyogrio.__version__ < "0.13")):
        return [value and dt.datetime(value.year, value.month, value.day) for value in values]
    if name == "dates" and kind == "kml":
        return [value and f"{value:%Y/%m/%d}" for value in values]
    if name == "dates" and kind in JSON | {"csv"}:
        return texts
    if name == "zoned" and kind in JSON | OF_TEXT | {"xlsx"}:
        return [value and value.isoformat() for value in values]
    if name in ("times", "instants"):
        cells = COLUMNS[name] if kind in JSON | {"csv", "parquet"} else COLUMNS[name].astype("M8[ms]")
        return [pd.Timestamp(cell) for cell in cells]
    if name == "spans":
        return [pd.Timedelta(cell) for cell in COLUMNS[name]]
    return values


def is_none(value):
    return not isinstance(value, list | dict | np.ndarray) and bool(pd.isna(value))


def same(found, wanted):
    if is_none(wanted):
        return is_none(found) or found == ""
    if isinstance(wanted, pd.Timestamp | pd.Timedelta):
        return type(wanted)(found) == wanted
    if isinstance(wanted, float) and wanted == 0:
        return found == 0 and math.copysign(1, found) == math.copysign(1, wanted)
    if isinstance(wanted, list) and isinstance(found, np.ndarray):
        return found.tolist() == wanted
    if isinstance(wanted, str) and wanted.startswith(("[", "{")) and isinstance(found, str):
        return json.loads(found) == json.loads(wanted)
    if isinstance(wanted, dt.datetime) and wanted.tzinfo is None:
        return np.datetime64(found) == np.datetime64(wanted)
    return bool(found == wanted)


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("name", COLUMNS)
def test_a_column_comes_back_or_is_refused(tmp_path, name, kind):
    table, path = PointTable(LONLAT, {"v": COLUMNS[name]}), tmp_path / f"table.{kind}"
    if kind in REFUSED.get(name, ()):
        with pytest.raises(ValueError, match=rf"column 'v' has .* \.{kind} cannot hold"):
            write(path, table)
        assert not path.exists()
        return
    with warnings.catch_warnings():
        warnings.simplefilter("error", RenamedColumnWarning)
        write(path, table)
    if kind in JSON:
        assert not {"NaN", "Infinity"} & set(path.read_text(encoding="utf-8").replace("-", "").split('"'))
        for line in path.read_text(encoding="utf-8").splitlines() if kind == "geojsonl" else [path.read_text()]:
            json.loads(line, parse_constant=pytest.fail)
    read = read_points(path)
    order = np.argsort(read.lonlat[:, 0])  # FlatGeobuf sorts
    assert read.lonlat[order].tolist() == LONLAT
    found = [read.columns["v"].tolist()[k] for k in order]
    if read.columns["v"].dtype.kind in "mM":
        found = [read.columns["v"][k] for k in order]
    assert all(map(same, found, expected(name, kind))), (found, expected(name, kind))


@pytest.mark.parametrize(
    ("name", "values", "said"),
    [("v", ["x" * 32_768] * 4, "32768 characters of a text"), (None, range(4), "16387 columns")],
)
def test_what_a_sheet_cannot_hold(tmp_path, name, values, said):
    columns = {name: values} if name else {f"c{k}": values for k in range(16_385)}
    with pytest.raises(ValueError, match=rf"there are {said}, but \.xlsx holds"):
        write(tmp_path / "a.xlsx", PointTable(LONLAT, columns))
    assert not list(tmp_path.iterdir())


def test_a_sheet_is_named_and_filled_as_excel_wants(tmp_path):
    """Names of sheets have up to 31 letters, and not these; a text that begins with = is no formula."""
    path = tmp_path / "areas [km2]: a name of more than thirty letters.xlsx"
    write(path, PointTable(LONLAT, {"v": ["=1+1", "-", "+", "@"]}))
    with zipfile.ZipFile(path) as book:
        assert b'name="areas _km2__ a name of more tha"' in book.read("xl/workbook.xml")
        assert b"<f>" not in book.read("xl/worksheets/sheet1.xml")
