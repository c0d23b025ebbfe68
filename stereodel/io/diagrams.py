"""Triangulations and diagrams as arguments: conversion into each other, ridges as arcs, columns of points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel.curves.trace import Arcs, great
from stereodel.triangulation import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi

Mesh = PlanarDelaunay | PlanarVoronoi | SphericalDelaunay | SphericalVoronoi
Columns = dict[str, npt.NDArray[Any]]


def usual_kind(mesh: Mesh) -> str:
    """What a mesh shows by default: cells of a diagram, triangles of a triangulation; TypeError for anything else."""
    if not isinstance(mesh, Mesh):
        raise TypeError(f"mesh must be a triangulation or a Voronoi diagram of stereodel, not {type(mesh).__name__}")
    return "cells" if isinstance(mesh, PlanarVoronoi | SphericalVoronoi) else "triangles"


def is_spherical(mesh: Mesh) -> bool:
    """Whether the mesh is on the sphere."""
    return isinstance(mesh, SphericalDelaunay | SphericalVoronoi)


def point_columns(columns: Mapping[str, npt.ArrayLike] | None, count: int) -> Columns:
    """The columns as arrays with a value for each of `count` points."""
    given = {name: np.asarray(values) for name, values in (columns or {}).items()}
    for name, values in given.items():
        if values.ndim < 1 or len(values) != count:
            raise ValueError(f"columns[{name!r}] has shape {values.shape}, but there are {count} points")
    return given


def diagram_of(mesh: Mesh) -> Any:
    """The Voronoi diagram of a triangulation, or the diagram itself."""
    if isinstance(mesh, PlanarDelaunay):
        return PlanarVoronoi(mesh)
    return SphericalVoronoi(mesh) if isinstance(mesh, SphericalDelaunay) else mesh


def triangulation_of(mesh: Mesh) -> Any:
    """The triangulation of a Voronoi diagram, or the triangulation itself."""
    return mesh.delaunay() if isinstance(mesh, PlanarVoronoi | SphericalVoronoi) else mesh


def ridge_arcs(diagram: SphericalVoronoi) -> Arcs:
    """The ridges as arcs; half great circles take their normals from the diagram."""
    if not len(diagram.ridge_vertices):
        return great(np.zeros((0, 3)), np.zeros((0, 3)))
    start, end = diagram.vertices[diagram.ridge_vertices].transpose(1, 0, 2)
    return great(start, end, diagram.ridge_normals())
