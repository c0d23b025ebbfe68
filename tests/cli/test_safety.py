"""Nothing is lost or changed in silence: places, columns, files; old files stay whatever goes wrong."""

import os
import subprocess
import sys

import geopandas
import pytest

from stereodel.cli import app
from tests.disks import small_disk

SQUARE = '{"type":"Polygon","coordinates":[[[-90,-40],[130,-40],[130,60],[-90,60],[-90,-40]]]}'
ATTRIBUTES = """name,lon,lat,x_wgs,y_wgs
Ulm,573000,5361000,10.0,48.4
Quito,780000,9980000,-78.5,-0.2
Perth,390000,6460000,115.9,-32.0
"""
OWN = ["--lon", "x_wgs", "--lat", "y_wgs"]
WRITING = {
    "voronoi": ["voronoi", "own.csv", *OWN],
    "nearest": ["nearest", "cities.csv", "--of", "own.csv", "--of-lon", "x_wgs", "--of-lat", "y_wgs"],
    "interpolate": [
        *("interpolate", "cities.csv", "--value", "people", "--method", "nearest", "--at", "own.csv"),
        *("--at-lon", "x_wgs", "--at-lat", "y_wgs"),
    ],
}
EVERY = {
    **WRITING,
    "clip": ["voronoi", "cities.csv", "--clip", "square.geojson"],
    "triangulate": ["triangulate", "cities.csv"],
    "grid": ["interpolate", "cities.csv", "--value", "people", "--grid", "10"],
    "contour": ["contour", "cities.csv", "--value", "people", "--levels", "2e6"],
    "globe": ["globe", "cities.csv", "--size", "60", "--show=graticule"],
}
PAIRS = {
    "voronoi": ("gpkg", "shp", "vtp"),
    "nearest": ("csv", "kml", "xlsx"),
    "interpolate": ("parquet", "geojsonl"),
    "clip": ("geojson",),
    "triangulate": ("fgb", "glb", "ply", "nc", "svg"),
    "grid": ("nc", "tif", "csv"),
    "contour": ("geojson", "gpkg"),
    "globe": ("svg", "pdf", "png"),
}
"""Each command with some format, and each format with some command."""


@pytest.fixture
def own(folder):
    (folder / "own.csv").write_text(ATTRIBUTES, encoding="utf-8")
    (folder / "square.geojson").write_text(SQUARE, encoding="utf-8")
    return folder


@pytest.mark.parametrize(("command", "kind"), [(command, kind) for command, kinds in PAIRS.items() for kind in kinds])
def test_a_full_disk_leaves_the_old_file(own, run, command, kind):
    """Whether it is full at once or near the end, nothing but the old file is there."""
    run(*EVERY[command], "-o", f"whole.{kind}")
    size, out = (own / f"whole.{kind}").stat().st_size, own / f"out.{kind}"
    out.write_text("old", encoding="utf-8")
    before = sorted(path.name for path in own.iterdir())
    for room in (40, int(0.97 * size)):
        with small_disk(room):
            message = run(*EVERY[command], "-o", out.name, "--overwrite", code=2).splitlines()[-1]
        assert message.startswith("error: out.")
        assert out.read_text(encoding="utf-8") == "old"
        assert sorted(path.name for path in own.iterdir()) == before


@pytest.mark.parametrize("command", PAIRS)
def test_a_pipe_whose_reader_has_gone(own, monkeypatch, capfd, command):
    """Whatever goes to stdout: no word of it, and exit code 1."""
    reading, writing = os.pipe()
    os.close(reading)
    with monkeypatch.context() as patched, os.fdopen(writing, "w") as pipe:
        patched.setattr("sys.stdout", pipe)
        with pytest.raises(SystemExit) as ended:
            app([*EVERY[command], "-o", "-", *(("--format", PAIRS[command][0]) if command != "globe" else ())])
    assert ended.value.code == 1
    assert "error" not in capfd.readouterr().err


TAKEN = ["lon", "LAT", "row", "rank", "area_km2", "SITE_ROW", "SITE_NAME", "distance_km", "PEOPLE", "geometry", "fid"]
TAKEN += ["geom", "Name"]


