"""Lines and regions of the sphere, from maps and diagrams, prepared once for all lenses and views."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
import numpy.typing as npt

from stereodel import data
from stereodel._arrays import BoolArray, FloatArray, Indices, as_lonlat
from stereodel.curves import trace
from stereodel.curves.chart import Chart
from stereodel.curves.insides import oriented
from stereodel.curves.ragged import Ragged, thinned
from stereodel.curves.seams import stitched
from stereodel.io.rows_of import ridge_net, triangle_sides, voronoi_sides
from stereodel.sphere import SphereArc, SphereCircle
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import units
from stereodel.triangulation import SphericalDelaunay, SphericalVoronoi

Rings = Sequence[npt.ArrayLike]
"""An outer ring and its holes, (k, 2) each, in degrees; the first point may be repeated at the end."""


@dataclass(frozen=True, eq=False)
class SphereLines:
    """Lines on the sphere as sequences of edges, which they may share; `sides` has ~e for edge e in reverse."""

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
    def great(cls, starts: FloatArray, ends: FloatArray) -> SphereLines:
        """The shorter great-circle arc between each pair of unit vectors (n, 3)."""
        return cls.alone(trace.great(starts, ends))

    @classmethod
    def alone(cls, arcs: trace.Arcs) -> SphereLines:
        """Prepared arcs, each of them a line."""
        return cls(trace.Edges.of(trace.numbered(arcs)), Ragged(np.arange(len(arcs)), np.arange(len(arcs) + 1)))

    def on(self, chart: Chart) -> tuple[Ragged, Indices]:
        """The visible parts, on the page, and the line of each."""
        seen, line = chart.lines(self.edges, self.sides)
        return thinned(seen, chart.tolerance), line


@dataclass(frozen=True, eq=False)
class SphereRegions:
    """Regions bounded by rings of edges, interior on the left; neighbours may share edges.

    rings: the edges of each ring in order; ~e for edge e in reverse.
    owner: the region of each ring, (r,).
    everywhere: whether each region is the whole sphere, without any ring, (n,).
    """

    edges: trace.Edges
    rings: Ragged
    owner: Indices
    everywhere: BoolArray

    @classmethod
    def of_lonlat(
        cls, polygons: Iterable[Rings], *, owners: npt.ArrayLike | None = None, latitude: Latitude = "spherical"
    ) -> SphereRegions:
        """Polygons whose sides are straight in longitude and latitude; ValueError for a ring of less than three points.

        polygons: rings of each polygon in degrees, the outer one first, in either direction. A ring that jumps by more
            than 180° of longitude continues across ±180°; one that separates the poles has its smaller side inside.
        owners: the region of each polygon; by default each polygon is one region.
        """
        rings, polygon, hole = [], [], []
        for number, polygon_rings in enumerate(polygons):
            rings += [_closed(ring, number) for ring in polygon_rings]
            hole += [place > 0 for place in range(len(polygon_rings))]
            polygon += [number] * len(polygon_rings)
        region = np.array(polygon, dtype=np.intp)
        if owners is not None:
            region = np.asarray(owners, dtype=np.intp)[region]
        count = int(region.max(initial=-1)) + 1
        lonlat, area = oriented(trace.unwrapped(Ragged.of(rings, np.zeros((0, 2)))), np.array(hole, dtype=bool))
        start, end, sides, owner = stitched(lonlat, region)
        # A polygon that fills the map, with no border left once the map's seams are removed, is the whole sphere: half
        # of the equal-area map are 360 square degrees.
        everywhere = np.bincount(region, area, minlength=count) > 360.0
        everywhere[owner[sides.sizes > 0]] = False
        return cls(trace.Edges.straight(start, end, latitude), sides, owner, everywhere)

    @classmethod
    def cells(cls, voronoi: SphericalVoronoi) -> SphereRegions:
        """The cells of a diagram, one region for each site."""
        sizes = np.diff(voronoi.region_offsets)
        if (sizes == 2).any() or (len(sizes) and len(voronoi.region_indices) == 0):
            raise ValueError(
                "a cell has fewer than three vertices, as where all sites are on one circle; draw its ridges"
            )
        count = len(voronoi.points)
        return cls._of(ridge_net(voronoi).arcs(), voronoi_sides(voronoi), np.arange(count), count)

    @classmethod
    def triangles(cls, triangulation: SphericalDelaunay) -> SphereRegions:
        """The triangles of a triangulation except closing ones, one region for each simplex."""
        kept = np.flatnonzero(~triangulation.closing)
        points, (sides, pairs) = units(triangulation.points), triangle_sides(triangulation.simplices[kept])
        arcs = trace.great(points[pairs[:, 0]], points[pairs[:, 1]])
        return cls._of(arcs, sides, kept, len(triangulation.simplices))

    @classmethod
    def circles(cls, circles: Iterable[SphereCircle]) -> SphereRegions:
        """The interiors of circles."""
        arcs = trace.exact([SphereArc.whole(circle) for circle in circles])
        number = np.arange(len(arcs))
        return cls._of(arcs, Ragged(number, np.arange(len(arcs) + 1)), number, len(arcs))

    @classmethod
    def _of(cls, arcs: trace.Arcs, rings: Ragged, owner: Indices, count: int) -> SphereRegions:
        return cls(trace.Edges.of(arcs), rings, owner, np.zeros(count, dtype=bool))

    @property
    def count(self) -> int:
        """Number of regions."""
        return len(self.everywhere)

    @cached_property
    def complement(self) -> SphereRegions:
        """What none of the regions contains, as one region, if they do not overlap."""
        rings = Ragged(~self.rings.values[::-1], self.rings.offsets[-1] - self.rings.offsets[::-1])
        everywhere = np.array([not len(rings) and not self.everywhere.any()])
        return SphereRegions(self.edges, rings, np.zeros_like(self.owner), everywhere)

    @cached_property
    def left(self) -> FloatArray:
        """What `Edges.left` says of the rings."""
        return self.edges.left(self.rings)

    @property
    def outlines(self) -> SphereLines:
        """The rings as lines, without the seams of map files."""
        return SphereLines(self.edges, self.rings)

    def on(self, chart: Chart) -> tuple[Ragged, Indices]:
        """The visible parts, as closed loops on the page, interior on the left, and the region of each."""

        def around(shown: BoolArray) -> BoolArray:
            center, reach = self._caps
            chord = np.sqrt(np.sum((center - chart.source.normal) ** 2, axis=1))
            asked = ~shown & (2 * np.arcsin(np.minimum(chord / 2, 1.0)) <= reach)  # not certainly elsewhere
            return self.everywhere | chart.surrounded(self.edges, self.rings, self.owner, self.left, asked)

        return chart.regions(self.edges, self.rings, self.owner, self.left, self.count, around)

    @cached_property
    def _caps(self) -> tuple[FloatArray, FloatArray]:
        """Centres (n, 3) and radii of caps that contain the regions; of one in no hemisphere, the sphere."""
        edge = np.where(self.rings.values < 0, ~self.rings.values, self.rings.values)
        region = self.owner[self.rings.row]
        start = np.where((self.rings.values < 0)[:, None], self.edges.arcs.end[edge], self.edges.arcs.start[edge])
        total = np.zeros((self.count, 3))
        np.add.at(total, region, start)
        length = np.sqrt(np.sum(total**2, axis=1, keepdims=True))
        center = np.divide(total, length, out=np.zeros_like(total), where=length > 0)
        away = 2 * np.arcsin(np.minimum(np.sqrt(np.sum((start - center[region]) ** 2, axis=1)) / 2, 1.0))
        reach = np.zeros(self.count)
        np.maximum.at(reach, region, away + self.edges.length[edge])
        # A region with its border in less than a hemisphere is within it, too, or else more than half of the sphere.
        area = np.mod(np.bincount(self.owner, self.left[:, 0], minlength=self.count), 4 * np.pi)
        reach[(reach >= np.pi / 2) | (area >= 2 * np.pi)] = np.pi
        return center, reach


def _closed(ring: npt.ArrayLike, number: int) -> FloatArray:
    """A ring as an array with its first point repeated at the end."""
    points = as_lonlat(ring, f"polygons[{number}]").reshape(-1, 2)
    if len(points) > 1 and (points[0] == points[-1]).all():
        points = points[:-1]
    if len(points) < 3:
        raise ValueError(f"polygons[{number}] has a ring of {len(points)} distinct points; a ring needs three")
    return np.concatenate([points, points[:1]])


@cache
def earth_lines(name: str, resolution: str, latitude: Latitude) -> SphereLines:
    """Natural Earth's coastlines, borders or rivers."""
    lines = getattr(data, name)(resolution=resolution)
    return SphereLines.of_lonlat(Ragged(lines.lonlat, lines.offsets.astype(np.intp)), latitude)


@cache
def earth_regions(name: str, resolution: str, latitude: Latitude) -> SphereRegions:
    """Natural Earth's land or lakes."""
    return SphereRegions.of_lonlat(getattr(data, name)(resolution=resolution).polygons(), latitude=latitude)
