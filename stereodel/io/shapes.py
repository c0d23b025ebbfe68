"""Reading shapes: GeoJSON, files, frames and geometries as points, lines and rings in degrees.

GeoJSON is read without any library; frames and geometries are taken apart by Shapely, all at once.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from stereodel._arrays import FloatArray, Geometries, Indices, as_lonlat
from stereodel._extras import optional
from stereodel.curves.ragged import Ragged
from stereodel.io.vector_files import read_frame

GEOGRAPHIC = "EPSG:4326"
GEOJSON = (".geojson", ".json")
PARQUET = (".parquet", ".geoparquet")
KINDS = ("Point", "MultiPoint", "LineString", "LinearRing", "MultiLineString", "Polygon", "MultiPolygon")
"""Types of geometries with coordinates; a LinearRing is a closed line of Shapely."""
POINT, LINE, RING, POLYGON, MULTIPOINT, MULTILINE, MULTIPOLYGON, COLLECTION = range(8)
"""Type codes of geometries in Shapely; those above POLYGON are multi-part."""


@dataclass(frozen=True, eq=False)
class Shapes:
    """All points, lines and polygons of a source, with their features; degrees, longitude first.

    Attributes
    ----------
    properties : sequence of mappings
        Properties of each feature.
    points : (n, 2) array
    point_feature : (n,) array of int
    lines : Ragged of (k, 2)
    line_feature : (m,) array of int
    rings : Ragged of (k, 2)
        Closed, with the first point repeated at the end. The outer ring of each polygon comes first, then its holes;
        orientations are those of the source.
    ring_polygon : (r,) array of int
        The polygon of each ring, in order.
    polygon_feature : (p,) array of int
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

    def column(self, name: str) -> FloatArray:
        """A property of each feature as a number, NaN if the feature lacks it.

        Raises
        ------
        ValueError
            If no feature has the property, or a value is not a number.
        """
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


def shapes_of(source: Any) -> Shapes:
    """The shapes of a file, of GeoJSON, of a frame, or of geometries.

    Parameters
    ----------
    source : path-like, mapping, GeoDataFrame, GeoSeries, geometry, or a sequence of geometries
        A GeoJSON file or object (RFC 7946); any other file that GeoPandas reads; anything with ``__geo_interface__``.
        Frames in another coordinate system are transformed to longitude and latitude; without one they are in degrees.

    Returns
    -------
    Shapes
        One feature for each row of a frame or geometry of a sequence. Null and empty geometries have no shapes.

    Raises
    ------
    OSError
        If a file cannot be read.
    ValueError
        If GeoJSON is invalid (the message says where), a latitude is outside [−90, 90], or a ring has fewer than three
        points.
    TypeError
        If `source` is of another type.
    ImportError
        For files other than GeoJSON, if GeoPandas is missing (``pip install stereodel[geo]``).

    Examples
    --------
    >>> square = {"type": "Polygon", "coordinates": [[[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]]}
    >>> shapes = shapes_of({"type": "Feature", "properties": {"people": 3}, "geometry": square})
    >>> len(shapes.rings), shapes.rings.values[1].tolist(), shapes.column("people").tolist()
    (1, [10.0, 0.0], [3.0])
    """
    if isinstance(source, str | os.PathLike):
        return _of_file(Path(source))
    if isinstance(source, Mapping):
        return _of_geojson(source, "the GeoJSON object")
    if hasattr(source, "to_crs"):
        degrees = source if source.crs is None else source.to_crs(GEOGRAPHIC)
        others = degrees.drop(columns=degrees.geometry.name).to_dict("records") if hasattr(degrees, "columns") else None
        return _of_geometries(np.asarray(degrees.geometry, dtype=object), others)
    if hasattr(source, "geom_type"):
        return _of_geometries(np.array([source], dtype=object))
    if isinstance(getattr(source, "__geo_interface__", None), Mapping):
        return _of_geojson(source.__geo_interface__, type(source).__name__)
    if isinstance(source, Iterable) and not isinstance(source, bytes):
        return _of_sequence(list(source))
    raise TypeError(f"source must be a file, GeoJSON, a GeoDataFrame or geometries, got {type(source).__name__}")


