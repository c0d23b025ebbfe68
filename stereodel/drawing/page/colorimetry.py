"""Colorimetry: linear sRGB, luminance and contrast, and OKLab, in which lightness and hue are perceptual.

Contrast is that of the Web Content Accessibility Guidelines 2.1; OKLab is Björn Ottosson's ("A perceptual color space
for image processing", 2020). Arrays of colours (..., 3) hold red, green and blue of sRGB in [0, 1], encoded.
"""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray

LUMINANCE: Final = np.array([0.2126, 0.7152, 0.0722])
"""Luminances of the primaries of sRGB, relative to white."""

FLARE: Final = 0.05
"""Luminance of the light that a screen reflects, which the definition of contrast adds."""

CONES: Final = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
"""Linear sRGB to cone responses in OKLab."""

OPPONENTS: Final = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)
"""Cube roots of cone responses to OKLab: lightness, green to red, blue to yellow."""

NEWTON_STEPS: Final = 8
"""Newton steps for the lightness of a given luminance, a cubic: within sRGB doubles need at most five."""

HALVINGS: Final = 24
"""Bisections of the largest chroma in sRGB: to a thousandth of the smallest 8-bit step."""


def linear(colors: npt.ArrayLike) -> FloatArray:
    """Linear light (...) of sRGB colours."""
    encoded = np.asarray(colors, dtype=np.float64)
    return np.where(encoded <= 0.04045, encoded / 12.92, (np.maximum(encoded, 0.0) + 0.055) ** 2.4 / 1.055**2.4)


def encoded(light: npt.ArrayLike) -> FloatArray:
    """Linear light (...) as sRGB colours, the inverse of `linear`, clipped to [0, 1]."""
    values = np.clip(np.asarray(light, dtype=np.float64), 0.0, 1.0)
    return np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1 / 2.4) - 0.055)


def luminance(colors: npt.ArrayLike) -> FloatArray:
    """Relative luminance (...) of colours (..., 3): 0 for black, 1 for white."""
    return np.asarray(np.sum(linear(colors) * LUMINANCE, axis=-1))


def contrast(a: npt.ArrayLike, b: npt.ArrayLike) -> FloatArray:
    """Contrast (...) of colours (..., 3), from 1 to 21 for black and white.

    >>> round(float(contrast((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))), 9)
    21.0
    """
    first, second = luminance(a) + FLARE, luminance(b) + FLARE
    return np.asarray(np.maximum(first, second) / np.minimum(first, second))


def to_oklab(colors: npt.ArrayLike) -> FloatArray:
    """Lightness, green to red and blue to yellow (..., 3) of colours (..., 3)."""
    cones = np.sum(linear(colors)[..., None, :] * CONES, axis=-1)
    return np.asarray(np.sum(np.cbrt(cones)[..., None, :] * OPPONENTS, axis=-1))


def with_luminance(colors: FloatArray, target: FloatArray) -> FloatArray:
    """Colours (n, 3) of the same hue in OKLab with another luminance (n,), in [0, 1].

    Their chroma is the same as far as sRGB contains it at that luminance.
    """
    hue = to_oklab(colors)[:, 1:]
    light = _with_chroma(hue, target)
    low, high = np.zeros(len(hue)), np.ones(len(hue))
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        holds = _displayable(_with_chroma(middle[:, None] * hue, target))
        low, high = np.where(holds, middle, low), np.where(holds, high, middle)
    return encoded(np.where(_displayable(light)[:, None], light, _with_chroma(low[:, None] * hue, target)))


def _displayable(light: FloatArray) -> npt.NDArray[np.bool_]:
    return np.asarray(((light >= 0) & (light <= 1)).all(axis=1))


def _with_chroma(hue: FloatArray, target: FloatArray) -> FloatArray:
    """Linear light (n, 3) of colours with given opponent components (n, 2) and luminance, inside or outside sRGB."""
    from_cones = np.linalg.inv(CONES)
    roots = np.sum(hue[:, None, :] * np.linalg.inv(OPPONENTS)[:, 1:], axis=-1)
    share = np.sum(LUMINANCE[:, None] * from_cones, axis=0)
    lightness = np.cbrt(target)
    for _ in range(NEWTON_STEPS):
        cones = lightness[:, None] + roots
        slope = 3 * np.sum(share * cones**2, axis=1)
        excess = np.sum(share * cones**3, axis=1) - target
        lightness = lightness - np.where(slope > 0, excess / np.where(slope > 0, slope, 1.0), 0.0)
    cones = (lightness[:, None] + roots) ** 3
    return np.asarray(np.sum(cones[:, None, :] * from_cones, axis=-1))
