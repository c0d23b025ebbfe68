"""Films of globes: sizes, numbers of frames, and that their frames are pages of the globe."""

import pickle
from dataclasses import replace
from itertools import pairwise, product
from unittest.mock import Mock

import numpy as np
import pytest

from stereodel import data
from stereodel.drawing import Label, View
from stereodel.drawing.page.fonts import MissingCharactersWarning
from stereodel.drawing.page.labels import label_box
from stereodel.drawing.page.placing import meets
from stereodel.film import Film, Flight, Spin, Stop, standing
from stereodel.globe import Globe
from tests.tiers import by_day


@pytest.fixture(scope="module")
def globe():
    globe = Globe()
    globe.add_land(resolution="110m")
    globe.add_coastlines(resolution="110m")
    globe.add_points([(2.35, 48.86)])
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
    motion = Mock(spec=Spin, side_effect=Spin(seconds=4000.0), seconds=4000.0)
    film = Film.of_globe(globe, motion)
    assert len(film) == 100_000
    assert motion.call_count == 0
    assert film.shots[25][1] == film.shots[-99_975][1] == Spin(seconds=4000.0)(1.0)[1]
    assert motion.call_count == 2
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


CITIES = "LHR CDG BER MAD FCO VIE WAW BUD PRG BRU AMS CPH ARN OSL HEL FRA MUC ZRH MXP ATH IST SVO KBP CAI IKA DXB"
CITIES = f"{CITIES} DEL BOM TAS OVB PEK PVG HKG TPE ICN NRT KIX VVO BKK MNL".split()
"""By their airports."""

FRAMES = 70


@pytest.fixture(scope="module")
def journey():
    """From Europe to Tokyo, with the names of forty cities, as the command makes it."""
    globe = Globe()
    globe.add_land(resolution="110m")
    globe.add_graticule(15)
    globe.add_coastlines(resolution="110m")
    table = data.airports()
    places = [table.lonlat[table.iata == code][0] for code in CITIES]
    globe.add_points(places)
    globe.add_labels(places, CITIES, movable=True)
    trip = Flight([Stop((10.0, 50.0), 4.0), Stop((139.7, 35.7), 4.0)])
    return Film.of_globe(globe, trip, size=(480, 480), fps=FRAMES / trip.seconds)


def test_names_keep_their_sides_and_do_not_flicker(journey):
    sides, strengths = np.full((FRAMES, len(CITIES)), -1), np.zeros((FRAMES, len(CITIES)))
    for frame in range(FRAMES):
        for row, side, strength in journey.shots[frame][2][0]:
            sides[frame, row], strengths[frame, row] = side, strength
    assert len(CITIES) == 40
    assert (sides >= 0).sum(axis=1).min() >= 4
    assert (sides >= 0).sum(axis=1).mean() > 10
    changes = 0
    for course, strength in zip(sides.T, strengths.T, strict=True):
        seen = course[course >= 0]
        changes += np.count_nonzero(np.diff(seen))
        starts = np.flatnonzero(np.diff(course, prepend=-2))
        for start, end in zip(starts, [*starts[1:], FRAMES], strict=True):
            assert end - start >= 8 or start == 0 or end == FRAMES
            fading = np.minimum(np.arange(1, end - start + 1), 4) / 4
            expected = np.ones(end - start) if start == 0 else fading
            expected = np.minimum(expected, 1.0 if end == FRAMES else fading[::-1])
            assert (strength[start:end] == (expected if course[start] >= 0 else 0.0)).all()
    assert changes <= 3


def test_frames_show_names_where_they_were_placed_for_the_film(journey):
    """In any order and any process; none covers another, leaves the disc or is removed by the page."""
    page = journey.page(40)
    _, _, (names,) = journey.shots[40]
    assert [label.text for label in page.labels] == [CITIES[row] for row, _, _ in names]
    assert [label.color[3] for label in page.labels] == [strength for _, _, strength in names]
    assert 0 < min(label.color[3] for label in page.labels) < 1
    assert all(label.halo_color[3] <= 0.8 * label.color[3] for label in page.labels)
    unit = page.points_per_unit
    boxes = np.array([label_box(label, unit) for label in page.labels])
    assert not any(meets(box, np.delete(boxes, k, axis=0)) for k, box in enumerate(boxes))
    other = pickle.loads(pickle.dumps(journey))
    assert [item.name for item in other.page(40).items] == [item.name for item in page.items]
    # The first have priority: what comes later changes nothing of where they stand.
    fewer = Globe()
    *others, all_names = journey.draw.globe.layers
    fewer.layers = [*others, replace(all_names, xyz=all_names.xyz[:20], labels=all_names.labels[:20])]
    film = replace(journey, shots=replace(journey.shots, pages=replace(journey.draw, globe=fewer)))
    assert film.shots[40][2][0] == tuple(name for name in names if name[0] < 20)


@pytest.mark.parametrize("seed", by_day(range(30), 0))
def test_the_course_of_a_name_is_the_cheapest(seed, monkeypatch):
    """Against all courses of a short film with two sides."""
    monkeypatch.setattr(standing, "LEAST", 3)
    rng = np.random.default_rng(seed)
    price = np.where(rng.random((8, 2)) < 0.3, np.inf, rng.uniform(0, 60, (8, 2)))
    price *= rng.choice([1.0, 5.0])

    def cost(course):
        total = sum(standing.AWAY if side < 0 else price[frame, side] for frame, side in enumerate(course))
        for one, other in pairwise(course):
            if one != other:
                total += standing.CHANGING if min(one, other) >= 0 else standing.COMING
        starts = [0, *(k for k in range(1, 8) if course[k] != course[k - 1]), 8]
        short = any(end - start < 3 for start, end in list(pairwise(starts))[1:-1])
        return np.inf if short else total

    best = min(product((-1, 0, 1), repeat=8), key=cost)
    assert cost(standing.course(price).tolist()) == pytest.approx(cost(best))


def test_names_in_films_of_other_layers():
    """Fixed names fade at the limb, those of one's own layers are avoided, and a globe without names has no more."""
    globe = Globe()
    assert len(Film.of_globe(globe, Spin(seconds=2.0), size=(90, 90), fps=10).shots[3]) == 2
    globe.add_labels([(0.0, 20.0), (90.0, 20.0)], ["here", "there"])
    film = Film.of_globe(globe, Spin(seconds=4.0), size=(300, 300), fps=10)
    shown = [{row: strength for row, _, strength in film.shots[frame][2][0]} for frame in range(len(film))]
    assert shown[0] == {0: 1.0}
    assert {0.25, 0.5, 0.75, 1.0} == {strength for frame in shown for strength in frame.values()}
    assert any(1 in frame for frame in shown)

    here = globe.layers[-1].xyz[:1]

    class Own:
        def lay(self, chart):
            places, _ = chart.points(here)
            yield Label("here, too", tuple(places[0].tolist()), (2.0, 0.0), "left")

    globe.add(Own())
    shots = Film.of_globe(globe, Spin(seconds=4.0), size=(300, 300), fps=10).shots
    assert not any(row == 0 for frame in range(len(shots)) for row, side, _ in shots[frame][2][0] if side == 0)
