"""What users draw: GeoJSON, GeoDataFrames and shapes of shapely, as points, lines and polygons in degrees."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_lonlat
from stereodel._extras import optional

GEOJSON = (".geojson", ".json")

GEOGRAPHIC = "EPSG:4326"


@dataclass
class Shapes:
    """Everything in a source by kind, each with the number of the feature that it belongs to."""

    properties: list[Mapping[str, Any]] = field(default_factory=list)
    points: list[FloatArray] = field(default_factory=list)
    lines: list[FloatArray] = field(default_factory=list)
    polygons: list[list[FloatArray]] = field(default_factory=list)
    point_features: list[int] = field(default_factory=list)
    line_features: list[int] = field(default_factory=list)
    polygon_features: list[int] = field(default_factory=list)

    def column(self, name: str) -> npt.NDArray[np.float64]:
        """A property of each feature as a number, NaN where it has none; a ValueError where no feature has it."""
        if not any(name in entry for entry in self.properties):
            known = sorted({str(key) for entry in self.properties for key in entry})
            raise ValueError(f"column {name!r} is no property of the features; they have {', '.join(known) or 'none'}")
        try:
            return np.array([_number(entry.get(name)) for entry in self.properties])
        except (TypeError, ValueError):
            raise ValueError(f"column {name!r} holds something that is no number; give one of numbers") from None


def _number(value: Any) -> float:
    return float("nan") if value is None else float(value)


def shapes_of(source: Any) -> Shapes:
    """The shapes of a file, of a GeoJSON object, or of anything with `__geo_interface__`.

    Parameters
    ----------
    source : path-like, mapping, or object with __geo_interface__
        A GeoJSON file or object (RFC 7946); any other file that GeoPandas reads; a GeoDataFrame, a GeoSeries, a shape
        of shapely. What has another coordinate system is transformed to longitude and latitude.

    Raises
    ------
    OSError
        When a file cannot be read.
    ValueError
        For what is no GeoJSON, saying where.
    TypeError
        For any other object.
    """
    if isinstance(source, (str, os.PathLike)):
        return _of_file(Path(source))
    if isinstance(source, Mapping):
        return _of_geojson(source, "the GeoJSON object")
    crs = getattr(source, "crs", None)
    if crs is not None and crs != GEOGRAPHIC:
        source = source.to_crs(GEOGRAPHIC)
    interface = getattr(source, "__geo_interface__", None)
    if not isinstance(interface, Mapping):
        raise TypeError(
            f"source must be a file, a GeoJSON object, a GeoDataFrame or a shape, got {type(source).__name__}"
        )
    return _of_geojson(interface, type(source).__name__)


def _of_file(path: Path) -> Shapes:
    if path.suffix.lower() not in GEOJSON:
        frame = optional("geopandas", "geo").read_file(path)
        return shapes_of(frame)
    try:
        content = json.loads(path.read_bytes())
    except ValueError as error:
        raise ValueError(f"{path.name} is no JSON: {error}") from None
    return _of_geojson(content, path.name)


def _of_geojson(content: Any, name: str) -> Shapes:
    shapes = Shapes()
    for number, (properties, geometry) in enumerate(_features(content, name)):
        shapes.properties.append(properties)
        where = name if _kind(content) != "FeatureCollection" else f"{name}, feature {number}"
        _add(shapes, geometry, number, where)
    return shapes


def _kind(content: Any) -> Any:
    return content.get("type") if isinstance(content, Mapping) else None


def _features(content: Any, name: str) -> Iterator[tuple[Mapping[str, Any], Any]]:
    kind = _kind(content)
    if kind == "FeatureCollection":
        features = content.get("features")
        if not isinstance(features, (list, tuple)):
            raise ValueError(f"{name} is a FeatureCollection without a list of features")
        for number, feature in enumerate(features):
            if _kind(feature) != "Feature":
                raise ValueError(f"{name}, feature {number} has no type Feature; see RFC 7946")
            yield feature.get("properties") or {}, feature.get("geometry")
    elif kind == "Feature":
        yield content.get("properties") or {}, content.get("geometry")
    elif kind in DEPTH or kind == "GeometryCollection":
        yield {}, content
    else:
        raise ValueError(f"{name} is no GeoJSON: its type is {kind!r}, no feature and no geometry; see RFC 7946")


DEPTH = {"Point": 0, "MultiPoint": 1, "LineString": 1, "MultiLineString": 2, "Polygon": 2, "MultiPolygon": 3}
"""How deep the positions of a geometry are nested."""


def _add(shapes: Shapes, geometry: Any, number: int, where: str) -> None:
    """Sort a geometry, or all of a collection, into its kind; null geometries are none."""
    if geometry is None:
        return
    kind = _kind(geometry)
    if kind == "GeometryCollection":
        for part in geometry.get("geometries") or ():
            _add(shapes, part, number, where)
        return
    if kind not in DEPTH:
        raise ValueError(f"{where} has a geometry of type {kind!r}; known are {', '.join(DEPTH)}")
    coordinates = geometry.get("coordinates")
    if coordinates is None:
        raise ValueError(f"{where} has a {kind} without coordinates")
    if kind == "Point":
        coordinates = [coordinates] if len(coordinates) else []
    parts = coordinates if kind.startswith("Multi") and kind != "MultiPoint" else [coordinates]
    for part in parts:
        if kind.endswith("Point"):
            _append(shapes.points, shapes.point_features, [_positions(part, kind, where)], number)
        elif kind.endswith("LineString"):
            _append(shapes.lines, shapes.line_features, [_positions(part, kind, where)], number)
        elif len(part):
            rings = [_positions(ring, kind, where) for ring in part]
            _append(shapes.polygons, shapes.polygon_features, [rings], number)


def _append(kind: list[Any], features: list[int], parts: list[Any], number: int) -> None:
    kept = [part for part in parts if len(part)]
    kind += kept
    features += [number] * len(kept)


def _positions(positions: Any, kind: str, where: str) -> FloatArray:
    """Positions (n, 2) in degrees, without heights."""
    try:
        pairs = [(position[0], position[1]) for position in positions]
        array = np.array(pairs, dtype=np.float64).reshape(-1, 2)
    except (TypeError, ValueError, IndexError, KeyError):
        raise ValueError(f"{where} has a {kind} with something else than positions of two or three numbers") from None
    return as_lonlat(array, f"{where}: {kind}")
