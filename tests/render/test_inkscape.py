"""SVG files in Inkscape: layers, names and our picture; changed and saved, the same picture but for the change."""

import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from PIL import Image

from stereodel.drawing import ColorScale, StereographicView
from stereodel.globe import Globe
from tests.render.test_librsvg import apart, shown
from tests.render.test_vector import INKSCAPE, SVG
from tools.browser import FONTS

pytestmark = pytest.mark.thorough  # `make test-thorough` installs the program; without it they fail

SIZE, BLOCK = 1200, 64
LEVELS = 6
"""By which means of blocks may differ. The programs are given our fonts: they know none that a file brings."""

NAMES = ["Ulm", "Côte d’Or", "12 °c", "Ulm"]


def page(color=None):
    """A flat map of named squares by value, and of type with halos; the second square, bare of type, is changed."""
    globe = Globe(title="Squares & names")
    globe.add_land(resolution="110m")
    globe.add_graticule(30)
    corners = [np.array([(0, 0), (4, 0), (4, 4), (0, 4)]) + place for place in [(5, 45), (12, 46), (0, 38), (20, 50)]]
    shades = ColorScale("viridis", 0, 3)(np.arange(4.0))
    if color is not None:
        shades[1] = color
    globe.add_polygons([[ring] for ring in corners], color=shades, ids=NAMES, name="squares")
    globe.add_points([(10.0, 52.0), (24.0, 44.0)], ids=["Here", "There"])
    globe.add_labels([(10.0, 52.0), (24.0, 44.0), (16.0, 40.0)], ["Wave AV", "שלום", "$x$ of all"], formulas=True)
    globe.legend["value"] = ColorScale("viridis", 0, 3)
    return globe.page(None, StereographicView(10, 46, angular_radius=20), width=400, legend=True)


def inkscape(file, *actions):
    command = ["inkscape", str(file), f"--actions={';'.join(actions)}"]
    ran = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    assert "not found" not in ran.stdout + ran.stderr


def pixels(file):
    """What Inkscape shows of a file, on white."""
    target = file.with_suffix(".png")
    inkscape(file, f"export-filename:{target}", f"export-width:{SIZE}", "export-background:white", "export-do")
    return np.asarray(Image.open(target).convert("RGB")).astype(float)


def told(root):
    """Layers, what is named by data, and the words, of a file."""
    layers = [group.get(f"{INKSCAPE}label") for group in root if group.get(f"{INKSCAPE}groupmode") == "layer"]
    named = {it.get("id"): it.get("data-id") for it in root.iter() if it.get("data-id")}
    return layers, named, ["".join(text.itertext()) for text in root.iter(f"{SVG}text")]


def test_inkscape_opens_changes_and_saves_a_file(tmp_path, monkeypatch):
    (fonts := tmp_path / "fonts.conf").write_text(
        FONTS.format(fonts=Path(mpl.get_data_path(), "fonts", "ttf"), cache=tmp_path)
    )
    monkeypatch.setenv("FONTCONFIG_FILE", str(fonts))
    first, saved = page().save(tmp_path / "page.svg"), tmp_path / "saved.svg"
    before, ours = pixels(first), page().pixels(size=SIZE).astype(float)
    assert apart(ours, before, BLOCK).max() < LEVELS
    change = ("select-by-id:Côte-d-Or", "object-set-attribute:fill,#ff0000")
    inkscape(first, *change, f"export-filename:{saved}", "export-do")
    wanted, after = page((1.0, 0.0, 0.0, 1.0)).pixels(size=SIZE).astype(float), pixels(saved)
    assert apart(ours, after, BLOCK).max() > 20  # it was changed
    assert apart(wanted, after, BLOCK).max() < LEVELS
    assert apart(wanted, shown(saved, SIZE), BLOCK).max() < LEVELS
    assert told(ET.parse(saved).getroot()) == told(ET.parse(first).getroot())
    layers, named, words = told(ET.parse(saved).getroot())
    assert layers == ["ground", "ball", "land", "graticule", "squares", "points", "limb", "scale", "tick", "labels"]
    ids = ["Ulm", "Côte-d-Or", "_12-c", "Ulm-2", "Here", "There"]
    assert named == dict(zip(ids, [*NAMES, "Here", "There"], strict=True))
    assert {"Wave AV", "שלום", "Squares & names"} <= set(words)
