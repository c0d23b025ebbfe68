"""Files that a reader drops on the page: the places that `read_points` finds, and the row of what is wrong."""

import base64
import gzip
import json

import pytest

from stereodel.io import read_points

from .conftest import SCRIPT

pytestmark = pytest.mark.filterwarnings("ignore::stereodel.io.DataWarning")


def geojson(*geometries, **members):
    features = [{"type": "Feature", "geometry": geometry} for geometry in geometries]
    return json.dumps({"type": "FeatureCollection", "features": features, **members})


def point(*coordinates):
    return {"type": "Point", "coordinates": list(coordinates)}


def crs(name):
    return {"type": "name", "properties": {"name": name}}


READABLE = {
    "plain.csv": "name,lon,lat\nQuito,-78.5,-0.2\nUlm,10,48.4\n",
    "comma.csv": "name;Longitude;Latitude;people\nQuito;-78,5;-0,2;1763000\nUlm;10,0;48,4;129000",
    "no_names.csv": "5,7\n8,9\n",
    "comments.csv": "# a\r\n# b\nlon,lat\n1,2\n",
    "signs.csv": "lon,lat\n+.5e1,-5.\n",
    "words_in_names.csv": "stationLon,the lat\n1,2\n",
    "quoted.csv": 'name,lon,lat\n"a, b ""c""\nnext",1,2\n',
    "utf16.csv": "name,lon,lat\nQuíto,1,2\n".encode("utf-16"),
    "mark.csv": "\ufefflon,lat\n1,2\n",
    "xy.csv": "X,Y\n1,2\n",
    "crlf.csv": "lon,lat\r\n1,2\r\n\r\n3,4\r\n",
    "cr.csv": "lon,lat\r1,2\r3,4",
    "blanks.txt": "  lon   lat\n1 2\n\n3\t4\n",
    "empty_column.csv": "lon,lat,\n1,2,\n3,4,\n",
    "empty_rows.csv": "lon,lat\n\n,\n1,2\n",
    "titles.csv": "Report 2024\nby us\n\nname;lon;lat\nUlm;9,99;48,4\nKiel;10,1;54,3\n",
    "utf16le.csv": "name,lon,lat\nQuíto,1,2\n".encode("utf-16-le"),
    "cp1252.csv": "name;Länge;Breite\nMünchen;11,57;48,14\n".encode("cp1252"),
    "dms.csv": "Longitud\tlatitud\n78°30'00\"W\t0°13.2' S\n10° 59′ 07.123″ Ost\tN 48,4\n-12:30\t− 1 7.5\n",
    "letters.csv": "lat,N/S,lon,E/W\n0.2,S,78.5,W\n48.4,N,10,E\n",
    "russian.csv": "имя|Широта|Долгота\nА|55.75|37.62 в.д.\n",
    "coords.csv": "YCOORD,XCOORD,n\n1,2,3\n",
    "ends.csv": "lon,lat\n1,2,,\n3,4\n",
    "point.geojson": geojson(point(10, 48.4, 500)),
    "feature_alone.geojson": json.dumps({"type": "Feature", "geometry": point(1, 2)}),
    "multipoint.geojson": geojson({"type": "MultiPoint", "coordinates": [[1, 2]]}),
    "degrees.geojson": geojson(point(1, 2), crs=crs("urn:ogc:def:crs:OGC:1.3:CRS84")),
}

