"""Shapes: points, lines and rings in degrees, of GeoJSON, frames and geometries.

Frames and geometries are taken apart by Shapely, all at once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from stereodel._arrays import FloatArray, Geometries, Indices
from stereodel.curves.ragged import Ragged
from stereodel.io.formats.geojson import Features
from stereodel.io.formats.map_rows import POINT, POLYGON, shapely
from stereodel.io.table import degrees

Placed = list[tuple[int, FloatArray]]
"""Numbers of features or polygons, and positions of each."""


@dataclass(frozen=True, eq=False)
class Shapes:
    """All points, lines and polygons of a source, with the numbers of their features; degrees, longitude first.

    Rings are closed, with the first point repeated at the end, the outer one of each polygon before its holes;
    orientations are those of the source.
    """

    properties: Sequence[Mapping[str, Any]]
    points: FloatArray
    point_feature: Indices
    lines: Ragged
    line_feature: Indices
    rings: Ragged
    ring_polygon: Indices
    polygon_feature: Indices

    @property
    def polygons(self) -> list[list[FloatArray]]:
        """The rings of each polygon, the outer one first."""
        rings, first = list(self.rings), np.searchsorted(self.ring_polygon, np.arange(len(self.polygon_feature) + 1))
        return [rings[a:b] for a, b in pairwise(first.tolist())]

    def in_degrees(self, crs: str | None) -> Shapes:
        """The same of coordinates in another system; ValueError names the row of a place that has no degrees."""
        ring_feature = self.polygon_feature[self.ring_polygon]
        return replace(
            self,
            points=degrees(self.points, crs, self.point_feature + 1),
            lines=replace(self.lines, values=degrees(self.lines.values, crs, self.line_feature[self.lines.row] + 1)),
            rings=replace(self.rings, values=degrees(self.rings.values, crs, ring_feature[self.rings.row] + 1)),
        )

    def column(self, name: str) -> FloatArray:
        """A property of each feature as a number, NaN if lacking; ValueError if none has it, or for other values."""
        if not any(name in entry for entry in self.properties):
            known = sorted({str(key) for entry in self.properties for key in entry})
            raise ValueError(
                f"column {name!r} is not a property of the features; they have {', '.join(known) or 'none'}"
            )
        values = [entry.get(name) for entry in self.properties]
        try:
            return np.array([np.nan if value is None else float(value) for value in values])
        except (TypeError, ValueError):
            raise ValueError(
                f"column {name!r} holds something that is not a number; name a column of numbers"
            ) from None

    def words(self, name: str) -> list[str | None] | None:
        """A property of each feature as text, None for features that lack it; None if any value is not text."""
        values = [entry.get(name) for entry in self.properties]
        given = [value for value in values if value is not None]
        if not given or not all(isinstance(value, str) for value in given):
            return None
        return values


def of_items(items: list[Any]) -> Shapes:
    """Shapes of Shapely's geometries, or of other objects with `__geo_interface__`, one feature each."""
    if all(item is None or hasattr(item, "geom_type") for item in items):
        geometries = np.empty(len(items), dtype=object)
        geometries[:] = items
        return of_geometries(geometries)
    contents = [item if isinstance(item, Mapping) else getattr(item, "__geo_interface__", None) for item in items]
    for number, content in enumerate(contents):
        if not isinstance(content, Mapping):
            raise TypeError(f"source[{number}] must be a geometry or GeoJSON, got {type(items[number]).__name__}")
    return of_features(Features.of(*contents))


def of_features(features: Features) -> Shapes:
    """Shapes of what was read from GeoJSON."""
    points, lines, rings, polygons = Placed(), Placed(), Placed(), list[int]()
    for number, kind, part in features.parts():
        if kind.endswith("Polygon"):
            rings += [(len(polygons), ring) for ring in part]
            polygons.append(number)
        else:
            (points if kind.endswith("Point") else lines).append((number, part[0]))
    (of, at), (line_feature, along), (ring_polygon, around) = map(_unzipped, (points, lines, rings))
    polygon_feature = np.array(polygons, dtype=np.intp)
    point_feature = np.repeat(of, at.sizes)
    shapes = (at.values, point_feature, along, line_feature, around, ring_polygon, polygon_feature)
    return Shapes(features.properties, *shapes).in_degrees(features.crs)


def of_geometries(geometries: Geometries, properties: list[Mapping[str, Any]] | None = None) -> Shapes:
    """Shapes of Shapely's geometries, one feature each."""
    # A copy, as pandas gives arrays that are read-only, which Shapely takes since 2.2.
    parts, feature = np.array(geometries), np.arange(len(geometries))
    while (shapely.get_type_id(parts) > POLYGON).any():
        parts, inner = shapely.get_parts(parts, return_index=True)
        feature = feature[inner]
    there = ~(shapely.is_missing(parts) | shapely.is_empty(parts))
    parts, feature = parts[there], feature[there]
    kind = shapely.get_type_id(parts)
    point, line, polygon = kind == POINT, (kind != POINT) & (kind != POLYGON), kind == POLYGON
    rings, owner = shapely.get_rings(parts[polygon], return_index=True)
    rows = [
        Ragged.grouped(lonlat.reshape(-1, 2), row, len(of))
        for of in (parts[line], rings)
        for lonlat, row in [shapely.get_coordinates(of, return_index=True)]
    ]
    points = shapely.get_coordinates(parts[point]).reshape(-1, 2)
    named = properties or [{}] * len(geometries)
    found = Shapes(named, points, feature[point], rows[0], feature[line], rows[1], owner, feature[polygon])
    return found.in_degrees(None)


def _unzipped(rows: Placed) -> tuple[Indices, Ragged]:
    numbers, places = [number for number, _ in rows], [positions for _, positions in rows]
    return np.array(numbers, dtype=np.intp), Ragged.of(places, np.zeros((0, 2)))
