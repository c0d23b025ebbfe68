"""Grids that are thinned: lines end exactly where their neighbours come too near, and nothing runs together."""

import tracemalloc

import numpy as np
import pytest

from stereodel import MoebiusMap, fisheye, lonlat_to_xyz, xyz_to_lonlat
from stereodel.constants import MOST_GRID_LINES
from stereodel.curves.chart import Chart
from stereodel.drawing import StereographicView, View
from stereodel.drawing.scene.graticule import Graticule, usual_spacing
from stereodel.globe.outlines_on_sphere import SphereLines
from stereodel.sphere import graticule, graticule_patch
from tests.tiers import by_day

NONE = MoebiusMap.identity()
LENSES = [NONE, fisheye((10.0, 40.0), magnification=4.0), fisheye((-70.0, -35.0), magnification=0.02)]
VIEWS = [View(10, 40), View(180, -40, 15), StereographicView(0, 70, angular_radius=120)]


@pytest.mark.parametrize("spacing", by_day([7.5, 10, 20, 36], 20))
def test_where_there_is_room_all_is_drawn(spacing):
    for grid, arcs in (
        (Graticule.regular(spacing), graticule(spacing)),
        (Graticule.patch((0, 40), 8, 1), graticule_patch((0, 40), 8, 1)),
    ):
        for lens in LENSES:
            drawn = grid.drawn(lens, VIEWS[0], 0.0)
            assert len(drawn) == len(arcs)
            for image, arc in zip(drawn, arcs, strict=True):
                points = image.sample(np.linspace(0, 1, 5) * image.stop)
                true = lens.image_of(arc)
                assert np.allclose(points @ true.circle.normal, true.circle.offset, atol=1e-12)
                assert np.allclose(points[[0, -1]], [true.start, true.end], atol=1e-9)
                assert image.stop == pytest.approx(true.angle_rad)


@pytest.mark.parametrize(
    ("spacing", "whole", "strides"),
    [(5, [-180, -90, 0, 90], {0, 1, 2, 6}), (10, [-180, -90, 0, 90], {0, 1, 3}), (20, [-180, 0], {0, 1, 3})],
)
def test_lines_that_always_stay(spacing, whole, strides):
    grid = Graticule.regular(spacing)
    kept = grid.thinned(Chart(NONE, View(0, 0)), 100.0)
    lons = xyz_to_lonlat(kept.points(np.arange(len(kept)), (kept.begin + kept.stop) / 2))[:-1, 0]
    assert sorted((lons + 180 + 1e-9) % 360 - 180 - 1e-9) == pytest.approx(whole)
    assert (kept.axis[-1] == [0, 0, 1]).all()
    assert kept.offset[-1] == 0
    assert kept.stop[-1] - kept.begin[-1] == 2 * np.pi
    assert set(grid.strides.tolist()) == strides


@pytest.mark.parametrize("lens", by_day(LENSES, LENSES[1]))
@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("grid", [Graticule.regular(5), Graticule.patch((10, 40), 10, 1)], ids=["graticule", "patch"])
def test_lines_end_where_their_neighbours_come_too_near_on_the_page(lens, view, grid):
    """By an oracle of its own: differences on the page."""
    least, checked = 0.03, 0
    shown = grid.thinned(Chart(lens, view), least)
    for k, line in enumerate(shown.edge):
        stride, whole = grid.strides[line], (grid.arcs.start[line], grid.arcs.end[line])
        for place in (shown.start[k], shown.end[k]):
            if stride and not any(np.array_equal(place, end) for end in whole):
                gap = spacing(place, lens, view, np.degrees(grid.step), meridian=line < grid.meridians)
                if gap is not None:
                    assert gap * stride == pytest.approx(least, rel=2e-3)
                    checked += 1
    assert checked > 0 or grid.meridians < 50


