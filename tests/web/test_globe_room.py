"""The Globe room in a browser: what the hand does is what the library computes, and the drawing follows it."""

import json
import subprocess
import sys
import time
from functools import partial
from urllib.parse import parse_qs

import numpy as np
import pytest
import shapely
from PIL import Image

from stereodel import MoebiusMap, SphereCircle, bubble_to_bubble, fisheye, lonlat_to_xyz
from stereodel.drawing import View

from .rooms import downloaded, opened, pixels, python_lines, said, table

pytestmark = pytest.mark.thorough  # what is asked once of each room by day stands in test_page.py

MARGIN = 7.0
"""Of a globe's limb in its canvas, CSS pixels."""


class Globe:
    """A globe of the page: its link as a map, its places as the library has them."""

    def __init__(self, page, selector="#globe-plate"):
        self.page, self.selector = page, selector
        box = page.page.locator(selector).first.bounding_box()
        self.middle = np.array([box["x"] + box["width"] / 2, box["y"] + box["height"] / 2])
        self.radius = box["width"] / 2 - MARGIN

    def values(self):
        """What the link says, once the hand rests."""
        self.page.page.wait_for_timeout(350)
        self.page.rest()
        return {name: values[0] for name, values in parse_qs(self.page.link).items()}

    def numbers(self, *names):
        values = self.values()
        return tuple(float(values.get(name, 0)) for name in names)

    def switch(self, name):
        """Switch a box on or off, where the page is: it does not scroll."""
        box = f"#room-globe input[name={name}]"
        self.page.page.evaluate("(box) => document.querySelector(box).click()", box)

    @property
    def lens(self):
        lon, lat, size = self.numbers("focuslon", "focuslat", "s")
        return fisheye((lon, lat), magnification=size)

    @property
    def view(self):
        return View(*self.numbers("viewlon", "viewlat", "viewroll"))

    def seen_at(self, lonlat, lens=None, view=None):
        """Where a place is in the window, by the link or by what is given."""
        x, y, z = (view or self.view).matrix @ (lens or self.lens)(lonlat_to_xyz(lonlat))
        assert z > 0
        return self.middle + self.radius * np.array([x, -y])

    def place_at(self, window):
        """What is there, as a direction."""
        x, y = (np.asarray(window) - self.middle) / self.radius * (1, -1)
        return self.lens.inverse()(self.view.matrix.T @ [x, y, np.sqrt(1 - x * x - y * y)])


@pytest.fixture
def globe(room):
    return Globe(room("globe"))


def test_a_drag_keeps_the_place_under_the_pointer(globe):
    start, end = globe.middle + (-60, 40), globe.middle + (90, -30)
    grabbed = globe.place_at(start)
    globe.page.page.emulate_media(reduced_motion="reduce")  # no running out
    for way in ((start, end), (end, start)):
        globe.page.drag(*way)
        assert np.linalg.norm(globe.place_at(way[1]) - grabbed) * globe.radius * 3 < 1
        globe.switch("north")


def test_the_wheel_magnifies_about_the_pointer_once_the_globe_has_the_focus(globe):
    page = globe.page.page
    at = globe.middle + (70, 90)
    page.mouse.move(*at)
    page.mouse.wheel(0, -200)
    assert globe.numbers("s") == (3.0,)  # the page scrolled or not: the globe has no focus
    page.evaluate("scrollTo(0, 0)")
    page.focus("#globe-plate")
    place = globe.place_at(at)
    page.mouse.wheel(0, -200)
    (size,) = globe.numbers("s")
    assert 3 < size <= 3 * np.exp(0.4)
    assert np.linalg.norm(globe.place_at(at) - place) * globe.radius * size < 1
    for _ in range(20):
        page.mouse.wheel(0, 500)
    assert globe.numbers("s") == (1.0,)  # the way back ends at the plain globe
    assert np.linalg.norm(globe.place_at(at) - place) * globe.radius < 1


def test_two_fingers_magnify_where_they_are_far_down_a_page(room):
    page = room("globe", touch=True, width=800, height=900)
    page.page.evaluate("void document.querySelector('.head').style.setProperty('padding-top', '600vh')")
    page.page.locator("#globe-plate").scroll_into_view_if_needed()
    page.rest()
    globe = Globe(page)
    middle = globe.middle + (50, -60)
    place = globe.place_at(middle)
    page.swipe((middle - (40, 0), middle - (80, 0)), (middle + (40, 0), middle + (80, 0)))
    (size,) = globe.numbers("s")
    assert 3 < size <= 6.001
    assert np.linalg.norm(globe.place_at(middle) - place) * globe.radius * size < 1.5


