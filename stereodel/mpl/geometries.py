"""Shapely geometries, and the frames of GeoPandas that hold them, as matplotlib paths in degrees."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.path import Path

from stereodel._arrays import FloatArray, as_lonlat
from stereodel._extras import optional
from stereodel.curves.ragged import Ragged
from stereodel.mpl.transforms import compound

POINT, POLYGON = 0, 3
"""Types of geometries in Shapely's numbering."""


def paths_of(geometries: Any) -> tuple[list[Path], FloatArray]:
    """A path for each polygon and line, the rings of polygons closed; and all points, (n, 2).

    Parameters
    ----------
    geometries : geometry, sequence of geometries, GeoSeries, GeoDataFrame, or anything with ``__geo_interface__``
        In degrees; frames in another coordinate system are transformed.
    """
    shapely = optional("shapely", "geo")
    frame = getattr(geometries, "geometry", geometries)
    if getattr(frame, "crs", None) is not None:
        frame = frame.to_crs("EPSG:4326")
    elif hasattr(frame, "__geo_interface__") and not isinstance(frame, shapely.Geometry):
        frame = _shapes(frame.__geo_interface__)
    parts = shapely.get_parts(shapely.get_parts(np.atleast_1d(np.asarray(frame, dtype=object))))
    parts = parts[~shapely.is_empty(parts)]
    kinds = shapely.get_type_id(parts)
    points = as_lonlat(shapely.get_coordinates(parts[kinds == POINT]), "geometries")
    return [_path(shapely, part) for part in parts[kinds != POINT]], points


def _shapes(given: dict[str, Any]) -> list[Any]:
    """The geometries of a GeoJSON object."""
    shape = optional("shapely.geometry", "geo").shape
    return [shape(feature["geometry"]) for feature in given["features"]] if "features" in given else [shape(given)]


def _path(shapely: Any, part: Any) -> Path:
    lines = shapely.get_rings(part) if shapely.get_type_id(part) == POLYGON else np.array([part])
    coordinates, line = shapely.get_coordinates(lines, return_index=True)
    rows = Ragged.grouped(as_lonlat(coordinates, "geometries"), line, len(lines))
    return compound(rows, closed=lines[0] is not part)
