"""The distribution's Chromium without a window or a network: for the tests of the page, its pictures and measurements.

Type is that of the figures: the browser finds the fonts that come with matplotlib and no others, so that a page is laid
out the same on every machine.
"""

from __future__ import annotations

import hashlib
import io
import os
import shutil
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import matplotlib as mpl
import numpy as np
from PIL import Image
from playwright.sync_api import Browser, CDPSession, ConsoleMessage, Page, sync_playwright

from stereodel._arrays import Pixels

NAMES: Final = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome")
"""What the browser is called on different systems."""

OPTIONS: Final = (
    "--disable-background-networking",
    "--disable-component-update",
    "--font-render-hinting=none",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
)
"""No network: no name is found, the browser asks for nothing by itself. Type without hinting is the same everywhere."""

WATCH: Final = """(() => {
  let frames = 0;
  const ask = requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (draw) => ask((now) => { frames += 1; return draw(now); });
  Object.defineProperty(window, "framesDrawn", { get: () => frames });
  const watch = new MutationObserver(() => {
    if (document.documentElement.dataset.ready === undefined) return;
    watch.disconnect();
    ask(() => setTimeout(() => { window.readyAt = performance.now(); }));
  });
  watch.observe(document, { attributes: true, subtree: true, attributeFilter: ["data-ready"] });
})()"""
"""Runs before every script of a page: counts the frames that the page asked for and got, and notes the milliseconds
until the first one after `data-ready` was set was drawn."""

INK: Final = 24
"""Levels, of 255, by which a pixel must differ from the ground to be ink: more than shading from pixel to pixel has."""

FONTS: Final = """<?xml version="1.0"?><!DOCTYPE fontconfig SYSTEM "urn:fontconfig:fonts.dtd">
<fontconfig><dir>{fonts}</dir><cachedir>{cache}</cachedir></fontconfig>
"""


@contextmanager
def chromium() -> Iterator[Browser]:
    """A browser, which ends with the block; a FileNotFoundError where there is none."""
    found = next(filter(None, map(shutil.which, NAMES)), None)
    if found is None:
        raise FileNotFoundError(f"there is no browser here, none of {', '.join(NAMES)}; get one with: make system")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        fonts = Path(folder, "fonts.conf")
        fonts.write_text(FONTS.format(fonts=Path(mpl.get_data_path(), "fonts", "ttf"), cache=folder))
        browser = playwright.chromium.launch(
            executable_path=found,
            args=list(OPTIONS),
            chromium_sandbox=os.geteuid() != 0,  # the sandbox of Chromium refuses to run as root
            env={**os.environ, "FONTCONFIG_FILE": str(fonts)},
        )
        try:
            yield browser
        finally:
            browser.close()


