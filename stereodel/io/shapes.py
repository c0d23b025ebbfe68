"""Shapes: points, lines and rings in degrees, of GeoJSON, frames and geometries.

GeoJSON is taken apart without any library; frames and geometries are by Shapely, all at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, pairwise
from numbers import Real
from typing import Any

import numpy as np

from stereodel._arrays import FloatArray, Geometries, Indices
from stereodel._extras import optional
from stereodel.curves.ragged import Ragged
from stereodel.io.geojson import KINDS, Features, kind_of, one
from stereodel.io.tables import degrees

POINT, LINE, RING, POLYGON, MULTIPOINT, MULTILINE, MULTIPOLYGON, COLLECTION = range(8)
"""Type codes of geometries in Shapely; those above POLYGON are multi-part."""

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
    found = []
    for number, item in enumerate(items):
        content = item if isinstance(item, Mapping) else getattr(item, "__geo_interface__", None)
        if not isinstance(content, Mapping):
            raise TypeError(f"source[{number}] must be a geometry or GeoJSON, got {type(item).__name__}")
        found.append(Features.of(content))
    rows = [row for each in found for row in zip(each.properties, each.geometries, strict=True)]
    crs = one({each.crs for each in found if each.geometries})
    return of_features(Features([row[0] for row in rows], [row[1] for row in rows], crs))


def of_features(features: Features) -> Shapes:
    """Shapes of what was read from GeoJSON."""
    points, lines, rings, polygons = Placed(), Placed(), Placed(), list[int]()
    for number, geometry in enumerate(features.geometries):
        where = f"row {number + 1}"
        for kind, part in _parts(geometry, where):
            if kind.endswith("Polygon"):
                rings += [(len(polygons), _closed(_positions(ring, kind, where), kind, where)) for ring in part]
                polygons.append(number)
            else:
                (points if kind.endswith("Point") else lines).append((number, _positions(part, kind, where)))
    (of, at), (line_feature, along), (ring_polygon, around) = map(_unzipped, (points, lines, rings))
    polygon_feature = np.array(polygons, dtype=np.intp)
    point_feature = np.repeat(of, at.sizes)
    shapes = (at.values, point_feature, along, line_feature, around, ring_polygon, polygon_feature)
    return Shapes(features.properties, *shapes).in_degrees(features.crs)


def of_geometries(geometries: Geometries, properties: list[Mapping[str, Any]] | None = None) -> Shapes:
    """Shapes of Shapely's geometries, one feature each."""
    shapely = optional("shapely", "geo")
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


def _parts(geometry: Any, where: str) -> Iterator[tuple[str, Any]]:
    """Kind and coordinates of the points, lines and polygons of a geometry; a null or empty one has none."""
    if geometry is None:
        return
    kind = kind_of(geometry)
    if kind == "GeometryCollection":
        for part in _listed(geometry.get("geometries") or (), kind, where):
            yield from _parts(part, where)
        return
    if kind not in KINDS:
        raise ValueError(f"{where}: has a geometry of type {kind!r}; known are {', '.join(KINDS)}")
    coordinates = geometry.get("coordinates")
    if coordinates is None:
        raise ValueError(f"{where}: has a {kind} without coordinates")
    coordinates = _listed(coordinates, kind, where)
    if kind == "Point":
        coordinates = [coordinates] if len(coordinates) else []
    for part in coordinates if kind in ("MultiLineString", "MultiPolygon") else [coordinates]:
        if len(_listed(part, kind, where)):
            yield kind, part


def _listed(value: Any, kind: str, where: str) -> Any:
    """The same, a sequence of any kind; ValueError for what has no order."""
    if hasattr(value, "__len__") and not isinstance(value, Mapping | str):
        return value
    inside = "geometries" if kind == "GeometryCollection" else "coordinates"
    raise ValueError(f"{where}: has a {kind} whose {inside} are {value!r:.40}, which is no list; see RFC 7946")


def _positions(positions: Any, kind: str, where: str) -> FloatArray:
    """Positions (n, 2), without heights; text is none."""
    try:
        pairs = [(position[0], position[1]) for position in positions]
        kinds = set(map(type, chain.from_iterable(pairs)))
        if all(issubclass(kind, Real) and not issubclass(kind, bool) for kind in kinds):
            return np.array(pairs, dtype=np.float64).reshape(-1, 2)
    except (TypeError, IndexError, KeyError, OverflowError):
        pass
    raise ValueError(f"{where}: has a {kind} whose positions are not two or three numbers each")


def _closed(ring: FloatArray, kind: str, where: str) -> FloatArray:
    """A ring closed by its first point, which is added if it is missing."""
    closed = ring if len(ring) > 1 and (ring[0] == ring[-1]).all() else np.concatenate([ring, ring[:1]])
    if len(closed) < 4:
        raise ValueError(f"{where}: has a {kind} with a ring of {max(0, len(closed) - 1)} points; a ring needs three")
    return closed
