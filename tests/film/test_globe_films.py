"""Films of globes: sizes, numbers of frames, and that their frames are pages of the globe."""

import pickle

import numpy as np
import pytest

from stereodel.drawing import View
from stereodel.drawing.page.fonts import MissingCharactersWarning
from stereodel.film import Film, Spin
from stereodel.globe import Globe

PARIS = (2.35, 48.86)


@pytest.fixture(scope="module")
def globe():
    globe = Globe()
    globe.add_land(resolution="110m")
    globe.add_coastlines(resolution="110m")
    globe.add_points([PARIS])
    return globe


def test_frames_are_the_globe_in_the_middle(globe):
    clip = Film.of_globe(globe, Spin(seconds=2.0), size=(160, 90), fps=5)
    assert (len(clip), clip.fps, clip.duration) == (10, 5, pytest.approx(2.0))
    wide = pickle.loads(pickle.dumps(clip)).picture(3)  # as other processes have it
    assert wide.shape == (90, 160, 3)
    square = globe.page(None, View(-108.0, 20.0), width=90 * 0.375 * 8**0.5).pixels(size=90)
    assert np.abs(wide[:, 35:125].astype(int) - square).mean() < 1
    assert (wide[:, :30] == 255).all()
    assert (wide[:, -30:] == 255).all()


@pytest.mark.parametrize("size", [(90, 160), (91, 47), (64, 64)])
def test_pages_have_the_size_asked_for(globe, size):
    clip = Film.of_globe(globe, Spin(), size=size, fps=1, background="#000033")
    picture = clip.picture(0)
    assert picture.shape == (size[1], size[0], 3)
    assert tuple(picture[0, 0]) == (0, 0, 51)
    ink = np.flatnonzero((picture != (0, 0, 51)).any(axis=(0, 2)))
    assert abs(ink[0] + ink[-1] - (size[0] - 1)) <= 1


@pytest.mark.parametrize(
    ("motion", "options", "message"),
    [
        *((Spin(), {"size": size}, "size") for size in ((0, 720), (1280, -1), (65536, 10))),
        (Spin(), {"size": (20000, 10000)}, "size makes frames of 20000 × 10000 pixels; give at most 67108864"),
        (Spin(), {"size": (100, 17000)}, "at most 16384"),
        (Spin(), {"background": "no such color"}, "background"),
        *((Spin(), {"fps": fps}, "fps") for fps in (0.0, float("nan"))),
        (Spin(seconds=0.1), {"fps": 2.0}, r"a motion of 0\.1 s has no frame at 2 frames a second"),
        (Spin(seconds=1e9), {}, r"a motion of 1e\+09 s has 2.5e\+10 frames at 25 frames a second, and at most 100000"),
        (Spin(seconds=1e308), {"fps": 1e308}, "and at most 100000 are drawn; give fewer seconds or a smaller fps"),
    ],
)
def test_what_cannot_be_is_refused_before_anything_is_drawn(globe, monkeypatch, tmp_path, motion, options, message):
    monkeypatch.setattr(Globe, "page", None)
    with pytest.raises(ValueError, match=message):
        Film.of_globe(globe, motion, **options).save(tmp_path / "high.mp4")
    assert list(tmp_path.iterdir()) == []


def test_shots_are_made_when_they_are_asked_for(globe):
    """A film of an hour is there at once and holds nothing; its shots are those of the motion."""

    class Counted:
        seconds, asked = 4000.0, 0

        def __call__(self, time):
            self.asked += 1
            return Spin(seconds=4000.0)(time)

    motion = Counted()
    film = Film.of_globe(globe, motion)
    assert len(film) == 100_000
    assert motion.asked == 0
    assert film.shots[25][1] == film.shots[-99_975][1] == Spin(seconds=4000.0)(1.0)[1]
    assert motion.asked == 2
    with pytest.raises(IndexError):
        film.shots[100_000]


def test_lines_and_type_of_small_films_are_smaller_in_pixels_not_in_the_picture():
    """Below 720 pixels their share of the picture grows with the root of what it shrinks by: heavy they never are."""
    globe = Globe()
    globe.add_labels([(0.0, 20.0)], ["name"])
    widths = {}
    for size in (160, 320, 720, 1440):
        page = Film.of_globe(globe, Spin(), size=(size, size)).page(0)
        assert page.width / page.height == pytest.approx(1.0)
        widths[size] = size / page.width  # pixels a point
    assert widths[720] == widths[1440] == pytest.approx(8 / 3)
    assert widths[320] == pytest.approx(8 / 3 * (320 / 720) ** 0.5)
    assert widths[160] == pytest.approx(8 / 3 * (160 / 720) ** 0.5)


def test_a_film_warns_once_of_characters_that_no_font_has(tmp_path, no_other_fonts):
    globe = Globe()
    globe.add_labels([(0.0, 20.0)], ["東京"])
    film = Film.of_globe(globe, Spin(seconds=0.3, turns=0.001), size=(60, 60), fps=10)
    with pytest.warns(MissingCharactersWarning, match=r"U\+4EAC .*U\+6771") as told:
        film.save(tmp_path / "a.gif", jobs=1, progress=False)
    assert len(told) == 1
