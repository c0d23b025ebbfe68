"""Styles: colours on a dark ground, what files change and what is wrong in them, several styles at once."""

import pickle
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.drawing import styled
from stereodel.drawing.page import Ball, Dots, Fill, Label, Page, Picture, Polygons, Polylines, Stroke, style
from stereodel.drawing.page.colors import contrast, luminance, to_oklab, with_luminance
from stereodel.drawing.page.sheets import GROUND, StyledDraw, StyleSheet, dark_color, dark_page
from stereodel.drawing.page.style import as_length
from tools.baselines import page_arrays

RED, BALL = (1.0, 0.0, 0.0, 1.0), Ball((0.0, 0.0), 1.0)
LOOP = np.array([[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]]])
SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 0.0)])
ROWS = np.array([0, 4, 8])
PAGE = (Path(__file__).parents[2] / "docs" / "drawing.md").read_text(encoding="utf-8")

shares = st.floats(0, 1)
colors = st.tuples(shares, shares, shares)


class Painted:
    """A painter without pixels."""


def page():
    """With an item of each kind, named after what maps have, in red."""
    several = np.array([RED, (0, 0, 1, 1)])
    items = (
        Fill((LOOP,), RED, "ball", BALL),
        Polygons(SQUARE, ROWS[:2], np.array([0]), np.array([RED]), BALL, "land"),
        Polygons(np.concatenate([SQUARE, SQUARE + 2]), ROWS, np.array([0, 1]), several, name="cells"),
        Stroke(LOOP, RED, 1.0, name="limb"),
        Polylines(SQUARE, ROWS[:2], RED, 1.0, "coast"),
        Dots(SQUARE, 2.0, RED, style.WHITE, 0.5, "sites"),
        Label("name", (0.0, 0.0), color=RED, halo=1.0),
        Picture((LOOP,), Painted()),
    )
    return Page((0.0, 4.0, 0.0, 4.0), items)


def over(color, ground):
    return color[3] * np.array(color[:3]) + (1 - color[3]) * np.array(ground[:3])


def test_contrasts_are_those_of_the_guidelines():
    white = (1.0, 1.0, 1.0)
    for gray, expected in ((0x76, 4.54), (0x77, 4.48), (0x94, 3.03), (0x95, 2.995)):
        assert float(contrast((gray / 255,) * 3, white)) == pytest.approx(expected, abs=5e-3)
    assert luminance((0.0, 1.0, 0.0)) == pytest.approx(0.7152)


def test_oklab_is_its_authors():
    """Values of the colours of CSS, as its specification has them."""
    for color, expected in {
        (1.0, 0.0, 0.0): (0.62796, 0.22486, 0.12585),
        (0.0, 1.0, 0.0): (0.86644, -0.23389, 0.17950),
        (0.0, 0.0, 1.0): (0.45201, -0.03246, -0.31153),
        (1.0, 1.0, 1.0): (1.0, 0.0, 0.0),
    }.items():
        np.testing.assert_allclose(to_oklab(color), expected, atol=1e-4)


@given(colors, shares)
def test_another_luminance_keeps_the_hue(color, target):
    found = with_luminance(np.array([color]), np.array([target]))
    assert float(luminance(found)[0]) == pytest.approx(target, abs=1e-6)
    before, after = to_oklab(color)[1:], to_oklab(found)[0, 1:]
    assert np.hypot(*after) <= np.hypot(*before) + 1e-4
    # Along the same ray, whose length may be none.
    assert abs(before[0] * after[1] - before[1] * after[0]) <= 1e-4 * max(np.hypot(*before), 1e-2)
    assert before @ after >= -1e-6


@given(colors)
def test_a_colour_has_the_contrast_that_it_has_on_white(color):
    dark = dark_color((*color, 1.0))
    assert dark_color((*color, 0.0))[3] == 0
    highest = float(contrast(GROUND[:3], (1.0, 1.0, 1.0)))
    expected = min(float(contrast(color, (1.0, 1.0, 1.0))), highest)
    assert float(contrast(dark[:3], GROUND[:3])) == pytest.approx(expected, rel=1e-4)


