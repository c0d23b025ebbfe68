"""Claim P15: conformal maps form a group, and matrices and PROJ pipelines stand for them."""

import numpy as np
import pyproj
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from stereodel.conformal import MoebiusMap, fisheye
from stereodel.constants import STORED_ERROR
from stereodel.sphere import Rotation, angular_distance, lonlat_to_xyz
from tests.examples import examples
from tests.strategies import decades, maps

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


def test_rotation_forms():
    turn = Rotation.about((20, 30), 40)
    assert MoebiusMap.rotation(turn) == MoebiusMap.rotation((20, 30), 40)
    assert (
        np.abs(MoebiusMap.rotation(turn)(POINTS) - turn(POINTS / np.linalg.norm(POINTS, axis=1)[:, None])).max() < 4e-16
    )
    assert (MoebiusMap.rotation(turn).scale_factor(POINTS) == 1).all()


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
