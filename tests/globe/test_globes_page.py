"""The page on globes says what is so: its code runs in order, prints what stands there, and writes its files."""

import re
from pathlib import Path

import numpy as np

from tools.image import read_picture
from tools.readme_images import globe_of_the_readme

IMAGES = Path(__file__).parents[2] / "docs" / "images"
PAGE = (Path(__file__).parents[2] / "docs" / "globes.md").read_text(encoding="utf-8")
README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


def test_the_code_of_the_page(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    for code in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL):
        exec(compile(code, "globes.md", "exec"), names)
    (printed,) = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)
    assert capsys.readouterr().out == printed
    written = {"paris.png", "marble.png", "airports.svg", "halves.pdf", "paper.png"}
    assert {path.name for path in tmp_path.iterdir()} == written
    assert len(names["page"].views) == 3


def test_the_globe_of_the_readme(tmp_path, monkeypatch):
    """The picture beside the code is what the code draws."""
    monkeypatch.chdir(tmp_path)
    exec(compile(globe_of_the_readme(), "README.md", "exec"), {})
    assert [path.name for path in tmp_path.iterdir()] == ["new_york.png"]
    drawn, shown = (read_picture(folder / "new_york.png").astype(int) for folder in (tmp_path, IMAGES))
    assert drawn.shape == shown.shape
    # Renderers of OpenGL round differently at the edges of lines.
    assert (np.abs(drawn - shown).max(axis=-1) > 8).mean() < 1e-3
    assert 'src="docs/images/new_york.png"' in README
