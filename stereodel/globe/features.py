"""Lines and regions of the Earth and of diagrams, prepared once for all globes."""

from __future__ import annotations

from functools import cache

import numpy as np

from stereodel import data
from stereodel.curves.ragged import Ragged
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


@cache
def sea(resolution: str, latitude: Latitude) -> SphereRegions:
    """The rest of the Earth."""
    return land(resolution, latitude).complement


def edges(triangulation: SphericalDelaunay) -> SphereLines:
    """The edges of a triangulation."""
    points = units(triangulation.points)
    pairs = triangulation.edges
    return SphereLines.great(points[pairs[:, 0]], points[pairs[:, 1]])


def ridges(voronoi: SphericalVoronoi) -> SphereLines:
    """The ridges of a diagram, some of which may be half great circles."""
    start, end = (voronoi.vertices[voronoi.ridge_vertices[:, k]] for k in (0, 1))
    return SphereLines.great(start, end, voronoi.ridge_normals())


def _lines(lines: data.EarthLines, latitude: Latitude) -> SphereLines:
    return SphereLines.of_lonlat(Ragged(lines.lonlat, lines.offsets.astype(np.intp)), latitude)
