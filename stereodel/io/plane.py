"""Cells of the plane as polygons, clipped to a rectangle."""

from __future__ import annotations

import numpy as np

from stereodel._arrays import FloatArray, Geometries, Indices
from stereodel.constants import UNIT_ROUNDOFF
from stereodel.curves import clip
from stereodel.curves.borders import Box, Pieces
from stereodel.curves.ragged import Ragged
from stereodel.curves.trace import Arcs
from stereodel.io.faces import voronoi_sides
from stereodel.io.on_map import polygons_on_map, repaired, shapely
from stereodel.triangulation import PlanarVoronoi


def plane_cells(diagram: PlanarVoronoi, box: Box) -> Geometries:
    """A Polygon for each point, empty where its cell is outside; neighbours share points, as ridges are cut once."""
    count = len(diagram.points)
    segments, ridge = _segments(diagram, box)
    # The ridges are already cut: only the endpoints of these arcs are used.
    none = np.zeros((len(ridge), 0))
    arcs = Arcs(segments[:, 0], segments[:, 1], none, none, none, none, none, ridge)
    low, high = [box.left, box.bottom], [box.right, box.top]
    opens, shuts = ((segments == low) | (segments == high)).any(axis=2).T
    pieces = Pieces(arcs, opens, shuts, np.ones(len(ridge), dtype=bool), np.zeros(len(ridge), dtype=bool))
    samples = Ragged(segments.reshape(-1, 2), 2 * np.arange(len(ridge) + 1))
    chains = clip.chains_of(voronoi_sides(diagram), pieces)
    points = clip.points_along(chains.pieces, samples)
    joined, owner = clip.closed_along(box, points.take(~chains.whole), chains.row[~chains.whole])
    loops, owner = clip.together(points.take(chains.whole), joined), np.append(chains.row[chains.whole], owner)
    if not len(ridge) and count:
        # One cell fills the rectangle: that of the site nearest to any place in it.
        middle = (box.corners[0] + box.corners[2]) / 2
        loops = Ragged.of([box.once()])
        owner = np.argmin(np.sum((diagram.points - middle) ** 2, axis=1), keepdims=True)
    there = loops.sizes > 3
    cells, _ = polygons_on_map(loops.take(there), owner[there], count)
    return repaired(cells, ~shapely.is_valid(cells))


def _segments(diagram: PlanarVoronoi, box: Box) -> tuple[FloatArray, Indices]:
    """The parts of ridges in the rectangle, in order, whose endpoints are vertices or lie exactly on its border.

    A vertex within rounding error of the border is placed on it for all its ridges; parts along the border are left
    out.
    """
    low, high = np.array([box.left, box.bottom]), np.array([box.right, box.top])
    pieces, ridge = diagram.segments((box.left, box.bottom, box.right, box.top))
    ends = diagram.ridge_vertices[ridge]
    vertices = diagram.vertices[ends] if len(diagram.vertices) else np.full_like(pieces, np.nan)
    size = max(map(abs, (box.left, box.right, box.bottom, box.top)))
    at_vertex = (ends >= 0) & (np.abs(pieces - vertices).max(axis=-1) <= 8 * UNIT_ROUNDOFF * size)
    pieces = np.clip(np.where(at_vertex[..., None], vertices, pieces), low, high)
    # Other endpoints move to the nearest side.
    gaps = np.concatenate([pieces - low, high - pieces], axis=-1)
    row, end = np.nonzero(~at_vertex)
    side = np.argmin(gaps[row, end], axis=-1)
    pieces[row, end, side % 2] = np.concatenate([low, high])[side]
    on_side = ((pieces[:, 0] == low) & (pieces[:, 1] == low)) | ((pieces[:, 0] == high) & (pieces[:, 1] == high))
    inward = ~on_side.any(axis=1) & (pieces[:, 0] != pieces[:, 1]).any(axis=1)
    return pieces[inward], ridge[inward]
