"""Cells of the plane as polygons, as far as they lie in a rectangle."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from stereodel._arrays import FloatArray, as_floats
from stereodel.constants import UNIT_ROUNDOFF
from stereodel.io.boxes import Box, close_along
from stereodel.io.faces import Indices, voronoi_faces
from stereodel.io.polygons import Geometries, assembled, repaired
from stereodel.io.rings import gathered
from stereodel.triangulation import PlanarVoronoi

MARGIN = 0.1
"""What is added on each side of the points where no extent is given, in terms of their longer side."""


def frame_of(points: FloatArray, extent: object) -> Box:
    """The rectangle (left, right, bottom, top), by default that of the points and a margin."""
    if extent is not None:
        left, right, bottom, top = as_floats(extent, "extent").tolist()  # type: ignore[arg-type]
        return Box(left, right, bottom, top)
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(2), np.zeros(2))
    margin = MARGIN * float((high - low).max()) or 1.0
    left, bottom = (low - margin).tolist()
    right, top = (high + margin).tolist()
    return Box(left, right, bottom, top)


def plane_cells(diagram: PlanarVoronoi, box: Box) -> Geometries:
    """A Polygon for each point, empty where its cell is outside; neighbours share points, as ridges are cut once."""
    index, offsets = diagram.region_indices, diagram.region_offsets
    cell = np.repeat(np.arange(len(diagram.points)), np.diff(offsets))
    corners = diagram.vertices[index] if len(diagram.vertices) else np.zeros((len(index), 2))
    cut = np.bincount(cell, (index < 0) | ~box.holds(corners), minlength=len(diagram.points)) > 0
    within = ~cut[cell]
    points, owners, rings = [corners[within]], [cell[within]], [cell[within]]
    for number, (owner, loop) in enumerate(_cut_cells(diagram, box, np.flatnonzero(cut)), len(diagram.points)):
        points.append(loop)
        owners.append(np.full(len(loop), owner))
        rings.append(np.full(len(loop), number))
    found = gathered(np.concatenate(points), np.concatenate(owners), np.concatenate(rings))
    return repaired(*assembled(found, len(diagram.points)))


def _cut_cells(diagram: PlanarVoronoi, box: Box, cells: Indices) -> Iterator[tuple[int, FloatArray]]:
    """The rings of cells that reach beyond the rectangle, and of one that fills it."""
    faces = voronoi_faces(diagram).subset(cells)
    pieces, ridge = _segments(diagram, box)
    place = np.full(len(diagram.ridge_points), -1)
    place[ridge] = np.arange(len(ridge))
    seen = place[faces.arcs]
    shown = seen >= 0
    sides = np.where(faces.reverse[shown, None, None], pieces[seen[shown]][:, ::-1], pieces[seen[shown]])
    bounds = np.concatenate([[0], np.cumsum(shown)])[faces.offsets].tolist()
    for owner, start, end in zip(cells.tolist(), bounds[:-1], bounds[1:], strict=True):
        chains = _chained(sides[start:end])
        yield from ((owner, loop) for loop in close_along(box, chains))
    if not len(ridge) and len(diagram.points):
        middle = box.corners().mean(axis=0)
        yield int(np.argmin(((diagram.points - middle) ** 2).sum(axis=1))), box.corners()


def _segments(diagram: PlanarVoronoi, box: Box) -> tuple[FloatArray, Indices]:
    """The ridges' parts in the rectangle, with ends that are vertices or lie on its border exactly.

    A vertex within rounding of the border is on it, for all its ridges alike; parts along the border are left out.
    """
    pieces, ridge = diagram.segments((box.left, box.right, box.bottom, box.top))
    ends = diagram.ridge_vertices[ridge]
    vertices = diagram.vertices[ends] if len(diagram.vertices) else np.full_like(pieces, np.nan)
    size = max(map(abs, (box.left, box.right, box.bottom, box.top)))
    at_vertex = (ends >= 0) & (np.abs(pieces - vertices).max(axis=-1) <= 8 * UNIT_ROUNDOFF * size)
    pieces[at_vertex] = box.clipped(vertices[at_vertex])
    pieces[~at_vertex] = box.nearest(pieces[~at_vertex])
    inward = ~box.same_side(pieces[:, 0], pieces[:, 1]) & (pieces[:, 0] != pieces[:, 1]).any(axis=1)
    return pieces[inward], ridge[inward]


def _chained(sides: FloatArray) -> list[FloatArray]:
    """Sides (k, 2, 2) in cyclic order as chains, broken where a side does not begin at the end of the one before."""
    breaks = np.flatnonzero((sides[:, 0] != np.roll(sides[:, 1], 1, axis=0)).any(axis=1))
    turned = np.roll(sides, -breaks[0], axis=0) if len(breaks) else sides
    parts = np.split(turned, (breaks - breaks[0])[1:]) if len(breaks) else [turned] * (len(turned) > 0)
    return [np.concatenate([part[:, 0], part[-1:, 1]]) for part in parts]
