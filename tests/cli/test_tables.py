"""Tables of results in every format, read again."""

import geopandas
import pytest
from typer.testing import CliRunner

from stereodel.cli import app
from stereodel.cli.destinations import TABLES
from stereodel.io import read_points


@pytest.mark.parametrize("kind", [kind for kind in TABLES if kind != "shp"])
def test_pipes_hold_the_same(folder, run, kind):
    """What one command writes to stdout, the next one reads from stdin."""
    first = CliRunner().invoke(app, ["nearest", "cities.csv", "--of", "cities.csv", "-o", "-", "--format", kind])
    options = ["nearest", "-", "--of", "cities.csv", "-o", "out.csv", "--keep", "people"]
    assert CliRunner().invoke(app, options, input=first.stdout_bytes).exit_code == 0
    found = read_points("out.csv").columns["site_people"].tolist()
    assert sorted(found) == sorted(read_points("cities.csv").columns["people"].tolist())


@pytest.mark.parametrize(
    ("command", "kind"),
    [
        (["voronoi", "plane.csv"], "gpkg"),
        (["triangulate", "plane.csv"], "parquet"),
        (["contour", "plane.csv", "--value", "v", "--levels", "1.5"], "geojson"),
        (["nearest", "plane.csv", "--of", "plane.csv"], "parquet"),
        (["interpolate", "plane.csv", "--value", "v", "--at", "plane.csv"], "gpkg"),
        (["nearest", "plane.csv", "--of", "plane.csv"], "geojson"),
    ],
)
def test_a_plane_keeps_its_coordinate_system(folder, run, command, kind):
    lines = ["e,n,v", "570000,5360000,1", "580000,5360000,2", "575000,5370000,3", "576000,5364000,2"]
    (folder / "plane.csv").write_text("\n".join(lines), encoding="utf-8")
    run(*command, "--plane", "e", "n", "--crs", "EPSG:25832", "-o", f"out.{kind}")
    read = geopandas.read_parquet if kind == "parquet" else geopandas.read_file
    frame = read(folder / f"out.{kind}")
    if kind == "geojson":  # which is in degrees
        assert frame.crs.to_epsg() == 4326
        frame = frame.to_crs("EPSG:25832")
    assert frame.crs.to_epsg() == 25832
    assert 560_000 < frame.total_bounds[0] < 580_000
    assert "--crs is 'EPSG:0'" in run(*command, "--plane", "e", "n", "--crs", "EPSG:0", "-o", "b.gpkg", code=2)


def test_other_endings_of_formats(folder, run):
    run("nearest", "cities.csv", "--of", "cities.csv", "-o", "out.json")
    run("nearest", "cities.csv", "--of", "cities.csv", "-o", "out.geoparquet")
    assert len(read_points("out.json")) == len(read_points("out.geoparquet")) == 5
