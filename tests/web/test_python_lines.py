"""The lines of Python that the page shows run as they stand, without a file, and draw the picture that is seen.

Both are compared without type, by the means of blocks of 64 pixels."""

import base64
import io
import re

import numpy as np
import pytest
from PIL import Image

from stereodel.drawing.page.labels import title_height
from stereodel.web import web

from .rooms import DRAWINGS, downloaded, opened, python_lines, table
from .test_owner import GIVEN, LONLAT, NAMES

BLOCK, LEVELS = 64, 6.0
"""Pixels; levels of 255."""

BARE = """for (const kind of ["fillText", "strokeText"]) CanvasRenderingContext2D.prototype[kind] = () => {}; 0"""

CAPS = "lens=bubble&fromlon=100&fromlat=-20&fromradius=150&tolon=0&tolat=0&toradius=30&beforelon=60&afterlon=30"
SITES = "2,48,10,50,-3,40,100,-20,-70,-30,20,89"
STATES = {
    "sphere": [
        "",
        "set=cities&pin=1&pole-lon=20&pole-lat=-30&view-lon=60&view-lat=40&on=bubble,seeing,closing",
        "set=everywhere&view-lon=120&view-lat=-30&on=cells",
        "set=hemisphere&view-lon=100&view-lat=20&on=seeing,closing",
        "set=hemisphere&view-lon=100&on=closing,triangles",
        "set=airports&pole-lon=0&pole-lat=90&on=seeing",
        "set=stars&pole-lon=0&pole-lat=-90&view-lon=-90&view-lat=60&on=seeing",
        "set=dodecahedron&pin=1&aim-lon=-140&aim-lat=50&view-lon=-120&view-lat=30&on=bubble,triangles,seeing",
        "set=dodecahedron&pin=1&aim-lon=-150&aim-lat=53.1",
        "s=6&focus-lon=20&focus-lat=10&view-lon=20&view-lat=10&pin=1&on=triangles,cells,bubble,seeing,closing",
        "sites=10,50,10.01,50,10.005,50.01,10.02,50.02,10.01,49.99&on=triangles,cells",
        "step=20",
        "step=5&set=dodecahedron&view-lat=-60",
        "step=2",
        "sites=",
        "sites=10,20",
        "sites=20,-30,10,20,120,0,-110,10,-160,-50,60,70&pole-lon=20&pole-lat=-30&on=triangles,cells,seeing",
        "sites=20,-30,10,20,60,0,-50,10,0,80&pole-lon=20&pole-lat=-30&on=triangles,cells,seeing",
        "sites=-15,35,-55,75,50,-45,70,-55,40,55&pole-lon=55&pole-lat=50&view-lon=20&view-lat=30&on=triangles,seeing",
        "sites=0,0,180,0&on=cells",
        "sites=10,20,60,0,20,-30,10,20,-50,10&on=triangles,cells,seeing",
        "sites=0,0,40,0,80,0,120,0,-160,0,-90,0&on=triangles,cells",
        "sites=0,0,40,50,80,0,120,10,-150,50,-90,0&on=triangles,cells,bubble,seeing,closing",
    ],
    "lift": [
        "on=triangles,cells,rays,seeing",
        "",
        "bend=0&height=90&side=0",
        "bend=0&height=30&side=40&set=flat&on=triangles,cells,seeing",
        "bend=20&on=triangles,cells,seeing",
        "bend=45&set=grid&height=0&on=cells",
        "bend=76&height=10&p=3&q=3",
        "height=90&side=123&on=seeing",
        "sites=1,2,4,2,6,5&bend=60",
        "sites=1,2,4,2,6,2",
        "sites=1,2",
        "sites=",
    ],
    "globe": [
        f"s=4&focuslon=0&focuslat=40&viewlon=0&viewlat=40&pointerlon=10&pointerlat=42&sites={SITES}&on=cells,land",
        "lens=bubble&pointerlon=12&pointerlat=50",
        "",
        "s=1&viewroll=30",
        "s=20&focuslon=0&focuslat=-90&viewlon=0&viewlat=-60&on=graticule",
        "viewlon=-170&viewlat=-40&on=land,graticule,tissot",
        f"{CAPS}&on=land,tissot",
        f"{CAPS}&on=land,cells,graticule&sites={SITES}",
    ],
}


def states():
    """Rooms and what their links say; each day the first of every room."""
    for room, values in STATES.items():
        for number, value in enumerate(values):
            marks = () if number < 1 else pytest.mark.thorough
            yield pytest.param(room, value, marks=marks, id=f"{room}-{number}")


def seen(page, room):
    """What a room shows, without type: the picture that it gives away, or both globes of a bubble beside each other."""
    page.page.evaluate(BARE)
    page.page.click("input[name=colours][value=light]", force=True)
    page.rest(still=0.3)
    if "lens=bubble" not in page.link:
        page.page.fill("input[name=png-scale]", "1")
        with Image.open(io.BytesIO(downloaded(page, "png")[1])) as image:
            return [np.asarray(image.convert("RGB"), dtype=float)]
    return [globe(page, which) for which in ("before", "after")]


