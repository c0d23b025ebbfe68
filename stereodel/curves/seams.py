"""Rings of map files without their seams.

GeoJSON and shapefiles cut polygons at ±180° and close them along ±90° around the poles. On the sphere there is no
border there: a part of the meridian that one ring follows upward on one side of the map and another downward on the
other side is a seam, and an edge along a pole is a point. Both are removed and the rings joined again. A part with a
region on one side only is kept: it is a real border that happens to lie on the meridian.
"""

from __future__ import annotations

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices
from stereodel.curves.ragged import Ragged, cycles, spans
from stereodel.curves.trace import sides_of


def stitched(rings: Ragged, owner: Indices, seam: float = 180.0) -> tuple[FloatArray, FloatArray, Ragged, Indices]:
    """Edges and rings, without seams, of closed rings (k, 2) in degrees with their regions on the left.

    seam: the meridian where the map is cut, in degrees.
    Returns starts and ends of edges (e, 2), in degrees, where the end of one and the start of the next may be one point
    with two longitudes; the indices of the edges of each ring; and the region of each ring.
    """
    first, sides = sides_of(rings)
    start, end = rings.values[first], rings.values[first + 1]
    border = _on_meridian(rings.values, seam) | (np.abs(rings.values[:, 1]) == 90)
    if not border.any():
        return start, end, sides, owner
    # Rings that touch no seam are unchanged.
    touched = np.zeros(len(rings), dtype=bool)
    touched[rings.row[border]] = True
    opened, whole = sides.take(touched).values, sides.take(~touched)
    a, b, belongs = _without_seams(start[opened], end[opened], owner[sides.row[opened]], seam)
    loops = cycles(_followers(a, b, belongs))
    return (
        np.concatenate([start[whole.values], a]),
        np.concatenate([end[whole.values], b]),
        Ragged(
            np.concatenate([np.arange(len(whole.values)), loops.values + len(whole.values)]),
            np.concatenate([whole.offsets, whole.offsets[-1] + loops.offsets[1:]]),
        ),
        np.concatenate([owner[~touched], belongs[loops.values[loops.offsets[:-1]]]]),
    )


def _on_meridian(places: FloatArray, seam: float) -> BoolArray:
    return np.mod(places[:, 0], 360) == seam % 360


def _without_seams(
    a: FloatArray, b: FloatArray, owner: Indices, meridian: float
) -> tuple[FloatArray, FloatArray, Indices]:
    """Edges without those along a pole and those along the seam that occur in both directions."""
    pole = (np.abs(a[:, 1]) == 90) & (a[:, 1] == b[:, 1])
    along = _on_meridian(a, meridian) & (a[:, 0] == b[:, 0]) & ~pole
    # Edges along the meridian are split wherever another one begins, on either side of the map.
    seam = np.flatnonzero(along)
    heights = np.unique(np.concatenate([p[_on_meridian(p, meridian), 1] for p in (a, b)]))
    low, high = np.minimum(a[seam, 1], b[seam, 1]), np.maximum(a[seam, 1], b[seam, 1])
    lowest = np.searchsorted(heights, low)
    steps = np.searchsorted(heights, high) - lowest
    row, step = np.repeat(np.arange(len(seam)), steps), spans(lowest, steps)
    up = np.where(b[seam, 1] > a[seam, 1], 1, -1)[row]
    # Up and down cancel; the rest runs one way, as often as the sum says.
    keys, where = np.unique(np.stack([owner[seam][row], step], axis=1), axis=0, return_inverse=True)
    excess = np.bincount(where.ravel(), up, minlength=len(keys)).astype(np.intp)
    left = np.repeat(np.arange(len(keys)), np.abs(excess))
    ends = np.stack([heights[keys[left, 1]], heights[keys[left, 1] + 1]], axis=1)
    ends = np.where((excess[left] > 0)[:, None], ends, ends[:, ::-1])
    real = ~(pole | along)
    added = [np.stack([np.full(len(left), meridian), ends[:, k]], axis=1) for k in (0, 1)]
    return (
        np.concatenate([a[real], added[0]]),
        np.concatenate([b[real], added[1]]),
        np.append(owner[real], keys[left, 0]),
    )


def _followers(a: FloatArray, b: FloatArray, owner: Indices) -> Indices:
    """For each edge, the edge of its region that begins where it ends, on the sphere."""
    places = np.concatenate([a, b])
    places[:, 0] = np.where(np.abs(places[:, 1]) == 90, 0.0, np.mod(places[:, 0], 360.0))
    node = np.unique(np.column_stack([np.tile(owner, 2), places]), axis=0, return_inverse=True)[1].ravel()
    begins, ends = node[: len(a)], node[len(a) :]
    follower = np.empty(len(a), dtype=np.intp)
    follower[np.argsort(ends, kind="stable")] = np.argsort(begins, kind="stable")
    return follower
