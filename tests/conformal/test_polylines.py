"""Images of many great-circle arcs: on the exact circles, through the images of their ends, no chord too long."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from stereodel import MoebiusMap, fisheye
from stereodel.conformal.polylines import image_of_polylines, largest_scale
from stereodel.sphere import SphereArc

lonlats = st.tuples(st.floats(-180, 180), st.floats(-89, 89))
sizes = st.floats(-6, 6).map(lambda e: 10.0**e)


def lens_of(focus, size, turn):
    return MoebiusMap.rotation((30.0, 40.0), turn) @ fisheye(focus, magnification=size)


@given(start=lonlats, end=lonlats, focus=lonlats, size=st.floats(-3, 3).map(lambda e: 10.0**e), turn=st.floats(0, 360))
def test_images_of_arcs_stay_within_the_tolerance(start, end, focus, size, turn):
    """Points all along the exact image are within the tolerance of the polyline, wherever the focus is."""
    assume(max(abs(start[0] - end[0]), abs(start[1] - end[1])) > 1e-3)
    assume(abs(start[1] + end[1]) > 1e-6 or abs(abs(start[0] - end[0]) - 180) > 1e-6)
    arc = SphereArc.great(start, end)
    assume(1e-6 < arc.angle_rad < 3.1)
    lens = lens_of(focus, size, turn)
    tolerance = 1e-3
    points, offsets = image_of_polylines(lens, np.stack([arc.start, arc.end]), np.array([0, 2]), tolerance=tolerance)
    assert offsets.tolist() == [0, len(points)]
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1.0, atol=1e-12)
    exact = lens.image_of(arc)
    truth = exact.sample(2000)
    a, b = points[:-1], points[1:]
    way = b - a
    share = np.clip(np.sum((truth[:, None] - a) * way, axis=-1) / np.maximum(np.sum(way**2, axis=-1), 1e-300), 0.0, 1.0)
    gap = np.linalg.norm(truth[:, None] - (a + share[..., None] * way), axis=-1).min(axis=1)
    assert gap.max() <= tolerance * (1 + 1e-6) + 1e-9


@given(focus=lonlats, size=sizes, at=lonlats, radius=st.floats(0, 3), seed=st.integers(0, 100))
def test_no_scale_nearby_is_larger_than_the_bound(focus, size, at, radius, seed):
    lens = fisheye(focus, magnification=size)
    rng = np.random.default_rng(seed)
    center = SphereArc.great(at, (at[0] + 1.0, at[1] * 0.5)).start
    other = rng.normal(size=(200, 3))
    side = other - np.outer(other @ center, center)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    angle = (radius * rng.random(200))[:, None]
    points = np.cos(angle) * center + np.sin(angle) * side
    bound = largest_scale(lens, center[None], np.array([radius]))[0]
    assert lens.scale_factor(points).max() <= bound * (1 + 1e-6)
    assert bound <= max(size, 1 / size) * (1 + 1e-12)


def test_lines_keep_to_themselves():
    """Several lines at once are each alone; empty ones, points and repeated points do no harm."""
    rng = np.random.default_rng(5)
    points = rng.normal(size=(12, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    points[7] = points[6]
    offsets = np.array([0, 4, 4, 5, 12])
    lens = fisheye((10.0, 20.0), magnification=7.0)
    images, ends = image_of_polylines(lens, points, offsets, tolerance=1e-3)
    for k in range(4):
        alone, _ = image_of_polylines(
            lens, points[offsets[k] : offsets[k + 1]], np.array([0, offsets[k + 1] - offsets[k]]), tolerance=1e-3
        )
        np.testing.assert_allclose(images[ends[k] : ends[k + 1]], alone, atol=1e-15)
    assert ends[1] == ends[2] == ends[3] - 1


@pytest.mark.parametrize("size", [1.0, 1e3, 1e9])
def test_a_meridian_through_the_focus_fills_the_front(size):
    """However far its ends are from the focus, a line through it is drawn all the way round."""
    lens = fisheye((0.0, 0.0), magnification=size)
    ends = np.array([[np.cos(1.5), 0.0, -np.sin(1.5)], [np.cos(1.5), 0.0, np.sin(1.5)]])
    points, _ = image_of_polylines(lens, ends, np.array([0, 2]), tolerance=1e-4)
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).max() < 0.03
    assert np.linalg.norm(points - [1.0, 0.0, 0.0], axis=1).min() < 0.02
