"""Closed loops on a chart as triangles, for OpenGL alone; all else fills outlines itself, by the nonzero rule."""

from __future__ import annotations

import numpy as np

from stereodel._arrays import Indices
from stereodel._extras import of_extra
from stereodel.curves.clip import signed_areas
from stereodel.curves.ragged import Ragged


def triangles(loops: Ragged, owner: Indices) -> tuple[np.ndarray, Indices]:
    """Corners (m, 3, 2) of triangles that cover loops, and the region of each; clockwise loops are holes.

    Ear clipping wants a shell with its holes. A hole belongs to the smallest shell of its region that holds its first
    point; most regions have shells alone.
    """
    with of_extra("draw"):
        from mapbox_earcut import triangulate_float64

    area, _ = signed_areas(loops)
    shells = np.flatnonzero(area > 0)
    held: dict[int, list[int]] = {int(shell): [] for shell in shells}
    low, high = (f.reduceat(loops.values, loops.offsets[:-1]) for f in (np.minimum, np.maximum))
    for hole in np.flatnonzero(area < 0):
        point = loops.values[loops.offsets[hole]]
        near = shells[
            (owner[shells] == owner[hole]) & (low[shells] <= point).all(axis=1) & (point <= high[shells]).all(axis=1)
        ]
        for shell in near[np.argsort(area[near])]:
            if _holds(loops.values[loops.offsets[shell] : loops.offsets[shell + 1]], point):
                held[int(shell)].append(int(hole))
                break
    corners, owners = [], []
    for shell, holes in held.items():
        rings = loops.take(np.array([shell, *holes]))
        found = triangulate_float64(rings.values, rings.offsets[1:].astype(np.uint32)).reshape(-1, 3)
        corners.append(rings.values[found])
        owners.append(np.full(len(found), owner[shell]))
    return np.concatenate([np.zeros((0, 3, 2)), *corners]), np.concatenate([owner[:0], *owners])


def _holds(loop: np.ndarray, point: np.ndarray) -> bool:
    (x0, y0), (x1, y1) = loop[:-1].T, loop[1:].T
    side = (x1 - x0) * (point[1] - y0) - (point[0] - x0) * (y1 - y0)
    up, down = (y0 <= point[1]) & (y1 > point[1]) & (side > 0), (y0 > point[1]) & (y1 <= point[1]) & (side < 0)
    return bool(np.count_nonzero(up) != np.count_nonzero(down))
