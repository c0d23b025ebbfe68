"""What a file of a stranger must not do: open other files, ask hosts, or take far more than it holds."""

import base64
import bz2
import ctypes
import gzip
import io
import json
import os
import random
import socket
import sqlite3
import sys
import threading
import time
import warnings
import zipfile
from contextlib import contextmanager
from functools import partial

import geopandas
import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pyogrio
import pytest
import shapely

from stereodel.constants import MOST_COLUMNS, MOST_LINE, MOST_MEMBERS
from stereodel.io import DataWarning, read_points, write
from stereodel.io.reading import shapes_of
from tests.fuzz.files import KILOBYTES, memory

POINT = geopandas.GeoDataFrame({"i": ["topsecret"]}, geometry=[shapely.Point(1, 2)], crs=4326)

VIRTUAL = (
    '<OGRVRTDataSource><OGRVRTLayer name="secret"><SrcDataSource>{}</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>'
)
KML = '<kml xmlns="http://www.opengis.net/kml/2.2"><Document>{}</Document></kml>'
PLACE = "<Placemark><name>{}</name><Point><coordinates>1,2</coordinates></Point></Placemark>"
GML = """<?xml version="1.0"?><wfs:FeatureCollection xmlns:wfs="http://www.opengis.net/wfs"
xmlns:gml="http://www.opengis.net/gml" xmlns:a="http://a" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
xmlns:xlink="http://www.w3.org/1999/xlink" xsi:schemaLocation="http://a {0}"><gml:featureMember><a:t fid="t.1">
<a:x xlink:href="{0}#p"/><a:g><gml:Point srsName="{0}"><gml:coordinates>1,2</gml:coordinates></gml:Point></a:g></a:t>
</gml:featureMember></wfs:FeatureCollection>"""
SCHEMA = "wfs?service=WFS&amp;request=DescribeFeatureType&amp;typename=a:t"
ALGORITHM = '{{"type":"gdal_streamed_alg","command_line":"gdal vector convert {} --of stream streamed_dataset"}}'
LINKED = (
    '{{"type":"FeatureCollection","crs":{{"type":"link","properties":{{"href":"{}","type":"ogcwkt"}}}},"features":['
    '{{"type":"Feature","properties":{{}},"geometry":{{"type":"Point","coordinates":[1,2]}}}}]}}'
)
INIT = '"type":"name","properties":{{"name":"+init={}:4326"}}'
GRIDDED = (
    'GEOGCS["x",DATUM["x",SPHEROID["WGS 84",6378137,298.257223563],EXTENSION["PROJ4_GRIDS","{}"]],'
    'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]'
)


@pytest.fixture
def asked():
    """A host that answers nothing, its address, and what it was asked."""
    heard = []
    with socket.socket() as host:
        host.bind(("127.0.0.1", 0))
        host.listen(20)

        def serve():
            while True:
                try:
                    caller, _ = host.accept()
                except OSError:
                    return
                with caller:
                    heard.append(caller.recv(2000))
                    caller.sendall(b"HTTP/1.0 404 no\r\nContent-Length: 0\r\n\r\n")

        threading.Thread(target=serve, daemon=True).start()
        yield f"http://127.0.0.1:{host.getsockname()[1]}/", heard
        host.shutdown(socket.SHUT_RDWR)


class Watched:
    """A folder, and whether a file in it was opened, as Linux tells."""

    def __init__(self, folder):
        self.linux = sys.platform == "linux"
        if self.linux:
            system = ctypes.CDLL(None)
            self.told = system.inotify_init1(os.O_NONBLOCK)
            assert system.inotify_add_watch(self.told, os.fsencode(folder), 0x20) > 0

    def opened(self):
        try:
            return self.linux and os.read(self.told, 100_000)
        except BlockingIOError:
            return b""

    def close(self):
        """As a user has a hundred at most."""
        if self.linux:
            os.close(self.told)


