"""A page made of a table: it opens on the globe, fitted, and says and shows what its owner gave, as pictures do."""

import base64
import io
import json
import re
import zlib
from functools import partial

import numpy as np
import pytest
from PIL import Image

from stereodel import SphericalDelaunay, SphericalVoronoi, angular_distance, lonlat_to_xyz
from stereodel.data import cities
from stereodel.drawing import ColorScale
from stereodel.earth import AUTHALIC_RADIUS_KM, MEAN_RADIUS_KM
from stereodel.globe import Globe as Picture
from stereodel.web import web
from stereodel.web.looks import Looks
from tests.tiers import by_day

from .rooms import barriers, downloaded, link, opened, said, table
from .test_globe_room import Globe

LONLAT = cities().lonlat
LONLAT = LONLAT[(np.abs(LONLAT - (10, 50)) < (5, 4)).all(axis=1)][:60]
NAMES = [f"Town *{k}* & _co_" for k in range(len(LONLAT))]
VALUES = np.round(np.random.default_rng(5).normal(9, 4, len(LONLAT)), 1)
AMOUNTS = np.round(10 ** np.random.default_rng(6).uniform(4, 6, len(LONLAT)))
SCALE = ColorScale.of(VALUES)
GIVEN = {"values": VALUES, "legend": "temperature, °C", "size": AMOUNTS, "size_legend": "people"}


def told(**given):
    """What a page carries of looks."""
    blocks = Looks(**given).blocks(LONLAT, "authalic")
    return json.loads(zlib.decompress(base64.b64decode(blocks["owner"])))


def written(owner):
    """What a legend says."""
    return re.findall(">([^<]+)</text>", owner["legend"])


def test_looks_are_those_of_pictures():
    owner = told(**GIVEN)
    picture = Picture()
    picture.add_points(LONLAT, **GIVEN)
    shades = np.array([re.findall(r"[\d.]+", ink)[:3] for ink in owner["inks"]], dtype=float)[owner["ink"]]
    assert np.abs(shades - 255 * SCALE(VALUES)[:, :3]).max() <= 0.5001
    sizes = picture.legend["people"]
    assert np.abs(np.array(owner["radii"]) * 72 / 96 * 2 - sizes(AMOUNTS)).max() < 0.01
    said = {*picture.legend, *sizes.ticks.values()}
    assert said < {*written(owner)} <= said | {*SCALE.ticks.values()}
    assert owner["columns"] == [["temperature, °C", VALUES.tolist()], ["people", AMOUNTS.tolist()]]
    gaps = np.where(np.arange(len(VALUES)) == 3, np.nan, VALUES)
    owner = told(values=gaps, scale=lambda values: ColorScale.classes(values, "quantiles", 4))
    assert len(owner["inks"]) == 5
    assert "no value" in written(owner)
    assert owner["columns"][0][1][3] is None
    words = np.array(["hill", "coast"] * 30)[: len(VALUES)]
    assert written(told(values=words)) == ["coast", "hill"]
    assert Looks().blocks(LONLAT, "authalic") == {}


@pytest.fixture(scope="module")
def towns(tmp_path_factory):
    """The page of sixty towns."""
    given = {"title": "Sixty towns & more", "source": "Invented", "resolution": "110m", "names": NAMES, **GIVEN}
    return web(tmp_path_factory.mktemp("towns") / "towns.html", lonlat=LONLAT, **given)


@pytest.fixture
def page(towns, room):
    """Open it as a reader does, without a room in the address."""
    return partial(room, file=towns)


def seen_in(page, lonlat):
    """The globe of a page, and where places on its near side are in the window, (n, 2)."""
    globe = Globe(page)
    seen = globe.lens(lonlat_to_xyz(lonlat)) @ globe.view.matrix.T
    assert (seen[:, 2] > 0).all()
    return globe, globe.middle + globe.radius * seen[:, :2] * (1, -1)


