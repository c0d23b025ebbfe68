"""GeoJSON as specified by RFC 7946."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import as_count
from stereodel._extras import optional
from stereodel.io.layers import Layer, Progress

HEAD: Final = '{"type":"FeatureCollection","features":['
TAIL: Final = "]}"


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
        Outer rings are counterclockwise, non-finite properties (NaN, infinity) are null, and there is no member
        ``crs``. Polygons of `to_geodataframe` are already cut at ±180°.

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
    rows = zip(*(_values(frame[name].to_numpy()) for name in names), strict=True) if names else iter([()] * len(frame))
    compact = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"), default=str).encode
    for row, text in zip(rows, shapely.to_geojson(geometry), strict=True):
        properties = compact(dict(zip(names, row, strict=True)))
        yield f'{{"type":"Feature","properties":{properties},"geometry":{text or "null"}}}'


def _values(column: npt.NDArray[Any]) -> list[Any]:
    """Values with None for NaN and infinity, which JSON lacks."""
    if column.dtype.kind == "f":
        return [value if np.isfinite(value) else None for value in column.tolist()]
    return [None if value is None or value != value else value for value in column.tolist()]
