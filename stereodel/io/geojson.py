"""GeoJSON after RFC 7946."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import as_count
from stereodel._extras import optional


def to_geojson(frame: Any, *, decimals: int | None = None, sequence: bool = False) -> str:
    """A GeoDataFrame as the text of a GeoJSON FeatureCollection.

    Parameters
    ----------
    frame : geopandas.GeoDataFrame
        From `to_geodataframe` or elsewhere. In another coordinate system than EPSG:4326 it is transformed; without any
        coordinates are written as they stand.
    decimals : int, optional
        Digits after the point to which coordinates are rounded; 7 are a centimetre. By default all that are needed to
        read the same doubles back. Neighbours that share points still share them, but narrow polygons may become
        invalid.
    sequence : bool
        A feature a line and nothing else, as programs for large data read it, instead of a collection.

    Returns
    -------
    str
        Outer rings are counterclockwise, properties without a value (NaN, infinity) are null, and there is no member
        ``crs``. Polygons of `to_geodataframe` are cut at ±180° already.

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
    shapely = optional("shapely", "geo")
    if frame.crs is not None:
        frame = frame.to_crs("EPSG:4326")
    geometry = shapely.orient_polygons(np.asarray(frame.geometry))
    if decimals is not None:
        digits = as_count(decimals, "decimals", low=0)
        geometry = shapely.transform(geometry, lambda coordinates: np.round(coordinates, digits))
    names = [name for name in frame.columns if name != frame.geometry.name]
    rows = zip(*(_values(frame[name].to_numpy()) for name in names), strict=True) if names else iter([()] * len(frame))
    compact = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"), default=str).encode
    features = [
        f'{{"type":"Feature","properties":{compact(dict(zip(names, row, strict=True)))},"geometry":{text or "null"}}}'
        for row, text in zip(rows, shapely.to_geojson(geometry), strict=True)
    ]
    if sequence:
        return "\n".join(features)
    return '{"type":"FeatureCollection","features":[\n' + ",\n".join(features) + "\n]}"


def _values(column: npt.NDArray[Any]) -> list[Any]:
    """Values that JSON has: no NaN, no infinity."""
    if column.dtype.kind == "f":
        return [value if np.isfinite(value) else None for value in column.tolist()]
    return [None if value is None or value != value else value for value in column.tolist()]