@pytest.fixture
def secret(tmp_path):
    """Files that no other file may open, and what watches them."""
    folder = tmp_path / "secret"
    folder.mkdir()
    POINT.to_file(folder / "secret.gpkg", driver="GPKG")
    (folder / "secret.gsb").write_text("topsecret" * 100)
    watched = Watched(folder)
    yield folder, watched
    watched.close()


def virtual_table(path, secret):
    POINT[:0].to_file(path, driver="GPKG", layer="t")
    with sqlite3.connect(path) as base:
        base.execute("PRAGMA writable_schema=1")
        made = f"CREATE VIRTUAL TABLE vo USING VirtualOGR('{secret}', 0, 'secret')"
        base.execute("INSERT INTO sqlite_master VALUES ('table', 'vo', 'vo', 0, ?)", [made])
        base.execute("INSERT INTO gpkg_contents (table_name, data_type, identifier) VALUES ('vo', 'attributes', 'vo')")


def schema(path, included):
    path.write_text(GML.replace("http://a {0}", "http://a a.xsd").format("x"))
    text = (
        '<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" targetNamespace="http://a"><xs:include schemaLocation='
    )
    path.with_suffix(".xsd").write_text(f'{text}"{included}"/></xs:schema>')


def gridded_shapes(path, grid):
    POINT.to_file(path)
    path.with_suffix(".prj").write_text(GRIDDED.format(grid))


def gridded_base(path, grid):
    POINT.to_file(path, driver="GPKG")
    with sqlite3.connect(path) as base:
        base.execute("UPDATE gpkg_spatial_ref_sys SET definition = ?", [GRIDDED.format(grid)])


REFERENCES = {
    **{f"virtual.{end}": VIRTUAL for end in ("kml", "gml", "gpx", "xlsx", "ods", "gpkg", "shp", "fgb", "dxf", "vrt")},
    "late.kml": '<?xml version="1.0"?><!-- k -->' + VIRTUAL,
    "second.kml": KML.format("") + VIRTUAL,
    "algorithm.kml": ALGORITHM,
    "algorithm.topojson": ALGORITHM,
    "service.gml": "<OGRWFSDataSource><URL>{}</URL></OGRWFSDataSource>",
    "schema.gml": GML,
    "net.kml": KML.format("<NetworkLink><Link><href>{}</href></Link></NetworkLink>" + PLACE),
    "entity.kml": '<!DOCTYPE kml [<!ENTITY x SYSTEM "{}">]>' + KML.format(PLACE.format("&x;")),
    "parameter.kml": '<!DOCTYPE kml [<!ENTITY % x SYSTEM "{}"> %x;]>' + KML.format(PLACE),
    "definition.kml": '<!DOCTYPE kml SYSTEM "{}">' + KML.format(PLACE),
    "style.kml": KML.format(PLACE.replace("<Point>", "<styleUrl>{0}#x</styleUrl><Point>")),
    "overlay.kml": KML.format("<GroundOverlay><Icon><href>{0}</href></Icon></GroundOverlay>" + PLACE),
    "location.gpx": '<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1" xsi:schemaLocation="http://a {0}" '
    'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"><wpt lat="1" lon="2"><link href="{0}"/></wpt></gpx>',
    "linked.topojson": LINKED,
    "linked.geojson": LINKED,
    "init.geojson": LINKED.replace('"type":"link","properties":{{"href":"{}","type":"ogcwkt"}}', INIT),
}


MADE = {
    "virtual_table.gpkg": virtual_table,
    "grid.shp": gridded_shapes,
    "grid.gpkg": gridded_base,
    "include.gml": schema,
    "a.zip": lambda path, secret: archive(path, ("a.kml", VIRTUAL.format(secret))),
}
"""What names a file in other ways than in its text: that of points, or one of a grid."""