class Visit:
    """An open page of an address or a file, as Playwright has it (`page`).

    `requests` are the addresses that it asked for, its own first, without those of data and blobs, which ask nobody;
    `complaints` errors that no script caught, and warnings and errors on the console. The window is `width` by
    `height` CSS pixels, of `scale` pixels of the device each; a page that is a file has no connection at all.
    """

    def __init__(
        self,
        browser: Browser,
        address: str | Path,
        *,
        width: int = 1280,
        height: int = 800,
        scale: float = 1.0,
        colours: str = "light",
        reduced_motion: bool = False,
        touch: bool = False,
        offline: bool | None = None,
    ) -> None:
        self._address = address.resolve().as_uri() if isinstance(address, Path) else address
        self._context = browser.new_context(
            viewport={"width": width, "height": height},
            device_scale_factor=scale,
            color_scheme="dark" if colours == "dark" else "light",
            reduced_motion="reduce" if reduced_motion else "no-preference",
            has_touch=touch,
            is_mobile=touch,
            offline=self._address.startswith("file:") if offline is None else offline,
            accept_downloads=True,
        )
        self._context.add_init_script(WATCH)
        self.page: Page = self._context.new_page()
        self.page.set_default_timeout(90_000)  # a machine whose processors are all busy may take long for a picture
        self._clock: CDPSession | None = None
        self.requests: list[str] = []
        self.complaints: list[str] = []
        self.page.on("request", lambda request: self._asked(request.url))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("console", self._heard)
        self.page.goto(self._address)

    def _asked(self, address: str) -> None:
        if not address.startswith(("data:", "blob:")):
            self.requests.append(address)

    def _heard(self, message: ConsoleMessage) -> None:
        if message.type in ("warning", "error"):
            self.complaints.append(f"{message.type}: {message.text}")

    def close(self) -> None:
        """Close the page."""
        self._context.close()

    def until(self, condition: str, *, seconds: float = 10.0) -> None:
        """Wait until a JavaScript expression is true; a TimeoutError after so many seconds."""
        # Not `wait_for_function`, which evaluates text in the page, where the security policy forbids that.
        end = time.monotonic() + seconds
        while not self.page.evaluate(condition):
            if time.monotonic() > end:
                raise TimeoutError(f"not true after {seconds:g} s: {condition}; the page says {self.complaints}")
            self.page.wait_for_timeout(20)

    def rest(self, *, still: float = 0.2, seconds: float = 10.0) -> None:
        """Wait until no frame was drawn for `still` seconds; a TimeoutError if the page does not come to rest."""
        end = time.monotonic() + seconds
        while self.frames(still):
            if time.monotonic() > end:
                raise TimeoutError(f"the page still draws after {seconds:g} s")

    def frames(self, seconds: float) -> int:
        """The number of frames that the page draws in so many seconds."""
        before = self.page.evaluate("framesDrawn")
        self.page.wait_for_timeout(1000 * seconds)
        return int(self.page.evaluate("framesDrawn") - before)

    def busy(self) -> float:
        """Seconds for which the page has kept its thread busy since this was first asked: script, layout, painting."""
        if self._clock is None:
            self._clock = self._context.new_cdp_session(self.page)
            self._clock.send("Performance.enable")
        found = {each["name"]: each["value"] for each in self._clock.send("Performance.getMetrics")["metrics"]}
        return float(found["TaskDuration"])

    @property
    def link(self) -> str:
        """The state in the address: what follows #, without it."""
        return str(self.page.evaluate("location.hash")).removeprefix("#")

    def picture(self, selector: str | None = None) -> Pixels:
        """Pixels (h, w, 3) of the window, or of the first element that a CSS selector finds."""
        shot = self.page.locator(selector).first if selector else self.page
        with Image.open(io.BytesIO(shot.screenshot(caret="hide"))) as image:
            return np.asarray(image.convert("RGB"))

    def ink(self, selector: str) -> float:
        """The share of the pixels of an element that are not the ground, 0 to 1."""
        return ink(self.picture(selector))

    def digest(self, selector: str | None = None) -> str:
        """SHA-256 of `picture`."""
        return hashlib.sha256(self.picture(selector).tobytes()).hexdigest()

    def middle(self, selector: str) -> tuple[float, float]:
        """The middle of an element in the window, in CSS pixels from the upper left corner."""
        box = self.page.locator(selector).first.bounding_box()
        if box is None:
            raise ValueError(f"{selector} is not to be seen")
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag(self, start: Sequence[float], end: Sequence[float], *, steps: int = 10) -> None:
        """Press the mouse at a place of the window, move it to another and let it go."""
        self.page.mouse.move(*start)
        self.page.mouse.down()
        self.page.mouse.move(*end, steps=steps)
        self.page.mouse.up()

    def swipe(self, *fingers: tuple[Sequence[float], Sequence[float]], steps: int = 10) -> None:
        """Move fingers over the screen, each from its first place of the window to its second; two of them pinch."""
        touch = self._context.new_cdp_session(self.page)
        for step in range(steps + 1):
            share = step / steps
            places = [np.add(np.multiply(start, 1 - share), np.multiply(end, share)) for start, end in fingers]
            # Chromium's gestures made of one command do not scroll without a window; touches step by step do.
            points = [{"x": float(x), "y": float(y), "id": number} for number, (x, y) in enumerate(places)]
            kind = "touchMove" if step else "touchStart"
            touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
            self.page.wait_for_timeout(16)
        touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        touch.detach()


def ink(pixels: Pixels) -> float:
    """The share of pixels (h, w, 3) that differ from the most frequent colour by more than `INK` levels, 0 to 1."""
    colours, counts = np.unique(pixels.reshape(-1, 3), axis=0, return_counts=True)
    ground = colours[counts.argmax()].astype(np.int16)
    return float((np.abs(pixels - ground) > INK).any(axis=-1).mean())
