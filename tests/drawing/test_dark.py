"""Colours on a dark ground: hue and contrast are kept, and what is measured is what others measure."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.drawing import style
from stereodel.drawing.colorimetry import contrast, luminance, to_oklab, with_luminance
from stereodel.drawing.page_styles import GROUND, dark_color, dark_page
from tests.drawing.pages import RED
from tests.drawing.pages import page as one_of_each

shares = st.floats(0, 1)
colors = st.tuples(shares, shares, shares)


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
    page = one_of_each()
    fill, polygons, several, stroke, lines, dots, label, picture = dark_page(page).items
    expected = dark_color(RED)
    for found in (fill.color, *polygons.colors, several.colors[0], stroke.color, lines.color, dots.color, label.color):
        np.testing.assert_allclose(found, expected)
    for found in (dots.rim, label.halo_color, dark_page(page).background):
        np.testing.assert_allclose(found, GROUND, atol=1e-3)
    assert picture is page.items[-1]
    assert fill.ball == page.items[0].ball
    # Nothing but colours changes.
    for before, after in zip(page.items, dark_page(page).items, strict=True):
        changed = {key for key, value in vars(before).items() if np.any(value != vars(after).get(key, value))}
        assert changed <= {"color", "rim", "halo_color", "colors", "by_color"}


def test_a_dark_page_stays_as_it_is():
    page = one_of_each()
    night = replace(page, background=(0.05, 0.05, 0.2, 1.0))
    assert dark_page(night) is night
    assert dark_page(dark_page(page)).items[0].color == dark_page(page).items[0].color
