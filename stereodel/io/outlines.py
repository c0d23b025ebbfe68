"""Borders of polygons on the sphere: rings with the inside on their left, without the seams of the map."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from stereodel._arrays import BoolArray, FloatArray
from stereodel._extras import optional
from stereodel.io.faces import Indices, spans
from stereodel.io.polygons import Geometries


@dataclass(frozen=True, eq=False)
class Outlines:
    """Rings of several geometries: ring i is ``lonlat[offsets[i]:offsets[i + 1]]``, its last point its first.

    Attributes
    ----------
    lonlat : (n, 2) array
        Degrees; the region is on the left of its rings.
    offsets : (r + 1,) array of int
    owner : (r,) array of int
        The geometry of each ring, in order.
    everything : (g,) array of bool
        Geometries that have no border because they cover the whole sphere.
    """

    lonlat: FloatArray
    offsets: Indices
    owner: Indices
    everything: BoolArray

    def subset(self, chosen: Indices) -> Outlines:
        """Some of the geometries, in order."""
        rings = np.flatnonzero(np.isin(self.owner, chosen))
        sizes = np.diff(self.offsets)[rings]
        lonlat = self.lonlat[spans(self.offsets[rings], sizes)]
        offsets = np.concatenate([[0], np.cumsum(sizes)])
        return Outlines(lonlat, offsets, np.searchsorted(chosen, self.owner[rings]), self.everything[chosen])


def outlines_of(geometries: Geometries) -> Outlines:
    """The borders of Polygons and MultiPolygons of longitude and latitude."""
    shapely = optional("shapely", "geo")
    polygons, geometry = shapely.get_parts(geometries, return_index=True)
    rings, polygon = shapely.get_rings(polygons, return_index=True)
    outer = np.append(True, polygon[1:] != polygon[:-1])
    lonlat, ring = shapely.get_coordinates(rings, return_index=True)
    offsets = np.searchsorted(ring, np.arange(len(rings) + 1))
    backwards = shapely.is_ccw(rings) != outer
    place = np.arange(len(lonlat))
    mirrored = (offsets[:-1] + offsets[1:] - 1)[ring] - place
    lonlat = lonlat[np.where(backwards[ring], mirrored, place)]
    owner = geometry[polygon]
    on_border = (np.abs(lonlat[:, 0]) == 180.0) | (np.abs(lonlat[:, 1]) == 90.0)
    cut = np.unique(owner[ring[on_border]])
    if not len(cut):
        return Outlines(lonlat, offsets, owner, np.zeros(len(geometries), dtype=np.bool_))
    pieces = np.split(lonlat, offsets[1:-1])
    return _without_seams(pieces, owner, cut, len(geometries))


def _without_seams(pieces: list[FloatArray], owner: Indices, cut: Indices, count: int) -> Outlines:
    """Rings of which some geometries' run along the border of the map, where nothing ends on the sphere."""
    everything = np.zeros(count, dtype=np.bool_)
    touching = np.isin(owner, cut)
    whole = np.flatnonzero(~touching)
    rings, owners = [pieces[i] for i in whole], owner[whole].tolist()
    for number in cut.tolist():
        opened = opened_rings([pieces[i] for i in np.flatnonzero(owner == number)])
        everything[number] = not opened
        rings += opened
        owners += [number] * len(opened)
    order = np.argsort(owners, kind="stable")
    rings, owners = [rings[i] for i in order], [owners[i] for i in order]
    offsets = np.concatenate([[0], np.cumsum([len(ring) for ring in rings], dtype=np.intp)])
    points = np.concatenate([np.zeros((0, 2)), *rings])
    return Outlines(points, offsets.astype(np.intp), np.array(owners, dtype=np.intp), everything)


def opened_rings(rings: list[FloatArray]) -> list[FloatArray]:
    """Closed rings (k, 2) of one region without the edges that run along ±180° both ways, and along ±90°.

    What is left is joined anew: it begins and ends where a seam did.
    """
    heights = np.unique(np.concatenate([ring[np.abs(ring[:, 0]) == 180.0, 1] for ring in rings]))
    edges = [edge for ring in rings for edge in pairwise(map(tuple, _noded(ring, heights).tolist()))]
    places = [(_place(a), _place(b)) for a, b in edges]
    there = set(places)
    kept = [
        edge for edge, (a, b) in zip(edges, places, strict=True) if a != b and not (_seam(edge) and (b, a) in there)
    ]
    return _loops(kept)


def _noded(ring: FloatArray, heights: FloatArray) -> FloatArray:
    """A ring with points at all given latitudes on its edges along ±180°."""
    points = [ring[:1]]
    for a, b in pairwise(ring):
        if abs(a[0]) == 180.0 and a[0] == b[0]:
            low, high = sorted((a[1], b[1]))
            between = heights[(heights > low) & (heights < high)]
            ordered = between if a[1] < b[1] else between[::-1]
            points.append(np.stack([np.full(len(ordered), a[0]), ordered], axis=1))
        points.append(b[None])
    return np.concatenate(points)


Point = tuple[float, ...]


def _place(point: Point) -> Point:
    """The same for points of the map that are one on the sphere."""
    lon, lat = point
    if abs(lat) == 90.0:
        return (0.0, lat)
    return (-180.0 if lon == 180.0 else lon, lat)


def _seam(edge: tuple[Point, ...]) -> bool:
    return all(abs(lon) == 180.0 or abs(lat) == 90.0 for lon, lat in edge)


def _loops(edges: list[tuple[Point, Point]]) -> list[FloatArray]:
    """Closed rings of directed edges, of which as many begin at each place as end there."""
    following: dict[Point, list[tuple[Point, Point]]] = {}
    for edge in edges:
        following.setdefault(_place(edge[0]), []).append(edge)
    rings = []
    for first in edges:
        ring = []
        here = _place(first[0])
        while following.get(here):
            start, end = following[here].pop()
            # Both, as the same pole may have two longitudes; what is straight on the map hangs on them.
            ring += [start, end]
            here = _place(end)
        if ring:
            rings.append(np.array([*ring, ring[0]]))
    return rings
