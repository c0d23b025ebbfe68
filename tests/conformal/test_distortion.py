"""Summaries of the scale over bubbles and points, against quadrature, samples and claim P17."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stereodel.conformal import Distortion, MoebiusMap, bubble_to_bubble, distortion, fisheye
from stereodel.sphere import Rotation, SphereCircle, angular_distance, lonlat_to_xyz

LONLAT = st.tuples(st.floats(-180, 180), st.floats(-89, 89))
QUATERNIONS = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: np.linalg.norm(q) > 1e-3).map(Rotation)
MAPS = st.builds(MoebiusMap, QUATERNIONS, st.floats(-1.5, 1.5).map(lambda k: 10.0**k), QUATERNIONS)
BUBBLES = st.builds(SphereCircle.around, LONLAT, st.floats(0.01, 179.9))


def sampled(bubble, rings=60):
    """Points of a bubble in rings that share its area equally, and its circle."""
    heights = 1 - (1 - bubble.offset) * (np.arange(rings) + 0.5) / rings
    circles = [SphereCircle(bubble.normal, float(height)).sample(120) for height in heights]
    return np.concatenate(circles), bubble.sample(360)


@given(MAPS, BUBBLES)
@settings(deadline=None, max_examples=20)
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
@settings(deadline=None, max_examples=40)
def test_mean_against_quadrature(conformal, bubble):
    a = (conformal.magnification + 1 / conformal.magnification) / 2
    b = (conformal.magnification - 1 / conformal.magnification) / 2
    c = bubble.center @ conformal.focus
    ring = lambda u: 1 / mpmath.sqrt((b * u - a * c) ** 2 + (1 - c * c))  # noqa: E731
    mean = mpmath.quad(ring, mpmath.linspace(bubble.offset, 1, 9)) / (1 - bubble.offset)
    if bubble.angular_radius > 1:
        assert distortion(conformal, bubble).mean == pytest.approx(float(mean), rel=1e-6)


@given(MAPS, BUBBLES)
@settings(deadline=None, max_examples=10)
def test_area_ratio_is_the_mean_of_the_squared_scale(conformal, bubble):
    inside, _ = sampled(bubble, rings=200)
    summary = distortion(conformal, bubble)
    assert summary.area_ratio == pytest.approx((conformal.scale_factor(inside) ** 2).mean(), rel=0.05)
    other = distortion(conformal, bubble.complement).area_ratio
    share = (1 - bubble.offset) / 2
    assert share * summary.area_ratio + (1 - share) * other == pytest.approx(1, rel=1e-9)
    assert summary.smallest**2 * (1 - 1e-9) <= summary.area_ratio <= summary.largest**2 * (1 + 1e-9)
    assert summary.smallest * (1 - 1e-9) <= summary.mean <= summary.largest * (1 + 1e-9)


@given(LONLAT, st.floats(1e-3, 90), LONLAT, st.floats(1e-3, 90))
@settings(deadline=None, max_examples=40)
def test_p17_centre_to_centre(source, chi0, target, xi0):
    bubble = SphereCircle.around(source, chi0)
    summary = distortion(bubble_to_bubble(bubble, SphereCircle.around(target, xi0)), bubble)
    ratio = np.cos(np.radians(chi0) / 2) ** 2 / np.cos(np.radians(xi0) / 2) ** 2
    assert summary.largest / summary.smallest == pytest.approx(max(ratio, 1 / ratio), rel=1e-9)
    areas = np.sin(np.radians(xi0) / 2) ** 2 / np.sin(np.radians(chi0) / 2) ** 2
    assert summary.area_ratio == pytest.approx(areas, rel=1e-9)


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


@pytest.mark.parametrize(
    ("region", "message"),
    [([], "region is empty"), ([(0, 91)], "latitude 91"), (np.zeros((2, 4)), "region must have shape")],
)
def test_bad_input(region, message):
    with pytest.raises(ValueError, match=message):
        distortion(fisheye((0, 0), magnification=2), region)
