"""Names of the numbers in the arrays of a page: each field of each item is found under its name."""

from dataclasses import replace

import numpy as np
import pytest

from stereodel.drawing.page import Ball, Dots, Fill, Label, Page, Polygons, Polylines, Stroke
from tools.fields import fields_of, item_of, place_in
from tools.image import array_differences

RED, BLUE = (0.8, 0.1, 0.0, 1.0), (0.0, 0.2, 0.9, 0.5)
LINE = np.linspace([[0.0, 0.0], [1.0, 1.0]], [[1.0, 1.0], [2.0, 0.0]], 4, axis=1)
LOOP = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]])
BALL = Ball((1.0, 0.5), 0.4)

ITEMS = {
    "stroke": Stroke(LINE, RED, 1.5, dash=(6.0, 4.0), name="limb"),
    "polylines": Polylines(LOOP, np.array([0, 4]), RED, 0.5, "coast"),
    "polygons": Polygons(LOOP, np.array([0, 4]), np.array([0]), np.array([RED]), BALL, "land"),
    "fill": Fill((LINE,), RED, "ball", BALL),
    "dots": Dots(LOOP[:3], 3.0, RED, BLUE, 0.5, "sites"),
    "label": Label("north", (1.0, 1.0), halo=1.0, halo_color=BLUE),
}

CHANGES = [
    *(("stroke", {"color": tuple(c + 0.1 * (k == i) for i, c in enumerate(RED))}, f"colour {what} is")
      for k, what in enumerate(("red", "green", "blue", "opacity"))),
    ("stroke", {"width": 2.0}, "width is 2, expected 1.5"),
    ("stroke", {"dash": (6.0, 5.0)}, "dash gap is 5, expected 4"),
    ("stroke", {"dash": (7.0, 4.0)}, "dash length is"),
    ("stroke", {"cap": "butt"}, "round ends is 0, expected 1"),
    ("stroke", {"closed": True}, "closed is"),
    ("stroke", {"path": LINE + np.eye(4)[:, 2:3] * [0.0, 1.0]}, "first in y of curve 0, control point 2: 0.6"),
    ("polylines", {"color": (0.8, 0.1, 0.0, 0.9)}, "colour opacity is"),
    ("polylines", {"width": 2.0}, "width is"),
    ("polylines", {"points": LOOP + [[0, 0], [0, 1], [0, 0], [0, 0]]}, "first in y of point 1: 0.0"),
    ("polygons", {"colors": np.array([(0.8, 0.2, 0.0, 1.0)])}, "first in colour green of region 0: 0.1"),
    ("polygons", {"ball": Ball((1.0, 0.5), 0.3)}, "ball radius is 0.3, expected 0.4"),
    ("fill", {"ball": Ball((1.0, 0.6), 0.4)}, "ball y is"),
    ("fill", {"color": (0.8, 0.1, 0.1, 1.0)}, "colour blue is"),
    ("dots", {"radius": 4.0}, "radius is"),
    ("dots", {"rim": RED}, "rim red is 0.8, expected 0; rim green is"),
    ("dots", {"rim_width": 1.0}, "rim width is"),
    ("dots", {"centers": LOOP[:3] + [[0, 0], [0, 0], [1, 0]]}, "first in x of dot 2"),
    ("label", {"anchor": (1.0, 2.0)}, "anchor y is"),
    ("label", {"offset": (1.0, 0.0)}, "offset x is 1, expected 0"),
    ("label", {"size": 20.0}, "size is"),
    ("label", {"rotation": 20.0}, "rotation is"),
    ("label", {"halo": 2.0}, "halo is 2"),
    ("label", {"halo_color": RED}, "halo colour red is"),
    ("label", {"text": "south"}, "text is south, expected north"),
    ("label", {"align": "left"}, "align is left"),
    ("label", {"valign": "top"}, "valign is top"),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "change", "told"), CHANGES)
def test_each_field_has_its_name(kind, change, told):
    before = Page((0.0, 4.0, 0.0, 2.0), (ITEMS[kind],))
    after = replace(before, items=(replace(ITEMS[kind], **change),))
    (message,) = array_differences(before.arrays(), after.arrays()).values()
    assert message.startswith(told) or f", {told}" in message


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"extent": (0.0, 4.0, 0.0, 2.5)}, "top is 2.5, expected 2"),
        ({"extent": (0.5, 4.0, 0.0, 2.0)}, "left is"),
        ({"width": 100.0}, "width is 100"),
        ({"background": BLUE}, "background red is"),
    ],
)
def test_each_field_of_a_page_has_its_name(change, told):
    page = Page((0.0, 4.0, 0.0, 2.0))
    assert array_differences(page.arrays(), replace(page, **change).arrays())["page"].startswith(told)


@pytest.mark.parametrize("kind", ITEMS)
def test_no_number_is_without_a_name(kind):
    arrays = Page((0.0, 4.0, 0.0, 2.0), (ITEMS[kind],)).arrays()
    arrays.pop("views")
    for name, array in arrays.items():
        assert len(fields_of(name)) == len(array) or place_in(name, (0,) * array.ndim).startswith("in ")
        assert name == "page" or item_of(name).startswith(f"{kind} 0")
