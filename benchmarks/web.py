"""The interactive page in Chromium without a graphics card: its size, how soon it is ready, frames a second.

    python -m benchmarks.web

Frames are counted while the globe is turned by the mouse, by a step in each of them, with land for maps of 1 : 50 or
1 : 110 million and the cells of so many sites; where others use the machine, they are fewer. Writes
benchmarks/web.json and the tables of docs/web.md.
"""

from __future__ import annotations

import gzip
import os
import statistics
import tempfile
from pathlib import Path
from typing import Any, Final

import numpy as np
from playwright.sync_api import Browser

from benchmarks import pages
from benchmarks.distributions import uniform_lonlat
from stereodel._arrays import FloatArray
from stereodel.web import web
from stereodel.web.contents import built
from tools.browser import Visit, chromium

SCENES: Final = ((1_000, "50m"), (10_000, "110m"))
"""Sites and land."""

STEPS: Final = 60
"""Of the mouse in a turn."""

MOVE: Final = """({ plate, x, y, steps }) => new Promise((moved) => {
  const canvas = document.querySelector(plate);
  const place = (step) => %s;
  let begin = null;
  let step = 0;
  const move = (now) => {
    begin ??= now;
    if (step === steps) return moved((now - begin) / 1000);
    const [right, down] = place(++step);
    const at = { clientX: x + right, clientY: y + down };
    canvas.dispatchEvent(new PointerEvent("pointermove", { pointerId: 1, pointerType: "mouse", ...at }));
    requestAnimationFrame(move);
  };
  requestAnimationFrame(move);
})"""
"""The seconds of a way of the mouse that is down, a step a frame; a step from outside takes two or three frames."""

TURN: Final = "[120 * Math.sin(2 * Math.PI * step / steps), 60 * Math.sin(4 * Math.PI * step / steps)]"
"""The way, px, that turns a globe, and back."""

DRAG: Final = "[40 * Math.sin(step / 8), 40 * (1 - Math.cos(step / 8))]"
"""That of a site which is dragged, on a circle."""

DRAGGED: Final = 9_000
"""Sites of the room Sphere, of which one is dragged: all are triangulated anew in every step."""

TIMES: Final = 5
"""That the page is opened."""

Row = dict[str, Any]


def sizes() -> list[Row]:
    """Bytes of what is sent: as they are, and packed by gzip."""
    scripts = {"script": "page", "script of files, at first need": "exchange", "script of Lift, at first need": "lift"}
    parts = {"kernel": built("stereodel.wasm"), **{what: built(f"{name}.js") for what, name in scripts.items()}}
    with tempfile.TemporaryDirectory() as folder:
        for resolution in ("110m", "50m"):
            page = web(Path(folder, "page.html"), resolution=resolution)
            parts[f"page with land 1 : {resolution[:-1]} million"] = page.read_bytes()
    return [
        {"what": name, "kB": len(content) / 1000, "gzip kB": len(gzip.compress(content, 9)) / 1000}
        for name, content in parts.items()
    ]


def seconds_until_ready(browser: Browser, page: Path) -> float:
    """From the request to the first drawing, by the page's own clock: the median."""
    found = []
    for _ in range(TIMES):
        visit = Visit(browser, page)
        visit.until("window.readyAt")
        found.append(visit.page.evaluate("readyAt") / 1000)
        visit.close()
    return statistics.median(found)


def frames(browser: Browser, page: Path, room: str, plate: str, way: str, then: str = "true") -> Row:
    """Frames a second while the mouse goes a way, one a step, and the milliseconds for which one keeps the page busy.

    From the middle of a plate of a room; afterwards what is said in JavaScript, as the way is, becomes true.
    """
    visit = Visit(browser, f"{page.as_uri()}#{room}")
    visit.until("document.documentElement.dataset.ready")
    visit.rest(seconds=60)
    x, y = visit.middle(plate)
    visit.page.mouse.move(x, y)
    visit.page.mouse.down()
    busy = visit.busy()
    seconds = visit.page.evaluate(MOVE % way, {"plate": plate, "x": x, "y": y, "steps": STEPS})
    found = {"frames a second": STEPS / seconds, "ms": 1000 * (visit.busy() - busy) / STEPS}
    visit.page.mouse.up()
    visit.until(then)
    visit.close()
    return found


def sites(count: int) -> FloatArray:
    """The first sites of a page."""
    return uniform_lonlat(count, np.random.default_rng(1))


def speed() -> Row:
    """How soon the page is ready, its frames by scene, and while the first site, in the middle, is dragged."""
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        plain = web(Path(folder, "plain.html"), resolution="110m")
        rows = []
        for count, resolution in SCENES:
            page = web(Path(folder, "sites.html"), lonlat=sites(count), name="sites", resolution=resolution)
            turned = frames(browser, page, "globe", "#globe-plate", TURN)
            rows.append({"sites": count, "land": resolution, **turned})
        lonlat = np.vstack([[0, 0], sites(DRAGGED - 1)])
        page = web(Path(folder, "dragged.html"), lonlat=lonlat, name="sites", resolution="110m")
        # In the end the sites are the reader's own: one has moved.
        ball = "v=1&room=sphere&set=given&turned=bubble", "#sphere-ball", DRAG, "location.hash.includes('file=')"
        dragged = {"sites": DRAGGED, **frames(browser, page, *ball)}
        return {"ready, seconds": seconds_until_ready(browser, plain), "scenes": rows, "drag": dragged}


if __name__ == "__main__":
    pages.record("web", {"load": os.getloadavg()[0], "sizes": sizes(), **speed()})