@pytest.mark.parametrize("name", [*REFERENCES, *MADE])
@pytest.mark.parametrize("door", [lambda path: read_points(path).columns, lambda path: shapes_of(path).properties])
def test_no_file_opens_another_or_asks_a_host(name, door, tmp_path, secret, asked):
    (folder, watched), (host, heard) = secret, asked
    path, base = tmp_path / name, folder / "secret.gpkg"
    if name in MADE:
        named = base if name in ("virtual_table.gpkg", "a.zip") else folder / "secret.gsb"
        makes = [partial(MADE[name], path, named)]
    else:
        text = REFERENCES[name].replace("{}", "{0}")
        makes = [
            partial(path.write_text, text.format(where)) for where in (base, f"/vsicurl/{host}a.gpkg", host + SCHEMA)
        ]
    for make in makes:
        make()
        watched.opened()
        try:
            said = str(door(path))
        except ValueError as error:
            said = str(error)
        assert "topsecret" not in said
        assert not watched.opened()
        assert heard == []


def test_a_coordinate_system_of_a_file_may_name_grids_of_proj_but_no_path():
    from stereodel.io.formats.foreign import check_crs

    check_crs('EXTENSION["PROJ4","+proj=merc +nadgrids=@null +wktext"]')
    check_crs('PARAMETERFILE["Latitude and longitude difference file","ntv2_0.gsb"]')
    for named in ("+proj=longlat +nadgrids=a.gsb,/etc/b", "+init=/etc/epsg:1", 'PARAMETERFILE["x", "C:\\\\a.gsb"]'):
        with pytest.raises(ValueError, match="another file by its path"):
            check_crs(named)


def test_the_settings_of_gdal_are_as_before(tmp_path):
    (tmp_path / "a.gml").write_text(GML.replace("{0}", "x"))
    for before in ("YES", None):
        pyogrio.set_gdal_config_options({"GML_DOWNLOAD_SCHEMA": before})
        assert len(read_points(tmp_path / "a.gml")) == 1
        assert pyogrio.get_gdal_config_option("GML_DOWNLOAD_SCHEMA") in (before, before == "YES")


HEAD = b"lon,lat\n1,2\n"
MIB = 1 << 20


def unpackable():
    """A comment of nearly a megabyte of letters at random."""
    return b"#" + base64.b64encode(random.Random(1).randbytes(720_000)) + b"\n"


def spreadsheet(path, rows, shared=b"</sst>"):
    """A spreadsheet with other rows and texts, from bytes."""
    pyogrio.write_dataframe(pd.DataFrame({"lon": [1.5], "lat": [2.5]}), path.with_suffix(".a.xlsx"), driver="XLSX")
    with zipfile.ZipFile(path.with_suffix(".a.xlsx")) as plain, zipfile.ZipFile(path, "w", 8) as archive:
        for name in plain.namelist():
            text = plain.read(name)
            text = text.replace(b"</sst>", shared).replace(b"</sheetData>", rows + b"</sheetData>")
            archive.writestr(name, text)


def repeated(row, count):
    return b"".join(row.replace(b"#", b"%d" % k) for k in range(3, count))


SHARED = b'<row r="#"><c r="A#"><v>1</v></c><c r="B#"><v>1</v></c><c r="C#" t="s"><v>2</v></c></row>'
END = b"</t></si></sst>"


def parquet(path, count, **more):
    pq.write_table(pa.table({"lon": np.zeros(count), "lat": np.zeros(count)} | more), path, compression="zstd")


def archive(path, *members):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, content in members:
            packed.writestr(name, content)


def understated(path):
    """A KMZ whose table of contents says that it holds little."""
    text = KML.format(PLACE.format(" " * (64 * MIB))).encode()
    archive(path, ("doc.kml", text))
    packed = path.read_bytes()
    path.write_bytes(packed.replace(len(text).to_bytes(4, "little"), (1000).to_bytes(4, "little")))


def endless(path):
    """A database with a table of coordinate systems and a layer that have no end."""
    POINT.to_file(path, driver="GPKG", layer="t")
    with sqlite3.connect(path) as base:
        rows = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i FROM n"
        base.execute(f"CREATE VIEW v AS {rows}")
        base.execute("DROP TABLE gpkg_spatial_ref_sys")
        base.execute(f"CREATE VIEW gpkg_spatial_ref_sys AS {rows}")
        base.execute("INSERT INTO gpkg_contents (table_name, data_type, identifier) VALUES ('v', 'attributes', 'v')")


