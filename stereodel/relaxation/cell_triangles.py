"""Voronoi cells as triangles: of the plane within a convex polygon, of the sphere; and integrals over triangles."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import AnyIndices, BoolArray, FloatArray, SignArray, as_bounds, as_floats
from stereodel.constants import QUADRATURE_CHORD
from stereodel.curves.ragged import Ragged, spans
from stereodel.triangulation import PlanarVoronoi, SphericalVoronoi


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


def flat_cells(points: FloatArray, polygon: FloatArray, workers: int | None) -> tuple[FloatArray, AnyIndices]:
    """Triangles (t, 3, 2) relative to their sites, counterclockwise, that make up the cells, and the sites (t,)."""
    # Four more sites bound every cell, so that all are fans of triangles around their sites, without reaching into the
    # polygon: within it every site is at most 2r away, r the radius of a circle around it; these are at least 7r away.
    low, high = polygon.min(axis=0), polygon.max(axis=0)
    reach = 4 * float(np.hypot(*(high - low)))
    far = low + (high - low) / 2 + reach * np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    diagram = PlanarVoronoi(np.concatenate([points, far]), workers=workers)
    cells = Ragged(diagram.region_indices, diagram.region_offsets)
    # A triangle for each side of a cell: its site at the origin, then both ends of the side. The four have none.
    own = cells.row < len(points)
    corners = cells.values[own], cells.values[cells.following[own]]
    site: AnyIndices = cells.row[own]
    here, there = (diagram.vertices[vertex] - points[site] for vertex in corners)
    triangles = np.stack([np.zeros_like(here), here, there], axis=1)
    # Cells are convex and so is the polygon: cutting the triangles at one side after the other leaves what is in both.
    for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        # Heights of the corners above the side, times its length.
        (x, y), (along, over) = end - start, np.moveaxis(triangles + (points[site] - start)[:, None], -1, 0)
        triangles, site = _clipped(triangles, site, x * over - y * along)
    return triangles, site


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
    a, b, c = _turned(triangles, alone)
    at_a, at_b, at_c = _turned(heights[:, :, None], alone)
    # Heights of different sign, of which one may be zero: their difference is not.
    return [a, a + (b - a) * (at_a / (at_a - at_b)), a + (c - a) * (at_a / (at_a - at_c)), b, c]


def _turned(corners: FloatArray, first: AnyIndices) -> FloatArray:
    """What belongs to corners (t, 3, d), as (3, t, d), so that this one comes first: the orientation stays."""
    return np.moveaxis(np.take_along_axis(corners, ((first[:, None] + np.arange(3)) % 3)[:, :, None], axis=1), 1, 0)


class RoundCells:
    """The cells of unit vectors `sites` (n, 3), by `ridges` (r, 2): the sites on the left and right of each."""

    def __init__(self, sites: FloatArray, workers: int | None) -> None:
        self.diagram = SphericalVoronoi(sites, workers=workers)
        self.sites = sites
        self.ridges = self.diagram.ridge_points
        self._start, end = np.moveaxis(self.diagram.vertices[self.diagram.ridge_vertices], 1, 0)
        self._normals = self.diagram.ridge_normals()
        # The angle from start to end about the normal: at most half a turn, as the whole ridge of two sites is in two
        # parts. A tiny one, or one of half a turn, may be rounded to the other side.
        side = np.einsum("ri,ri->r", self._normals, np.cross(self._start, end))
        self._angles = np.arctan2(np.abs(side), np.einsum("ri,ri->r", self._start, end))

    def moments(self) -> FloatArray:
        """Integrals (n, 3) of the unit vectors over the cells.

        Half the sum of the ridges' normals times their angles, by Stokes' theorem.
        """
        # The boundary of the left cell runs along a ridge, that of the right cell against it.
        turned = self._normals * (self._angles / 2)[:, None]
        left, right = self.ridges.T
        count = len(self.sites)
        return np.column_stack([np.bincount(left, t, count) - np.bincount(right, t, count) for t in turned.T])

    def triangles(self) -> tuple[FloatArray, AnyIndices]:
        """Counterclockwise triangles (t, 3, 3) of a site and a piece of a ridge, or parts of them; and the sites (t,).

        No side is longer than QUADRATURE_CHORD. The cell of a single site is the whole sphere.
        """
        if len(self.sites) and not len(self.ridges):
            signs = np.array([[x, y, z] for x in (1.0, -1.0) for y in (1.0, -1.0) for z in (1.0, -1.0)])
            octants = np.array([np.diag(s) if s.prod() > 0 else np.diag(s)[::-1] for s in signs])
            return split_long(octants, np.zeros(8, dtype=np.intp))
        # Each ridge in pieces of equal angle, none longer than the chord: ridge by ridge, step 0, 1, … of each.
        pieces = np.ceil(self._angles / QUADRATURE_CHORD).astype(int)
        ridge = np.repeat(np.arange(len(pieces)), pieces)
        step = spans(np.zeros_like(pieces), pieces)
        ends = [self._along(ridge, (step + k) * self._angles[ridge] / pieces[ridge]) for k in (0, 1)]
        # A piece runs with its left site on the left: the triangle with the right one takes it backwards.
        left, right = self.ridges[ridge].T
        lefts = np.stack([self.sites[left], *ends], axis=1)
        rights = np.stack([self.sites[right], *ends[::-1]], axis=1)
        return split_long(np.concatenate([lefts, rights]), np.concatenate([left, right]))

    def _along(self, ridge: AnyIndices, angle: FloatArray) -> FloatArray:
        start, normal = self._start[ridge], self._normals[ridge]
        return start * np.cos(angle)[:, None] + np.cross(normal, start) * np.sin(angle)[:, None]


Rule = tuple[FloatArray, FloatArray]
"""Barycentric coordinates (k, 3) of nodes, and their weights (k,), which sum to one."""

MIDPOINTS: Rule = ((np.ones((3, 3)) - np.eye(3)) / 2, np.full(3, 1 / 3))
"""Exact for polynomials of degree two."""


def _radon() -> Rule:
    root = np.sqrt(15.0)
    equal = (np.array([6.0 - root, 6.0 + root]) / 21)[:, None, None]
    corners = equal + np.eye(3) * (1 - 3 * equal)
    nodes = np.vstack([np.full((1, 3), 1 / 3), corners.reshape(6, 3)])
    return nodes, np.repeat([9 / 40, (155 - root) / 1200, (155 + root) / 1200], [1, 3, 3])


RADON = _radon()
"""Exact for polynomials of degree five: J. Radon, "Zur mechanischen Kubatur" (1948)."""


def flat_nodes(triangles: FloatArray, rule: Rule) -> tuple[FloatArray, FloatArray]:
    """Nodes (t, k, 2) and weights (t, k) for counterclockwise triangles (t, 3, 2) of the plane."""
    b, c = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    areas = (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]) / 2
    return np.einsum("kc,tcd->tkd", rule[0], triangles), areas[:, None] * rule[1]


def spherical_nodes(triangles: FloatArray, rule: Rule) -> tuple[FloatArray, FloatArray]:
    """Nodes (t, k, 3), unit vectors, and weights (t, k) for counterclockwise triangles (t, 3, 3) of unit vectors.

    The flat triangle's nodes y are projected from the centre: a small area of it, seen from there, is
    det[a b c] / |y|³ times as large as its share of the triangle, halved.
    """
    a, b, c = (triangles[:, k] for k in range(3))
    determinant = np.einsum("ti,ti->t", a, np.cross(b - a, c - a))
    flat = np.einsum("kc,tcd->tkd", rule[0], triangles)
    length = np.sqrt(np.einsum("tkd,tkd->tk", flat, flat))
    return flat / length[..., None], (determinant / 2)[:, None] * rule[1] / length**3


def split_long(triangles: FloatArray, number: AnyIndices) -> tuple[FloatArray, AnyIndices]:
    """Spherical triangles (t, 3, 3) and their numbers (t,), halved until no side is longer than QUADRATURE_CHORD."""
    done = [(triangles[:0], number[:0])]
    while len(triangles):
        # Side k is the one opposite corner k: from the corner after it to the corner before it.
        sides = np.linalg.norm(np.roll(triangles, -1, axis=1) - np.roll(triangles, 1, axis=1), axis=2)
        long = sides.max(axis=1) > QUADRATURE_CHORD
        done.append((triangles[~long], number[~long]))
        triangles, number = _halves(triangles[long], sides[long]), np.tile(number[long], 2)
    return np.concatenate([t for t, _ in done]), np.concatenate([n for _, n in done])


def _halves(triangles: FloatArray, sides: FloatArray) -> FloatArray:
    """Both halves (2t, 3, 3) of triangles cut from the middle of the longest side, which is opposite its corner."""
    # The longest side is bc; its middle on the sphere is the direction of b + c.
    a, b, c = _turned(triangles, np.argmax(sides, axis=1))
    middle = b + c
    length = np.linalg.norm(middle, axis=1, keepdims=True)
    middle = np.where(length > 0, middle / np.where(length > 0, length, 1.0), a)
    return np.concatenate([np.stack([a, b, middle], axis=1), np.stack([a, middle, c], axis=1)])
