"""Films as scripts: a looping GIF with the script's name, in its true colours, whole or not at all."""

import subprocess
import sys

import imageio.v3 as iio
import pytest
from PIL import Image

from tests.tasks.processes import importable

SCRIPT = """
from functools import partial
import numpy as np
from stereodel.drawing.page import Dots, Label, Page
from stereodel.film import Film

def frame(x, color):
    items = Dots(np.array([[x, 0.5]]), 10.0, color), Label("x", (0.2, 0.8), size=30.0)
    return Page((0.0, 2.0, 0.0, 1.0), items, width=120.0)

def film():
    return Film(partial(frame, color=(0.8, 0.1, 0.1, 1.0)), [0.5, 1.0, 1.5], seconds=(0.1, 0.2, 1.0), size=120)
"""


@pytest.fixture
def moving(tmp_path, monkeypatch):
    """The film of a script in a folder of its own."""
    with importable(tmp_path / "scripts", "moving", SCRIPT, monkeypatch) as module:
        yield module.film()


def test_it_writes_a_looping_gif_beside_its_folder(moving, tmp_path, capsys):
    moving.main([])
    (file,) = (tmp_path / "out").iterdir()
    assert file.name == "moving.gif"
    assert f"moving: moving.gif in {tmp_path / 'out'}" in capsys.readouterr().out
    with Image.open(file) as gif:
        times = [gif.seek(k) or gif.info["duration"] for k in range(gif.n_frames)]
        assert (times, gif.info["loop"]) == ([100, 200, 1000], 0)


def test_it_takes_folder_size_and_text(moving, tmp_path):
    moving.main(["--out", str(tmp_path / "new"), "--size", "60", "--no-text"])
    frames = iio.imread(tmp_path / "new" / "moving.gif")[..., :3]
    assert frames.shape == (3, 30, 60, 3)
    assert (frames[0, :12, :10] == 255).all()
    assert (moving.picture(0)[:24, :20] < 128).any()


AS_TEXT = """
import sys, types
sys.modules["__main__"] = main = types.ModuleType("__main__")
exec(compile(open({path!r}).read(), {path!r}, "exec"), main.__dict__)
"""


def test_a_program_may_run_a_script_as_text(tmp_path):
    """As the documentation does; no other process could import what draws."""
    script = tmp_path / "anim_dots.py"
    script.write_text(
        "from stereodel.drawing import Page\n"
        "from stereodel.film import Film\n"
        "def draw(x):\n"
        "    return Page((0.0, 1.0, 0.0, 1.0), background=(x, 0.0, 0.0, 1.0))\n"
        f"Film(draw, [0.0, 1.0], fps=5, size=20).main(['--out', {str(tmp_path)!r}])\n"
    )
    subprocess.run([sys.executable, "-c", AS_TEXT.format(path=str(script))], check=True)
    assert (tmp_path / "anim_dots.gif").is_file()
