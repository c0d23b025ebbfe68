"""Files that a reader drops on the page: the same rows as `read_points` finds, and the same words for what is wrong."""

import base64
import gzip
import json

import pytest

from stereodel.io import read_points

from .conftest import SCRIPT

LONG = ",".join(f"column name number with many letters {k}" for k in range(40))

TABLES = {
    "plain.csv": "name,lon,lat\nQuito,-78.5,-0.2\nUlm,10,48.4\n",
    "comma.csv": "name;Longitude;Latitude;people\nQuito;-78,5;-0,2;1763000\nUlm;10,0;48,4;129000",
    "outside_often.csv": "lon,lat\n5,-97\n7,95.2\n8,1e20",
    "large.csv": "lon,lat\n5,1e16\n",
    "no_names.csv": "5,7\n8,9\n",
    "three_numbers.csv": "5,7,1\n8,9,2\n",
    "empty.csv": "",
    "comments_alone.csv": "# a\n# b\n",
    "comments.csv": "# a\r\n# b\nlon,lat\n1,2\n1,'3\n",
    "no_column.csv": "a,b\n1,2\n",
    "no_latitude.csv": "lon,b\n1,2\n",
    "quotes_in_names.csv": "it's,b\"c\n1,2\n",
    "two_columns.csv": "lon,longitude,lat\n1,2,3\n",
    "many_columns.csv": LONG + "\n" + ",".join("1" * 40) + "\n",
    "repeated_column.csv": "lon,lon,lat\n1,2,3\n",
    "one_for_both.csv": "long lat,b\n1,2\n",
    "missing.csv": "lon,lat\n1,\n2,NA\n3,4\n",
    "infinite.csv": "lon,lat\n1,inf\n2,-1e999\n",
    "words.csv": "lon,lat\n1,2\nüber,3\nx,4\n",
    "control.csv": "lon,lat\n\x07\t\u00e9\u2028,2\n",
    "underscore.csv": "lon,lat\n1_000,2\n",
    "point.csv": "lon,lat\n.,2\n",
    "signs.csv": "lon,lat\n+.5e1,-5.\n",
    "arabic_digit.csv": "lon,lat\n\u0661,2\n",
    "short_row.csv": "lon,lat\n1,2\n3\n",
    "long_row.csv": "lon,lat\n1,2\n3,4,5\n",
    "quoted.csv": 'name,lon,lat\n"a, b ""c""\nnext",1,2\n',
    "open_quote.csv": 'name,lon,lat\n"a,1,2\nb,3,4\n',
    "after_quote.csv": '# above\nname,lon,lat\n"b\nb",1,2\n"a"x,1,2\n',
    "latin1.csv": "name,lon,lat\nA,1,2\nQuíto,1,2\n".encode("latin1"),
    "utf16.csv": "name,lon,lat\nQuíto,1,2\n".encode("utf-16"),
    "mark.csv": "\ufefflon,lat\n1,2\n",
    "xy.csv": "X,Y\n1,2\n",
    "crlf.csv": "lon,lat\r\n1,2\r\n\r\n3,4\r\n",
    "cr.csv": "lon,lat\r1,2\r3,4",
    "empty_column.csv": "lon,lat,\n1,2,\n3,4,\n",
    "empty_rows.csv": "lon,lat\n\n,\n1,2\n",
    "header_alone.csv": "lon,lat\n",
    "packed.csv.gz": gzip.compress(b"lon,lat\n1,2\n"),
}


def geojson(*geometries, **members):
    features = [{"type": "Feature", "geometry": geometry} for geometry in geometries]
    return json.dumps({"type": "FeatureCollection", "features": features, **members})


def point(*coordinates):
    return {"type": "Point", "coordinates": list(coordinates)}


