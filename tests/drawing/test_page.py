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
        if not found or found[-1] is not names["page"]:
            found.append(names["page"])
    return found


def test_the_examples_draw_what_they_say(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene, sketch, legend, slide, globe, titled = pages()
    [bubble] = [item for item in scene.items if isinstance(item, Fill) and item.name == "bubble"]
    assert isinstance(bubble.ball, Ball)
    assert [label.text for label in scene.labels] == ["a site"]
    assert [item.name for item in sketch.items if not isinstance(item, Label)][:3] == ["circle", "axis", "angle"]
    assert [label.text for label in sketch.labels] == ["$R$"]
    assert [label.text for label in legend.labels] == ["Delaunay triangulation", "sites"]
    # On a slide labels are placed again, and come last.
    assert sorted(item.name for item in slide.items) == sorted(item.name for item in legend.items)
    assert {"legend-delaunay", "legend-sites"} < {item.name for item in slide.items}
    assert slide.width / slide.height == pytest.approx(33.87 / 19.05)
    assert slide.background[0] < 0.1
    amounts = [item for item in globe.items if isinstance(item, Dots)]
    assert [round(item.radius**2, 9) for item in amounts] == [11.2, 6.1, 6.8]
    assert [item.text for item in globe.items if isinstance(item, Label)] == ["11.2", "6.1", "6.8"]
    assert (titled.items, titled.title) == (globe.items, "Three capitals")
