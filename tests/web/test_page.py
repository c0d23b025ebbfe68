"""The page as its readers have it: offline, small, at rest when nothing moves, by keys, in every colour and width."""

import gzip
import io
import json
import re

import numpy as np
import pytest
import shapely
from PIL import Image

from stereodel import fisheye, lonlat_to_xyz
from stereodel.web import assemble
from stereodel.web.contents import built
from tests.tiers import by_day
from tools.browser import ink

from .rooms import CANNOT_BE_READ, DISCS, DRAWINGS, barriers, downloaded, link, pixels, said

thorough = pytest.mark.thorough


FOCUSED = """(() => {
  const at = document.activeElement;
  (window.reached ??= new Set()).add(at.cloneNode().outerHTML);
  return at !== document.body;
})()"""
"""Notes what has the focus, and tells whether it is anything: by its attributes, as rows of tables are made anew."""

NOT_REACHED = """[
  ...document.querySelectorAll("a[href], button, input, select, summary, [tabindex='0']"),
].filter((element) => !element.disabled && element.checkVisibility() && !element.closest("[hidden]") &&
  !(element.type === "radio" && !element.checked) &&
  !reached.has(element.cloneNode().outerHTML)).map((element) => element.outerHTML.slice(0, 100))"""


def kilobytes(text):
    return len(gzip.compress(text.encode() if isinstance(text, str) else text, 9)) / 1000


def test_sizes():
    assert kilobytes(assemble.html("110m")) <= 240
    for name, most in {"page.js": 45, "exchange.js": 20, "lift.js": 8, "stereodel.wasm": 144}.items():
        assert kilobytes(built(name)) <= most


SCALE = float(fisheye((10.0, 48.0), magnification=3.0).scale_factor(lonlat_to_xyz((0.0, 20.0))))
FIRST_WORDS = {
    "sphere": ("sum", "104 facets on the sphere = 94 triangles in the plane + 10 facets that see\u00a0P"),
    "lift": ("sum", "92 facets on the ball = 83 triangles of the sheet + 9 facets that see the pole"),
    "globe": ("pointer", f"everything is {SCALE:.2f} times as large as on a plain globe"),
}


@pytest.mark.parametrize("name", DRAWINGS)
def test_a_room_asks_for_nothing_and_rests(room, page_file, name):
    page = room(name)
    assert page.requests == [page_file.as_uri()]
    assert page.frames(0.7) == 0
    canvases = f"#room-{name} canvas:visible"
    assert all(page.ink(f"{canvases} >> nth={k}") > 0.03 for k in range(page.page.locator(canvases).count()))
    output, words = FIRST_WORDS[name]
    assert words in said(page, name, output)


@thorough
@pytest.mark.parametrize("name", DRAWINGS)
def test_reduced_motion_draws_nothing_unasked(room, name):
    """Not while the page opens either: one frame in full after a hand has let go, and no more."""
    page = room(name, reduced_motion=True)
    x, y = page.middle(DRAWINGS[name])
    page.drag((x, y), (x + 60, y + 10), steps=3)
    page.page.mouse.move(1, 1)
    page.page.wait_for_timeout(400)  # that frame comes after 120 ms of rest
    assert page.frames(0.5) == 0


KEYS = {"sphere": ["Ctrl", "Z", "Del", "Esc"], "lift": [",", "."], "globe": ["+", "−", "F"]}
"""Keys of each room that nobody would guess."""


@pytest.mark.parametrize("name", by_day(DRAWINGS, "sphere"))
@pytest.mark.parametrize("colours", by_day(["light", "dark"], "light"))
@pytest.mark.parametrize("width", by_day([1280, 320], 1280))
def test_axe_finds_nothing_and_keys_are_told_on_the_page_and_to_who_does_not_see_it(room, name, colours, width):
    page = room(name, colours=colours, width=width)
    assert barriers(page) == []
    brightness = np.median(page.picture())
    assert brightness > 200 if colours == "light" else brightness < 60
    tree = page.page.context.new_cdp_session(page.page).send("Accessibility.getFullAXTree")["nodes"]
    told = [node["description"]["value"] for node in tree if "turn" in node.get("description", {}).get("value", "")]
    assert all(key in told[0] for key in ["arrows turn", "0", *KEYS[name]])
    shown = page.page.locator(f"#room-{name} kbd:visible").all_inner_texts()
    assert set(KEYS[name]) <= set(shown)


