"""Lines on the sphere, from maps and diagrams, prepared once for all lenses and views."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Indices, as_lonlat
from stereodel.conformal import MoebiusMap
from stereodel.curves import clip, trace
from stereodel.curves.borders import Pieces
from stereodel.curves.chart import Chart
from stereodel.curves.ragged import Ragged, thinned
from stereodel.sphere.latitudes import Latitude


@dataclass(frozen=True, eq=False)
class SphereLines:
    """Lines on the sphere as sequences of edges, which they may share.

    Parameters
    ----------
    edges : Edges
    sides : Ragged
        The edges of each line in order; ~e for edge e in reverse.
    """

    edges: trace.Edges
    sides: Ragged

    @classmethod
    def straight_in_lonlat(cls, lines: Iterable[npt.ArrayLike], latitude: Latitude = "spherical") -> SphereLines:
        """Lines, (k, 2) each, in degrees, straight in longitude and latitude; single points are left out.

        A segment that spans more than 180° of longitude takes the shorter way, across ±180°.
        """
        arrays = [as_lonlat(line, "lines").reshape(-1, 2) for line in lines]
        return cls.of_lonlat(Ragged.of([line for line in arrays if len(line) > 1], np.zeros((0, 2))), latitude)

    @classmethod
    def of_lonlat(cls, lines: Ragged, latitude: Latitude = "spherical") -> SphereLines:
        """The same, from rows of points in degrees."""
        lonlat = trace.unwrapped(lines, turns=False)
        first, sides = trace.sides_of(lonlat)
        return cls(trace.Edges.straight(lonlat.values[first], lonlat.values[first + 1], latitude), sides)

    @classmethod
    def great(cls, starts: FloatArray, ends: FloatArray, normals: FloatArray | None = None) -> SphereLines:
        """A great-circle arc between each pair of unit vectors (n, 3): the shorter one, or the one around a normal."""
        return cls.alone(trace.great(starts, ends, normals))

    @classmethod
    def alone(cls, arcs: trace.Arcs) -> SphereLines:
        """Prepared arcs, each of them a line."""
        return cls(trace.Edges.of(trace.numbered(arcs)), Ragged(np.arange(len(arcs)), np.arange(len(arcs) + 1)))

    def on(self, chart: Chart) -> Ragged:
        """The visible parts, on the page."""
        return thinned(chart.lines(self.edges, self.sides), chart.tolerance)

    def through(self, lens: MoebiusMap, *, tolerance: float) -> tuple[FloatArray, Indices]:
        """Polylines (unit vectors, offsets) whose chords are within `tolerance` radii of the images."""
        pieces = Pieces.uncut(self.edges.arcs_under(lens, tolerance / 2).through(lens), seen=True)
        chains = clip.chains_of(self.sides, pieces)
        found = clip.points_along(chains.pieces, pieces.arcs.sampled(tolerance / 2))
        return found.values, found.offsets
