"""Sine, cosine and angle in degrees, in double-double: no platform mathematics, so the same bits on every machine.

The series are the kernel's: `stereodel/kernel/coordinates/degrees.cpp`.
"""

from __future__ import annotations

import numpy as np

from stereodel import _kernel
from stereodel._arrays import FloatArray
from stereodel._double_double import DoubleDouble


def sin_cos_degrees(angle: FloatArray) -> tuple[DoubleDouble, DoubleDouble]:
    """Sine and cosine of angles in degrees, relative error below 2⁻¹⁰¹, mirrored where the angles are.

    They are exact at multiples of 90°, one of the two at odd multiples of 45°.
    """
    return pair(_kernel.sin_cos_degrees(np.ascontiguousarray(angle).ravel()).reshape(*angle.shape, 4))


def pair(parts: FloatArray) -> tuple[DoubleDouble, DoubleDouble]:
    """Two numbers as the kernel gives them, (..., 4)."""
    return DoubleDouble(parts[..., 0], parts[..., 1]), DoubleDouble(parts[..., 2], parts[..., 3])


def angle_degrees(y: DoubleDouble, x: DoubleDouble) -> FloatArray:
    """The angle of (x, y) in degrees in [−180, 180], 0 at the origin, within an ulp."""
    # A guess by the platform's arctangent is corrected in double-double: the platform's last bits do not show.
    guess = np.where((x.hi == 0) & (y.hi == 0), 0.0, np.degrees(np.arctan2(y.hi, x.hi)))
    sine, cosine = sin_cos_degrees(guess)
    across, along = (y * cosine - x * sine).round(), (x * cosine + y * sine).round()
    step = np.divide(across, along, out=np.zeros_like(guess), where=along != 0)
    return np.asarray(guess + np.degrees(step))
