"""Styles in files: what they change, what they leave, and what is wrong in them, by file and key."""

import re
from pathlib import Path

import numpy as np
import pytest

from stereodel.drawing import styled
from stereodel.drawing.lengths import as_length
from stereodel.drawing.style_files import PageStyle
from tests.drawing.pages import RED, page

PAGE = (Path(__file__).parents[2] / "docs" / "drawing.md").read_text(encoding="utf-8")


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


def test_an_empty_file_changes_nothing_and_a_base_comes_first(tmp_path):
    assert PageStyle.of_file(write(tmp_path, ""))(page()).arrays().keys() == page().arrays().keys()
    dark = styled(page(), write(tmp_path, 'base = "dark"\n[fills]\nball = "lime"'))
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
        ("colour = 1", "mine.toml: colour is not a key of styles; give base, background, fills, lines, dots, labels"),
        ("lines.coast.widht = 1", "mine.toml: lines.coast.widht is not a key of styles; give color, width"),
        ("lines.coast.width = -1", "mine.toml: lines.coast.width is -1"),
        ("lines.coast.width = '1 ell'", "mine.toml: lines.coast.width is '1 ell'; give a length with a unit"),
        ("lines.coast = 1", "mine.toml: lines.coast is 1, but must be a table, such as [lines.coast]"),
        ("fills.land = 'grass'", "mine.toml: fills.land is 'grass', which is not a colour"),
        ("labels.size = 0", "mine.toml: labels.size is 0"),
        ("labels.font = 'Nowhere'", "mine.toml: labels.font is 'Nowhere', which this machine does not have"),
        ("dots = []", "mine.toml: dots is [], but must be a table"),
        ("base = 'bright'", "style is 'bright'"),
        ("background = [1, 2]", "mine.toml: background is [1, 2], which is not a colour"),
    ],
)
def test_what_is_wrong_is_said_with_file_and_key(text, message, tmp_path):
    with pytest.raises(ValueError, match=re.escape(message)):
        styled(page(), write(tmp_path, text))


LENGTHS = {2.5: 2.5, "10": 10, "10pt": 10, "1in": 72, "25.4 mm": 72, "2.54CM": 72, " 1e1 mm ": 28.3465}


@pytest.mark.parametrize(("given", "points"), LENGTHS.items())
def test_lengths(given, points):
    assert as_length(given, "width") == pytest.approx(points, rel=1e-5)


@pytest.mark.parametrize("given", ["", "cm", "1 ell", "-1cm", "0mm", "1.2.3cm", "1cm2", 0, -1, np.nan, np.inf])
def test_what_is_no_length(given):
    with pytest.raises(ValueError, match=r"^width is "):
        as_length(given, "width")


def test_the_file_of_the_page_on_drawing(tmp_path):
    """Colours with opacity, too."""
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    drawn = styled(page(), write(tmp_path, text))
    assert drawn.items[4].width == 0.6
    assert PageStyle.of_file(tmp_path / "mine.toml").lines["graticule"]["color"][3] == 64 / 255
