"""Pages for a column and a slide, and several styles at once."""

import pickle

import numpy as np
import pytest

from stereodel.drawing import Page, Sketch, styled
from stereodel.drawing.label import label_box
from stereodel.drawing.page import Dots, Label, Stroke
from stereodel.drawing.page_styles import GROUND, StyledDraw, dark_page
from stereodel.drawing.style import BLACK, DotStyle, LineStyle

CM = 72 / 2.54
LONG = "Half of it lies within 100 km of Manhattan, the other half is the rest of the world; every angle is true."


def circle():
    """A circle that fills its page, whose extent is wider."""
    return Sketch().add_circle((0.0, 0.0), 1.0, name="circle", style=LineStyle(BLACK, 1.0, (3.0, 2.0)))


def page(*labels, extent=(-2.0, 2.0, -1.0, 1.0)):
    sketch = circle().add_points([(0.5, 0.0)], name="points", style=DotStyle(BLACK, 2.0, rim_width=0.5))
    return sketch.add_items(labels).page(extent, width=17 * CM)


def boxes(shown):
    return [label_box(label, shown.points_per_unit) for label in shown.labels]


def overlapping(shown):
    found = boxes(shown)
    return [
        (shown.labels[i].text, shown.labels[j].text)
        for i in range(len(found))
        for j in range(i)
        if np.all(np.maximum(found[i][0], found[j][0]) < np.minimum(found[i][1], found[j][1]))
    ]


def outside(shown):
    left, right, bottom, top = np.array(shown.extent) * shown.points_per_unit
    return [
        label.text
        for label, (low, high) in zip(shown.labels, boxes(shown), strict=True)
        if low[0] < left or low[1] < bottom or high[0] > right or high[1] > top
    ]


def test_a_slide_has_its_size_and_the_picture_in_the_middle():
    for extent in ((-2.0, 2.0, -1.0, 1.0), (-1.0, 1.0, -3.0, 3.0), (0.0, 9.0, 0.0, 1.0)):
        slide = styled(page(extent=extent), "slide")
        assert (slide.width, slide.height) == pytest.approx((33.87 * CM, 19.05 * CM))
        (left, right, bottom, top), (a, b, c, d) = slide.extent, extent
        assert ((left + right) / 2, (bottom + top) / 2) == pytest.approx(((a + b) / 2, (c + d) / 2))
        assert left < a < b < right
        assert bottom < c < d < top


def test_what_is_measured_in_points_changes_with_the_medium():
    label = Label("word", (0.0, 0.0), (8.0, 4.0), halo=1.0, size=18.0)
    small, large = styled(page(label), "column"), styled(page(label), "slide")
    share = 8.4 / 17
    stroke, dots, (word,) = small.items[0], small.items[1], small.labels
    assert stroke.width == pytest.approx(share ** (1 / 3))
    assert stroke.dash == pytest.approx((3 * share ** (1 / 3), 2 * share ** (1 / 3)))
    assert (dots.radius, dots.rim_width) == pytest.approx((2 * share ** (1 / 3), 0.5 * share ** (1 / 3)))
    assert (word.size, word.halo, *word.offset) == pytest.approx(np.array([18, 1, 8, 4]) * share ** (1 / 2))
    growth = (33.87 * CM - 48) / page().width
    assert large.items[0].width == pytest.approx(1.25 * growth)
    assert large.labels[0].size == pytest.approx(1.15 * 18 * growth)