WRONG = {
    "empty.csv": ("", "the table is empty"),
    "comments_alone.csv": ("# a\n# b\n", "the table is empty"),
    "repeated_column.csv": ("lon,lon,lat\n1,2,3\n", "there are several columns with the name 'lon'"),
    "missing.csv": ("lon,lat\n1,\n2,NA\n3,4\n", "Row 1: the latitude is missing"),
    "infinite.csv": ("lon,lat\n1,2\n2,-1e999\n", "Row 2: the latitude is '-1e999', not degrees with a sign, N or S"),
    "words.csv": (
        "lon,lat\n1,2\nüber,3\nx,4\nx,4\n",
        "Row 2: the longitude is 'über', not degrees with a sign, E or W",
    ),
    "underscore.csv": ("lon,lat\n1_000,2\n", "Row 1: the longitude is '1_000', not degrees"),
    "outside.csv": ("lon,lat\n5,7\n7,95.2\n8,1e20", "Row 2: longitude 7, latitude 95.2 is not on Earth"),
    "short_row.csv": ("lon,lat\n1,2\n3\n", "Row 2: it has 1 in place of 2 fields"),
    "long_row.csv": ("lon,lat\n1,2\n3,4,5\n", "Row 2: it has 3 in place of 2 fields"),
    "open_quote.csv": ('name,lon,lat\n"a,1,2\nb,3,4\n', 'in "a,1,2'),
    "after_quote.csv": ('name,lon,lat\n"a"x,1,2\n', 'in "a"x,1,2'),
    "no_rows.csv": ("lon,lat\n", "there are no points"),
    "no_features.geojson": (geojson(), "there are no points"),
    "far_round.csv": ("lon,lat\n1,2\n9999.5,3\n", "Row 2: longitude 9999.5, latitude 3 is not on Earth"),
    "swapped.csv": ("lon,lat\n48 N,2\n3,4\n", "Row 1: the longitude is '48 N', not degrees with a sign, E or W"),
    "east_or_west.csv": ("lon,lat\n2 O,2\n3,4\n", "Row 1: the longitude is '2 O', not degrees with a sign, E or W"),
    "seconds.csv": ("lon,lat\n1,2 70 0 N\n3,4\n", "Row 1: the latitude is '2 70 0 N', not degrees"),
    "cyrillic.csv": ("lon,lat,имя\n1,2,Москва\n".encode("cp1251"), "neither a picture nor a table in text"),
    "my book.xlsx": (b"PK\x03\x04\x14\0\x06\0", 'to make a page of it, type: stereodel web "my book.xlsx"'),
    "walk.gpx": ("<?xml version='1.0'?>\n<gpx></gpx>", "to make a page of it, type: stereodel web walk.gpx"),
    "packed.csv.gz": (gzip.compress(b"lon,lat\n1,2\n"), "type: stereodel web packed.csv.gz"),
    "torn.geojson": ('{"features":[1,', "the file is not JSON: "),
    "list.json": ("[1,2]", "the file is not a GeoJSON FeatureCollection of points"),
    "number.geojson": ('{"features":[3]}', "Row 1: a Point is needed, not no geometry"),
    "no_geometry.geojson": (geojson(point(1, 2), None), "Row 2: a Point is needed, not no geometry"),
    "polygon.geojson": (geojson({"type": "Polygon", "coordinates": []}), "Row 1: a Point is needed, not Polygon"),
    "several.geojson": (geojson({"type": "MultiPoint", "coordinates": [[1, 2], [3, 4]]}), "Row 1: a Point is needed"),
    "one_coordinate.geojson": (geojson(point(5)), "Row 1: a Point has two or three coordinates, not [5]"),
    "null.geojson": (geojson(point(1, None)), "Row 1: a Point has two or three coordinates, not [1,null]"),
    "latitude.geojson": (geojson(point(1, 97.2)), "Row 1: longitude 1, latitude 97.2 is not on Earth"),
    "cities.xyz": (b"\x89PNG\r\n\x1a\n\x00", "neither a picture nor a table in text that the page can read"),
}

PLANE = {
    "x,y\n1,2\n3,4e9\n": ("x", "y"),
    "n,Y,X\n1,2,3\n4,5,6\n": ("X", "Y"),
    "1 2.5\n3 4\n": ("lon", "lat"),
    "x;y\n567.890;1\n": ("x", "y"),
    "x;y\n567,890;0,5\n": ("x", "y"),
    "x;y\n567.890;1\n0.5;1\n0.25;1\n": ("x", "y"),
    'x,y\n"567,890",1\n"0,5",2\n': ("x", "y"),
}
"""Tables of a plane, with the columns that are taken."""

