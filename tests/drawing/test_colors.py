"""What is taken for a colour, checked at the door, and scales from numbers to colours with their legends."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib import colormaps
from matplotlib.colors import to_rgba

from stereodel.drawing import ColorScale, DotStyle, LineStyle, Page
from stereodel.drawing.page import Fill, Label, Stroke
from stereodel.drawing.page.colors import as_color, as_colors

shares = st.floats(0, 1)


@pytest.mark.parametrize(
    "value",
    ["tab:red", "#abc", "#aabbcc80", "0.5", "C1", "xkcd:sky blue", ("red", 0.25), ((0.1, 0.2, 0.3), 0.5), "none"],
)
def test_words_are_matplotlibs(value):
    assert as_color(value) == to_rgba(value)


@given(st.lists(shares, min_size=3, max_size=4))
def test_numbers_are_taken_as_they_are_and_are_opaque_by_default(numbers):
    expected = (*numbers, 1.0)[:4]
    for given_as in (tuple(numbers), numbers, np.array(numbers)):
        found = as_color(given_as)
        assert found == expected
        assert all(type(part) is float for part in found)


NONE = r"(?s)ink is .*, which is not a colour; give a name such as"
BEYOND = r"ink is \(.*\); red, green, blue and opacity must be in \[0, 1\]"


@pytest.mark.parametrize(
    ("value", "message"),
    [
        *((value, NONE) for value in ("sky", "", "1.5", 3, None, np.eye(3), ("red", 2.0), (None, 0.1, 0.2))),
        *(((0.5,) * count, NONE) for count in (2, 5)),
        *((value, BEYOND) for value in ((255, 0, 0), (0.1, -0.1, 0.2), (0.1, 0.2, 0.3, 1.5), (np.nan, 0.0, 0.0))),
    ],
)
def test_what_is_no_colour_is_named(value, message):
    with pytest.raises(ValueError, match=message):
        as_color(value, "ink")


def test_styles_take_any_colour():
    assert LineStyle("k", 1.0) == LineStyle((0.0, 0.0, 0.0, 1.0), 1.0)
    assert DotStyle("w", 2.0, rim="#000", rim_width=0.5).rim == (0.0, 0.0, 0.0, 1.0)
    with pytest.raises(ValueError, match="rim is 'sky'"):
        DotStyle("k", 1.0, "sky")
    with pytest.raises(ValueError, match="width"):
        LineStyle("k", -1.0)


@pytest.mark.parametrize("one", ["tab:red", "0.5", ("red", 0.25), (0.1, 0.2, 0.3), np.array([0.1, 0.2, 0.3, 0.4])])
def test_one_colour_is_that_of_all(one):
    np.testing.assert_array_equal(as_colors(one, 4), [as_color(one)] * 4)
    assert as_colors(one, 0).shape == (0, 4)


def test_colours_of_each_are_opaque_by_default():
    rows = np.linspace(0, 1, 12).reshape(4, 3)
    np.testing.assert_array_equal(as_colors(rows, 4), [as_color(row) for row in rows])
    with_opacity = np.linspace(0, 1, 16).reshape(4, 4)
    np.testing.assert_array_equal(as_colors(with_opacity.tolist(), 4), with_opacity)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (np.zeros((3, 3)), r"cells must have shape \(4, 3\) or \(4, 4\), got \(3, 3\)"),
        (np.zeros((4, 5)), "cells must have shape"),
        (np.full((4, 3), 200.0), r"cells must be in \[0, 1\]; divide"),
        (-np.ones((4, 3)), r"cells must be in \[0, 1\]"),
        ("no colour", "cells is 'no colour', which is not a colour"),
    ],
)
def test_wrong_colours_are_named(values, message):
    with pytest.raises(ValueError, match=message):
        as_colors(values, 4, "cells")


def test_linear_and_logarithmic_places():
    values = [1.0, 10.0, 100.0, 1000.0]
    np.testing.assert_allclose(
        ColorScale("viridis", 1.0, 1000.0, log=True).place(values), [0, 1 / 3, 2 / 3, 1], atol=1e-15
    )
    np.testing.assert_allclose(ColorScale("viridis", 0.0, 1000.0).place([0.0, 250.0, 2000.0, -1.0]), [0, 0.25, 1, 0])


def test_colours_are_matplotlibs():
    found = ColorScale("magma", -1.0, 1.0)(np.linspace(-1, 1, 20).reshape(4, 5))
    np.testing.assert_array_equal(found, colormaps["magma"](np.linspace(-1, 1, 20).reshape(4, 5) / 2 + 0.5)[..., :3])


def test_zero_gets_the_first_colour_of_a_logarithmic_scale():
    scale = ColorScale("inferno", 0.1, 10.0, log=True)
    assert np.array_equal(scale(0.0), scale(0.1))


def test_legend():
    scale = ColorScale("cividis", 1.0, 100.0, log=True)
    items = scale.legend((1.0, 2.0), (4.0, 0.5), {1.0: "one", 10.0: "ten", 100.0: "hundred"}, title="size")
    assert [item.text for item in items if isinstance(item, Label)] == ["one", "ten", "hundred", "size"]
    assert [item.path[0, 0, 0] for item in items if isinstance(item, Stroke)] == [1.0, 3.0, 5.0]
    assert {type(item) for item in items} == {Fill, Stroke, Label}
    picture = Page((1.0, 5.0, 2.0, 2.5), items, width=400.0).pixels(size=400, text=False, renderer="agg")
    shown = scale(10 ** (2 * (np.arange(400) + 0.5) / 400))
    assert np.abs(picture[25] / 255 - shown).max() < 0.02


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("sunset", 0.0, 1.0), "name is 'sunset', which is not a colour map of matplotlib"),
        (("viridis", 1.0, 1.0), "high is 1.0"),
        (("viridis", 0.0, 1.0, True), "low is 0.0"),
        (("viridis", np.nan, 1.0), "low is nan"),
    ],
)
def test_refused_scales(arguments, message):
    with pytest.raises(ValueError, match=message):
        ColorScale(*arguments)
