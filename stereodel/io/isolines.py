"""Contours as lines on the map."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from stereodel._arrays import Geometries
from stereodel.curves.ragged import Ragged
from stereodel.curves.trace import great
from stereodel.interpolation import Contour
from stereodel.io.diagrams import Columns
from stereodel.io.on_map import shapely
from stereodel.io.tiles import sphere_lines
from stereodel.sphere.latitudes import Latitude


def isolines(contours: Sequence[Contour], max_segment: float, latitude: Latitude | None) -> tuple[Columns, Geometries]:
    """A row for each contour: its level, whether it is closed, and its line, cut at ±180° on the sphere."""
    columns: Columns = {
        "level": np.array([contour.level for contour in contours], dtype=np.float64),
        "closed": np.array([contour.closed for contour in contours], dtype=np.bool_),
    }
    if not contours:
        return columns, np.zeros(0, dtype=object)
    points = Ragged.of([contour.points for contour in contours])
    if points.values.shape[1] == 2:
        return columns, np.asarray(shapely.linestrings(points.values, indices=points.row))
    ends = np.ones(len(points.values), dtype=np.bool_)
    ends[points.offsets[1:] - 1] = False
    first = np.flatnonzero(ends)
    arcs = great(points.values[first], points.values[first + 1])
    lines = Ragged(np.arange(len(first)), points.offsets - np.arange(len(points) + 1))
    kind = latitude or next((contour.latitude for contour in contours if contour.latitude), None) or "spherical"
    return columns, sphere_lines(arcs, max_segment, kind, lines)
