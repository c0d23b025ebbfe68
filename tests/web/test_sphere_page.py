"""The Sphere room in a browser: what the hand, the keys and the fields do, what is drawn and said of it."""

import json
import re

import numpy as np
import pytest

from stereodel import SphericalDelaunay, lonlat_to_xyz
from stereodel.triangulation.theorem import planar_part
from stereodel.web.contents import scattered

GAP = scattered()["gap"]

ROOM = "#room-sphere"
BALL = "#sphere-ball"
PLANE = "#sphere-plane"


def said(page, name):
    return page.page.locator(f"{ROOM} [data-out={name}]").inner_text().replace("\u2009", "").replace("\u2002", " ")


def value(page, name):
    return page.page.locator(f"{ROOM} [name={name}]").input_value()


def link(page):
    """The values of the address, once it has followed."""
    page.page.wait_for_timeout(400)
    return dict(part.split("=", 1) for part in page.link.split("&") if "=" in part)


def is_accent(pixels):
    """Pixels of the colour of what is held."""
    red, green, blue = (pixels[..., k].astype(int) for k in range(3))
    return (red > 180) & (red - green > 60) & (green - blue > 40)


def test_the_first_picture_and_its_sentence(room):
    page = room("sphere")
    assert said(page, "sentence") == (
        "The circle round 7·22·41 has the radius 20.09° on the sphere, 0.560 ball radii in the plane. "
        "Other sites inside: 0\u00a0and\u00a00."
    )
    assert said(page, "sum") == "104 facets on the sphere = 94 triangles in the plane + 10 facets that see\u00a0P"
    for canvas in (BALL, PLANE):
        assert page.ink(canvas) > 0.05
        assert is_accent(page.picture(canvas)).mean() > 0.002
    assert page.frames(0.5) == 0


def test_the_bubble_follows_the_pointer_in_both_pictures(room):
    page = room("sphere")
    before = page.digest(PLANE)
    x, y = page.middle(BALL)
    page.page.mouse.move(x + 60, y + 60)
    page.rest()
    sentence = said(page, "sentence")
    assert "7·22·41" not in sentence
    assert page.digest(PLANE) != before
    on_ball = page.digest(BALL)
    page.page.mouse.move(*page.middle(PLANE))
    page.rest()
    assert said(page, "sentence") != sentence
    assert page.digest(BALL) != on_ball
    assert said(page, "sentence").endswith("Other sites inside: 0\u00a0and\u00a00.")


def test_a_click_keeps_the_bubble_and_escape_frees_it(room):
    page = room("sphere")
    x, y = page.middle(BALL)
    page.page.mouse.click(x + 60, y + 60)
    kept = said(page, "sentence")
    page.page.mouse.move(x - 100, y)
    assert said(page, "sentence") == kept
    assert link(page)["pin"] == "1"
    page.page.locator(BALL).press("Escape")
    page.page.mouse.move(x - 101, y)
    page.rest()
    assert said(page, "sentence") != kept


def test_the_grabbed_place_stays_under_the_pointer(room):
    page = room("sphere")
    x, y = page.middle(BALL)
    start, end = (x + 40, y - 30), (x - 60, y + 45)  # from between the sites
    radius = page.page.locator(BALL).bounding_box()["width"] / 2 - 7
    grabbed = unseen(page, start, (x, y), radius)
    page.page.emulate_media(reduced_motion="reduce")  # no running out
    page.drag(start, end)
    page.rest()
    moved = unseen(page, end, (x, y), radius)
    assert np.degrees(np.arccos(np.clip(grabbed @ moved, -1, 1))) < np.degrees(1.5 / radius)


def unseen(page, at, middle, radius):
    """The direction of the sphere under a place of the window, by the fields of the view."""
    state = link(page)
    lon, lat = (np.radians(float(state.get(f"view-{part}", 0))) for part in ("lon", "lat"))
    u, v = (at[0] - middle[0]) / radius, (middle[1] - at[1]) / radius
    right = np.array([-np.sin(lon), np.cos(lon), 0])
    up = np.array([-np.sin(lat) * np.cos(lon), -np.sin(lat) * np.sin(lon), np.cos(lat)])
    toward = np.cross(right, up)
    return u * right + v * up + np.sqrt(1 - u * u - v * v) * toward


