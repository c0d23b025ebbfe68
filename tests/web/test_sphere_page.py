"""The Sphere room in a browser: what the hand, the keys and the fields do, what is drawn and said of it."""

import numpy as np
import pytest

from stereodel import SphericalDelaunay, lonlat_to_xyz
from stereodel.triangulation import planar_part
from stereodel.web.contents import scattered

from .rooms import link, opened, python_lines, said, table

pytestmark = pytest.mark.thorough  # what is asked once of each room by day stands in test_page.py


ROOM = "#room-sphere"
BALL = "#sphere-ball"
PLANE = "#sphere-plane"


def output(page, name):
    return said(page, "sphere", name)


def value(page, name):
    return page.page.locator(f"{ROOM} [name={name}]").input_value()


def test_the_bubble_follows_the_pointer_until_a_click_keeps_it(room):
    page = room("sphere")
    x, y = page.middle(BALL)
    shown = [(page.digest(BALL), page.digest(PLANE), output(page, "sentence"))]
    for at in ((x + 60, y + 60), page.middle(PLANE)):
        page.page.mouse.move(*at)
        page.rest()
        shown.append((page.digest(BALL), page.digest(PLANE), output(page, "sentence")))
    assert [len(set(each)) for each in zip(*shown, strict=True)] == [3, 3, 3]
    assert output(page, "sentence").endswith("Other sites inside, counted exactly: 0\u00a0and\u00a00.")

    page.page.mouse.click(x + 60, y + 60)
    kept = output(page, "sentence")
    page.page.mouse.move(x - 100, y)
    assert output(page, "sentence") == kept
    assert link(page)["pin"] == "1"
    page.page.locator(BALL).press("Escape")
    page.page.mouse.move(x - 101, y)
    page.rest()
    assert output(page, "sentence") != kept


def test_the_pole_is_dragged_over_the_limb(room):
    page = room("sphere")
    x, y = page.middle(BALL)
    radius = page.page.locator(BALL).bounding_box()["width"] / 2 - 7
    direction = lonlat_to_xyz([-150.0, 53.1])
    assert "lies behind" in page.page.inner_text("#sphere-desc")
    page.page.mouse.move(x + radius * direction[1], y - radius * direction[2])  # seen from 0° N, 0° E
    page.page.mouse.down()
    page.page.mouse.move(x - 0.5 * radius, y - 1.02 * radius, steps=6)
    page.page.mouse.move(x - 40, y - 60, steps=6)
    page.page.mouse.up()
    page.rest()
    assert "lies in front" in page.page.inner_text("#sphere-desc")
    front = lonlat_to_xyz([float(link(page)[f"pole-{axis}"]) for axis in ("lon", "lat")])
    np.testing.assert_allclose(radius * front[1:], [-40, 60], atol=1)
    planar = len(planar_part(SphericalDelaunay.from_lonlat(scattered()["gap"]), front))
    assert output(page, "sum").startswith(
        f"104 facets on the sphere = {planar} triangles in the plane + {104 - planar} "
    )
    page.page.fill(f"{ROOM} [name=pole-lat]", "-20")
    page.rest()
    assert link(page)["pole-lat"] == "-20"


def test_sites_are_added_moved_removed_and_undone(room):
    page = room("sphere")
    x, y = page.middle(BALL)
    page.page.check(f"{ROOM} [name=click][value=add]")
    page.page.mouse.click(x + 33, y + 7)
    assert output(page, "count") == "The 55 sites"
    page.drag((x + 33, y + 7), (x + 60, y + 40))
    page.rest()
    assert output(page, "sum").startswith("106 facets")
    assert len(link(page)["sites"].split(",")) == 2 * 55
    page.page.check(f"{ROOM} [name=click][value=remove]")
    page.page.mouse.click(x + 60, y + 40)
    assert output(page, "count") == "The 54 sites"
    for _ in range(3):
        page.page.click(f"{ROOM} [data-do=undo]")
    assert page.page.is_disabled(f"{ROOM} [data-do=undo]")
    assert link(page)["set"] == "gap"
    assert output(page, "sum") == "104 facets on the sphere = 94 triangles in the plane + 10 facets that see\u00a0P"


