"""The files of pictures that changed, and the store that they compare with."""

import re
from dataclasses import replace

import numpy as np
import pytest

from stereodel.drawing.page import Dots, Label, Page
from tests.images.report import difference_picture, in_short, report_failure, report_pass
from tools.baselines import Case, Store, cases_of, main, write_baselines

FIGURE = """
import numpy as np
from stereodel.drawing import Page
from stereodel.render import Figure
from stereodel.drawing.page import Dots
def geometry():
    return {"centers": np.array([[1.0, 0.5]])}
def draw(g):
    return Page((0.0, 2.0, 0.0, 1.0), (Dots(g["centers"], RADIUS, (0.0, 0.0, 0.0, 1.0)),))
FIGURE = Figure("NAME", geometry, draw, renderer="agg")
"""


def drawn(name="dot", radius=9.0, text="north", x=2.0, **label):
    items = (Dots(np.array([[1.0, 0.5]]), radius, (0.0, 0.0, 0.0, 1.0)), Label(text, (x, 1.0), **label))
    return Case(name, Page((0.0, 4.0, 0.0, 2.0), items), {}, "agg")


@pytest.fixture
def store(tmp_path):
    found = Store(tmp_path / "store")
    found.folder.mkdir()
    for name in ("dot", "other"):
        found.write(drawn(name))
    found.write_tables()
    return found


@pytest.fixture
def scripts(tmp_path):
    """A folder with a script of a figure."""
    folder = tmp_path / "figures"
    folder.mkdir()
    write_figure(folder, "fig90_dot", 9.0)
    return folder


def write_figure(folder, name, radius):
    (folder / f"{name}.py").write_text(FIGURE.replace("RADIUS", str(radius)).replace("NAME", name))


def test_the_difference_is_red_where_it_can_be_seen():
    white = np.full((100, 100, 3), 255, dtype=np.uint8)
    other = white.copy()
    other[0, 0] = 0
    other[1, 1] = 250
    marked = difference_picture(white, other[:50, :70])
    assert marked.shape == (50, 70, 3)
    assert marked[0, 0].tolist() == [220, 0, 0]
    assert marked[1, 1].tolist() == [240, 160, 0]
    assert np.ptp(marked[5, 5]) == 0


def test_a_picture_that_changed_has_a_file_until_it_passes(store, tmp_path):
    """Stored, today, difference and labels; a new picture has only the second and the last."""
    sheet = report_failure(
        store, drawn("other", 10.0), ["T2: <half> of it", *(f"T0: {n}" for n in range(300))], tmp_path
    )
    text = sheet.read_text(encoding="utf-8")
    assert text.count("<img") == 4
    assert report_failure(store, drawn("new"), ["T1: missing"], tmp_path).read_text(encoding="utf-8").count("<img") == 2
    assert "T2: &lt;half&gt; of it" in text
    assert "T0: 299" in text
    assert not re.search(r"https?:|url\(|@import|<link|src=\"(?!data:image/png;base64,)", text)
    for name in ("other", "new", "dot"):
        report_pass(name, tmp_path)
    assert list(tmp_path.glob("*.html")) == []


def test_the_terminal_says_what_it_leaves_out():
    assert in_short(["T2: a", "T3: b"]) == ["T2: a", "T3: b"]
    assert in_short([str(number) for number in range(50)]) == [*map(str, range(8)), "and 42 more"]


def test_what_is_stored_passes_until_it_changes(scripts, tmp_path):
    folder = tmp_path / "new"

    def check():
        (case,) = cases_of(scripts / "fig90_dot.py")
        return [message[:3] for message in Store(folder).otherwise(case)]

    (case,) = cases_of(scripts / "fig90_dot.py")
    assert check() == ["T1:", "T3:", "T0:"]
    assert all("make baselines" in message for message in Store(folder).otherwise(case))
    assert not folder.exists()
    assert list(write_baselines(scripts, folder)) == ["fig90_dot: new"]
    assert check() == []
    assert list(write_baselines(scripts, folder)) == ["fig90_dot: as it was"]
    write_figure(scripts, "fig90_dot", 10.0)
    assert check() == ["T2:", "T0:"]
    write_figure(scripts, "fig91_dot", 10.0)
    assert list(write_baselines(scripts, folder, ["fig90"])) == ["fig90_dot: changed"]
    (scripts / "fig90_dot.py").unlink()
    assert list(write_baselines(scripts, folder)) == ["fig91_dot: new", "fig90_dot: removed, no script draws it"]


def test_a_few_pixels_of_rounding_pass_the_third_net(store):
    case = drawn()
    case.picture[:2, :2] -= 3
    assert store.looks_otherwise(case) == []
    case.picture[:40] = 0
    (message,) = store.looks_otherwise(case)
    assert message.startswith("T2: 12.5")


def test_the_command_reports_and_its_exit_code_tells(scripts, tmp_path, capsys):
    assert main(["--scripts", str(scripts), "--store", str(tmp_path / "new"), "fig90"]) == 0
    assert capsys.readouterr().out == "fig90_dot: new\n"
    assert main(["--scripts", str(scripts / "none"), "--store", str(tmp_path)]) == 2
    assert "no figure scripts" in capsys.readouterr().err


def test_labels_keep_their_place_to_a_pixel_where_another_freetype_sets_them(store, monkeypatch):
    monkeypatch.setattr("tools.baselines.set_with", lambda: "another")
    pixel = 4.0 / 640
    assert store.set_otherwise(drawn(x=2.0 + 0.8 * pixel)) == []
    for moved in (drawn(x=2.0 + 1.2 * pixel), drawn(x=2.0 - 1.2 * pixel), drawn(text="norths"), drawn(text="")):
        (message,) = store.set_otherwise(moved)
        assert message.startswith("T3: label 1 (")
    bare = replace(drawn(), page=drawn().page.without_labels())
    assert store.set_otherwise(bare) == ["T3: 1 labels expected, 0 found"]


@pytest.mark.parametrize(
    "change",
    [{"color": (2 / 255, 0.0, 0.0, 1.0)}, {"offset": (0.5, 0.0)}, {"size": 9.1}, {"halo": 0.1}, {"text": "uorth"}],
    ids=lambda change: next(iter(change)),
)
def test_labels_keep_their_pixels_where_the_same_libraries_set_them(store, change):
    assert store.set_otherwise(drawn()) == []
    (message,) = store.set_otherwise(drawn(**change))
    assert message == f'T3: label 1 ("{change.get("text", "north")}") looks otherwise where it was'
