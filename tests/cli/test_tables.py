"""Tables of results in every format, read again."""

import numpy as np
import pytest

from stereodel.cli.destinations import TABLES
from stereodel.io import read_points


@pytest.mark.parametrize("kind", TABLES)
def test_formats_hold_the_same(folder, run, kind):
    run("nearest", "cities.csv", "--of", "cities.csv", "-o", f"out.{kind}")
    table = read_points(folder / f"out.{kind}")
    # FlatGeobuf sorts rows by place; names of shapefiles have ten letters; KML says more, and all of it as text.
    order = np.argsort(table.columns["site_row"].astype(int)) if kind == "fgb" else np.arange(5)
    assert table.lonlat[order].tolist() == read_points("cities.csv").lonlat.tolist()
    names = ["name", "people", "site_row", "site_name", "distance_km"]
    if kind == "shp":
        names[-1] = "distance_k"
    assert [name for name in table.columns if name.lower() in names] == (
        ["Name", *names[1:]] if kind == "kml" else names
    )
    assert table.columns["site_name"][order].tolist() == ["Quito", "Lagos", "Ulm", "Kyoto", "Perth"]
    assert table.columns["site_row"][order].astype(int).tolist() == [1, 2, 3, 4, 5]
    others = [f"out.{ending}" for ending in ("cpg", "dbf", "prj", "shx")] if kind == "shp" else []
    assert sorted(path.name for path in folder.iterdir()) == sorted(["cities.csv", f"out.{kind}", *others])


@pytest.mark.parametrize("kind", [kind for kind in TABLES if kind != "shp"])
def test_pipes_hold_the_same(folder, run, kind):
    """What one command writes to stdout, the next one reads from stdin."""
    from typer.testing import CliRunner

    from stereodel.cli import app

    first = CliRunner().invoke(app, ["nearest", "cities.csv", "--of", "cities.csv", "-o", "-", "--format", kind])
    options = ["nearest", "-", "--of", "cities.csv", "-o", "out.csv", "--keep", "people"]
    assert CliRunner().invoke(app, options, input=first.stdout_bytes).exit_code == 0
    found = read_points("out.csv").columns["site_people"].tolist()
    assert sorted(found) == sorted(read_points("cities.csv").columns["people"].tolist())
