"""`stereodel globe`: pictures that show what was asked for."""

import numpy as np
import pytest

from stereodel import lonlat_to_xyz
from stereodel.cli.globe_page import GlobePicture, lens_at, middle_of
from stereodel.render import View
from stereodel.render.image import read_picture
from stereodel.render.page import Dots


def test_png_has_the_size_asked_for(folder, run):
    run("globe", "cities.csv", "-o", "globe.png", "--size", 200)
    assert read_picture(folder / "globe.png").shape == (200, 200, 3)


@pytest.mark.parametrize(("shown", "groups"), [("cells", {"voronoi"}), ("triangles", {"delaunay"}), ("points", set())])
def test_svg_shows_what_was_asked_for(folder, shown, groups, run):
    run("globe", "cities.csv", "-o", "globe.svg", "--show", shown)
    text = (folder / "globe.svg").read_text(encoding="utf-8")
    assert {name for name in ("voronoi", "delaunay") if f'id="{name}' in text} == groups


def test_the_focus_is_magnified():
    """A point 10° north of the focus is drawn sin 10° above the middle, and sin 2·atan(4·tan 5°) through the lens."""
    places = lonlat_to_xyz([(10.0, 40.0), (10.0, 50.0)])
    heights = []
    for magnification in (1.0, 4.0):
        picture = GlobePicture(places, frozenset({"points"}), View(10, 40), lens_at((10.0, 40.0), magnification))
        (dots,) = (item for item in picture.page().items if isinstance(item, Dots))
        assert dots.centers[0] == pytest.approx([0, 0], abs=1e-12)
        heights.append(dots.centers[1, 1])
    assert heights == pytest.approx([np.sin(np.radians(10)), np.sin(2 * np.arctan(4 * np.tan(np.radians(5))))])


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


def test_the_middle_of_points():
    assert middle_of(lonlat_to_xyz([(170, 10), (-170, 10)])) == pytest.approx((-180, 10), abs=0.2)
    assert middle_of(lonlat_to_xyz([(0, 0), (180, 0)])) == (0.0, 0.0)


def test_clusters_are_drawn(folder, run):
    """Points 1e-12 degrees apart, duplicates, and a single point."""
    (folder / "tight.csv").write_text("lon,lat\n5,5\n5.000000000001,5\n5,5.000000000001\n5,5\n", encoding="utf-8")
    (folder / "one.csv").write_text("lon,lat\n5,5\n", encoding="utf-8")
    for name in ("tight", "one"):
        run("globe", f"{name}.csv", "-o", f"{name}.svg", "--show", "cells", "--show", "triangles", "--magnify", 9)
        assert (folder / f"{name}.svg").stat().st_size > 0
