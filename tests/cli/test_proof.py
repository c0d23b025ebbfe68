"""Tables of proof: every format and command × what goes wrong with files. Old files stay, nothing else is left."""

import bz2
import gzip
import io
import os
import resource
import signal
import zipfile
from contextlib import contextmanager

import numpy as np
import pytest

from stereodel.cli import app
from stereodel.cli.contour import LINES
from stereodel.cli.destinations import MESHES, TABLES
from stereodel.cli.interpolate import GRIDS
from stereodel.io import PointTable, read_points, write

EVERY = {
    "triangulate": (["triangulate", "cities.csv"], (*TABLES, *MESHES)),
    "voronoi": (["voronoi", "cities.csv"], (*TABLES, *MESHES)),
    "clip": (["voronoi", "cities.csv", "--clip", "square.geojson"], TABLES),
    "nearest": (["nearest", "cities.csv", "--of", "cities.csv"], TABLES),
    "interpolate": (["interpolate", "cities.csv", "--value", "people", "--at", "at.csv"], TABLES),
    "grid": (["interpolate", "cities.csv", "--value", "people", "--grid", "10"], GRIDS),
    "contour": (["contour", "cities.csv", "--value", "people", "--levels", "2e6"], LINES),
    "globe": (["globe", "cities.csv", "--size", "60", "--no-land", "--no-coastlines"], ("svg", "pdf")),
}
RUNS = [(command, kind) for command, (_, kinds) in EVERY.items() for kind in kinds]
SQUARE = '{"type":"Polygon","coordinates":[[[-90,-40],[130,-40],[130,60],[-90,60],[-90,-40]]]}'


@pytest.fixture
def here(folder):
    """The folder, with a polygon to cut with and a point that asks."""
    (folder / "square.geojson").write_text(SQUARE, encoding="utf-8")
    (folder / "at.csv").write_text("who,lon,lat\nAda,11.6,48.1\n", encoding="utf-8")
    return folder


def one_line(message):
    return message.startswith("error: ") and message.count("\n") == 1 and len(message) < 500


@contextmanager
def small_disk(room):
    """Files of this process may not grow beyond so many bytes, as on a disk that is full."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        signal.signal(signal.SIGXFSZ, before)


def assert_refused(folder, run, room, options, out):
    """The old file is there still, and nothing else that was not."""
    out.write_text("old", encoding="utf-8")
    before = sorted(path.name for path in folder.iterdir())
    with small_disk(room):
        message = run(*options, "-o", out.name, "--overwrite", code=2)
    message = message.splitlines()[-1] + "\n" if message.startswith("note: ") else message
    assert one_line(message), message
    assert message.startswith(f"error: {out.stem}.")
    assert out.read_text(encoding="utf-8") == "old"
    assert sorted(path.name for path in folder.iterdir()) == before


@pytest.mark.parametrize(("command", "kind"), RUNS)
def test_a_full_disk_leaves_the_old_file(here, run, command, kind):
    assert_refused(here, run, 40, EVERY[command][0], here / f"out.{kind}")


@pytest.mark.parametrize("share", [0.3, 0.97])
@pytest.mark.parametrize("kind", sorted({*TABLES, *MESHES} - {"svg", "pdf"}))
def test_a_disk_that_is_full_amid_a_file(here, run, kind, share):
    run(*EVERY["voronoi"][0], "-o", f"whole.{kind}")
    room = int(share * (here / f"whole.{kind}").stat().st_size)
    assert_refused(here, run, room, EVERY["voronoi"][0], here / f"out.{kind}")


@pytest.mark.parametrize(("command", "kind"), [(c, k) for c, k in RUNS if k != "shp"])
def test_a_device_that_takes_nothing(here, run, command, kind):
    (here / f"full.{kind}").symlink_to("/dev/full")
    message = run(*EVERY[command][0], "-o", f"full.{kind}", code=2)
    assert message == f"error: full.{kind}: No space left on device\n"
    assert (here / f"full.{kind}").is_symlink()


@pytest.mark.parametrize(("command", "kind"), [(c, k) for c, k in RUNS if k != "shp"])
def test_a_pipe_whose_reader_has_gone(here, monkeypatch, capfd, command, kind):
    """Whatever goes to stdout: no word of it, and exit code 1."""
    reading, writing = os.pipe()
    os.close(reading)
    with monkeypatch.context() as patched, os.fdopen(writing, "w") as pipe:
        patched.setattr("sys.stdout", pipe)
        with pytest.raises(SystemExit) as ended:
            app([*EVERY[command][0], "-o", "-", "--format", kind])
    assert ended.value.code == 1
    assert capfd.readouterr().err == ""


def table(count=40):
    rng = np.random.default_rng(8)
    lonlat = np.column_stack([rng.uniform(-179, 179, count), rng.uniform(-80, 80, count)])
    return PointTable(lonlat, {"name": [f"place {k}" for k in range(count)], "value": rng.uniform(size=count)})


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Files of every kind that is read, by their endings."""
    folder = tmp_path_factory.mktemp("whole")
    files = {}
    for kind in ("csv", "geojson", "geojsonl", "parquet", "gpkg", "fgb", "kml"):
        write(folder / f"a.{kind}", table())
        files[kind] = (folder / f"a.{kind}").read_bytes()
    write(folder / "a.shp", table())
    files["shp"] = (folder / "a.shp").read_bytes()
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for path in sorted(folder.glob("a.*")):
            if path.suffix in (".shp", ".shx", ".dbf", ".prj"):
                archive.write(path, path.name)
    files["zip"] = packed.getvalue()
    files["csv.gz"], files["csv.bz2"] = gzip.compress(files["csv"]), bz2.compress(files["csv"])
    return files


