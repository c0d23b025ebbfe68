"""Voronoi cells of the plane within a convex polygon, as triangles."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import AnyIndices, BoolArray, FloatArray, SignArray, as_bounds, as_floats
from stereodel.curves.ragged import Ragged
from stereodel.triangulation import PlanarVoronoi


def as_polygon(bounds: npt.ArrayLike | None) -> FloatArray:
    """Corners (k, 2), counterclockwise, of (xmin, ymin, xmax, ymax) or of a convex polygon."""
    if bounds is None:
        raise ValueError("bounds are needed in the plane: (xmin, ymin, xmax, ymax), or the corners of a convex polygon")
    values = as_floats(bounds, "bounds")
    if values.shape == (4,):
        left, bottom, right, top = as_bounds(values)
        values = np.array([[left, bottom], [right, bottom], [right, top], [left, top]])
    if values.shape[1:] != (2,) or len(values) < 3:
        raise ValueError(f"bounds must be (xmin, ymin, xmax, ymax) or corners (k, 2), k >= 3, got shape {values.shape}")
    turns = _kernel.plane.turn(values, np.roll(values, -1, axis=0), np.roll(values, -2, axis=0))
    # Left turns alone could go around more than once: each corner must lie left of all sides too.
    if (turns <= 0).any() or any((sides < 0).any() for sides in _sides(values, values)):
        raise ValueError("bounds must be the corners of a convex polygon, counterclockwise")
    return values


def _sides(points: FloatArray, polygon: FloatArray) -> list[SignArray]:
    """For each side of the polygon the signs (n,) of the points, 1 inside."""
    starts, ends = (np.repeat(p[:, None], len(points), axis=1) for p in (polygon, np.roll(polygon, -1, axis=0)))
    return [_kernel.plane.turn(start, end, points) for start, end in zip(starts, ends, strict=True)]


def outside(points: FloatArray, polygon: FloatArray) -> BoolArray:
    """Which points lie outside the polygon, (n,)."""
    return np.asarray(np.any([sides < 0 for sides in _sides(points, polygon)], axis=0))


def check_inside(points: FloatArray, polygon: FloatArray) -> None:
    """Raise ValueError for points outside the polygon."""
    wrong = outside(points, polygon)
    if wrong.any():
        k = int(np.argmax(wrong))
        raise ValueError(f"points[{k}] is {points[k].tolist()}, outside bounds")


def flat_cells(points: FloatArray, polygon: FloatArray, workers: int | None) -> tuple[FloatArray, AnyIndices]:
    """Triangles (t, 3, 2) relative to their sites, counterclockwise, that make up the cells, and the sites (t,)."""
    # Four more sites bound every cell, so that all are fans of triangles around their sites.
    diagram = PlanarVoronoi(np.concatenate([points, _far_points(polygon)]), workers=workers)
    cells = Ragged(diagram.region_indices, diagram.region_offsets)
    # A triangle for each side of a cell: its site at the origin, then both ends of the side. The four have none.
    own = cells.row < len(points)
    corners = cells.values[own], cells.values[cells.following[own]]
    site: AnyIndices = cells.row[own]
    here, there = (diagram.vertices[vertex] - points[site] for vertex in corners)
    triangles = np.stack([np.zeros_like(here), here, there], axis=1)
    # Cells are convex and so is the polygon: cutting the triangles at one side after the other leaves what is in both.
    for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        triangles, site = _clipped(triangles, site, _heights(triangles, points[site], start, end))
    return triangles, site


def _far_points(polygon: FloatArray) -> FloatArray:
    """Four points so far around a polygon that they bound all cells without reaching into it.

    Within the polygon every site is at most 2r away, r the radius of a circle around it; these are at least 7r away.
    """
    low, high = polygon.min(axis=0), polygon.max(axis=0)
    middle, radius = low + (high - low) / 2, float(np.hypot(*(high - low))) / 2
    return middle + 8 * radius * np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])


def _heights(triangles: FloatArray, sites: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Heights (t, 3) of corners relative to sites (t, 2) above the line from start to end, times its length."""
    x, y = end - start
    inside = sites - start
    over, along = triangles[..., 1] + inside[:, None, 1], triangles[..., 0] + inside[:, None, 0]
    return x * over - y * along


def _clipped(triangles: FloatArray, site: AnyIndices, heights: FloatArray) -> tuple[FloatArray, AnyIndices]:
    """The parts of triangles with heights above zero: none, one or two triangles each."""
    # One corner inside leaves its tip, a and the two cuts; one corner d outside leaves a quadrangle, in two triangles.
    count = (heights > 0).sum(axis=1)
    (one,), (two,) = np.nonzero(count == 1), np.nonzero(count == 2)
    a, ab, ac, _, _ = _cut(triangles[one], heights[one], np.argmax(heights[one] > 0, axis=1))
    _, db, dc, b, c = _cut(triangles[two], heights[two], np.argmin(heights[two] > 0, axis=1))
    whole = count == 3
    corners = [triangles[whole]] + [np.stack(t, axis=1) for t in ((a, ab, ac), (db, b, c), (db, c, dc))]
    return np.concatenate(corners), np.concatenate([site[whole], site[one], site[two], site[two]])


def _cut(triangles: FloatArray, heights: FloatArray, alone: AnyIndices) -> list[FloatArray]:
    """Triangles (t, 3, 2) cut at height zero between one corner a and the others, b and c: a, ab, ac, b, c."""
    # Corners and heights in the same order, turned so that the lone one comes first: the orientation stays.
    turn = (alone[:, None] + np.arange(3)) % 3
    a, b, c = np.moveaxis(np.take_along_axis(triangles, turn[:, :, None], axis=1), 1, 0)
    at_a, at_b, at_c = np.take_along_axis(heights, turn, axis=1).T[:, :, None]
    # Heights of different sign, of which one may be zero: their difference is not.
    return [a, a + (b - a) * (at_a / (at_a - at_b)), a + (c - a) * (at_a / (at_a - at_c)), b, c]
