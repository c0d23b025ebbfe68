"""Latitudes of WGS84 against pyproj and many digits."""

import numpy as np
import pytest
from mpmath import mp, mpf, workdps
from pyproj import Transformer

from stereodel.sphere.latitudes import FLATTENING, authalic_latitude, geocentric_latitude

LATITUDES = np.concatenate([np.linspace(-90, 90, 37), 90 - np.logspace(-12, 0, 13), np.logspace(-12, 0, 13)])


def authalic_by_digits(latitude):
    with workdps(50):
        e2 = mpf(FLATTENING) * (2 - mpf(FLATTENING))
        e = mp.sqrt(e2)

        def q(s):
            return (1 - e2) * (s / (1 - e2 * s * s) + mp.atanh(e * s) / e)

        return float(mp.degrees(mp.asin(q(mp.sin(mp.radians(mpf(latitude)))) / q(mpf(1)))))


def test_authalic_latitude():
    expected = [authalic_by_digits(latitude) for latitude in LATITUDES]
    np.testing.assert_allclose(authalic_latitude(LATITUDES), expected, rtol=4e-16 * 4, atol=0)
    np.testing.assert_allclose(90 - authalic_latitude(LATITUDES[-26:-13]), 90 - np.array(expected[-26:-13]), atol=3e-14)


def test_geocentric_latitude_is_the_direction_from_the_centre():
    to_centre = Transformer.from_crs("EPSG:4979", "EPSG:4978", always_xy=True)
    x, y, z = to_centre.transform(np.zeros_like(LATITUDES), LATITUDES, np.zeros_like(LATITUDES))
    np.testing.assert_allclose(geocentric_latitude(LATITUDES), np.degrees(np.arctan2(z, np.hypot(x, y))), atol=3e-14)


@pytest.mark.parametrize("convert", [geocentric_latitude, authalic_latitude])
def test_the_equator_the_poles_and_symmetry(convert):
    assert convert(np.array([0.0, 90.0, -90.0])).tolist() == [0.0, 90.0, -90.0]
    assert np.array_equal(convert(-LATITUDES), -convert(LATITUDES))
    assert np.abs(convert(np.array([45.0]))[0] - 45) > 0.1
