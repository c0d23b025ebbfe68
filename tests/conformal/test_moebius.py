"""Claim P15: conformal maps form a group; its matrices, pipelines, powers, kinds and fixed points."""

import numpy as np
import pyproj
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel.conformal import MoebiusMap, fisheye, three_points
from stereodel.constants import STORED_ERROR
from stereodel.sphere import Rotation, angular_distance, lonlat_to_xyz
from tests.examples import examples
from tests.strategies import BETWEEN_POLES, decades, maps

MAPS = maps(decades(-4, 4))
POINTS = np.random.default_rng(11).normal(size=(20, 3))
IDENTITY = MoebiusMap.identity()
METRIC = np.diag([1.0, 1.0, 1.0, -1.0])


def stretch(conformal):
    """How far a map stretches vectors, as the root of the sum of squares of its biquaternion does."""
    return np.sqrt((conformal.magnification + 1 / conformal.magnification) / 2)


@given(MAPS, MAPS, MAPS)
@example(
    MoebiusMap.identity(),
    MoebiusMap(Rotation([0, 0, 0, 1]), 1e-3, Rotation([0, 0.1875, 0, 1])),
    MoebiusMap(Rotation([0, 0.1875, 0, 1]), 1e3, Rotation([0, 0, 0, 1])),
)
@examples(0.2)
def test_group_laws(a, b, c):
    # What is composed first is stored rounded. The last map stretches that error, though all three together may do
    # nothing: relative to the result it grows by what the maps stretch one by one, and not together.
    whole = a @ (b @ c)
    lost = stretch(a) * stretch(b) * stretch(c) / stretch(whole)
    assert ((a @ b) @ c).is_close(whole, tolerance=4 * STORED_ERROR * lost)
    assert (a @ a.inverse()).is_close(IDENTITY)
    assert (a.inverse() @ a).is_close(IDENTITY)
    assert (IDENTITY @ a).is_close(a)
    assert (a @ b).inverse().is_close(b.inverse() @ a.inverse())
    assert a.inverse().inverse().is_close(a)
    assert not (a @ MoebiusMap.rotation((0, 90), 1e-3)).is_close(a)
    assert not (a @ fisheye((0, 0), magnification=1.001)).is_close(a)


@given(maps(st.one_of(decades(-6, 6), decades(-16, 0).map(lambda x: 1 + x))))
def test_lorentz_matrix(conformal):
    m = conformal.matrix
    size = np.abs(m).max()
    assert np.abs(m.T @ METRIC @ m - METRIC).max() < 1e-14 * size**2
    image = np.concatenate([POINTS / np.linalg.norm(POINTS, axis=1)[:, None], np.ones((20, 1))], axis=1) @ m.T
    assert np.abs(image[:, :3] / image[:, 3:] - conformal(POINTS)).max() < 1e-13 * size
    again = MoebiusMap.from_matrix(m)
    # The twist about the axis is known to S ulps, everything else to ulps.
    assert again.is_close(conformal, tolerance=1e-14 * size)
    assert max(again.magnification, 1 / again.magnification) == pytest.approx(
        max(conformal.magnification, 1 / conformal.magnification), rel=2e-14
    )
    assert np.abs(again(POINTS) - conformal(POINTS)).max() < 1e-13 * size
    if size > 1 + 1e-6:
        assert np.abs(np.abs(again.focus @ conformal.focus) - 1) < 1e-14


COMPLEX = st.builds(complex, st.floats(-3, 3), st.floats(-3, 3))


@given(COMPLEX, COMPLEX, COMPLEX, COMPLEX)
def test_complex_matrix(a, b, c, d):
    determinant = abs(a * d - b * c)
    size = abs(a) ** 2 + abs(b) ** 2 + abs(c) ** 2 + abs(d) ** 2
    if determinant < 1e-2 * max(size, 1e-2):
        return
    conformal = MoebiusMap.from_matrix(np.array([[a, b], [c, d]]))
    x, y, z = (POINTS / np.linalg.norm(POINTS, axis=1)[:, None]).T
    # Spinors (x + iy, 1 − z) instead of quotients: no point is at infinity.
    top, bottom = a * (x + 1j * y) + b * (1 - z), c * (x + 1j * y) + d * (1 - z)
    total = abs(top) ** 2 + abs(bottom) ** 2
    mixed = 2 * top * bottom.conj() / total
    expected = np.stack([mixed.real, mixed.imag, (abs(top) ** 2 - abs(bottom) ** 2) / total], axis=1)
    assert np.abs(conformal(POINTS) - expected).max() < 1e-11
    sigma = size / determinant
    assert conformal.magnification == pytest.approx((sigma + np.sqrt(max(sigma**2 - 4, 0))) / 2, rel=1e-6)