@thorough
@pytest.mark.parametrize("name", DRAWINGS)
def test_tab_reaches_everything_and_nothing_is_wider_than_the_window(room, name):
    page = room(name)
    for _ in range(300):
        page.page.keyboard.press("Tab")
        # Rows of the table are made when they come into sight.
        page.page.evaluate("new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)))")
        if not page.page.evaluate(FOCUSED):
            break
    assert page.page.evaluate(NOT_REACHED) == []
    for width in (1600, 1280, 1000, 800, 390, 320):
        page.page.set_viewport_size({"width": width, "height": 800})
        page.rest()
        assert page.page.evaluate("document.documentElement.scrollWidth") <= width


@thorough
@pytest.mark.parametrize("name", DISCS)
def test_a_swipe_on_the_disc_turns_and_one_in_the_corner_scrolls(room, name):
    page = room(name, touch=True, width=390)
    disc = page.page.locator(DISCS[name])
    disc.scroll_into_view_if_needed()
    page.rest()
    box, before = disc.bounding_box(), page.page.evaluate("scrollY")
    still = page.digest(DISCS[name])
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.swipe((middle, (middle[0] + 30, middle[1] + 40)))
    page.rest()
    assert page.page.evaluate("scrollY") == before
    assert page.digest(DISCS[name]) != still
    corner = (box["x"] + 3, box["y"] + box["height"] - 3)
    page.swipe((corner, (corner[0], corner[1] - 120)))
    page.rest()
    assert page.page.evaluate("scrollY") > before + 60


# Links


DROP = """([name, text]) => {
  const files = new DataTransfer();
  files.items.add(new File([text], name));
  for (const type of ["dragover", "drop"]) {
    document.body.dispatchEvent(new DragEvent(type, { dataTransfer: files, bubbles: true, cancelable: true }));
  }
}"""


def drop(page, name, count):
    """Drop a table of so many places with names and numbers, one of which is missing."""
    lonlat = np.random.default_rng(count).uniform((-180, -90), (180, 90), size=(count, 2))
    rows = [f"Ort {k} & Co,{lon},{lat},{k or ''}\n" for k, (lon, lat) in enumerate(lonlat)]
    page.page.evaluate(DROP, [name, "name,lon,lat,size\n" + "".join(rows)])
    page.page.locator(".room:visible td.name").first.wait_for()
    page.rest()


def test_names_colours_and_what_a_hand_has_changed_are_in_the_link(room):
    page = room("sphere")
    drop(page, "towns.csv", 6)
    for key in (".", "Delete", "n"):
        page.page.locator("#sphere-ball").press(key)
    page.page.locator("input[name=colours][value=dark]").check()
    page.rest(still=0.5)
    elsewhere = room(page.link)
    names = [f"Ort {k} & Co" for k in range(1, 6)]
    assert elsewhere.page.locator("#room-sphere td.name").all_inner_texts() == [*names, ""]
    assert elsewhere.page.locator("select[name=set] option:checked").first.inner_text() == "towns.csv"
    assert downloaded(elsewhere, "csv")[1].splitlines()[0] == b"lon,lat,name,size"
    assert downloaded(elsewhere, "csv") == downloaded(page, "csv")
    assert elsewhere.page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(22, 24, 27)"
    assert pixels(elsewhere, "sphere") == pixels(page, "sphere")


@pytest.mark.parametrize("name", by_day(DISCS, "globe"))
def test_a_page_that_is_saved_has_the_table_at_any_length(room, tmp_path, name):
    page = room(name)
    drop(page, "many.csv", 3000)
    page.page.locator(DRAWINGS[name]).press("ArrowUp")
    page.rest(still=0.5)
    assert "file=many.csv" in page.link
    for _ in range(1 if name == "globe" else 2):  # a page that was saved can be saved
        file = tmp_path / "saved.html"
        file.write_bytes(downloaded(page, "page")[1])
        page.page.mouse.move(1, 1)
        saved = room("", file=file)
        assert saved.page.locator(f"#room-{name} td.name").first.inner_text() == "Ort 0 & Co"
        assert pixels(saved, name) == pixels(page, name)
        saved.rest(still=0.5)
        again = room(page.link, file=file)
        assert pixels(again, name) == pixels(page, name)
        page = saved


