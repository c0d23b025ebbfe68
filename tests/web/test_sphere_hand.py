"""The hand on the Sphere: a site that is dragged is drawn where it was and where it is, and nowhere else; the lens."""

import numpy as np
import pytest
from playwright.sync_api import expect

from stereodel import fisheye, lonlat_to_xyz
from stereodel.drawing import View

from .rooms import link, said

BALL = "#sphere-ball"
PLANE = "#sphere-plane"


def differing(a, b):
    """The share of pixels that differ by more than an eye sees."""
    return float((np.abs(a.astype(int) - b).max(axis=-1) > 24).mean())


def values_of(lonlat):
    """A link with sites."""
    return f"v=1&room=sphere&sites={','.join(f'{value:.9f}' for value in np.ravel(lonlat))}"


def crowd(rng):
    """Three hundred sites all over the sphere, the first one in the middle of the view."""
    return np.vstack([[0, 0], rng.uniform((-180, -80), (180, 80), size=(300, 2))])


def city(rng):
    """Sixty sites within 100 m, and the first one in their middle."""
    around = rng.uniform(-1, 1, size=(30, 2))
    return np.array([10, 48.4]) + np.vstack([[0, 0], around, -around]) * [68e-5, 45e-5]


@pytest.mark.parametrize("sites", [crowd, pytest.param(city, marks=pytest.mark.thorough)])
def test_a_dragged_site_is_drawn_as_a_fresh_page_draws_it(room, rng, sites):
    page = room(values_of(sites(rng)))
    x, y = page.middle(BALL)
    before = page.picture(BALL)
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x + 90, y - 50, steps=9)
    page.rest()
    held, sentence = [page.picture(drawing) for drawing in (BALL, PLANE)], said(page, "sphere", "sentence")
    assert differing(before, held[0]) > 0.005
    assert "Other sites inside, counted exactly: 0\u00a0and\u00a00." in sentence
    page.page.mouse.up()
    page.rest()
    # While the hand holds it, only its surroundings are drawn anew, and the plane keeps its frame.
    at_rest = [page.picture(drawing) for drawing in (BALL, PLANE)]
    assert max(map(differing, held, at_rest[:1] if sites is city else at_rest)) < 0.003
    page.page.mouse.move(1, 1)
    link(page)
    again = room(page.link)
    assert said(again, "sphere", "sentence") == said(page, "sphere", "sentence") == sentence
    assert [again.digest(drawing) for drawing in (BALL, PLANE)] == [page.digest(drawing) for drawing in (BALL, PLANE)]


def ring(lat):
    return "sites=" + ",".join(f"{lon},{lat}" for lon in range(0, 360, 30))


HATCHED, CELLS = "Hatched is where the facets go that see P.", "Cells differ: centres are not sent to centres."
TRIANGLES, THIN = "Delaunay triangles.", "Voronoi cells in thin lines."
SAID = {
    "sites=": {"sentence": "No sites yet. Click the ball, or open a file."},
    "sites=0,0": {"sentence": "All sites lie at one place: its cell is the whole sphere, and there are no triangles."},
    "sites=0,0,90,0": {"sentence": "All sites lie on one great circle: there are no triangles."},
    ring(0): {"sentence": "All sites lie on one great circle: there are no triangles."},
    ring(30): {"sum": "20 facets on the sphere = 10 triangles in the plane + 10 facets that see\u00a0P"},
    "on=triangles,seeing": {"on-ball": TRIANGLES, "in-plane": f"The same triangles. {HATCHED}"},
    "on=triangles,cells,seeing": {
        "on-ball": f"{TRIANGLES} {THIN}",
        "in-plane": f"The same triangles. {CELLS} {HATCHED}",
    },
    "on=cells": {"on-ball": THIN, "in-plane": CELLS},
    "on=cells&step=34": {"on-ball": f"{TRIANGLES} New ones are dashed.", "in-plane": "The same triangles."},
    "on=cells&sites=0,0": {"on-ball": "", "in-plane": ""},
}
"""Sentences and captions."""


def test_what_is_said_follows_what_is_drawn(room):
    page = room("sphere")
    for state, outputs in SAID.items():
        page.page.evaluate("(state) => void (location.hash = state)", f"v=1&room=sphere&{state}")
        for output, words in outputs.items():
            expect(page.page.locator(f"#room-sphere [data-out={output}]")).to_have_text(words)
        assert page.page.locator("#messages").inner_text() == ""
        assert "on=" in state or page.ink(BALL) > 0.001


@pytest.mark.thorough
def test_the_wheel_magnifies_about_the_pointer(room):
    page = room("sphere")
    x, y = page.middle(BALL)
    right, down = int(x + 60) - x, int(y - 40) - y  # at a whole pixel, as clicks are
    page.page.mouse.click(x + right, y + down)
    before = link(page)
    for _ in range(4):
        page.page.mouse.wheel(0, -250)
    page.rest()
    names = ["view-lon", "view-lat", "focus-lon", "focus-lat", "s"]
    state = {name: float(value) for name, value in link(page).items() if name in names}
    assert state["s"] == pytest.approx(np.exp(2), rel=1e-6)
    lens = fisheye((state["focus-lon"], state["focus-lat"]), magnification=state["s"])
    aim = lonlat_to_xyz([float(before["aim-lon"]), float(before["aim-lat"])])
    radius = page.page.locator(BALL).bounding_box()["width"] / 2 - 7
    seen = View(state["view-lon"], state["view-lat"]).matrix @ lens(aim)
    np.testing.assert_allclose(radius * seen[:2], [right, -down], atol=0.5)
    assert "Magnified 7.39 times at" in page.page.inner_text("#sphere-desc")
    page.page.locator(BALL).press("0")
    page.rest()
    assert "Magnified" not in page.page.inner_text("#sphere-desc")


def test_sites_of_a_city_fill_both_pictures(room, rng):
    page = room(values_of(city(rng)))
    for drawing in (BALL, PLANE):
        assert page.ink(drawing) > 0.1
    x, y = page.middle(PLANE)
    page.page.mouse.move(x + 20, y + 9)
    page.rest()
    assert 5e4 < float(link(page)["s"]) < 2e5
    sentence = said(page, "sphere", "sentence")
    assert "Other sites inside, counted exactly: 0\u00a0and\u00a00." in sentence
    degrees = float(sentence.split("the radius ")[1].split("°")[0])
    assert 1e-5 < degrees < 5e-4
