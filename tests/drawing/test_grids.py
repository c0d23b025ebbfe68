"""Grids that are thinned: lines end exactly where their neighbours come too near, and nothing runs together."""

import numpy as np
import pytest

from stereodel import MoebiusMap, fisheye, lonlat_to_xyz, xyz_to_lonlat
from stereodel.drawing import StereographicView, View
from stereodel.drawing.grids import Grid
from stereodel.sphere import graticule, graticule_patch

NONE = MoebiusMap.identity()
LENSES = [NONE, fisheye((10.0, 40.0), magnification=4.0), fisheye((-70.0, -35.0), magnification=0.02)]
VIEWS = [View(10, 40), View(180, -40, 15), StereographicView(0, 70, angular_radius=120)]


@pytest.mark.parametrize("spacing", [7.5, 10, 20, 36])
def test_where_there_is_room_all_is_drawn(spacing):
    for grid, arcs in (
        (Grid.graticule(spacing), graticule(spacing)),
        (Grid.patch((0, 40), 8, 1), graticule_patch((0, 40), 8, 1)),
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
    grid = Grid.graticule(spacing)
    kept = grid.thinned(NONE, View(0, 0), 100.0)
    lons = xyz_to_lonlat(kept.points(np.arange(len(kept)), (kept.begin + kept.stop) / 2))[:-1, 0]
    assert sorted((lons + 180 + 1e-9) % 360 - 180 - 1e-9) == pytest.approx(whole)
    assert (kept.axis[-1] == [0, 0, 1]).all()
    assert kept.offset[-1] == 0
    assert kept.stop[-1] - kept.begin[-1] == 2 * np.pi
    assert set(grid.strides.tolist()) == strides


def test_meridians_end_where_the_formula_says():
    # From above a pole the page shows neighbours Δλ·cos φ apart on meridians, whatever the depth.
    step, least = np.radians(10), 0.05
    grid = Grid.graticule(10)
    shown = grid.thinned(NONE, View(0, 90), least)
    north = shown.end[shown.edge < grid.meridians]
    lines = shown.edge[shown.edge < grid.meridians]
    assert sorted(lines) == list(range(36))
    for line, end in zip(lines, north, strict=True):
        stride = 0 if line % 9 == 0 else 3 if line % 3 == 0 else 1
        assert np.hypot(*end[:2]) == pytest.approx(least / stride / step if stride else 0.0, abs=1e-9)


@pytest.mark.parametrize("lens", LENSES)
@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("grid", [Grid.graticule(5), Grid.patch((10, 40), 10, 1)], ids=["graticule", "patch"])
def test_lines_end_where_their_neighbours_come_too_near_on_the_page(lens, view, grid):
    """By an oracle of its own: differences on the page."""
    least, checked = 0.03, 0
    shown = grid.thinned(lens, view, least)
    for k, line in enumerate(shown.edge):
        stride, whole = grid.strides[line], (grid.arcs.start[line], grid.arcs.end[line])
        for place in (shown.start[k], shown.end[k]):
            if stride and not any(np.array_equal(place, end) for end in whole):
                gap = spacing(place, lens, view, np.degrees(grid.step), meridian=line < grid.meridians)
                if gap is not None:
                    assert gap * stride == pytest.approx(least, rel=2e-3)
                    checked += 1
    assert checked > 0 or grid.meridians < 50


@pytest.mark.parametrize("lens", LENSES)
@pytest.mark.parametrize("view", VIEWS)
def test_what_is_drawn_is_all_that_has_room(lens, view):
    grid, least = Grid.graticule(10), 0.03
    shown = grid.thinned(lens, view, least)
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
