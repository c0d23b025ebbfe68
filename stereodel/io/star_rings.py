"""Rings on the map that are seen to be simple without a geometry of each: nearly all of a large diagram.

A ring is star-shaped if it winds once around the mean of its points, always forward as seen from there: its rays
to all points of it differ, so that it meets itself nowhere, and it runs counterclockwise. Both follow from signs, the
first with a bound on its rounding error; uncertain cases are left to GEOS.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Packed
from stereodel.constants import STAR_ROUNDING
from stereodel.curves.ragged import Ragged

HEAD: Final = np.frombuffer(bytes([1, 3, 0, 0, 0, 1, 0, 0, 0]), dtype=np.uint8)
"""Header of a polygon with one ring as well-known binary, before the number of its points."""


def star_shaped(rings: Ragged, slack: float) -> tuple[BoolArray, FloatArray]:
    """Which rings are surely simple and counterclockwise, with the area in them where they are.

    Rings are on the map, none is empty, and the first point does not come again at the end. A ring with an area of less
    than `slack` times its length, however little, is not sure.
    """
    first, sizes = rings.offsets[:-1], rings.sizes
    center = np.add.reduceat(rings.values, first) / sizes[:, None]
    x, y = np.repeat(center, sizes, axis=0).T
    x, y = rings.values[:, 0] - x, rings.values[:, 1] - y
    after = rings.following
    x_after, y_after = x[after], y[after]
    ahead, back = x * y_after, y * x_after
    cross = ahead - back
    forward = cross > STAR_ROUNDING * (np.abs(ahead) + np.abs(back)) + np.finfo(np.float64).tiny
    # What always goes forward passes the direction of x once in each turn, and from below.
    turns = np.add.reduceat((y < 0) & (y_after >= 0), first, dtype=np.intp)
    area = np.add.reduceat(cross, first) / 2
    length = np.add.reduceat(np.hypot(x_after - x, y_after - y), first)
    return np.logical_and.reduceat(forward, first) & (turns == 1) & (area > 2 * slack * length), area


def packed_rings(rings: Ragged) -> Packed:
    """Polygons of one ring each, without its first point again at its end, as well-known binary."""
    result: Packed = np.full(len(rings), None, dtype=object)
    sizes = rings.sizes
    for size in np.unique(sizes).tolist():
        rows = np.flatnonzero(sizes == size)
        place = rings.offsets[rows, None] + np.append(np.arange(size), 0)
        cells = np.empty((len(rows), len(HEAD) + 4 + 16 * (size + 1)), dtype=np.uint8)
        cells[:, : len(HEAD)] = HEAD
        cells[:, len(HEAD) : len(HEAD) + 4] = np.array([size + 1], dtype="<u4").view(np.uint8)
        cells[:, len(HEAD) + 4 :] = rings.values[place].astype("<f8", copy=False).reshape(len(rows), -1).view(np.uint8)
        result[rows] = cells.view(f"V{cells.shape[1]}")[:, 0].astype(object)
    return result
