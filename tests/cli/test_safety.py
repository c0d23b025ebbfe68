"""Nothing is lost or changed in silence: places, columns, files."""

import os
import subprocess
import sys

import geopandas
import pytest

from stereodel.io import read_points

ATTRIBUTES = """name,lon,lat,x_wgs,y_wgs
Ulm,573000,5361000,10.0,48.4
Quito,780000,9980000,-78.5,-0.2
Perth,390000,6460000,115.9,-32.0
"""
OWN = ["--lon", "x_wgs", "--lat", "y_wgs"]
PLACES = [[10.0, 48.4], [-78.5, -0.2], [115.9, -32.0]]

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
    "triangulate": ["triangulate", "cities.csv"],
    "contour": ["contour", "cities.csv", "--value", "people", "--levels", "2e6"],
    "globe": ["globe", "cities.csv", "--size", "40", "--no-land", "--no-coastlines"],
}


@pytest.fixture
def own(folder):
    (folder / "own.csv").write_text(ATTRIBUTES, encoding="utf-8")
    return folder


@pytest.mark.parametrize("kind", ["csv", "geojson", "gpkg", "parquet"])
@pytest.mark.parametrize("command", WRITING)
def test_the_place_that_was_computed_with_is_written(own, run, command, kind):
    run(*WRITING[command], "-o", f"out.{kind}")
    columns = dict(read_points(own / f"out.{kind}", lon="lon", lat="lat").columns) if kind == "csv" else None
    if kind == "csv" or command != "voronoi":
        found = read_points(own / f"out.{kind}", **({"lon": "lon", "lat": "lat"} if kind == "csv" else {}))
        assert found.lonlat.tolist() == PLACES
        columns = dict(found.columns)
    else:
        frame = (
            geopandas.read_parquet(own / "out.parquet")
            if kind == "parquet"
            else geopandas.read_file(own / f"out.{kind}")
        )
        assert frame[["lon", "lat"]].to_numpy().tolist() == PLACES
        columns = {name: frame[name].to_numpy() for name in frame if name != "geometry"}
    # The attributes of those names are there still, under others, and that was said.
    assert any(list(values) == [573000, 780000, 390000] for values in columns.values())
    if kind == "csv" or command == "voronoi":
        assert run.said.startswith("note: column 'lon' is written as 'lon_1' and 'lat' as 'lat_1'")


@pytest.mark.parametrize("kind", ["csv", "geojson", "gpkg"])
def test_results_of_a_result_keep_the_first_answer(folder, run, kind):
    run("nearest", "cities.csv", "--of", "cities.csv", "-o", f"first.{kind}")
    run("nearest", "cities.csv", "--of", f"first.{kind}", "-k", 2, "-o", "second.csv")
    assert "'site_row' is written as 'site_row_1'" in run.said
    columns = read_points("second.csv").columns
    assert columns["site_row_1"].tolist() == [1, 1, 2, 2, 3, 3, 4, 4, 5, 5]
    assert columns["site_row"].tolist()[::2] == [1, 2, 3, 4, 5]
    run("voronoi", "cities.csv", "-o", f"cells.{kind}")
    if kind == "csv":
        run("voronoi", "cells.csv", "-o", "again.csv")
        assert {"area_km2", "area_km2_1"} < set(read_points("again.csv").columns)


