"""Polygons of maps as triangles: rings straight in longitude and latitude, an outer one and its holes each."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_lonlat
from stereodel._extras import of_extra
from stereodel.globe.lines import SphereLines
from stereodel.globe.regions import SphereMesh
from stereodel.sphere.latitudes import Latitude

Rings = Sequence[npt.ArrayLike]
"""An outer ring and its holes, (k, 2) each, degrees; a last point that repeats the first may be there or not."""


@dataclass(frozen=True, eq=False)
class Polygons:
    """Polygons on the sphere: what they cover, and their outlines without the seams at ±180° and the poles."""

    mesh: SphereMesh
    outlines: SphereLines

    @classmethod
    def of_lonlat(
        cls,
        polygons: Iterable[Rings],
        *,
        owners: npt.ArrayLike | None = None,
        latitude: Latitude = "spherical",
    ) -> Polygons:
        """Polygons whose sides are straight in longitude and latitude.

        Parameters
        ----------
        polygons : iterable of sequences of (k, 2) array_like
            Rings of each in degrees, the outer one first, in either direction. A ring that jumps by more than 180° of
            longitude goes on across ±180°; one that goes round a pole holds the pole that is nearer.
        owners : (n,) array_like of int, optional
            The region that each polygon belongs to; by default its own.
        latitude : {"spherical", "geodetic", "authalic"}

        Raises
        ------
        ValueError
            For a latitude outside [−90, 90], or a ring of fewer than three points.
        """
        cleaned = [_closed_rings(rings, number) for number, rings in enumerate(polygons)]
        owner = np.arange(len(cleaned)) if owners is None else np.asarray(owners, dtype=np.intp)
        corners, faces, belongs = [np.zeros((0, 2))], [np.zeros((0, 3), dtype=np.intp)], [owner[:0]]
        size = 0
        for rings, region in zip(cleaned, owner, strict=True):
            points = np.concatenate(rings)
            triangles = _ears(points, [len(ring) for ring in rings])
            corners.append(points)
            faces.append(triangles + size)
            belongs.append(np.full(len(triangles), region))
            size += len(points)
        mesh = SphereMesh(np.concatenate(corners), np.concatenate(faces), np.concatenate(belongs), latitude)
        lines = (line for rings in cleaned for ring in rings for line in _without_seams(ring))
        return cls(mesh, SphereLines.straight_in_lonlat(lines, latitude, shorter=False))


def _closed_rings(rings: Rings, number: int) -> list[FloatArray]:
    """Rings as arrays without a repeated last point, holes kept beside their outer ring in longitude."""
    arrays = [_unwrapped(as_lonlat(ring, f"polygons[{number}]").reshape(-1, 2)) for ring in rings]
    for ring in arrays:
        if len(ring) < 3:
            raise ValueError(f"polygons[{number}] has a ring of {len(ring)} different points; a ring needs three")
    middle = arrays[0][:, 0].mean() if arrays else 0.0
    return [ring + np.array([360.0 * np.round((middle - ring[:, 0].mean()) / 360.0), 0.0]) for ring in arrays]


def _unwrapped(ring: FloatArray) -> FloatArray:
    """A ring whose longitude goes on where it jumps across ±180°; closed over a pole where it goes round it."""
    if len(ring) > 1 and (ring[0] == ring[-1]).all():
        ring = ring[:-1]
    if len(ring) == 0:
        return ring
    following = np.roll(ring, -1, axis=0)
    step = following[:, 0] - ring[:, 0]
    # At a pole a step in longitude is none on the sphere: map files close their rings there.
    at_pole = (np.abs(ring[:, 1]) == 90) & (ring[:, 1] == following[:, 1])
    turns = np.where((np.abs(step) > 180) & (np.abs(step) < 360) & ~at_pole, -np.sign(step), 0.0)
    if not turns.any():
        return ring
    lon = ring[:, 0] + 360.0 * np.concatenate([[0.0], np.cumsum(turns)[:-1]])
    unwrapped = np.stack([lon, ring[:, 1]], axis=1)
    winding = turns.sum()
    if winding == 0:
        return unwrapped
    pole = np.copysign(90.0, ring[:, 1].mean())
    last = (ring[0, 0] + 360.0 * winding, ring[0, 1])
    return np.concatenate([unwrapped, [last, (last[0], pole), (ring[0, 0], pole)]])


def _ears(points: FloatArray, sizes: list[int]) -> npt.NDArray[np.intp]:
    """Triangles of a polygon in the plane, counterclockwise."""
    with of_extra("draw"):
        from mapbox_earcut import triangulate_float64

    found = triangulate_float64(np.ascontiguousarray(points), np.cumsum(sizes).astype(np.uint32))
    faces = found.reshape(-1, 3).astype(np.intp)
    a, b, c = (points[faces[:, i]] for i in range(3))
    clockwise = (b - a)[:, 0] * (c - a)[:, 1] < (b - a)[:, 1] * (c - a)[:, 0]
    faces[clockwise] = faces[clockwise][:, ::-1]
    return faces


def _without_seams(ring: FloatArray) -> list[FloatArray]:
    """The lines of a ring that are borders: not its sides along ±180° or at a pole."""
    closed = np.concatenate([ring, ring[:1]])
    start, end = closed[:-1], closed[1:]
    meridian = (np.abs(start[:, 0]) == 180) & (start[:, 0] == end[:, 0])
    pole = (np.abs(start[:, 1]) == 90) & (start[:, 1] == end[:, 1])
    # A ring that was closed over a pole goes there and back on one meridian.
    to_pole = (start[:, 0] == end[:, 0]) & ((np.abs(start[:, 1]) == 90) | (np.abs(end[:, 1]) == 90))
    seam = meridian | pole | to_pole
    if not seam.any():
        return [closed]
    first = int(np.flatnonzero(seam)[0]) + 1
    order = np.roll(np.arange(len(ring)), -first)
    runs = np.split(order, np.flatnonzero(np.diff(seam[order].astype(int))) + 1)
    return [np.concatenate([start[run], end[run[-1:]]]) for run in runs if not seam[run[0]]]