def test_the_pole_is_dragged_over_the_limb(room):
    page = room("sphere")
    x, y = page.middle(BALL)
    radius = page.page.locator(BALL).bounding_box()["width"] / 2 - 7
    direction = lonlat_to_xyz([-150.0, 53.1])
    pole = (x + radius * direction[1], y - radius * direction[2])  # seen from 0° N, 0° E
    assert "lies behind" in said_desc(page)
    out = (x - 0.5 * radius, y - 1.02 * radius)
    page.page.mouse.move(*pole)
    page.page.mouse.down()
    page.page.mouse.move(*out, steps=6)
    page.page.mouse.move(x - 40, y - 60, steps=6)
    page.page.mouse.up()
    page.rest()
    assert "lies in front" in said_desc(page)
    state = link(page)
    lonlat = [float(state["pole-lon"]), float(state["pole-lat"])]
    front = lonlat_to_xyz(lonlat)
    np.testing.assert_allclose(radius * front[1:], [-40, 60], atol=1)
    delaunay = first_sites()
    planar = len(planar_part(delaunay, front))
    assert said(page, "sum").startswith(f"104 facets on the sphere = {planar} triangles in the plane + {104 - planar} ")
    page.page.locator(f"{ROOM} [name=pole-lat]").fill("-20")
    page.rest()
    assert link(page)["pole-lat"] == "-20"


def said_desc(page):
    return page.page.locator("#sphere-desc").inner_text()


def first_sites():
    return SphericalDelaunay.from_lonlat(GAP)


def test_sites_are_added_moved_removed_and_undone(room):
    page = room("sphere")
    x, y = page.middle(BALL)
    rows = f"{ROOM} h2[data-out=count]"
    page.page.locator(f"{ROOM} [name=click][value=add]").check()
    page.page.mouse.click(x + 33, y + 7)
    assert page.page.locator(rows).inner_text() == "The 55 sites"
    assert said(page, "sum").startswith("106 facets")
    page.drag((x + 33, y + 7), (x + 60, y + 40))
    page.rest()
    assert said(page, "sum").startswith("106 facets")
    state = link(page)
    assert state["sites"].startswith("d")
    page.page.locator(f"{ROOM} [name=click][value=remove]").check()
    page.page.mouse.click(x + 60, y + 40)
    assert page.page.locator(rows).inner_text() == "The 54 sites"
    for _ in range(3):
        page.page.locator(f"{ROOM} [data-do=undo]").click()
    assert page.page.locator(rows).inner_text() == "The 54 sites"
    assert page.page.locator(f"{ROOM} [data-do=undo]").is_disabled()
    assert said(page, "sum") == "104 facets on the sphere = 94 triangles in the plane + 10 facets that see\u00a0P"


def test_keys_alone_reach_everything(room):
    page = room("sphere", reduced_motion=True)
    ball = page.page.locator(BALL)
    ball.focus()
    for key in ("ArrowRight", "ArrowUp", "Shift+ArrowUp"):
        page.page.keyboard.press(key)
    assert (value(page, "view-lon"), value(page, "view-lat")) == ("5.0", "6.0")
    page.page.keyboard.press("0")
    assert value(page, "view-lon") == "0.0"
    page.page.keyboard.press("n")
    assert page.page.locator(f"{ROOM} h2[data-out=count]").inner_text() == "The 55 sites"
    page.page.keyboard.press("Control+ArrowRight")
    assert "5.0°\u202fE" in page.page.locator(f"{ROOM} tr[data-site='54']").inner_text()
    page.page.keyboard.press("Delete")
    page.page.keyboard.press("Control+z")
    assert page.page.locator(f"{ROOM} h2[data-out=count]").inner_text() == "The 55 sites"
    page.page.keyboard.press("Escape")
    page.page.keyboard.press(".")
    assert page.page.locator(f"{ROOM} tr.on[data-site='0']").count() == 1
    page.page.wait_for_timeout(700)
    assert "Site 1, 48.0°" in page.page.locator("#status").inner_text()
    page.page.keyboard.press("Enter")
    assert link(page)["pin"] == "1"


def test_fields_do_what_the_hand_does(room):
    page = room("sphere", reduced_motion=True)
    form = page.page.locator(f"{ROOM} [data-form=site]")
    form.locator("[name=lat]").fill("12.5")
    form.locator("[name=lon]").fill("40")
    form.locator("button[value=add]").click()
    row = page.page.locator(f"{ROOM} tr[data-site='54']")
    assert re.split(r"\s{2,}|\t", row.inner_text().strip())[1:3] == ["12.5°\u202fN", "40.0°\u202fE"]
    form.locator("[name=lat]").fill("-30")
    form.locator("button[value=move]").click()
    assert "30.0°\u202fS" in row.inner_text()
    form.locator("button[value=remove]").click()
    assert row.count() == 0
    page.page.locator(f"{ROOM} tr[data-site='49'] button").click()
    assert (value(page, "view-lon"), value(page, "view-lat")) == ("96.6", "-7.4")


