"""Films: what is drawn is what is written, an interruption costs nothing, and what fails is named."""

import os
import re
import signal
import subprocess
import sys
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import stereodel
from stereodel.film import Film, FrameError
from stereodel.film import film as film_module
from stereodel.film import frames as frames_module
from tests.tasks.processes import ended, importable, wait_until
from tests.tiers import by_day

BALLS = """
import os, time
from pathlib import Path
import numpy as np
from stereodel.drawing import Page
from stereodel.film import Film
from stereodel.drawing.page import Dots, Label

LOG = Path(__file__).with_name("log")

def ball(x):
    "A ball at x; -1 fails, -2 ends the process."
    with LOG.open("a") as log:
        log.write(f"{os.getpid()} {x}\\n")
    if x == -1:
        raise ValueError("no ball there")
    if x == -2:
        os._exit(3)
    dot = Dots(np.array([[x, 1.0]]), 40.0, (0.8, 0.1, 0.1, 1.0))
    return Page((0.0, 4.0, 0.0, 2.0), (dot, Label("ball", (0.5, 0.2), size=30.0)), width=160.0)

def wide(x):
    return Page((0.0, x, 0.0, 1.0))

def slow_ball(x):
    time.sleep(float(os.environ.get("SLOW", "0")))
    return ball(x)
"""


@pytest.fixture
def balls(tmp_path, monkeypatch):
    """A module with functions that draw."""
    with importable(tmp_path / "code", "balls", BALLS, monkeypatch) as module:
        yield module


@pytest.fixture
def out(tmp_path):
    folder = tmp_path / "out"
    folder.mkdir()
    return folder


def drawn(balls):
    """(process, x) of each frame that was drawn so far."""
    return [(int(pid), float(x)) for pid, x in (line.split() for line in balls.LOG.read_text().splitlines())]


def frames(path):
    with Image.open(path) as image:
        return np.stack([np.asarray(image.convert("RGB")) for _ in map(image.seek, range(image.n_frames))])


def save(film, path):
    return film.save(path, jobs=1, progress=False)


def test_the_file_shows_the_frames(balls, out):
    film = Film(balls.ball, (1.0, 1.5, 2.0, 2.5), fps=10, size=80)
    file = save(film, out / "balls.png")
    assert [path.name for path in out.iterdir()] == [file.name]
    assert np.array_equal(frames(file), [film.picture(number) for number in range(4)])
    assert (len(film), film.duration, film.page(2).width) == (4, pytest.approx(0.4), 160.0)
    bare = save(replace(film, text=False), out / "bare.png")
    assert not np.array_equal(frames(bare), frames(file))


def test_several_processes_give_the_same_file_as_one(balls, out):
    film = Film(balls.ball, np.linspace(1, 3, 6).tolist(), size=80)
    one, two = (film.save(out / f"{jobs}.webp", jobs=jobs, progress=False) for jobs in (1, 2))
    assert one.read_bytes() == two.read_bytes()
    processes = {pid for pid, _ in drawn(balls)[6:]}
    assert os.getpid() not in processes
    assert 1 <= len(processes) <= 2
    wait_until(lambda: all(map(ended, processes)))


@pytest.mark.thorough
def test_a_process_draws_so_many_frames_and_then_another_goes_on(balls, out, monkeypatch):
    monkeypatch.setattr(film_module, "LIFETIME", 2)
    film = Film(balls.ball, (1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 3.2), size=80)
    assert len(frames(film.save(out / "many.png", jobs=2, progress=False))) == 7
    processes = [pid for pid, _ in drawn(balls)]
    assert len(processes) == 7
    assert max(map(processes.count, processes)) == 2
    wait_until(lambda: all(map(ended, processes)))


def test_equal_shots_are_drawn_once(balls, out):
    film = Film(balls.ball, (1.0, 2.0, 2.0, 2.0, 1.0), size=80)
    assert len(frames(save(film, out / "held.png"))) == 5
    assert [x for _, x in drawn(balls)] == [1.0, 2.0]


def test_a_frame_that_fails_is_named_and_the_others_are_kept(balls, out):
    film = Film(balls.ball, (1.0, 1.5, -1.0, 2.0), size=80)
    with pytest.raises(FrameError, match="frame 2: ValueError: no ball there") as caught:
        save(film, out / "balls.png")
    assert str(caught.value.__cause__) == "no ball there"
    assert [path.name for path in out.iterdir()] == ["balls.png.frames"]
    good = Film(balls.ball, (1.0, 1.5, 2.5, 2.0), size=80)
    whole = save(good, out / "balls.png")
    assert [x for _, x in drawn(balls)] == [1.0, 1.5, -1.0, 2.5, 2.0]
    assert whole.read_bytes() == save(good, out / "again.png").read_bytes()