def computed(made):
    """A database whose layer is a view or has a column that is computed."""

    def make(path):
        POINT.to_file(path, driver="GPKG", layer="t")
        with sqlite3.connect(path) as base:
            base.execute(made)
            base.execute("UPDATE gpkg_contents SET table_name = 'v'")
            base.execute("UPDATE gpkg_geometry_columns SET table_name = 'v'")

    return make


PRODUCT = ", ".join(f"sqlite_master {letter}" for letter in "abcdefgh")

BOMBS = {
    "product.gpkg": computed(f"CREATE VIEW v AS SELECT 1 AS fid, a.name AS geom FROM {PRODUCT}"),
    "union.gpkg": computed(
        f"CREATE VIEW v AS SELECT fid, geom FROM t WHERE 1 UNION ALL SELECT 1, a.name FROM {PRODUCT}"
    ),
    "blob.gpkg": computed("CREATE VIEW v AS SELECT fid, geom, zeroblob(500000000) AS a FROM t"),
    "column.gpkg": computed("CREATE TABLE v (fid INTEGER PRIMARY KEY, geom POINT, a AS (zeroblob(500000000)))"),
    "endless.gpkg": endless,
    "blanks.csv.bz2": lambda path: path.write_bytes(bz2.compress(HEAD + b" " * (1 << 26))),
    # Within the ratio, as they begin with a comment that does not pack.
    "line.csv.gz": lambda path: path.write_bytes(gzip.compress(unpackable() + HEAD + b" " * (30 * MIB))),
    "fields.csv.gz": lambda path: path.write_bytes(gzip.compress(unpackable() + HEAD + b"3,4" + b"," * (30 * MIB))),
    "quoted.csv.gz": lambda path: path.write_bytes(gzip.compress(unpackable() + HEAD + b'"' + b"a" * (30 * MIB))),
    "rows.csv.bz2": lambda path: path.write_bytes(bz2.compress(HEAD + b"1,2\n" * (1 << 21))),
    "zeros.csv.gz": lambda path: path.write_bytes(gzip.compress(HEAD + b"0" * (1 << 26))),
    "a.geojson.gz": lambda path: path.write_bytes(gzip.compress(b'{"features":[' + b" " * (1 << 26) + b"]}")),
    "columns.csv.bz2": lambda path: path.write_bytes(bz2.compress(b"lon,lat" + b"," * 500_000)),
    "a.kmz": lambda path: archive(path, ("doc.kml", KML.format(" " * (1 << 26)))),
    "understated.kmz": understated,
    "a.zip": lambda path: archive(path, ("a.shp", bytes(1 << 26))),
    "many.zip": lambda path: archive(path, *((f"{k}.shp", b"") for k in range(MOST_MEMBERS + 1))),
    "nested.zip": lambda path: archive(path, ("a.kml", b"PK\x03\x04")),
    "a.xlsx": lambda path: spreadsheet(path, b" " * (1 << 26)),
    "far.xlsx": lambda path: spreadsheet(path, repeated(b'<row r="#"><c r="XFD#"><v>1</v></c></row>', 40_000)),
    "shared.xlsx": lambda path: spreadsheet(path, repeated(SHARED, 20_000), b"<si><t>" + b"x" * 30_000 + END),
    "zeros.parquet": lambda path: parquet(path, 1 << 25),
    "text.parquet": lambda path: parquet(path, 1000, a=["x" * 300_000] * 1000),
    "a.ods": lambda path: archive(path, ("content.xml", bytes(1 << 26))),
}


@contextmanager
def little(patience):
    """Less than two seconds and 300 MB, as Linux tells."""
    read_points(io.BytesIO(HEAD))
    held, began = memory(fresh=True), time.process_time()
    yield
    assert time.process_time() - began < 2 * patience
    assert memory() - held < KILOBYTES


