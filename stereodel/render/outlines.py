"""The outlines of patches: loops round triangles that share their corners, for paper.

A side that two triangles share runs both ways and falls out; what is left are the loops that bound the region, with it
on their left: counterclockwise round the outside, clockwise round holes, as the nonzero rule wants them.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray
from stereodel._extras import of_extra
from stereodel.drawing.page import Patch

with of_extra("draw"):
    from matplotlib.path import Path as Outline

Indices = npt.NDArray[np.intp]

ARC_STEP_RAD = np.pi / 4
"""Longest arc that one cubic stands for: it is off by 4e-6 of the radius."""


def patch_outline(patch: Patch, *, spacing: float = 0.0) -> Outline:
    """The loops of a patch as one compound path, its rim as arcs of the circle.

    Corners closer along a loop than `spacing`, in page units, become one, and loops no longer than that fall out: a
    continent that a lens makes a spot is not written point by point.
    """
    vertices: list[FloatArray] = []
    codes: list[npt.NDArray[np.uint8]] = []
    for loop in loops(boundary_sides(patch.faces)):
        points, kinds = _loop_path(patch, loop, spacing)
        if len(points) == 3:  # there, back and closed
            continue
        vertices.append(points)
        codes.append(kinds)
    if not vertices:
        return Outline(np.zeros((0, 2)))
    return Outline(np.concatenate(vertices), np.concatenate(codes))


def boundary_sides(faces: npt.NDArray[np.integer]) -> Indices:
    """Directed sides (k, 2) that no triangle has the other way round; a side that comes twice each way falls out."""
    sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.intp)
    sides = sides[sides[:, 0] != sides[:, 1]]
    if len(sides) == 0:
        return np.zeros((0, 2), dtype=np.intp)
    size = int(sides.max()) + 1
    low, high = sides.min(axis=1), sides.max(axis=1)
    forward = np.where(sides[:, 0] < sides[:, 1], 1, -1)
    codes, where = np.unique(low * size + high, return_inverse=True)
    excess = np.bincount(where, weights=forward, minlength=len(codes)).astype(np.intp)
    kept = np.repeat(np.arange(len(codes)), np.abs(excess))
    ends = np.stack([codes[kept] // size, codes[kept] % size], axis=1)
    forward_only = (excess[kept] > 0)[:, None]
    directed: Indices = np.where(forward_only, ends, ends[:, ::-1])
    return directed


def loops(sides: Indices) -> list[Indices]:
    """Closed loops of vertices that directed sides (k, 2) make; at each vertex as many begin as end."""
    order = np.argsort(sides[:, 0], kind="stable")
    begins, ends = sides[order].T
    # The side that follows each: at a vertex where several begin, each is taken by one that ends there.
    arrivals = np.argsort(ends, kind="stable")
    following = np.empty(len(order), dtype=np.intp)
    following[arrivals] = np.arange(len(order))
    unused = np.ones(len(order), dtype=bool)
    found = []
    for first in range(len(order)):
        loop = []
        side = first
        while unused[side]:
            unused[side] = False
            loop.append(begins[side])
            side = following[side]
        if loop:
            found.append(np.array(loop, dtype=np.intp))
    return found


def _loop_path(patch: Patch, loop: Indices, spacing: float) -> tuple[FloatArray, npt.NDArray[np.uint8]]:
    """One loop, closed; runs along the rim as cubics, all else as straight lines."""
    on_rim = patch.rim[loop] & patch.rim[np.roll(loop, -1)]
    if on_rim.all():
        points = patch.points[loop]
        once_round = _swept(points, np.roll(points, -1, axis=0), np.array(patch.middle)) > np.pi
        # Otherwise there and back along the rim, as where a pole lies on it.
        return _whole_circle(patch, loop) if once_round else _polygon(points)
    # Begins where a side that is not on the rim ends, so that no run along the rim is cut.
    loop = np.roll(loop, -int(np.flatnonzero(~on_rim)[0]) - 1)
    on_rim = patch.rim[loop] & patch.rim[np.roll(loop, -1)]
    points = patch.points[loop]
    following = np.roll(points, -1, axis=0)
    vertices: list[FloatArray] = [points[:1]]
    codes: list[npt.NDArray[np.uint8]] = [np.array([Outline.MOVETO])]
    cuts = np.flatnonzero(on_rim[1:] != on_rim[:-1]) + 1
    for run in np.split(np.arange(len(loop)), cuts):
        sweep = _swept(points[run], following[run], np.array(patch.middle)) if on_rim[run[0]] else 0.0
        if sweep > 0:
            added, kind = _arc(points[run[0]], following[run[-1]], np.array(patch.middle), sweep), Outline.CURVE4
        else:
            added, kind = _spaced(points[run[0]], following[run], spacing), Outline.LINETO
        vertices.append(added)
        codes.append(np.full(len(added), kind))
    vertices.append(points[:1])
    codes.append(np.array([Outline.CLOSEPOLY]))
    return np.concatenate(vertices), np.concatenate(codes).astype(np.uint8)


def _spaced(start: FloatArray, points: FloatArray, spacing: float) -> FloatArray:
    """Points along a line from a start, at most one to each piece of a length; the last one stays where it is."""
    if spacing == 0.0:
        return points
    step = np.hypot(*np.diff(points, axis=0, prepend=start[None]).T)
    piece = np.floor(np.cumsum(step) / spacing)
    return points[np.diff(piece, append=np.inf) > 0]


def _polygon(points: FloatArray) -> tuple[FloatArray, npt.NDArray[np.uint8]]:
    codes = [Outline.MOVETO, *[Outline.LINETO] * (len(points) - 1), Outline.CLOSEPOLY]
    return np.concatenate([points, points[:1]]), np.array(codes, dtype=np.uint8)


def _whole_circle(patch: Patch, loop: Indices) -> tuple[FloatArray, npt.NDArray[np.uint8]]:
    start = patch.points[loop[:1]]
    half = 2 * np.array(patch.middle) - start[0]
    arcs = [_arc(a, b, np.array(patch.middle), np.pi) for a, b in ((start[0], half), (half, start[0]))]
    vertices = np.concatenate([start, *arcs, start])
    codes = [Outline.MOVETO, *[Outline.CURVE4] * (len(vertices) - 2), Outline.CLOSEPOLY]
    return vertices, np.array(codes, dtype=np.uint8)


def _swept(starts: FloatArray, ends: FloatArray, middle: FloatArray) -> float:
    """Angle about a middle along sides less than half a turn long; negative where rounding has them turned round."""
    u, w = starts - middle, ends - middle
    return float(np.arctan2(u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0], np.sum(u * w, axis=1)).sum())


def _arc(start: FloatArray, end: FloatArray, middle: FloatArray, sweep: float) -> FloatArray:
    """Control points, three to a cubic, of the counterclockwise arc about a middle from start to end."""
    u, w = start - middle, end - middle
    pieces = max(1, int(np.ceil(sweep / ARC_STEP_RAD)))
    t = np.linspace(0.0, sweep, pieces + 1)[:, None]
    side = np.array([-u[1], u[0]])
    ends = np.cos(t) * u + np.sin(t) * side
    ends[-1] = w
    reach = 4 / 3 * np.tan(sweep / pieces / 4)
    tangents = reach * np.stack([-ends[:, 1], ends[:, 0]], axis=1)
    cubics = np.stack([ends[:-1] + tangents[:-1], ends[1:] - tangents[1:], ends[1:]], axis=1)
    path: FloatArray = middle + cubics.reshape(-1, 2)
    return path
