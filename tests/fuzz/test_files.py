"""Changed files: a few at every run, more in the thorough one; and what was found by them, made by hand."""

import subprocess
import sys
import warnings
from pathlib import Path

import geopandas
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import shapely

from stereodel.io import read_points
from stereodel.io.reading import shapes_of
from tests.fuzz.files import DOORS, REFUSED, seeds, wrong


@pytest.mark.parametrize(("count", "seed"), [(69, 5), pytest.param(2000, 7, marks=pytest.mark.thorough, id="thorough")])
def test_changed_files_are_read_or_refused_in_one_line(count, seed):
    """In a process of its own, as a crash would end it."""
    command = [sys.executable, "-m", "tests.fuzz.files", str(count), str(seed)]
    ran = subprocess.run(command, cwd=Path(__file__).resolve().parents[2], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert f"{count} changed files" in ran.stdout


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    return seeds(tmp_path_factory.mktemp("sound"))


def noise(count):
    return np.random.default_rng(count).integers(0, 256, count, dtype=np.uint8).tobytes()


HARMS = {
    "nothing": lambda content: b"",
    "one byte": lambda content: content[:1],
    "a beginning": lambda content: content[:20],
    "half": lambda content: content[: len(content) // 2],
    "zeros": lambda content: bytes(len(content)),
    "noise": lambda content: noise(len(content)),
    "noise within": lambda content: content[:100] + noise(300) + content[400:],
    "another kind": lambda content: b"%PDF-1.7\n" + content,
    "a line without end": lambda content: b'"' + b"a," * 5000,
}
READ = [("a beginning", ".csv"), *(("half", ending) for ending in (".csv", ".bz2", ".geojsonl"))]
READ += [("noise within", ""), ("another kind", ".zip"), ("another kind", ".csv")]
"""What leaves enough: tables in lines, damage in what is not read, archives, which may have anything before them, and
tables, which may have titles."""


@pytest.mark.parametrize("harm", HARMS)
def test_every_kind_of_file_with_every_harm(sound, tmp_path, harm):
    found = {}
    for name, content in sound.items():
        path = tmp_path / name
        path.write_bytes(HARMS[harm](content))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found[name] = wrong(path)
            if not any(harm == each and name.endswith(ending) for each, ending in READ):
                for door in DOORS.get(path.suffix, DOORS[""]):
                    with pytest.raises(REFUSED):
                        door(path)
    assert set(found.values()) == {None}, found


PLACE = geopandas.GeoDataFrame({"a": ["Zoë"]}, geometry=[shapely.Point(1, 2)], crs=4326)


def cut_text(folder):
    """A shapefile whose text is cut inside a letter, as writers do that count bytes."""
    PLACE.to_file(folder / "a.shp", encoding="utf-8")
    table = folder / "a.dbf"
    table.write_bytes(table.read_bytes().replace("Zoë".encode(), b"Zo\xc3\x20"))
    return folder / "a.shp"


def unknown_crs(folder):
    PLACE.to_parquet(folder / "a.parquet")
    table = pq.read_table(folder / "a.parquet")
    damaged = table.schema.metadata[b"geo"].replace(b'"type": "GeographicCRS"', b'"type": "GeogrxphicCRS"')
    assert damaged != table.schema.metadata[b"geo"]
    pq.write_table(table.replace_schema_metadata({b"geo": damaged}), folder / "a.parquet")
    return folder / "a.parquet"


def not_of_the_earth(folder):
    PLACE.to_file(folder / "a.shp")
    prj = folder / "a.prj"
    prj.write_text(prj.read_text().replace("6378137", "1737400"))
    return folder / "a.shp"


def without_metadata_of_columns(folder):
    schema = pa.schema([("lon", pa.float64())], metadata={b"geo": b'{"columns": 5}'})
    pq.write_table(pa.table({"lon": [1.0]}, schema=schema), folder / "a.parquet")
    return folder / "a.parquet"


def no_geometry_in_the_middle(folder):
    """A FlatGeobuf with a damaged geometry, of which GDAL makes a table that ends beyond its memory."""
    frame = geopandas.GeoDataFrame({"a": ["x"] * 20}, geometry=[shapely.Point(k, 2) for k in range(20)], crs=4326)
    frame.to_file(folder / "a.fgb", driver="FlatGeobuf")
    content = bytearray((folder / "a.fgb").read_bytes())
    content[-140] = 0
    (folder / "a.fgb").write_bytes(content)
    return folder / "a.fgb"


MADE = [cut_text, unknown_crs, not_of_the_earth, without_metadata_of_columns]


def by_hand(name, content):
    def make(folder):
        (folder / name).write_bytes(content)
        return folder / name

    return pytest.param(make, id=f"{name} {content[:12]}")


BYTES = [
    ("a.gpkg", b"SQLite format 3\0aaaa"),
    ("a.parquet", b"PAR1aaaa"),
    ("a.parquet", b"PAR1" + bytes(50) + b"PAR1"),
    ("a.kml", b'<?xml version="1.0" encoding="UDF-8"?><kml/>'),
    ("a.geojson", b'{"features":' + b"[" * 200_000),
    ("a.csv", b'lon,lat,a\n1,2,"x\n3,4,b\n'),
    ("a.csv.gz", b"\x1f\x8b\x08aaaa"),
    ("a.csv.bz2", b"BZhaaaa"),
    ("a.shp", b"\x00\x00\x27\x0aaaaa"),
    ("a.xlsx", b"PK\x03\x04aaaa"),
    ("a.kml", b"<kml>"),
    ("a.csv", b"lon,lat\n" + b"1," * 100_000),
    ("a.csv", b"\xff\xfe1"),
]


@pytest.mark.parametrize("make", [*MADE, no_geometry_in_the_middle, *(by_hand(*row) for row in BYTES)])
def test_what_libraries_raise_for_damage_is_one_line_that_names_the_file(make, tmp_path):
    path = make(tmp_path)
    for door in (read_points, shapes_of):
        with pytest.raises(ValueError, match=rf"\A{path}: .{{,450}}\Z"):
            door(path)
