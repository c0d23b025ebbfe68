"""The largest scale of a lens near a point."""

from __future__ import annotations

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.conformal.moebius import MoebiusMap
from stereodel.sphere.vectors import turned


def largest_scale(lens: MoebiusMap, points: FloatArray, radius: FloatArray) -> FloatArray:
    """The largest local scale within angular distances `radius` (n,) of unit vectors (n, 3), radians."""
    there = turned(points, lens.right.matrix)
    size = lens.magnification
    height = there[:, 2] if size >= 1 else -there[:, 2]
    across = np.sqrt(there[:, 0] ** 2 + there[:, 1] ** 2)
    # At the place nearest to the point of largest scale: the focus, or its antipode if the map shrinks.
    half = np.maximum(np.arctan2(across, height) - radius, 0.0) / 2
    larger = max(size, 1 / size)
    scale: FloatArray = larger / (np.cos(half) ** 2 + (larger * np.sin(half)) ** 2)
    return scale
