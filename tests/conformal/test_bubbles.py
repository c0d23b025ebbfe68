"""Claims P16 and P17: any bubble onto any other, point to point, uniquely up to a turn; how much the scale varies."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.conformal import MoebiusMap, bubble_to_bubble, distortion, fisheye
from stereodel.sphere import Rotation, SphereArc, SphereCircle, angular_distance
from tests.examples import examples
from tests.strategies import BETWEEN_POLES

BUBBLES = st.builds(SphereCircle.around, BETWEEN_POLES, st.floats(0.5, 179.5))
PLACES = st.tuples(st.floats(0, 0.95), st.floats(0, 360))


def inside(bubble, place):
    """The point of a bubble at a fraction of its radius from the centre."""
    fraction, bearing = place
    start = bubble.sample(1)[0]
    edge = Rotation.about(bubble.center, bearing)(start)
    return Rotation.about(np.cross(bubble.center, edge), fraction * bubble.angular_radius)(bubble.center)


def same(a, b):
    return angular_distance(a.center, b.center) < 1e-9 and abs(a.angular_radius - b.angular_radius) < 1e-9


@given(BUBBLES, BUBBLES, PLACES, PLACES, st.floats(-360, 360))
@examples(0.2)
def test_p16_bubble_to_bubble_and_point_to_point(source, target, start, end, turn):
    p, q = inside(source, start), inside(target, end)
    conformal = bubble_to_bubble(source, target, p, q, turn=turn)
    assert same(conformal.image_of(source), target)
    assert angular_distance(conformal(p), q) < 1e-9
    assert same(conformal.inverse().image_of(target), source)


@given(BUBBLES, BUBBLES, PLACES, PLACES, st.floats(1, 359))
@examples(0.2)
def test_p16_the_turn_is_the_angle_at_the_target_point(source, target, start, end, turn):
    p, q = inside(source, start), inside(target, end)
    plain, turned = bubble_to_bubble(source, target, p, q), bubble_to_bubble(source, target, p, q, turn=turn)
    step = 1e-6 / float(plain.scale_factor(p))
    ahead = p + step * np.linalg.svd(p[None])[2][1]
    a, b = plain(ahead) - q, turned(ahead) - q
    angle = np.degrees(np.arctan2(np.dot(q, np.cross(a, b)), np.dot(a, b)))
    assert abs((angle - turn + 180) % 360 - 180) < 0.1


@given(BUBBLES, BUBBLES, PLACES, PLACES, st.floats(-180, 180))
@examples(0.2)
def test_p16_unique_up_to_the_turn(source, target, start, end, turn):
    # Another way to a map with the same properties differs by a turn about the point: a map of the target
    # bubble onto itself that fixes a point and turns by nothing is the identity.
    p, q = inside(source, start), inside(target, end)
    there = bubble_to_bubble(source, target, p, q, turn=turn)
    back = bubble_to_bubble(target, source, q, p, turn=-turn)
    loop = there @ back
    assert same(loop.image_of(target), target)
    step = 1e-6
    ahead = q + step * np.linalg.svd(q[None])[2][1]
    angle = np.degrees(turned_by(loop, q, ahead))
    assert (bubble_to_bubble(target, target, q, q, turn=-angle) @ loop).is_close(MoebiusMap.identity(), tolerance=1e-4)


def turned_by(conformal, fixed, ahead):
    a, b = ahead - fixed, conformal(ahead) - conformal(fixed)
    return float(np.arctan2(np.dot(fixed, np.cross(a, b)), np.dot(a, b)))


@given(BUBBLES, PLACES)
@examples(0.2)
def test_no_turn_onto_itself_is_the_identity(bubble, place):
    p = inside(bubble, place)
    assert bubble_to_bubble(bubble, bubble, p, p).is_close(MoebiusMap.identity(), tolerance=1e-12)


@given(BETWEEN_POLES, st.floats(1, 179), st.floats(1, 179))
@examples(0.2)
def test_centres_by_default_give_the_fisheye(center, first, second):
    a, b = SphereCircle.around(center, first), SphereCircle.around(center, second)
    size = np.tan(np.radians(second) / 2) / np.tan(np.radians(first) / 2)
    assert bubble_to_bubble(a, b).is_close(fisheye(center, magnification=size), tolerance=1e-12)


@given(BETWEEN_POLES, st.floats(1, 90), BETWEEN_POLES, st.floats(1, 90))
@examples(0.2)
def test_p17_scales_differ_by_at_most_1_to_2(source, chi0, target, xi0):
    bubble = SphereCircle.around(source, chi0)
    conformal = bubble_to_bubble(bubble, SphereCircle.around(target, xi0))
    radius = SphereArc.great(bubble.center, bubble.sample(1)[0]).sample(50)
    scale = conformal.scale_factor(radius)
    ratio = np.cos(np.radians(chi0) / 2) ** 2 / np.cos(np.radians(xi0) / 2) ** 2
    assert scale[0] / scale[-1] == pytest.approx(ratio, rel=1e-11)
    assert scale.max() / scale.min() == pytest.approx(max(ratio, 1 / ratio), rel=1e-9)
    assert scale.max() / scale.min() <= 2 * (1 + 1e-11)
    summary = distortion(conformal, bubble)
    assert summary.largest / summary.smallest == pytest.approx(max(ratio, 1 / ratio), rel=1e-9)
    areas = np.sin(np.radians(xi0) / 2) ** 2 / np.sin(np.radians(chi0) / 2) ** 2
    assert summary.area_ratio == pytest.approx(areas, rel=1e-9)