@pytest.mark.parametrize("name", BOMBS)
def test_a_small_file_does_not_become_a_large_table(name, tmp_path, patience):
    BOMBS[name](tmp_path / name)
    assert (tmp_path / name).stat().st_size < 1.2 * MIB
    with little(patience), pytest.raises(ValueError, match=rf"\A{tmp_path / name}: .+\Z"):
        read_points(tmp_path / name)


def test_long_lines_are_read(tmp_path):
    for end in ("\n", "\r", "\r\n"):
        line = "x" * (MOST_LINE - 8)
        table = read_points(io.StringIO(f"# {'y' * 2 * MOST_LINE}{end}lon,lat,a{end}1,2,{line}{end}3,4,{line}{end}"))
        assert table.columns["a"].tolist() == [line, line]


def test_what_is_packed_well_is_read(tmp_path):
    text = KML.format(PLACE).encode()
    (tmp_path / "a.kml.gz").write_bytes(gzip.compress(text))
    archive(tmp_path / "a.zip", ("in/a.kml", text), ("__MACOSX/in/._a.kml", b"\0\5\x16\7"), ("read.me", b"x"))
    assert len(read_points(tmp_path / "a.kml.gz")) == len(read_points(tmp_path / "a.zip")) == 1
    rows = b"".join(b"%d,%d,valid,station\n" % (k % 180, k % 90) for k in range(50_000))
    assert len(read_points(io.BytesIO(gzip.compress(b"lon,lat,flag,kind\n" + rows)))) == 50_000
    assert len(read_points(io.BytesIO(bz2.compress(HEAD) + bz2.compress(b"3,4\n")))) == 2


def own_keys(count, rows):
    """GeoJSON with properties that few of its features have, and one that all have."""
    place = {"type": "Point", "coordinates": [1, 1]}
    properties = ({"a": row} | {f"k{row}_{k}": k for k in range(count)} for row in range(rows))
    features = [{"type": "Feature", "properties": own, "geometry": place} for own in properties]
    return json.dumps({"type": "FeatureCollection", "features": features})


@pytest.mark.parametrize("make", [read_points, lambda stream: shapes_of(json.load(stream))])
def test_properties_of_their_own_take_what_they_hold(make, patience):
    text = own_keys(1, 20_000)
    with little(patience), warnings.catch_warnings():
        warnings.simplefilter("ignore", DataWarning)
        make(io.StringIO(text))


def test_properties_that_few_features_have_are_in_one_column(tmp_path):
    with pytest.warns(DataWarning, match="6000 of 6001 properties are together in the column 'others'"):
        table = read_points(io.StringIO(own_keys(2, 3000)))
    assert list(table.columns) == ["a", "others"]
    assert table.columns["a"].tolist() == list(range(3000))
    assert table.columns["others"][5] == {"k5_0": 0, "k5_1": 1}
    write(tmp_path / "a.csv", table)
    assert json.loads(read_points(tmp_path / "a.csv").columns["others"][5]) == {"k5_0": 0, "k5_1": 1}
    write(tmp_path / "a.geojson", table)
    assert read_points(tmp_path / "a.geojson").columns["others"][5] == {"k5_0": 0, "k5_1": 1}
    assert len(read_points(io.StringIO(own_keys(1, 1000))).columns) == 1001  # few cells, however empty


def test_columns_take_time_in_their_number(patience):
    names = ",".join(f"c{k}" for k in range(MOST_COLUMNS - 2))
    began = time.process_time()
    table = read_points(io.StringIO(f"lon,lat,{names}\n1,2{',7' * (MOST_COLUMNS - 2)}"))
    assert time.process_time() - began < 6 * patience
    assert len(table.columns) == MOST_COLUMNS - 2
    assert table.columns["c9"].dtype.kind == "i"
    with pytest.raises(ValueError, match="32769 columns; 32768 are the most"):
        read_points(io.StringIO(f"lon,lat,{names},another\n1,2{',7' * (MOST_COLUMNS - 1)}"))
