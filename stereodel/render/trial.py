"""A small test picture with known pixels, drawn to check whether rendering works.

It shows a texture behind a translucent rectangle of two triangles, so that a misplaced texel, a missing triangle, an
edge without four samples and a seam along the diagonal are all detected.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from stereodel._arrays import Pixels
from stereodel.render.pieces import Triangles

SIDE: Final = 8
"""Pixels across and down."""

VEIL: Final = (1.25, 2.0, 6.5, 7.0)
"""Left, bottom, right and top of the rectangle: three quarters of a column, whole columns, and half of one."""

VEILED: Final = np.array([0.0, 0.75, 1.0, 1.0, 1.0, 1.0, 0.5, 0.0])
"""Fraction of the samples of each column covered by the rectangle, in its rows."""

ROUNDING: Final = 2
"""Levels of 255 by which a pixel may differ: blending is rounded once, and the average of the samples once."""


def trial_triangles() -> Triangles:
    """The triangles of the test picture, `SIDE` pixels wide and high."""
    left, bottom, right, top = VEIL
    ground = [(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)]
    veil = [(left, bottom), (right, bottom), (right, top), (left, top)]
    colors = [[1.0, 1.0, 1.0, 1.0]] * 4 + [[0.0, 0.0, 0.0, 0.5]] * 4
    faces = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]], dtype=np.int32)
    texels = np.dstack([_texels(), np.full((SIDE, SIDE), 255, dtype=np.uint8)])
    slots = np.repeat(np.arange(2, dtype=np.int32), 4)
    return Triangles(np.array(ground + veil, dtype=float), np.array(colors), slots, faces, {0: texels})


def trial_pixels() -> Pixels:
    """The expected pixels, (SIDE, SIDE, 3)."""
    _, bottom, _, top = VEIL
    rows = np.arange(SIDE - 1, -1, -1)
    share = np.outer((rows >= bottom) & (rows < top), VEILED)[..., None]
    return np.rint(_texels() * (1 - share / 2)).astype(np.uint8)


def trial_problem(picture: Pixels) -> str:
    """A description of errors in a rendered test picture; empty if there are none.

    >>> trial_problem(trial_pixels())
    ''
    >>> trial_problem(trial_pixels()[::-1])
    '64 of 64 pixels of a trial picture are wrong, the first is (0, 224, 90) in place of (0, 0, 90)'
    """
    expected = trial_pixels()
    wrong = (np.abs(expected.astype(np.int16) - picture) > ROUNDING).any(axis=-1)
    if not wrong.any():
        return ""
    found, wanted = (tuple(pixels[wrong][0].tolist()) for pixels in (picture, expected))
    count = f"{np.count_nonzero(wrong)} of {wrong.size} pixels of a trial picture are wrong"
    return f"{count}, the first is {found} in place of {wanted}"


def _texels() -> Pixels:
    """Texels of distinct colours: red encodes the column, green the row."""
    row, column = np.indices((SIDE, SIDE))
    return np.stack([32 * column, 32 * row, np.full_like(row, 90)], axis=-1).astype(np.uint8)
