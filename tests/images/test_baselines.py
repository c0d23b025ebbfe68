"""The program that stores baselines: what it writes, what it leaves alone, and what a missing one means."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from stereodel.drawing.page import Dots, Label, Page
from tests.images.report import Failure
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

FILM = """
import numpy as np
from stereodel.drawing import Page
from stereodel.film import Film
from stereodel.drawing.page import Dots
def frame(x):
    return Page((0.0, 2.0, 0.0, 1.0), (Dots(np.array([[x, 0.5]]), 9.0, (0.0, 0.0, 1.0, 1.0)),))
def film():
    return Film(frame, range(5))
"""


@pytest.fixture
def project(tmp_path):
    """Two scripts and an empty store."""
    scripts = tmp_path / "figures"
    scripts.mkdir()
    write_figure(scripts, "fig90_dot", 9.0)
    (scripts / "anim_dot.py").write_text(FILM)
    return scripts, tmp_path / "store"


def write_figure(scripts, name, radius):
    (scripts / f"{name}.py").write_text(FIGURE.replace("RADIUS", str(radius)).replace("NAME", name))


def check(scripts: Path, folder: Path, name: str):
    store = Store(folder)
    (case,) = (c for c in cases_of(scripts / f"{name}.py") if c.name.startswith(name))
    return store.otherwise(case)


def test_what_was_written_passes(project):
    scripts, folder = project
    assert list(write_baselines(scripts, folder)) == [
        *(f"anim_dot_{frame}: new" for frame in ("first", "middle", "last")),
        "fig90_dot: new",
    ]
    assert check(scripts, folder, "fig90_dot") == []
    assert len(list(folder.iterdir())) == 4 * 2 + 2


def test_a_missing_baseline_fails_and_names_the_command(project):
    scripts, folder = project
    t1, t3, t0 = check(scripts, folder, "fig90_dot")
    assert t0.startswith("T0: fig90_dot.npz.xz is missing")
    assert t1.startswith("T1: fig90_dot.png or its hash is missing")
    assert t3.startswith("T3: labels.json has no fig90_dot")
    assert all("make baselines" in message for message in (t0, t1, t3))
    assert not folder.exists()


def test_a_change_fails_until_it_is_stored(project):
    scripts, folder = project
    list(write_baselines(scripts, folder))
    write_figure(scripts, "fig90_dot", 10.0)
    messages = check(scripts, folder, "fig90_dot")
    assert [message[:2] for message in messages] == ["T2", "T0"]
    assert list(write_baselines(scripts, folder, ["fig90"])) == ["fig90_dot: changed"]
    assert check(scripts, folder, "fig90_dot") == []


def test_what_passes_is_left_as_it_was(project):
    scripts, folder = project
    list(write_baselines(scripts, folder))
    before = {path.name: path.stat().st_mtime_ns for path in folder.iterdir() if path.suffix != ".json"}
    assert list(write_baselines(scripts, folder))[-1] == "fig90_dot: as it was"
    assert {path.name: path.stat().st_mtime_ns for path in folder.iterdir() if path.suffix != ".json"} == before


def test_what_no_script_draws_any_more_is_removed(project):
    scripts, folder = project
    list(write_baselines(scripts, folder))
    (scripts / "anim_dot.py").unlink()
    assert "anim_dot_last: removed, no script draws it" in list(write_baselines(scripts, folder))
    assert sorted(path.name for path in folder.iterdir()) == [
        *("fig90_dot.npz.xz", "fig90_dot.png", "labels.json", "pixels.json")
    ]


def test_the_hash_decides_before_the_picture(project, monkeypatch):
    scripts, folder = project
    list(write_baselines(scripts, folder))
    monkeypatch.setattr("tools.baselines.read_picture", lambda path: pytest.fail("T2 was not needed"))
    assert check(scripts, folder, "fig90_dot") == []


def test_a_few_pixels_of_rounding_pass_the_third_net(project):
    scripts, folder = project
    list(write_baselines(scripts, folder))
    (case,) = cases_of(scripts / "fig90_dot.py")
    case.picture[:2, :2] -= 3
    assert Store(folder).looks_otherwise(case) == []
    case.picture[:40] = 0
    (message,) = Store(folder).looks_otherwise(case)
    assert message.startswith("T2: 12.5")


def test_a_failure_carries_both_pictures(project):
    scripts, folder = project
    list(write_baselines(scripts, folder))
    page = Page((0.0, 2.0, 0.0, 1.0), (Dots(np.array([[1.0, 0.5]]), 9.0, (1.0, 0.0, 0.0, 1.0)),))
    failure = Failure.of(Store(folder), Case("fig90_dot", page, {}, "agg"), ["T2: red"])
    assert failure.expected is not None
    assert failure.expected.shape == failure.actual.shape
    assert Failure.of(Store(folder / "none"), Case("fig90_dot", page, {}, "agg"), []).expected is None


def test_the_command_reports_and_its_exit_code_tells(project, capsys):
    scripts, folder = project
    assert main(["--scripts", str(scripts), "--store", str(folder), "fig90"]) == 0
    assert capsys.readouterr().out == "fig90_dot: new\n"
    assert main(["--scripts", str(scripts / "none"), "--store", str(folder)]) == 2
    assert "no figure scripts" in capsys.readouterr().err


def labelled(x, text="north"):
    return Case("labelled", Page((0.0, 4.0, 0.0, 2.0), (Label(text, (x, 1.0)), Label("", (1.0, 1.0)))), {}, "agg")


@pytest.fixture
def stored_label(tmp_path):
    store = Store(tmp_path)
    store.write(labelled(2.0))
    store.write_tables()


def test_labels_keep_their_place_to_a_pixel(tmp_path, stored_label, monkeypatch):
    """Where another FreeType sets them."""
    monkeypatch.setattr("tools.baselines.set_with", lambda: "matplotlib 3.10.9, FreeType 2.6.1, x86_64")
    pixel = 4.0 / 640
    for kept in (labelled(2.0), labelled(2.0 + 0.8 * pixel)):
        assert Store(tmp_path).set_otherwise(kept) == []
    for moved in (labelled(2.0 + 1.2 * pixel), labelled(2.0 - 1.2 * pixel), labelled(2.0, "norths"), labelled(2.0, "")):
        (message,) = Store(tmp_path).set_otherwise(moved)
        assert message.startswith("T3: label 0 (")
    bare = Case("labelled", labelled(2.0).page.without_labels(), {}, "agg")
    assert Store(tmp_path).set_otherwise(bare) == ["T3: 2 labels expected, 0 found"]


def test_labels_keep_their_pixels_where_the_same_libraries_set_them(tmp_path, stored_label):
    assert Store(tmp_path).set_otherwise(labelled(2.0)) == []
    red, light = ({"color": (value, 0.0, 0.0, 1.0)} for value in (1.0, 2 / 255))
    label, empty = labelled(2.0).page.items
    for change in (red, light, {"offset": (0.5, 0.0)}, {"size": 1.01 * label.size}, {"halo": 0.1}, {"text": "uorth"}):
        page = replace(labelled(2.0).page, items=(replace(label, **change), empty))
        assert Store(tmp_path).set_otherwise(Case("labelled", page, {}, "agg")) == [
            f'T3: label 0 ("{change.get("text", "north")}") looks otherwise where it was'
        ], change


def test_type_set_with_other_libraries_is_stored_anew(project, monkeypatch):
    scripts, folder = project
    list(write_baselines(scripts, folder))
    monkeypatch.setattr("tools.baselines.set_with", lambda: "another")
    assert list(write_baselines(scripts, folder, ["fig90"])) == ["fig90_dot: as it was"]
    assert Store(folder).labels["fig90_dot"]["set_with"] == "another"


def test_what_differs_is_named(tmp_path):
    """A moved label, by its number, its field and its text."""
    store, label = Store(tmp_path), Label("north", (1.0, 1.0), offset=(3.0, 0.0))
    store.write(Case("labelled", Page((0.0, 4.0, 0.0, 2.0), (label,)), {}, "agg"))
    moved = replace(label, offset=(4.5, 0.0), text="south", color=(0.0, 0.5, 0.0, 1.0))
    t0 = Store(tmp_path).drawn_otherwise(Case("labelled", Page((0.0, 4.0, 0.0, 2.0), (moved,)), {}, "agg"))
    assert t0 == [
        'T0: label 0 ("south"), place: offset x is 4.5, expected 3; colour green is 0.5, expected 0',
        'T0: label 0 ("south"), text: text is south, expected north',
    ]