def sentence(k):
    """What is said of a town, from the library."""
    diagram = SphericalVoronoi.from_lonlat(LONLAT, latitude="authalic")
    area = diagram.areas(radius=AUTHALIC_RADIUS_KM)[k]
    count = int((diagram.ridge_points == k).sum())
    away = np.radians(angular_distance(diagram.points[k], diagram.points)) * MEAN_RADIUS_KM
    away[k] = np.inf
    amount = f"{AMOUNTS[k]:.0f}" if AMOUNTS[k] < 10_000 else f"{AMOUNTS[k]:,.0f}".replace(",", "\u202f")
    whole = f"{area:.0f}" if area < 10_000 else f"{area:,.0f}".replace(",", "\u202f")
    size = whole if area >= 100 else f"{area:#.3g}"
    name, next_one = (NAMES[j].replace("*", "∗").replace("_", "ˍ") for j in (k, int(np.argmin(away))))
    (lon, lat), far = LONLAT[k], away.min()
    return (
        f"{name}, {lat:.2f}°\u202fN {lon:.2f}°\u202fE, temperature {VALUES[k]:g} °C, people {amount}; "
        f"its cell has {size} km² and {count} neighbours, the nearest is {next_one}, "
        f"{far:.{1 if far < 100 else 0}f} km away."
    )


def test_it_opens_fitted_and_says_everything_of_a_place(page):
    shown = page()
    assert shown.page.title() == shown.page.inner_text("#room-globe h1") == "Sixty towns & more"
    assert said(shown, "globe", "source") == "Invented"
    globe, seen = seen_in(shown, LONLAT)
    away = np.linalg.norm(seen - globe.middle, axis=1) / globe.radius
    assert 0.7 < away.max() < 0.95
    assert shown.page.get_by_role("img", name="temperature, °C: colours, linear from 0").is_visible()
    apart = np.linalg.norm(seen[:, None] - seen, axis=2) + np.where(np.eye(len(seen)), np.inf, 0)
    k = int(np.argmax(apart.min(axis=1)))
    x, y = np.rint(seen[k]).astype(int)
    assert np.abs(shown.picture()[y, x].astype(int) - 255 * SCALE(VALUES[k])[:3]).max() < 30  # shaded toward the limb
    shown.page.mouse.move(*seen[k])
    assert said(shown, "globe", "pointer") == sentence(k).replace("\u2009", "")
    shown.page.mouse.move(5, 5)
    assert said(shown, "globe", "pointer").startswith("At the pointer")
    shown.page.focus("#room-globe .sites tr[data-site='3'] button")
    assert said(shown, "globe", "pointer") == sentence(3)
    shown.page.wait_for_timeout(700)
    assert shown.page.inner_text("#status") == sentence(3)
    assert "people" in shown.page.inner_text("#room-globe .sites thead")


def test_files_and_a_print_of_one_sheet_have_title_legend_and_source_and_no_handle(page, tmp_path):
    import pypdfium2

    shown = page()
    svg = downloaded(shown, "svg")[1].decode()
    assert svg.count('class="spot"') >= len(LONLAT)
    for text in ("Sixty towns &amp; more", "Invented", "temperature, °C", "people"):
        assert f">{text}</text>" in svg
    assert "focus" not in svg
    assert b",people\n" in downloaded(shown, "csv")[1].replace(b"\r", b"")
    height = float(re.search(r'<svg [^>]*height="([\d.]+)"', svg)[1])
    image = Image.open(io.BytesIO(downloaded(shown, "png")[1]))
    assert image.height == pytest.approx(2 * height, abs=1)
    disc = shown.page.locator("#globe-plate").bounding_box()["height"]
    assert height > disc + 100
    foot = np.asarray(image.convert("L"))[int(2 * disc) + 100 :]
    assert (foot < 100).sum() > 500  # letters of the legend and of the source
    shown.page.pdf(path=tmp_path / "towns.pdf")
    with pypdfium2.PdfDocument(tmp_path / "towns.pdf") as document:
        assert len(document) == 1
        text = document[0].get_textpage().get_text_range()
        said = [word in text for word in ("Sixty towns & more", "Invented", "Drag", "Five small", "Magnification")]
        assert said == [True, True, False, False, False]
        sheet = document[0].render(scale=1).to_numpy()
    assert (sheet[140:190, -235:-50].std(axis=2) > 20).mean() > 0.04  # the bar of the legend, on the right


