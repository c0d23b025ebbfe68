"""Reading tables of points: separators, names of columns, what is said of wrong rows, and every format."""

import io
import re
import warnings

import geopandas
import numpy as np
import pandas as pd
import pytest
import shapely

from stereodel.io import DataWarning, PointTable, RenamedColumnWarning, read_points, write
from stereodel.io.formats.names import find_lonlat

CITIES = [("Quito", -78.5, -0.2, 1763000), ("Ulm", 10.0, 48.4, 129000), ("Perth", 115.9, -32.0, 2309000)]


def frame():
    table = pd.DataFrame(CITIES, columns=["name", "lon", "lat", "people"])
    return geopandas.GeoDataFrame(
        table[["name", "people"]], geometry=geopandas.points_from_xy(table["lon"], table["lat"]), crs=4326
    )


def assert_cities(table):
    assert np.allclose(table.lonlat, [[lon, lat] for _, lon, lat, _ in CITIES], atol=1e-12)
    assert table.columns["name"].tolist() == [name for name, *_ in CITIES]
    assert table.columns["people"].tolist() == [people for *_, people in CITIES]
    assert table.columns["people"].dtype == np.int64
    assert table.rows.tolist() == [1, 2, 3]


@pytest.mark.parametrize("separator", [",", ";", "\t", "|", " "])
@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_separators_and_decimal_signs(separator, decimal, end):
    if separator == decimal:
        return
    lines = [separator.join(["name", "lon", "lat", "people"])]
    lines += [separator.join(map(str, row)).replace(".", decimal) for row in CITIES]
    assert_cities(read_points(io.StringIO(end.join(lines) + end)))


@pytest.mark.parametrize(
    ("header", "row", "values"),
    [
        ("lon;lat;pop;mm", "9,9934;48,4011;128.928;118,69", [128928, 118.69]),
        ("lon;lat;pop", "9,123;48,456;128.928", [128928]),  # degrees have no thousands
        ("lon;lat;pop", "9;48;-128.928", [-128.928]),  # nothing speaks for the comma
        ("lon\tlat\tpop", "9.123\t48.456\t128.928", [128.928]),
        ("lon;lat;pop", "9.5;48.25;1,234", [1234]),
        ("lon;lat;pop", "9,5;48,25;1,234", [1.234]),
        ("lon;lat;pop", "9;48;1,234", ["1,234"]),
        ("lon;lat;pop;mm", "9;48;0,234;1,234", [0.234, 1.234]),
        ("lon;lat;pop;mm;kg", "9,5;48;1.234;0.5;1,234", ["1.234", 0.5, "1,234"]),
        ('lon,lat,"pop"', '"9,5","48,25",1.234', [1234]),
        ("lon;lat;pop;day", "9;48;1.234;24.12.2000", [1.234, "24.12.2000"]),
    ],
)
def test_marks_that_may_separate_thousands_are_read_as_those_of_the_other_numbers(header, row, values):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        table = read_points(io.StringIO(f"{header}\n{row}\n{row}"))
    assert [column.tolist() for column in table.columns.values()] == [[value] * 2 for value in values]
    told = {each.split("'")[3]: each for each in (str(one.message) for one in said)}
    kept = {value for value in values if isinstance(value, str) and value != "24.12.2000"}
    grouped = {cell for cell in row.replace('"', "").split(";" if ";" in header else ",") if value_of(cell) in values}
    assert {cell for cell, each in told.items() if "kept as text" in each} == kept
    assert {cell for cell, each in told.items() if "between thousands" in each} == grouped


def value_of(cell):
    """The number of a cell whose one mark separates thousands."""
    return int(re.sub("[.,]", "", cell)) if re.fullmatch(r"[0-9]+[.,][0-9]{3}", cell) else None


def test_a_place_in_metres_has_no_doubtful_marks():
    text = "east;north;rain\n567.890;54321;2,5\n"
    for read in (
        lambda: read_points(io.StringIO(text), lon="east", lat="north", crs="EPSG:3857"),
        lambda: read_points(io.StringIO(text), plane=("east", "north")),
    ):
        with pytest.warns(DataWarning, match="'east' has marks between thousands: '567.890' is 567890; decimal= says"):
            read()
    said = r"row 1: the east '567.890' may be 567.890 or 567890; say which mark is decimal"
    with pytest.warns(DataWarning, match="'east' is kept as text"), pytest.raises(ValueError, match=said):
        read_points(io.StringIO("east;north;rain;snow\n567.890;54321;2,5;0.5\n"), plane=("east", "north"))
    table = read_points(io.StringIO(text.replace("2,5", "2.5")), plane=("east", "north"))
    assert table.places.tolist() == [[567.890, 54321]]


def test_features_without_a_place():
    text = '{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry": null}, '
    text += '{"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [1, 2]}}]}'
    with pytest.raises(ValueError, match="row 1: a Point is needed, not no geometry"):
        read_points(io.BytesIO(text.encode()), format="geojson")
    found = read_points(io.BytesIO(text.encode()), format="geojson", skip_missing=True)
    assert (found.places.tolist(), found.rows.tolist()) == ([[1, 2]], [2])