def test_the_ring_is_dragged_and_a_double_click_sets_the_focus(globe):
    start = globe.seen_at((10, 48))
    globe.page.drag(start, start + (80, 60))
    assert np.linalg.norm(globe.seen_at(globe.numbers("focuslon", "focuslat")) - start - (80, 60)) < 1
    assert globe.numbers("viewlon", "viewlat") == (-8.0, 20.0)
    at = globe.middle + (-100, 20)
    place = globe.place_at(at)
    globe.page.page.mouse.dblclick(*at)
    globe.page.page.wait_for_timeout(450)
    lon, lat = globe.numbers("focuslon", "focuslat")
    assert lonlat_to_xyz((lon, lat)) @ place > np.cos(np.radians(0.01))
    assert np.linalg.norm(globe.seen_at((lon, lat)) - at) < 1


def test_keys(globe):
    page = globe.page.page
    page.focus("#globe-plate")
    for key in ("ArrowRight", "Shift+ArrowUp", "+"):
        page.keyboard.press(key)
    assert globe.numbers("viewlon", "viewlat", "s") == (-3.0, 21.0, 3.75)
    page.keyboard.press("f")
    assert np.linalg.norm(globe.seen_at(globe.numbers("focuslon", "focuslat")) - globe.middle) < 1
    page.keyboard.press("0")
    assert globe.numbers("viewlon", "viewlat", "s", "focuslon") == (-8.0, 20.0, 3.0, 10.0)
    page.wait_for_timeout(700)
    assert page.inner_text("#status") == "3.00 times at 48.0°\u202fN 10.0°\u202fE, seen from 20.0°\u202fN 8.0°\u202fW"


def test_the_pointer_is_followed_and_five_sides_are_drawn_with_the_lens_alone(globe):
    """Not anew while the globe turns: one drawing for a move of the mouse, and one in full when it rests."""
    mouse, (x, y) = globe.page.page.mouse, globe.middle
    mouse.move(x + 120, y + 100)
    pointed = lonlat_to_xyz(globe.numbers("pointerlon", "pointerlat"))
    assert pointed @ globe.place_at((x + 120, y + 100)) > 1 - 1e-9
    needle = globe.page.page.inner_text("#room-globe [data-out=scale] .needle")
    assert needle == f"{float(globe.lens.scale_factor(pointed)):.2f}×"
    side = ".views li:nth-child(1) canvas"
    before = globe.page.digest(side)
    mouse.move(x + 90, y + 70)
    mouse.down()
    drawn, begun = globe.page.page.evaluate("framesDrawn"), time.monotonic()
    mouse.move(x - 10, y + 70, steps=10)
    pauses = (time.monotonic() - begun) / 0.12  # in which it may rest, too
    globe.page.rest()
    assert 5 <= globe.page.page.evaluate("framesDrawn") - drawn <= 12 + pauses
    mouse.up()
    globe.page.rest()
    assert globe.page.digest(side) == before
    globe.page.page.focus("#room-globe input[name=mag]")
    globe.page.page.keyboard.press("ArrowRight")
    globe.page.rest()
    assert globe.page.digest(side) != before


def test_figures_to_begin_with_and_five_sides_to_fly_to(room):
    globe = Globe(room("globe", reduced_motion=True))
    for which, size in {"figure-10": 1.0, "figure-11": 4.0, "figure-12": 20.0}.items():
        globe.page.page.click(f"button[value={which}]")
        assert globe.numbers("s", "focuslon", "focuslat", "viewlat") == (size, 0.0, 40.0, 40.0)
    globe.page.page.click(".views li:nth-child(5) button")
    assert globe.numbers("viewlon", "viewlat") == (180.0, -40.0)
    assert globe.page.frames(0.5) == 0