@pytest.mark.parametrize("command", EVERY)
def test_an_input_is_never_written_and_a_file_not_unasked(own, run, command):
    ending = {"globe": "svg", "contour": "geojson"}.get(command, "csv")
    out = own / f"out.{ending}"
    out.write_text("mine", encoding="utf-8")
    message = run(*EVERY[command], "-o", out.name, code=2)
    assert message == f"error: {out.name}: already exists; replace it with --overwrite, or choose another name\n"
    assert out.read_text(encoding="utf-8") == "mine"
    run(*EVERY[command], "-o", out.name, "--overwrite")
    assert out.read_text(encoding="utf-8") != "mine"
    (own / "link").mkdir()
    (own / "link" / f"same.{ending}").symlink_to(own / "cities.csv")
    options = list(EVERY[command])
    options = [str(own / "cities.csv") if option == "cities.csv" else option for option in options]
    if "cities.csv" in EVERY[command]:
        message = run(*options, "-o", f"link/same.{ending}", "--overwrite", code=2)
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
    assert "--of-crs is 'EPSG:0', which PROJ does not know" in run(*options, "--of-crs", "EPSG:0", code=2)
    points = geopandas.GeoDataFrame({"name": ["a"]}, geometry=geopandas.points_from_xy([10], [48]), crs=4326)
    points.to_file("two.gpkg", layer="first")
    points.to_file("two.gpkg", layer="second")
    message = run("voronoi", "two.gpkg", "-o", "-", code=2)
    assert message == "error: two.gpkg: there are several layers, 'first', 'second'; say which with --layer-name\n"
    assert len(rows(run("voronoi", "two.gpkg", "--layer-name", "second", "-o", "-"))) == 1


@pytest.mark.parametrize(
    "command",
    [
        ["voronoi", "cut.gml", "-o", "-"],
        ["nearest", "cities.csv", "--of", "cut.gml", "-o", "-"],
        ["interpolate", "cities.csv", "--value", "people", "--at", "cut.gml", "-o", "-"],
        ["voronoi", "cities.csv", "--clip", "cut.gml", "-o", "cells.geojson"],
        ["globe", "--layer", "cut.gml", "--no-land", "--no-coastlines", "-o", "globe.svg"],
    ],
)
def test_a_cut_file_is_named_at_every_door(own, run, command):
    points = geopandas.GeoDataFrame(
        {"name": ["a"] * 9}, geometry=geopandas.points_from_xy([10] * 9, [48] * 9), crs=4326
    )
    points.to_file("whole.gml", driver="GML")
    (own / "cut.gml").write_bytes((own / "whole.gml").read_bytes()[:1500])
    before = sorted(own.iterdir())
    assert "error: cut.gml: the file is damaged: unclosed token: line 20" in run(*command, code=2)
    assert sorted(own.iterdir()) == before


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.gpkg", b"SQLite format 3\0aaaa"),
        ("a.parquet", b"PAR1aaaa"),
        ("a.geojson", b'{"features":[null]}'),
        ("a.geojson", b'{"features":[{"geometry":{"type":"Point","coordinates":5}}]}'),
        ("a.geojson", b'{"features":' + b"[" * 200_000),
        ("a.csv", b'lon,lat,a\n1,2,"x\n3,4,b\n'),
        ("a.csv.gz", b"\x1f\x8b\x08aaaa"),
        ("a.csv.bz2", b"BZhaaaa"),
        ("a.shp", b"\x00\x00\x27\x0aaaaa"),
        ("a.xlsx", b"PK\x03\x04aaaa"),
        ("a.kml", b"<kml>"),
        ("a.csv", b"lon,lat\n" + b"1," * 100_000),
        ("a.csv", b"\xff\xfe1"),
    ],
)
def test_damaged_files_are_one_line(folder, run, name, content):
    (folder / name).write_bytes(content)
    message = run("voronoi", name, "-o", "out.csv", code=2)
    assert message.startswith(f"error: {name}: ")
    assert message.count("\n") == 1
    assert len(message) < 500
    assert not (folder / "out.csv").exists()


def shell(folder, command):
    """A command line run by a shell, since redirections are its own."""
    program = f'{sys.executable} -c "from stereodel.cli import app; app()"'
    return subprocess.run(
        ["bash", "-c", command.replace("stereodel ", f"{program} ")],
        cwd=folder,
        env={**os.environ, "COLUMNS": "200"},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("-o - >&-", "error: stdout is closed; name a file with --out\n"),
        ("-o - >/dev/full", "error: stdout: No space left on device\n"),
        ("-o full.csv", "error: full.csv: No space left on device\n"),
    ],
)
def test_what_takes_nothing(folder, options, message):
    (folder / "full.csv").symlink_to("/dev/full")
    ran = shell(folder, f"stereodel voronoi cities.csv {options}")
    assert (ran.returncode, ran.stderr) == (2, message)
