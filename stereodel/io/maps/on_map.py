"""Arcs of the sphere on the map of longitude and latitude: sampled for straight lines, as Shapely geometries."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Geometries, Indices
from stereodel.constants import AT_POLE
from stereodel.curves import clip
from stereodel.curves.borders import Antimeridian, Pieces
from stereodel.curves.fill import holders
from stereodel.curves.ragged import Ragged, spans
from stereodel.io.formats.map_rows import shapely

Rule = Callable[[Ragged, Indices], tuple[Indices, FloatArray]]
"""Given some rows of points and their indices, returns after which points to insert new ones, and the new points."""


def refined(samples: Ragged, rule: Rule) -> Ragged:
    """Rows of points, refined until a rule inserts none; rows that received no points are not checked again."""
    rows = np.arange(len(samples))
    while True:
        some = samples.take(rows)
        places, points = rule(some, rows)
        if not len(places):
            return samples
        samples = samples.inserted(spans(samples.offsets[rows], some.sizes)[places] + 1, points)
        rows = rows[np.unique(some.row[places])]


def steps_of(samples: Ragged) -> Indices:
    """The points that are followed by another in their row."""
    inner = np.ones(len(samples.values), dtype=bool)
    inner[samples.offsets[1:] - 1] = False
    return np.flatnonzero(inner)


def close_in_longitude(samples: Ragged, step_rad: float) -> Ragged:
    """Points of arcs, with more inserted between those too far apart in longitude, as near a pole."""

    def rule(some: Ragged, _: Indices) -> tuple[Indices, FloatArray]:
        step = steps_of(some)
        reach = np.hypot(some.values[:, 0], some.values[:, 1])
        # Projected onto the cylinder through the equator; a pole has no longitude.
        level = some.values / np.where(reach > AT_POLE, reach, 1.0)[:, None]
        p, q = level[step], level[step + 1]
        turn = np.abs(np.arctan2(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0], p[:, 0] * q[:, 0] + p[:, 1] * q[:, 1]))
        apart = (turn > step_rad) & (reach[step] > AT_POLE) & (reach[step + 1] > AT_POLE)
        # Halfway in longitude, in the plane of the chord and therefore on its great circle.
        return step[apart], unit(p[apart] + q[apart])

    return refined(samples, rule)


def unit(vectors: FloatArray) -> FloatArray:
    """Non-zero vectors (n, 3) scaled to length 1."""
    return vectors / np.sqrt(np.sum(vectors**2, axis=1, keepdims=True))


def lines_on_map(
    sides: Ragged, owner: Indices, count: int, pieces: Pieces, samples: Ragged, border: Antimeridian
) -> Geometries:
    """Lines (count,) of rows of edges: a MultiLineString for several rows, or if one crosses ±180° or a pole."""
    rows, line = clip.lines(sides, pieces, samples, border)
    # A line along ±180° is cut at each vertex, as at a border: join it where it continues.
    first = rows.offsets[1:-1]
    goes_on = (line[1:] == line[:-1]) & (rows.values[first] == rows.values[first - 1]).all(axis=1)
    begins = np.append(True, ~goes_on)[: len(rows)]
    rows = clip.without_repeats(Ragged(rows.values, np.append(rows.offsets[:-1][begins], rows.offsets[-1])))
    parts = shapely.linestrings(rows.values, indices=rows.row) if len(rows) else np.zeros(0, dtype=object)
    return grouped(parts, owner[line[begins]], np.full(count, shapely.LineString()), shapely.multilinestrings)


def polygons_on_map(loops: Ragged, owner: Indices, count: int) -> tuple[Geometries, BoolArray]:
    """Polygons and MultiPolygons (count,) of closed loops, and which loops run counterclockwise.

    Clockwise loops are holes; without a shell they are dropped.
    """
    result = np.full(count, shapely.Polygon())
    if not len(loops):
        return result, np.zeros(0, dtype=bool)
    outlines = shapely.linearrings(loops.values, indices=loops.row)
    outer, holder = holders(loops, owner)
    parts = shapely.polygons(outlines)
    for shell in np.unique(holder[holder >= 0]):
        parts[shell] = shapely.polygons(outlines[shell], holes=outlines[holder == shell])
    return grouped(parts[outer], owner[outer], result, shapely.multipolygons), outer


def grouped(parts: Geometries, owner: Indices, empty: Geometries, collect: Any) -> Geometries:
    """One geometry for each owner: `collect` combines several parts, and `empty` is used where there are none."""
    counts, result = np.bincount(owner, minlength=len(empty)), empty.copy()
    alone = counts[owner] == 1
    result[owner[alone]] = parts[alone]
    several, number = np.unique(owner[~alone], return_inverse=True)
    if len(several):
        order = np.argsort(number, kind="stable")
        result[several] = collect(parts[~alone][order], indices=number[order])
    return result


def repaired(geometries: Geometries, wrong: BoolArray) -> Geometries:
    """Valid polygons in place of those smaller than the spacing of doubles."""
    for place in np.flatnonzero(wrong).tolist():
        parts = shapely.get_parts(shapely.make_valid(geometries[place]))
        geometries[place] = shapely.union_all(parts[shapely.get_dimensions(parts) == 2])
    return geometries
