"""Lines and polygons as flat arrays: what the sets of maps have in common."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from stereodel._arrays import FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class Lines:
    """Polylines, straight in longitude and latitude: line i is ``lonlat[offsets[i]:offsets[i + 1]]``."""

    lonlat: FloatArray
    """(n, 2): longitude and geodetic latitude in degrees."""
    offsets: IntArray
    """(m + 1,)."""

    def lines(self) -> list[FloatArray]:
        """The polylines, each (k, 2)."""
        return np.split(self.lonlat, self.offsets[1:-1])

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """All lines as GeoJSON: one MultiLineString."""
        return {"type": "MultiLineString", "coordinates": [line.tolist() for line in self.lines()]}


@dataclass(frozen=True, eq=False)
class Polygons:
    """Polygons as GeoJSON has them: sides straight in longitude and latitude, cut along ±180°.

    Ring i is ``lonlat[ring_offsets[i]:ring_offsets[i + 1]]``, its first point again at its end; polygon j has the rings
    from ``polygon_offsets[j]`` up to ``polygon_offsets[j + 1]``: its outline counterclockwise, then holes clockwise.
    """

    lonlat: FloatArray
    """(n, 2): longitude and geodetic latitude in degrees."""
    ring_offsets: IntArray
    """(r + 1,)."""
    polygon_offsets: IntArray
    """(p + 1,)."""

    def polygons(self) -> list[list[FloatArray]]:
        """The polygons, each a list of rings (k, 2), the outline first."""
        rings = np.split(self.lonlat, self.ring_offsets[1:-1])
        return [rings[i:j] for i, j in pairwise(self.polygon_offsets.tolist())]

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """All polygons as GeoJSON: one MultiPolygon."""
        return {
            "type": "MultiPolygon",
            "coordinates": [[ring.tolist() for ring in polygon] for polygon in self.polygons()],
        }
