"""The drawing core of the page in Node, on its own kernel: true arcs, fills from all sides, the grabbed point."""

import json
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

from stereodel.web.contents import land_rings

DRAWING = Path(__file__).parent / "drawing.ts"


@pytest.fixture
def drawing(node):
    """Call a function of drawing.ts: `drawing("arcs(100)")`; the land of the page is `block`."""

    def call(expression):
        code = f"""
        import {{ text }} from "node:stream/consumers";
        import * as drawing from "{DRAWING}";
        const block = await text(process.stdin);
        console.log(JSON.stringify(await drawing.{expression}));
        """
        return node(code, input=land_rings("110m"))

    return call


def test_what_is_drawn_of_an_arc_is_its_image(drawing):
    measured = drawing("arcs(10_000)")
    assert measured["seen"] > 20_000
    assert measured["missing"] == 0
    assert measured["worst"] < 0.1  # pixels


def test_land_fills_right_through_any_lens_from_any_side(drawing):
    filled, sampled = np.array(drawing("fills(block, 500, 130)")).T
    assert np.abs(filled - sampled).max() < 0.003
    assert filled.std() > 0.1  # of many kinds


def test_a_slow_turn_never_jumps(drawing):
    shares = np.array(drawing("slowTurn(block, 400)"))
    assert np.abs(np.diff(shares)).max() < 0.02
    assert np.ptp(shares) > 0.1


def test_caps_fill_right_from_any_side(drawing):
    filled, sampled = np.array(drawing("caps(1_000, 120)")).T
    assert np.abs(filled - sampled).max() < 0.004


def test_the_grabbed_point_stays_under_the_pointer(drawing):
    assert drawing("grabbed(500)") == {name: pytest.approx(0, abs=1e-3) for name in ("free", "north", "wheel", "out")}


def test_svg_is_well_formed(drawing):
    root = ET.fromstring(drawing("svg()"))
    names = {"svg": "http://www.w3.org/2000/svg"}
    path = root.find(".//svg:path", names)
    assert "A" in path.get("d")
    assert path.get("fill-opacity") == "0.5"
    assert "".join(root.find(".//svg:text", names).itertext()) == "P, behind <&>"
    assert json.dumps(root.find("svg:title", names).text) == '"A bubble"'
