"""`stereodel globe`: pictures that show what was asked for."""

import json
import re
from dataclasses import replace
from itertools import pairwise
from xml.etree import ElementTree as ET

import imageio.v3 as iio
import numpy as np
import pytest
from PIL import Image, ImageSequence
from typer.testing import CliRunner

from stereodel import fisheye, lonlat_to_xyz
from stereodel.cli import app
from stereodel.cli import globe as command
from stereodel.cli.globe import Aim, layer_of, motion_of
from stereodel.drawing import StereographicView, View
from stereodel.film import Film, FrameError
from tests.globe.test_looks import squares
from tests.render.test_vector import SVG
from tools.baselines import read_picture

BARE = ["--show=graticule"]


GROUPS = ("coast", "graticule", "land", "borders", "rivers", "lakes", "voronoi", "delaunay")
EARTH = "land,lakes,graticule,rivers,coastlines,borders"


@pytest.mark.parametrize(
    ("options", "groups"),
    [
        (["cities.csv", "--show=cells"], {"voronoi"}),
        (["cities.csv", "--show=triangles"], {"delaunay"}),
        (["cities.csv", "--show=points"], set()),
        (["--show=none"], set()),
        ([], {"coast", "graticule", "land"}),
        ([f"--show={EARTH}"], {"coast", "graticule", "land", "borders", "rivers", "lakes"}),
        (["--texture", "blue-marble"], {"coast", "graticule"}),
        (["--texture", "blue-marble", "--show=land"], {"land"}),
    ],
)
def test_svg_shows_what_was_asked_for(folder, run, options, groups):
    run("globe", "-o", "globe.svg", "--size", 200, *options)
    text = (folder / "globe.svg").read_text(encoding="utf-8")
    assert {name for name in GROUPS if f'id="{name}' in text} == groups
    assert groups or len(text) < 20_000


def test_the_middle_of_the_picture():
    points = lonlat_to_xyz([(170, 10), (-170, 10)])
    free = Aim(None, 1.0, None, "globe")
    assert free.views == (View(0, 0),)
    assert free.with_middle_of(points).place == pytest.approx((-180, 10), abs=0.2)
    focused = replace(free, focus=(1.0, 2.0))
    assert focused.with_middle_of(points).views == (View(1, 2),)
    assert replace(focused, middle=(3.0, 4.0)).views == (View(3, 4),)
    flat = replace(focused, projection="stereographic")
    assert flat.views == (StereographicView(1, 2),)
    both = replace(focused, projection="hemispheres").views
    assert both == (StereographicView(1, 2), StereographicView(-179, -2))
    assert free.with_middle_of(lonlat_to_xyz([(0, 0), (180, 0)])).place == (0.0, 0.0)


def test_textures(folder, run):
    """A picture of the Earth that is red in the west: seen from 90° W, the globe is red, and from 90° E it is not."""
    pixels = np.zeros((20, 40, 3), dtype=np.uint8)
    pixels[:, :20, 0] = 255
    iio.imwrite(folder / "red.png", pixels)
    for name, view in (("west.png", "-90,0"), ("east.png", "90,0")):
        run("globe", "-o", name, "--size", 60, "--texture", "red.png", f"--view={view}", *BARE)
    west, east = (read_picture(folder / name)[30, 30].astype(int) for name in ("west.png", "east.png"))
    assert west[0] > 150 > 50 > west[1]
    assert east.max() < 50


GROWING = ["--magnify=5", "--projection", "stereographic", "--title=Earth"]


@pytest.mark.parametrize(("name", "options", "frames"), [("turn.gif", [], 3), ("grow.webp", GROWING, 6)])
def test_films(folder, run, monkeypatch, name, options, frames):
    """Whole files of so many frames, which differ, and nothing beside them."""
    for constant, value in (("SECONDS", 3.0), ("FPS", 2.0), ("GIF_FPS", 1.0)):
        monkeypatch.setattr(command, constant, value)
    run("globe", "-o", name, "--focus", "10,50", "--size", 48, *BARE, *options)
    with Image.open(folder / name) as film:
        pictures = [np.asarray(picture.convert("RGB")) for picture in ImageSequence.Iterator(film)]
    assert len(pictures) == frames
    assert all((one != other).any() for one, other in pairwise(pictures))
    assert sorted(path.name for path in folder.iterdir()) == sorted(["cities.csv", name])


