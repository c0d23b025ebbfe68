"""Tables as people have them: what is read, what is said of it, and what is refused with the option that helps."""

import gzip
import io
import json
import warnings
from zipfile import ZipFile

import duckdb
import geopandas
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest
import xarray
from typer.testing import CliRunner

from stereodel import SphericalVoronoi
from stereodel.cli.application import app
from stereodel.io import DataWarning, PointTable, inspect, nearest_shapes, read_points, to_geodataframe, write

ULM, KIEL = (9.99, 48.4), (10.1, 54.3)
TWO = [ULM, KIEL]
NAMES, GROUPED = {"name": ["Ulm", "Kiel"]}, {"n": [128928, 1085664]}


def case(content, places=TWO, columns=None, note="", **options):
    """A table with | between its lines: what is read by some options, and what is said or, as places, refused."""
    return content.replace("|", "\n"), options, places, columns or {}, note


HEADERS = """
Länge;Breite|Längengrad;Breitengrad|geogr. Länge;geogr. Breite|longitud;latitud|Longitudine;Latitudine|долгота;широта|\
经度;纬度|経度;緯度|خط الطول;خط العرض|X_COORD;Y_COORD|POINT_X;POINT_Y|geoLaenge;geoBreite
"""
READ = [
    case("sep=;|name;lon;lat|Ulm;9,99;48,4|Kiel;10,1;54,3", TWO, NAMES),
    case("Report 2024|by us||name,lon,lat|Ulm,9.99,48.4|Kiel,10.1,54.3", TWO, NAMES, "2 rows above"),
    case("Report;;|;;|name;lon;lat|Ulm;9,99;48,4|Kiel;10,1;54,3", TWO, NAMES, "1 row above"),
    case("a|b,c,d|lon,lat,v|9.99,48.4,1|10.1,54.3,2", TWO, {"v": [1, 2]}, skip_rows=2),
    case("lon,lat,rain|deg,deg,mm|9.99,48.4,7|10.1,54.3,8", TWO, {"rain": [7, 8]}, "a row of units is left out"),
    case("name;lon;lat;n|Ulm;9,99;48,4;128.928|Kiel;10,1;54,3;1.085.664", TWO, NAMES | GROUPED, "thousands"),
    case("n;lon;lat|1.234;9,99;48,4|2.345;10,1;54,3", TWO, {"n": [1234, 2345]}, decimal=","),
    case("n;lon;lat|1.234;9;48|2.345;10;54", [(9, 48), (10, 54)], {"n": [1.234, 2.345]}, decimal="."),
    case("n;lon;lat|1'763'000;9.99;48.4|1\u202f763\u202f000.5;10.1;54.3", TWO, {"n": [1763000, 1763000.5]}),
    case("n;lon;lat|\u22125;9,99;48,4|12;10,1;54,3", TWO, {"n": [-5, 12]}),
    case("t,lon,lat|-9999,9.99,48.4|12.5,10.1,54.3", TWO, {"t": [None, 12.5]}, missing=[-9999]),
    case("t,lon,lat|keine,9.99,48.4|12.5,10.1,54.3", TWO, {"t": [None, 12.5]}, missing="keine"),
    case("lon,lat|-9999,48|9.99,48.4", [ULM], missing=["-9999"], skip_missing=True),
    case("lon,lat|9.99,48.4|181,91|10.1,54.3|x,3", note="2 rows are left out: row 2: latitude 91", skip_invalid=True),
    case("lon,lat|9.99,48.4|1,2,3|10.1,54.3", note="1 row is left out: row 2: has 3 fields", skip_invalid=True),
    case("lon,lat|9.99,48.4|99999,3", [ULM], note="row 2: longitude 99999.0 is outside", skip_invalid=True),
    case("lon,lat|729.99,48.4", [(729.99, 48.4)], wrap=True),
    case("lon,lat,|9.99,48.4|10.1,54.3,,"),
    case("v,lon,lat|#N/A,9.99,48.4|2,10.1,54.3", TWO, {"v": [None, 2]}),
    case("n;lon;lat|1.085.664;9;48|128.928;10;54", [(9, 48), (10, 54)], {"n": GROUPED["n"][::-1]}, "thousands"),
    case("n;m;lon;lat|1.085.664;128.928;9;48", [(9, 48)], {"n": [1085664], "m": [128928]}, 2),
    case('n,lon,lat|"1,234","9,99","48,4"', [ULM], {"n": [1.234]}),
    case("n;lon;lat|1,5;9.99;48.4", [ULM], {"n": ["1,5"]}, "not a number with the decimal mark '.'", decimal="."),
    case("n;lon;lat|1.234.567;9.99;48.4", [ULM], {"n": ["1.234.567"]}, "kept as text"),
    case('"name" "lon" "lat"|"New  York" -74 40.7', [(-74, 40.7)], {"name": ["New York"]}),
    case("lon,lat,n|deg,deg,mm|9.99,48.4,7|1,2|10.1,54.3,8", TWO, {"n": [7, 8]}, 2, skip_invalid=True),
    case("id,lon,lat|1E3,9.99,48.4|7,10.1,54.3", TWO, {"id": ["1E3", "7"]}),
    case("v,lon,lat|1E+16,9.99,48.4|1.5E3,10.1,54.3", TWO, {"v": [1e16, 1500]}),
    case("lon\tlat|10°59'07″E\t48°24'N", [(10.985277777777778, 48.4)]),
    case("lon;lat|170 41,4 W;S 12° 30' 15,5''", [(-170.69, -12.504305555555556)]),
    case("lon,lat|170.70W,12:30:15|\u22125°,1d30m", [(-170.7, 12.504166666666666), (-5, 1.5)]),
    case("wkt,v|POINT (9.99 48.4),1|POINT Z (10.1 54.3 7),2", TWO, {"v": [1, 2]}),
    case("lonlat,v|9.99 48.4,1|10.1 54.3,2", TWO, {"v": [1, 2]}, "'lonlat' is read as longitude, latitude"),
    case("at;v|48°24'N 9°59'24″E;1", [(9.99, 48.4)], {"v": [1]}, "'at' is read as latitude, longitude"),
    case('at,v|"48.4, 9.99",1', [ULM], {"v": [1]}, lon="at", lat="at"),
    *(case(f"{names}|9,99;48,4|10,1;54,3") for names in HEADERS.strip().split("|")),
    case("10 48.4|2 51", [(10, 48.4), (2, 51)], {}, "there is no header: column_1 is read as the longitude"),
    case("48.4 10|51 2", [(10, 48.4), (2, 51)], lon="column_2", lat="column_1"),
    case("35.7,139.7|-9,9", [(-9, 9)], {}, 2, skip_invalid=True),
    case("where|48.4, 9.99|54.3, 10.1", TWO, {}, "'where' is read as latitude, longitude; the name 'lonlat' says it"),
    case("Länge/Breite|9,99 / 48,4|10,1 / 54,3", TWO, {}, "is read as longitude, latitude; the name 'latlon' says it"),
    case("cache|N 48° 24.000 E 009° 59.400|N 54° 18.000 E 010° 06.000", TWO, {}, "is read as latitude, longitude"),
    case("geom|SRID=4326;POINT(9.99 48.4)|SRID=4326;MULTIPOINT((10.1 54.3))"),
    case("geom,v|POINT EMPTY,1|POINT(9.99 48.4),2", [ULM], {"v": [2]}, skip_missing=True),
    case("# by us|# lat,lon|48.4,9.99|54.3,10.1", TWO, {}, "the last line of comments is read as the header"),
    case("# lat, lon, as text|lon,lat|9.99,48.4|10.1,54.3"),
    case("sep=~|name~lon~lat|Ulm~9.99~48.4|Kiel~10.1~54.3", TWO, NAMES),
    case("lat,NS,lon,EW|48.4,N,9.99,W", [(-9.99, 48.4)], {"NS": ["N"], "EW": ["W"]}, 2),
    case("lon,EW,lat,wind|-9.99,W,48.4,S", [(-9.99, 48.4)], {"EW": ["W"], "wind": ["S"]}),
    case("lon;lat|9,5° Ost;48° Nord|9°30' Ouest;48° Süd", [(9.5, 48), (-9.5, -48)]),
    case("lon;lat|9,5° O;48°|1° W;48°", [(9.5, 48), (-1, 48)], {}, "column 'lon': O is read as E, by its name"),
    case("lon;lat|9,5° O;48°|1° E;48°", [(-9.5, 48), (1, 48)], {}, "column 'lon': O is read as W"),
    case("Länge;Breite|9°30'O;48°N", [(9.5, 48)], {}, "O is read as E"),
    case("longitud;latitud|9°30'O;48°N", [(-9.5, 48)], {}, "O is read as W"),
    case("経度;緯度|東経139度30分;北緯35度|37°30' в.д.;55° ю.ш.", [(139.5, 35), (37.5, -55)]),
    case("lon;lat|٩٫٩٩;٤٨٫٤|–۱۰.۱;\u200b５４.３", [ULM, (-10.1, 54.3)]),
    case("name,lon,lat,n|Ulm,9,48,7|Kiel,10,54,8|Grand Total,,,15", [(9, 48), (10, 54)], NAMES | {"n": [7, 8]}, 1),
    case("name;lon;lat|Ulm;9;48|Kiel;10;54|Mittelwert:;9,5;51", [(9, 48), (10, 54)], NAMES, "a row of totals"),
    case("name,lon,lat|Aral,9.99,48.4|Total,10.1,54.3", TWO, {"name": ["Aral", "Total"]}),
    case('{"name":"Ulm","lon":9.99,"lat":48.4}|{"name":"Kiel","lon":10.1,"lat":54.3}', TWO, NAMES),
    case('[{"where":"48.4, 9.99"},{"where":"54.3, 10.1"}]', TWO, {}, "is read as latitude, longitude"),
    case("a,10,48.4|b,2,51", [(10, 48.4), (2, 51)], {"column_1": ["a", "b"]}, lon="column_2", lat="column_3"),
    case('n;lon;lat|"Ulm; Donau, B";9,99;48,4|"a\nb";10,1;54,3', TWO, {"n": ["Ulm; Donau, B", "a\nb"]}),
    case("\ufefflon,lat|9.99,48.4||10.1,54.3"),
    case("lon,lat,name|", [], {"name": []}),
    # refused, with the option that helps
    case("lon,lat|1" + 5000 * " " + "x,2", "row 1: the longitude .* is not a number"),
    case("lon,lat|9,48|99999,3", r"row 2: longitude 99999.0 is outside .* skip_invalid=True, or .* wrap=True"),
    case("lon,lat|9,48|181,91", "row 2: latitude 91.0 is outside .* leave such rows out with skip_invalid=True"),
    case("lon,lat|48°N,9°E", "row 1: the longitude '48°N' is a latitude"),
    case("lon,lat|9°O,48°", "row 1: the longitude '9°O' has an O, which is east in German and west in .* skip_inv"),
    case("at|48°N 9°O", "row 1: the longitude '48°N 9°O' has an O, which is"),
    case("lon~lat|9~48", "both the column 'lon~lat'.*; a first line such as sep=~ says what separates columns"),
    case("lon,lat|3571234,5363123", "row 1: latitude 5363123.0 is outside .* give crs=, or"),
    case("name,where|Ulm,48.4, 9.99", "row 1 has 3 fields, .* put fields with separators in quotation marks, or"),
    case("lat,lon|4824N,00959E", "row 1: the longitude '00959E' is not a number"),
    case("lon,lat|9°75',48", "row 1: the longitude .9°75'. is not a number"),
    case("lon,lat|9,48", "encoding is 'cp1525', which does not exist", encoding="cp1525"),
    case("lon,lat|9,48", "decimal is 'x', but must be one of", decimal="x"),
    case("v\t|SRID=1;POINT(1 2)\t|SRID=2;POINT(1 2)\t", "several coordinate systems, 1, 2"),
    case("g;v|SRID=3857;1", "column 'g' is to have both coordinates", lon="g", lat="g"),
]