# Whoever runs the tests in the background has SIGINT ignored, and programs inherit that.
FILM = """
import signal
import sys
signal.signal(signal.SIGINT, signal.default_int_handler)
import balls
from stereodel.film import Film
film = Film(balls.slow_ball, [k / 10 for k in range(10, 30)], size=80)
film.save(sys.argv[1], jobs=2)
"""
OWN = """
import sys
from stereodel.drawing import Page
from stereodel.film import Film
def nothing(x):
    return Page((0.0, x, 0.0, x))
Film(nothing, [1.0, 2.0, 3.0], size=40).save(sys.argv[1], jobs=2)
"""
GUARDED = OWN.replace("Film(nothing", 'if __name__ == "__main__": Film(nothing')


def start(balls, out, code, *, slow="0", how="film.py"):
    """A process that runs code: as a script, as a module, or given to the interpreter."""
    folder = Path(balls.__file__).parent
    (folder / "film.py").write_text(code)
    paths = [str(Path(stereodel.__file__).parents[1]), str(folder)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths), "SLOW": slow}
    arguments = {"film.py": [str(folder / "film.py")], "-m": ["-m", "film"], "-c": ["-c", code]}[how]
    command = [sys.executable, *arguments, str(out / "balls.gif")]
    return subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True, start_new_session=True)


NAMES = """import balls; from stereodel.film import Film; from stereodel.film.frames import frame_names
film = Film(balls.ball, [1.0], size=40); before = frame_names(film._camera, film.shots); film.picture(0)
assert frame_names(film._camera, film.shots) == before"""
# How the script is run, its code, what it says, and how many frames the file has.
SCRIPTS = {
    "of a module's pages": ("film.py", FILM, r"drawing 20/20.*writing 20/20", 20),
    "without a guard": ("film.py", OWN, r'FrameError: frame [01]: .* call under `if __name__ == "__main__":`', 0),
    "with a guard": ("film.py", GUARDED, "", 3),
    "as a module": ("-m", GUARDED, "", 3),
    "interactive": ("-c", OWN, r"TypeError: draw or the shots are defined in an interactive session.*jobs=1", 0),
    "interactive, here": ("-c", OWN.replace("jobs=2", "jobs=1"), "", 3),
    "names": ("-c", NAMES, "", None),
}
"""Names depend on the environment, which the first picture of a process leaves as it was."""


@pytest.mark.parametrize("name", by_day(SCRIPTS, "without a guard"))
def test_films_in_scripts(balls, out, name):
    how, code, words, count = SCRIPTS[name]
    process = start(balls, out, code, how=how)
    _, said = process.communicate(timeout=60)
    assert (process.returncode != 0) == (count == 0), said
    assert re.search(words, said, re.DOTALL)
    if count:
        assert len(frames(out / "balls.gif")) in (count, 2)  # of frames that are alike a GIF has one


@pytest.mark.parametrize("how", by_day(["interrupted", "killed"], "interrupted"))
def test_an_interruption_costs_nothing(balls, out, how):
    process = start(balls, out, FILM, slow="0.2")
    kept = out / "balls.gif.frames"
    wait_until(lambda: len(list(kept.glob("[!.]*.png"))) >= 3)
    if how == "killed":
        process.kill()
    else:
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
    _, said = process.communicate(timeout=60)
    assert process.returncode != 0
    assert ("KeyboardInterrupt" in said) == (how == "interrupted")
    wait_until(lambda: all(ended(pid) for pid, _ in drawn(balls)))
    assert [path.name for path in out.iterdir()] == ["balls.gif.frames"]
    finished = len(list(kept.glob("[!.]*.png")))
    assert 3 <= finished < 20

    before = len(drawn(balls))
    film = Film(balls.slow_ball, [k / 10 for k in range(10, 30)], size=80)
    resumed = save(film, out / "balls.gif")
    assert len(drawn(balls)) - before == 20 - finished
    whole = save(film, out / "whole.gif")
    assert resumed.read_bytes() == whole.read_bytes()
    assert sorted(path.name for path in out.iterdir()) == ["balls.gif", "whole.gif"]


@dataclass(frozen=True)
class Painter:
    ink: float

    def __call__(self, shot):
        raise AssertionError


def test_names_of_frames_depend_on_all_that_counts(balls, monkeypatch):
    monkeypatch.setitem(sys.modules, Painter.__module__, sys.modules[__name__])
    shots = [1.0, (1.0, 2), 1.0]
    names = frames_module.frame_names(Painter(1.0), shots)
    assert names[0] == names[2] != names[1]
    assert frames_module.frame_names(Painter(1.0), shots) == names
    assert set(frames_module.frame_names(Painter(2.0), shots)).isdisjoint(names)
    film = Film(balls.ball, shots)
    cameras = [replace(film, **change)._camera for change in ({}, {"size": 9}, {"text": False})]
    assert len({frames_module.frame_names(camera, shots)[0] for camera in cameras}) == 3
    before = frames_module.frame_names(film._camera, shots)
    Path(balls.__file__).write_text(BALLS.replace("40.0", "41.0"))
    assert frames_module.frame_names(film._camera, shots) != before
    monkeypatch.setattr(frames_module, "library_digest", lambda: b"another version")
    assert set(frames_module.frame_names(Painter(1.0), shots)).isdisjoint(names)