def test_what_moves():
    aim = Aim((10.0, 50.0), 8.0, None, "globe")
    lens, view = motion_of(aim, [(20.0, 40.0)])(0.0)
    assert lens.is_close(fisheye((10, 50), magnification=8))
    assert view == View(10, 50)
    flight = motion_of(aim, [(20.0, 40.0)])
    assert flight(flight.seconds)[1] == View(20, 40)
    grown = [motion_of(aim, [])(time)[0].magnification for time in (0.0, 5.0, 10.0)]
    assert grown == pytest.approx([1, 8, 1])
    still = motion_of(replace(aim, magnification=1.0), [])
    lens, view = still(2.5)
    assert (lens.magnification, view.lat) == (1, 50)
    assert view.lon == pytest.approx(10 - 90)


def test_a_frame_that_fails_is_told_and_an_interrupted_film_goes_on(folder, run, monkeypatch):
    def failing(error):
        def save(self, path, *, progress):
            raise error

        return save

    monkeypatch.setattr(Film, "save", failing(FrameError("frame 3 could not be drawn")))
    assert run("globe", "-o", "a.gif", code=2) == "error: frame 3 could not be drawn\n"
    monkeypatch.setattr(Film, "save", failing(KeyboardInterrupt()))
    assert "the same command draws the missing frames" in run("globe", "-o", "a.gif", code=130)


def test_a_picture_to_stdout(folder):
    ran = CliRunner().invoke(app, ["globe", "cities.csv", "-o", "-", "--size=40"])
    assert ran.stdout_bytes.startswith(b"\x89PNG")


@pytest.mark.parametrize("options", [(), ("--magnify=1e9",)])
def test_the_graticule_suits_what_the_lens_shows(folder, run, options):
    """About a dozen meridians cross the middle of the picture, however much is magnified."""
    run("globe", "-o", "globe.svg", "--focus=2,48", "--show=graticule", *options)
    (path,) = re.findall('<path id="graticule"[^>]* d="([^"]*)"', (folder / "globe.svg").read_text(encoding="utf-8"))
    assert 12 <= path.count("M") <= 36


def test_names_titles_and_legends(folder, run):
    """What the options say is in the file: names of the first rows before others, words."""
    rows = "name,lon,lat\nLarge,10,50\nNear,10,50.01\n,20,40\nFar,-170,-50\n"
    (folder / "towns.csv").write_text(rows, encoding="utf-8")
    run("globe", "towns.csv", "-o", "a.svg", "--view=10,50", "--labels=name", "--title=Towns & more", "--legend")
    root = ET.parse(folder / "a.svg").getroot()
    texts = ["".join(text.itertext()) for text in root.iter(f"{SVG}text")]
    assert texts == ["Large", "Near", "Towns & more", "cells", "towns"]
    assert root.find(f"{SVG}title").text == "Towns & more"
    assert float(root.get("width").removesuffix("pt")) == pytest.approx(170 / 25.4 * 72, abs=1e-3)


def test_a_legend_shows_what_the_map_shows_in_a_style_of_ones_own(folder, run):
    (folder / "towns.csv").write_text("lon,lat\n10,50\n20,40\n0,60\n", encoding="utf-8")
    (folder / "v.toml").write_text(
        '[lines]\nvoronoi = {color = "red", width = 2}\n[dots.sites]\ncolor = "#00aa00"\n', encoding="utf-8"
    )
    run("globe", "towns.csv", "-o", "a.svg", "--view=10,50", "--legend", "--style=v.toml", "--style=dark")
    looks = {path.get("id"): path.attrib for path in ET.parse(folder / "a.svg").getroot().iter(f"{SVG}path")}
    assert looks["ground"]["fill"] == "#121212"
    for name in ("voronoi", "legend-voronoi"):
        assert (looks[name]["stroke"], looks[name]["stroke-width"]) == ("#ff0000", "2"), name
    assert looks["sites-2"]["fill"] == looks["legend-sites-2"]["fill"] == "#00aa00"