def test_known_complex_matrices():
    assert MoebiusMap.from_matrix([[1, 0], [0, 1]]).is_close(IDENTITY)
    # ζ ↦ 4ζ pushes away from the south pole: a fisheye there.
    assert MoebiusMap.from_matrix([[4, 0], [0, 1]]).is_close(fisheye((0, -90), magnification=4))
    assert MoebiusMap.from_matrix([[0, 1], [1, 0]]).is_close(MoebiusMap.rotation((0, 0), 180))
    assert MoebiusMap.from_matrix([[0, -1], [1, 0]]).is_close(MoebiusMap.rotation((90, 0), 180))
    assert MoebiusMap.from_matrix([[1e-200, 0], [0, 1e-200]]).is_close(IDENTITY)
    assert MoebiusMap.from_matrix([[1e6, 0], [0, 1]]).magnification == pytest.approx(1e6, rel=1e-14)


def proj_image(conformal, lonlat):
    transformer = pyproj.Transformer.from_pipeline(conformal.to_proj())
    return np.stack(transformer.transform(lonlat[:, 0], lonlat[:, 1]), axis=1)


@pytest.mark.parametrize("focus", [(0.0, 40.0), (123.4, -56.7), (0.0, 90.0), (30.0, -90.0), (-180.0, 0.0)])
@pytest.mark.parametrize("magnification", [0.25, 1.0, 4.0, 20.0, 1000.0])
def test_p18_proj_computes_the_same_map(focus, magnification):
    lens = fisheye(focus, magnification=magnification)
    assert "affine" not in lens.to_proj()
    lonlat = np.random.default_rng(4).uniform([-180, -85], [180, 85], size=(50, 2))
    expected = lens(lonlat_to_xyz(lonlat))
    assert angular_distance(lonlat_to_xyz(proj_image(lens, lonlat)), expected).max() < 1e-7


@given(MAPS)
@example(MoebiusMap(Rotation([0.0, 0.0, 0.5, 5.96046448e-08]), 1.0, Rotation([0.0, 0.0, 0.0, 1.0])))
def test_every_map_is_a_proj_pipeline(conformal):
    lonlat = np.random.default_rng(4).uniform([-180, -89], [180, 89], size=(100, 2))
    xyz = lonlat_to_xyz(lonlat)
    # Next to the antipode of the focus PROJ's plane is far away from its middle.
    gap = angular_distance(lonlat_to_xyz(proj_image(conformal, lonlat)), conformal(xyz))
    away = angular_distance(xyz, -conformal.focus) > 1
    # Its inverse about a middle next to a pole divides what cancels by the cosine of the latitude.
    cosines = [np.hypot(*point[:2]) for point in (conformal.focus, conformal(conformal.focus))]
    lost = max((2e-14 / cosine for cosine in cosines if cosine > 1e-12), default=0.0)
    assert (gap < (1e-9 + lost) * np.maximum(1, conformal.scale_factor(xyz)))[away].all()


STRONG, MILD = maps(decades(-3, 3)), maps(st.floats(0.2, 5))
EXPONENTS = st.floats(-2, 2)
PLACES = np.random.default_rng(21).normal(size=(20, 3))
PARABOLIC = MoebiusMap.from_matrix([[1, 0.7], [0, 1]])


def turn_at(conformal, point):
    """Radians by which a map turns directions at a fixed point, counterclockwise seen from outside."""
    step = 1e-6 * np.linalg.svd(point[None])[2][1]
    ahead = conformal(point + step) - conformal(point)
    return np.arctan2(np.dot(point, np.cross(step, ahead)), np.dot(step, ahead))


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


@given(STRONG)
def test_fixed_points_are_fixed_and_the_multiplier_is_the_derivative(conformal):
    k = conformal.multiplier
    if conformal.kind not in {"rotation", "boost", "loxodromic"} or abs(k - 1) <= 1e-2 or abs(k + abs(k)) <= 1e-3:
        return  # powers jump, or fixed points run together
    points = conformal.fixed_points
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
