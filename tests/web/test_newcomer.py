"""Five tasks of somebody who has a table and has not read the documentation, each in at most three actions."""

import re

import numpy as np
import pytest

from stereodel import SphericalVoronoi
from stereodel.earth import AUTHALIC_RADIUS_KM
from stereodel.web import web

from .rooms import CANNOT_BE_READ, downloaded, pixels, said

rng = np.random.default_rng(12)
LONLAT = np.column_stack([rng.uniform(5, 15, 40), rng.uniform(45, 54, 40)]).round(4)
NAMES = [f"Town {k}" for k in range(40)]


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    path = tmp_path_factory.mktemp("newcomer") / "towns.csv"
    rows = (f"{name},{lon},{lat}\n" for name, (lon, lat) in zip(NAMES, LONLAT, strict=True))
    path.write_text("name,lon,lat\n" + "".join(rows))
    return path


@pytest.fixture(scope="module")
def file(table):
    """The page that `stereodel web towns.csv` makes."""
    file = table.with_suffix(".html")
    return web(file, lonlat=LONLAT, names=NAMES, name=table.name, resolution="110m")


def test_open_my_table(room, table):
    page = room("")
    page.page.set_input_files("input[type=file]:visible", str(table))  # one: the button with the file
    page.until("document.querySelector('.room:not([hidden]) tbody')?.textContent.includes('Town 3')")
    assert "40" in page.page.locator("[data-out=count]:visible, [data-out=places]:visible").inner_text()


def test_find_the_cell_of_a_place_and_magnify_it(room, file):
    towns = room(file=file)
    towns.page.click("#room-globe tbody tr[data-site='7'] button")  # one: its row
    towns.rest()
    area = SphericalVoronoi.from_lonlat(LONLAT, latitude="authalic").areas(radius=AUTHALIC_RADIUS_KM)[7]
    sentence = said(towns, "globe", "pointer")
    numbers = [float(text.replace("\u202f", "")) for text in re.findall(r"\d[\d\u202f]*(?:\.\d+)?", sentence)]
    assert "Town 7" in sentence
    assert min(abs(number / area - 1) for number in numbers if number > 0) < 1e-3

    # Its row has brought it to the middle.
    before = float(said(towns, "globe", "mag"))
    towns.page.locator("#globe-plate").scroll_into_view_if_needed()
    x, y = towns.middle("#globe-plate")
    towns.page.mouse.dblclick(x, y)  # the focus there
    towns.rest()
    towns.page.mouse.wheel(0, -300)  # and the wheel
    towns.rest()
    assert float(said(towns, "globe", "mag")) > 1.5 * before
    lon, lat = (float(towns.page.input_value(f"#room-globe input[name=focus-{axis}]")) for axis in ("lon", "lat"))
    assert np.hypot(lon - LONLAT[7, 0], lat - LONLAT[7, 1]) < 0.2


def test_send_it_to_a_friend_and_get_it_into_a_paper(room, visit, file):
    towns = room(file=file)
    towns.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    towns.page.click("[data-export=link]")  # one
    towns.page.wait_for_timeout(200)
    address = towns.page.evaluate("navigator.clipboard.readText()")
    friend = visit(address)
    friend.until("document.documentElement.dataset.ready")
    friend.rest()
    assert CANNOT_BE_READ not in friend.page.locator("#messages").inner_text()
    assert pixels(friend, "globe") == pixels(towns, "globe")

    name, svg = downloaded(towns, "svg")  # one
    assert name.endswith(".svg")
    assert svg.count(b"Town ") > 3
