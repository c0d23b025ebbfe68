"""A folder with small tables, and the command run in it."""

import csv
import io

import pytest
from typer.testing import CliRunner

from stereodel.cli import app

CITIES = """name,lon,lat,people
Quito,-78.5,-0.2,2800000
Lagos,3.4,6.5,15400000
Ulm,10.0,48.4,128000
Kyoto,135.8,35.0,1460000
Perth,115.9,-32.0,2110000
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The current folder, with cities.csv in it."""
    (tmp_path / "cities.csv").write_text(CITIES, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def run(folder):
    """Run the command in the folder; gives what it prints on stdout, or on stderr when a failure is expected."""

    def run(*arguments, stdin=None, code=0):
        ran = CliRunner().invoke(app, [str(argument) for argument in arguments], input=stdin)
        assert ran.exit_code == code, ran.output
        assert ran.exception is None or isinstance(ran.exception, SystemExit)
        run.said = ran.stderr
        return ran.stderr if code else ran.stdout

    return run


@pytest.fixture
def rows():
    """A function from the text of a CSV table to its rows as dictionaries."""
    return lambda text: list(csv.DictReader(io.StringIO(text)))
