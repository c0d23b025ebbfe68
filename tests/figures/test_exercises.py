"""The exercises: each change is made to its script, and what comes out is compared with the answer."""

import re

import numpy as np
import pytest

from stereodel.sphere import angular_distance
from tests.figures.scripts import FOLDER, arc_points, geometry
from tests.figures.test_captions import hidden_up_to
from tests.tiers import by_day

QUESTIONS, ANSWERS = (FOLDER.parent / "docs" / "exercises.md").read_text(encoding="utf-8").split("## Answers")


def strays(g):
    """How far images of edges stray from the edges between the images, in lengths of these."""
    a, b = np.moveaxis(g["sites"][g["edges"]] @ [1, 1j], 1, 0)
    return np.abs(((g["middles"] @ [1, 1j] - a) / (b - a)).imag).max()


TRUE = {
    1: lambda g: [len(g["edges"])],
    2: lambda g: [len(g["edges"]), len(g["vertices"])],
    3: lambda g: [np.degrees(np.arccos(g["circle"][3]))],
    4: lambda g: [strays(g)],
    5: lambda g: [(g["kinds"][2] == 3).sum(), (g["kinds"][2] == 2).sum()],
    6: lambda g: [g["extents"][2]],
    7: lambda g: [g[f"{name}_broken"].sum() for name in ("Mercator", "equal-area")],
    8: lambda g: [angular_distance(g["hemisphere_points"][1], [0, 0, -1])],
    9: lambda g: [(arc_points(g["fine_2"])[..., 2] < 0).any(axis=1).sum(), hidden_up_to(8)],
    10: lambda g: [(g["stretched_angles"] < 10).sum(), np.degrees(np.arccos(1 / 4))],
}
"""The numbers of each answer, from the geometry that the changed script draws."""


def agree(text, true):
    """Whether numbers in bold type are those: exactly, or to the last of their decimals."""
    for written, value in zip(re.findall(r"\*\*([\d.]+)\*\*", text), true, strict=False):
        _, point, decimals = written.partition(".")
        assert float(written) == pytest.approx(value, abs=0.5 * 10.0 ** -len(decimals) if point else 1e-6)
    return text.count("**") // 2


@pytest.mark.parametrize("number", by_day(list(TRUE), 1, 6))
def test_an_answer_is_what_comes_out(number, monkeypatch):
    (question,) = re.findall(rf"^### {number}\. (.*?)(?=^### |\Z)", QUESTIONS, re.MULTILINE | re.DOTALL)
    (answer,) = re.findall(rf"^{number}\. (.*?)(?=^\d+\. |\Z)", ANSWERS, re.MULTILINE | re.DOTALL)
    (name,) = re.findall(r"`figures/(\w+)\.py`", question)
    old, new = re.search(r"```diff\n-(.*)\n\+(.*)\n```", question).groups()
    script = FOLDER / f"{name}.py"
    lines = script.read_text(encoding="utf-8").split("\n")
    assert lines.count(old) == 1
    assert f"gallery/{name}>" in question
    monkeypatch.syspath_prepend(str(FOLDER))
    module = {"__name__": name, "__file__": str(script)}
    exec(compile("\n".join(new if line == old else line for line in lines), str(script), "exec"), module)
    true = TRUE[number](module["FIGURE"].geometry())
    assert agree(answer, true) == len(true)
    assert agree(question, TRUE[number](geometry(name))) == (number in (1, 3, 4)) + 2 * (number == 7) + (number == 10)


def test_there_are_ten():
    assert [int(number) for number in re.findall(r"^### (\d+)\.", QUESTIONS, re.MULTILINE)] == list(TRUE)
    assert [int(number) for number in re.findall(r"^(\d+)\.", ANSWERS, re.MULTILINE)] == list(TRUE)
    assert len(TRUE) == 10