COLLECTIONS = {
    "point.geojson": geojson(point(10, 48.4, 500)),
    "feature.geojson": '{"type":"Feature"}',
    "feature_alone.geojson": json.dumps({"type": "Feature", "geometry": {"type": "Point", "coordinates": [1, 2]}}),
    "geometry_as_feature.geojson": '{"features":[{"type":"Point","coordinates":[1,2]}]}',
    "list.json": "[1,2]",
    "polygon.geojson": geojson({"type": "Polygon", "coordinates": []}),
    "no_geometry.geojson": geojson(point(1, 2), None),
    "number.geojson": '{"features":[3]}',
    "properties.geojson": '{"features":[{"properties":[1],"geometry":null}]}',
    "one_coordinate.geojson": geojson(point(5)),
    "text.geojson": geojson({"type": "Point", "coordinates": "a'b"}),
    "no_coordinates.geojson": geojson(point()),
    "multipoints.geojson": geojson({"type": "MultiPoint", "coordinates": [[1, 2], [3, 4]]}),
    "latitude.geojson": geojson(point(1, 97.2), point(1, 91)),
    "true.geojson": geojson(point(True, 2)),
    "texts.geojson": geojson(point("1.5", "2")),
    "no_type.geojson": geojson({"type": None}),
    "null.geojson": geojson(point(1, None), point([1], 3)),
    "degrees.geojson": geojson(crs={"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}),
    "no_name.geojson": geojson(crs={"properties": {"name": 5}}),
    "lines.geojsonl": "\n".join(json.dumps({"geometry": point(k, 2 * k)}) for k in range(3)),
    "nothing.geojson": geojson(),
}

XY = ("x", "y")
PLANE = {
    "x,y\n1,2\n3,4e9\n": XY,
    "x,y\n1,2\n3,\n": XY,
    "x,y\n1,2\nb,3\n": XY,
    "n,Y,X\n1,2,3\n4,5,6\n": ("X", "Y"),
    "1;2,5\n3;4\n": ("lon", "lat"),
    "x;y\n567.890;1\n": XY,
    "x;y\n567,890;1\n567,891;1\n": XY,
    "x;y\n567,890;0,5\n": XY,
    "x;y\n567,890;0.5\n": XY,
    "x;y;z\n567.890;1;0,5\n": XY,
    "x;y;z\n567.890;1;007,5\n": XY,
    "x;y\n567.890;1\n0,5;1\n": XY,
    "x;y\n567.890;1\n0.5;1\nNA;1\n": XY,
    "x,y\n567.890,1\n": XY,
    'x,y\n"567,890",1\n': XY,
    'x,y\n"567,890",1\n"0,5",2\n': XY,
}
"""Tables of a plane, with the columns that are taken."""

READ = f"""
import {{ readPoints }} from "{SCRIPT}/files.ts";
const {{ kind, chosen, files }} = given;
const answers = {{}};
for (const [name, content] of Object.entries(files)) {{
  const bytes = new Uint8Array(Buffer.from(content, "base64"));
  try {{
    const found = await readPoints(name, bytes, kind, chosen ?? undefined);
    answers[name] = {{ places: [...found.places], names: found.names }};
  }} catch (error) {{
    answers[name] = {{ error: error.message, columns: error.names }};
  }}
}}
export default answers;
"""


def on_page(node, files, kind="lonlat", chosen=None):
    bytes_of = {name: each if isinstance(each, bytes) else each.encode() for name, each in files.items()}
    packed = {name: base64.b64encode(each).decode() for name, each in bytes_of.items()}
    return node(READ, {"kind": kind, "chosen": chosen, "files": packed})


def in_python(folder, name, content, columns=None):
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    try:
        return {"places": read_points(path, plane=columns).places.ravel().tolist()}
    except ValueError as error:
        return {"error": str(error).removeprefix(f"{path}: ")}


CASES = [pytest.param("lonlat", name, content, None, id=name) for name, content in (TABLES | COLLECTIONS).items()]
CASES += [pytest.param("plane", "plane.csv", content, columns, id=content) for content, columns in PLANE.items()]


@pytest.mark.filterwarnings("ignore:column .* is kept as text")
@pytest.mark.parametrize(("kind", "name", "content", "columns"), CASES)
def test_the_page_reads_what_the_library_reads_in_its_words(node, tmp_path, kind, name, content, columns):
    found, expected = on_page(node, {name: content}, kind)[name], in_python(tmp_path, name, content, columns)
    assert {key: found.get(key) for key in expected} == expected


def test_random_tables_are_read_alike(node, tmp_path, rng):
    files = {}
    for k in range(40):
        mark = rng.choice([",", ";", "\t", "|", " "])
        places = rng.normal(scale=40, size=(rng.integers(1, 9), 2)).clip(-90, 90)
        form = rng.choice(["{:.3f}", "{:g}", "{:.17g}", "{:e}"])
        rows = [mark.join([f"n{row}", *(form.format(x) for x in place)]) for row, place in enumerate(places)]
        files[f"{k}.csv"] = "\n".join([mark.join(["name", "lng", "lat"]), *rows])
    found = on_page(node, files)
    for name, content in files.items():
        assert found[name]["places"] == in_python(tmp_path, name, content)["places"]
        assert found[name]["names"][0] == "n0"


PLACES = b"lon,lat\n" + b"1,2\n"
MOST = "has 1\u202f000\u202f001 points. The page takes up to 1\u202f000\u202f000; for more there is the Python library."


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("torn.geojson", '{"features":[1,', "the file is not JSON: "),
        ("cities.xyz", b"\x89PNG\r\n\x1a\n\x00", "cities.xyz is not a table, GeoJSON or a 2 : 1 picture."),
        pytest.param("stars.csv", PLACES + b"1,2\n" * 1_000_000, MOST, marks=pytest.mark.thorough),
    ],
    ids=lambda value: value if str(value).endswith((".geojson", ".xyz", ".csv")) else "",
)
def test_other_files_are_refused(node, name, content, said):
    assert on_page(node, {name: content})[name]["error"].startswith(said)


@pytest.mark.parametrize("kind", ["lonlat", "plane"])
def test_the_reader_is_asked_for_columns_that_do_not_say_what_they_are(node, kind):
    files = {"strange.csv": "east,north,height\n7,1,0\n5,6,9\n"}
    assert on_page(node, files, kind)["strange.csv"]["columns"] == ["east", "north", "height"]
    assert on_page(node, files, kind, ["north", "height"])["strange.csv"]["places"] == [1, 0, 6, 9]
