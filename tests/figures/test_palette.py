"""The palette as others see it: with one kind of cone missing, and printed in gray. Pairs are those of the pages."""

from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations

import numpy as np
import pytest

from stereodel.drawing.colorimetry import contrast
from stereodel.drawing.label import label_box
from stereodel.drawing.page import Dots, Fill, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.style import FILLS, LINES, fainter, with_opacity
from tests.figures.color_vision import VISIONS, difference, lab_difference
from tests.figures.scripts import FIGURES, page, path_points

MAPS = ("globe_europe", "globe_new_york", "globe_tissot")
by_name = pytest.mark.parametrize("name", [*FIGURES, *MAPS])

TEXT = 4.5
"""Least contrast of type, that of the Web Content Accessibility Guidelines 2.1 (criterion 1.4.3)."""

GRAPHICS = 3.0
"""Least contrast of lines and dots, that of criterion 1.4.11."""

AUXILIARY = {"graticule", "grid", "rivers", "borders"}
"""Lines that a picture is read without: they must stay behind what they help to place."""

AUXILIARY_CONTRAST = 2.0
"""Of such lines: those below break up in print, as a halftone of less than a third of black does."""

HIDDEN_CONTRAST = 1.5
"""Of what is seen through glass: that it is faint says where it is."""

TOLD_APART = {"line": 15.0, "dot": 15.0, "fill": 10.0}
"""From this difference on, CIEDE2000, things that are otherwise alike are meant to be told apart by their colour."""

STILL_APART = {"line": 8.0, "dot": 8.0, "fill": 5.0}
"""What must remain of it; 1 can just be seen where areas touch, lines are thin and apart."""

WIDER = 1.3
"""Lines and dots whose widths have this ratio are told apart by it."""

ASIDE = 1.5
"""Pixels beside a line where it is looked what is there: one that parts two regions stands out from one of them."""

PIXELS = 300
"""Across the picture of what lies under lines and type."""


@dataclass(frozen=True)
class Sign:
    """What a reader tells from others by its look."""

    name: str
    kind: str
    color: tuple
    size: float = 0.0
    dash: tuple | None = None


def over(color, ground):
    """A colour with opacity on an opaque ground (…, 3)."""
    return color[3] * np.array(color[:3]) + (1 - color[3]) * np.asarray(ground)


def signs(shown):
    """The different signs of a page; of scales and of regions coloured by numbers there are none."""
    ground, found = shown.background[:3], set()
    for item in shown.items:
        match item:
            case Stroke(color=color, width=width, dash=dash, name=name):
                found.add(Sign(name, "line", tuple(over(color, ground)), width, dash))
            case Polylines(color=color, width=width, name=name):
                found.add(Sign(name, "line", tuple(over(color, ground)), width))
            case Dots(color=color, radius=radius, name=name):
                found.add(Sign(name, "dot", tuple(over(color, ground)), radius))
            case Fill(color=color, name=name) if name != "scale":
                found.add(Sign(name, "fill", tuple(over(color, ground))))
            case Polygons(name=name) if len(item.by_color[0]) == 1:
                found.add(Sign(name, "fill", tuple(over(item.by_color[0][0], ground))))
    return sorted(found, key=repr)


def told_apart_by_more_than_colour(a, b, lines):
    """Whether two signs of a kind differ in width, dashes, or because one of them is a region with an outline."""
    if a.kind == "fill":
        return bool({a.name, b.name} & lines)
    return (a.dash is None) != (b.dash is None) or max(a.size, b.size) >= WIDER * min(a.size, b.size)


def lost(found):
    """Pairs of signs that colour alone tells apart, and not to everybody."""
    lines = {sign.name for sign in found if sign.kind == "line"}
    for a, b in combinations(found, 2):
        colors = np.array([a.color, b.color])
        if a.kind != b.kind or difference(*colors) < TOLD_APART[a.kind] or told_apart_by_more_than_colour(a, b, lines):
            continue
        for vision, seen in VISIONS.items():
            left = float(difference(*seen(colors)))
            if left < STILL_APART[a.kind]:
                yield f"{a.kind} {a.name} and {b.name}, {vision}: {left:.1f}"


@by_name
def test_what_colour_says_is_said_to_everybody(name):
    assert list(lost(signs(page(name)))) == []


