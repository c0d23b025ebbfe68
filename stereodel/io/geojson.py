"""GeoJSON as specified by RFC 7946."""

from __future__ import annotations

import json
import warnings
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import Column, as_count
from stereodel._extras import optional
from stereodel._tasks.progress import Progress
from stereodel.constants import EMPTY_RATIO, FEW_CELLS
from stereodel.io.cells import check_held, plain_cells
from stereodel.io.columns import DataWarning, beside, listed
from stereodel.io.layers import Layer
from stereodel.io.self_contained import check_crs
from stereodel.io.text import column, objects

HEAD: Final = '{"type":"FeatureCollection","features":['
TAIL: Final = "]}"

KINDS: Final = ("Point", "MultiPoint", "LineString", "LinearRing", "MultiLineString", "Polygon", "MultiPolygon")
"""Types of geometries with coordinates; a LinearRing is a closed line of Shapely."""


@dataclass(frozen=True, eq=False)
class Features:
    """Features that were read: properties and geometry of each, and the coordinate system, None for degrees."""

    properties: list[Mapping[str, Any]]
    geometries: list[Any]
    crs: str | None

    @classmethod
    def of(cls, content: Any) -> Features:
        """The features of a GeoJSON object: a collection, a feature or a geometry; ValueError names the row."""
        kind = kind_of(content)
        if kind in KINDS or kind == "GeometryCollection":
            rows: Any = [{"geometry": content}]
        elif kind == "Feature":
            rows = [content]
        elif isinstance(content, Mapping) and (kind == "FeatureCollection" or (kind is None and "features" in content)):
            rows = content.get("features")
        else:
            raise ValueError(f"this is not GeoJSON: its type is {kind!r}, neither feature nor geometry; see RFC 7946")
        if not isinstance(rows, list | tuple):
            raise ValueError("this is a FeatureCollection without a list of features")
        for row, feature in enumerate(rows, 1):
            known = isinstance(feature, Mapping) and feature.get("type", "Feature") == "Feature"
            if not known or not isinstance(feature.get("properties") or {}, Mapping):
                raise ValueError(f"row {row}: is not a GeoJSON Feature with properties by name; see RFC 7946")
        every = _crs_of(content)
        systems = {every if row.get("crs") is None else _crs_of(row) for row in rows} or {every}
        return cls([row.get("properties") or {} for row in rows], [row.get("geometry") for row in rows], one(systems))

    def columns(self) -> dict[str, Column]:
        """The properties as columns, None where a feature lacks one; see `read_points` for those that few have."""
        counts, rows = Counter(chain.from_iterable(self.properties)), len(self.properties)
        if rows * len(counts) <= max(FEW_CELLS, EMPTY_RATIO * counts.total()):
            return {name: column(each.get(name) for each in self.properties) for name in counts}
        common = {name: None for name, count in counts.items() if EMPTY_RATIO * count >= rows}
        others = [{name: each[name] for name in each if name not in common} or None for each in self.properties]
        result = {name: column(each.get(name) for each in self.properties) for name in common}
        added = beside(common, {"others": objects(others)})
        said = f"{len(counts) - len(common)} of {len(counts)} properties are together in the column {listed([*added])}"
        warnings.warn(f"{said}, as few features have any of them", DataWarning, stacklevel=2)
        return result | added


def one(systems: set[str | None]) -> str | None:
    """The only coordinate system of features."""
    if len(systems) > 1:
        names = ", ".join(sorted(name or "degrees" for name in systems))
        raise ValueError(f"there are several coordinate systems, {names}; give features of one")
    return systems.pop() if systems else None


def kind_of(content: Any) -> Any:
    """The member ``type`` of a GeoJSON object; None for what is none."""
    return content.get("type") if isinstance(content, Mapping) else None


def _crs_of(content: Mapping[str, Any]) -> str | None:
    """The coordinate system that an object names in the manner of GeoJSON before RFC 7946; None for degrees."""
    crs = content.get("crs")
    if crs is None:
        return None
    name = (crs.get("properties") or {}).get("name") if isinstance(crs, Mapping) else None
    if not isinstance(name, str):
        raise ValueError(f"the member crs of the file is {crs!r}, which names no coordinate system")
    check_crs(name)
    return None if name.upper().endswith(("CRS84", "EPSG::4326", "EPSG:4326")) else name


def to_geojson(frame: Any, *, decimals: int | None = None, sequence: bool = False) -> str:
    """A GeoDataFrame as the text of a GeoJSON FeatureCollection.

    Parameters
    ----------
    frame : geopandas.GeoDataFrame
        From `to_geodataframe` or elsewhere. Coordinates in a system other than EPSG:4326 are transformed; without a
        coordinate system they are written unchanged.
    decimals : int, optional
        Number of decimals to which coordinates are rounded; 7 correspond to a centimetre. By default as many as needed
        to read the same doubles back. Neighbours that share points still share them, but narrow polygons may become
        invalid.
    sequence : bool
        Write one feature per line, as programs for large data expect, instead of a FeatureCollection.

    Returns
    -------
    str
        Outer rings are counterclockwise, non-finite properties (NaN, infinity), also those in lists and mappings, are
        null, and there is no member ``crs``. Polygons of `to_geodataframe` are already cut at ±180°.

    Notes
    -----
    Source: H. Butler and others, "The GeoJSON Format", RFC 7946 (2016), sections 3.1.6, 3.1.9, 4 and 11.2.

    Examples
    --------
    >>> from stereodel import SphericalDelaunay
    >>> from stereodel.io import to_geodataframe
    >>> sites = to_geodataframe(SphericalDelaunay.from_lonlat([[10.0, 48.4]]), what="sites")
    >>> print(to_geojson(sites, decimals=3))
    {"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{"point":0},"geometry":{"type":"Point","coordinates":[10.0,48.4]}}
    ]}
    """
    found = list(features(frame, decimals))
    return "\n".join(found) if sequence else "\n".join([HEAD, ",\n".join(found), TAIL])


def write_geojson(
    layer: Layer, path: Path, *, decimals: int | None = None, sequence: bool = False, progress: Progress | None = None
) -> None:
    """Write the rows of a map in the format of `to_geojson`, block by block."""
    check_held(layer.columns, path.suffix[1:])
    between = "\n" if sequence else ",\n"
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write("" if sequence else HEAD)
        for number, block in enumerate(layer.blocks(progress)):
            file.write(between if number else "" if sequence else "\n")
            file.write(between.join(features(block.frame(), decimals)))
        file.write("\n" if sequence else f"\n{TAIL}\n")


def features(frame: Any, decimals: int | None) -> Iterator[str]:
    """The rows of a frame as GeoJSON features, one line each."""
    shapely = optional("shapely", "geo")
    if frame.crs is not None:
        frame = frame.to_crs("EPSG:4326")
    geometry = shapely.orient_polygons(np.asarray(frame.geometry))
    if decimals is not None:
        digits = as_count(decimals, "decimals", low=0)
        geometry = shapely.transform(geometry, lambda coordinates: np.round(coordinates, digits))
    names = [name for name in frame.columns if name != frame.geometry.name]
    rows = zip(*(plain_cells(frame[name]) for name in names), strict=True) if names else iter([()] * len(frame))
    compact = json.JSONEncoder(ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode
    for row, text in zip(rows, shapely.to_geojson(geometry), strict=True):
        properties = compact(dict(zip(names, row, strict=True)))
        yield f'{{"type":"Feature","properties":{properties},"geometry":{text or "null"}}}'
