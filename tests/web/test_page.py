"""The page as its readers have it: offline, small, at rest when nothing moves, by keys, in every colour and width."""

import base64
import gzip
import json
import re
import zlib

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from PIL import Image

from stereodel.io import read_points
from stereodel.web import assemble, web
from stereodel.web.contents import built
from tools.browser import ink

ROOMS = {"sphere": "#sphere-ball", "lift": "#lift-plate", "globe": "#globe-plate"}
"""Rooms, and their first drawing."""

DISCS = {"sphere": "#sphere-ball", "globe": "#globe-plate"}
"""Those that are turned."""

FOCUSED = """(() => {
  const at = document.activeElement;
  (window.reached ??= new Set()).add(at.cloneNode().outerHTML);
  return at !== document.body;
})()"""
"""Notes what has the focus, and tells whether it is anything: by its attributes, as rows of tables are made anew."""

PIXELS = "(selector) => document.querySelector(selector).toDataURL()"
"""Of the drawing alone, without the ring round what has the focus."""

NEXT_FRAME = "new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)))"

NOT_REACHED = """[
  ...document.querySelectorAll("a[href], button, input, select, summary, [tabindex='0']"),
].filter((element) => !element.disabled && element.checkVisibility() && !element.closest("[hidden]") &&
  !(element.type === "radio" && !element.checked) &&
  !reached.has(element.cloneNode().outerHTML)).map((element) => element.outerHTML.slice(0, 100))"""


def kilobytes(text):
    return len(gzip.compress(text.encode() if isinstance(text, str) else text, 9)) / 1000


def test_sizes():
    assert kilobytes(assemble.html("110m")) <= 230
    assert kilobytes(built("page.js")) <= 40
    assert kilobytes(built("exchange.js")) <= 13
    assert kilobytes(built("lift.js")) <= 8
    assert kilobytes(built("stereodel.wasm")) <= 140


@pytest.mark.parametrize("name", ROOMS)
def test_a_room_asks_for_nothing_and_rests(room, page_file, name):
    page = room(name)
    assert page.requests == [page_file.as_uri()]
    assert page.frames(1.0) == 0
    assert page.ink(ROOMS[name]) > 0.03


@pytest.mark.parametrize("name", ROOMS)
def test_reduced_motion_draws_nothing_unasked(room, name):
    """Not while the page opens either: one frame in full after a hand has let go, and no more."""
    page = room(name, reduced_motion=True)
    x, y = page.middle(ROOMS[name])
    page.drag((x, y), (x + 60, y + 10), steps=3)
    page.page.mouse.move(1, 1)
    page.page.wait_for_timeout(400)  # that frame comes after 120 ms of rest
    assert page.frames(0.5) == 0


@pytest.mark.parametrize("name", ROOMS)
@pytest.mark.parametrize(
    "how",
    [{}, {"colours": "dark"}, {"width": 320}, {"width": 320, "colours": "dark"}],
    ids=["light", "dark", "320", "320 dark"],
)
def test_axe_finds_nothing(room, name, how):
    page = room(name, **how)
    found = Axe().run(page.page).response
    assert [f"{each['id']}: {each['nodes'][0]['html'][:120]}" for each in found["violations"]] == []
    assert len(found["passes"]) > 20


@pytest.mark.parametrize("name", ROOMS)
def test_nothing_is_wider_than_the_window(room, name):
    page = room(name)
    for width in (1600, 1280, 1000, 800, 390, 320):
        page.page.set_viewport_size({"width": width, "height": 800})
        page.rest()
        assert page.page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize("name", ROOMS)
def test_tab_reaches_everything(room, name):
    page = room(name)
    for _ in range(300):
        page.page.keyboard.press("Tab")
        page.page.evaluate(NEXT_FRAME)  # rows of the table are made when they come into sight
        if not page.page.evaluate(FOCUSED):
            break
    assert page.page.evaluate(NOT_REACHED) == []


@pytest.mark.parametrize("name", DISCS)
def test_keys_turn_and_magnify(room, name):
    page = room(name)
    page.page.focus(DISCS[name])
    seen = [page.digest(DISCS[name])]
    for key in ["ArrowLeft", "ArrowUp", "Shift+ArrowRight", *(["+", "f"] if name == "globe" else ["n"])]:
        page.page.keyboard.press(key)
        page.rest()
        seen.append(page.digest(DISCS[name]))
    assert len(set(seen)) == len(seen)


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


@pytest.mark.parametrize("name", DISCS)
def test_a_link_shows_the_same_pixels(room, name):
    page = room(name)
    page.page.focus(DISCS[name])
    for key in ("ArrowLeft", "ArrowLeft", "ArrowUp"):
        page.page.keyboard.press(key)
    page.until("location.hash.includes('v=1')")
    page.rest(still=0.4)
    again = room(page.link)
    assert again.page.evaluate(PIXELS, DISCS[name]) == page.page.evaluate(PIXELS, DISCS[name])


