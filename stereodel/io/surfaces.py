"""Triangulations and diagrams as meshes: nodes and the polygons between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_choice
from stereodel.io.faces import Indices, spans, voronoi_faces
from stereodel.io.frames import Mesh, diagram_of, is_spherical, ridge_arcs, triangulation_of, usual_kind
from stereodel.sphere.vectors import units
from stereodel.triangulation import SphericalVoronoi


@dataclass(frozen=True, eq=False)
class Surface:
    """Polygons of nodes, counterclockwise.

    Attributes
    ----------
    nodes : (n, 2) or (n, 3) array
        Points of the plane, unit vectors of the sphere.
    corners : (k,) array of int
    offsets : (f + 1,) array of int
        Polygon i has the nodes ``corners[offsets[i]:offsets[i + 1]]``.
    number : (f,) array of int
        The point of each cell, the triangle of each triangle.
    cells : bool
        Whether the polygons are cells.
    """

    nodes: FloatArray
    corners: Indices
    offsets: Indices
    number: Indices
    cells: bool

    @property
    def table(self) -> npt.NDArray[np.int32]:
        """The polygons as rows, (f, largest number of corners), the rest of each row -1."""
        lengths = np.diff(self.offsets)
        rows = np.full((len(lengths), int(lengths.max(initial=3))), -1, dtype=np.int32)
        rows[np.repeat(np.arange(len(lengths)), lengths), spans(np.zeros_like(lengths), lengths)] = self.corners
        return rows

    @property
    def edges(self) -> npt.NDArray[np.int32]:
        """Pairs of nodes with a side between them, (e, 2), each once."""
        after = np.arange(1, len(self.corners) + 1)
        after[self.offsets[1:] - 1] = self.offsets[:-1]
        return np.unique(np.sort(np.column_stack([self.corners, self.corners[after]]), axis=1), axis=0).astype(np.int32)


def surface_of(mesh: Mesh, what: str | None) -> Surface:
    """Cells or triangles; unbounded cells of the plane and closing triangles of the sphere are left out."""
    kind = as_choice(what or usual_kind(mesh), ("cells", "triangles"), "what")
    return _cells(diagram_of(mesh)) if kind == "cells" else _triangles(mesh)


def _triangles(mesh: Mesh) -> Surface:
    triangulation, spherical = triangulation_of(mesh), is_spherical(mesh)
    number = np.flatnonzero(~triangulation.closing) if spherical else np.arange(len(triangulation.simplices))
    corners = triangulation.simplices[number].astype(np.intp).ravel()
    nodes = units(mesh.points) if spherical else mesh.points
    return Surface(nodes, corners, 3 * np.arange(len(number) + 1), number, cells=False)


def _cells(diagram: Any) -> Surface:
    if isinstance(diagram, SphericalVoronoi) and len(diagram.vertices) == 2:
        return _lunes(diagram)
    lengths = np.diff(diagram.region_offsets)
    cell = np.repeat(np.arange(len(lengths)), lengths)
    unbounded = np.bincount(cell, diagram.region_indices < 0, minlength=len(lengths)) > 0
    number = np.flatnonzero((lengths > 0) & ~unbounded)
    corners = diagram.region_indices[spans(diagram.region_offsets[number], lengths[number])].astype(np.intp)
    return Surface(diagram.vertices, corners, np.concatenate([[0], np.cumsum(lengths[number])]), number, cells=True)


def _lunes(diagram: SphericalVoronoi) -> Surface:
    """Cells between two opposite vertices, with the middle of each ridge as a further node."""
    faces, arcs = voronoi_faces(diagram), ridge_arcs(diagram)
    lengths = np.diff(faces.offsets)
    start = diagram.ridge_vertices[faces.arcs, faces.reverse.astype(np.intp)].astype(np.intp)
    corners = np.column_stack([start, 2 + faces.arcs]).ravel()
    number = np.flatnonzero(lengths)
    offsets = 2 * np.concatenate([[0], np.cumsum(lengths[number])])
    return Surface(np.concatenate([diagram.vertices, arcs.middles()]), corners, offsets, number, cells=True)
