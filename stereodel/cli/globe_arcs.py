"""Arcs of the sphere seen through a lens, many at a time, as they are drawn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stereodel import MoebiusMap, SphericalVoronoi
from stereodel._arrays import FloatArray, IntArray
from stereodel.constants import SHORT_ARC
from stereodel.render import CircleArc


@dataclass(frozen=True, eq=False)
class Arcs:
    """Arcs of circles of the unit sphere, each by its start, its middle and its end, (k, 3)."""

    start: FloatArray
    middle: FloatArray
    end: FloatArray

    @classmethod
    def great(cls, start: FloatArray, end: FloatArray, normal: FloatArray | None = None) -> Arcs:
        """Great-circle arcs of at most 180°, counterclockwise about `normal`, by default the shorter ones."""
        middle = start + end
        if normal is not None:
            # Half the way round from start, also where the ends are opposite.
            halves = np.arctan2(_length(np.cross(start, end)), np.sum(start * end, axis=1, keepdims=True)) / 2
            middle = np.cos(halves) * start + np.sin(halves) * np.cross(normal, start)
        length = _length(middle)
        joined = length[:, 0] > 0  # opposite ends have no shorter arc
        return cls(start[joined], middle[joined] / length[joined], end[joined])

    def through(self, lens: MoebiusMap) -> Arcs:
        """Their images under a conformal map, which are arcs of circles again."""
        return Arcs(lens(self.start), lens(self.middle), lens(self.end))

    def facing(self, toward: FloatArray) -> Arcs:
        """Those that may be seen from above a point: no point of an arc is farther than half of it from an end."""
        heights = np.maximum(self.start @ toward, self.end @ toward)
        _, radius, sweep = self._circles()
        seen = heights + radius * sweep / 2 > 0
        return Arcs(self.start[seen], self.middle[seen], self.end[seen])

    def curves(self) -> list[CircleArc]:
        """The arcs, ready to be drawn."""
        axis, _, sweep = self._circles()
        center = axis * np.sum(axis * self.start, axis=1, keepdims=True)
        u = self.start - center
        v = np.cross(axis, u)
        drawn = np.flatnonzero(sweep > 0)
        return [CircleArc(center[k], u[k], v[k], 0.0, float(sweep[k])) for k in drawn]

    def _circles(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Unit normals (k, 3), radii (k,) and angles swept about the normals (k,)."""
        first, second = self.middle - self.start, self.end - self.middle
        axis = np.cross(first, second)
        short = (_length(first) + _length(second))[:, 0] < SHORT_ARC
        axis[short] = np.cross(self.start[short], self.end[short] - self.start[short])
        axis /= np.maximum(_length(axis), np.finfo(np.float64).tiny)
        u = self.start - axis * np.sum(axis * self.start, axis=1, keepdims=True)
        sweep = np.arctan2(np.sum(np.cross(axis, u) * self.end, axis=1), np.sum(u * self.end, axis=1))
        # Rounding may turn the angle of a short arc negative; it is not a whole turn for that.
        return axis, _length(u)[:, 0], np.where(short, np.abs(sweep), np.mod(sweep, 2 * np.pi))


def edges_of(points: FloatArray, pairs: IntArray) -> Arcs:
    """The shorter great-circle arcs between pairs of unit vectors."""
    return Arcs.great(points[pairs[:, 0]], points[pairs[:, 1]])


def ridges_of(diagram: SphericalVoronoi) -> Arcs:
    """The ridges of a Voronoi diagram."""
    ends = diagram.vertices[diagram.ridge_vertices]
    return Arcs.great(ends[:, 0], ends[:, 1], diagram.ridge_normals())


def _length(vectors: FloatArray) -> FloatArray:
    """Lengths of rows, (k, 1)."""
    length: FloatArray = np.sqrt(np.sum(vectors**2, axis=1, keepdims=True))
    return length