def test_back_leads_to_the_room_before(room):
    page = room("sphere")
    page.page.click("nav a[href='#globe']")
    page.until("!document.querySelector('#room-globe').hidden")
    page.page.go_back()
    page.until("!document.querySelector('#room-sphere').hidden && document.querySelector('#room-globe').hidden")
    page.rest()
    assert page.ink(ROOMS["sphere"]) > 0.03


@pytest.mark.parametrize(
    "link",
    [
        "cellar",
        "v=1&room=globe&s=NaN",
        "v=1&room=globe&viewlat=1e999",
        "v=1&room=sphere&sites=<script>alert(1)</script>",
        "v=1&room=lift&bend=-1",
        "v=1&room=sphere&sites=d" + "A" * 1_000_000,
    ],
    ids=lambda link: link[:40],
)
def test_a_hostile_link_gives_a_message_and_the_first_view(room, link):
    page = room(link)
    assert (
        page.page.locator("[role=alert]")
        .inner_text()
        .startswith("This link cannot be read, so here is the room as it begins.")
    )
    name = next((name for name in ROOMS if f"room={name}" in link), "sphere")
    first = room(name)
    page.page.locator("[role=alert] button").click()
    page.rest()
    assert page.digest(ROOMS[name]) == first.digest(ROOMS[name])


# Files

DROP = """([name, text]) => {
  const files = new DataTransfer();
  files.items.add(new File([text], name));
  for (const type of ["dragover", "drop"]) {
    document.body.dispatchEvent(new DragEvent(type, { dataTransfer: files, bubbles: true, cancelable: true }));
  }
}"""


def drop(page, name, text):
    page.page.evaluate(DROP, [name, text])


@pytest.mark.parametrize(
    "text",
    [
        "lon,lat\n5,7\n7,95.2\n",
        "lon,lat\n1,2\nx,4\n",
        "lon,lat\n1,\n",
        'name,lon,lat\n"a,1,2\n',
        "lon,lon,lat\n1,2,3\n",
    ],
)
@pytest.mark.parametrize("name", DISCS)
def test_a_wrong_file_is_told_in_the_words_of_read_points(room, tmp_path, name, text):
    file = tmp_path / "cities.csv"
    file.write_text(text)
    with pytest.raises(ValueError) as raised:
        read_points(file)
    page = room(name)
    before = page.digest(DISCS[name])
    drop(page, "cities.csv", text)
    page.until("document.querySelector('[role=alert]')?.checkVisibility()")
    said = " ".join(page.page.locator("[role=alert] p").inner_text().split())
    assert "cities.csv" in said
    assert " ".join(str(raised.value).split()).split(": ", 1)[-1] in said
    assert said.endswith("Nothing has changed.")
    page.page.locator("[role=alert] button").click()
    page.rest()
    assert page.digest(DISCS[name]) == before


@pytest.mark.parametrize("name", DISCS)
def test_a_file_that_is_dropped_is_drawn(room, name):
    page = room(name)
    before = page.digest(DISCS[name])
    rows = "\n".join(f"{lon},{lat}" for lon in range(-180, 180, 20) for lat in range(-80, 81, 20))
    drop(page, "grid.csv", f"lon,lat\n{rows}\n")
    page.page.wait_for_timeout(300)
    page.rest()
    assert page.digest(DISCS[name]) != before
    assert page.page.locator("[role=alert]:visible").count() == 0


def test_a_page_opens_with_the_points_that_it_was_made_for(visit, tmp_path):
    lonlat = [(-78.5, -0.2), (3.4, 6.5), (10.0, 48.4), (135.8, 35.0), (115.9, -32.0)]
    names = ["Quito", "Lagos", "Ulm", "Kyoto", "Perth"]
    file = web(tmp_path / "cities.html", lonlat=lonlat, names=names, name="cities.csv", resolution="110m")
    page = visit(file)
    page.until("document.documentElement.dataset.ready")
    page.rest()
    table = page.page.locator("#room-sphere .sites").inner_text()
    assert "135.8" in table
    assert "48.4" in table
    assert page.page.locator("#room-sphere td.name").all_inner_texts() == names
    page.page.click(".rooms a[href='#globe']")
    page.rest()
    assert page.page.locator("#room-globe td.name").all_inner_texts() == names


# Exports


