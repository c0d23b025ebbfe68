"""Arcs of the sphere on the map of longitude and latitude: sampled for straight lines, as well-known binary."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Geometries, Indices, Packed
from stereodel.constants import AT_POLE
from stereodel.curves import clip
from stereodel.curves.borders import Antimeridian, Pieces
from stereodel.curves.fill import holders
from stereodel.curves.ragged import Ragged, spans
from stereodel.curves.trace import sides_of
from stereodel.io.formats import wkb
from stereodel.io.formats.map_rows import shapely, unpacked
from stereodel.predicates import orient2d
from stereodel.sphere.vectors import units

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


def close_in_longitude(samples: Ragged, step_rad: float) -> Ragged:
    """Points of arcs, with more inserted between those too far apart in longitude, as near a pole."""

    def rule(some: Ragged, _: Indices) -> tuple[Indices, FloatArray]:
        step = sides_of(some)[0]
        reach = np.hypot(some.values[:, 0], some.values[:, 1])
        # Projected onto the cylinder through the equator; a pole has no longitude.
        level = some.values / np.where(reach > AT_POLE, reach, 1.0)[:, None]
        p, q = level[step], level[step + 1]
        turn = np.abs(np.arctan2(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0], p[:, 0] * q[:, 0] + p[:, 1] * q[:, 1]))
        apart = (turn > step_rad) & (reach[step] > AT_POLE) & (reach[step + 1] > AT_POLE)
        # Halfway in longitude, in the plane of the chord and therefore on its great circle.
        return step[apart], units(p[apart] + q[apart])

    return refined(samples, rule)


def lines_on_map(
    sides: Ragged, owner: Indices, count: int, pieces: Pieces, samples: Ragged, border: Antimeridian
) -> Packed:
    """Lines (count,) of rows of edges: a MultiLineString for several rows, or if one crosses ±180° or a pole."""
    rows, line = clip.lines(sides, pieces, samples, border)
    # A line along ±180° is cut at each vertex, as at a border: join it where it continues.
    first = rows.offsets[1:-1]
    goes_on = (line[1:] == line[:-1]) & (rows.values[first] == rows.values[first - 1]).all(axis=1)
    begins = np.append(True, ~goes_on)[: len(rows)]
    rows = clip.without_repeats(Ragged(rows.values, np.append(rows.offsets[:-1][begins], rows.offsets[-1])))
    return wkb.grouped(wkb.lines(rows), owner[line[begins]], count)


def polygons_on_map(loops: Ragged, owner: Indices, count: int) -> tuple[Packed, BoolArray]:
    """Polygons and MultiPolygons (count,) of closed loops, and which loops run counterclockwise.

    Clockwise loops are holes; without a shell they are dropped.
    """
    if not len(loops):
        return np.full(count, None, dtype=object), np.zeros(0, dtype=bool)
    outer, holder = holders(loops, owner)
    parts = wkb.polygons(opened(loops))
    for shell in np.unique(holder[holder >= 0]).tolist():
        parts[shell] = wkb.with_holes(parts[shell], parts[holder == shell].tolist())
    return wkb.grouped(parts[outer], owner[outer], count), outer


def opened(loops: Ragged) -> Ragged:
    """Closed loops without their last points, which are their first."""
    first, sides = sides_of(loops)
    return Ragged(loops.values[first], sides.offsets)


def simple(rings: Ragged) -> BoolArray:
    """Which rings (n,) certainly run counterclockwise without touching themselves; nearly all faces do, see below.

    Either they go once around the mean of their corners, which lies left of all sides that have a length; or, as
    every convex face of the sphere does but for rounding, they enclose one piece of each meridian: one run of sides to
    the east lies below one to the west, and vertical sides are between these runs alone. Each corner is compared with
    the side across. Signs are exact.
    """
    start, after, row = rings.values, rings.following, rings.row
    step = start[after] - start
    middle = (np.add.reduceat(start, rings.offsets[:-1]) / rings.sizes[:, None])[row]
    around = np.bincount(row, (orient2d(middle, start, start[after]) <= 0) & step.any(axis=1)) == 0
    around &= np.bincount(row, (start[:, 1] < middle[:, 1]) & (start[after, 1] >= middle[:, 1])) == 1
    way = np.sign(step[:, 0])
    low, high = (f.reduceat(start[:, 0], rings.offsets[:-1])[row] for f in (np.minimum, np.maximum))
    good = np.bincount(row, (way == 0) & (np.where(start[:, 0] == high, 1, -1) * step[:, 1] <= 0)) == 0
    order = np.lexsort((start[:, 0], row))
    place = np.zeros(len(row), dtype=np.intp)  # from west to east, in one ring after the other
    place[order[1:]] = np.cumsum((np.diff(row[order]) > 0) | (np.diff(start[order, 0]) > 0))
    for side in (1, -1):
        good &= np.bincount(row, (way == side) & (way[after] != side)) == 1
        west = np.flatnonzero(way == side)
        west, east = (west, after[west])[::side]
        west, east = (ends[np.argsort(place[west], kind="stable")] for ends in (west, east))
        corner = np.flatnonzero((way == -side) & good[row] & (start[:, 0] > low) & (start[:, 0] < high))
        under = np.searchsorted(place[west], place[corner], side="right") - 1
        wrong = orient2d(start[west[under]], start[east[under]], start[corner]) != side
        good &= np.bincount(row[corner], wrong, minlength=len(good)) == 0
    return good | around


def invalid(polygons: Packed, loops: Ragged, owner: Indices) -> BoolArray:
    """Which polygons of closed loops are not valid; Shapely is asked only where the loops do not say so themselves."""
    unsure = np.zeros(len(polygons), dtype=bool)
    if len(loops):
        unsure[owner[~simple(opened(loops))]] = True
        west, east = (f.reduceat(loops.values[:, 0], loops.offsets[:-1]) for f in (np.minimum, np.maximum))
        order = np.lexsort((west, owner))
        one, next_one = order[:-1], order[1:]
        unsure[owner[one[(owner[one] == owner[next_one]) & (east[one] >= west[next_one])]]] = True
    unsure &= wkb.is_there(polygons)
    if unsure.any():
        unsure[unsure] = ~shapely.is_valid(unpacked(polygons[unsure]))
    return unsure


def repaired(geometries: Geometries, wrong: BoolArray) -> Geometries:
    """Valid polygons in place of those smaller than the spacing of doubles."""
    for place in np.flatnonzero(wrong).tolist():
        parts = shapely.get_parts(shapely.make_valid(geometries[place]))
        geometries[place] = shapely.union_all(parts[shapely.get_dimensions(parts) == 2])
    return geometries