KINDS = [
    "csv",
    "geojson",
    "geojsonl",
    "parquet",
    "gpkg",
    "fgb",
    "kml",
    "shp",
    "zip",
    "csv.gz",
    "csv.bz2",
    "xlsx",
    "ods",
]
HARMS = {
    "nothing": lambda content: b"",
    "one byte": lambda content: content[:1],
    "a beginning": lambda content: content[:20],
    "half": lambda content: content[: len(content) // 2],
    "zeros": lambda content: bytes(len(content)),
    "noise": lambda content: np.random.default_rng(4).integers(0, 256, len(content), dtype=np.uint8).tobytes(),
    "noise within": lambda content: (
        content[:100] + np.random.default_rng(5).integers(0, 256, 300, dtype=np.uint8).tobytes() + content[400:]
    ),
    "another kind": lambda content: b"%PDF-1.7\n" + content,
    "a line without end": lambda content: b'"' + b"a," * 5000,
}


def read_by(reader, run, name):
    """What a command says of a file, and its exit code: 0 where enough of it is left to be read."""
    from typer.testing import CliRunner

    options = {
        "points": ["voronoi", name, "-o", "out.csv"],
        "clip": ["voronoi", "cities.csv", "--clip", name, "-o", "out.csv"],
        "plane": ["triangulate", name, "--plane", "value", "value", "-o", "out.csv"],
    }[reader]
    ran = CliRunner().invoke(app, options)
    assert ran.exception is None or isinstance(ran.exception, SystemExit), repr(ran.exception)
    return ran.exit_code, ran.stderr


@pytest.mark.parametrize("reader", ["points", "clip", "plane"])
@pytest.mark.parametrize("harm", HARMS)
@pytest.mark.parametrize("kind", KINDS)
def test_damaged_files(folder, run, whole, kind, harm, reader):
    name = f"harmed.{kind}"
    (folder / name).write_bytes(HARMS[harm](whole.get(kind, b"PK\x03\x04" + bytes(500))))
    code, message = read_by(reader, run, name)
    if code == 0:
        # Of a table in lines, with its damage in what is not read, or an archive, which may have anything before it.
        assert harm in ("half", "noise within") or (kind, harm) == ("zip", "another kind")
        return
    if code == 1:
        assert message == f"{name}: there are no points\n" or message.startswith(f"{name}: no triangles")
    else:
        assert code == 2
        assert one_line(message), message
        assert message.startswith(f"error: {name}: ")
    assert not (folder / "out.csv").exists()


def results(folder, run, command, kind, header):
    """The columns of what a command writes for five points with a further column."""
    names = ["Quito", "Lagos", "Ulm", "Kyoto", "Perth"]
    places = ["-78.5,-0.2", "3.4,6.5", "10.0,48.4", "135.8,35.0", "115.9,-32.0"]
    rows = [f"{name},{place},{k + 1}e6,{70 + k}" for k, (name, place) in enumerate(zip(names, places, strict=True))]
    (folder / "own.csv").write_text("\n".join([f"name,x_wgs,y_wgs,people,{header}", *rows]), encoding="utf-8")
    options = {
        "voronoi": ["voronoi", "own.csv", "--lon", "x_wgs", "--lat", "y_wgs"],
        "nearest": [
            *("nearest", "own.csv", "--lon", "x_wgs", "--lat", "y_wgs", "-k", "2"),
            *("--of", "own.csv", "--of-lon", "x_wgs", "--of-lat", "y_wgs"),
        ],
        "interpolate": [
            *("interpolate", "own.csv", "--lon", "x_wgs", "--lat", "y_wgs", "--value", "people"),
            *("--at", "own.csv", "--at-lon", "x_wgs", "--at-lat", "y_wgs", "--method", "nearest"),
        ],
    }[command]
    run(*options, "-o", f"{header}.{kind}")
    if kind == "csv":
        return read_points(folder / f"{header}.csv", lon="lon", lat="lat").columns
    import geopandas

    read = geopandas.read_parquet if kind == "parquet" else geopandas.read_file
    frame = read(folder / f"{header}.{kind}")
    return {name: frame[name].to_numpy() for name in frame if name != "geometry"}


TAKEN = {
    "voronoi": ("lon", "LAT", "row", "area_km2", "geometry", "fid", "geom", "Name"),
    "nearest": ("lon", "rank", "site_row", "SITE_NAME", "distance_km", "geometry", "fid", "Name"),
    "interpolate": ("lon", "lat", "PEOPLE", "geometry", "fid", "Name"),
}


@pytest.mark.parametrize("kind", ["csv", "geojson", "parquet", "gpkg", "fgb"])
@pytest.mark.parametrize(("command", "name"), [(c, n) for c, names in TAKEN.items() for n in names])
def test_columns_that_collide(folder, run, command, name, kind):
    """What is computed is what it is without them, and theirs is there, under another name if need be."""
    plain, found = (results(folder, run, command, kind, header) for header in ("harmless", name))
    mine = [
        column for column in found if not column.startswith(("site_N", "site_n"))
    ]  # where nearest writes the name again
    own = [column for column in mine if sorted(set(found[column].tolist())) == [70, 71, 72, 73, 74]]
    assert len(own) == 1
    for column in plain.keys() & found.keys() - {*own}:
        assert sorted(map(str, found[column].tolist())) == sorted(map(str, plain[column].tolist()))
    assert len(mine) == sum(not column.startswith(("site_N", "site_n")) for column in plain)