@given(colors, colors)
def test_two_colours_have_the_contrast_that_they_had(a, b):
    if max(float(contrast(each, (1.0, 1.0, 1.0))) for each in (a, b)) < 18:
        after = contrast(dark_color((*a, 1.0))[:3], dark_color((*b, 1.0))[:3])
        assert float(after) == pytest.approx(float(contrast(a, b)), rel=1e-4)


@pytest.mark.parametrize("name", style.FILLS)
def test_what_is_see_through_has_the_contrast_that_it_has_on_white(name):
    color = style.FILLS[name]
    dark = dark_color(color)
    assert dark[3] == color[3]
    before, after = contrast(over(color, style.WHITE), style.WHITE[:3]), contrast(over(dark, GROUND), GROUND[:3])
    assert float(after) == pytest.approx(float(before), rel=0.02)


def test_every_item_but_pictures_has_its_dark_colours():
    light = page()
    dark = dark_page(light)
    fill, polygons, several, stroke, lines, dots, label, picture = dark.items
    expected = dark_color(RED)
    for found in (fill.color, *polygons.colors, several.colors[0], stroke.color, lines.color, dots.color, label.color):
        np.testing.assert_allclose(found, expected)
    for found in (dots.rim, label.halo_color, dark.background):
        np.testing.assert_allclose(found, GROUND, atol=1e-3)
    assert picture is light.items[-1]
    assert fill.ball == light.items[0].ball
    night = replace(light, background=(0.05, 0.05, 0.2, 1.0))
    assert dark_page(night) is night
    assert dark_page(dark) is dark
    # Nothing but colours changes.
    for before, after in zip(light.items, dark.items, strict=True):
        changed = {key for key, value in vars(before).items() if np.any(value != vars(after).get(key, value))}
        assert changed <= {"color", "rim", "halo_color", "colors", "by_color"}


def write(folder, text):
    file = folder / "mine.toml"
    file.write_text(text, encoding="utf-8")
    return file


def test_a_file_changes_what_it_names(tmp_path):
    file = write(
        tmp_path,
        """
        background = "black"
        [fills]
        ball = "#00ff00"
        land = [0, 1, 0, 0.5]
        cells = "white"
        nothing = "white"
        [lines]
        limb = {color = "lime", width = "1mm"}
        coast = {width = 3}
        [dots.sites]
        radius = 4.5
        rim = "white"
        rim_width = 1
        [labels]
        size = 12
        color = "lime"
        font = ["Nowhere", "DejaVu Serif"]
        halo = 0
        """,
    )
    drawn = styled(page(), file)
    ball, land, cells, limb, coast, dots, label, _ = drawn.items
    green = (0.0, 1.0, 0.0, 1.0)
    assert drawn.background == (0.0, 0.0, 0.0, 1.0)
    assert ball.color == green
    assert land.colors.tolist() == [[0.0, 1.0, 0.0, 0.5]]
    assert cells.colors.tolist() == page().items[2].colors.tolist()  # several colours say something
    assert (limb.color, limb.width) == (green, pytest.approx(72 / 25.4))
    assert (coast.color, coast.width) == (RED, 3.0)
    assert (dots.radius, dots.color, dots.rim, dots.rim_width) == (4.5, RED, (1.0, 1.0, 1.0, 1.0), 1.0)
    assert (label.size, label.color, label.halo) == (12.0, green, 0.0)
    assert label.font == ("Nowhere", "DejaVu Serif")
    assert page().background == (1.0, 1.0, 1.0, 1.0)