THOUSANDS = [
    "x;y\n567,890;1\n567,891;1\n",
    "x;y\n567,890;0.5\n",
    "x;y;z\n567.890;1;0,5\n",
    "x;y\n567.890;1\n0,5;1\n",
    'x,y\n"567,890",1\n',
]
"""Those where nobody knows whether a mark is decimal."""

READ = f"""
import {{ readPoints }} from "{SCRIPT}/files.ts";
const {{ kind, chosen, files }} = given;
const answers = {{}};
for (const [name, content] of Object.entries(files)) {{
  const bytes = new Uint8Array(Buffer.from(content, "base64"));
  try {{
    const found = readPoints(name, bytes, kind, chosen ?? undefined);
    const values = Object.fromEntries([...found.values].map(([name, all]) => [name, [...all]]));
    answers[name] = {{ ...found, places: [...found.places], values }};
  }} catch (error) {{
    answers[name] = {{ error: error.message, columns: error.columns }};
  }}
}}
export default answers;
"""


def on_page(node, files, kind="lonlat", chosen=None):
    bytes_of = {name: each if isinstance(each, bytes) else each.encode() for name, each in files.items()}
    packed = {name: base64.b64encode(each).decode() for name, each in bytes_of.items()}
    return node(READ, {"kind": kind, "chosen": chosen, "files": packed})


def in_python(folder, name, content, columns=None, **how):
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_points(path, plane=columns, **how).places.ravel().tolist()


CASES = [pytest.param("lonlat", name, content, None, id=name) for name, content in READABLE.items()]
CASES += [pytest.param("plane", "plane.csv", content, columns, id=content) for content, columns in PLANE.items()]


@pytest.mark.parametrize(("kind", "name", "content", "columns"), CASES)
def test_the_page_reads_what_the_library_reads(node, tmp_path, kind, name, content, columns):
    assert on_page(node, {name: content}, kind)[name]["places"] == in_python(tmp_path, name, content, columns)


@pytest.mark.parametrize(("content", "said"), WRONG.values(), ids=WRONG)
def test_what_is_wrong_is_told_and_left_out(node, request, tmp_path, content, said):
    name = request.node.callspec.id
    found = on_page(node, {name: content})[name]
    assert said in (found.get("error") or found["wrong"])
    if "places" in found and name != "east_or_west.csv":  # the library knows by other words which it is
        assert found["places"] == in_python(tmp_path, name, content, skip_invalid=True)


@pytest.mark.parametrize("content", THOUSANDS)
def test_a_mark_that_may_separate_thousands_is_refused(node, content):
    found = on_page(node, {"a.csv": content}, "plane")["a.csv"]
    assert "not a number without a mark between thousands" in (found.get("error") or found["wrong"])


@pytest.mark.thorough
def test_more_points_than_the_page_takes(node):
    said = on_page(node, {"stars.csv": "lon,lat\n" + "1,2\n" * 1_000_001})["stars.csv"]["error"]
    assert said.startswith("there are 1\u202f000\u202f001 points; the page takes up to 1\u202f000\u202f000;")


@pytest.mark.parametrize("names", ["east,north,height", "lon,b,c", "lon,longitude,lat", "long lat,b,c"])
def test_the_reader_is_asked_for_columns_where_names_do_not_decide(node, names):
    files, asked = {"a.csv": f"{names}\n7,1,0\n5,6,9\n"}, names.split(",")
    for kind in ["lonlat", "plane"]:
        assert on_page(node, files, kind)["a.csv"]["columns"] == asked
        assert on_page(node, files, kind, asked[1:])["a.csv"]["places"] == [1, 0, 6, 9]