@pytest.mark.parametrize("command", WRITING)
def test_columns_that_collide(own, run, rows, command):
    """What is computed is what it is without them; theirs are there, under other names if need be, and that is said."""
    table = ["name,x_wgs,y_wgs", "Ulm,10.0,48.4", "Quito,-78.5,-0.2", "Perth,115.9,-32.0"]
    (own / "own.csv").write_text("\n".join(table), encoding="utf-8")
    plain = rows(run(*WRITING[command], "-o", "-"))
    cells = [TAKEN, *([str(1000 * j + k) for j in range(len(TAKEN))] for k in range(3))]
    table = [",".join([line, *cell]) for line, cell in zip(table, cells, strict=True)]
    (own / "own.csv").write_text("\n".join(table), encoding="utf-8")
    found = rows(run(*WRITING[command], "-o", "-"))
    assert run.said.startswith("note: column '")
    for before, after, theirs in zip(plain, found, cells[1:], strict=True):
        assert sorted(after.values()) == sorted([*before.values(), *theirs])
        assert all(after[name] == before[name] for name in before if after[name] not in theirs)


@pytest.mark.parametrize("command", ["voronoi", "nearest", "interpolate", "triangulate", "contour", "globe"])
def test_an_input_is_never_written_and_a_file_not_unasked(own, run, command):
    out = own / f"out.{PAIRS[command][0]}"
    out.write_text("mine", encoding="utf-8")
    message = run(*EVERY[command], "-o", out.name, code=2)
    assert message == f"error: {out.name}: already exists; replace it with --overwrite, or choose another name\n"
    assert out.read_text(encoding="utf-8") == "mine"
    run(*EVERY[command], "-o", out.name, "--overwrite")
    assert out.read_bytes() != b"mine"
    (own / "link").mkdir()
    (same := own / "link" / out.name).symlink_to(own / EVERY[command][1])
    message = run(*EVERY[command], "-o", same, "--overwrite", code=2)
    assert "is an input, so it cannot be overwritten" in message


@pytest.mark.parametrize("command", WRITING)
def test_rows_without_a_place(own, run, rows, command):
    with (own / "own.csv").open("a", encoding="utf-8") as file:
        file.write("Nowhere,1,1,,\nKyoto,1,1,135.8,35\n")
    assert "row 4: the longitude is missing" in run(*WRITING[command], "-o", "-", code=2)
    table = rows(run(*WRITING[command], "-o", "-", "--skip-missing"))
    assert [row["name"] for row in table] == ["Ulm", "Quito", "Perth", "Kyoto"]


def test_coordinate_systems_and_layers(own, run, rows):
    (own / "utm.csv").write_text("name,east,north\nUlm,573000,5361000\n", encoding="utf-8")
    options = ["nearest", "cities.csv", "--of", "utm.csv", "--of-lon", "east", "--of-lat", "north", "-o", "-"]
    (row,) = rows(run(*options, "--of-crs", "EPSG:25832"))
    assert row["site_name"] == "Ulm"
    assert abs(float(row["lon"]) - 9.986225) < 1e-6
    points = geopandas.GeoDataFrame({"name": ["a"]}, geometry=geopandas.points_from_xy([10], [48]), crs=4326)
    points.to_file("two.gpkg", layer="first")
    points.to_file("two.gpkg", layer="second")
    assert len(rows(run("voronoi", "two.gpkg", "--layer-name", "second", "-o", "-"))) == 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("-o - >&-", "error: stdout is closed; name a file with --out\n"),
        ("-o - >/dev/full", "error: stdout: No space left on device\n"),
        ("-o full.csv", "error: full.csv: No space left on device\n"),
    ],
)
def test_what_takes_nothing(folder, options, message):
    """Run by a shell, since redirections are its own."""
    (folder / "full.csv").symlink_to("/dev/full")
    command = f'{sys.executable} -c "from stereodel.cli import app; app()" voronoi cities.csv {options}'
    ran = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True, check=False, timeout=60)
    assert (ran.returncode, ran.stderr) == (2, message)


def test_a_closed_pipe_is_quiet(folder):
    arguments = ["interpolate", "cities.csv", "--value", "people", "--grid", "0.5", "--method", "nearest", "-o", "-"]
    program = [sys.executable, "-c", "from stereodel.cli import app; app()"]
    with subprocess.Popen([*program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as writer:
        assert writer.stdout.readline() == b"lon,lat,people\n"
        writer.stdout.close()
        assert writer.stderr.read() == b""
        assert writer.wait() == 1
