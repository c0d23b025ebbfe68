"""Latitudes of the WGS84 ellipsoid as latitudes of a sphere, and back.

All in double-double and without the platform's mathematics: the same bits on every machine. With φ the geodetic
latitude, s = sin φ, c = cos φ:

geocentric, the direction from the Earth's centre: tan θ = (1 − e²) tan φ. J. P. Snyder, "Map Projections: A Working
Manual" (1987), equation 3-28.

authalic, on the sphere of equal area: sin β = q(s)/q(1), q(s) = (1 − e²)(s/(1 − e²s²) + artanh(es)/e) (Snyder, 3-11 and
3-12). With P(t) = Σ (k + 1)/(2k + 1) e²ᵏ tᵏ this is q(s) = 2(1 − e²) s P(s²), so that

    P(1) sin β = s P(s²),    P(1) cos β = c R(s²),    R² = P² + (P(1) + P) D,    D(t) = (P(1) − P(t))/(1 − t),

since P(1)² − s²P² = (P(1)² − P²) + (1 − s²)P². Every term of P, of D and of R² is positive: nothing cancels, at the
poles as little as at the equator. And dβ/dφ = 1/((1 − e²s²)² R).
"""

from __future__ import annotations

from typing import Final, Literal

import numpy as np

from stereodel import _kernel
from stereodel._arrays import FloatArray
from stereodel._double_double import DoubleDouble
from stereodel.earth import FLATTENING
from stereodel.sphere.degrees import angle_degrees, pair, sin_cos_degrees

Latitude = Literal["spherical", "geodetic", "authalic"]

KINDS: Final[tuple[Latitude, ...]] = ("spherical", "geodetic", "authalic")
"""What a latitude may be: of the sphere unchanged, or of WGS84 with the direction from its centre or equal areas."""

# 1/f = 298.257223563 as a fraction of two doubles, so that e² is known to twice the precision of one.
_ONE_LESS_F = DoubleDouble(297257223563.0) / 298257223563.0
_E2 = DoubleDouble(1e9) / 298257223563.0 * (1.0 + _ONE_LESS_F)
_POLAR = _ONE_LESS_F * _ONE_LESS_F  # 1 − e²


def _authalic_factors(t: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble]:
    """P and R of sin² φ: the series is the kernel's, `stereodel/kernel/coordinates/latitudes.cpp`."""
    squares = np.stack([t.hi, t.lo], axis=-1)
    return pair(_kernel.authalic_factors(squares.reshape(-1, 2)).reshape(*squares.shape[:-1], 4))


_P_AT_POLE, _ = _authalic_factors(DoubleDouble(np.float64(1.0)))


def sin_cos_on_sphere(latitude: FloatArray, kind: Latitude) -> tuple[DoubleDouble, DoubleDouble]:
    """Sine and cosine of the latitude on the sphere, from geodetic latitude in degrees, relative error below 2⁻⁸⁴.

    They are exact at the equator and the poles once rounded, and mirrored where latitudes are.
    """
    sine, cosine = sin_cos_degrees(latitude)
    if kind == "geodetic":
        sine = _POLAR * sine
        length = (sine * sine + cosine * cosine).sqrt()
        return sine / length, cosine / length
    p, r = _authalic_factors(sine * sine)
    return sine * p / _P_AT_POLE, cosine * r / _P_AT_POLE


def latitude_of(z: DoubleDouble, rho: DoubleDouble, kind: Latitude) -> FloatArray:
    """Latitude in degrees of vectors by their height and their distance from the axis, within an ulp.

    Geocentric: an angle. Authalic: Newton's method for φ from tan φ ≈ tan β/(1 − e²)^⅔. Both sides agree
    in their terms of order e², and the start is off by less than 6e-7 rad (e⁴/80). A step squares the error times
    |φ''(β)/2| < e²: it is below 3e-15 after the first and below 1e-31 after the second; what remains is the rounding of
    the result. Steps are angles of the sphere, which keep their digits next to the poles.
    """
    if kind == "geodetic":
        return angle_degrees(z, _POLAR * rho)
    guess = angle_degrees(z, (1 - FLATTENING) ** (4 / 3) * rho)
    return _authalic_step(z, rho, _authalic_step(z, rho, guess))


def _authalic_step(z: DoubleDouble, rho: DoubleDouble, latitude: FloatArray) -> FloatArray:
    sine, cosine = sin_cos_degrees(latitude)
    t = sine * sine
    p, r = _authalic_factors(t)
    across = (z * (cosine * r) - rho * (sine * p)).round()
    along = (rho * (cosine * r) + z * (sine * p)).round()
    slope = (1 - _E2.hi * t.hi) ** 2 * r.hi
    return latitude + np.degrees(across / along * slope)