def heard(read, *source, **options):
    """What is read, and what was said of it."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", DataWarning)
        return read(*source, **options), [str(each.message) for each in said]


@pytest.mark.parametrize(("content", "options", "places", "columns", "note"), READ)
def test_a_dirty_table(content, options, places, columns, note):
    if isinstance(places, str):
        with pytest.raises(ValueError, match=places):
            heard(read_points, io.StringIO(content), **options)
        return
    table, told = heard(read_points, io.StringIO(content), **options)
    assert table.places.tolist() == [list(place) for place in places]
    assert table.rows.tolist() == [*range(1, len(places) + 1)] or "left out" in str(told) or "skip_missing" in options
    got = {name: [None if each != each else each for each in values.tolist()] for name, values in table.columns.items()}
    assert got == columns
    assert len(told) == int(note if isinstance(note, int) else bool(note))
    assert str(note) in "".join(told) or isinstance(note, int)


@pytest.mark.parametrize(
    ("text", "encoding", "guess"),
    [
        ("Stadt,lon,lat\nKöln,6.9,50.9\nMünchen,11.6,48.1\n", "cp1252", "cp1252"),
        ("ville,lon,lat\nOrléans,1.9,47.9\n", "latin-1", "cp1252"),
        ("miasto,lon,lat\nŁódź,19.4,51.7\nKraków,19.9,50\nGdańsk,18.6,54.3\n", "cp1250", "cp1250"),
        ("город,lon,lat\nМосква,37.6,55.7\nКазань,49.1,55.8\nСамара,50.1,53.2\n", "cp1251", "cp1251"),
        ("都市,lon,lat\n東京,139.7,35.7\n大阪,135.5,34.7\n名古屋,136.9,35.2\n", "shift_jis", "cp932"),
    ],
)
def test_encodings(text, encoding, guess):
    expected = read_points(io.StringIO(text))
    told = read_points(io.BytesIO(text.encode(encoding)), encoding=encoding)
    with pytest.warns(DataWarning, match=f"is not text in UTF-8; the file is read in the encoding {guess}, which is a"):
        guessed = read_points(io.BytesIO(text.encode(encoding)))
    for table in (told, guessed):
        assert table.lonlat.tolist() == expected.lonlat.tolist()
        assert [values.tolist() for values in table.columns.values()] == [c.tolist() for c in expected.columns.values()]
    for name in ("utf-16", *(["utf-16-le", "utf-16-be"] if text[0] < "\x80" else [])):
        assert [*read_points(io.BytesIO(text.encode(name))).columns] == [*expected.columns]
    packed = read_points(io.BytesIO(gzip.compress(text.encode())))
    assert packed.lonlat.tolist() == expected.lonlat.tolist()
    with pytest.raises(ValueError, match="line 2 is not text in ascii; say which encoding the file has with encoding="):
        read_points(io.BytesIO(text.replace("都市", "a").replace("город", "a").encode()), encoding="ascii")


OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
KIND = "application/vnd.openxmlformats-officedocument.spreadsheetml"


def workbook(path, sheets):
    """Sheets of rows of text and numbers, as small as a workbook may be."""

    def cell(value):
        return f"<c><v>{value}</v></c>" if value != str(value) else f'<c t="inlineStr"><is><t>{value}</t></is></c>'

    names, links, parts = "", "", {}
    types = f'<Override PartName="/xl/workbook.xml" ContentType="{KIND}.sheet.main+xml"/>'
    for k, (name, rows) in enumerate(sheets.items(), 1):
        types += f'<Override PartName="/xl/worksheets/sheet{k}.xml" ContentType="{KIND}.worksheet+xml"/>'
        names += f'<sheet name="{name}" sheetId="{k}" r:id="r{k}"/>'
        links += f'<Relationship Id="r{k}" Type="{OFFICE}/worksheet" Target="worksheets/sheet{k}.xml"/>'
        cells = "".join(f"<row>{''.join(map(cell, row))}</row>" for row in rows)
        parts[f"worksheets/sheet{k}.xml"] = f"<worksheet><sheetData>{cells}</sheetData></worksheet>"
    parts["../[Content_Types].xml"] = f"<Types>{types}</Types>"
    parts["workbook.xml"] = f'<workbook xmlns:r="{OFFICE}"><sheets>{names}</sheets></workbook>'
    parts["_rels/workbook.xml.rels"] = f"<Relationships>{links}</Relationships>"
    with ZipFile(path, "w") as archive:
        for name, text in parts.items():
            archive.writestr(f"xl/{name}".replace("xl/../", ""), text)


def test_sheets_of_text_with_titles_and_several_sheets(tmp_path):
    path, header = tmp_path / "book.xlsx", ["name", "lon", "lat"]
    plain = [header, ["Ulm", "9.99", "48.4"], ["Kiel", "10.1", "54.3"]]
    workbook(path, {"Text": plain, "Titel": [["Report", "", ""], header, ["Ulm", *ULM], ["Kiel", *KIEL]]})
    for sheet in ("Text", "Titel"):
        table, _ = heard(read_points, path, layer=sheet)
        assert table.lonlat.tolist() == [list(place) for place in TWO]
        assert table.columns["name"].tolist() == ["Ulm", "Kiel"]
    with pytest.raises(ValueError, match="several layers, 'Text', 'Titel'; give a file with one, or say which"):
        read_points(path)


COLUMNS = {"lon": [9.99, 10.1], "lat": [48.4, 54.3], "name": ["Ulm", "Kiel"], "n": [1, 2**53 + 1]}


def relation(columns):
    given = pa.table(columns)  # noqa: F841 - DuckDB sees it
    return duckdb.sql("SELECT * FROM given")


@pytest.mark.parametrize("frame", [pd.DataFrame, pl.DataFrame, pl.LazyFrame, pa.table, relation])
def test_frames_at_every_door(tmp_path, frame):
    source = frame(COLUMNS)
    table = read_points(source)
    assert table.lonlat.tolist() == [list(place) for place in TWO]
    assert [values.tolist() for values in table.columns.values()] == [COLUMNS["name"], COLUMNS["n"]]
    diagram, others = SphericalVoronoi(table.points()), frame({"name": COLUMNS["name"]})
    assert to_geodataframe(diagram, columns=others)["name"].tolist() == COLUMNS["name"]
    write(tmp_path / "a.csv", diagram, columns=others)
    assert "Kiel" in (tmp_path / "a.csv").read_text()
    write(tmp_path / "a.nc", diagram, columns=others, what="triangles")
    with xarray.open_dataset(tmp_path / "a.nc") as mesh:
        assert mesh["name"].values.tolist() == COLUMNS["name"]
    assert PointTable(TWO, others).columns["name"].tolist() == COLUMNS["name"]
    assert inspect(source).found["rows"] == 2
    with pytest.raises(ValueError, match="without geometries; it can be read as points"):
        nearest_shapes(TWO, source)


def test_missing_values_and_odd_types_of_frames():
    columns = {"a": pd.Categorical([None, "x"]), "b": pa.array([2.5, None]).dictionary_encode().to_pandas()}
    columns |= {"c": pd.array([None, 3], "Int64"), "d": pd.to_datetime([None, "2020-01-01T05+02:00"])}
    columns |= {"e": pd.period_range("2020-01", periods=2, freq="M"), "f": ["9,5", 2]}
    frame = pd.DataFrame({"lon": pd.Categorical([None, 10.1]), "lat": [48.4, 54.3], **columns})
    for given in (frame, frame.drop(columns="f")):  # Arrow has no column of text and numbers
        table = read_points(given, skip_missing=True)
        assert (table.places.tolist(), table.rows.tolist()) == ([[10.1, 54.3]], [2])
        got = [each.tolist()[0] for each in table.columns.values()]
        assert got[:1] + got[2:5] == ["x", 3, frame["d"][1], frame["e"][1]]
        assert np.isnan(got[1])
    twice = pa.table([[1.0], [2.0], [3.0]], names=["lon", "lat", "lat"])
    with pytest.raises(ValueError, match=r'cannot be read, .*"lat" exists 2'):
        read_points(twice)


def test_an_index_and_geometries_of_frames():
    named = pd.DataFrame(COLUMNS).set_index("name")
    assert read_points(named).columns["name"].tolist() == COLUMNS["name"]
    points = geopandas.points_from_xy(*np.transpose(TWO))
    for crs in (4326, None):  # those without a coordinate system are degrees
        assert read_points(geopandas.GeoSeries(points, crs=crs)).lonlat.tolist() == [list(place) for place in TWO]
        arrow = pa.table(geopandas.GeoDataFrame(NAMES, geometry=points, crs=crs).to_arrow())
        assert read_points(arrow).lonlat.tolist() == [list(place) for place in TWO]
        assert nearest_shapes(TWO, arrow)[0].tolist() == [0, 1]


@pytest.mark.parametrize("door", [read_points, lambda given: PointTable(TWO, given)])
def test_what_is_no_frame_is_refused(door):
    for given in ({1, 2}, pd.Series([1, 2])):
        with pytest.raises(TypeError, match=f"a frame, not {type(given).__name__}"):
            door(given)


DIRTY = """Bericht