@pytest.mark.parametrize(
    ("draw", "shots", "options", "name", "how", "error", "message"),
    [
        ("ball", [], {}, "a.gif", {}, ValueError, "shots is empty"),
        *(("ball", [1.0], {"fps": fps}, "a.gif", {}, ValueError, "fps") for fps in (0.0, -25.0, np.nan, np.inf)),
        *(("ball", [1.0], {"size": size}, "a.gif", {}, ValueError, "size") for size in (0, 65_536)),
        ("ball", [1.0], {"size": 99.5}, "a.gif", {}, TypeError, "size"),
        ("ball", [1.0], {}, "a.mov", {}, ValueError, "path must end in"),
        ("ball", [1.0], {}, "a.gif", {"jobs": 0}, ValueError, "jobs"),
        ("ball", [1.0], {"fps": 60}, "a.gif", {}, ValueError, "at most 50 frames a second"),
        ("ball", [1.0, lambda: None], {}, "a.gif", {}, TypeError, r"shots\[1\] cannot be sent"),
        (None, [1.0], {}, "a.gif", {}, TypeError, "draw cannot be sent to the processes that draw"),
        ("ball", [1.0], {}, "none/a.gif", {"jobs": 1}, FileNotFoundError, "none"),
        ("ball", [1.0], {}, "folder.gif", {"jobs": 1}, IsADirectoryError, r"folder\.gif is a folder; give the name"),
        ("ball", range(100_001), {}, "a.gif", {}, ValueError, "shots has 100001 entries, and at most 100000"),
    ],
)
def test_what_cannot_be_is_refused_before_anything_is_drawn(
    balls, out, draw, shots, options, name, how, error, message
):
    (out / "folder.gif").mkdir()
    with pytest.raises(error, match=message):
        Film(getattr(balls, draw) if draw else lambda _: None, shots, **options).save(out / name, **how)
    assert [path.name for path in out.iterdir()] == ["folder.gif"]
    assert not balls.LOG.exists()


def test_frames_of_several_sizes_are_named(balls, out):
    film = Film(balls.wide, [2.0, 4.0], size=40)
    with pytest.raises(ValueError, match="frame 1 has 40 by 10 pixels and differs from the first with 40 by 20"):
        save(film, out / "wide.gif")


def test_what_is_not_of_a_film_stays_in_its_folder(balls, out):
    kept = out / "balls.gif.frames"
    kept.mkdir()
    (kept / "notes.txt").write_text("mine")
    (kept / f".{'0' * 32}.png.17.tmp").write_text("half a frame")
    (kept / f"{'0' * 32}.png").write_text("a frame of another film")
    save(Film(balls.ball, [1.0], size=40), out / "balls.gif")
    assert [path.name for path in kept.iterdir()] == ["notes.txt"]


def test_a_kept_frame_that_cannot_be_read_is_named(balls, out):
    film = Film(balls.ball, [1.0, -1.0], size=40)
    with pytest.raises(FrameError):
        save(film, out / "balls.gif")
    (frame,) = (out / "balls.gif.frames").iterdir()
    frame.write_bytes(frame.read_bytes()[:60])
    with pytest.raises(OSError, match=rf"{frame.name} cannot be read .*remove it and try again"):
        save(replace(film, shots=[1.0]), out / "balls.gif")
    assert not (out / "balls.gif").exists()


def test_as_a_script_it_writes_a_looping_gif_beside_its_folder(balls, out, capsys):
    """With the script's name; folder, size and text are options."""
    film = Film(partial(balls.ball), [2.5, 3.0, 3.5], seconds=(0.1, 0.2, 1.0), size=80)
    film.main([])
    assert [path.name for path in out.iterdir()] == ["balls.gif"]
    assert f"balls: balls.gif in {out}" in capsys.readouterr().out
    with Image.open(out / "balls.gif") as gif:
        times = [gif.seek(k) or gif.info["duration"] for k in range(gif.n_frames)]
        assert (times, gif.info["loop"]) == ([100, 200, 1000], 0)
    film.main(["--out", str(out / "new"), "--size", "60", "--no-text"])
    bare = frames(out / "new" / "balls.gif")
    assert bare.shape == (3, 30, 60, 3)
    assert (bare[0, :, :20] == 255).all()
    assert (film.picture(0)[:, :26] < 128).any()


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
