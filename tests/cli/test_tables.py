"""Tables of results in every format, read again."""

import pytest

from stereodel.cli.destinations import TABLES
from stereodel.io import read_points


@pytest.mark.parametrize("kind", TABLES)
def test_formats_hold_the_same(folder, run, kind):
    run("nearest", "cities.csv", "--of", "cities.csv", "-o", f"out.{kind}")
    table = read_points(folder / f"out.{kind}")
    assert table.lonlat.tolist() == read_points("cities.csv").lonlat.tolist()
    assert list(table.columns) == ["name", "people", "site_row", "site_name", "distance_km"]
    assert table.columns["site_name"].tolist() == ["Quito", "Lagos", "Ulm", "Kyoto", "Perth"]
    assert table.columns["site_row"].tolist() == [1, 2, 3, 4, 5]
    assert sorted(path.name for path in folder.iterdir()) == ["cities.csv", f"out.{kind}"]


@pytest.mark.parametrize("kind", TABLES)
def test_pipes_hold_the_same(folder, run, kind):
    """What one command writes to stdout, the next one reads from stdin."""
    from typer.testing import CliRunner

    from stereodel.cli import app

    first = CliRunner().invoke(app, ["nearest", "cities.csv", "--of", "cities.csv", "-o", "-", "--format", kind])
    options = ["nearest", "-", "--of", "cities.csv", "-o", "out.csv", "--keep", "people"]
    assert CliRunner().invoke(app, options, input=first.stdout_bytes).exit_code == 0
    assert (
        read_points("out.csv").columns["site_people"].tolist() == read_points("cities.csv").columns["people"].tolist()
    )
