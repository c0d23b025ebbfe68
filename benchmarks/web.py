"""The interactive page in Chromium without a graphics card: its size, how soon it is ready, what a frame takes.

    python -m benchmarks.web

Frames are timed while the globe is turned by the mouse, by a step in each of them, with land for maps of 1 : 50 or
1 : 110 million and so many sites; where others use the machine, they take longer. Writes
benchmarks/web.json and the tables of docs/web.md.
"""

from __future__ import annotations

import gzip
import os
import statistics
import tempfile
from collections.abc import Callable
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

SCENES: Final = ((1_000, "50m"), (10_000, "110m"), (100_000, "110m"))
"""Sites and land."""

STEPS: Final = 60
"""Of the mouse in a turn."""

MOVE: Final = """({ plate, clientX, clientY }) => new Promise((drawn) => {
  const move = new PointerEvent("pointermove", { pointerId: 1, pointerType: "mouse", clientX, clientY });
  document.querySelector(plate).dispatchEvent(move);
  requestAnimationFrame(() => requestAnimationFrame(() => drawn()));
})"""
"""One move of the mouse that is down, and the frame that shows it."""

DRAGGED: Final = 10_000
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


def turn(step: int) -> tuple[float, float]:
    """The way, px, that turns a globe, and back."""
    angle = 2 * np.pi * step / STEPS
    return 120 * np.sin(angle), 60 * np.sin(2 * angle)


def drag(step: int) -> tuple[float, float]:
    """That of a site which is dragged, on a circle."""
    return 40 * np.sin(step / 8), 40 * (1 - np.cos(step / 8))


def frame(browser: Browser, page: Path, room: str, plate: str, way: Callable[[int], tuple[float, float]]) -> float:
    """Milliseconds for which a frame keeps the page's own thread busy while the mouse goes a way: the median.

    From the middle of a plate of a room, one move a frame.
    """
    visit = Visit(browser, f"{page.as_uri()}#{room}")
    visit.until("document.documentElement.dataset.ready")
    visit.rest(seconds=60)
    x, y = visit.middle(plate)
    visit.page.mouse.move(x, y)
    visit.page.mouse.down()
    times = [visit.busy()]
    for step in range(1, STEPS + 1):
        right, down = way(step)
        visit.page.evaluate(MOVE, {"plate": plate, "clientX": x + right, "clientY": y + down})
        times.append(visit.busy())
    visit.page.mouse.up()
    visit.close()
    return 1000 * float(np.median(np.diff(times)))


def sites(count: int) -> FloatArray:
    """The first sites of a page."""
    return uniform_lonlat(count, np.random.default_rng(1))


def speed() -> Row:
    """How soon the page is ready, and a frame by scene, and while the first site, in the middle, is dragged."""
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        plain = web(Path(folder, "plain.html"), resolution="110m")
        rows = []
        for count, resolution in SCENES:
            page = web(Path(folder, "sites.html"), lonlat=sites(count), name="sites", resolution=resolution)
            turned = frame(browser, page, "globe", "#globe-plate", turn)
            rows.append({"sites": count, "land": resolution, "ms": turned})
        lonlat = np.vstack([[0, 0], sites(DRAGGED - 1)])
        page = web(Path(folder, "dragged.html"), lonlat=lonlat, name="sites", resolution="110m")
        ball = "v=1&room=sphere&set=given", "#sphere-ball", drag
        dragged = {"sites": DRAGGED, "ms": frame(browser, page, *ball)}
        return {"ready, seconds": seconds_until_ready(browser, plain), "scenes": rows, "drag": dragged}


if __name__ == "__main__":
    pages.record("web", {"load": os.getloadavg()[0], "sizes": sizes(), **speed()})