def test_layers_of_points_lines_and_polygons(folder, run):
    """With colours, widths and outlines; a polygon's outline and a dot's rim are paths of their own."""
    for kind, coordinates in {
        "Point": [10, 50],
        "LineString": [[0, 40], [20, 60]],
        "Polygon": [[[0, 40], [20, 40], [10, 60], [0, 40]]],
    }.items():
        geometry = {"type": kind, "coordinates": coordinates}
        (folder / f"{kind}.geojson").write_text(json.dumps(geometry), encoding="utf-8")

    def drawn(*layers):
        layers = [f"--layer={layer}" for layer in layers]
        run("globe", "-o", "a.svg", "--focus=10,50", "--magnify=5", *BARE, *layers, "--overwrite")
        paths = ET.parse(folder / "a.svg").getroot().iter(f"{SVG}path")
        return [path for path in paths if (path.get("id") or "").startswith("layer")]

    assert len(drawn("Polygon.geojson", "LineString.geojson", "Point.geojson")) == 5
    looks = ["Polygon.geojson,color=#00ff00,outline=none", "LineString.geojson,color=red,width=1mm"]
    area, line = drawn(*looks)
    assert line.get("stroke") == "#ff0000"
    assert float(line.get("stroke-width")) == pytest.approx(72 / 25.4, abs=1e-4)
    assert area.get("fill").startswith("url(")  # lit as the ball is
    shape = json.loads((folder / "Polygon.geojson").read_text(encoding="utf-8"))
    named = {"type": "Feature", "properties": {"NAME": "Côte d’Or"}, "geometry": shape}
    (folder / "named.geojson").write_text(json.dumps(named), encoding="utf-8")
    assert drawn("named.geojson,outline=none,id=NAME") == []  # it has a name of its own
    assert 'id="Côte-d-Or" data-name="Côte d’Or"' in (folder / "a.svg").read_text(encoding="utf-8")
    (folder / "a,color=b.geojson").touch()
    assert layer_of("a,color=b.geojson")[0].name == "a,color=b.geojson"


BY_VALUE = ["cities.csv", "--point-size=people", "--point-color=people", "--show=points"]
BY_VALUE += ["--legend-text=people=inhabitants", "--legend-text=people (size)=many"]


def test_points_and_layers_by_value(folder, run):
    """Areas and colours of a column, classes of a layer; what polygons replace is said, and they do so."""
    run("globe", "-o", "a.svg", *BY_VALUE, "--scale=log", "--colors=magma_r")
    text = (folder / "a.svg").read_text(encoding="utf-8")
    assert "inhabitants: colours, logarithmic from 100" in text
    assert "many: areas of dots in proportion to the amount, 15.4" in text
    (folder / "six.geojson").write_text(json.dumps(squares([None, *range(1, 6)])))
    layer = ["--layer=six.geojson,column=kind", "--legend", "--resolution=110m"]
    run("globe", "-o", "b.svg", *layer, "--classes=0,2,4,9", "--colors=#ff0000,#00ff00,#0000ff")
    assert run.said.startswith(
        "note: six.geojson: polygons replace the land and the coastlines of the package; --show="
    )
    text = (folder / "b.svg").read_text(encoding="utf-8")
    assert 'id="land' not in text
    assert 'id="coast' not in text
    assert all(color in text for color in ("#ff0000", "#00ff00", "#0000ff"))
    assert "kind: colours of 3 classes with the limits 0, 2, 4, 9; no value in gray" in text
    run("globe", "-o", "c.svg", *layer, "--show=land,coastlines", "--center=3")
    assert run.said == ""
    text = (folder / "c.svg").read_text(encoding="utf-8")
    assert text.index('id="land') < text.index('id="layer') < text.index('id="coast')
