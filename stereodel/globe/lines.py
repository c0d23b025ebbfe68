"""Lines on the sphere, as maps give them: their images under a lens, and the parts of them that a view shows."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_lonlat, read_only
from stereodel.conformal import MoebiusMap
from stereodel.conformal.polylines import image_of_polylines, largest_scale
from stereodel.constants import LONGEST_EDGE
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude

Indices = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class SphereLines:
    """Polylines on the sphere: line i is ``points[offsets[i]:offsets[i + 1]]``, closed where its ends are equal.

    Parameters
    ----------
    points : (n, 3) array
        Unit vectors.
    offsets : (m + 1,) array
    lonlat : (n, 2) array, optional
        Longitudes and latitudes in degrees of the same points, where the lines are straight in them, as those of map
        files are; otherwise neighbours are joined by great-circle arcs.
    latitude : {"spherical", "geodetic", "authalic"}
        Of `lonlat`.
    """

    points: FloatArray
    offsets: Indices
    lonlat: FloatArray | None = None
    latitude: Latitude = "spherical"

    @classmethod
    def straight_in_lonlat(
        cls, lines: Iterable[npt.ArrayLike], latitude: Latitude = "spherical", *, shorter: bool = True
    ) -> SphereLines:
        """Lines, (k, 2) each, degrees, straight in longitude and latitude; single points are left out.

        With `shorter` a piece that spans more than 180° of longitude goes the other way, across ±180°.
        """
        arrays = [as_lonlat(line, "lines").reshape(-1, 2) for line in lines]
        arrays = [line for line in arrays if len(line) > 1]
        lonlat = np.concatenate([np.zeros((0, 2)), *arrays])
        return cls.of_lonlat(lonlat, _offsets([len(line) for line in arrays]), latitude, shorter=shorter)

    @classmethod
    def of_lonlat(
        cls,
        lonlat: FloatArray,
        offsets: npt.NDArray[np.integer],
        latitude: Latitude = "spherical",
        *,
        shorter: bool = True,
    ) -> SphereLines:
        """The same of flat arrays."""
        ends = offsets.astype(np.intp)
        places = _unwrapped(lonlat, ends) if shorter else lonlat
        points = lonlat_to_xyz(lonlat, latitude=latitude)
        return cls(read_only(points), read_only(ends), read_only(places), latitude)

    @classmethod
    def great(cls, starts: FloatArray, ends: FloatArray) -> SphereLines:
        """A great-circle arc, the shorter one, between each pair of unit vectors (n, 3)."""
        points = np.stack([starts, ends], axis=1).reshape(-1, 3)
        return cls(read_only(points), read_only(np.arange(0, len(points) + 1, 2)))

    def through(self, lens: MoebiusMap, *, tolerance: float) -> tuple[FloatArray, Indices]:
        """Polylines (unit vectors, offsets) whose chords are within `tolerance` radii of the images."""
        points, offsets = self._followed(lens, tolerance / 2)
        return image_of_polylines(lens, points, offsets, tolerance=tolerance / 2)

    def _followed(self, lens: MoebiusMap, tolerance: float) -> tuple[FloatArray, Indices]:
        """Points of great-circle arcs that stay close to lines straight in longitude and latitude, after the lens."""
        if self.lonlat is None or len(self.points) < 2:
            return self.points, self.offsets
        joined = np.ones(len(self.points) - 1, dtype=bool)
        joined[self.offsets[1:-1] - 1] = False
        first = np.flatnonzero(joined)
        pieces = pieces_of_edges(
            lens, self.lonlat[first], self.lonlat[first + 1], self.points[first], self.points[first + 1], tolerance
        )
        long = pieces > 1
        if not long.any():
            return self.points, self.offsets
        extra = pieces[long] - 1
        edge = np.repeat(first[long], extra)
        number = np.arange(len(edge)) - np.repeat(np.cumsum(extra) - extra, extra) + 1
        share = (number / np.repeat(pieces[long], extra))[:, None]
        # In this form rounding cannot lead beyond the ends, and so not beyond a pole.
        between = self.lonlat[edge] + share * (self.lonlat[edge + 1] - self.lonlat[edge])
        added = lonlat_to_xyz(between, latitude=self.latitude)
        return (
            np.insert(self.points, edge + 1, added, axis=0),
            self.offsets + np.searchsorted(edge + 1, self.offsets),
        )


def pieces_of_edges(
    lens: MoebiusMap, start: FloatArray, end: FloatArray, start_xyz: FloatArray, end_xyz: FloatArray, tolerance: float
) -> Indices:
    """Into how many great-circle arcs edges straight in longitude and latitude are cut, to stray by a tolerance."""
    length, bend = measures_in_lonlat(start, end, start_xyz, end_xyz)
    scale = largest_scale(lens, start_xyz, length)
    pieces = np.maximum(np.sqrt(bend * scale / tolerance), length / np.radians(LONGEST_EDGE))
    counted: Indices = np.maximum(1, np.ceil(pieces)).astype(np.intp)
    return counted


def measures_in_lonlat(
    start: FloatArray, end: FloatArray, start_xyz: FloatArray, end_xyz: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Upper bounds, radians: of the length of edges straight in (lon, lat), and how far they stray from an arc.

    With steps a in longitude and b in latitude the covariant acceleration is (sin φ cos φ a², −2 sin φ a b) northwards
    and eastwards; a curve strays by an eighth of it from the great-circle arc between its ends.
    """
    a, b = np.abs(np.radians(end - start)).T
    z0, z1 = start_xyz[:, 2], end_xyz[:, 2]
    sine = np.maximum(np.abs(z0), np.abs(z1))
    lowest = np.where(z0 * z1 < 0, 0.0, np.minimum(np.abs(z0), np.abs(z1)))
    cosine = np.sqrt(np.maximum(0.0, 1 - lowest**2))
    return np.hypot(cosine * a, b), sine * np.hypot(cosine * a**2, 2 * a * b) / 8


