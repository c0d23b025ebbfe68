"""Legends: rows below a picture, in points, whatever the unit of the page."""

from dataclasses import replace

import numpy as np
import pytest

from stereodel.drawing import (
    Dots,
    DotStyle,
    Fill,
    Label,
    LineStyle,
    Page,
    Polygons,
    Polylines,
    Stroke,
    styled,
    with_legend,
)
from stereodel.drawing.scene.legend import GAP, ROW, SAMPLE

LINE, DASHES, DOT = LineStyle("red", 0.7), LineStyle("blue", 1.0, (3.0, 2.0)), DotStyle("green", 2.0, "black", 0.5)
ENTRIES = {"lines": LINE, "dashes": DASHES, "dots": DOT, "tint": "orange", "more": LINE}


@pytest.fixture(params=[1.0, 0.02])
def page(request):
    """A page 100 points wide and 50 high, in two units."""
    unit = request.param
    extent = (-1.0 * unit, 3.0 * unit, 5.0 * unit, 7.0 * unit)
    return Page(
        extent, (Label("picture", (0.0, 0.0)),), width=100.0, background=(0.9, 0.9, 1.0, 1.0), views=(np.eye(3),)
    )


def in_points(page, xy):
    """From the upper left corner of a page to the right and down."""
    left, _, _, top = page.extent
    return (np.asarray(xy) - [left, top]) * page.points_per_unit * [1, -1]


def test_the_picture_stays_and_the_page_grows_downwards_by_its_rows(page):
    grown = with_legend(page, ENTRIES, columns=2, size=10.0)
    assert grown.items[0] is page.items[0]
    assert (grown.width, grown.background, grown.views) == (page.width, page.background, page.views)
    assert grown.points_per_unit == pytest.approx(page.points_per_unit)
    assert np.array_equal(np.delete(grown.extent, 2), np.delete(page.extent, 2))
    assert grown.height == pytest.approx(50 + 10 * ROW * 3.5)


def test_entries_are_read_row_by_row(page):
    grown = with_legend(page, ENTRIES, columns=2, indent=8.0, size=10.0, ink="navy")
    words = grown.labels[1:]
    assert [label.text for label in words] == list(ENTRIES)
    row = 10 * ROW
    expected = [(8 + 42 * column, 50 + row * (down + 1)) for down in range(3) for column in range(2)][:5]
    assert np.allclose([in_points(grown, label.anchor) for label in words], expected)
    assert {label.offset for label in words} == {(SAMPLE[0] + GAP, 0.0)}
    assert {(label.align, label.valign, label.size) for label in words} == {("left", "center", 10.0)}
    assert {label.color for label in words} == {(0.0, 0.0, 128 / 255, 1.0)}


def test_samples_look_as_what_they_stand_for(page):
    grown = with_legend(page, ENTRIES, size=10.0)
    line, dashes, dots, tint, _ = [item for item in grown.items if not isinstance(item, Label)]
    assert (line.color, line.width, line.dash) == (LINE.color, LINE.width, None)
    assert (dashes.color, dashes.dash) == (DASHES.color, DASHES.dash)
    assert (dots.radius, dots.color, dots.rim, dots.rim_width) == (DOT.radius, DOT.color, DOT.rim, DOT.rim_width)
    assert tint.color == pytest.approx((1.0, 165 / 255, 0.0, 1.0))
    # All of one length, at the height of their words.
    length, height = SAMPLE
    anchors = [in_points(grown, label.anchor) for label in grown.labels[1:]]
    assert np.allclose(in_points(grown, line.path[0, [0, 3]]), [anchors[0], anchors[0] + [length, 0]])
    assert np.allclose(in_points(grown, dots.centers), [anchors[2] + [length / 2, 0]])
    corners = in_points(grown, tint.paths[0][:, 0])
    assert np.allclose(
        [corners.min(axis=0), corners.max(axis=0)], anchors[3] + [[0, -height / 2], [length, height / 2]]
    )


def test_errors_say_what_is_wrong(page):
    with pytest.raises(ValueError, match="columns is 0, but must be at least 1"):
        with_legend(page, ENTRIES, columns=0)
    with pytest.raises(ValueError, match="no colour"):
        with_legend(page, {"x": "no colour"})


def test_samples_follow_what_they_explain_in_every_style(page, tmp_path):
    """They are named after what looks like them; what only resembles it, in width or in dashes, is another thing."""
    line = np.array([[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]])
    picture = (
        Stroke(line, LINE.color, LINE.width, name="coast"),
        Polylines(line[0], np.array([0, 4]), LINE.color, 2 * LINE.width, "roads"),
        Dots(line[0], DOT.radius, DOT.color, DOT.rim, DOT.rim_width, "sites"),
        Fill((line,), (1.0, 165 / 255, 0.0, 1.0), "land"),
        Polygons(line[0], np.array([0, 4]), np.array([0]), np.array([[0.0, 0.0, 1.0, 1.0]]), name="lakes"),
    )
    entries = ENTRIES | {"wide": LINE.scaled(2), "water": "blue"}
    told = with_legend(replace(page, items=picture), entries, columns=2)
    samples = {item.name: item for item in told.items[len(picture) :] if not isinstance(item, Label)}
    assert list(samples) == ["legend-coast", "legend", "legend-sites", "legend-land", "legend-roads", "legend-lakes"]
    file = tmp_path / "own.toml"
    file.write_text(
        "[lines]\ncoast = {color = 'lime', width = 3.0}\nroads = {width = 0.1}\n"
        "[dots.sites]\ncolor = 'red'\nradius = 1.0\n[fills]\nland = 'gold'\nlakes = 'navy'\n"
    )
    for styles in ((), ("dark",), (file,), ("dark", file)):
        items = {item.name: item for item in styled(told, *styles).items if not isinstance(item, Label)}
        for name in ("coast", "roads", "sites", "land", "lakes"):
            assert looks(items[f"legend-{name}"]) == looks(items[name]), (styles, name)
    assert looks(items["coast"]) == ((0.0, 1.0, 0.0, 1.0), 3.0)


def looks(item):
    """Colours and sizes of an item."""
    match item:
        case Polygons():
            return tuple(item.colors[0].tolist())
        case Fill():
            return item.color
        case Dots():
            return item.color, item.radius, item.rim, item.rim_width
        case _:
            return item.color, item.width
