"""What is taken for a colour, checked at the door."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_rgba

from stereodel.drawing import ColorScale, DotStyle, LineStyle
from stereodel.drawing.page.colors import as_color, as_colors
from tests.refused import refused


@pytest.mark.parametrize(
    "value",
    ["tab:red", "#abc", "#aabbcc80", "0.5", "C1", "xkcd:sky blue", ("red", 0.25), ((0.1, 0.2, 0.3), 0.5), "none"],
)
def test_words_are_matplotlibs(value):
    assert as_color(value) == to_rgba(value)


@given(st.lists(st.floats(0, 1), min_size=3, max_size=4))
def test_numbers_are_taken_as_they_are_and_are_opaque_by_default(numbers):
    expected = (*numbers, 1.0)[:4]
    for given_as in (tuple(numbers), numbers, np.array(numbers)):
        found = as_color(given_as)
        assert found == expected
        assert all(type(part) is float for part in found)


NONE = r"(?s)ink is .*, which is not a colour; give a name such as"
BEYOND = r"ink is \(.*\); red, green, blue and opacity must be in \[0, 1\]"


test_what_is_no_colour_or_scale_is_named = refused(
    *((as_color, (v, "ink"), NONE) for v in ("sky", "", "1.5", 3, None, np.eye(3), ("red", 2.0), (None, 0.1, 0.2))),
    *((as_color, ((0.5,) * count, "ink"), NONE) for count in (2, 5)),
    *(
        (as_color, (value, "ink"), BEYOND)
        for value in ((255, 0, 0), (0.1, -0.1, 0.2), (0.1, 0.2, 0.3, 1.5), (np.nan, 0.0, 0.0))
    ),
    (as_colors, (np.zeros((3, 3)), 4, "cells"), r"cells must have shape \(4, 3\) or \(4, 4\), got \(3, 3\)"),
    (as_colors, (np.zeros((4, 5)), 4, "cells"), "cells must have shape"),
    (as_colors, (np.full((4, 3), 200.0), 4, "cells"), r"cells must be in \[0, 1\]; divide"),
    (as_colors, (-np.ones((4, 3)), 4, "cells"), r"cells must be in \[0, 1\]"),
    (as_colors, ("no colour", 4, "cells"), "cells is 'no colour', which is not a colour"),
    (DotStyle, ("k", 1.0, "sky"), "rim is 'sky'"),
    (LineStyle, ("k", -1.0), "width"),
    (ColorScale, ("sunset", 0.0, 1.0), "colors is 'sunset', which is not a colour map of matplotlib"),
    (ColorScale, ("viridis", 1.0, 1.0), "high is 1.0"),
    (ColorScale, ("viridis", 0.0, 1.0, "log"), "low is 0.0"),
    (ColorScale, ("viridis", np.nan, 1.0), "low is nan"),
    call=lambda make, arguments: make(*arguments),
)


def test_colours_of_all_and_of_each():
    """Opaque by default; a colour alone is that of all."""
    for one in ("tab:red", "0.5", ("red", 0.25), (0.1, 0.2, 0.3), np.array([0.1, 0.2, 0.3, 0.4])):
        np.testing.assert_array_equal(as_colors(one, 4), [as_color(one)] * 4)
        assert as_colors(one, 0).shape == (0, 4)
    rows = np.linspace(0, 1, 12).reshape(4, 3)
    np.testing.assert_array_equal(as_colors(rows, 4), [as_color(row) for row in rows])
    with_opacity = np.linspace(0, 1, 16).reshape(4, 4)
    np.testing.assert_array_equal(as_colors(with_opacity.tolist(), 4), with_opacity)
    assert LineStyle("k", 1.0) == LineStyle((0.0, 0.0, 0.0, 1.0), 1.0)
    assert DotStyle("w", 2.0, rim="#000", rim_width=0.5).rim == (0.0, 0.0, 0.0, 1.0)
