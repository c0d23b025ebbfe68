"""`latitude` is one word with one default at each kind of door: Python, the commands, the page."""

import inspect
import typing

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import typer.main
from typer.testing import CliRunner

from stereodel.cli import application, partition
from stereodel.cli.application import app
from stereodel.cli.options import LatitudeKind
from stereodel.sphere.latitudes import KINDS, Latitude
from tests.test_api import PACKAGES
from tools import names


def doors():
    """Public functions, classes and methods that take a latitude's kind."""
    for package in PACKAGES.values():
        for name in names.public_names(package):
            value = getattr(package, name)
            methods = [] if not inspect.isclass(value) else [each for each in vars(value) if each[0] != "_"]
            for thing in (value, *(getattr(value, each) for each in methods)):
                if callable(thing) and not (inspect.isclass(thing) and issubclass(thing, Exception)):
                    try:
                        parameters = inspect.signature(thing).parameters
                    except ValueError:
                        continue
                    if "latitude" in parameters:
                        yield f"{package.__name__}.{getattr(thing, '__qualname__', name)}", parameters["latitude"]


DOORS = dict(doors())
OF_THE_EARTH = {"stereodel.web.web", "stereodel.io.nearest_shapes"}


@pytest.mark.parametrize("name", DOORS)
def test_a_door_of_the_library(name):
    """Spherical, or what is remembered; authalic, as for commands, for the page and shapes."""
    parameter = DOORS[name]
    assert parameter.default in ({"authalic"} if name in OF_THE_EARTH else {"spherical", None})
    assert str(parameter.annotation).removesuffix(" | None") == "Latitude"


def test_there_are_these_doors():
    assert len(DOORS) >= 28
    assert typing.get_args(Latitude) == KINDS


def test_doors_of_the_commands():
    """Every command that takes columns of longitude and latitude takes their kind, and all have the same default; but
    for pictures, in which the kind cannot be seen, and for what is understood of a table, where it decides nothing.
    """
    takers = {}
    for name, command in typer.main.get_command(app).commands.items():
        options = {option: each for each in command.params for option in each.opts}
        assert ("--lat" in options) == ("--latitude" in options) or name in {"globe", "inspect"}, name
        if "--latitude" in options:
            takers[name] = options["--latitude"]
    assert takers.keys() >= {"contour", "interpolate", "nearest", "triangulate", "voronoi", "web"}
    for option in takers.values():
        assert option.default == "authalic"
    assert typing.get_args(typing.get_args(LatitudeKind)[0]) == KINDS
    assert len({option.help for option in takers.values()}) == 1


@pytest.mark.parametrize(("given", "kind"), [([], "authalic"), (["--latitude", "geodetic"], "geodetic")])
@pytest.mark.parametrize("out", ["a.csv", pytest.param("a/", marks=pytest.mark.thorough), "a.html"])
def test_where_areas_are_written_the_command_says_of_which_latitudes(tmp_path, monkeypatch, out, given, kind):
    lon, lat = [1.0, 20.0, 50.0, 9.0], [3.0, 4.0, -50.0, 70.0]
    pq.write_table(pa.table({"lon": lon, "lat": lat}), tmp_path / "points.parquet")
    said = []
    for module in (application, partition):
        monkeypatch.setattr(module, "say", said.append)
    command = {"a.csv": "voronoi", "a/": "partition", "a.html": "web"}[out]
    monkeypatch.chdir(tmp_path)
    ran = CliRunner().invoke(app, [command, "points.parquet", "-o", out, *given])
    assert ran.exit_code == 0, ran.output
    assert len(said) == 1
    assert said[0].endswith(f" {kind} latitudes")