def _of_file(path: Path) -> Shapes:
    path.stat()  # the system's own message says best that there is none
    if path.suffix.lower() in PARQUET:
        return shapes_of(optional("geopandas", "geo").read_parquet(path))
    if path.suffix.lower() not in GEOJSON:
        frame = read_frame(path)
        if not hasattr(frame, "to_crs"):
            raise ValueError(f"{path.name} is a table without geometries")
        return shapes_of(frame)
    try:
        content = json.loads(path.read_bytes())
    except ValueError as error:
        raise ValueError(f"{path.name} is not JSON: {error}") from None
    return _of_geojson(content, path.name)


def _of_sequence(items: list[Any]) -> Shapes:
    """Shapely geometries, or other objects with `__geo_interface__`, one feature each."""
    if all(item is None or hasattr(item, "geom_type") for item in items):
        geometries = np.empty(len(items), dtype=object)
        geometries[:] = items
        return _of_geometries(geometries)
    found = _Found()
    for number, item in enumerate(items):
        content = item if isinstance(item, Mapping) else getattr(item, "__geo_interface__", None)
        if not isinstance(content, Mapping):
            raise TypeError(f"source[{number}] must be a geometry or GeoJSON, got {type(item).__name__}")
        for properties, geometry in _features(content, f"source[{number}]"):
            found.add(properties, geometry, f"source[{number}]")
    return found.shapes()


def _of_geometries(geometries: Geometries, properties: list[Mapping[str, Any]] | None = None) -> Shapes:
    """Shapely geometries, one feature each."""
    shapely = optional("shapely", "geo")
    parts, feature = geometries, np.arange(len(geometries))
    while (shapely.get_type_id(parts) > POLYGON).any():
        parts, inner = shapely.get_parts(parts, return_index=True)
        feature = feature[inner]
    there = ~(shapely.is_missing(parts) | shapely.is_empty(parts))
    parts, feature = parts[there], feature[there]
    kind = shapely.get_type_id(parts)
    point, line, polygon = kind == POINT, (kind != POINT) & (kind != POLYGON), kind == POLYGON
    rings, owner = shapely.get_rings(parts[polygon], return_index=True)
    rows = [
        Ragged.grouped(as_lonlat(lonlat.reshape(-1, 2), "source"), row, len(of))
        for of in (parts[line], rings)
        for lonlat, row in [shapely.get_coordinates(of, return_index=True)]
    ]
    points = as_lonlat(shapely.get_coordinates(parts[point]).reshape(-1, 2), "source")
    named = properties or [{}] * len(geometries)
    return Shapes(named, points, feature[point], rows[0], feature[line], rows[1], owner, feature[polygon])


