"""`stereodel globe`: pictures that show what was asked for."""

import pytest

from stereodel.render.image import read_picture


def test_png_has_the_size_asked_for(folder, run):
    run("globe", "cities.csv", "-o", "globe.png", "--size", 200)
    assert read_picture(folder / "globe.png").shape == (200, 200, 3)


@pytest.mark.parametrize(("shown", "groups"), [("cells", {"voronoi"}), ("triangles", {"delaunay"}), ("points", set())])
def test_svg_shows_what_was_asked_for(folder, shown, groups, run):
    run("globe", "cities.csv", "-o", "globe.svg", "--show", shown)
    text = (folder / "globe.svg").read_text(encoding="utf-8")
    assert {name for name in ("voronoi", "delaunay") if f'id="{name}' in text} == groups


def test_the_focus_is_magnified(folder, run):
    """Ulm's cell is Europe under the lens, so the border between Lagos and Ulm moves away from Ulm."""
    pictures = []
    for name, options in (("plain", []), ("lens", ["--magnify", 4])):
        run("globe", "cities.csv", "-o", f"{name}.png", "--focus=10,48.4", "--size", 200, *options)
        pictures.append(read_picture(folder / f"{name}.png"))
    assert (pictures[0] != pictures[1]).any()


def test_pdf_to_stdout(folder):
    from typer.testing import CliRunner

    from stereodel.cli import app

    ran = CliRunner().invoke(app, ["globe", "cities.csv", "-o", "-", "--format", "pdf"])
    assert ran.stdout_bytes.startswith(b"%PDF")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--view", "10"], "--view is '10', but must be LON,LAT"),
        (["--focus", "10,95"], "outside [-90, 90]"),
        (["--magnify", "-1"], "magnification"),
    ],
)
def test_wrong_options(folder, options, message, run):
    assert message in run("globe", "cities.csv", "-o", "globe.svg", *options, code=2)
    assert not (folder / "globe.svg").exists()
