"""What goes into OpenGL and comes out: coloured triangles, windows, pixels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from stereodel._arrays import FloatArray, IntArray, Pixels

Disc = tuple[float, float, float, float]
"""Centre x, y and radius along x and y, in pixels, which need not be quite as high as wide."""


@dataclass(frozen=True, eq=False)
class Triangles:
    """Coloured triangles in painter's order.

    Parameters
    ----------
    points : (n, 2) array
        Pixels from the lower left corner, x right, y up.
    colors : (n, 4) array
        sRGB and opacity in [0, 1].
    slots : (n,) int array
        Number of the item that a vertex belongs to; must not decrease along `faces`.
    faces : (m, 3) int array
        Either orientation.
    textures : mapping of int to (height, width, 4) uint8 array
        Number of an item → the window that is drawn as it alone would look, sRGB and opacity, rows from the top: what
        the colours of its triangles are multiplied by, pixel for pixel.
    balls : mapping of int to tuple of float
        Number of an item → centre x, y and radius along x and y, pixels from the lower left corner: the ball in whose
        light it is drawn, see `stereodel.drawing.page.Ball`.
    """

    points: FloatArray
    colors: FloatArray
    slots: IntArray
    faces: IntArray
    textures: Mapping[int, Pixels] = field(default_factory=dict)
    balls: Mapping[int, Disc] = field(default_factory=dict)


@dataclass(frozen=True)
class Window:
    """A part of a picture, in pixels from its lower left corner, x right, y up."""

    left: int
    bottom: int
    width: int
    height: int
