"""Triangulations and diagrams as arguments, and their cells and triangles as rows of sides; connectivity only.

A side is the index of an arc that two faces share, or ~index where it runs from the arc's end to its start, as in
TopoJSON; the arc of a side is ``np.maximum(side, ~side)``.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Indices, IntArray
from stereodel._spaces import SPHERE
from stereodel.curves.ragged import Ragged
from stereodel.curves.trace import Arcs, great
from stereodel.io.formats.map_rows import content_of, is_frame
from stereodel.sphere import xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation import PlanarVoronoi, SphericalVoronoi
from stereodel.triangulation.delaunay import Triangulation, state_of
from stereodel.triangulation.diagram import Diagram

Mesh = Triangulation | Diagram[Any]
MESHES = (Triangulation, Diagram)
"""The same, for `isinstance`."""
Columns = dict[str, npt.NDArray[Any]]


def usual_kind(mesh: Mesh) -> str:
    """What a mesh shows by default: cells of a diagram, triangles of a triangulation; TypeError for anything else."""
    if not isinstance(mesh, MESHES):
        raise TypeError(f"mesh must be a triangulation or a Voronoi diagram of stereodel, not {type(mesh).__name__}")
    return "cells" if isinstance(mesh, Diagram) else "triangles"


def point_columns(columns: Any, count: int) -> Columns:
    """The columns of a mapping or a frame as arrays with a value for each of `count` points."""
    named: Any = content_of(columns).columns() if is_frame(columns) else columns or {}
    given = {name: np.asarray(values) for name, values in named.items()}
    for name, values in given.items():
        if values.ndim < 1 or len(values) != count:
            raise ValueError(f"columns[{name!r}] has shape {values.shape}, but there are {count} points")
    return given


def places_of(mesh: Mesh, points: FloatArray, latitude: Latitude) -> FloatArray:
    """Points on the surface of a mesh as (n, 2): longitude and latitude, or as they are in the plane."""
    return xyz_to_lonlat(points, latitude=latitude) if mesh.surface is SPHERE else points


def diagram_of(mesh: Mesh) -> Any:
    """The Voronoi diagram of a triangulation, or the diagram itself."""
    return mesh if isinstance(mesh, Diagram) else mesh.surface.voronoi(mesh)


def triangulation_of(mesh: Mesh) -> Any:
    """The triangulation of a Voronoi diagram, or the triangulation itself."""
    return mesh.delaunay() if isinstance(mesh, Diagram) else mesh


def triangles_of(mesh: Mesh) -> tuple[Any, Indices]:
    """The triangulation, and its triangles but for those that close the far side of the sphere."""
    triangulation = triangulation_of(mesh)
    return triangulation, np.flatnonzero(state_of(triangulation).open)


def ridge_arcs(diagram: SphericalVoronoi) -> Arcs:
    """The ridges as arcs; half great circles take their normals from the diagram."""
    if not len(diagram.ridge_vertices):
        return great(np.zeros((0, 3)), np.zeros((0, 3)))
    start, end = diagram.vertices[diagram.ridge_vertices].transpose(1, 0, 2)
    return great(start, end, diagram.ridge_normals())


def voronoi_sides(diagram: PlanarVoronoi | SphericalVoronoi) -> Ragged:
    """The ridges around the cell of each point, counterclockwise; a duplicate's cell has none.

    In a cell each vertex is the start of one side, so the sides follow the order of the cell's vertices. The strips
    between collinear points have no vertices; their sides are in no particular order.
    """
    pairs, ends = diagram.ridge_points.astype(np.intp), diagram.ridge_vertices.astype(np.intp)
    cell, count = pairs.T.ravel(), len(diagram.points)
    ridge = np.arange(len(pairs))
    if not len(diagram.vertices):
        order = np.argsort(cell, kind="stable")
    else:
        # Sorted by (cell, corner), the corners of cells and the sides by starting corner are the same list.
        base = len(diagram.vertices) + 1
        corners = np.repeat(np.arange(count), np.diff(diagram.region_offsets)) * base + diagram.region_indices + 1
        order = np.empty_like(cell)
        order[np.argsort(corners)] = np.argsort(cell * base + ends.T.ravel() + 1)
    return Ragged.grouped(np.concatenate([ridge, ~ridge])[order], cell, count)


def triangle_sides(simplices: IntArray) -> tuple[Ragged, Indices]:
    """The sides of triangles (m, 3), and the endpoints of the edges (e, 2), lower index first."""
    start, end = simplices.ravel().astype(np.intp), np.roll(simplices, -1, axis=1).ravel().astype(np.intp)
    keys = np.minimum(start, end) << 32 | np.maximum(start, end)
    edges, number = np.unique(keys, return_inverse=True)
    sides = np.where(start > end, ~number.ravel(), number.ravel())
    return Ragged(sides, np.arange(0, len(start) + 1, 3)), np.column_stack([edges >> 32, edges & 0xFFFFFFFF])
