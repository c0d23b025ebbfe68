"""The shading of a ball as a radial gradient, for vector files.

Pixels are shaded individually (`shaders/flat.frag`): with n the normal at a place, l the direction toward the light and
t = n·l, a colour is multiplied by

    b = 1 − SHADE ((1 − t)/2)²,    t = p λ + √(1 − ρ²) l_z,

where ρ is the distance from the centre in radii, p its component toward the light on the page, and λ the length of l
there. Lines of equal brightness are circles of the ball, which the page shows as ellipses; no gradient of SVG or PDF
has that form. Their gradients have circles about (1 − s) f + s c with radii s r, which shrink to a focus f. Here f lies
on the axis toward the light, c is farther from the light by the fraction `drift` of r, and s = 1 is reached at the far
edge of the disc. Given f and drift, s is a function of the place, and the brightness at some values of s follows by
least squares over the disc. From a grid of both, the pair with the smallest maximum difference from b is chosen.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import product
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray

LIGHT: Final = np.array([-0.35, 0.45, 0.82]) / np.linalg.norm([-0.35, 0.45, 0.82])
"""Direction toward the light in view axes (right, up, toward), as in `shaders/flat.frag`."""

SHADE: Final = 0.36
"""How much darker a ball is where it faces away from the light, as in `shaders/flat.frag`."""

STOPS: Final = 16
"""Values of s at which the gradient has a colour; denser outward, where the brightness falls fastest."""

RINGS, SPOKES = 25, 19
"""Places on the disc where brightness is compared: rings of equal area, over half a turn, by symmetry."""


@dataclass(frozen=True)
class Gradient:
    """A radial gradient over the unit disc, x right, y up: from 0 at the focus to 1 at the last circle.

    focus, center: the point to which circles shrink, and the centre of the last circle.
    offsets, brightness: factors on a colour at the offsets; linear in between.
    """

    focus: tuple[float, float]
    center: tuple[float, float]
    radius: float
    offsets: tuple[float, ...]
    brightness: tuple[float, ...]


def brightness(x: FloatArray, y: FloatArray) -> FloatArray:
    """Factor on the colour of pixels at a place of the unit disc."""
    normal = np.stack([x, y, np.sqrt(np.maximum(0.0, 1 - x**2 - y**2))], axis=-1)
    light: FloatArray = 1 - SHADE * ((1 - normal @ LIGHT) / 2) ** 2
    return light


@cache
def ball_gradient() -> Gradient:
    """The gradient closest to the shading of pixels."""
    rho, turn = np.sqrt(np.linspace(0, 1, RINGS))[:, None], np.linspace(0, np.pi, SPOKES)
    along, across = (rho * np.cos(turn)).ravel(), (rho * np.sin(turn)).ravel()
    reach = float(np.hypot(*LIGHT[:2]))
    toward = LIGHT[:2] / reach
    exact = brightness(along * toward[0] - across * toward[1], along * toward[1] + across * toward[0])
    offsets = 1 - np.linspace(1, 0, STOPS) ** 2
    best, least = (0.0, 0.0, 1.0, offsets), np.inf
    for focus, drift in product(np.linspace(0.5, 0.95, 19), np.linspace(0.2, 0.9, 29)):
        place = _shares(along - focus, across, drift)
        radius = float(place.max())
        levels, largest = _fitted(place / radius, offsets, exact)
        if largest < least:
            best, least = (float(focus), float(focus - drift * radius), radius, levels), largest
    focus, center, radius, levels = best
    east, north = toward.tolist()
    return Gradient(
        (focus * east, focus * north),
        (center * east, center * north),
        radius,
        tuple(offsets.tolist()),
        tuple(levels.tolist()),
    )


def _shares(x: FloatArray, y: FloatArray, drift: float) -> FloatArray:
    """Radii s of the circles about (−drift s, 0) through places relative to the focus: |(x + drift s, y)| = s."""
    a, b, c = 1 - drift**2, drift * x, x**2 + y**2
    shares: FloatArray = (b + np.sqrt(b**2 + a * c)) / a
    return shares


def _fitted(place: FloatArray, offsets: FloatArray, exact: FloatArray) -> tuple[FloatArray, float]:
    """Least-squares values at the offsets, linear in between, and the largest difference from the exact ones."""
    hats = np.stack([np.interp(place, offsets, row) for row in np.eye(len(offsets))], axis=1)
    levels = np.asarray(np.linalg.lstsq(hats, exact, rcond=None)[0], dtype=np.float64)
    return levels, float(np.abs(hats @ levels - exact).max())
