"""The palette as others see it: with one kind of cone missing, and printed in gray. Pairs are those of the pages."""

from collections import defaultdict
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import combinations

import numpy as np
import pytest

from stereodel.drawing.page import Dots, Fill, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.page.colors import color_map, contrast, encoded, linear, luminance, to_oklab
from stereodel.drawing.page.labels import label_box
from stereodel.drawing.page.scales import USUAL
from stereodel.drawing.page.style import DOTS, LINES, MAP_LINES, fainter
from tests.figures.scripts import FIGURES, FOLDER, page, path_points, script
from tests.tiers import by_day

SCRIPTS = sorted(path.stem for kind in ("earth", "globe", "sky") for path in FOLDER.glob(f"{kind}_*.py"))
by_name = pytest.mark.parametrize(
    "name", by_day([*FIGURES, "globe_europe", "globe_tissot"], "fig03_bubbles", "fig06_sphere_size", "globe_tissot")
)

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

HIDDEN_AUXILIARY_CONTRAST = 1.3
"""Of lines that are both: their near halves, which are darker, tell how the far ones go on."""

TOLD_APART = {"line": 0.12, "dot": 0.12, "fill": 0.08}
"""From this distance in Oklab on things that are otherwise alike are meant to be told apart by their colour."""

STILL_APART = {"line": 0.08, "dot": 0.08, "fill": 0.065}
"""What must remain of it; 0.01 can just be seen where areas touch, lines are thin and apart."""

WIDER = 1.3
"""Lines and dots whose widths have this ratio are told apart by it."""

ASIDE = 1.5
"""Pixels beside a line where it is looked what is there: one that parts two regions stands out from one of them."""

SAMPLES = 500
"""Of a look on a page."""

PIXELS = 300
"""Across the picture of what lies under lines and type."""

DEFICIENCIES = {
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    "gray": 3 * [luminance(np.eye(3)).tolist()],
}
"""Of linear RGB: Machado, Oliveira and Fernandes, "A Physiologically-based Model for Simulation of Color Vision
Deficiency", IEEE Transactions on Visualization and Computer Graphics 15 (2009), severity 1; and black ink alone."""


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


def difference(first, second):
    """How far colours are apart, as a distance in Oklab."""
    return float(np.linalg.norm(to_oklab(first) - to_oklab(second)))


def lost(found):
    """Pairs of signs that colour alone tells apart, and not to everybody."""
    lines = {sign.name for sign in found if sign.kind == "line"}
    for a, b in combinations(found, 2):
        colors = np.array([a.color, b.color])
        if a.kind != b.kind or difference(*colors) < TOLD_APART[a.kind] or told_apart_by_more_than_colour(a, b, lines):
            continue
        for vision, matrix in DEFICIENCIES.items():
            left = difference(*encoded(linear(colors) @ np.transpose(matrix)))
            if left < STILL_APART[a.kind]:
                yield f"{a.kind} {a.name} and {b.name}, {vision}: {left:.3f}"


@by_name
def test_what_colour_says_is_said_to_everybody(name):
    assert list(lost(signs(page(name)))) == []


@lru_cache(maxsize=3)
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


def drawn_points(shown):
    """Name and colours of lines and dots, and points on them: at most some for each."""
    places = defaultdict(list)
    for item in shown.items:
        match item:
            case Stroke():
                places[item.name, (item.color,)].append(path_points(item.path, 5))
            case Polylines():
                places[item.name, (item.color,)].append(item.points)
            case Dots() if len(item.centers):
                colors = (item.color, item.rim) if item.rim_width > 0 else (item.color,)  # it is seen by either
                places[item.name, colors].append(item.centers)
    for look, runs in places.items():
        points = np.concatenate(runs)
        yield *look, points[:: -(-len(points) // SAMPLES)]


FAINT = {fainter(look.color) for look in (*LINES.values(), *MAP_LINES.values(), *DOTS.values())}
"""Colours of what is seen through glass."""


@by_name
def test_lines_and_dots_stand_out_from_what_is_below(name):
    shown, wrong = page(name), []
    if shown.pictured:
        return  # cells coloured by numbers are of every lightness
    for sign, colors, points in drawn_points(shown):
        below = [ground(name)(points, aside) for aside in ((ASIDE, 0), (-ASIDE, 0), (0, ASIDE), (0, -ASIDE))]
        near, far = (
            (AUXILIARY_CONTRAST, HIDDEN_AUXILIARY_CONTRAST) if sign in AUXILIARY else (GRAPHICS, HIDDEN_CONTRAST)
        )
        least = far if colors[0] in FAINT else near
        if (found := max(usual_contrast(color, *below) for color in colors)) < least:
            wrong.append(f"{sign}: {found:.2f}")
    assert wrong == []


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


def lightness(name):
    """That of Oklab along a scale."""
    return to_oklab(color_map(name)(np.linspace(0, 1, 101))[:, :3])[:, 0]


SCALES = {name: found for name in SCRIPTS if (found := script(name).get("SCALE"))}
SCALES["earth_airports"] = script("earth_airports")["scale_of"](np.array([1.0, 1e7]))


def test_scales_are_told_by_lightness_and_have_two_ends_in_print():
    assert len(SCALES) == 4
    for name in {scale.colors for scale in SCALES.values()} | {USUAL, "cividis"}:
        steps = np.diff(lightness(name))
        assert (steps > 0).all() or (steps < 0).all(), name
        assert abs(steps.sum()) > 0.55, name
