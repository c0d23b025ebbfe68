"""Clipping polygons on the map to other polygons, such as land."""

from __future__ import annotations

from functools import cache
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray, Geometries, Indices, Packed
from stereodel.curves.ragged import Ragged
from stereodel.io.formats.map_rows import ROWS, packed, shapely, unpacked
from stereodel.io.formats.wkb import is_there
from stereodel.io.maps.on_map import repaired
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude

TILES: Final = (1.40625, 5.625, 22.5, 90.0)
"""Sides, in degrees, of the squares into which the mask is divided; each is a quarter of the next."""

CORNER: Final = np.array([-180.0, -90.0])
"""Corner of the map from which squares are counted."""

MARGIN: Final = 1 / 64
"""Overlap of a square with its neighbours, in units of its side: a clipped polygon ends before the square does."""


def clipped(binary: Packed, rings: Ragged, polygon: Indices, latitude: Latitude) -> tuple[Packed, FloatArray]:
    """Polygons clipped to others, given by rings, and the share of each area that remains; None if they lie outside.

    Lines are straight on the map, as in a GIS; those of the polygons follow great circles as closely as before.
    Crossings are rounded to doubles, separately for each of two neighbours.
    """
    mask, result, share = Mask(rings, polygon), binary.copy(), np.zeros(len(binary))
    for begin in range(0, len(binary), ROWS):
        rows = begin + np.flatnonzero(is_there(binary[begin : begin + ROWS]))
        whole = unpacked(binary[rows])
        cut = mask.cut(whole)
        result[rows] = packed(cut)
        changed = ~shapely.equals_identical(cut, whole)
        share[rows] = 1.0
        part, of = areas_on_sphere(cut[changed], latitude), areas_on_sphere(whole[changed], latitude)
        share[rows[changed]] = np.divide(part, of, out=np.zeros_like(part), where=of > 0)
    return result, share


class Mask:
    """The polygons to which others are clipped: in degrees, either cut at ±180° or continued beyond."""

    def __init__(self, rings: Ragged, polygon: Indices) -> None:
        if not len(rings):
            raise ValueError("clip has no polygons; give land, or polygons to cut with")
        polygons = shapely.polygons(shapely.linearrings(rings.values, indices=rings.row), indices=polygon)
        whole = shapely.union_all(repaired(polygons, ~shapely.is_valid(polygons)))
        world = shapely.box(-180.0, -90.0, 180.0, 90.0)
        if not shapely.covers(world, whole):
            west, _, east, _ = np.floor((shapely.bounds(whole) + 180.0) / 360.0).astype(int).tolist()
            around = (np.array([-360.0 * turns, 0.0]) for turns in range(west, east + 1))
            turned = [shapely.transform(whole, step.__add__) for step in around]
            whole = shapely.intersection(shapely.union_all(turned), world)
        self._tile = cache(self._made)
        self._whole = whole

    def _made(self, level: int, x: int, y: int) -> Any:
        """The part of the mask in a square, clipped from that in the next larger square."""
        if level == len(TILES):
            return self._whole
        side = TILES[level]
        west, south = np.array([x, y]) * side + CORNER
        reach = MARGIN * side
        square = shapely.box(west - reach, south - reach, west + side + reach, south + side + reach)
        return shapely.intersection(self._tile(level + 1, x // 4, y // 4), square)

    def cut(self, polygons: Geometries) -> Geometries:
        """Polygons clipped to the mask; empty if they lie outside."""
        shapely.prepare(self._whole)
        result = polygons.copy()
        touched = shapely.intersects(self._whole, polygons)
        result[~touched] = shapely.Polygon()
        waiting = np.flatnonzero(touched)
        waiting = waiting[~shapely.contains_properly(self._whole, polygons[waiting])]
        for level, side in enumerate(TILES):
            bounds = shapely.bounds(polygons[waiting])
            low, high = (np.floor((corner - CORNER) / side) for corner in (bounds[:, :2], bounds[:, 2:]))
            fits = (low == high).all(axis=1)
            tiles, number = np.unique(low[fits].astype(int), axis=0, return_inverse=True)
            for k, (x, y) in enumerate(tiles.tolist()):
                rows = waiting[fits][number.ravel() == k]
                result[rows] = areal(shapely.intersection(polygons[rows], self._tile(level, x, y)))
            waiting = waiting[~fits]
        result[waiting] = areal(shapely.intersection(polygons[waiting], self._whole))
        return result


def areal(geometries: Geometries) -> Geometries:
    """The polygons in results of overlays, counterclockwise; where borders touch, these also hold lines and points."""
    collections = shapely.get_type_id(geometries) == shapely.GeometryType.GEOMETRYCOLLECTION
    mixed = collections | (shapely.get_dimensions(geometries) < 2)
    return np.asarray(shapely.orient_polygons(repaired(geometries, mixed)), dtype=object)


def areas_on_sphere(polygons: Geometries, latitude: Latitude) -> FloatArray:
    """Areas on the unit sphere, in steradians, of polygons whose sides are straight in longitude and latitude.

    Along such a side the mean sine of the latitude is sin(m) sin(d)/d, where m is the latitude of the midpoint and d
    half the difference in latitude; the area between the side and the equator is that mean times the difference in
    longitude.
    """
    parts, polygon = shapely.get_parts(polygons, return_index=True)
    rings, part = shapely.get_rings(parts, return_index=True)
    lonlat, ring = shapely.get_coordinates(rings, return_index=True)
    if not len(lonlat):
        return np.zeros(len(polygons))
    x, y, z = lonlat_to_xyz(lonlat, latitude=latitude).T
    height, inner = np.arctan2(z, np.hypot(x, y)), ring[1:] == ring[:-1]
    middle, half = (height[1:] + height[:-1]) / 2, (height[1:] - height[:-1]) / 2
    below = np.sin(middle) * np.sinc(half / np.pi) * np.radians(np.diff(lonlat[:, 0]))
    return np.bincount(polygon[part[ring[1:][inner]]], -below[inner], minlength=len(polygons)).astype(np.float64)
