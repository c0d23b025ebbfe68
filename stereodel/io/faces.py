"""Cells and triangles as cycles of sides, each side an arc that two faces share. Integers only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, IntArray
from stereodel.triangulation import PlanarVoronoi, SphericalVoronoi

Indices = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Faces:
    """Faces one after the other, the sides of each counterclockwise.

    Attributes
    ----------
    arcs : (k,) array of int
        Which arc a side is.
    reverse : (k,) array of bool
        Whether the side runs from the arc's end to its start.
    offsets : (f + 1,) array of int
        Face i has the sides from ``offsets[i]`` up to ``offsets[i + 1]``.
    """

    arcs: Indices
    reverse: BoolArray
    offsets: Indices

    @property
    def owner(self) -> Indices:
        """The face of each side, (k,)."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))

    def subset(self, chosen: Indices) -> Faces:
        """Some of the faces, in the order given."""
        lengths = np.diff(self.offsets)[chosen]
        offsets = np.concatenate([[0], np.cumsum(lengths)])
        sides = spans(self.offsets[chosen], lengths)
        return Faces(self.arcs[sides], self.reverse[sides], offsets)


def spans(starts: Indices, lengths: Indices) -> Indices:
    """The numbers start, start + 1, … of each of several stretches, one stretch after the other."""
    before = np.cumsum(lengths) - lengths
    numbers: Indices = np.arange(int(lengths.sum())) + np.repeat(starts - before, lengths)
    return numbers


def voronoi_faces(diagram: PlanarVoronoi | SphericalVoronoi) -> Faces:
    """The cells of all points with their ridges as arcs; a duplicate's has no sides.

    Within a cell a vertex is the start of one side, so that the sides follow in the order of the cell's vertices. The
    strips between points of one line have no vertices, and sides in no particular order.
    """
    pairs, ends = diagram.ridge_points.astype(np.intp), diagram.ridge_vertices.astype(np.intp)
    cell, count = pairs.T.ravel(), len(diagram.points)
    arcs, reverse = np.tile(np.arange(len(pairs)), 2), np.repeat([False, True], len(pairs))
    order = np.argsort(cell, kind="stable")
    if len(diagram.vertices):
        base = len(diagram.vertices) + 1
        corners = np.repeat(np.arange(count), np.diff(diagram.region_offsets)) * base + diagram.region_indices + 1
        order = np.empty_like(cell)
        order[np.argsort(corners)] = np.argsort(cell * base + ends.T.ravel() + 1)
    return Faces(arcs[order], reverse[order], np.concatenate([[0], np.cumsum(np.bincount(cell, minlength=count))]))


def triangle_faces(simplices: IntArray) -> tuple[Faces, Indices]:
    """Triangles (m, 3) with their edges as arcs, and the ends of the edges (e, 2), lower index first."""
    start, end = simplices.ravel().astype(np.intp), np.roll(simplices, -1, axis=1).ravel().astype(np.intp)
    keys = np.minimum(start, end) << 32 | np.maximum(start, end)
    edges, arcs = np.unique(keys, return_inverse=True)
    offsets = np.arange(0, len(start) + 1, 3)
    return Faces(arcs.ravel(), start > end, offsets), np.column_stack([edges >> 32, edges & 0xFFFFFFFF])