@pytest.mark.parametrize(("width", "height"), by_day([(900, 500), (640, 480), (360, 640)], (640, 480)))
def test_a_frame_has_the_drawing_alone(towns, visit, tmp_path, width, height):
    host = tmp_path / "host.html"
    host.write_text(f'<iframe src="{towns.as_uri()}?frame" width="{width}" height="{height}"></iframe>')
    outer = visit(host)
    frame = outer.page.frames[1]
    frame.wait_for_selector("[data-ready=true]")
    assert frame.inner_text("body").split("\n")[0] == "Sixty towns & more"
    assert "Invented" in frame.inner_text("body")
    assert "Magnification" not in frame.inner_text("body")
    frame_box = outer.page.locator("iframe").bounding_box()
    for part in ("h1 >> visible=true", ".credit", ".legend", "#globe-plate"):
        box = frame.locator(part).bounding_box()
        assert box["y"] >= frame_box["y"]
        assert box["y"] + box["height"] <= frame_box["y"] + height + 3
        assert box["x"] + box["width"] <= frame_box["x"] + width + 3
    assert box["height"] > 0.65 * min(width, height)
    for x, y in np.random.default_rng(2).uniform(0.2, 0.8, (400, 2)):
        outer.page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"])
        if title := frame.get_attribute("#globe-plate", "title"):
            break
    assert title in map(sentence, range(len(LONLAT)))


@pytest.mark.thorough
def test_cells_and_lines_by_value(page):
    shown = page("v=1&room=globe&on=land,fills,north")
    pairs = np.random.default_rng(3).integers(0, len(LONLAT), (500, 2))
    asked = LONLAT[pairs].mean(axis=1)
    seen = seen_in(shown, np.vstack([LONLAT, asked]))[1]
    dots, seen = seen[: len(LONLAT)], seen[len(LONLAT) :]
    radii = np.array(told(**GIVEN)["radii"])
    free = (np.linalg.norm(seen[:, None] - dots, axis=2) - radii).min(axis=1) > 2  # not under a dot
    asked, (x, y) = asked[free], np.rint(seen[free]).astype(int).T
    nearest = SphericalDelaunay.from_lonlat(LONLAT).nearest(lonlat=asked)
    near = (np.abs(shown.picture()[y, x] - 255 * SCALE(VALUES[nearest])[:, :3]).max(axis=1) < 25).sum()
    assert near > 0.9 * len(asked) > 50
    before = shown.digest("#globe-plate")
    shown.page.evaluate("document.querySelector('#room-globe input[name=isolines]').click()")
    shown.rest(still=0.3)
    assert shown.digest("#globe-plate") != before


@pytest.mark.thorough
def test_the_owner_is_silent_about_other_places(page):
    shown = page()
    opened(shown, "globe", table("two.csv", "lon,lat,height\n100,10,5\n101,11,-1234.5\n"))
    assert shown.page.inner_text("#room-globe h1") == "Every angle true, every size your choice"
    assert not shown.page.is_visible(".legend")
    shown.page.hover("#room-globe .sites tr[data-site='1'] td:nth-child(2)")
    assert "Place 2, 11.00°\u202fN 101.00°\u202fE, height −1234.5; its cell has" in said(shown, "globe", "pointer")
    assert said(shown, "globe", "pointer").endswith("1 neighbour, the nearest is Place 1, 156 km away.")
    values = link(shown)
    assert (float(values["focuslon"]), float(values["focuslat"])) == pytest.approx((100.5, 10.5), abs=0.1)


@pytest.mark.thorough
@pytest.mark.parametrize("query", ["", "?frame"])
@pytest.mark.parametrize("colours", ["light", "dark"])
def test_axe_finds_nothing(page, query, colours):
    assert barriers(page(query=query, colours=colours)) == []
