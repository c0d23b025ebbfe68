"""The figure runner: what is drawn again and what is not, what is noted of it, and what happens on errors."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from stereodel._tasks.kept import Kept
from stereodel.film.frames import DRAWN_WITH
from tools import build

SCRIPT = """
import os
from pathlib import Path
from _shared import INK

class Drawing:
    def save(self, out, *, size=None, text=True):
        temporary = Path(out) / ".{name}.part"  # scripts run at the same time
        temporary.write_text(INK + str(os.getpid()))
        os.replace(temporary, Path(out) / "{name}.txt")
        return {{"pixel_hash": "abc", "renderer": "none"}}

{kind} = Drawing()
"""


@pytest.fixture
def scripts(tmp_path):
    folder = tmp_path / "figures"
    folder.mkdir()
    (folder / "_shared.py").write_text("INK = 'black'\n")
    (folder / "fig01_one.py").write_text(SCRIPT.format(name="fig01_one", kind="FIGURE"))
    (folder / "anim_two.py").write_text(SCRIPT.format(name="anim_two", kind="FIGURE"))
    return folder


def command(*arguments, cwd):
    """Run the builder as `make` does."""
    environment = {**os.environ, "PYTHONPATH": str(Path(build.__file__).parents[1])}
    line = [sys.executable, "-m", "tools.build", *map(str, arguments)]
    return subprocess.run(line, cwd=cwd, env=environment, capture_output=True, text=True, check=False)


def noted(out):
    """What is noted of each figure whose files are there, by its name."""
    kept = Kept(out)
    names = sorted(path.stem for path in (out / build.NOTES).iterdir())
    return {name: note for name in names if (note := kept.note(f"{build.NOTES}/{name}"))}


def drawn(outcomes):
    return sorted(outcome.script.stem for outcome in outcomes)


@pytest.mark.thorough
def test_only_what_is_out_of_date_runs(scripts, tmp_path):
    out = tmp_path / "out"
    assert drawn(build.build(scripts, out)) == ["anim_two", "fig01_one"]
    assert build.build(scripts, out) == []

    (scripts / "fig01_one.py").touch()
    assert build.build(scripts, out) == []  # contents decide, not times

    (scripts / "fig01_one.py").write_text((scripts / "fig01_one.py").read_text() + "# changed\n")
    assert drawn(build.build(scripts, out)) == ["fig01_one"]

    (out / "anim_two.txt").write_text("scribbled over")
    assert drawn(build.build(scripts, out)) == ["anim_two"]

    (out / "fig01_one.txt").unlink()
    assert drawn(build.build(scripts, out)) == ["fig01_one"]

    written = (out / "fig01_one.txt").read_bytes()
    (out / "fig01_one.txt").write_bytes(written[::-1])
    assert drawn(build.build(scripts, out)) == ["fig01_one"]  # of the same size, and another one
    assert (out / "fig01_one.txt").read_bytes() == written

    (out / "notes" / "anim_two.json").write_text('{"half')
    assert drawn(build.build(scripts, out)) == ["anim_two"]

    (scripts / "_shared.py").write_text("INK = 'gray'\n")
    assert drawn(build.build(scripts, out)) == ["anim_two", "fig01_one"]
    assert (out / "fig01_one.txt").read_text().startswith("gray")


def test_notes_say_what_was_drawn_with_what(scripts, tmp_path):
    out = tmp_path / "out"
    build.build(scripts, out)
    notes = noted(out)
    assert list(notes) == ["anim_two", "fig01_one"]
    record = notes["fig01_one"]
    assert record["figure"] == "fig01_one"
    assert record["pixel_hash"] == "abc"
    assert record["renderer"] == "none"
    assert record["seconds"] >= 0
    assert set(record["versions"]) == {"python", *DRAWN_WITH}
    assert record["files"] == {"fig01_one.txt": (out / "fig01_one.txt").stat().st_size}


@pytest.mark.thorough
def test_failing_scripts_do_not_stop_the_others(scripts, tmp_path):
    (scripts / "fig00_bad.py").write_text("def helper():\n    raise KeyError('no such site')\n\nhelper()\n")
    (scripts / "fig02_dies.py").write_text("import os\nos._exit(3)\n")
    (scripts / "fig03_empty.py").write_text("")
    ran = command("--scripts", scripts, "--out", "out", cwd=tmp_path)
    assert ran.returncode == 1
    assert (tmp_path / "out" / "fig01_one.txt").exists()
    assert (tmp_path / "out" / "anim_two.txt").exists()
    assert "2 drawn, 3 failed" in ran.stdout
    assert "in helper" in ran.stderr
    assert "no such site" in ran.stderr
    assert "its process ended with code 3, without a Python error" in ran.stderr
    assert "defines neither FIGURE nor film()" in ran.stderr
    assert list(noted(tmp_path / "out")) == ["anim_two", "fig01_one"]


FILM = """
import numpy as np
from stereodel.drawing import Page
from stereodel.drawing.page import Dots
from stereodel.film import Film
def frame(x):
    return Page((0.0, 2.0, 0.0, 1.0), (Dots(np.array([[x, 0.5]]), 9.0, (0.0, 0.0, 1.0, 1.0)),))