def test_keys_alone_reach_everything(room):
    page = room("sphere", reduced_motion=True)
    page.page.focus(BALL)
    for key in ("ArrowRight", "ArrowUp", "Shift+ArrowUp"):
        page.page.keyboard.press(key)
    assert (value(page, "view-lon"), value(page, "view-lat")) == ("5.0", "6.0")
    page.page.keyboard.press("0")
    assert value(page, "view-lon") == "0.0"
    page.page.keyboard.press("n")
    assert output(page, "count") == "The 55 sites"
    page.page.keyboard.press("Control+ArrowRight")
    assert "5.0°\u202fE" in page.page.locator(f"{ROOM} tr[data-site='54']").inner_text()
    page.page.keyboard.press("Delete")
    assert output(page, "count") == "The 54 sites"
    page.page.keyboard.press("Control+z")
    assert output(page, "count") == "The 55 sites"
    page.page.keyboard.press("Meta+z")  # of a Mac
    page.page.keyboard.press("Meta+z")
    assert output(page, "count") == "The 54 sites"
    page.page.keyboard.press("Escape")
    page.page.keyboard.press(".")
    assert page.page.locator(f"{ROOM} tr.on[data-site='0']").count() == 1
    page.page.wait_for_timeout(700)
    assert "Site 1, 48.0°" in page.page.locator("#status").inner_text()
    page.page.keyboard.press("Enter")
    assert link(page)["pin"] == "1"


def test_fields_do_what_the_hand_does(room):
    page = room("sphere", reduced_motion=True)
    row, form = page.page.locator(f"{ROOM} tr[data-site='54']"), f"{ROOM} [data-form=site]"
    page.page.fill(f"{form} [name=lon]", "40")
    for do, lat, words in [("add", "12.5", "12.5°\u202fN"), ("move", "-30", "30.0°\u202fS"), ("remove", "0", "")]:
        page.page.fill(f"{form} [name=lat]", lat)
        page.page.click(f"{form} button[value={do}]")
        assert row.count() == (do != "remove")
        assert words in " ".join(row.all_inner_texts())
    page.page.click(f"{ROOM} tr[data-site='49'] button")
    assert (value(page, "view-lon"), value(page, "view-lat")) == ("96.6", "-7.4")


def test_the_insertion_goes_step_by_step(room):
    page = room("sphere")
    page.page.fill("#step", "34")
    words = "Site 34 sees 4 facets. They make room: their outline has 6 sides, and as many new facets meet at the site."
    assert output(page, "sentence") == words
    before = page.digest(PLANE)
    for do, site in (("back", 33), ("next", 34)):
        page.page.click(f"{ROOM} [data-do={do}]")
        page.rest()
        assert output(page, "step") == f"site {site} of 54"
        assert (page.digest(PLANE) == before) == (site == 34)
    assert link(page)["step"] == "34"


def test_names_stand_in_the_table_are_said_and_follow_the_hand_and_undo(room):
    towns = "name,lat,lon\nUlm,48.4,10\nQuito,-0.2,-78.5\n<b>Lagos</b>,6.5,3.4\nPerth,-31.9,115.9\n"
    page, names = room("sphere"), ["Ulm", "Quito", "<b>Lagos</b>", "Perth"]
    opened(page, "sphere", table("towns.csv", towns))
    shown = page.page.locator(f"{ROOM} td.name")
    page.page.press(BALL, ".")
    page.page.wait_for_timeout(800)
    assert page.page.inner_text("#status") == "Site 1, Ulm, 48.4°\u202fN, 10.0°\u202fE, 3 neighbours"
    for key in ("Delete", "n"):  # the first one goes, another one comes
        page.page.press(BALL, key)
    assert shown.all_inner_texts() == [*names[1:], ""]
    lines = python_lines(page)
    assert "np.array([" in lines  # not the file, which holds other sites
    assert "read_points" not in lines
    for _ in range(2):
        page.page.click(f"{ROOM} [data-do=undo]")
    assert shown.all_inner_texts() == names
    assert page.page.inner_text(f"{ROOM} select[name=set] option:checked") == "towns.csv"
