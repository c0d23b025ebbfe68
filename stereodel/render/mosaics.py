"""Many cells of a diagram and long polylines on the ball, laid out all at once.

A scene of a hundred arcs is laid out arc by arc, exactly. A quarter of a million cells, or the world's coastlines, are
cut into short straight pieces first: a chord of STEP_RAD leaves its arc by STEP_RAD²/8 of the radius, a twenty-fifth of
a pixel when the radius has a thousand.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray
from stereodel.render.page import Beziers, Mosaic, Stroke
from stereodel.render.regions import limb
from stereodel.render.style import LineStyle
from stereodel.render.things import Laid, Layer, Layout
from stereodel.sphere.frames import turned

STEP_RAD = np.radians(1.0)
"""Longest side of a triangle, and longest step of a polyline."""

LONGEST_CHORD = 2 * np.sin(STEP_RAD / 2)

Indices = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class MosaicThing:
    """The cells of a diagram, each in one colour: triangles of unit vectors (n, 3, 3) and their colours (n, 3)."""

    triangles: FloatArray
    colors: FloatArray
    role: str

    def lay(self, layout: Layout) -> Iterator[Laid]:
        """The part on the near side."""
        corners, kept = near_part(turned(self.triangles, layout.matrix))
        if len(corners):
            outline = (layout.path([limb(layout.radius)]),)
            placed = layout.on_page(layout.radius * corners)
            yield Layer.TINT, Mosaic(placed, corners, self.colors[kept], outline, self.role)


@dataclass(frozen=True, eq=False)
class PolylinesThing:
    """Polylines of unit vectors, (k, 3) each, in steps so short that they are drawn straight."""

    lines: tuple[FloatArray, ...]
    look: LineStyle
    role: str

    def lay(self, layout: Layout) -> Iterator[Laid]:
        """The parts on the near side."""
        for line in self.lines:
            for run in near_runs(turned(line, layout.matrix)):
                path = straight_path(layout.on_page(layout.radius * run))
                closed = len(run) > 3 and bool(np.array_equal(run[0], run[-1]))
                yield (
                    Layer.LINE,
                    Stroke(path, self.look.color, self.look.width, self.look.dash, "round", closed, self.role),
                )


def cell_triangles(
    points: FloatArray, vertices: FloatArray, indices: Indices, offsets: Indices
) -> tuple[FloatArray, Indices]:
    """Every cell of a diagram as triangles of its site and each of its sides, cut into small ones.

    Parameters
    ----------
    points : (n, 3) array
        Sites, directions.
    vertices : (v, 3) array
        Unit vectors.
    indices, offsets : int arrays
        The vertices of cell i, counterclockwise: ``indices[offsets[i]:offsets[i + 1]]``, none or more than two.

    Returns
    -------
    triangles : (m, 3, 3) array
        Unit vectors, counterclockwise seen from outside.
    cell : (m,) array
        Number of the cell of each.
    """
    sizes = np.diff(offsets)
    cell = np.repeat(np.arange(len(sizes)), sizes)
    following = np.arange(1, len(indices) + 1)
    following[offsets[1:][sizes > 0] - 1] = offsets[:-1][sizes > 0]
    corners = [units(points)[cell], vertices[indices], vertices[indices[following]]]
    return refined(np.stack(corners, axis=1), cell)


def refined(triangles: FloatArray, owner: Indices) -> tuple[FloatArray, Indices]:
    """Triangles cut at the middles of their long sides until none is longer than STEP_RAD.

    Whether a side is cut, and where, depends on the side alone: neighbours stay joined without a gap.
    """
    fine_triangles, fine_owners = [triangles[:0]], [owner[:0]]
    while len(triangles):
        steps = triangles - np.roll(triangles, -1, axis=1)
        long = np.sum(steps**2, axis=-1) > LONGEST_CHORD**2
        pieces, owners = [triangles[:0]], [owner[:0]]
        for pattern, corners in PIECES.items():
            which = np.flatnonzero((long == pattern).all(axis=1))
            pieces.append(_with_middles(triangles[which])[:, corners].reshape(-1, 3, 3))
            owners.append(np.repeat(owner[which], len(corners)))
        fine = ~long.any(axis=1)
        fine_triangles.append(triangles[fine])
        fine_owners.append(owner[fine])
        triangles, owner = np.concatenate(pieces), np.concatenate(owners)
    return np.concatenate(fine_triangles), np.concatenate(fine_owners)


# Corners 0, 1, 2 and the middles 3, 4, 5 of the sides 01, 12, 20; which sides are cut → the triangles that come of it.
PIECES = {
    (True, True, True): [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)],
    (True, True, False): [(3, 1, 4), (0, 3, 4), (0, 4, 2)],
    (False, True, True): [(5, 4, 2), (0, 1, 4), (0, 4, 5)],
    (True, False, True): [(0, 3, 5), (3, 1, 2), (3, 2, 5)],
    (True, False, False): [(0, 3, 2), (3, 1, 2)],
    (False, True, False): [(0, 1, 4), (0, 4, 2)],
    (False, False, True): [(0, 1, 5), (5, 1, 2)],
}


def _with_middles(triangles: FloatArray) -> FloatArray:
    """Corners and middles of the sides, (n, 6, 3)."""
    return np.concatenate([triangles, units(triangles + np.roll(triangles, -1, axis=1))], axis=1)


def units(vectors: FloatArray) -> FloatArray:
    """Directions (..., 3) as unit vectors."""
    directions: FloatArray = vectors / np.sqrt(np.sum(vectors**2, axis=-1, keepdims=True))
    return directions


def near_part(triangles: FloatArray) -> tuple[FloatArray, Indices]:
    """What is left of triangles (n, 3, 3) in view axes when the far side is cut off, and of which each piece is."""
    above = triangles[..., 2] >= 0
    count = above.sum(axis=1)
    whole, one, two = (np.flatnonzero(count == k) for k in (3, 1, 2))
    # Turned round so that the corner that is alone on its side comes first.
    a, b, c = _turned_to(triangles[one], above[one].argmax(axis=1))
    tips = np.stack([a, _on_limb(a, b), _on_limb(a, c)], axis=1)
    a, b, c = _turned_to(triangles[two], above[two].argmin(axis=1))
    left, right = _on_limb(b, a), _on_limb(c, a)
    halves = [np.stack([left, b, c], axis=1), np.stack([left, c, right], axis=1)]
    return np.concatenate([triangles[whole], tips, *halves]), np.concatenate([whole, one, two, two])


def _turned_to(triangles: FloatArray, first: Indices) -> tuple[FloatArray, FloatArray, FloatArray]:
    row = np.arange(len(triangles))
    return triangles[row, first], triangles[row, (first + 1) % 3], triangles[row, (first + 2) % 3]


def _on_limb(near: FloatArray, far: FloatArray) -> FloatArray:
    """Where arcs from a point on the near side to one on the far side pass the limb."""
    crossing = near * -far[..., 2:] + far * near[..., 2:]
    crossing[..., 2] = 0.0
    return units(crossing)


def near_runs(line: FloatArray) -> list[FloatArray]:
    """The pieces of a polyline (k, 3) in view axes that are on the near side, ended on the limb."""
    above = line[:, 2] >= 0
    changes = np.flatnonzero(above[1:] != above[:-1])
    runs = []
    for number, run in enumerate(np.split(line, changes + 1)):
        if run[0, 2] >= 0:
            before = [_on_limb(run[:1], line[changes[number - 1], None])] if number else []
            after = [_on_limb(run[-1:], line[changes[number] + 1, None])] if number < len(changes) else []
            runs.append(np.concatenate([*before, run, *after]))
    return [run for run in runs if len(run) > 1]


def stepped(line: FloatArray) -> FloatArray:
    """A polyline of unit vectors with points added on the great circles between its points, STEP_RAD apart at most."""
    while True:
        long = np.flatnonzero(np.sum(np.diff(line, axis=0) ** 2, axis=1) > LONGEST_CHORD**2)
        if len(long) == 0:
            return line
        line = np.insert(line, long + 1, units(line[long] + line[long + 1]), axis=0)


def straight_path(points: FloatArray) -> Beziers:
    """A polyline on the page as a run of straight cubics."""
    start, step = points[:-1, None], np.diff(points, axis=0)[:, None]
    path: Beziers = start + step * (np.arange(4) / 3)[:, None]
    path[:, 3] = points[1:]
    return path