@pytest.mark.parametrize("lens", by_day(LENSES, LENSES[1]))
@pytest.mark.parametrize("view", VIEWS)
def test_what_is_drawn_is_all_that_has_room(lens, view):
    grid, least = Graticule.regular(10), 0.03
    shown = grid.thinned(Chart(lens, view), least)
    for line in range(len(grid.arcs)):
        t = grid.arcs.begin[line] + np.linspace(0.001, 0.999, 40) * (grid.arcs.stop - grid.arcs.begin)[line]
        parts = np.flatnonzero(shown.edge == line)
        for angle, place in zip(t, grid.arcs.points(np.full(40, line), t), strict=True):
            gap = spacing(place, lens, view, 10.0, meridian=line < grid.meridians)
            if gap is None or abs(gap * grid.strides[line] - least) < 1e-3:
                continue
            wanted = grid.strides[line] == 0 or gap * grid.strides[line] > least
            inside = [shown.begin[k] <= angle + turn <= shown.stop[k] for k in parts for turn in (0, 2 * np.pi)]
            assert any(inside) == wanted


@pytest.mark.parametrize("latitude", ["spherical", "authalic"])
@pytest.mark.parametrize("degrees", by_day([2, 5, 36], 5))
def test_the_lines_of_a_picture_are_all_of_the_graticule_that_it_shows(degrees, latitude):
    """For lenses and views of every kind."""
    rng = np.random.default_rng(int(10 * degrees))
    whole = Graticule.regular(degrees, latitude=latitude)
    for number in range(10):
        focus, size = rng.uniform([-180, -90], [180, 90]) if number % 4 else (30.0, 90.0), 10 ** rng.uniform(-2, 4)
        other = StereographicView(*rng.uniform([-180, -90], [180, 90]), angular_radius=rng.uniform(30, 150))
        view = View(*focus) if number % 2 else other
        assert_same_lines(whole, fisheye(focus, magnification=size), view, 0.02, degrees, latitude=latitude)


@pytest.mark.parametrize("size", by_day([3, 30, 300], 30))
@pytest.mark.parametrize("focus", [(30.0, 0.0), (30.0, 0.2), (30.0, 20.0)])
def test_no_line_is_lost_where_room_is_scarce(focus, size):
    """The focus at the edge of a flat map, where both lens and view are largest: lines end just beside it."""
    for least in (0.02, 0.05, 0.2):
        lens, view = fisheye(focus, magnification=size), StereographicView(focus[0] - 89.9, 0)
        assert_same_lines(Graticule.regular(1), lens, view, least, 1)


def assert_same_lines(whole, lens, view, least, degrees, **options):
    """Bit for bit."""
    chart = Chart(lens, view)
    some = Graticule.shown(degrees, chart, least, **options)
    seen, expected = (SphereLines.alone(grid.thinned(chart, least)).on(chart)[0] for grid in (some, whole))
    assert np.array_equal(seen.values, expected.values)
    assert np.array_equal(seen.offsets, expected.offsets)


@pytest.mark.parametrize("degrees", [15, 0.01, 1e-9, 180 / 1_000_003])
@pytest.mark.parametrize("focus", [(2.35, 48.86), (0, 90), (30, 89.9), (179.9999, 0)])
def test_however_fine_a_grid_is_a_picture_has_some_thousand_lines(degrees, focus):
    """Neighbours that a picture shows are so far apart, 0.0032 radii, that no more have room."""
    for size in (1, 1e3, 1e6, 1e9, 1e12, 1e-6):
        lens = fisheye(focus, magnification=size)
        for view in (View(*focus), View(focus[0] + 100, -focus[1]), StereographicView(*focus, angular_radius=150)):
            assert len(Graticule.shown(degrees, Chart(lens, view), 0.0032).arcs) < 10_000


@pytest.mark.parametrize("size", [1, 3, 20, 1e3, 1e6, 1e9, 1e11])
@pytest.mark.parametrize("focus", [(2.35, 48.86), (-70, -12)])
def test_usual_spacings_suit_the_picture(size, focus):
    lens, view = fisheye(focus, magnification=size), View(*focus)
    chart = Chart(lens, view)
    degrees = usual_spacing(chart)
    across = 4 * np.degrees(np.arctan(1 / size))
    assert across / degrees == pytest.approx(12, rel=0.6)
    crossed, _ = SphereLines.alone(Graticule.shown(degrees, chart, 0.0032).arcs).on(chart)
    assert 12 <= len(crossed) <= 60
    assert usual_spacing(Chart(lens, View(focus[0] + 180, -focus[1]))) == 15.0