def film():
    return Film(frame, [0.5, 1.0, 1.5], seconds=0.1, size=60)
"""


@pytest.mark.thorough
def test_a_style_goes_into_a_folder_of_its_own(scripts, tmp_path):
    (scripts / "anim_two.py").write_text(FILM)
    (tmp_path / "gold.toml").write_text('background = "gold"\n')
    line = ("--scripts", scripts, "--out", "out", "--style", "gold.toml,dark", "anim_two")
    assert "out/dark-gold: 1 drawn, 0 failed" in command(*line, cwd=tmp_path).stdout
    made = {path.name for path in (tmp_path / "out" / "dark-gold").iterdir()}
    assert made == {"anim_two.gif", "notes"}
    assert "up to date" in command(*line, cwd=tmp_path).stdout
    (tmp_path / "gold.toml").write_text('background = "navy"\n')
    assert "1 drawn, 0 failed" in command(*line, cwd=tmp_path).stdout


@pytest.mark.thorough
def test_a_film_becomes_a_gif(scripts, tmp_path, monkeypatch):
    (scripts / "anim_two.py").write_text(FILM)
    out = tmp_path / "out"
    (outcome,) = build.build(scripts, out, ["anim"])
    assert outcome.error == ""
    assert sorted(path.name for path in out.iterdir()) == ["anim_two.gif", "notes"]
    record = noted(out)["anim_two"]
    assert (record["frames"], record["size"], list(record["files"])) == (3, 60, ["anim_two.gif"])
    monkeypatch.setattr(build, "LARGEST_FILM", 100)
    outcome = build.run_script(scripts / "anim_two.py", out)
    assert "give fewer frames or a smaller size" in outcome.error


def test_names_select_scripts(scripts, tmp_path):
    assert drawn(build.build(scripts, tmp_path / "out", ["fig"])) == ["fig01_one"]
    with pytest.raises(build.BuildError, match=r"'fig9'; there are anim_two, fig01_one"):
        build.build(scripts, tmp_path / "out", ["fig9"])


@pytest.mark.thorough
@pytest.mark.usefixtures("scripts")
@pytest.mark.parametrize(
    ("folder", "out", "words"),
    [("figures", "file/below", "Not a directory: 'file/below'"), ("nowhere", "out", "no figure scripts in nowhere")],
)
def test_mistakes_are_one_line(tmp_path, folder, out, words):
    (tmp_path / "file").write_text("")
    ran = command("--scripts", folder, "--out", out, cwd=tmp_path)
    assert (ran.returncode, len(ran.stderr.splitlines())) == (2, 1)
    assert words in ran.stderr
