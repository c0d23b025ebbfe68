"""Films of globes: sizes, numbers of frames, and that their frames are pages of the globe."""

import numpy as np
import pytest
from PIL import Image

from stereodel.drawing import View
from stereodel.film import Film, Flight, Spin, Stop
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
    wide = clip.picture(3)
    assert wide.shape == (90, 160, 3)
    square = globe.page(None, View(-108.0, 20.0), width=90 * 0.375).pixels(size=90)
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


def test_the_same_film_twice_is_the_same_file(globe, tmp_path):
    trip = Flight([Stop(PARIS, hold=0.2), Stop(PARIS, 4.0, hold=0.2)])
    files = [
        Film.of_globe(globe, trip, size=(96, 54), fps=5).save(tmp_path / f"{jobs}.png", jobs=jobs, progress=False)
        for jobs in (1, 2)
    ]
    assert files[0].read_bytes() == files[1].read_bytes()
    with Image.open(files[0]) as image:
        assert (image.n_frames, image.size) == (round(5 * trip.seconds), (96, 54))


def test_bad_films_are_refused(globe):
    for size in ((0, 720), (1280, -1), (1280.5, 720)):
        with pytest.raises((ValueError, TypeError), match="size"):
            Film.of_globe(globe, Spin(), size=size)
    with pytest.raises(ValueError, match="background"):
        Film.of_globe(globe, Spin(), background="no such color")
    with pytest.raises(ValueError, match="fps"):
        Film.of_globe(globe, Spin(), fps=0.0)
    with pytest.raises(ValueError, match=r"a motion of 0\.1 s has no frame at 2 frames a second"):
        Film.of_globe(globe, Spin(seconds=0.1), fps=2.0)
