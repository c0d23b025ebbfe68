"""The triangles of a picture: pieces of items in painter's order, and those needed for a window."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, IntArray, Pixels, SingleArray

Corners = FloatArray
"""Triangles by their corners, (n, 3, 2)."""

Disc = tuple[float, float, float, float]
"""Centre x, y and radius along x and y, in pixels, which may differ slightly."""

MARGIN = 1.0
"""Pixels by which a window is widened to find its triangles: coordinates up to 2²⁴ are rounded by 1/2."""


@dataclass(frozen=True, eq=False)
class Triangles:
    """Coloured triangles in painter's order.

    points: (n, 2), pixels from the lower left corner, x right, y up.
    colors: (n, 4), sRGB and opacity in [0, 1].
    slots: (n,), index of the item of each vertex; must not decrease along `faces`.
    faces: (m, 3), either orientation.
    textures: by index of an item, an image of the window with this item alone, sRGB and opacity, rows from the top; it
        multiplies the colours of the item's triangles pixel by pixel.
    balls: by index of an item, the ball that shades it: centre x, y and radius along x and y, in pixels from the lower
        left corner, see `stereodel.drawing.page.Ball`.
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


@dataclass(frozen=True, eq=False)
class Piece:
    """Triangles of one item by their corners (n, 3, 2), pixels, and a colour at each corner (n, 3, 4).

    An item with a texture, which is created when a window is drawn, must consist of one piece; all pieces of an item
    are shaded by the same ball, or by none.
    """

    corners: Corners
    colors: FloatArray
    texture: Callable[[Window], Pixels] | None = None
    ball: Disc | None = None

    @cached_property
    def boxes(self) -> SingleArray:
        """Bounding box of each triangle, (n, 4)."""
        a, b, c = (self.corners[:, i] for i in range(3))
        low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
        return np.concatenate([low, high], axis=1, dtype=np.float32)


class Pieces:
    """The triangles of a picture in painter's order, piece by piece.

    numbered: index of a piece's item, not decreasing, and the piece.

    >>> corners = np.array([[[0.0, 0.0], [9.0, 0.0], [0.0, 9.0]], [[90.0, 90.0], [99.0, 90.0], [90.0, 99.0]]])
    >>> pieces = Pieces([(0, Piece(corners, np.ones((2, 3, 4))))])
    >>> len(pieces.within(Window(0, 0, 50, 50)).faces), len(pieces.within(Window(0, 0, 100, 100)).faces)
    (1, 2)
    """

    def __init__(self, numbered: Iterable[tuple[int, Piece]]) -> None:
        kept = [(number, piece) for number, piece in numbered if len(piece.corners)]
        self._numbers = np.array([number for number, _ in kept], dtype=np.int32)
        self._pieces = [piece for _, piece in kept]
        self._boxes = np.array([_around(piece.boxes) for piece in self._pieces], dtype=np.float32).reshape(-1, 4)

    def within(self, window: Window) -> Triangles:
        """All triangles that touch a window, in order, and possibly others."""
        hit = np.flatnonzero(_touching(self._boxes, window))
        chosen = [(self._pieces[i], np.flatnonzero(_touching(self._pieces[i].boxes, window))) for i in hit]
        corners = np.concatenate([np.zeros((0, 3, 2)), *(piece.corners[rows] for piece, rows in chosen)])
        colors = np.concatenate([np.zeros((0, 3, 4)), *(piece.colors[rows] for piece, rows in chosen)])
        slots = np.repeat(self._numbers[hit], [3 * len(rows) for _, rows in chosen])
        faces = np.arange(3 * len(corners), dtype=np.int32).reshape(-1, 3)
        drawn = [
            (int(self._numbers[i]), self._pieces[i]) for i, (_, rows) in zip(hit, chosen, strict=True) if len(rows)
        ]
        textures = {number: piece.texture(window) for number, piece in drawn if piece.texture is not None}
        balls = {number: piece.ball for number, piece in drawn if piece.ball is not None}
        return Triangles(corners.reshape(-1, 2), colors.reshape(-1, 4), slots, faces, textures, balls)


def _around(boxes: SingleArray) -> SingleArray:
    return np.concatenate([boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)])


def _touching(boxes: SingleArray, window: Window) -> BoolArray:
    left, bottom, right, top = boxes.T
    across = (left < window.left + window.width + MARGIN) & (right > window.left - MARGIN)
    touching: BoolArray = across & (bottom < window.bottom + window.height + MARGIN) & (top > window.bottom - MARGIN)
    return touching