def test_the_insertion_goes_step_by_step(room):
    page = room("sphere")
    page.page.locator("#step").fill("34")
    assert said(page, "sentence") == (
        "Site 34 sees 4 facets. They make room: their outline has 6 sides, and as many new facets meet at the site."
    )
    assert said(page, "step") == "site 34 of 54"
    before = page.digest(PLANE)
    page.page.locator(f"{ROOM} [data-do=back]").click()
    page.rest()
    assert said(page, "step") == "site 33 of 54"
    assert page.digest(PLANE) != before
    page.page.locator(f"{ROOM} [data-do=next]").click()
    page.rest()
    assert page.digest(PLANE) == before
    assert link(page)["step"] == "34"


@pytest.mark.parametrize(
    ("state", "sentence"),
    [
        ("sites=d", "No sites yet. Click the ball, or open a file."),
        ("sites=dAAA", "All sites lie at one place: its cell is the whole sphere, and there are no triangles."),
        ("sites=dAACA4cLrAAA", "Two sites: each has half of the sphere, and there are no triangles."),
    ],
)
def test_without_triangles_the_sentence_says_so(room, state, sentence):
    page = room(f"v=1&room=sphere&{state}")
    assert said(page, "sentence") == sentence
    assert page.page.locator("#messages").inner_text() == ""
    assert page.ink(BALL) > 0.001


def test_a_link_shows_the_same_pixels(room):
    page = room("sphere")
    x, y = page.middle(BALL)
    page.drag((x + 40, y - 30), (x - 50, y - 10))
    page.page.mouse.click(x + 20, y + 40)
    page.page.mouse.move(1, 1)
    page.page.locator(f"{ROOM} [name=cells]").uncheck()
    page.page.locator("body").click(position={"x": 1, "y": 1})
    page.page.wait_for_timeout(600)
    page.rest()
    again = room(page.link)
    for canvas in (BALL, PLANE):
        assert again.digest(canvas) == page.digest(canvas)


def test_the_ball_is_named_and_seen_from_somewhere(room):
    page = room("v=1&room=sphere&set=hemisphere")
    assert page.page.locator(BALL).get_attribute("aria-label") == "Sphere with 40 sites"
    assert page.page.locator(f"{ROOM} [data-show=closing]").is_visible()
    assert not room("sphere").page.locator(f"{ROOM} [data-show=closing]").is_visible()


def test_what_is_taken_along(room, tmp_path):
    page = room("sphere")
    for kind, ending in (("svg", "svg"), ("png", "png"), ("geojson", "geojson")):
        with page.page.expect_download() as download:
            page.page.locator(f"[data-export={kind}]").click()
        download.value.save_as(tmp_path / f"sphere.{ending}")
    svg = (tmp_path / "sphere.svg").read_text(encoding="utf-8")
    assert svg.count("<path") > 10
    assert len(re.findall(r' d="[^"]*A', svg)) > 3  # true arcs
    features = json.loads((tmp_path / "sphere.geojson").read_text(encoding="utf-8"))["features"]
    kinds = [feature["properties"]["kind"] for feature in features]
    assert (kinds.count("cell"), kinds.count("triangle")) == (54, 104)
    areas = [feature["properties"]["area"] for feature in features if feature["properties"]["kind"] == "cell"]
    assert sum(areas) == pytest.approx(4 * np.pi)


def test_cells_as_geojson_are_those_of_the_library(room, tmp_path):
    shapely = pytest.importorskip("shapely")
    page = room("sphere")
    with page.page.expect_download() as download:
        page.page.locator("[data-export=geojson]").click()
    features = json.loads(download.value.path().read_text(encoding="utf-8"))["features"]
    for kind in ("cell", "triangle"):
        shapes = [shapely.geometry.shape(f["geometry"]) for f in features if f["properties"]["kind"] == kind]
        assert all(shape.is_valid for shape in shapes)
        total = shapely.union_all(shapes)
        assert total.area == pytest.approx(360 * 180, rel=1e-6)
        assert sum(shape.area for shape in shapes) == pytest.approx(360 * 180, rel=1e-6)


def test_the_python_lines_run(room, tmp_path, monkeypatch):
    page = room("sphere")
    page.page.locator(".foot summary").click()
    page.page.wait_for_timeout(100)
    lines = page.page.locator("#python").inner_text()
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(lines, names)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ball.svg", "plane.svg"]
    assert len(names["triangles"]) == 94
    assert (names["triangle"] + 1).tolist() == [7, 22, 41]


def opened(page, file):
    """Open a file of the reader's in the room."""
    page.page.set_input_files(f"{ROOM} input[type=file]", str(file))
    page.page.wait_for_timeout(100)
    page.rest()


@pytest.fixture
def named(room, tmp_path):
    """The room with four sites of a file that names them."""
    file = tmp_path / "towns.csv"
    file.write_text("name,lat,lon\nUlm,48.4,10\nQuito,-0.2,-78.5\n<b>Lagos</b>,6.5,3.4\nPerth,-31.9,115.9\n")
    page = room("sphere")
    opened(page, file)
    return page