def test_tables_of_a_plane(tmp_path):
    text = "site,east,north,depth\nA,3500,5400,1\nB,3600,5410,\nC,,5420,2\n"
    with pytest.raises(ValueError, match="row 3: the east is missing; leave such rows out with skip_missing=True"):
        read_points(io.StringIO(text), plane=("east", "north"))
    frame = pd.read_csv(io.StringIO(text))
    places = geopandas.GeoDataFrame(frame, geometry=[shapely.Point(1, 2)] * 3, crs=4326)
    (tmp_path / "a.csv").write_text(text)
    frame.to_parquet(tmp_path / "plain.parquet")
    places.to_parquet(tmp_path / "with_geometry.parquet")
    places.to_file(tmp_path / "a.gpkg")
    for path in tmp_path.iterdir():
        table = read_points(path, plane=("east", "north"), crs="EPSG:31467", skip_missing=True)
        assert (table.surface, table.axes, table.crs) == ("plane", ("east", "north"), "EPSG:31467")
        assert table.places.tolist() == table.points().tolist() == [[3500, 5400], [3600, 5410]]
        assert list(table.columns) == ["site", "depth"]
        values, some = table.values(["depth"], skip_missing=True)
        assert (values.tolist(), some.rows.tolist(), some.columns["site"].tolist()) == ([[1]], [1], ["A"])
        with pytest.raises(ValueError, match=f"{path.name}: row 2: the depth is missing"):
            table.values(["depth"])
        with pytest.raises(ValueError, match="those of a plane"):
            _ = table.lonlat
    for wrong, message in (
        ({"plane": ("east", "up")}, "there is no column 'up'; the columns are 'site'"),
        ({"plane": ("east", "north"), "lon": "east"}, "plane names the columns of both coordinates"),
    ):
        with pytest.raises(ValueError, match=message):
            read_points(tmp_path / "a.csv", **wrong)
    with pytest.raises(ValueError, match="there is no column 'x'; the columns are none at all"):
        read_points(io.StringIO('{"features": []}'), plane=("x", "y"))


def test_a_table_of_a_plane_is_written_in_its_own_coordinates(tmp_path):
    table = PointTable([[3500, 5400]], {"east": [7]}, surface="plane", axes=("east", "north"), crs="EPSG:31467")
    with pytest.warns(RenamedColumnWarning, match="'east' is written as 'east_1'"):
        write(tmp_path / "a.csv", table)
    assert (tmp_path / "a.csv").read_text().splitlines() == ["east,north,east_1", "3500,5400,7"]
    write(tmp_path / "a.gpkg", table)
    found = geopandas.read_file(tmp_path / "a.gpkg")
    assert (found.crs.to_epsg(), found.geometry[0].coords[:]) == (31467, [(3500, 5400)])


@pytest.mark.parametrize(
    ("names", "found"),
    [
        (["lon", "lat"], ("lon", "lat")),
        (["LATITUDE", "Longitude", "x", "y"], ("Longitude", "LATITUDE")),
        (["decimalLatitude", "decimalLongitude", "elevation"], ("decimalLongitude", "decimalLatitude")),
        (["latitude_deg", "longitude_deg"], ("longitude_deg", "latitude_deg")),
        (["lon", "start_lon", "lat", "start_lat"], ("lon", "lat")),
        (["x", "y", "platform", "belongs"], ("x", "y")),
        ([" lng ", "Lat "], (" lng ", "Lat ")),
    ],
)
def test_columns_are_found_by_name(names, found):
    assert find_lonlat(names) == found
    assert read_points(io.StringIO("A,B\n1,2\n"), lon="b", lat="A").lonlat.tolist() == [[2, 1]]  # in any case


def test_long_tables_are_read_in_blocks(monkeypatch):
    monkeypatch.setattr("stereodel.io.formats.delimited.BLOCK", 2)
    rows = [f"{k},{k / 2},name {k}" for k in range(7)]
    table = read_points(io.StringIO("\n".join(["lon,lat,name", *rows, ",,", "", " "])))
    assert table.lonlat.tolist() == [[k, k / 2] for k in range(7)]
    assert table.columns["name"][6] == "name 6"
    with pytest.raises(ValueError, match="row 6 has 1 field"):
        read_points(io.StringIO("\n".join(["lon,lat,name", *rows[:5], "7", *rows[5:]])))


@pytest.mark.parametrize("kind", ["int64", "uint64"])
def test_whole_numbers_that_no_double_equals(tmp_path, kind):
    frame = pd.DataFrame({"lon": np.array([1, 2**53 + 1], kind), "lat": [1, 2]})
    frame.to_parquet(tmp_path / "cities.parquet")
    with pytest.raises(ValueError, match="row 2: the longitude 9007199254740993 is not a double; subtract an origin"):
        read_points(tmp_path / "cities.parquet")


@pytest.mark.parametrize(("ending", "crs"), [("geojson", 4326), ("gpkg", 3857), ("parquet", 3857)])
def test_files_of_geopandas(tmp_path, ending, crs):
    path, points = tmp_path / f"cities.{ending}", frame().to_crs(crs)
    points.to_parquet(path) if ending == "parquet" else points.to_file(path)
    assert_cities(read_points(path))
    with path.open("rb") as stream:
        assert_cities(read_points(stream))


def test_tables_are_values():
    lonlat = np.array([[1.0, 2.0]])
    table = PointTable(lonlat, {"name": ["a"]})
    lonlat[:] = 0
    assert table.lonlat.tolist() == [[1, 2]]
    with pytest.raises(ValueError, match="read-only"):
        table.lonlat[0, 0] = 5
    with pytest.raises(TypeError):
        table.columns["name"] = []
