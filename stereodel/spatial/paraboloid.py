"""Qhull's picture of a Delaunay triangulation: the lower hull of the points lifted to a paraboloid."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.spatial.options import Options

_INFINITY_ABOVE = 1.1
"""With "Qz", Qhull puts a point at infinity at so many times the height of the highest point."""


class Paraboloid(NamedTuple):
    """The surface z = scale·(x² + y²) + shift."""

    scale: float
    shift: float

    @classmethod
    def over(cls, points: FloatArray, options: Options) -> Paraboloid:
        """Qhull's paraboloid: with "Qbb", heights run from 0 to the largest absolute coordinate."""
        if not options.scaled or len(points) == 0:
            return cls(1.0, 0.0)
        with np.errstate(over="ignore"):
            heights = (points**2).sum(axis=1)
        low, high = float(heights.min()), float(heights.max()) * (_INFINITY_ABOVE if options.at_infinity else 1.0)
        if not low < high < np.inf:
            return cls(1.0, 0.0)
        scale = float(np.abs(points).max()) / (high - low)
        return cls(scale, -low * scale)

    def lift(self, points: FloatArray) -> FloatArray:
        """Points (..., 2) with their heights, (..., 3)."""
        heights = (points**2).sum(axis=-1) * self.scale + self.shift
        return np.concatenate([points, heights[..., None]], axis=-1)

    def equations(self, corners: FloatArray) -> FloatArray:
        """Planes (m, 4) of lifted triangles (m, 3, 2): unit normal that points down, and offset.

        With d = b − a, e = c − a and the doubled area A = d×e, the circumcentre is a + q/2A where
        q = (e_y|d|² − d_y|e|², d_x|e|² − e_x|d|²), and the plane is that of the paraboloid's gradient there: its normal
        is that of (scale·(q + 2Aa), −A). Nothing is divided by the area, so that slivers have planes as well.
        """
        a, d, e = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        dd, ee = (d * d).sum(axis=1), (e * e).sum(axis=1)
        area = np.maximum(d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0], 0.0)  # exactly positive, whatever rounding says
        q = np.column_stack([e[:, 1] * dd - d[:, 1] * ee, d[:, 0] * ee - e[:, 0] * dd])
        normals = np.column_stack([self.scale * (q + 2.0 * area[:, None] * a), -area])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        return np.column_stack([normals, -(normals * self.lift(a)).sum(axis=1)])
