"""Captions: taken from scripts into files, and set below pictures."""

import ast
import xml.etree.ElementTree as ET
from dataclasses import replace

import imageio.v3 as iio
import numpy as np
import pypdf
import pytest

from stereodel.drawing.page import Fill, Label, Page, Stroke
from stereodel.drawing.page.style import BLACK
from stereodel.render.figure import Figure, caption_of, captioned, parted
from stereodel.render.pixel_rows import LabelLayer
from tests.images.scripts import SCRIPTS
from tools.build import load_drawing

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
    assert [(child.tag.partition("}")[2], child.text) for child in root[:2]] == [
        ("title", title),
        ("desc", description),
    ]
    told = pypdf.PdfReader(tmp_path / f"{name}.pdf").metadata
    assert (told["/Title"], told["/Subject"]) == (title, description)
    texts = iio.immeta(tmp_path / f"{name}.png")
    assert (texts["Title"], texts["Description"]) == (title, description)


def test_what_is_no_script_has_no_caption_and_docstrings_may_be_of_a_line_or_without_a_rule():
    assert Figure("nothing", dict, lambda _: Page((0.0, 1.0, 0.0, 1.0))).page().title == ""
    assert Figure("nothing", dict, lambda _: page()).page().title == "A title"
    assert parted("One line.") == ("One line.", "")
    assert parted("Title\n\nText with ``code`` = 5.") == ("Title", "Text with “code” = 5.")
    assert parted("") == ("", "")


def test_a_caption_stands_below_the_picture_within_its_width():
    below = captioned(page())
    texts = [label.text.replace(r"\$", "$") for label in below.labels if label.name == "caption"]
    assert texts[0] == "A title"
    assert " ".join(texts[1:]) == " ".join(DESCRIPTION.split())
    assert len(texts) > 4
    assert (below.width, below.points_per_unit, below.extent[3]) == (300.0, 150.0, 1.0)
    captions = replace(below, items=tuple(item for item in below.items if item.name == "caption"))
    rows, columns = np.nonzero(LabelLayer(captions, 600).rows()[..., 3])
    assert 300 < rows.min() < 340
    assert below.height * 2 - 40 < rows.max() < below.height * 2 - 16
    assert 24 <= columns.min() <= 27
    assert 600 - 24 - 60 < columns.max() <= 600 - 24
    # Baselines go down evenly, and what leaves the picture below is covered.
    heights = [label.anchor[1] for label in captions.labels]
    assert (np.diff(heights) < 0).all()
    picture = below.pixels(size=600, text=False, renderer="agg")
    assert (picture[310:] == 255).all()
    assert np.array_equal(picture[:300], page().pixels(size=600, text=False, renderer="agg"))


def test_type_is_white_on_dark_grounds_and_nothing_needs_no_room():
    dark = captioned(page(background=(0.1, 0.1, 0.3, 1.0)))
    assert {label.color[:3] for label in dark.labels if label.name == "caption"} == {(1.0, 1.0, 1.0)}
    (ground,) = [item for item in dark.items if isinstance(item, Fill)]
    assert ground.color == (0.1, 0.1, 0.3, 1.0)
    bare = page(title="", description="")
    assert captioned(bare) is bare


def test_scripts_set_captions_on_request(tmp_path):
    figure = Figure("small", dict, lambda _: page(), renderer="agg")
    figure.main(["--out", str(tmp_path), "--size", "100", "--caption"])
    assert iio.imread(tmp_path / "small.png").shape[0] == round(100 * captioned(page()).height / 300)
    (sheet,) = pypdf.PdfReader(tmp_path / "small.pdf").pages
    assert "The second costs $5 — or $6." in sheet.extract_text()
    figure.main(["--out", str(tmp_path), "--size", "100", "--caption", "--no-text"])
    assert iio.imread(tmp_path / "small.png").shape[0] == 50
