"""Cells and triangles as rows of sides, each side an arc shared by two faces; connectivity only.

A side is the index of its arc, or ~index where it runs from the arc's end to its start, as in TopoJSON; the arc
of a side is ``np.maximum(side, ~side)``.
"""

from __future__ import annotations

import numpy as np

from stereodel._arrays import Indices, IntArray
from stereodel.curves.ragged import Ragged
from stereodel.triangulation import PlanarVoronoi, SphericalVoronoi


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
