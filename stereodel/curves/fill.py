"""Closed loops on a chart as triangles, for OpenGL only; other backends fill outlines by the nonzero rule."""

from __future__ import annotations

from functools import cache

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices
from stereodel._extras import of_extra
from stereodel.constants import TOUCHING
from stereodel.curves.clip import signed_areas, with_first_again
from stereodel.curves.ragged import Ragged, cycles, offsets_of, spans
from stereodel.curves.trace import sides_of


def triangles(loops: Ragged, owner: Indices) -> tuple[FloatArray, Indices]:
    """Corners (m, 3, 2) of triangles that cover loops, and the region of each; clockwise loops are holes.

    Loops without holes that are star-shaped about their centre, such as cells, become triangle fans, all at once; the
    others are triangulated by ear clipping, each with its holes.
    """
    with of_extra("draw"):
        from mapbox_earcut import triangulate_float64

    shells, holder = holders(loops, owner)
    fanned, fans, row = _fans(loops)
    fanned &= shells
    fanned[holder[holder >= 0]] = False
    # The other shells, each followed by its holes.
    rings = np.flatnonzero(np.where(shells, ~fanned, holder >= 0))
    shell = np.where(shells, np.arange(len(loops)), holder)[rings]
    order = np.lexsort((rings, holder[rings] >= 0, shell))
    several, (number, counts) = loops.take(rings[order]), np.unique(shell, return_counts=True)
    bounds = offsets_of(counts)
    corners, owners = [fans[fanned[row]]], [owner[row[fanned[row]]]]
    for which, first, end in zip(number.tolist(), bounds[:-1].tolist(), bounds[1:].tolist(), strict=True):
        ends = several.offsets[first + 1 : end + 1]
        points = several.values[several.offsets[first] : ends[-1]]
        found = triangulate_float64(points, (ends - several.offsets[first]).astype(np.uint32)).reshape(-1, 3)
        corners.append(points[found])
        owners.append(np.full(len(found), owner[which]))
    return np.concatenate(corners), np.concatenate(owners)


def holders(loops: Ragged, owner: Indices) -> tuple[BoolArray, Indices]:
    """Which loops (m,) are shells, and the smallest shell of its region that holds each hole, the others, or −1."""
    # They may touch, even along sides, where rounding decides what lies inside: the corner or middle of a side that is
    # farthest from the shell does not touch it.
    area, _ = signed_areas(loops)
    shells, holder = np.flatnonzero(area > 0), np.full(len(loops), -1)
    shell_of = cache(lambda number: _Shell(loops.values[loops.offsets[number] : loops.offsets[number + 1]]))
    low, high = (f.reduceat(loops.values, loops.offsets[:-1]) for f in (np.minimum, np.maximum))
    for hole in np.flatnonzero(area < 0):
        ring = loops.values[loops.offsets[hole] : loops.offsets[hole + 1]]
        meets = (low[shells] < high[hole]).all(axis=1) & (low[hole] < high[shells]).all(axis=1)
        near = shells[(owner[shells] == owner[hole]) & meets & (area[shells] > -area[hole])]
        for shell in near[np.argsort(area[near])]:
            if shell_of(shell).holds(ring):
                holder[hole] = shell
                break
    return area > 0, holder


def union(loops: Ragged) -> Ragged:
    """The border, as closed loops, of the union of regions that share border points but do not overlap."""
    # A side of two loops occurs in both directions and cancels. At each point as many of the rest begin as end.
    first = np.delete(np.arange(len(loops.values)), loops.offsets[1:] - 1)
    places, node = np.unique(loops.values, axis=0, return_inverse=True)
    sides = np.stack([node.ravel()[first], node.ravel()[first + 1]], axis=1)
    sides = sides[sides[:, 0] != sides[:, 1]]
    forward = sides[:, 0] < sides[:, 1]
    codes, where = np.unique(sides.min(axis=1) * len(places) + sides.max(axis=1), return_inverse=True)
    excess = np.bincount(where.ravel(), np.where(forward, 1, -1), minlength=len(codes)).astype(np.intp)
    left = np.repeat(np.arange(len(codes)), np.abs(excess))
    ends = np.stack(np.divmod(codes[left], max(1, len(places))), axis=1)
    begin, end = np.where((excess[left] > 0)[:, None], ends, ends[:, ::-1]).T
    follower = np.empty(len(begin), dtype=np.intp)
    follower[np.argsort(end, kind="stable")] = np.argsort(begin, kind="stable")
    found = cycles(follower)
    return with_first_again(Ragged(places[begin[found.values]], found.offsets))