def test_a_script_that_fails_is_told_and_tried_again(visit, page_file):
    page = visit(f"{page_file.as_uri()}#sphere", complaints=["did not run", "Content Security Policy"])
    page.until("document.documentElement.dataset.ready")
    page.rest()
    change = """(code) => {
      const block = document.getElementById("block-exchange");
      window.kept ??= block.textContent;
      block.textContent = code ?? window.kept;
    }"""
    foreign = base64.b64encode(zlib.compress(b"document.currentScript.offers = {};")).decode()
    page.page.evaluate(change, foreign)
    page.page.click("[data-export=svg]")
    page.until("document.querySelector('[role=alert]')")
    assert page.page.inner_text("[role=alert]").startswith("The computation failed and was stopped.")
    page.page.evaluate(change, None)
    with page.page.expect_download() as download:
        page.page.click("[data-export=svg]")
    assert b"</svg>" in download.value.path().read_bytes()


def test_what_is_not_needed_is_not_compiled(room):
    """Neither files nor the Lift room, until they are asked for; then once."""
    page = room("sphere")
    page.page.evaluate(
        """() => {
          const append = HTMLHeadElement.prototype.append;
          window.run = [];
          HTMLHeadElement.prototype.append = function (element) {
            run.push(element.text.length);
            append.call(this, element);
          };
        }"""
    )
    page.page.click("nav a[href='#globe']")
    page.until("!document.querySelector('#room-globe').hidden")
    page.rest()
    assert page.page.evaluate("run") == []
    for name in ("lift", "sphere", "lift"):
        page.page.click(f"nav a[href='#{name}']")
        page.until(f"!document.querySelector('#room-{name}').hidden")
        page.rest()
    assert page.ink(ROOMS["lift"]) > 0.03
    for _ in range(2):
        with page.page.expect_download():
            page.page.click("[data-export=svg]")
    assert page.page.evaluate("run") == [len(built(name).decode()) for name in ("lift.js", "exchange.js")]


@pytest.mark.parametrize("name", ROOMS)
@pytest.mark.parametrize("kind", ["svg", "png"])
def test_a_drawing_is_taken_along(room, name, kind):
    page = room(name)
    with page.page.expect_download() as download:
        page.page.click(f"[data-export={kind}]")
    content = download.value.path().read_bytes()
    assert download.value.suggested_filename == f"stereodel-{name}.{kind}"
    assert content[:8] == b"\x89PNG\r\n\x1a\n" if kind == "png" else b"</svg>" in content


@pytest.mark.parametrize("name", ["sphere", "lift"])
def test_svg_and_png_are_the_same_picture(room, visit, tmp_path, name):
    page = room(name)
    page.page.fill("input[name=png-scale]", "1")
    for kind in ("svg", "png"):
        with page.page.expect_download() as download:
            page.page.click(f"[data-export={kind}]")
        download.value.save_as(tmp_path / f"room.{kind}")
    with Image.open(tmp_path / "room.png") as image:
        png = np.asarray(image.convert("RGB")).astype(int)
    drawn = visit(tmp_path / "room.svg", width=png.shape[1], height=png.shape[0]).picture().astype(int)
    assert drawn.shape == png.shape
    assert ink(png) > 0.05
    assert (np.abs(drawn - png).max(axis=-1) > 48).mean() < 0.005


def test_cells_are_taken_along_as_geojson(room):
    page = room("sphere")
    with page.page.expect_download() as download:
        page.page.click("[data-export=geojson]")
    features = json.loads(download.value.path().read_text())["features"]
    assert len(features) > 50
    assert {feature["geometry"]["type"] for feature in features} <= {"Polygon", "MultiPolygon", "Point"}


@pytest.mark.parametrize("name", ROOMS)
def test_the_lines_of_python_run(room, name, tmp_path, monkeypatch):
    page = room(name)
    page.page.click(".foot summary")
    page.page.wait_for_timeout(100)
    code = page.page.locator(".foot code").inner_text()
    monkeypatch.chdir(tmp_path)
    exec(compile(code, f"{name}.py", "exec"), {})
    assert re.search(r"^from stereodel", code, re.MULTILINE)


# Colours


@pytest.mark.parametrize("name", ROOMS)
def test_dark_is_dark(room, name):
    light, dark = (room(name, colours=colours).picture() for colours in ("light", "dark"))
    assert np.median(light) > 200
    assert np.median(dark) < 60


@pytest.mark.parametrize("touch", [False, True])
@pytest.mark.parametrize("name", ["sphere", "lift"])
def test_tables_show_whole_rows(room, name, touch):
    page = room(name, touch=touch, width=390 if touch else 1280)
    height, head, row = page.page.evaluate(
        "(room) => ['.sites', 'thead', 'tr[data-site]'].map((selector, k) => { const each ="
        " document.querySelector(`${room} ${selector}`); return k ? each.getBoundingClientRect().height :"
        " each.clientHeight; })",
        f"#room-{name}",
    )
    rows = (height - head) / row
    assert rows == pytest.approx(7, abs=0.05)
