"""What globes draw, from the Earth and from diagrams: lines and regions made ready once."""

from __future__ import annotations

from functools import cache
from typing import cast

import numpy as np
import numpy.typing as npt

from stereodel import data
from stereodel._arrays import FloatArray, as_floats
from stereodel.curves.ragged import Ragged
from stereodel.data.shapes import Lines
from stereodel.drawing.colors import ColorLike, as_color
from stereodel.drawing.scales import ColorScale
from stereodel.globe.lines import SphereLines
from stereodel.globe.regions import SphereRegions
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import units
from stereodel.triangulation import SphericalDelaunay, SphericalVoronoi


@cache
def coastlines(resolution: str, latitude: Latitude) -> SphereLines:
    """The coastlines of the Earth."""
    return _lines(data.coastlines(resolution=resolution), latitude)


@cache
def borders(resolution: str, latitude: Latitude) -> SphereLines:
    """The borders between countries."""
    return _lines(data.borders(resolution=resolution), latitude)


@cache
def rivers(resolution: str, latitude: Latitude) -> SphereLines:
    """The rivers of the Earth."""
    return _lines(data.rivers(resolution=resolution), latitude)


@cache
def lakes(resolution: str, latitude: Latitude) -> SphereRegions:
    """The lakes of the Earth."""
    return SphereRegions.of_lonlat(data.lakes(resolution=resolution).polygons(), latitude=latitude)


@cache
def land(resolution: str, latitude: Latitude) -> SphereRegions:
    """The land of the Earth."""
    return SphereRegions.of_lonlat(data.land(resolution=resolution).polygons(), latitude=latitude)


def edges(triangulation: SphericalDelaunay) -> SphereLines:
    """The edges of a triangulation."""
    points = units(triangulation.points)
    pairs = triangulation.edges
    return SphereLines.great(points[pairs[:, 0]], points[pairs[:, 1]])


def ridges(voronoi: SphericalVoronoi) -> SphereLines:
    """The ridges of a diagram, of which some are half great circles."""
    start, end = (voronoi.vertices[voronoi.ridge_vertices[:, k]] for k in (0, 1))
    return SphereLines.great(start, end, voronoi.ridge_normals())


def _lines(lines: Lines, latitude: Latitude) -> SphereLines:
    return SphereLines.of_lonlat(Ragged(lines.lonlat, lines.offsets.astype(np.intp)), latitude)


def as_tints(colors: ColorLike | npt.ArrayLike, count: int, name: str = "colors") -> FloatArray:
    """Colours (n, 4) of n things from one for all or from (n, 3) or (n, 4), in [0, 1]."""
    if isinstance(colors, str) or np.ndim(np.asarray(colors, dtype=object)) < 2:
        return np.tile(as_color(cast(ColorLike, colors), name), (count, 1))
    array = as_floats(cast(npt.ArrayLike, colors), name)
    if array.shape not in ((count, 3), (count, 4)):
        raise ValueError(f"{name} must have shape ({count}, 3) or ({count}, 4), got {array.shape}")
    if ((array < 0) | (array > 1)).any():
        raise ValueError(f"{name} must be in [0, 1]; divide numbers of 0 to 255 by 255")
    return np.concatenate([array, np.ones((count, 4 - array.shape[-1]))], axis=1)


def scaled_colors(values: FloatArray, scale: ColorScale | None) -> FloatArray:
    """Colours (n, 3) of numbers; by default viridis over their range."""
    if len(values) == 0:
        return np.zeros((0, 3))
    low, high = float(values.min()), float(values.max())
    found = ColorScale("viridis", low, high if high > low else low + 1.0) if scale is None else scale
    return found(values)
