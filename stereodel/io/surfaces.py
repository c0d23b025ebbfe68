"""Triangulations and diagrams as polygon meshes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from stereodel._arrays import FloatArray, Indices, IntArray, as_choice
from stereodel.curves.ragged import Ragged, spans
from stereodel.io.diagrams import Mesh, diagram_of, is_spherical, ridge_arcs, triangulation_of, usual_kind
from stereodel.io.faces import voronoi_sides
from stereodel.sphere.vectors import units
from stereodel.triangulation import SphericalVoronoi


@dataclass(frozen=True, eq=False)
class Surface:
    """Polygons of nodes, counterclockwise: triangles, or `cells`."""

    nodes: FloatArray  # (n, 2) of the plane, or (n, 3), unit vectors
    polygons: Ragged  # the nodes of each
    number: Indices  # (f,): index of each cell's point, or of each triangle
    cells: bool

    @property
    def table(self) -> IntArray:
        """The polygons as rows, (f, largest number of corners), padded with -1."""
        sizes = self.polygons.sizes
        rows = np.full((len(sizes), int(sizes.max(initial=3))), -1, dtype=np.int32)
        rows[self.polygons.row, spans(np.zeros_like(sizes), sizes)] = self.polygons.values
        return rows

    @property
    def edges(self) -> IntArray:
        """Edges as pairs of nodes, (e, 2), each once."""
        here = self.polygons.values
        sides = np.column_stack([here, here[self.polygons.following]])
        return np.unique(np.sort(sides, axis=1), axis=0).astype(np.int32)


def surface_of(mesh: Mesh, what: str | None) -> Surface:
    """Cells or triangles; unbounded cells of the plane and closing triangles of the sphere are left out."""
    kind = as_choice(what or usual_kind(mesh), ("cells", "triangles"), "what")
    return _cells(diagram_of(mesh)) if kind == "cells" else _triangles(mesh)


def _triangles(mesh: Mesh) -> Surface:
    triangulation, spherical = triangulation_of(mesh), is_spherical(mesh)
    number = np.flatnonzero(~triangulation.closing) if spherical else np.arange(len(triangulation.simplices))
    corners = triangulation.simplices[number].astype(np.intp).ravel()
    nodes = units(mesh.points) if spherical else mesh.points
    return Surface(nodes, Ragged(corners, 3 * np.arange(len(number) + 1)), number, cells=False)


def _cells(diagram: Any) -> Surface:
    if isinstance(diagram, SphericalVoronoi) and len(diagram.vertices) == 2:
        return _lunes(diagram)
    regions = Ragged(diagram.region_indices.astype(np.intp), diagram.region_offsets)
    unbounded = np.bincount(regions.row, regions.values < 0, minlength=len(regions)) > 0
    number = np.flatnonzero((regions.sizes > 0) & ~unbounded)
    return Surface(diagram.vertices, regions.take(number), number, cells=True)


def _lunes(diagram: SphericalVoronoi) -> Surface:
    """Cells between two antipodal vertices, with the midpoint of each ridge as an additional node."""
    sides, arcs = voronoi_sides(diagram), ridge_arcs(diagram)
    ridge = np.maximum(sides.values, ~sides.values)
    start = diagram.ridge_vertices[ridge, (sides.values < 0).astype(np.intp)].astype(np.intp)
    corners = Ragged(np.column_stack([start, 2 + ridge]).ravel(), 2 * sides.offsets)
    number = np.flatnonzero(sides.sizes)
    middles = arcs.points(np.arange(len(arcs)), arcs.stop / 2)
    return Surface(np.concatenate([diagram.vertices, middles]), corners.take(number), number, cells=True)
