"""`stereodel web`: the interactive page as a file, from a table or without one."""

import webbrowser

import numpy as np
import pytest

from stereodel.web import assemble, web

LONLAT = [(-78.5, -0.2), (3.4, 6.5), (10.0, 48.4), (135.8, 35.0), (115.9, -32.0)]


@pytest.fixture
def opened(monkeypatch):
    """Addresses that the browser of the system was asked to show."""
    addresses = []
    monkeypatch.setattr(webbrowser, "open", lambda address: addresses.append(address) or True)
    return addresses


def test_the_command_writes_what_the_function_writes(folder, run):
    run("web", "cities.csv", "-o", "page.html", "--resolution", "110m")
    names = ["Quito", "Lagos", "Ulm", "Kyoto", "Perth"]
    web("same.html", lonlat=LONLAT, names=names, name="cities.csv", resolution="110m")
    assert (folder / "page.html").read_bytes() == (folder / "same.html").read_bytes()


@pytest.mark.parametrize(
    ("points", "name"), [([], "stereodel.html"), (["cities.csv"], "cities.html"), (["-"], "stereodel.html")]
)
def test_the_page_is_named_after_the_table(folder, run, points, name):
    run("web", *points, "--resolution", "110m", stdin="lon,lat\n1,2\n")
    assert (folder / name).is_file()
    assert run.said == ""


def test_stdout(folder, run):
    whole = run("web", "-o", "-", "--resolution", "110m")
    assert whole == assemble.html("110m")
    assert [path.name for path in folder.iterdir()] == ["cities.csv"]


def test_columns_and_missing_places(folder, run):
    (folder / "odd.csv").write_text("east,north\n1,2\n5,\n3,4\n", encoding="utf-8")
    arguments = ("web", "odd.csv", "--lon", "east", "--lat", "north", "--resolution", "110m")
    assert run(*arguments, code=2).startswith("error: odd.csv: row 2: ")
    run(*arguments, "--skip-missing")
    given = assemble.Given(np.array([(1.0, 2.0), (3.0, 4.0)]), "odd.csv")
    assert (folder / "odd.html").read_text(encoding="utf-8") == assemble.html("110m", given)


def test_a_page_is_not_replaced_unasked(folder, run):
    (folder / "cities.html").write_text("mine", encoding="utf-8")
    assert "already exists; replace it with --overwrite" in run("web", "cities.csv", code=2)
    assert (folder / "cities.html").read_text(encoding="utf-8") == "mine"
    run("web", "cities.csv", "--overwrite", "--resolution", "110m")
    assert (folder / "cities.html").stat().st_size > 100_000


def test_open_shows_the_file_if_there_is_a_browser(folder, run, opened, monkeypatch):
    run("web", "--open", "--resolution", "110m")
    assert opened == [(folder / "stereodel.html").resolve().as_uri()]
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    said = run("web", "--open", "--resolution", "110m", "--overwrite", code=2)
    assert said == "error: stereodel.html: is written, but there is no browser to open it\n"