def clipped_lines(points: FloatArray, offsets: Indices, edge: float) -> tuple[FloatArray, Indices]:
    """The parts of polylines of unit vectors in view axes that are in the cap z ≥ edge, ended on its rim.

    Returns
    -------
    points : (k, 3) array
    offsets : (r + 1,) int array
        Of the runs that are left; a line that leaves the cap and comes back becomes two.
    """
    if len(points) == 0:
        return points, np.zeros(1, dtype=np.intp)
    inside = points[:, 2] >= edge
    joined = np.ones(len(points), dtype=bool)
    joined[offsets[1:] - 1] = False
    # Between each point and the next there may be one on the rim.
    crosses = joined & (inside != np.roll(inside, -1))
    where = np.flatnonzero(crosses)
    rim = on_rim(points[where], points[(where + 1) % len(points)], edge)
    elements = np.insert(points, where + 1, rim, axis=0)
    place = np.arange(len(points)) + np.cumsum(crosses) - crosses
    kept = np.ones(len(elements), dtype=bool)
    kept[place] = inside
    # A run begins at a point inside that nothing inside comes before on its line, or on the rim on the way in.
    begins = np.zeros(len(elements), dtype=bool)
    begins[place[np.unique(offsets[:-1][offsets[:-1] < offsets[1:]])]] = True
    begins[place[where] + 1] = ~inside[where]
    begins &= kept
    starts = np.cumsum(kept)[begins] - 1
    runs = np.append(starts, kept.sum())
    return _without_points(elements[kept], runs)


def on_rim(a: FloatArray, b: FloatArray, edge: float) -> FloatArray:
    """Where chords between unit vectors in view axes meet the plane z = edge, pushed onto the rim of the cap."""
    share = (edge - a[:, 2:]) / (b[:, 2:] - a[:, 2:])
    point = a + share * (b - a)
    across = np.sqrt(np.sum(point[:, :2] ** 2, axis=1, keepdims=True))
    point[:, :2] *= np.sqrt(1 - edge**2) / np.maximum(across, np.finfo(np.float64).tiny)
    point[:, 2] = edge
    return point


def thinned(points: FloatArray, offsets: Indices, spacing: float) -> tuple[FloatArray, Indices]:
    """Polylines on the page without points that are closer along the line than `spacing`; ends stay.

    What is left out is less than `spacing` from a point that stays.
    """
    if len(points) == 0:
        return points, offsets
    step = np.zeros(len(points))
    step[1:] = np.hypot(*(points[1:] - points[:-1]).T)
    step[offsets[:-1]] = 0.0
    cell = np.floor(np.cumsum(step) / spacing)
    kept = np.ones(len(points), dtype=bool)
    kept[1:] = cell[1:] != cell[:-1]
    kept[offsets[:-1]] = True
    kept[offsets[1:] - 1] = True
    return points[kept], np.concatenate([[0], np.cumsum(kept)])[offsets]


def _unwrapped(lonlat: FloatArray, offsets: Indices) -> FloatArray:
    """Longitudes that go on across ±180° along each line."""
    step = np.diff(lonlat[:, 0], prepend=lonlat[:1, 0])
    step[offsets[:-1]] = 0.0
    jumps = np.where(np.abs(step) > 180, -360.0 * np.sign(step), 0.0)
    if not jumps.any():
        return lonlat
    total = np.cumsum(jumps)
    shift = total - np.repeat(total[offsets[:-1]], np.diff(offsets))
    return np.stack([lonlat[:, 0] + shift, lonlat[:, 1]], axis=1)


def _without_points(points: FloatArray, offsets: Indices) -> tuple[FloatArray, Indices]:
    """Lines of two points or more."""
    sizes = np.diff(offsets)
    kept = np.repeat(sizes > 1, sizes)
    return points[kept], _offsets(sizes[sizes > 1])


def _offsets(sizes: npt.ArrayLike) -> Indices:
    return np.concatenate([[0], np.cumsum(np.asarray(sizes, dtype=np.intp))]).astype(np.intp)
