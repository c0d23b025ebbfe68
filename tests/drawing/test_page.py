"""The examples of docs/drawing.md make the pages that the text tells of."""

import re
from pathlib import Path

import pytest

from stereodel.drawing.page import Ball, Dots, Fill, Label

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "drawing.md").read_text(encoding="utf-8")


def pages():
    """What is called `page` after each example; the examples are run in one go, as a reader would."""
    names = {}
    found = []
    for code in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL):
        exec(compile(code, "docs/drawing.md", "exec"), names)
        found.append(names["page"])
    return found


def test_the_examples_draw_what_they_say():
    scene, solid, sketch, slide, globe = pages()
    assert solid is scene
    [bubble] = [item for item in scene.items if isinstance(item, Fill) and item.name == "bubble"]
    assert isinstance(bubble.ball, Ball)
    assert [label.text for label in scene.labels] == ["a site"]
    assert [item.name for item in sketch.items] == ["circle", "axis", "angle"]
    assert [item.name for item in slide.items] == ["circle", "axis", "angle"]
    assert slide.width / slide.height == pytest.approx(33.87 / 19.05)
    assert slide.background[0] < 0.1
    amounts = [item for item in globe.items if isinstance(item, Dots)]
    assert [round(item.radius**2, 9) for item in amounts] == [11.2, 6.1, 6.8]
    assert [item.text for item in globe.items if isinstance(item, Label)] == ["11.2", "6.1", "6.8"]