def spacing(end, lens, view, step, *, meridian):
    """Of neighbours at a place, None where it is out of sight or at the limb."""
    lon, lat = xyz_to_lonlat(end)
    small = 1e-4
    steps = np.array([[0, 0], [small, 0], [-small, 0], [0, small], [0, -small]])
    axes = lens(lonlat_to_xyz(steps + [lon, lat])) @ view.matrix.T
    if abs(lat) > 89.9 or axes[0, 2] < view.edge + 1e-3:
        return None
    page = view.flattened(axes)
    east, north = (page[1] - page[2]) / 2, (page[3] - page[4]) / 2
    area = abs(east[0] * north[1] - east[1] * north[0])
    return step / small * area / np.hypot(*(north if meridian else east))


def asked(rng):
    """How many lines a random picture asks for, and what it is: radii and magnifications of all sizes."""
    focus = rng.uniform(-180, 180), float(rng.choice([rng.uniform(-90, 90), 90, -90, 89.9999, 0]))
    place = focus if rng.random() < 0.5 else rng.uniform((-180, -90), (180, 90))
    flat = StereographicView(*place, angular_radius=min(170.0, 10 ** rng.uniform(-7, 2.26)))
    view = View(*place) if rng.random() < 0.2 else flat
    lens = fisheye(focus, magnification=10 ** rng.uniform(-3, 6))
    spacing = usual_spacing(Chart(lens, view)) if rng.random() < 0.5 else float(rng.choice([15, 1, 0.1, 1e-3, 1e-6]))
    return len(Graticule.shown(spacing, Chart(lens, view), 0.0032).arcs), (spacing, lens, view)


@pytest.mark.parametrize("seed", by_day(range(13), 0))
def test_no_picture_asks_for_lines_without_number(seed):
    """A view of a small part that a lens shrinks asked for millions, of the scale that the lens has elsewhere."""
    rng = np.random.default_rng(seed)
    count, picture = max((asked(rng) for _ in range(300)), key=lambda found: found[0])
    assert count < MOST_GRID_LINES / 2, picture
    lens = fisheye((-37.9, 0), magnification=0.005)
    chart = Chart(lens, StereographicView(-37.9, 0, angular_radius=0.0036))
    assert len(Graticule.shown(1e-6, chart, 0.003).arcs) < 10_000


def test_lines_without_number_are_refused_before_they_are_made():
    tracemalloc.start()
    with pytest.raises(ValueError, match="over 65536 lines"):
        Graticule.shown(1e-9, Chart(fisheye((0, 0), magnification=1e-3), View(0, 0)), 1e-8)
    assert tracemalloc.get_traced_memory()[1] < 10e6
    tracemalloc.stop()


def test_many_lines_take_little_memory():
    """The most that have room at a usual width, around the pole."""
    chart, least = Chart(fisheye((0, -90), magnification=790), View(0, -30)), 0.0032
    grid = Graticule.shown(0.05, chart, least)
    assert len(grid.arcs) > 1500
    tracemalloc.start()
    grid.thinned(chart, least)
    assert tracemalloc.get_traced_memory()[1] < 60e6
    tracemalloc.stop()


@pytest.mark.parametrize("radius", [1e-6, 1e-4])
def test_a_tiny_view_under_a_lens_asks_for_little(radius):
    """The cap is known by its angle: its cosine is 1, or 15 % off. Hidden parts of lines have no points between."""
    lens, view = fisheye((10.0, 40.0), magnification=1e3), StereographicView(10, 40, angular_radius=radius)
    chart = Chart(lens, view)
    assert np.degrees(chart.source.radius) == pytest.approx(radius / 1e3, rel=1e-9)
    spacing = usual_spacing(chart)
    assert radius / 1e3 / 10 < spacing < radius / 1e3 / 4
    grid = Graticule.shown(spacing, chart, 0.003)
    assert len(grid.arcs) < 200
    lines, _ = SphereLines.alone(grid.thinned(chart, 0.003)).on(chart)
    assert 0 < len(lines.values) < 1e5