def _fans(loops: Ragged) -> tuple[BoolArray, FloatArray, Indices]:
    """Which loops wind monotonically once around the mean of their points; triangles to the mean, and their loops."""
    first, sides = sides_of(loops)
    row, count = sides.row, len(loops)
    number = np.maximum(np.bincount(row, minlength=count), 1)
    middle = np.stack([np.bincount(row, loops.values[first, k], minlength=count) / number for k in (0, 1)], axis=1)[row]
    a, b = loops.values[first] - middle, loops.values[first + 1] - middle
    sine, cosine = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], np.sum(a * b, axis=1)
    turn = np.bincount(row, np.arctan2(sine, cosine), minlength=count)
    ahead = np.bincount(row, sine <= 0, minlength=count) == 0
    fans = np.stack([middle, loops.values[first], loops.values[first + 1]], axis=1)
    return ahead & (turn < 3 * np.pi), fans, row


class _Shell:
    """A loop whose sides are listed by horizontal bands, to find the few near a hole; a band is a mean side high."""

    def __init__(self, loop: FloatArray) -> None:
        self.a, self.b = loop[:-1], loop[1:]
        low, high = np.minimum(self.a[:, 1], self.b[:, 1]), np.maximum(self.a[:, 1], self.b[:, 1])
        self.bottom, self.height = low.min(), (high - low).mean()
        first, last = (((y - self.bottom) // self.height).astype(np.intp) for y in (low, high))
        side, band = np.repeat(np.arange(len(low)), last - first + 1), spans(first, last - first + 1)
        order = np.argsort(band, kind="stable")
        self.sides = Ragged.grouped(side[order], band, int(last.max()) + 1)

    def holds(self, ring: FloatArray) -> bool:
        """Whether the loop contains a ring that does not cross it."""
        x, y = self._off(ring)
        (x0, y0), (x1, y1) = (ends.T for ends in self._between(y, y))
        side = (x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)
        up, down = (y0 <= y) & (y1 > y) & (side > 0), (y0 > y) & (y1 <= y) & (side < 0)
        return bool(np.count_nonzero(up) != np.count_nonzero(down))

    def _off(self, ring: FloatArray) -> FloatArray:
        """A corner or middle of a side of a ring off the loop: the first one farther than most, or the farthest."""
        low, high = ring.min(axis=0), ring.max(axis=0)
        clear = TOUCHING * (high - low).max()
        a, b = self._between(low[1] - clear, high[1] + clear)
        near = (np.maximum(a[:, 0], b[:, 0]) >= low[0] - clear) & (np.minimum(a[:, 0], b[:, 0]) <= high[0] + clear)
        a, way = a[near], (b - a)[near]
        best, far = ring[0], -1.0
        square = np.maximum(np.sum(way**2, axis=1), np.finfo(np.float64).tiny)
        for point in np.concatenate([ring[:-1], (ring[1:] + ring[:-1]) / 2]):
            share = np.clip(np.sum((point - a) * way, axis=1) / square, 0.0, 1.0)
            away = float(np.hypot(*(point - a - share[:, None] * way).T).min(initial=np.inf))
            if away > far:
                best, far = point, away
            if far > clear:
                break
        return best

    def _between(self, low: float, high: float) -> tuple[FloatArray, FloatArray]:
        """Both ends of the sides in all bands from one height to another, once for each band."""
        first, last = (min(max(int((y - self.bottom) // self.height), -1), len(self.sides) - 1) for y in (low, high))
        some = self.sides.values[self.sides.offsets[max(first, 0)] : self.sides.offsets[last + 1]]
        return self.a[some], self.b[some]
