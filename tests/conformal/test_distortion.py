"""Summaries of the scale over bubbles and points, against quadrature, samples and claim P17."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.conformal import Distortion, distortion, fisheye
from stereodel.conformal.distortions import largest_scale
from stereodel.sphere import SphereArc, SphereCircle, angular_distance, lonlat_to_xyz
from tests.examples import examples
from tests.strategies import BETWEEN_POLES, decades, maps

MAPS = maps(decades(-1.5, 1.5))
BUBBLES = st.builds(SphereCircle.around, BETWEEN_POLES, st.floats(0.01, 179.9))


def sampled(bubble, rings=60):
    """Points of a bubble in rings that share its area equally, and its circle."""
    heights = 1 - (1 - bubble.offset) * (np.arange(rings) + 0.5) / rings
    u, v = np.linalg.svd(bubble.normal[None])[2][1:]
    turn = np.linspace(0, 2 * np.pi, 120, endpoint=False)[:, None]
    circle = np.cos(turn) * u + np.sin(turn) * v
    inside = heights[:, None, None] * bubble.normal + np.sqrt(1 - heights**2)[:, None, None] * circle
    return inside.reshape(-1, 3), bubble.sample(360)


@given(MAPS, BUBBLES)
def test_extremes_bound_every_point_and_are_reached(conformal, bubble):
    summary = distortion(conformal, bubble)
    inside, edge = sampled(bubble)
    scale = conformal.scale_factor(np.concatenate([inside, edge, bubble.center[None]]))
    assert summary.smallest * (1 - 1e-9) <= scale.min()
    assert scale.max() <= summary.largest * (1 + 1e-9)
    for value, place in ((summary.smallest, summary.smallest_at), (summary.largest, summary.largest_at)):
        point = lonlat_to_xyz(place)
        assert conformal.scale_factor(point) == pytest.approx(value, rel=1e-12)
        assert angular_distance(bubble.center, point) <= bubble.angular_radius + 1e-9


@given(MAPS, BUBBLES)
@examples(0.2)
def test_mean_against_quadrature(conformal, bubble):
    a = (conformal.magnification + 1 / conformal.magnification) / 2
    b = (conformal.magnification - 1 / conformal.magnification) / 2
    c = bubble.center @ conformal.focus
    ring = lambda u: 1 / mpmath.sqrt((b * u - a * c) ** 2 + (1 - c * c))  # noqa: E731
    mean = mpmath.quad(ring, mpmath.linspace(bubble.offset, 1, 9)) / (1 - bubble.offset)
    if bubble.angular_radius > 1:
        assert distortion(conformal, bubble).mean == pytest.approx(float(mean), rel=1e-6)


@given(MAPS, BUBBLES)
@examples(0.2)
def test_area_ratio_is_the_mean_of_the_squared_scale(conformal, bubble):
    inside, _ = sampled(bubble, rings=200)
    summary = distortion(conformal, bubble)
    assert summary.area_ratio == pytest.approx((conformal.scale_factor(inside) ** 2).mean(), rel=0.05)
    other = distortion(conformal, bubble.complement).area_ratio
    share = (1 - bubble.offset) / 2
    assert share * summary.area_ratio + (1 - share) * other == pytest.approx(1, rel=1e-9)
    assert summary.smallest**2 * (1 - 1e-9) <= summary.area_ratio <= summary.largest**2 * (1 + 1e-9)
    assert summary.smallest * (1 - 1e-9) <= summary.mean <= summary.largest * (1 + 1e-9)


@pytest.mark.parametrize("s", [1e-9, 1e-3, 1 - 1e-9, 1.0, 1 + 1e-9, 20.0, 1e9])
@pytest.mark.parametrize("radius", [1e-9, 1e-3, 30.0, 179.999])
@pytest.mark.parametrize("side", [1, -1])
def test_around_focus_and_antipode(s, radius, side):
    # The mean of 1/(a − b u) from u = cos α to 1 is ln((a − b cos α)/(a − b)) / (b (1 − cos α)).
    lens = fisheye((0, 90), magnification=s)
    mean = distortion(lens, SphereCircle.around((0, 90 * side), radius)).mean
    with mpmath.workdps(60):
        a, b = (mpmath.mpf(s) + 1 / mpmath.mpf(s)) / 2, side * (mpmath.mpf(s) - 1 / mpmath.mpf(s)) / 2
        rest = 2 * mpmath.sin(mpmath.radians(mpmath.mpf(radius)) / 2) ** 2
        truth = 1 if b == 0 else mpmath.log(1 + b * rest / (a - b)) / (b * rest)
    assert mean == pytest.approx(float(truth), rel=1e-12)


def test_of_points():
    lens = fisheye((10, 20), magnification=4)
    points = [(10, 20), (40, 50), (-170, -20)]
    summary = distortion(lens, points)
    scale = lens.scale_factor(lonlat_to_xyz(points))
    assert summary == distortion(lens, lonlat_to_xyz(points))
    assert (summary.largest, summary.smallest) == (scale[0], scale[2])
    assert summary.mean == pytest.approx(scale.mean())
    assert summary.area_ratio == pytest.approx((scale**2).mean())
    assert summary.largest_at == pytest.approx((10, 20))
    assert summary.smallest_at == pytest.approx((-170, -20))
    assert isinstance(summary, Distortion)


@given(focus=BETWEEN_POLES, size=decades(-6, 6), at=BETWEEN_POLES, radius=st.floats(0, 3), seed=st.integers(0, 100))
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
