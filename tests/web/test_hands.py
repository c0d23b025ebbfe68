"""A link is the picture: what hands have made of a room comes back pixel by pixel in a page opened from its link.

Hands take whatever there is in a room, drawings most often; each state goes on from the one before. The environment
says how many are tried in each room: `STEREODEL_TEST_HANDS=500 pytest -m thorough -o faulthandler_timeout=0`.
"""

import base64
import io
import os

import numpy as np
import pytest
from PIL import Image

from .rooms import DRAWINGS, pixels

CONTROLS = """(room) => {
  const controls = "canvas.plate, button, select, input:not([type=file])";
  const all = [...document.querySelectorAll(`#room-${room} :is(${controls})`)];
  for (const each of all) delete each.dataset.number;
  return all.filter((each) => !each.disabled && each.checkVisibility())
    .map((each, number) => ((each.dataset.number = number), each.type ?? "canvas"));
}"""
"""Numbers all that a hand can take, and tells their kinds."""

SLIDE = """(slider, share) => {
  slider.valueAsNumber = Number(slider.min) + share * (slider.max - slider.min);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}"""

KEYS = ["ArrowLeft", "Shift+ArrowUp", "ArrowDown", "Control+ArrowRight", "Control+z", "Delete", "Enter", "Escape"]
KEYS += ["+", "-", "0", ".", ",", "f", "n"]


def gesture(page, canvas, rng):
    """Something that is done on a drawing, or near it."""
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    corner, size = np.array([box["x"], box["y"]]), np.array([box["width"], box["height"]])
    a, b, c = corner + size * rng.uniform(0.05, 0.95, size=(3, 2))
    mouse = page.page.mouse
    match rng.choice(["drag", "drag", "hover", "click", "double", "wheel", "keys", "pinch"]):
        case "drag":
            page.drag(a, b, steps=3)
        case "hover":
            mouse.move(*a)
        case "click":
            mouse.click(*a)
        case "double":
            mouse.dblclick(*a)
        case "wheel":
            canvas.focus()
            mouse.move(*a)
            mouse.wheel(0, rng.uniform(-900, 500))
        case "keys":
            for key in rng.choice(KEYS, 3):
                canvas.press(key)
        case "pinch":
            page.swipe((a, b), (c, corner + size / 2), steps=2)


def hand(page, name, rng):
    """Take something of a room, a drawing every second time."""
    kinds = page.page.evaluate(CONTROLS, name)
    drawings = [number for number, kind in enumerate(kinds) if kind == "canvas"]
    number = rng.choice(drawings) if rng.random() < 0.5 else rng.integers(len(kinds))
    control = page.page.locator(f"#room-{name} [data-number='{number}']")
    match kinds[number]:
        case "canvas":
            gesture(page, control, rng)
        case "range":
            control.evaluate(SLIDE, rng.random())
        case "number":
            control.fill(str(round(rng.uniform(-200, 200), rng.integers(3))))
            control.press("Enter")
        case "select-one":
            control.select_option(index=int(rng.integers(control.locator("option").count())))
        case _:
            control.evaluate("(each) => each.click()")


def shown(page, name):
    """The pixels of all drawings of a room, once nothing moves and the address has followed."""
    page.page.mouse.move(1, 1)
    page.page.evaluate("document.activeElement.blur()")
    page.rest(still=0.45)
    return pixels(page, name)


def array(drawing):
    with Image.open(io.BytesIO(base64.b64decode(drawing.partition(",")[2]))) as image:
        return np.asarray(image).astype(int)


@pytest.mark.parametrize("name", DRAWINGS)
@pytest.mark.parametrize("states", [1, pytest.param(60, marks=pytest.mark.thorough)])
def test_a_link_shows_the_same_pixels(room, page_file, name, states):
    rng, hands = np.random.default_rng(states), 6 if states == 1 else 3
    if states > 1:
        states = int(os.environ.get("STEREODEL_TEST_HANDS", states))
    page, fresh, different = room(name, height=1200), None, []
    pictures = {str(shown(page, name))}
    for state in range(states):
        for _ in range(hands):
            hand(page, name, rng)
        here = shown(page, name)
        pictures.add(str(here))
        if fresh is None:
            fresh = room(page.link, height=1200)
        else:
            fresh.page.goto("about:blank")
            fresh.page.goto(f"{page_file.as_uri()}#{page.link}")
            fresh.until("document.documentElement.dataset.ready")
        there = shown(fresh, name)
        if there != here:
            pairs = zip(map(array, here), map(array, there), strict=True)
            different.append((state, [(np.abs(a - b).max(axis=-1) > 0).sum() for a, b in pairs], page.link))
    assert different == []
    assert len(pictures) > 1 + states // 2
