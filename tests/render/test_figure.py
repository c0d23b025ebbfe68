"""Figures: files whole or not at all; scripts that explain themselves; captions in files."""

import ast
import re
import xml.etree.ElementTree as ET
from functools import partial
from pathlib import Path

import imageio.v3 as iio
import numpy as np
import pypdf
import pytest

from stereodel.drawing.page import Dots, Label, Page, Stroke
from stereodel.drawing.page.style import BLACK
from stereodel.render.figure import Figure, caption_of, default_folder, parted
from stereodel.render.pixel_rows import pixel_hash
from tests.images.scripts import SCRIPTS
from tools.build import load_drawing


def geometry():
    return {"centers": np.array([[1.0, 1.0]])}


def draw(g, label="P"):
    items = (Dots(g["centers"], 8.0, BLACK), Label(label, (1.0, 1.5)))
    return Page((0.0, 2.0, 0.0, 2.0), items, width=144.0)


@pytest.fixture
def figure():
    return Figure("small", geometry, draw, renderer="agg")


def test_save_writes_three_files_and_a_record(figure, tmp_path):
    folder = tmp_path / "new" / "folder"
    record = figure.save(folder, size=100)
    assert sorted(path.name for path in folder.iterdir()) == ["small.pdf", "small.png", "small.svg"]
    assert record["files"] == ["small.png", "small.svg", "small.pdf"]
    assert (record["figure"], record["renderer"], record["size"]) == ("small", "agg", 100)
    assert record["seconds"] >= 0
    assert record["pixel_hash"] == pixel_hash(figure.pixels(size=100, text=False))
    figure.save(folder)
    assert iio.imread(folder / "small.png").shape == (600, 600, 3)
    assert iio.immeta(folder / "small.png")["dpi"] == pytest.approx((300, 300), abs=0.1)


def test_text_can_be_left_out_of_all_files(figure, tmp_path):
    figure.main(["--out", str(tmp_path), "--size", "100", "--no-text"])
    assert np.array_equal(iio.imread(tmp_path / "small.png"), figure.pixels(size=100, text=False))
    assert b'id="label"' not in (tmp_path / "small.svg").read_bytes()
    figure.main(["--out", str(tmp_path), "--size", "100", "--text"])
    assert b'id="label"' in (tmp_path / "small.svg").read_bytes()


def test_default_folder_is_beside_that_of_the_script(figure, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    expected = Path(__file__).resolve().parent.parent / "out"
    for each in (figure, Figure("small", geometry, partial(draw, label="Q"), renderer="agg")):
        assert default_folder(each.draw) == expected


def test_a_style_has_a_folder_of_its_own(figure, tmp_path, monkeypatch):
    monkeypatch.setattr("stereodel.render.figure.default_folder", lambda source: tmp_path)
    sheet = tmp_path / "large.toml"
    sheet.write_text("[labels]\nsize = 20\n", encoding="utf-8")
    figure.main(["--size", "100", "--style", f"{sheet},dark"])
    assert sorted(path.name for path in tmp_path.iterdir()) == ["dark-large", "large.toml"]
    picture = iio.imread(tmp_path / "dark-large" / "small.png")
    assert picture[0, 0].tolist() == [18, 18, 18]
    assert np.array_equal(picture, figure.styled("dark", sheet).pixels(size=100))
    assert not np.array_equal(picture, figure.styled("dark").pixels(size=100))
    figure.main(["--size", "100", "--style", "dark", "--out", str(tmp_path / "here")])
    assert (tmp_path / "here" / "small.svg").is_file()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--style", "dark,bright"], "invalid style_names value: 'dark,bright'"),
        *((["--size", size], f"invalid int value: {size!r}") for size in ("many", "1e3")),
        *((["--size", size], f"small: size is {size}") for size in ("0", "-5", "100000")),
        (["--out", "file/folder", "--size", "50"], r"small: .*file"),
    ],
)
def test_bad_options_are_explained(figure, tmp_path, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(SystemExit) as stopped:
        figure.main(["--out", str(tmp_path), *arguments])
    assert stopped.value.code == 2 or re.match(message, stopped.value.code)
    assert stopped.value.code != 2 or message in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


# Captions


DESCRIPTION = (
    "The first paragraph is longer than a line can be, at this width. " * 3 + "\n\nThe second costs $5 — or $6."
)


def page(**fields):
    line = np.linspace([1.0, 1.0], [1.0, -5.0], 4)[None]  # leaves the page below
    items = (Stroke(line, BLACK, 2.0, name="line"), Label("label", (0.5, 0.5)))
    return Page((0.0, 2.0, 0.0, 1.0), items, width=300.0, **{"title": "A title", "description": DESCRIPTION, **fields})


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_each_script_has_a_title_and_a_text(script):
    docstring = ast.get_docstring(ast.parse(script.read_text(encoding="utf-8")))
    title, description = caption_of(script)
    assert title == docstring.splitlines()[0]
    assert len(description) > 80
    assert "``" not in description
    assert "==" not in description
    assert "  " not in description
    words = docstring.replace("``", "").split()[len(title.split()) + 1 :]
    assert description.translate(str.maketrans("", "", "“”")).split() == words


@pytest.mark.parametrize("name", ["fig04_triangles", "fig10_earth"])
def test_figures_have_the_captions_of_their_scripts(name, tmp_path):
    """Whether what draws them stands in the script, or in a module beside it."""
    (script,) = [script for script in SCRIPTS if script.stem == name]
    figure = load_drawing(script)
    title, description = caption_of(script)
    shown = figure.page()
    assert (shown.title, shown.description) == (title, description)
    figure.save(tmp_path, size=100)
    root = ET.parse(tmp_path / f"{name}.svg").getroot()
    first = [(child.tag.partition("}")[2], child.text) for child in root[:2]]
    assert first == [("title", title), ("desc", description)]
    told = pypdf.PdfReader(tmp_path / f"{name}.pdf").metadata
    assert (told["/Title"], told["/Subject"]) == (title, description)
    texts = iio.immeta(tmp_path / f"{name}.png")
    assert (texts["Title"], texts["Description"]) == (title, description)


def test_what_is_no_script_has_no_caption_and_docstrings_may_be_of_a_line_or_without_a_rule():
    assert Figure("nothing", dict, lambda _: Page((0.0, 1.0, 0.0, 1.0))).page().title == ""
    assert Figure("nothing", dict, lambda _: page()).page().title == "A title"
    with pytest.raises(ValueError, match="renderer is 'svg', but must be one of 'gl', 'agg'"):
        Figure("nothing", dict, lambda _: page(), renderer="svg").pixels(size=40)
    assert parted("One line.") == ("One line.", "")
    assert parted("Title\n\nText with ``code`` = 5.") == ("Title", "Text with “code” = 5.")
    assert parted("") == ("", "")