def test_bubble_to_bubble(room):
    page = room("v=1&room=globe&lens=bubble")
    taken, filled = SphereCircle.around((10, 48), 14.0), SphereCircle.around((10, 48), 72.0)
    carry = bubble_to_bubble(taken, filled)
    middle, rim = (float(carry.scale_factor(p)) for p in (lonlat_to_xyz((10, 48)), taken.sample(4)[0]))
    words = f"In the middle of the bubble everything is {middle:.2f} times as large, at its rim {rim:.2f} times."
    assert page.page.inner_text("#room-globe [data-out=pointer]") == words
    globe = Globe(page, "#globe-before")
    at = partial(globe.seen_at, lens=MoebiusMap.identity(), view=View(10, 42))
    page.drag(at((10, 34)), at((10, 20)))  # the rim, to 28°
    assert globe.numbers("fromradius") == (pytest.approx(28, abs=0.3),)
    page.drag(at((10, 48)), at((25, 40)))  # the inside
    assert np.linalg.norm(at(globe.numbers("fromlon", "fromlat")) - at((25, 40))) < 1
    assert globe.numbers("toradius") == (72.0,)
    page.page.fill("input[name=to-radius]", "30")
    page.page.keyboard.press("Enter")
    assert globe.numbers("toradius") == (30.0,)
    assert page.ink("#globe-after") > 0.3


def test_the_readers_places_stand_in_a_table(globe):
    page = globe.page
    assert not page.page.is_visible("#room-globe .sites")
    before = page.picture("#globe-plate").astype(int)
    opened(page, "globe", table("towns.csv", "name,lon,lat\nA,10,48.4\nB,-78.5,-0.2\nC,3.4,6.5\n"))
    changed = np.abs(page.picture("#globe-plate") - before).max(axis=-1)
    assert (changed > 60).mean() > 0.002  # the cells, too, and not the places alone
    assert said(page, "globe", "places") == "The 3 places of towns.csv"
    rows = page.page.locator("#room-globe .sites tbody tr[data-site]")
    assert said(page, "globe", "latitude") == "Areas are those of the ellipsoid WGS84 (authalic)."

    # The row that has the focus is held in the drawing; its number brings it to the middle, and the lens to it.
    before = page.picture("#globe-plate").astype(int)
    rows.nth(2).get_by_role("button").focus()
    page.rest()
    x, y = globe.seen_at((3.4, 6.5)) - globe.middle + page.picture("#globe-plate").shape[0] / 2
    window = np.s_[int(y) - 4 : int(y) + 5, int(x) - 4 : int(x) + 5]
    changed = page.picture("#globe-plate").astype(int) - before
    assert np.abs(changed[window]).max() > 100
    assert (np.abs(changed).max(axis=-1) > 30).sum() < 100
    rows.nth(1).get_by_role("button").click()
    page.page.wait_for_timeout(600)
    assert globe.numbers("focuslon", "focuslat", "viewlon", "viewlat") == pytest.approx((-78.5, -0.2, -78.5, -0.2))


@pytest.mark.parametrize("kind", ["authalic", "geodetic", "spherical"])
def test_a_page_and_the_command_agree_about_the_cells_of_a_table(rng, room, tmp_path, kind):
    lonlat = np.round(rng.uniform((-180, -90), (180, 90), (40, 2)), 2)
    table, cells = tmp_path / "towns.csv", tmp_path / "cells.geojson"
    np.savetxt(table, lonlat, "%.2f", delimiter=",", header="lon,lat", comments="")
    asked = [] if kind == "authalic" else ["--latitude", kind]
    for command in (["web", table, "-o", tmp_path / "towns.html"], ["voronoi", table, "-o", cells]):
        subprocess.run([sys.executable, "-m", "stereodel", *command, *asked], check=True)
    page = room("globe", file=tmp_path / "towns.html", height=1400)
    page.until("document.querySelectorAll('#room-globe .sites tbody tr[data-site]').length > 10")
    rows = page.page.locator("#room-globe .sites tbody tr[data-site]").all_inner_texts()
    shown = [int("".join(c for c in row.split("\t")[3] if c.isdigit())) for row in rows]
    written = [feature["properties"]["area_km2"] for feature in json.loads(cells.read_text())["features"]]
    assert shown == np.rint(written[: len(shown)]).astype(int).tolist()

    # The file of the page's own cells: the corners of both are the same, in the latitudes of the table.
    theirs = json.loads(downloaded(page, "geojson")[1])["features"]
    shapes = [shapely.geometry.shape(feature["geometry"]) for feature in theirs]
    pairs = zip(shapes, shapely.from_geojson(cells.read_text()).geoms, strict=True)
    # Towards the poles the chords of the page are longer on the map.
    pairs = [(shape, ours) for shape, ours in pairs if np.abs(shape.bounds[1::2]).max() < 60]
    assert len(pairs) > 5
    assert all(shape.symmetric_difference(ours).area < 1e-3 * ours.area for shape, ours in pairs)