Stadt;Länge;Breite;n;t
Köln;6,95;50,94;1.085.664;-9999
Ulm;9,99;48,4;128.928;12,5
X;181;91;5;13
Ulm;9,99;48,4;7;14"""


def test_inspect_says_what_was_understood():
    report = inspect(io.BytesIO(DIRTY.encode("cp1252")))
    found = report.found
    assert (found["encoding"], found["separator"], found["place"]) == ("cp1252", ";", ["Länge", "Breite"])
    assert (found["rows"], found["duplicates"], found["extent"]) == (3, 1, [6.95, 48.4, 9.99, 50.94])
    assert found["left_out"] == {3: "latitude 91.0 is outside [-90, 90]"}
    assert found["far"] == {"t": {-9999.0: 1}}
    assert found["columns"]["n"] == {"type": "integer", "range": [7, 1085664], "missing": 0}
    assert found["columns"]["Stadt"]["examples"] == ["Köln", "Ulm"]
    assert json.loads(json.dumps(found))["thousands"] == {"n": "."}
    options = {"encoding": "cp1252", "lon": "Länge", "lat": "Breite", "decimal": ",", "skip_rows": 2}
    options |= {"missing": [-9999.0], "skip_invalid": True}
    assert dict(found["options"]) == options
    table, told = heard(read_points, io.BytesIO(DIRTY.encode("cp1252")), **options)
    assert told == ["1 row is left out: row 3: latitude 91.0 is outside [-90, 90]"]
    assert np.isnan(table.columns["t"][0])
    text = str(report)
    assert "left out    row 3: latitude 91.0" in text
    assert "options     encoding='cp1252' lon='Länge' lat='Breite' decimal=',' skip_rows=2 missing=[-9999.0]" in text


SAME = ("place", "notation", "rows", "left_out", "extent", "header", "separator", "thousands", "columns", "crs")


@pytest.mark.parametrize(("content", "options"), [each[:2] for each in READ if not isinstance(each[2], str)])
def test_the_options_of_an_inspection_say_the_same(content, options):
    found = inspect(io.StringIO(content), **options).found
    again = inspect(io.StringIO(content), **found["options"]).found
    assert {name: again.get(name) for name in SAME} == {name: found.get(name) for name in SAME}


@pytest.mark.parametrize("field", ["", "t;"])
def test_decimal_commas_are_no_separators_under_a_title(field):
    head, row = f"Report\n\n{field}lon;lat", f"{field and '1,5;'}8,5;54,25"
    with pytest.warns(DataWarning, match="1 row above the header left out"):
        table = read_points(io.StringIO("\n".join([head, row, row])))
    assert (table.lonlat[0].tolist(), [*table.columns]) == ([8.5, 54.25], ["t"] if field else [])


def test_options_are_quoted_as_a_shell_wants_them():
    ran = CliRunner().invoke(app, ["inspect", "-"], input="My Lon, [deg];lat\n9,5;48,5\n")
    assert "options     '--lon=My Lon, [deg]' --lat=lat\n" in ran.stdout


def test_inspect_answers_where_reading_cannot():
    found = inspect(io.StringIO("a,b\n1,2\n3,4")).found
    assert "no column looks like the longitude" in found["problem"]
    assert (found["header"], inspect(io.StringIO("1 2\n3 4")).found["header"]) == (1, None)
    assert found["columns"]["a"] == {"type": "integer", "range": [1, 3], "missing": 0}
    assert inspect(io.StringIO("lon,lat\n48,9\n50,99\n60,-80")).found["swapped"] is False
    japan = inspect(io.StringIO("lon,lat\n35.7,139.7\n34.7,135.5\n43,-80"))
    assert "swapped?    the longitudes look like latitudes" in str(japan)
    none = inspect(io.StringIO("x,y\n3571234,5363123"), missing=[-9]).found
    assert (none["rows"], none["problem"]) == (0, "no row has a place")
    assert none["left_out"] == {1: "latitude 5363123.0 is outside [-90, 90]"}
    assert none["options"] == {"lon": "x", "lat": "y", "missing": ["-9"]}
    gaps = inspect(io.StringIO("lon,lat\n1,\n3,4")).found["options"]
    assert gaps == {"lon": "lon", "lat": "lat", "skip_missing": True}
    with pytest.warns(DataWarning, match="1 of the values of 't' are -9999, far outside all others; missing= leaves"):
        read_points(io.StringIO("lon,lat,t\n1,2,-9999\n2,3,4\n3,4,5")).values(["t"])
