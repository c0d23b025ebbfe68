import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.sphere import (
    SphereArc,
    SphereCircle,
    angular_distance,
    graticule,
    graticule_patch,
    great_circle_points,
    lonlat_to_xyz,
    meridian,
    parallel,
    xyz_to_lonlat,
)
from tests.strategies import BETWEEN_POLES


@given(BETWEEN_POLES, BETWEEN_POLES)
def test_great_arc(start, end):
    a, b = lonlat_to_xyz(start), lonlat_to_xyz(end)
    if not 1e-9 < angular_distance(a, b) < 180 - 1e-9:
        return
    arc = SphereArc.great(start, end)
    assert np.degrees(arc.length) == pytest.approx(float(angular_distance(a, b)), abs=1e-13)
    center, u, v, sweep_rad = arc.frame()
    assert (center == 0).all()
    assert np.abs(center + u - a).max() < 4e-16
    assert np.abs(np.cos(sweep_rad) * u + np.sin(sweep_rad) * v - b).max() < 1e-15
    assert np.abs(arc.sample(5) - great_circle_points(a, b, 5)).max() < 1e-15
    assert np.linalg.det([u, v, arc.circle.normal]) == pytest.approx(1)


@given(BETWEEN_POLES, st.floats(1e-9, 179.0), st.floats(0, 6.28), st.floats(0.01, 6.28))
def test_arc_of_any_circle(center, radius, first, sweep):
    circle = SphereCircle.around(center, radius)
    middle, u, v, _ = SphereArc.whole(circle).frame()
    start, end = (middle + np.cos(t) * u + np.sin(t) * v for t in (first, first + sweep))
    arc = SphereArc(circle, start, end)
    assert arc.angle_rad == pytest.approx(sweep, abs=1e-15 / circle.radius + 1e-15)
    points = arc.sample(6)
    assert np.abs(points @ circle.normal - circle.offset).max() < 1e-15
    middle, u, v, sweep_rad = arc.frame()
    assert np.abs(middle + np.cos(sweep_rad) * u + np.sin(sweep_rad) * v - end).max() < 2e-15


def test_whole_circle_is_closed():
    circle = SphereCircle.around((20, 30), 40)
    arc = SphereArc.whole(circle)
    assert arc.closed
    assert arc.length == pytest.approx(2 * np.pi * np.sin(np.radians(40)))
    assert (arc.sample(9)[0] == arc.sample(9)[-1]).all()
    assert SphereArc(circle, arc.start, arc.start).closed


def test_great_arc_of_neighbours_one_step_apart():
    a, b = np.array([1.0, 1.0, 0.0]), np.array([1.0, np.nextafter(1, 2), 0.0])
    assert SphereArc.great(a, b).length == pytest.approx(2.0**-53, rel=1e-6)
    assert angular_distance(a, b) == pytest.approx(np.degrees(2.0**-53), rel=1e-6)


@given(st.floats(-180, 179), st.floats(-89, 89))
def test_meridians_and_parallels(lon, lat):
    line = meridian(lon).sample(9)
    assert (line[0] == [0, 0, -1]).all()
    assert (line[-1] == [0, 0, 1]).all()
    inner = xyz_to_lonlat(line[1:-1])
    assert np.abs((inner[:, 0] - lon + 180) % 360 - 180).max() < 1e-12
    assert (np.diff(inner[:, 1]) > 0).all()
    ring = xyz_to_lonlat(parallel(lat).sample(5))
    assert ring[:, 1] == pytest.approx(lat, abs=1e-12)
    assert np.abs(ring[:4, 0] - [0, 90, -180, -90]).max() < 1e-12


@pytest.mark.parametrize(("spacing", "count"), [(10, 36 + 17), (5, 72 + 35), (30, 12 + 5), (60, 6 + 3), (7.5, 48 + 23)])
def test_graticule_counts(spacing, count):
    lines = graticule(spacing)
    assert len(lines) == count
    assert len({line.circle for line in lines}) == count
    latitudes = [line.circle.offset for line in lines if line.closed]
    assert latitudes == pytest.approx([-value for value in reversed(latitudes)], abs=0)
    assert 0.0 in latitudes


@pytest.mark.parametrize(("half_width", "spacing", "lines"), [(8, 2, 9), (8, 1, 17), (1.5, 0.5, 7), (0.3, 0.1, 7)])
def test_graticule_patch(half_width, spacing, lines):
    arcs = graticule_patch((0, 40), half_width, spacing)
    assert len(arcs) == 2 * lines
    for arc in arcs:
        assert np.degrees(arc.angle_rad) == pytest.approx(2 * half_width)
        lonlat = xyz_to_lonlat(arc.sample(5))
        assert np.abs(lonlat - [0, 40]).max() <= half_width + 1e-12
        center, u, v, sweep = arc.frame()
        assert np.abs(center + np.cos(sweep) * u + np.sin(sweep) * v - arc.end).max() < 1e-15
    first_meridian, first_parallel = xyz_to_lonlat(arcs[0].sample(2)), xyz_to_lonlat(arcs[lines].sample(2))
    assert np.abs(first_meridian - [[-half_width, 40 - half_width], [-half_width, 40 + half_width]]).max() < 1e-12
    assert np.abs(first_parallel - [[-half_width, 40 - half_width], [half_width, 40 - half_width]]).max() < 1e-12


def test_great_circle_points_of_many_pairs():
    a = np.array([[1.0, 0, 0], [0, 5.0, 0]])
    points = great_circle_points(a, [0, 0, 1], 4)
    assert points.shape == (2, 4, 3)
    assert np.abs(angular_distance(points[:, :-1], points[:, 1:]) - 30).max() < 1e-13
    assert (great_circle_points(a, a, 3) == [[[1, 0, 0]] * 3, [[0, 1, 0]] * 3]).all()