def test_long_lines_are_broken_and_the_page_grows():
    left, right, bottom, top = -2.0, 2.0, -1.5, 1.5
    title = Label("A title", (left + 0.1, 1.35), align="left", valign="baseline", size=17.0)
    words = Label(LONG, (left + 0.1, 1.2), align="left", valign="baseline", size=8.5)
    credit = Label(LONG, (left + 0.1, -1.4), align="left", valign="baseline", size=6.0)
    column = styled(page(title, words, credit, extent=(left, right, bottom, top)), "column")
    assert overlapping(column) == outside(column) == []
    texts = [label.text for label in column.labels]
    # From the picture upward, then from it downward: each long line is two or more.
    assert texts[-1 - len(texts) // 2 :] != texts[: len(texts) // 2]
    assert len(texts) >= 5
    downward = sorted(column.labels, key=lambda label: -label_box(label, column.points_per_unit)[1, 1])
    head, foot = ([label for label in downward if side * label.anchor[1] > 0] for side in (1, -1))
    assert head[0].text == "A title"
    assert " ".join(label.text for label in head[1:]) == LONG
    assert " ".join(label.text for label in foot) == LONG
    for label, (low, high) in zip(column.labels, boxes(column), strict=True):
        assert low[1] > column.points_per_unit if label.anchor[1] > 0 else high[1] < -column.points_per_unit
    assert column.height > 8.4 * CM * 3 / 4


def test_spaces_of_a_line_that_is_not_broken_stay():
    spaced = Label("M A R E   N O S T R U M", (0.0, 1.2), size=12.0)
    assert styled(page(spaced, extent=(-2.0, 2.0, -1.5, 1.5)), "column").labels[0].text == spaced.text


def test_type_that_is_clear_of_lines_stays_so():
    """A word left of a vertical line reaches over it in a column, where type is larger beside the picture."""
    line = Sketch().add_segment((0.08, -1.0), (0.08, 1.0), name="axis")
    before = line.add_label((-0.05, 0.0), "a word").page((-2.0, 2.0, -1.0, 1.0), width=17 * CM)
    column = styled(before, "column")
    assert boxes(column)[0][1, 0] <= 0.08 * column.points_per_unit
    assert column.labels[0].offset[0] < 0
    crossed = line.page((-2.0, 2.0, -1.0, 1.0), width=17 * CM)
    on_line = Label("on it", (0.08, 0.0))
    kept = styled(Page(crossed.extent, (*crossed.items[:1], on_line), crossed.width), "column").labels[0]
    assert kept.offset == (0.0, 0.0)


@pytest.mark.parametrize("style", ["column", "slide"])
@pytest.mark.parametrize("halo", [0.0, 1.5])
def test_dots_stay_clear_of_type_and_its_halo(style, halo):
    """A dot that a word is just clear of, beside a line that crosses the word: the line may stay, the dot may not."""
    word = Label("a word", (0.0, 0.0), halo=halo)
    (_, low), (right, _) = label_box(word, 17 * CM / 4)
    rim = 0.5
    radius = 4.0
    at = np.array([right + halo + radius + rim / 2 + 0.05, low]) / (17 * CM / 4)

    def line():
        return Sketch().add_segment((0.0, -1.0), (0.0, 1.0), name="axis")

    dotted = line().add_points([at], name="dot", style=DotStyle(BLACK, radius, rim_width=rim))
    shown = styled(dotted.add_items([word]).page((-2.0, 2.0, -1.0, 1.0), width=17 * CM), style)
    (dot,) = [item for item in shown.items if isinstance(item, Dots)]
    label, unit = shown.labels[0], shown.points_per_unit
    box = label_box(label, unit) + label.halo * np.array([[-1.0], [1.0]])
    away = np.abs(unit * dot.centers[0] - box.mean(axis=0)) - (box[1] - box[0]) / 2
    assert away.max() >= dot.radius + dot.rim_width / 2
    assert label.offset != (0.0, 0.0)
    under = line().add_points([(0.02, 0.0)], name="points").add_items([word])
    assert styled(under.page((-2.0, 2.0, -1.0, 1.0), width=17 * CM), style).labels[0].offset == (0.0, 0.0)


def test_type_turned_is_held_by_its_turned_box():
    upright = Label("a long word upright", (-1.95, 0.0), rotation=90.0)
    column = styled(page(upright), "column")
    assert abs(column.labels[0].offset[0]) < 3
    flat = styled(page(Label("a long word upright", (-1.95, 0.0))), "column")
    assert flat.labels[0].offset[0] > 10
    assert outside(flat) == []


def test_the_order_of_styles_does_not_matter():
    words = page(Label("word", (0.0, 0.0)))
    one, other = styled(words, "slide", "dark").arrays(), styled(words, "dark", "slide").arrays()
    assert one.keys() == other.keys()
    for key, value in one.items():
        np.testing.assert_array_equal(value, other[key])
    assert styled(words, "dark", "slide").background == pytest.approx(GROUND, abs=1e-3)
    assert styled(words) is words
    assert styled(words, "dark").arrays().keys() == dark_page(words).arrays().keys()


def draw(number):
    return page(Label(str(number), (0.0, 0.0))) if number else np.zeros((2, 2, 3), dtype=np.uint8)


def test_what_draws_in_a_style_can_be_sent_to_other_processes():
    sent = pickle.loads(pickle.dumps(StyledDraw(draw, ("slide", "dark"))))
    assert isinstance(sent(1).items[0], Stroke)
    assert isinstance(sent(1).items[1], Dots)
    assert sent(1).width == pytest.approx(33.87 * CM)
    with pytest.raises(TypeError, match="draw gives ndarray, which cannot be styled; let it return a Page"):
        sent(0)
    with pytest.raises(ValueError, match="style is 'bright'"):
        StyledDraw(draw, ("bright",))
