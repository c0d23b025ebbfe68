"""Latitudes of the WGS84 ellipsoid as latitudes of a sphere."""

from __future__ import annotations

import math

import numpy as np

from stereodel._arrays import FloatArray

FLATTENING = 1 / 298.257223563
_E2 = FLATTENING * (2 - FLATTENING)
_E = math.sqrt(_E2)


def geocentric_latitude(latitude: FloatArray) -> FloatArray:
    """Latitude of the direction from the Earth's centre, from geodetic latitude; both in degrees.

    tan θ = (1 − e²) tan φ; exact at 0 and ±90. J. P. Snyder, "Map Projections: A Working Manual" (1987), equation 3-28.
    """
    phi = np.radians(np.abs(latitude))
    return np.copysign(np.degrees(np.arctan2((1 - _E2) * np.sin(phi), np.cos(phi))), latitude)


def authalic_latitude(latitude: FloatArray) -> FloatArray:
    """Latitude on the sphere of equal area, from geodetic latitude; both in degrees.

    sin β = q/q(90°), q = (1 − e²)(s/(1 − e²s²) + artanh(es)/e), s = sin φ (Snyder, equations 3-11 and 3-12). Near the
    poles the arcsine loses half of the digits; the cosine is therefore taken from q(90°) − q, written without
    cancellation.
    """
    distance = np.radians(90.0 - np.abs(latitude)) / 2
    s, from_pole = np.sin(np.radians(np.abs(latitude))), 2 * np.sin(distance) ** 2
    q = (1 - _E2) * (s / (1 - _E2 * s * s) + np.arctanh(_E * s) / _E)
    rest = from_pole * (1 + _E2 * s) / (1 - _E2 * s * s)
    rest = rest + (1 - _E2) / _E * np.arctanh(_E * from_pole / (1 - _E2 * s))
    beta: FloatArray = np.degrees(np.arctan2(q, np.sqrt(rest * (rest + 2 * q))))
    return np.copysign(beta, latitude)