def test_an_empty_file_changes_nothing_and_dark_comes_first(tmp_path):
    assert page_arrays(StyleSheet.of_file(write(tmp_path, ""))(page())).keys() == page_arrays(page()).keys()
    dark = styled(page(), write(tmp_path, '[fills]\nball = "lime"'), "dark")
    assert dark.background == styled(page(), "dark").background
    assert dark.items[0].color == (0.0, 1.0, 0.0, 1.0)
    assert dark.items[3].color == styled(page(), "dark").items[3].color
    both = styled(page(), "dark", str(write(tmp_path, 'background = "navy"')))
    assert both.background == (0.0, 0.0, 128 / 255, 1.0)
    assert both.items[3].color == dark.items[3].color


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a = ", "mine.toml: is not TOML"),
        ("colour = 1", "mine.toml: colour is not a key of styles; give background, fills, lines, dots, labels"),
        ("lines.coast.widht = 1", "mine.toml: lines.coast.widht is not a key of styles; give color, width"),
        ("lines.coast.width = -1", "mine.toml: lines.coast.width is -1"),
        ("lines.coast.width = '1 ell'", "mine.toml: lines.coast.width is '1 ell'; give a length with a unit"),
        ("lines.coast = 1", "mine.toml: lines.coast is 1, but must be a table, such as [lines.coast]"),
        ("fills.land = 'grass'", "mine.toml: fills.land is 'grass', which is not a colour"),
        ("labels.size = 0", "mine.toml: labels.size is 0"),
        ("labels.font = 'Nowhere'", "mine.toml: labels.font is 'Nowhere', which this machine does not have"),
        ("labels.font = 5", "mine.toml: labels.font is 5; give a family"),
        ("dots = []", "mine.toml: dots is [], but must be a table"),
        ("background = [1, 2]", "mine.toml: background is [1, 2], which is not a colour"),
    ],
)
def test_what_is_wrong_is_said_with_file_and_key(text, message, tmp_path):
    with pytest.raises(ValueError, match=re.escape(message)):
        styled(page(), write(tmp_path, text))


def test_lengths_and_what_is_none():
    lengths = {2.5: 2.5, "10": 10, "10pt": 10, "1in": 72, "25.4 mm": 72, "2.54CM": 72, " 1e1 mm ": 28.3465}
    assert [as_length(length, "width") for length in lengths] == pytest.approx([*lengths.values()], rel=1e-5)
    for length in ("", "cm", "1 ell", "-1cm", "0mm", "1.2.3cm", "1cm2", 0, -1, np.nan, np.inf):
        with pytest.raises(ValueError, match=r"^width is "):
            as_length(length, "width")


def test_the_file_of_the_page_on_drawing(tmp_path):
    """Colours with opacity, too."""
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    drawn = styled(page(), write(tmp_path, text))
    assert drawn.items[4].width == 0.6
    assert StyleSheet.of_file(tmp_path / "mine.toml").looks["lines"]["graticule"]["color"][3] == 64 / 255


def test_the_order_of_names_and_files_does_not_matter(tmp_path):
    file = write(tmp_path, '[fills]\nball = "lime"')
    one, other = page_arrays(styled(page(), "dark", file)), page_arrays(styled(page(), file, "dark"))
    assert one.keys() == other.keys()
    for key, value in one.items():
        np.testing.assert_array_equal(value, other[key])
    assert styled(page(), file, "dark").background == pytest.approx(GROUND, abs=1e-3)
    before = page()
    assert styled(before) is before


def draw(number):
    return page() if number else np.zeros((2, 2, 3), dtype=np.uint8)


def test_what_draws_in_a_style_can_be_sent_to_other_processes():
    sent = pickle.loads(pickle.dumps(StyledDraw(draw, ("dark",))))
    assert sent(1).background == styled(page(), "dark").background
    with pytest.raises(TypeError, match="draw gives ndarray, which cannot be styled; let it return a Page"):
        sent(0)
    with pytest.raises(ValueError, match="style is 'bright'"):
        StyledDraw(draw, ("bright",))
