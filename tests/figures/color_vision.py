"""Colours as they are seen by others: with one kind of cone missing, and in gray; and how different two of them look.

Simulation: Machado, Oliveira and Fernandes, "A Physiologically-based Model for Simulation of Color Vision Deficiency",
IEEE Transactions on Visualization and Computer Graphics 15 (2009), the matrices of severity 1 for linear RGB.
Difference: CIEDE2000 as in Sharma, Wu and Dalal, "The CIEDE2000 Color-Difference Formula", Color Research and
Application 30 (2005), whose test data are in `test_palette.py`.
"""

import numpy as np

from stereodel.drawing.colorimetry import encoded, linear, luminance

DEFICIENCIES = {
    "protanopia": [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    "deuteranopia": [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
    "tritanopia": [
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.303900],
    ],
}
TO_XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)
"""Linear sRGB, white D65."""


def seen_with(name, colors):
    """Colours (..., 3) as they look to those with a deficiency."""
    return encoded(linear(colors) @ np.array(DEFICIENCIES[name]).T)


def in_gray(colors):
    """Colours (..., 3) printed with black ink alone."""
    return np.repeat(encoded(luminance(colors))[..., None], 3, axis=-1)


VISIONS = {name: lambda colors, name=name: seen_with(name, colors) for name in DEFICIENCIES} | {"gray": in_gray}


def lab(colors):
    """CIE L*, a*, b* (..., 3)."""
    share = linear(colors) @ TO_XYZ.T / TO_XYZ.sum(axis=1)
    f = np.where(share > (6 / 29) ** 3, np.cbrt(share), share / (3 * (6 / 29) ** 2) + 4 / 29)
    x, y, z = np.moveaxis(f, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def difference(first, second):
    """CIEDE2000 of colours (..., 3)."""
    return lab_difference(lab(first), lab(second))


def lab_difference(first, second):
    """CIEDE2000 of L*, a*, b* (..., 3)."""
    (l1, a1, b1), (l2, a2, b2) = np.moveaxis(np.asarray(first), -1, 0), np.moveaxis(np.asarray(second), -1, 0)
    c7 = ((np.hypot(a1, b1) + np.hypot(a2, b2)) / 2) ** 7
    stretch = 1 + 0.5 * (1 - np.sqrt(c7 / (c7 + 25.0**7)))
    c1, c2 = np.hypot(stretch * a1, b1), np.hypot(stretch * a2, b2)
    h1, h2 = (np.degrees(np.arctan2(b, stretch * a)) % 360 for a, b in ((a1, b1), (a2, b2)))
    gray = c1 * c2 == 0
    turn = np.where(gray, 0.0, (h2 - h1 + 180) % 360 - 180)
    mean = np.where(gray, h1 + h2, h1 + turn / 2) % 360
    light, chroma = (l1 + l2) / 2, (c1 + c2) / 2
    t = 1 - 0.17 * _cos(mean - 30) + 0.24 * _cos(2 * mean) + 0.32 * _cos(3 * mean + 6) - 0.20 * _cos(4 * mean - 63)
    weights = (
        1 + 0.015 * (light - 50) ** 2 / np.sqrt(20 + (light - 50) ** 2),
        1 + 0.045 * chroma,
        1 + 0.015 * chroma * t,
    )
    steps = (l2 - l1, c2 - c1, 2 * np.sqrt(c1 * c2) * np.sin(np.radians(turn / 2)))
    dl, dc, dh = (step / weight for step, weight in zip(steps, weights, strict=True))
    tilt = (
        -np.sin(np.radians(60 * np.exp(-(((mean - 275) / 25) ** 2)))) * 2 * np.sqrt(chroma**7 / (chroma**7 + 25.0**7))
    )
    return np.sqrt(dl**2 + dc**2 + dh**2 + tilt * dc * dh)


def _cos(degrees):
    return np.cos(np.radians(degrees))
