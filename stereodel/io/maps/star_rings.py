"""Rings on the map that are seen to be simple without a geometry of each: nearly all of a large diagram.

A ring is star-shaped if it winds once around the mean of its points, always forward as seen from there: its rays
to all points of it differ, so that it meets itself nowhere, and it runs counterclockwise. Both follow from signs, the
first with a bound on its rounding error; uncertain cases are left to GEOS.
"""

from __future__ import annotations

import numpy as np

from stereodel._arrays import BoolArray, FloatArray
from stereodel.constants import STAR_ROUNDING
from stereodel.curves.ragged import Ragged


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