def test_a_panorama_is_seen_through_the_lens_and_another_shape_is_refused(globe, tmp_path):
    file = tmp_path / "square.png"
    Image.new("RGB", (100, 100)).save(file)
    opened(globe.page, "globe", file)
    assert "100 × 100" in globe.page.page.inner_text("[role=alert]")
    # One colour north and south of 40° N, east and west of 0°: what is drawn tells where it comes from.
    image = np.zeros((256, 512, 3), np.uint8)
    image[: round(256 * 50 / 180), :, 0] = 255
    image[:, 256:, 1] = 255
    Image.fromarray(image).save(file)
    opened(globe.page, "globe", file)
    for name in ("graticule", "tissot"):
        globe.switch(name)
    globe.page.rest()
    for lonlat, red, green in [((20, 50), 255, 255), ((-9, 52), 255, 0), ((9, 20), 0, 255), ((-9, 20), 0, 0)]:
        x, y = np.rint(globe.seen_at(lonlat)).astype(int)
        r, g, _ = globe.page.picture()[y, x].astype(int)
        assert (r > 128, g > 128) == (red > 128, green > 128), lonlat


def test_a_panorama_is_taken_along_and_named_by_the_link(room, tmp_path):
    page = room("globe")
    water = page.digest("#globe-plate")
    Image.new("RGB", (256, 128), (200, 30, 60)).save(tmp_path / "rooms.png")
    page.page.set_input_files("#room-globe input[type=file]", str(tmp_path / "rooms.png"))
    page.until("location.hash.includes('picture=rooms.png')")
    page.rest(still=0.4)
    painted = page.digest("#globe-plate")
    assert painted != water
    assert not page.page.is_visible("#room-globe input[name=land]")
    assert downloaded(page, "svg")[1].count(b'href="data:image/png;base64,') == 1
    lines = python_lines(page)
    assert 'globe.add_raster("rooms.png")' in lines
    assert "add_land" not in lines
    subprocess.run([sys.executable, "-c", lines], cwd=tmp_path, check=True)
    # The link has the name and not the bytes: where the picture was opened it is shown again, elsewhere it is missed.
    link = page.link
    for go, named, drawn in ((page.page.go_back, "!", water), (page.page.go_forward, "", painted)):
        go()
        page.until(f"{named}location.hash.includes('picture=')")
        page.rest()
        assert page.digest("#globe-plate") == drawn
    told = room(link).page.inner_text("[role=alert]")
    assert told.startswith("rooms.png is named by this link, which does not hold its pixels. Open the file here.")
    page.page.click("text=Back to land and coasts")
    page.rest(still=0.4)
    assert page.digest("#globe-plate") == water
    assert page.page.is_checked("#room-globe input[name=land]")


def test_a_preset_forgets_the_pointer(room):
    pages, presets = [room("globe"), room("globe")], "document.querySelector('[value=new-york]').click()"
    pages[0].page.mouse.move(*np.add(pages[0].middle("#globe-plate"), 60))
    for page in pages:
        page.page.evaluate(presets)
        page.rest(still=0.4)
    assert pages[0].digest("#globe-before") == pages[1].digest("#globe-before")


STROKE = "CanvasRenderingContext2D.prototype.stroke"
FAILING = f"""() => {{
  let calls = 0;
  window.kept = {STROKE};
  {STROKE} = function (...given) {{
    if (++calls > 3) throw new Error("no memory");
    return kept.apply(this, given);
  }};
}}"""


@pytest.mark.parametrize("name", ["globe-plate", "globe-after", "sphere-ball"])
def test_a_failure_amid_a_movement_leaves_the_last_picture_until_it_is_drawn_again(room, name):
    page = room("v=1&room=globe&lens=bubble" if name == "globe-after" else name[:-6], complaints=["no memory"])
    x, y = page.middle(f"#{name}")
    page.page.mouse.move(x + 150, y)
    page.rest(still=0.4)
    before = pixels(page, name.split("-")[0])
    page.page.mouse.down()
    page.page.evaluate(FAILING)
    page.page.mouse.move(x + 100, y + 10)
    page.until("document.querySelector('#messages').textContent")
    page.rest()
    assert pixels(page, name.split("-")[0]) == before
    message = page.page.locator("#messages")
    assert message.inner_text().startswith("The computation failed and was stopped. Your sites are still here.")
    page.page.mouse.up()
    page.page.evaluate(f"void ({STROKE} = kept)")
    message.get_by_role("button", name="Draw again").click()
    page.rest()
    assert message.inner_text() == ""
    assert page.page.locator(".failed").count() == 0
    assert pixels(page, name.split("-")[0]) != before
