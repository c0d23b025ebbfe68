"""The palette as others see it: with one kind of cone missing, and printed in gray. Pairs are those of the pages."""

from collections import defaultdict
from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations

import numpy as np
import pytest

from stereodel.drawing.colorimetry import contrast
from stereodel.drawing.colors import color_map
from stereodel.drawing.label import label_box
from stereodel.drawing.page import Dots, Fill, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.scales import usual_scale
from stereodel.drawing.style import DOTS, FILLS, LINES, MAP_LINES, fainter, with_opacity
from tests.figures.color_vision import VISIONS, difference, lab, lab_difference
from tests.figures.scripts import FIGURES, FOLDER, page, path_points, script

MAPS = ("globe_europe", "globe_tissot")
SCRIPTS = sorted(path.stem for kind in ("earth", "globe", "sky") for path in FOLDER.glob(f"{kind}_*.py"))
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

HIDDEN_AUXILIARY_CONTRAST = 1.3
"""Of lines that are both: their near halves, which are darker, tell how the far ones go on."""

TOLD_APART = {"line": 15.0, "dot": 15.0, "fill": 10.0}
"""From this difference on, CIEDE2000, things that are otherwise alike are meant to be told apart by their colour."""

STILL_APART = {"line": 8.0, "dot": 8.0, "fill": 5.0}
"""What must remain of it; 1 can just be seen where areas touch, lines are thin and apart."""

WIDER = 1.3
"""Lines and dots whose widths have this ratio are told apart by it."""

ASIDE = 1.5
"""Pixels beside a line where it is looked what is there: one that parts two regions stands out from one of them."""

SYMMETRY = 5.0
"""By how much L* may differ at places as far from the middle of a diverging scale."""

SAMPLES = 500
"""Of a look on a page."""

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


def dot_colors(item):
    """Of the dot itself and of its rim, if it has one: it is seen by either."""
    return (item.color, item.rim) if item.rim_width > 0 else (item.color,)


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
                places[item.name, dot_colors(item)].append(item.centers)
    for look, runs in places.items():
        points = np.concatenate(runs)
        yield *look, points[:: -(-len(points) // SAMPLES)]


FAINT = {fainter(look.color) for look in (*LINES.values(), *MAP_LINES.values(), *DOTS.values())}
"""Colours of what is seen through glass."""


def least_contrast(sign, color):
    """That of a line or a dot by its name and colour."""
    if sign in AUXILIARY:
        return HIDDEN_AUXILIARY_CONTRAST if color in FAINT else AUXILIARY_CONTRAST
    return HIDDEN_CONTRAST if color in FAINT else GRAPHICS


@by_name
def test_lines_and_dots_stand_out_from_what_is_below(name):
    shown, wrong = page(name), []
    if shown.pictured:
        return  # cells coloured by numbers are of every lightness
    for sign, colors, points in drawn_points(shown):
        below = [ground(name)(points, aside) for aside in ((ASIDE, 0), (-ASIDE, 0), (0, ASIDE), (0, -ASIDE))]
        if (found := max(usual_contrast(color, *below) for color in colors)) < least_contrast(sign, colors[0]):
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


def test_a_white_dot_is_seen_by_its_rim():
    ring, paper = DOTS["ring"], np.ones((3, 3))
    bare, rimmed = (Dots(np.zeros((1, 2)), ring.radius, ring.color, ring.rim, width) for width in (0, ring.rim_width))
    assert max(usual_contrast(color, paper) for color in dot_colors(bare)) == pytest.approx(1)
    assert max(usual_contrast(color, paper) for color in dot_colors(rimmed)) > GRAPHICS


def test_what_is_seen_through_glass_may_be_faint():
    near, far = LINES["delaunay"].color, LINES["delaunay"].hidden.color
    assert [least_contrast(sign, near) for sign in ("delaunay", "graticule")] == [GRAPHICS, AUXILIARY_CONTRAST]
    assert [least_contrast(sign, far) for sign in ("delaunay", "graticule")] == [
        HIDDEN_CONTRAST,
        HIDDEN_AUXILIARY_CONTRAST,
    ]


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


def lightness(name):
    """CIE L* along a scale."""
    return lab(color_map(name)(np.linspace(0, 1, 101))[:, :3])[:, 0]


def told_by_lightness(name):
    """Whether lightness tells places of a scale apart: by rising or falling, on diverging scales from their middle."""
    found = lightness(name)
    steps = np.diff(found)
    ordered = (steps > 0).all() or (steps < 0).all()
    half = steps[: len(steps) // 2]
    symmetric = np.abs(found - found[::-1]).max() < SYMMETRY and ((half > 0).all() or (half < 0).all())
    return bool(ordered or symmetric)


SCALES = {name: found for name in SCRIPTS if (found := script(name).get("SCALE"))}
SCALES["earth_airports"] = script("earth_airports")["scale_of"](np.array([1.0, 1e7]))


def test_scales_are_told_by_lightness():
    assert len(SCALES) == 4
    for name in {scale.name for scale in SCALES.values()} | {usual_scale(np.arange(2.0)).name, "cividis"}:
        assert told_by_lightness(name), name


@pytest.mark.parametrize("name", sorted(SCALES))
def test_a_scale_has_two_ends_in_print(name):
    first, *_, last = lightness(SCALES[name].name)
    assert abs(first - last) > 60


def test_a_rainbow_is_not_told_by_lightness():
    assert not told_by_lightness("jet")
    assert not told_by_lightness("hsv")
    assert told_by_lightness("coolwarm")
    assert not told_by_lightness("bwr")  # its blue is darker than its red
