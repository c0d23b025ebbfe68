"""The group beyond products: powers, kinds, fixed points, three points to three points, Tissot's circles."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.conformal import MoebiusMap, fisheye, three_points
from stereodel.sphere import SphereCircle, angular_distance, lonlat_to_xyz
from tests.examples import examples
from tests.strategies import BETWEEN_POLES, decades, maps

MAPS, MILD = maps(decades(-3, 3)), maps(st.floats(0.2, 5))
EXPONENTS = st.floats(-2, 2)
POINTS = np.random.default_rng(21).normal(size=(20, 3))
IDENTITY = MoebiusMap.identity()
PARABOLIC = MoebiusMap.from_matrix([[1, 0.7], [0, 1]])


def turn_at(conformal, point):
    """Radians by which a map turns directions at a fixed point, counterclockwise seen from outside."""
    step = 1e-6 * np.linalg.svd(point[None])[2][1]
    ahead = conformal(point + step) - conformal(point)
    return np.arctan2(np.dot(point, np.cross(step, ahead)), np.dot(step, ahead))


def sane(conformal):
    """Whether fixed points and angle are far from where powers jump or fixed points run together."""
    k = conformal.multiplier
    return conformal.kind in {"rotation", "boost", "loxodromic"} and abs(k - 1) > 1e-2 and abs(k + abs(k)) > 1e-3


@given(MILD, EXPONENTS, EXPONENTS)
def test_powers_are_a_one_parameter_group(conformal, s, t):
    first, second = conformal.power(s), conformal.power(t)
    # What one factor is off, an ulp, is magnified by the other.
    size = max(first.magnification, second.magnification)
    assert (first @ second).is_close(conformal.power(s + t), tolerance=1e-14 * size)
    assert first.inverse().is_close(conformal.power(-s), tolerance=1e-14 * size)


def test_powers_of_known_maps():
    assert PARABOLIC.power(0.0) == IDENTITY
    assert fisheye((0, 40), magnification=1e-6).power(-1.5).is_close(fisheye((0, 40), magnification=1e9))
    assert MoebiusMap.rotation((10, 20), 30).power(4.5).is_close(MoebiusMap.rotation((10, 20), 135))
    assert MoebiusMap.rotation((10, 20), -150).power(2).is_close(MoebiusMap.rotation((10, 20), 60))
    assert PARABOLIC.power(-2.5).is_close(MoebiusMap.from_matrix([[1, -1.75], [0, 1]]))
    assert MoebiusMap.rotation((10, 20), 1e-5).power(1e6).is_close(MoebiusMap.rotation((10, 20), 10), tolerance=1e-9)
    tiny = fisheye((3, 4), magnification=1 + 1e-12)
    assert tiny.power(3e5).magnification - 1 == pytest.approx(3e5 * (tiny.magnification - 1), rel=1e-6)


@pytest.mark.parametrize("axis", [(10, 20), (10, -20), (-50, 0), (0, 0), (180, 0)])
def test_half_a_turn_goes_round_the_last_positive_coordinate(axis):
    x = lonlat_to_xyz(axis)
    last = next(c for c in x[::-1] if abs(c) > 1e-9)
    quarter = MoebiusMap.rotation(axis, 180).power(0.5)
    assert quarter.is_close(MoebiusMap.rotation(x * np.sign(last), 90))
    assert MoebiusMap.rotation(axis, -180).power(0.5) == quarter


@given(MAPS)
def test_fixed_points_are_fixed_and_the_multiplier_is_the_derivative(conformal):
    if not sane(conformal):
        return
    points, k = conformal.fixed_points, conformal.multiplier
    slack = 1e-14 * (1 + conformal.scale_factor(points))
    assert (np.abs(conformal(points) - points).max(axis=1) < slack / min(1, abs(k - 1))).all()
    assert abs(k) >= 1 - 1e-12
    assert conformal.scale_factor(points) == pytest.approx([abs(k), 1 / abs(k)], rel=1e-9)
    for point, angle in zip(points, (np.angle(k), -np.angle(k)), strict=True):
        gap = turn_at(conformal, point) - angle
        # A step of 1e-6 is not small beside what the scale does next to other fixed points.
        assert abs((gap + np.pi) % (2 * np.pi) - np.pi) < 1e-3 * (1 + max(abs(k), conformal.magnification))


@given(MILD, st.sampled_from(["rotation", "boost", "loxodromic"]), BETWEEN_POLES, st.floats(1.1, 4), st.floats(5, 175))
@examples(0.2)
def test_kind_fixed_points_and_multiplier_go_with_conjugation(other, kind, axis, size, angle):
    inner = MoebiusMap.rotation(axis, 0 if kind == "boost" else angle)
    if kind != "rotation":
        inner = inner @ fisheye(axis, magnification=size)
    carried = other @ inner @ other.inverse()
    assert inner.kind == carried.kind == kind
    assert carried.multiplier == pytest.approx(inner.multiplier, rel=1e-11)
    assert angular_distance(carried.fixed_points, other(inner.fixed_points)).max() < 1e-10
    assert carried.power(0.7).is_close(other @ inner.power(0.7) @ other.inverse(), tolerance=1e-11)


@given(MILD)
def test_parabolic_maps(other):
    carried = other @ PARABOLIC @ other.inverse()
    assert carried.kind == carried.power(-3.3).kind == "parabolic"
    assert carried.multiplier == 1
    assert carried.fixed_points.shape == (1, 3)
    assert angular_distance(carried.fixed_points[0], other([0.0, 0.0, 1.0])) < 1e-12
    assert np.abs(carried(carried.fixed_points) - carried.fixed_points).max() < 1e-14


@pytest.mark.parametrize(
    ("conformal", "kind", "multiplier"),
    [
        (IDENTITY, "identity", 1),
        (fisheye((10, 20), magnification=3) @ fisheye((10, 20), magnification=1 / 3), "identity", 1),
        (MoebiusMap.rotation((10, 20), 180), "rotation", -1),
        (MoebiusMap.rotation((10, 20), 1e-6), "rotation", np.exp(1j * np.radians(1e-6))),
        (fisheye((10, 20), magnification=1e-9), "boost", 1e9),
        (fisheye((10, 20), magnification=1 + 1e-6), "boost", 1 + 1e-6),
        (MoebiusMap.rotation((10, 20), 180) @ fisheye((10, 20), magnification=5), "loxodromic", -5),
        (MoebiusMap.rotation((10, 20), -90) @ fisheye((10, 20), magnification=5), "loxodromic", -5j),
    ],
)
def test_known_kinds(conformal, kind, multiplier):
    assert conformal.kind == kind
    assert conformal.multiplier == pytest.approx(multiplier, rel=1e-12, abs=1e-15)
    assert kind != "boost" or conformal.multiplier.imag == 0


def test_fixed_points_come_in_order():
    assert np.abs(fisheye((10, 20), magnification=3).fixed_points[0] - lonlat_to_xyz((10, 20))).max() < 4e-16
    assert np.abs(fisheye((10, 20), magnification=0.3).fixed_points[1] - lonlat_to_xyz((10, 20))).max() < 4e-16
    assert np.abs(MoebiusMap.rotation((10, 20), 70).fixed_points[0] - lonlat_to_xyz((10, 20))).max() < 4e-16
    assert np.abs(MoebiusMap.rotation((10, 20), -70).fixed_points[1] - lonlat_to_xyz((10, 20))).max() < 4e-16


TRIPLES = st.lists(BETWEEN_POLES, min_size=3, max_size=3).filter(
    lambda rows: min(angular_distance(*lonlat_to_xyz([rows[i], rows[j]])) for i, j in ((0, 1), (0, 2), (1, 2))) > 1e-3
)


@given(TRIPLES, TRIPLES)
@examples(0.2)
def test_three_points_to_three_points(sources, targets):
    conformal = three_points(sources, targets)
    slack = 2e-15 * (1 + conformal.scale_factor(lonlat_to_xyz(sources)))
    assert (np.abs(conformal(lonlat_to_xyz(sources)) - lonlat_to_xyz(targets)).max(axis=1) < slack).all()
    assert three_points(targets, sources).is_close(conformal.inverse(), tolerance=1e-12)


def test_three_points_close_together():
    # A triangle of a micrometre on Earth, onto one with right angles.
    sources = lonlat_to_xyz((10, 50)) + 1e-13 * np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1]])
    conformal = three_points(sources, np.eye(3))
    assert conformal.magnification > 1e12
    assert np.abs(conformal(sources) - np.eye(3)).max() < 4e-16 * conformal.scale_factor(sources).max()


def test_tissot_circles_are_the_exact_images():
    lens, places = fisheye((0, 40), magnification=4), [(0, 40), (30, 10), (-90, -20)]
    for place, image in zip(places, lens.tissot(places, 5.0), strict=True):
        assert image == lens.image_of(SphereCircle.around(place, 5.0))
    assert lens.tissot(lonlat_to_xyz(places), 5.0)[1].angular_radius == pytest.approx(
        lens.tissot(places, 5.0)[1].angular_radius, rel=1e-14
    )
