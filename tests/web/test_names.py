"""Names beside dots, none over another, and what is drawn weaker where it is dense."""

import numpy as np
import pytest

from stereodel.web import web

from .conftest import SCRIPT, asking
from .rooms import downloaded, opened, table

ask = asking(f"""
const context = {{ measureText: (text) => ({{ width: 6 * text.length }}) }};
globalThis.document = {{ createElement: () => ({{ append() {{}}, getContext: () => context }}) }};
const {{ drawNames, Seats }} = await import("{SCRIPT}/drawing/names.ts");
const {{ Pen }} = await import("{SCRIPT}/drawing/pen.ts");
""")

R, SIZE = 300.0, 13
STYLE = f"{{ ink: 'ink', halo: 'halo', size: {SIZE} }}"


def frames(node, names, turned, moving):
    """What stands where, frame by frame: {name: (x, y)} of the baseline's left end."""
    shown = ask(
        node,
        f"""(() => {{
          const [standing, disc] = [new Map(), {{ x: {R}, y: {R}, r: {R} }}];
          return given.turned.map((images, at) => {{
            const labels = {{}};
            const label = (text, x, y) => {{ if (text in labels) throw new Error("twice"); labels[text] = [x, y]; }};
            const pen = {{ width: {2 * R}, height: {2 * R}, label }};
            const named = {{ names: given.names, standing, isMoving: given.moving[at] }};
            drawNames(new Seats(pen, disc), named, images, {STYLE});
            return labels;
          }});
        }})()""",
        {"names": names, "turned": [points.ravel().tolist() for points in turned], "moving": moving},
    )
    return [{name: np.array(place) for name, place in labels.items()} for labels in shown]


def test_names_never_collide_stay_in_the_disc_and_keep_their_sides_while_the_globe_turns(node, rng):
    points = rng.normal(size=(300, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    names = [f"Place {k}" for k in range(300)]
    turns = np.radians(np.append(np.arange(0, 12, 0.5), 11.5))
    turned = [points @ np.array([(np.cos(t), 0, -np.sin(t)), (0, 1, 0), (np.sin(t), 0, np.cos(t))]) for t in turns]
    *moving, rest = shown = frames(node, names, turned, [False] + [True] * (len(turns) - 2) + [False])
    same = []
    dots = [points[:, :2] * (R, -R) + R for points in turned]
    for labels, places, images in zip(shown, dots, turned, strict=True):
        low = np.array([place + (0, -0.7 * SIZE) for place in labels.values()])
        high = np.array([place + (6 * len(name), 0.22 * SIZE) for name, place in labels.items()])
        meet = ((low[:, None] < high) & (low < high[:, None])).all(axis=-1)
        assert meet.sum() == len(labels) > 20  # each one meets itself
        assert np.hypot(*np.maximum(R - low, high - R).T).max() <= R
        seen = places[images[:, 2] > 0.2]
        assert not ((low[:, None] < seen) & (seen < high[:, None])).all(axis=-1).any()  # no dot is covered
    for before, after, was, now in zip(moving, moving[1:], dots, dots[1:], strict=False):
        for name in before.keys() & after.keys():
            k = int(name.split()[1])
            same.append(np.allclose(before[name] - was[k], after[name] - now[k]))
    assert np.mean(same) > 50 / 51
    assert next(iter(rest)) == min(rest, key=lambda name: int(name.split()[1]))
    (fresh,) = frames(node, names, turned[-1:], [False])
    assert {name: tuple(at) for name, at in fresh.items()} == {name: tuple(at) for name, at in rest.items()}


def test_lines_and_dots_are_weaker_only_where_they_are_dense(node):
    expression = """(() => {
      const each = (visit) => {
        for (let x = 0; x < 600; x += x < 300 ? 2.5 : 60) {
          for (let y = 0; y < 300; y += x < 300 ? 2.5 : 60) visit(x > 299 ? x + 55 : x, y);
        }
      };
      const [found, dots] = [[], []];
      class Found extends Pen {
        path(_, trace, ink, { width, strokeOpacity }) {
          const count = [[0, 0], [0, 0]];
          trace({ moveTo: (x) => ++count[0][x < 300 ? 0 : 1], lineTo: (x) => ++count[1][x < 302 ? 0 : 1] });
          found.push([width * strokeOpacity / 1.1, ...count]);
        }
        discs(_, { radius, opacity }, places) { dots.push([(radius / 2.2) ** 2 * opacity, places.length / 2]); }
      }
      const pen = new Found(600, 300, {}, 1);
      const [ends, places] = [[], []];
      each((x, y) => { ends.push(x, y, x + 2, y); places.push(x, y); });
      pen.lines("delaunay", ends);
      pen.dots("site", places);
      return { found, dots };
    })()"""
    answer = ask(node, expression)
    counts = np.array([count for _, count, _ in answer["found"]])
    assert [count for _, count, _ in answer["found"]] == [count for *_, count in answer["found"]]
    assert counts.sum(axis=0).tolist() == [120 * 120, 5 * 5]  # none is lost
    strengths = np.array([strength for strength, *_ in answer["found"]])
    ink = strengths @ counts * (2 * 1.1) / (300 * 300)
    assert 0.05 < ink[0] < 0.2
    assert (strengths[counts[:, 1] > 0] == 1).all()
    ink = sum(part * number for part, number in answer["dots"]) * 15 / (300 * 300)
    assert 0.03 < ink < 0.1
    assert answer["dots"][-1] == [1, 25]


def test_names_are_drawn_taken_along_and_switched_off(room):
    towns = "name,lon,lat\nOslo,10.8,59.9\n*Lagos*,3.4,6.5\nPerth,115.9,-31.9\n<i>Rome,12.5,41.9\n"
    page = room("globe")
    switch = page.page.locator("#room-globe [name=names]")
    assert not switch.is_visible()
    opened(page, "globe", table("towns.csv", towns))
    page.page.click("#room-globe button[value=figure-10]")  # seen from 40° N 0° E, with Perth behind
    page.rest()
    svg = downloaded(page, "svg")[1].decode()
    assert [name in svg for name in ("Oslo<", ">∗Lagos∗<", "Perth", "&lt;i&gt;Rome<")] == [True, True, False, True]
    before = page.digest("#globe-plate")
    switch.uncheck()
    page.rest()
    assert page.digest("#globe-plate") != before
    assert "Oslo<" not in downloaded(page, "svg")[1].decode()


@pytest.mark.thorough
@pytest.mark.parametrize("count", [1000, 9000, 30_000])
@pytest.mark.parametrize("drawing", ["sphere-ball", "sphere-plane", "globe-plate"])
def test_no_number_of_sites_makes_a_picture_black(room, rng, tmp_path, count, drawing):
    lonlat = np.stack([rng.uniform(-180, 180, count), np.degrees(np.arcsin(rng.uniform(-1, 1, count)))], axis=1)
    page = room(drawing.split("-")[0], file=web(tmp_path / "many.html", lonlat=lonlat, resolution="110m"))
    page.rest(seconds=30)
    pixels = page.picture(f"#{drawing}").mean(axis=2)
    side = len(pixels) // 20
    tiles = pixels[: 20 * side, : 20 * side].reshape(20, side, 20, side).mean(axis=(1, 3))
    assert 60 < tiles.min() < 235
    assert tiles.mean() > 150
