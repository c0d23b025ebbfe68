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
    ("stroke", {"color": (0.8, 0.2, 0.0, 1.0)}, "colour green is 0.2, expected 0.1"),
    ("stroke", {"dash": (6.0, 5.0)}, "dash gap is 5, expected 4"),
    ("stroke", {"path": LINE + np.eye(4)[:, 2:3] * [0.0, 1.0]}, "first in y of curve 0, control point 2: 0.6"),
    ("polylines", {"points": LOOP + [[0, 0], [0, 1], [0, 0], [0, 0]]}, "first in y of point 1: 0.0"),
    ("polygons", {"colors": np.array([(0.8, 0.2, 0.0, 1.0)])}, "first in colour green of region 0: 0.1"),
    ("fill", {"ball": Ball((1.0, 0.5), 0.3)}, "ball radius is 0.3, expected 0.4"),
    ("dots", {"rim": RED}, "rim red is 0.8, expected 0; rim green is"),
    ("label", {"offset": (1.0, 0.0)}, "offset x is 1, expected 0"),
    ("label", {"text": "south"}, "text is south, expected north"),
]


@pytest.mark.parametrize(("kind", "change", "told"), CHANGES)
def test_a_field_has_its_name(kind, change, told):
    before = Page((0.0, 4.0, 0.0, 2.0), (ITEMS[kind],))
    after = replace(before, items=(replace(ITEMS[kind], **change),))
    (message,) = array_differences(before.arrays(), after.arrays()).values()
    assert message.startswith(told) or f", {told}" in message


@pytest.mark.parametrize("kind", ITEMS)
def test_no_number_is_without_a_name(kind):
    arrays = Page((0.0, 4.0, 0.0, 2.0), (ITEMS[kind],)).arrays()
    arrays.pop("views")
    for name, array in arrays.items():
        assert len(fields_of(name)) == len(array) or place_in(name, (0,) * array.ndim).startswith("in ")
        assert name == "page" or item_of(name).startswith(f"{kind} 0")
