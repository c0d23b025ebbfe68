"""The drawing core of the page in Node, on its own kernel: true arcs, fills from all sides, the grabbed point."""

import json
import re
import xml.etree.ElementTree as ET
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


def along(d):
    """Points (n, 2) along the arcs and lines of a path of SVG, as its specification has them (appendix B.2.4)."""
    points, at = [], np.zeros(2)
    for letter, text in re.findall(r"([MLA])([^MLAZ]*)", d):
        numbers = np.array(text.split(), dtype=float)
        end = numbers[-2:]
        share = np.linspace(0, 1, 400)[:, np.newaxis]
        if letter == "L":
            points.append(at + share * (end - at))
        elif letter == "A":
            radii, turn, (large, sweep) = numbers[:2], np.radians(numbers[2]), numbers[3:5]
            axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
            half = axes @ (at - end) / 2 / radii  # half the chord, where the ellipse is a circle of radius 1
            height = np.sqrt(max(0.0, 1 / (half @ half) - 1)) * (-1 if large == sweep else 1)
            middle = height * np.array([half[1], -half[0]])
            first, last = (np.arctan2(*side[::-1]) for side in (half - middle, -half - middle))
            way = (last - first) % (2 * np.pi) - (0 if sweep else 2 * np.pi)
            angles = first + share * way
            circle = middle + np.hstack([np.cos(angles), np.sin(angles)])
            points.append(circle * radii @ axes + (at + end) / 2)
        at = end
    return np.vstack(points)


def test_arcs_of_svg_are_those_of_the_canvas(drawing):
    arcs = [
        (np.array(arc["points"])[:, np.newaxis], along(arc["d"])) for arc in drawing("svgArcs(400)") if arc["points"]
    ]
    worst = [np.linalg.norm(points - path, axis=-1).min(axis=1).max() for points, path in arcs]
    assert len(worst) > 200
    assert max(worst) < 2.5  # pixels: between the points along an arc


def test_svg_is_well_formed(drawing):
    root = ET.fromstring(drawing("svg()"))
    path = root.find(".//{*}path")
    assert "A" in path.get("d")
    assert path.get("fill-opacity") == "0.5"
    assert "".join(root.find(".//{*}text").itertext()) == "P, behind <&>"
    assert root.find("{*}title").text == "A bubble"
