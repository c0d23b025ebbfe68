"""The pages of the documentation that draw: their code runs in order, prints what stands there, writes its files."""

import re

import matplotlib.pyplot as plt
import numpy as np
import pytest

from stereodel.drawing.page import Dots, Fill, Label
from tests.figures.scripts import FOLDER
from tools.baselines import read_picture
from tools.pictures import globe_of_the_readme

DOCS = FOLDER.parent / "docs"


def run(page, folder, monkeypatch, capsys, smaller=()):
    """What the examples of a page leave: their names after each of them. What they print is compared."""
    monkeypatch.chdir(folder)
    names, after = {}, []
    for kind, code in re.findall(r"```(python|text)\n(.*?)```", (DOCS / page).read_text(encoding="utf-8"), re.DOTALL):
        if kind == "text":
            assert capsys.readouterr().out.rstrip() == code.rstrip()
            continue
        for number, other in smaller:
            code = code.replace(number, other)
        exec(compile(code, page, "exec"), names)
        after.append(dict(names))
    plt.close("all")
    return after


def test_drawing(tmp_path, monkeypatch, capsys):
    found = {id(names["page"]): names["page"] for names in run("drawing.md", tmp_path, monkeypatch, capsys)}
    scene, sketch, legend, valued, dark, globe, titled = found.values()
    assert [item.name for item in scene.items if isinstance(item, Fill) and item.ball] == ["ball", "bubble"]
    assert [[label.text for label in page.labels] for page in (scene, sketch)] == [["a site"], ["$R$"]]
    assert [label.text for label in legend.labels] == ["Delaunay triangulation", "sites"]
    assert [item.name for item in dark.items] == [item.name for item in valued.items]
    assert dark.background[0] < 0.1
    assert [round(item.radius**2, 9) for item in globe.items if isinstance(item, Dots)] == [11.2, 6.1, 6.8]
    assert [item.text for item in globe.items if isinstance(item, Label)] == ["11.2", "6.1", "6.8"]
    assert (titled.items, titled.title) == (globe.items, "Three capitals")


@pytest.mark.thorough
def test_globes(tmp_path, monkeypatch, capsys):
    *_, names = run("globes.md", tmp_path, monkeypatch, capsys)
    written = {"paris.png", "cities.svg", "marble.png", "airports.svg", "halves.pdf", "paper.png"}
    assert {path.name for path in tmp_path.iterdir()} == written
    assert len(names["page"].views) == 3


def test_rasters(tmp_path, monkeypatch, capsys):
    *_, names = run("rasters.md", tmp_path, monkeypatch, capsys, [("1200", "120"), ("512", "64")])
    assert [path.name for path in tmp_path.iterdir()] == ["paris.png"]
    assert [names[name].shape[:-1] for name in ("pixels", "faces")] == [(120, 120), (6, 64, 64)]


@pytest.mark.thorough
def test_map_libraries(tmp_path, monkeypatch, capsys):
    run("map_libraries.md", tmp_path, monkeypatch, capsys)
    pictures = re.findall(r"\{image\} images/(\S+)", (DOCS / "map_libraries.md").read_text(encoding="utf-8"))
    assert pictures
    assert all((tmp_path / name).is_file() and (DOCS / "images" / name).is_file() for name in pictures)


@pytest.mark.thorough
def test_the_globe_of_the_readme(tmp_path, monkeypatch):
    """The picture beside the code is what the code draws."""
    monkeypatch.chdir(tmp_path)
    exec(compile(globe_of_the_readme(), "README.md", "exec"), {})
    assert [path.name for path in tmp_path.iterdir()] == ["new_york.png"]
    drawn, shown = (read_picture(path / "new_york.png").astype(int) for path in (tmp_path, DOCS / "images"))
    assert drawn.shape == shown.shape
    # Renderers of OpenGL round differently at the edges of lines.
    assert (np.abs(drawn - shown).max(axis=-1) > 8).mean() < 1e-3
    assert 'src="docs/images/new_york.png"' in (DOCS.parent / "README.md").read_text(encoding="utf-8")