def names(page):
    return page.page.locator(f"{ROOM} td.name").all_inner_texts()


def test_names_of_the_readers_sites_stand_in_the_table_and_are_said(named):
    assert names(named) == ["Ulm", "Quito", "<b>Lagos</b>", "Perth"]
    named.page.locator(BALL).press(".")
    named.page.wait_for_timeout(800)
    said_last = named.page.locator("#status").inner_text()
    assert said_last == "Site 1, Ulm, 48.4°\u202fN, 10.0°\u202fE, 3 neighbours"


def test_names_follow_the_hand_and_undo_leads_back_to_the_file(named):
    ball = named.page.locator(BALL)
    for key in (".", "Delete", "n"):  # the first one goes, another one comes
        ball.press(key)
    assert names(named) == ["Quito", "<b>Lagos</b>", "Perth", ""]
    named.page.locator(".foot summary").click()
    named.page.wait_for_timeout(500)
    lines = named.page.locator("#python").inner_text()
    assert "np.array([" in lines  # not the file, which holds other sites
    assert "read_points" not in lines
    for _ in range(2):
        named.page.locator(f"{ROOM} [data-do=undo]").click()
    assert names(named) == ["Ulm", "Quito", "<b>Lagos</b>", "Perth"]
    assert named.page.locator(f"{ROOM} select[name=set] option:checked").inner_text() == "towns.csv"
    named.page.wait_for_timeout(500)
    assert 'read_points("towns.csv")' in named.page.locator("#python").inner_text()


def test_undo_gives_back_the_set_of_the_list(room):
    page = room("sphere")
    page.page.locator(BALL).press("n")
    assert "sites" in link(page)
    page.page.locator(BALL).press("Control+z")
    assert link(page)["set"] == "gap"
    assert page.page.locator(f"{ROOM} [data-do=undo]").is_disabled()


def test_the_bubble_goes_and_comes_with_its_switch(room):
    page = room("sphere")
    shares = []
    for _ in range(3):
        shares.append([is_accent(page.picture(canvas)).mean() for canvas in (BALL, PLANE)])
        page.page.locator(f"{ROOM} [name=bubble]").click()
        page.rest()
    assert max(shares[1]) < 0.001 < min(shares[0])  # what is left is the handle of the pole
    assert shares[2] == shares[0]
    page.page.locator(f"{ROOM} [name=bubble]").click()
    assert said(page, "sentence").startswith("The circle round")


def test_sites_that_lie_close_are_dark(room, tmp_path, rng):
    file = tmp_path / "close.csv"
    near = rng.normal(scale=0.2, size=(80, 2))
    np.savetxt(file, np.vstack([near, [[0, 120], [40, -120], [-40, -120]]]), "%.5f", delimiter=",", header="lat,lon")
    file.write_text(file.read_text().removeprefix("# "))
    page = room("sphere")
    opened(page, file)
    for name in ("triangles", "cells", "bubble", "seeing"):
        page.page.locator(f"{ROOM} [name={name}]").uncheck()
    page.rest()
    picture = page.picture(BALL)
    y, x = (size // 2 for size in picture.shape[:2])
    assert picture[y - 1 : y + 2, x - 1 : x + 2].max() < 90  # rims of paper would be white here


def test_a_failure_is_told_and_the_room_is_drawn_again(visit, page_file):
    page = visit(f"{page_file.as_uri()}#sphere", complaints=["no clip"])
    page.until("document.documentElement.dataset.ready")
    page.rest()
    clip = "CanvasRenderingContext2D.prototype.clip"
    page.page.evaluate(f"window.kept = {clip}; {clip} = () => {{ throw new Error('no clip'); }}; 0")
    page.page.locator(f"{ROOM} [name=cells]").uncheck()
    page.rest()
    message = page.page.locator("#messages")
    assert message.inner_text().startswith("The computation failed and was stopped. Your sites are still here.")
    assert page.page.locator(f"{ROOM}.failed").count() == 1
    page.page.evaluate(f"{clip} = window.kept; 0")
    message.get_by_role("button", name="Draw again").click()
    page.rest()
    assert page.page.locator(f"{ROOM}.failed").count() == 0
    assert message.inner_text() == ""


def test_a_hostile_link_begins_the_room_with_a_message(room):
    first = room("sphere").digest(BALL)
    for state in ("pole-lat=NaN", "sites=d!!!!", "step=999", "view-lon=1e999", "turned=%3Cscript%3E&pole-lat=95"):
        page = room(f"v=1&room=sphere&{state}")
        words = "This link cannot be read, so here is the room as it begins."
        assert page.page.locator("#messages").inner_text().startswith(words)
        assert page.digest(BALL) == first
