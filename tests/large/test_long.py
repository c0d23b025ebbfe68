"""What shows only after long: memory over ten thousand pictures in one process, a film of 24 000 frames."""

import gc
from functools import partial
from pathlib import Path

import av
import numpy as np
import pytest

from stereodel.data import cities
from stereodel.drawing.page import Dots, Page
from stereodel.film import Film
from stereodel.globe import Globe

pytestmark = pytest.mark.large

SAVES = 10_000
FRAMES = 24_000
GROWTH = 20e6
"""Bytes: of caches that fill, fonts that are loaded late, and parts of the heap that are kept."""


def memory():
    """Bytes of this process that are in memory."""
    gc.collect()
    return 4096 * int(Path("/proc/self/statm").read_text().split()[1])


@pytest.mark.parametrize("kind", ["svg", "pdf", "png"])
def test_memory_over_ten_thousand_pictures(tmp_path, kind):
    places = cities().lonlat[:40]

    def save(number):
        globe = Globe()
        globe.add_land(resolution="110m")
        globe.add_points(places + [number % 7, 0], values=np.arange(40.0) + number % 5, legend="value")
        globe.add_labels(places[:3], [f"Place {number % 11}"] * 3)
        globe.save(tmp_path / f"globe.{kind}", size=120)

    for number in range(SAVES // 20):
        save(number)
    before = memory()
    for number in range(SAVES):
        save(number)
    assert memory() - before < GROWTH


def page(far, x):
    return Page((0.0, 16.0, 0.0, 9.0), (Dots(np.array([[16 * x / far, 4.5]]), 4.0, (0.8, 0.1, 0.1, 1.0)),))


def test_a_film_of_twenty_four_thousand_frames(tmp_path):
    film = Film(partial(page, FRAMES), range(FRAMES), fps=24, size=64)
    film.save(tmp_path / "film.mp4")
    with av.open(str(tmp_path / "film.mp4")) as written:
        assert sum(1 for _ in written.decode(video=0)) == FRAMES
