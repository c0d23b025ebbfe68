"""The drawing core of the page in Node, on its own kernel: true arcs, fills from all sides, the grabbed point."""

import json
from pathlib import Path

import numpy as np
import pytest

from stereodel.web.contents import land_rings

DRAWING = Path(__file__).parent / "drawing.ts"


@pytest.fixture
def drawing(node, request):
    """Call a function of drawing.ts, whose random numbers begin with the test: `drawing("arcs(100)")`."""
    preface = f'import * as drawing from "{DRAWING}?{request.node.name}"; export default await drawing.'
    return lambda expression: node(f"{preface}{expression};")


LAND = json.dumps(land_rings("110m"))


def test_what_is_drawn_of_an_arc_is_its_image(drawing):
    measured = drawing("arcs(3_000)")
    assert measured["seen"] > 6_000
    assert measured["missing"] == 0
    assert measured["worst"] < 0.1  # pixels


@pytest.mark.parametrize("count", [60, pytest.param(500, marks=pytest.mark.thorough)])
def test_land_fills_right_through_any_lens_from_any_side(drawing, count):
    filled, sampled = np.array(drawing(f"fills({LAND}, {count}, 130)")).T
    assert np.abs(filled - sampled).max() < 0.003
    assert filled.std() > 0.1  # of many kinds


def test_a_slow_turn_never_jumps(drawing):
    shares = np.array(drawing(f"slowTurn({LAND}, 400)"))
    assert np.abs(np.diff(shares)).max() < 0.02
    assert np.ptp(shares) > 0.1


def test_caps_fill_right_from_any_side(drawing):
    filled, sampled = np.array(drawing("caps(1_000, 120)")).T
    assert np.abs(filled - sampled).max() < 0.004


def test_the_grabbed_point_stays_under_the_pointer(drawing):
    assert drawing("grabbed(500)") == {name: pytest.approx(0, abs=1e-3) for name in ("free", "north", "wheel", "out")}
