"""Scales from numbers to colours, and their legends."""

import numpy as np
import pytest
from matplotlib import colormaps

from stereodel.drawing import ColorScale, Page
from stereodel.drawing.page import Fill, Label, Stroke


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