@cache
def ground(name):
    """The page without lines, dots and type, in pixels, and where a page point is on it."""
    shown = page(name)
    regions = tuple(item for item in shown.items if isinstance(item, Fill | Polygons | Picture))
    bare = replace(shown, items=regions)
    pixels = bare.pixels(size=PIXELS, text=False, renderer="gl" if bare.pictured else "agg") / 255
    left, _, _, top = shown.extent
    scale = PIXELS * shown.points_per_unit / shown.width

    def at(points, aside=(0.0, 0.0)):
        column, row = np.floor(scale * (np.asarray(points) - (left, top)) * (1, -1) + aside).astype(int).T
        return pixels[np.clip(row, 0, len(pixels) - 1), np.clip(column, 0, PIXELS - 1)]

    return at


def usual_contrast(color, *below):
    """The median of a colour's contrast with what is below it, (n, 3) in several places, of which the best counts."""
    return float(np.median(np.max([contrast(over(color, place), place) for place in below], axis=0)))


@by_name
def test_lines_and_dots_stand_out_from_what_is_below(name):
    shown, at, wrong = page(name), ground(name), []
    if shown.pictured:
        return  # cells coloured by numbers are of every lightness
    for item in shown.items:
        match item:
            case Stroke():
                points = path_points(item.path, 5)
            case Polylines():
                points = item.points
            case Dots(centers=points):
                pass
            case _:
                continue
        styles = [LINES[item.name].hidden.color] if item.name in LINES else []
        hidden = item.color in styles or any(item.color == fainter(style.color) for style in LINES.values())
        least = AUXILIARY_CONTRAST if item.name in AUXILIARY else GRAPHICS
        least = HIDDEN_CONTRAST if hidden else least
        below = [at(points, aside) for aside in ((ASIDE, 0), (-ASIDE, 0), (0, ASIDE), (0, -ASIDE))]
        if len(points) and (found := usual_contrast(item.color, *below)) < least:
            wrong.append(f"{item.name}: {found:.2f}")
    assert sorted(set(wrong)) == []


@by_name
def test_type_can_be_read(name):
    shown, at, wrong = page(name), ground(name), []
    for label in shown.labels:
        low, high = label_box(label, shown.points_per_unit) / shown.points_per_unit
        inside = np.stack(np.meshgrid(*np.linspace(low, high, 4).T), axis=-1).reshape(-1, 2)
        below = np.array([label.halo_color[:3]]) if label.halo else at(inside)
        if (found := usual_contrast(label.color, below)) < TEXT:
            wrong.append(f"{label.text}: {found:.2f}")
    assert wrong == []


def test_bright_signs_of_one_hue_are_noticed():
    """What the tests above look for: two accents that gray makes one, but not where one of them is dashed."""
    red, green = (0.80, 0.30, 0.20), (0.20, 0.52, 0.20)
    pair = [Sign("a", "line", red, 1.0), Sign("b", "line", green, 1.0)]
    assert {text.split(", ")[1].split(":")[0] for text in lost(pair)} >= {"gray"}
    assert list(lost([pair[0], replace(pair[1], dash=(3.0, 2.0))])) == []
    assert list(lost([pair[0], replace(pair[1], size=1.4)])) == []


def test_a_pale_line_is_noticed():
    pale = with_opacity(FILLS["large_bubble"], 1.0)
    assert usual_contrast(pale, np.ones((3, 3))) < AUXILIARY_CONTRAST


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [
        ((50.0, 2.6772, -79.7751), (50.0, 0.0, -82.7485), 2.0425),
        ((50.0, -1.0, 2.0), (50.0, 0.0, 0.0), 2.3669),
        ((50.0, 2.49, -0.001), (50.0, -2.49, 0.0011), 7.2195),
        ((50.0, 2.5, 0.0), (61.0, -5.0, 29.0), 22.8977),
        ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
        ((22.7233, 20.0904, -46.694), (23.0331, 14.973, -42.5619), 2.0373),
        ((90.9257, -0.5406, -0.9208), (88.6381, -0.8985, -0.7239), 1.5381),
    ],
)
def test_the_difference_is_that_of_its_authors(first, second, expected):
    assert float(lab_difference(first, second)) == pytest.approx(expected, abs=1e-4)


def test_grays_look_the_same_to_everybody():
    grays = np.repeat(np.linspace(0, 1, 11)[:, None], 3, axis=1)
    for seen in VISIONS.values():
        np.testing.assert_allclose(seen(grays), grays, atol=2e-3)
