"""Latitudes of WGS84 against many digits and pyproj, there and back."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mpf

from stereodel import lonlat_to_xyz, xyz_to_lonlat
from stereodel._double_double import DoubleDouble
from stereodel.sphere.latitudes import latitude_of, sin_cos_on_sphere

LATITUDES = np.concatenate([np.linspace(-90, 90, 37), 90 - np.logspace(-12, 0, 13), np.logspace(-300, 0, 31)])
ELLIPSOIDAL = ["geodetic", "authalic"]


def on_sphere(latitude, kind):
    """Sine and cosine by the textbook formulas, 80 digits."""
    f = 1 / mpf("298.257223563")
    e2 = f * (2 - f)
    e = mpmath.sqrt(e2)

    def q(s):
        return (1 - e2) * (s / (1 - e2 * s * s) + mpmath.atanh(e * s) / e)

    phi = mpf(latitude) * mpmath.pi / 180
    if kind == "authalic":
        sine = q(mpmath.sin(phi)) / q(mpf(1))
        return sine, mpmath.sqrt(1 - sine**2)
    theta = mpmath.atan2((1 - e2) * mpmath.sin(phi), mpmath.cos(phi))
    return mpmath.sin(theta), mpmath.cos(theta)


@pytest.mark.parametrize("kind", ELLIPSOIDAL)
def test_relative_error_is_below_its_bound(kind):
    sines, cosines = sin_cos_on_sphere(LATITUDES, kind)
    with mpmath.workdps(80):
        for k, latitude in enumerate(LATITUDES):
            for got, true in zip((sines[k], cosines[k]), on_sphere(latitude, kind), strict=True):
                # 80 digits have no exact zero at 90°; doubles below 2^-960 have no room for a low part.
                if abs(true) > mpf(10) ** -70 and abs(true) > mpf(2) ** -960:
                    assert abs((mpf(float(got.hi)) + mpf(float(got.lo))) / true - 1) < mpf(2) ** -84


@pytest.mark.parametrize("kind", ELLIPSOIDAL)
def test_the_equator_the_poles_and_symmetry(kind):
    xyz = lonlat_to_xyz([[0, 0], [90, 0], [-180, 0], [12, 90], [34, -90]], latitude=kind)
    assert xyz.tolist() == [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, 0, 1], [0, 0, -1]]
    assert not np.signbit(xyz[xyz == 0]).any()
    north, south = (lonlat_to_xyz(np.stack([LATITUDES, s * LATITUDES], axis=-1), latitude=kind) for s in (1, -1))
    assert np.array_equal(south, north * [1, 1, -1])


@given(st.tuples(st.floats(-180, 180, exclude_max=True), st.floats(-90, 90)))
def test_there_and_back(lonlat):
    for kind in ELLIPSOIDAL:
        xyz = lonlat_to_xyz(lonlat, latitude=kind)
        back = xyz_to_lonlat(xyz, latitude=kind)
        # A component of the vector is rounded by 2^-54 of itself, or 2^-53 of 1, radians; the result by half an ulp.
        np.testing.assert_allclose(back[1], lonlat[1], rtol=4e-16, atol=1e-14 if abs(lonlat[1]) > 1 else 1e-320)
        if abs(lonlat[1]) < 89:
            np.testing.assert_allclose((back[0] - lonlat[0] + 180) % 360 - 180, 0, atol=1e-13)


@given(st.floats(0, 1, exclude_min=True), st.floats(0, 1, exclude_min=True))
def test_authalic_latitude_is_found_within_an_ulp(z, rho):
    """The next double to either side is on the other side of what is sought."""
    found = float(latitude_of(DoubleDouble(z), DoubleDouble(rho), "authalic"))
    with mpmath.workdps(60):
        for step in (-1, 1):
            beside = found + step * 1.01 * np.spacing(found)
            if 1e-290 < beside < 90 and min(z, rho) > 1e-290:
                sine, cosine = on_sphere(beside, "authalic")
                assert mpmath.sign(mpf(z) * cosine - mpf(rho) * sine) == -step
