"""What globes draw, from the Earth and from diagrams: lines and meshes made ready once."""

from __future__ import annotations

from functools import cache

import numpy as np
import numpy.typing as npt

from stereodel import data
from stereodel._arrays import FloatArray, as_floats
from stereodel.drawing.scales import ColorScale
from stereodel.globe.lines import SphereLines
from stereodel.globe.polygons import Polygons
from stereodel.globe.regions import SphereMesh
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import units
from stereodel.triangulation import SphericalDelaunay, SphericalVoronoi

Indices = npt.NDArray[np.intp]


@cache
def coastlines(resolution: str, latitude: Latitude) -> SphereLines:
    """The coastlines of the Earth."""
    lines = data.coastlines(resolution=resolution)
    return SphereLines.of_lonlat(lines.lonlat, lines.offsets, latitude)


@cache
def borders(resolution: str, latitude: Latitude) -> SphereLines:
    """The borders between countries."""
    lines = data.borders(resolution=resolution)
    return SphereLines.of_lonlat(lines.lonlat, lines.offsets, latitude)


@cache
def rivers(resolution: str, latitude: Latitude) -> SphereLines:
    """The rivers of the Earth."""
    lines = data.rivers(resolution=resolution)
    return SphereLines.of_lonlat(lines.lonlat, lines.offsets, latitude)


@cache
def lakes(resolution: str, latitude: Latitude) -> Polygons:
    """The lakes of the Earth."""
    return Polygons.of_lonlat(data.lakes(resolution=resolution).polygons(), latitude=latitude)


@cache
def land(resolution: str, latitude: Latitude) -> Polygons:
    """The land of the Earth."""
    return Polygons.of_lonlat(data.land(resolution=resolution).polygons(), latitude=latitude)


def edges(triangulation: SphericalDelaunay) -> SphereLines:
    """The edges of a triangulation."""
    points = units(triangulation.points)
    pairs = triangulation.edges
    return SphereLines.great(points[pairs[:, 0]], points[pairs[:, 1]])


def ridges(voronoi: SphericalVoronoi) -> SphereLines:
    """The ridges of a diagram, each by its ends and its middle, as some are half great circles."""
    start, end = (voronoi.vertices[voronoi.ridge_vertices[:, k]] for k in (0, 1))
    middle = _middles(start, end, voronoi.ridge_normals())
    points = np.stack([start, middle, end], axis=1).reshape(-1, 3)
    return SphereLines(points, np.arange(0, len(points) + 1, 3))


def _middles(start: FloatArray, end: FloatArray, normals: FloatArray) -> FloatArray:
    """The points half the way from start to end, counterclockwise about the normals, at most 180° apart."""
    across = np.sqrt(np.sum(np.cross(start, end) ** 2, axis=1, keepdims=True))
    half = np.arctan2(across, np.sum(start * end, axis=1, keepdims=True)) / 2
    return units(np.cos(half) * start + np.sin(half) * np.cross(normals, start))


def cells_mesh(voronoi: SphericalVoronoi) -> SphereMesh:
    """The cells of a diagram as triangles of the site and each side; owners are the sites."""
    sizes = np.diff(voronoi.region_offsets)
    if (sizes == 2).any() or (len(sizes) and len(voronoi.region_indices) == 0):
        raise ValueError("a cell has fewer than three vertices, as where all sites are on one circle; draw its ridges")
    owner = np.repeat(np.arange(len(sizes)), sizes)
    following = np.arange(1, len(voronoi.region_indices) + 1)
    following[voronoi.region_offsets[1:][sizes > 0] - 1] = voronoi.region_offsets[:-1][sizes > 0]
    vertices = voronoi.region_indices.astype(np.intp) + len(sizes)
    faces = np.stack([owner, vertices, vertices[following]], axis=1)
    return SphereMesh(np.concatenate([units(voronoi.points), voronoi.vertices]), faces, owner)


def triangles_mesh(triangulation: SphericalDelaunay) -> SphereMesh:
    """The triangles of a triangulation but the closing ones; owners are the simplices."""
    kept = np.flatnonzero(~triangulation.closing)
    return SphereMesh(units(triangulation.points), triangulation.simplices[kept].astype(np.intp), kept)


def as_tints(colors: npt.ArrayLike, count: int) -> FloatArray:
    """Colours (n, 4) of n things from (n, 3) or (n, 4), in [0, 1]."""
    array = as_floats(colors, "colors")
    if array.shape not in ((count, 3), (count, 4)):
        raise ValueError(f"colors must have shape ({count}, 3) or ({count}, 4), got {array.shape}")
    if ((array < 0) | (array > 1)).any():
        raise ValueError("colors must be in [0, 1]; divide numbers of 0 to 255 by 255")
    return np.concatenate([array, np.ones((count, 4 - array.shape[-1]))], axis=1)


def scaled_colors(values: FloatArray, scale: ColorScale | None) -> FloatArray:
    """Colours (n, 3) of numbers; by default viridis over their range."""
    if len(values) == 0:
        return np.zeros((0, 3))
    low, high = float(values.min()), float(values.max())
    found = ColorScale("viridis", low, high if high > low else low + 1.0) if scale is None else scale
    return found(values)