def globe(page, which):
    """One of the globes, on paper."""
    data = page.page.locator(f"#globe-{which}").evaluate("canvas => canvas.toDataURL()").split(",")[1]
    with Image.open(io.BytesIO(base64.b64decode(data))) as image:
        ground = Image.new("RGBA", image.size, (0xFD, 0xFC, 0xFA, 255))
        ground.alpha_composite(image.convert("RGBA"))
    return np.asarray(ground.convert("RGB"), dtype=float)


def drawn(visit, lines, room, folder, monkeypatch):
    """The picture that lines draw in a folder, without type, of a pixel a point."""
    monkeypatch.chdir(folder)
    exec(compile(lines, f"{room}.py", "exec"), {"__name__": "__main__"})
    text = (folder / f"{room}.svg").read_text(encoding="utf-8")
    text = re.sub(r'="([\d.]+)pt"', r'="\1px"', text, count=2)
    bare = folder / "bare.svg"
    bare.write_text(text.replace("</svg>", "<style>[id^=label]{display:none}</style></svg>"), encoding="utf-8")
    size = (float(re.search(f'<svg[^>]*? {side}="([\\d.]+)px"', text)[1]) for side in ("width", "height"))
    width, height = (int(np.ceil(each)) for each in size)
    return visit(bare, width=width, height=height).picture().astype(float)


def middle(pixels, shape):
    """The middle of a picture, of the size of another one: paper round it, or without its margin."""
    wide = np.pad(pixels, [(BLOCK, BLOCK), (BLOCK, BLOCK), (0, 0)], mode="edge")
    top, left = (round((own - other) / 2) for own, other in zip(wide.shape[:2], shape[:2], strict=True))
    return wide[top : top + shape[0], left : left + shape[1]]


def blocks(pixels):
    """Means of blocks, those at the right and the lower edge with their last pixels again and again."""
    more = [(0, -size % BLOCK) for size in pixels.shape[:2]]
    whole = np.pad(pixels, [*more, (0, 0)], mode="edge")
    return whole.reshape(whole.shape[0] // BLOCK, BLOCK, -1, BLOCK, 3).mean(axis=(1, 3))


def compare(page, visit, room, folder, monkeypatch):
    """Assert that the lines of a page draw what it shows."""
    pictures = seen(page, room)
    made = drawn(visit, python_lines(page), room, folder, monkeypatch)
    for number, picture in enumerate(pictures):
        part = made[:, made.shape[1] * number // len(pictures) : made.shape[1] * (number + 1) // len(pictures)]
        close(middle(part, picture.shape), picture)


def close(part, picture):
    """Assert that two pictures are alike, and not empty."""
    assert part.shape == picture.shape
    assert np.ptp(blocks(picture)) > 10
    assert np.abs(blocks(part) - blocks(picture)).max() < LEVELS


@pytest.mark.parametrize(("name", "values"), list(states()))
def test_the_lines_of_python_draw_the_picture(room, visit, tmp_path, monkeypatch, name, values):
    page = room(f"v=1&room={name}&{values}".rstrip("&"))
    assert page.page.locator("[role=alert]").count() == 0
    compare(page, visit, name, tmp_path, monkeypatch)


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.thorough) for name in DRAWINGS])
def test_many_places_come_from_the_table_that_the_page_exports(room, visit, tmp_path, monkeypatch, rng, name):
    rows = np.round(rng.uniform([-180, -85], [180, 85], size=(300, 2)), 3)
    lines = ["x,y" if name == "lift" else "lon,lat", *(f"{x},{y}" for x, y in rows.tolist())]
    page = room(f"v=1&room={name}")
    opened(page, name, table("places.csv", "\n".join(lines)))
    file, content = downloaded(page, "csv")
    lines = python_lines(page)
    named = re.search(r'"([^"]*\.csv)".*  # the page draws over 1000 lines weaker', lines)[1]
    assert named in (file, "places.csv")
    (tmp_path / named).write_bytes(content)
    page.page.click(".foot summary")
    compare(page, visit, name, tmp_path, monkeypatch)


@pytest.mark.parametrize(
    ("layers", "title", "given"),
    [
        ("land,cells,names", "Sixty towns", GIVEN),
        pytest.param("land,fills,isolines", "Sixty towns", GIVEN, marks=pytest.mark.thorough),
        pytest.param("land,fills", "", {"values": ["hill", "coast"] * 30, "size": 9}, marks=pytest.mark.thorough),
        pytest.param("land,fills", "", {"size": GIVEN["size"], "color": "teal"}, marks=pytest.mark.thorough),
    ],
)
def test_the_lines_of_an_owner_draw_values_below_a_title(room, visit, tmp_path, monkeypatch, layers, title, given):
    file = tmp_path / "towns.html"
    web(file, lonlat=LONLAT, names=NAMES, name="towns.csv", title=title, resolution="110m", **given)
    page = room(f"v=1&room=globe&on={layers}", file=file)
    (tmp_path / "towns.csv").write_bytes(downloaded(page, "csv")[1])
    [picture] = seen(page, "globe")
    lines = python_lines(page)
    assert "legend=True" in lines
    made = drawn(visit, lines, "globe", tmp_path, monkeypatch)[round(title_height(title)) :]
    picture = picture[36 * bool(title) :][: round(page.page.locator("#globe-plate").bounding_box()["height"])]
    close(middle(made[: made.shape[1]], picture.shape), picture)