def test_fields_take_the_nearest_number_that_they_can_and_say_so(room):
    page = room("globe", reduced_motion=True)
    latitude = page.page.locator("#room-globe [name=focus-lat]")
    latitude.fill("-95.5")
    assert latitude.get_attribute("aria-invalid") == "true"
    assert page.page.inner_text("#room-globe .reason") == "\u221290 is the least."
    latitude.press("Tab")
    assert (latitude.input_value(), latitude.get_attribute("aria-invalid")) == ("-90.0", None)
    assert link(page)["focuslat"] == "-90"
    latitude.fill("")
    latitude.press("Tab")
    assert latitude.input_value() == "-90.0"


HOSTILE = ["s=NaN", "s=1e999", "s=0.5", "focuslat=91", "lens=cheese", "viewlon=1e999", "fromradius=0"]
HOSTILE = [f"globe&{value}" for value in HOSTILE]
HOSTILE += ["lift&bend=-1", "sphere&sites=<script>alert(1)</script>", "sphere&sites=1,2,3", "sphere&step=999"]
HOSTILE += ["sphere&on=%3Cscript%3E&pole-lat=95"]


@pytest.mark.parametrize("values", by_day(HOSTILE, HOSTILE[0]), ids=lambda values: values[:20])
def test_a_hostile_link_gives_a_message_and_the_first_view(room, values):
    name = values.partition("&")[0]
    page = room(f"v=1&room={values}")
    assert page.page.locator("[role=alert]").inner_text().startswith(CANNOT_BE_READ)
    page.page.locator("[role=alert] button").click()
    page.rest()
    assert pixels(page, name) == pixels(room(name), name)


# What is taken along


@thorough
def test_what_is_not_needed_is_not_compiled(room):
    """Neither files nor the Lift room, until they are asked for; then once."""
    page = room("sphere")
    page.page.evaluate("""() => {
      const append = HTMLHeadElement.prototype.append;
      window.run = [];
      HTMLHeadElement.prototype.append = function (element) {
        run.push(element.text.length);
        append.call(this, element);
      };
    }""")
    compiled = []
    for name in ("globe", "lift", "sphere", "lift"):
        page.page.click(f"nav a[href='#{name}']")
        page.until(f"!document.querySelector('#room-{name}').hidden")
        page.rest()
        compiled.append(page.page.evaluate("run.length"))
    assert compiled == [0, 1, 1, 1]
    assert page.ink(DRAWINGS["lift"]) > 0.03
    page.page.go_back()  # leads to the room before
    page.until("!document.querySelector('#room-sphere').hidden && document.querySelector('#room-lift').hidden")
    page.rest()
    assert page.ink(DRAWINGS["sphere"]) > 0.03
    for _ in range(2):
        downloaded(page, "svg")
    assert page.page.evaluate("run") == [len(built(name).decode()) for name in ("lift.js", "exchange.js")]


@pytest.mark.parametrize("name", by_day(DRAWINGS, "sphere"))
def test_svg_and_png_are_the_same_picture(room, visit, tmp_path, name):
    page = room(name)
    page.page.fill("input[name=png-scale]", "1")
    (svg_name, svg), (png_name, png) = downloaded(page, "svg"), downloaded(page, "png")
    assert (svg_name, png_name) == (f"stereodel-{name}.svg", f"stereodel-{name}.png")
    with Image.open(io.BytesIO(png)) as image:
        given = np.asarray(image.convert("RGB")).astype(int)
    file = tmp_path / svg_name
    file.write_bytes(svg)
    drawn = visit(file, width=given.shape[1], height=given.shape[0]).picture().astype(int)
    assert drawn.shape == given.shape
    assert ink(given) > 0.05
    assert (np.abs(drawn - given).max(axis=-1) > 48).mean() < 0.005
    assert len(re.findall(rb' d="[^"]*A', svg)) > 3  # true arcs


@thorough
def test_cells_and_triangles_are_taken_along_and_fill_the_map(room):
    features = json.loads(downloaded(room("sphere"), "geojson")[1])["features"]
    for kind, count in {"cell": 54, "triangle": 104}.items():
        found = [feature["geometry"] for feature in features if feature["properties"]["kind"] == kind]
        shapes = [shapely.geometry.shape(geometry) for geometry in found]
        assert [shape.is_valid for shape in shapes] == [True] * count
        assert shapely.union_all(shapes).area == pytest.approx(360 * 180, rel=1e-6)
        assert sum(shape.area for shape in shapes) == pytest.approx(360 * 180, rel=1e-6)
    areas = [feature["properties"]["area"] for feature in features if feature["properties"]["kind"] == "cell"]
    assert sum(areas) == pytest.approx(4 * np.pi)