@dataclass
class _Found:
    """Collects the shapes of GeoJSON feature by feature."""

    properties: list[Mapping[str, Any]] = field(default_factory=list)
    points: list[FloatArray] = field(default_factory=list)
    point_feature: list[int] = field(default_factory=list)
    lines: list[FloatArray] = field(default_factory=list)
    line_feature: list[int] = field(default_factory=list)
    rings: list[FloatArray] = field(default_factory=list)
    ring_polygon: list[int] = field(default_factory=list)
    polygon_feature: list[int] = field(default_factory=list)

    def shapes(self) -> Shapes:
        none = np.zeros((0, 2))
        features = (
            np.array(numbers, dtype=np.intp)
            for numbers in (self.point_feature, self.line_feature, self.ring_polygon, self.polygon_feature)
        )
        point, line, ring, polygon = features
        points, lines, rings = (
            np.concatenate([none, *self.points]),
            Ragged.of(self.lines, none),
            Ragged.of(self.rings, none),
        )
        return Shapes(self.properties, points, point, lines, line, rings, ring, polygon)

    def add(self, properties: Mapping[str, Any], geometry: Any, where: str) -> None:
        """Add a feature."""
        self.properties.append(properties)
        self._sort(geometry, where)

    def _sort(self, geometry: Any, where: str) -> None:
        """Sort a geometry, or the members of a collection, by type; null geometries are skipped."""
        if geometry is None:
            return
        kind = _kind(geometry)
        if kind == "GeometryCollection":
            for part in geometry.get("geometries") or ():
                self._sort(part, where)
            return
        if kind not in KINDS:
            raise ValueError(f"{where} has a geometry of type {kind!r}; known are {', '.join(KINDS)}")
        coordinates = geometry.get("coordinates")
        if coordinates is None:
            raise ValueError(f"{where} has a {kind} without coordinates")
        if kind == "Point":
            coordinates = [coordinates] if len(coordinates) else []
        parts = coordinates if kind in ("MultiLineString", "MultiPolygon") else [coordinates]
        for part in parts:
            if len(part):
                self._add_part(part, kind, where)

    def _add_part(self, part: Any, kind: str, where: str) -> None:
        number = len(self.properties) - 1
        if kind.endswith("Polygon"):
            self.rings += [_closed(_positions(ring, kind, where), kind, where) for ring in part]
            self.ring_polygon += [len(self.polygon_feature)] * len(part)
            self.polygon_feature.append(number)
            return
        positions = _positions(part, kind, where)
        if kind.endswith("Point"):
            self.points.append(positions)
            self.point_feature += [number] * len(positions)
        else:
            self.lines.append(positions)
            self.line_feature.append(number)


def _of_geojson(content: Any, name: str) -> Shapes:
    found = _Found()
    several = _kind(content) == "FeatureCollection"
    for number, (properties, geometry) in enumerate(_features(content, name)):
        found.add(properties, geometry, f"{name}, feature {number}" if several else name)
    return found.shapes()


def _kind(content: Any) -> Any:
    return content.get("type") if isinstance(content, Mapping) else None


def _features(content: Any, name: str) -> Iterator[tuple[Mapping[str, Any], Any]]:
    """Properties and geometry of each feature of a GeoJSON object."""
    kind = _kind(content)
    if kind == "FeatureCollection":
        features = content.get("features")
        if not isinstance(features, list | tuple):
            raise ValueError(f"{name} is a FeatureCollection without a list of features")
        for number, feature in enumerate(features):
            if _kind(feature) != "Feature":
                raise ValueError(f"{name}, feature {number} is not of type Feature; see RFC 7946")
            yield feature.get("properties") or {}, feature.get("geometry")
    elif kind == "Feature":
        yield content.get("properties") or {}, content.get("geometry")
    elif kind in KINDS or kind == "GeometryCollection":
        yield {}, content
    else:
        raise ValueError(f"{name} is not GeoJSON: its type is {kind!r}, neither feature nor geometry; see RFC 7946")


def _positions(positions: Any, kind: str, where: str) -> FloatArray:
    """Positions (n, 2) in degrees, without heights."""
    try:
        pairs = [(position[0], position[1]) for position in positions]
        array = np.array(pairs, dtype=np.float64).reshape(-1, 2)
    except (TypeError, ValueError, IndexError, KeyError):
        raise ValueError(f"{where} has a {kind} whose positions are not two or three numbers each") from None
    return as_lonlat(array, f"{where}: {kind}")


def _closed(ring: FloatArray, kind: str, where: str) -> FloatArray:
    """A ring closed by its first point, which is added if it is missing."""
    closed = ring if len(ring) > 1 and (ring[0] == ring[-1]).all() else np.concatenate([ring, ring[:1]])
    if len(closed) < 4:
        raise ValueError(f"{where} has a {kind} with a ring of {max(0, len(closed) - 1)} points; a ring needs three")
    return closed
