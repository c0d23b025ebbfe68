"""Several foci: cores are the conformal fisheye, rings keep their limit, nothing folds, the rest stays."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.conformal import FocusBlend, fisheye
from stereodel.sphere import Rotation, angular_distance, lonlat_to_xyz
from tests.examples import examples
from tests.strategies import decades

CITIES = [(-74.0, 40.7), (2.35, 48.86), (139.7, 35.7)]
SIZES = st.lists(decades(0.1, 2), min_size=3, max_size=3)
LIMITS = st.floats(20, 150)
BLENDS = st.builds(lambda sizes, limit: FocusBlend(CITIES, magnification=sizes, limit=limit), SIZES, LIMITS)


def sphere_points(count, seed):
    points = np.random.default_rng(seed).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None]


def around(blend, count=40):
    """Points in the disc of each focus, dense next to it."""
    places = []
    for focus in blend.foci:
        u, v = np.linalg.svd(focus[None])[2][1:]
        radius = np.radians(blend.width) * np.geomspace(1e-6, 1, count)[:, None]
        turn = np.linspace(0, 40, count)[:, None]
        places.append(np.cos(radius) * focus + np.sin(radius) * (np.cos(turn) * u + np.sin(turn) * v))
    return np.concatenate(places)


def jacobian(function, point, step):
    """The derivative in an oriented basis of the tangent plane, columns in space, and its orientation."""
    u = np.linalg.svd(point[None])[2][1]
    v = np.cross(point, u)
    columns = [(function(point + step * w) - function(point - step * w)) / (2 * step) for w in (u, v)]
    return np.stack(columns, axis=1), np.dot(function(point), np.cross(*columns))


@given(BLENDS)
@examples(0.2)
def test_stretches_are_those_of_the_derivative_and_nothing_folds(blend):
    for point in around(blend, 12):
        distance = np.linalg.norm(blend.foci - point, axis=1).min()
        matrix, orientation = jacobian(blend, point, 1e-3 * distance)
        largest, smallest = blend.stretches(point)
        assert np.linalg.svd(matrix)[1] == pytest.approx([largest, smallest], rel=2e-3, abs=1e-6)
        assert orientation > 0


@given(BLENDS)
@examples(0.2)
def test_cores_are_fisheyes(blend):
    for focus, size, radius in zip(blend.foci, blend.magnification, blend.core_radii, strict=True):
        u, v = np.linalg.svd(focus[None])[2][1:]
        angle = np.radians(radius) * np.linspace(0, 0.999, 9)[:, None]
        points = np.cos(angle) * focus + np.sin(angle) * (0.6 * u + 0.8 * v)
        assert blend(points) == pytest.approx(fisheye(focus, magnification=size)(points), abs=1e-16 * (20 + size))
        assert blend.stretches(points)[0] == pytest.approx(fisheye(focus, magnification=size).scale_factor(points))
        assert blend.angular_distortion(points).max() < 1e-5


@given(BLENDS)
def test_angles_are_off_by_the_limit_at_most_and_it_is_reached(blend):
    off = blend.angular_distortion(around(blend, 400))
    assert off.max() <= blend.limit * (1 + 1e-9)
    assert off.max() == pytest.approx(blend.limit, rel=1e-6)


@given(BLENDS)
def test_outside_the_discs_nothing_moves_and_the_rim_is_smooth(blend):
    points = sphere_points(500, 1)
    outside = np.min([angular_distance(points, focus) for focus in blend.foci], axis=0) > blend.width
    assert np.abs(blend(points) - points)[outside].max() < 4e-16
    for focus in blend.foci:
        u = np.linalg.svd(focus[None])[2][1]
        for side in (-1, 1):
            angle = np.radians(blend.width) + side * 1e-7
            point = np.cos(angle) * focus + np.sin(angle) * u
            assert np.abs(blend(point) - point).max() < 1e-12
            assert np.ravel(blend.stretches(point)) == pytest.approx([1, 1], abs=1e-4)


@given(BLENDS)
def test_along_a_ray_points_keep_their_order(blend):
    for focus in blend.foci:
        u = np.linalg.svd(focus[None])[2][1]
        angle = np.radians(blend.width) * np.concatenate([[0], np.geomspace(1e-6, 1, 400)])[:, None]
        images = blend(np.cos(angle) * focus + np.sin(angle) * u)
        assert (np.diff(angular_distance(images, focus)) > 0).all()
        assert np.abs(images @ np.cross(focus, u)).max() < 1e-16 * (20 + blend.magnification.max())


def test_discs_meet_where_nothing_else_is_said():
    width = FocusBlend(CITIES, magnification=4.0).width
    assert width == pytest.approx(angular_distance(*lonlat_to_xyz(CITIES[:2])) / 2)
    assert FocusBlend([(0, 0)], magnification=4.0).width == 90


def test_what_magnifies_nothing_moves_nothing():
    points = sphere_points(60, 3)
    assert FocusBlend(CITIES, magnification=1.0)(1e-300 * points) == pytest.approx(points, abs=1e-15)


def test_it_turns_with_its_foci():
    turn, points = Rotation((0.3, -0.5, 0.2, 0.7)), sphere_points(300, 2)
    blend = FocusBlend(CITIES, magnification=[4, 10, 2], width=20)
    turned = FocusBlend(turn(lonlat_to_xyz(CITIES)), magnification=[4, 10, 2], width=20)
    assert np.abs(turned(turn(points)) - turn(blend(points))).max() < 1e-13
