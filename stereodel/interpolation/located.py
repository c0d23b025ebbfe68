"""Barycentric coordinates of queries in the triangles that contain them, and gradients there.

On the sphere the triangle is the plane one with the same corners, met by the ray through the query: with unit vectors
a, b, c and q the barycentric coordinates are det[q b c], det[a q c] and det[a b q], divided by their sum.
"""

from __future__ import annotations

import numpy as np

from stereodel import _double_double as double_double
from stereodel._arrays import AnyIndices, FloatArray
from stereodel._double_double import DoubleDouble, scaled
from stereodel.constants import NEEDLE, PLAIN_SQUARES, THIN_TRIANGLE
from stereodel.interpolation.interpolator import PrecisePoints
from stereodel.sphere.vectors import crossed


def cross2(a: FloatArray, b: FloatArray) -> FloatArray:
    """Third component of the product a × b of vectors (..., 2)."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Inner product along the last axis, which is kept."""
    return np.einsum("...i,...i->...", a, b)[..., None]


def lengths(vectors: FloatArray) -> FloatArray:
    """Lengths along the last axis, which is kept, also where squares would overflow or underflow."""
    with np.errstate(over="ignore"):
        plain = np.sqrt(np.sum(np.square(vectors), axis=-1, keepdims=True))
    least, largest = PLAIN_SQUARES
    rows = np.nonzero(~((plain > least) & (plain < largest))[..., 0])
    if len(rows[0]):
        odd, exponent = scaled(vectors[rows])
        root, half = np.sqrt(np.sum(np.square(odd), axis=-1)), exponent // 2
        plain[rows] = np.ldexp(np.ldexp(root, half), exponent - half)[:, None]
    return plain


class LocatedQueries:
    """Queries (m, 2), each with the corners (m, 3) of the triangle that contains it, counterclockwise."""

    def __init__(self, sites: PrecisePoints, corners: AnyIndices, queries: FloatArray) -> None:
        self.sites, self.corners = sites, corners
        self.given, self.queries = queries, PrecisePoints(queries)

    def offsets(self) -> list[FloatArray]:
        """Corners less queries, three arrays (m, d), one for each corner."""
        rows = np.arange(len(self.corners))
        return [self.sites.minus(self.corners[:, k], self.queries, rows) for k in range(3)]

    def weights(self) -> FloatArray:
        """Barycentric coordinates (m, 3): not negative, of sum one."""
        # From differences scaled by a power of two, so that the largest component is between 1/2 and 1. A sum below
        # THIN_TRIANGLE, twice the area of a thin triangle, is computed again in double-double; what cancels even there
        # leaves the nearest corner.
        offsets = np.stack(self.offsets(), axis=1)
        exponent = np.frexp(np.abs(offsets).max(axis=(1, 2), initial=0.0))[1]
        weights = _areas([np.ldexp(offsets[:, k], -exponent[:, None]) for k in range(3)], self._up())
        total = weights.sum(axis=1)
        thin = np.flatnonzero(~(total > THIN_TRIANGLE))
        if len(thin):
            weights[thin] = self._weights_of_thin(thin, exponent[thin], offsets[thin])
            total = weights.sum(axis=1)
        return weights / total[:, None]

    def _up(self) -> FloatArray | None:
        return self.queries.rounded if self.queries.curved else None

    def _weights_of_thin(self, rows: AnyIndices, exponent: AnyIndices, offsets: FloatArray) -> FloatArray:
        queries, sites, shift = self.queries.exact[rows], self.sites.exact, -exponent[:, None]
        exact = [sites[self.corners[rows, k]] - queries for k in range(3)]
        scaled = [DoubleDouble(np.ldexp(d.hi, shift), np.ldexp(d.lo, shift)) for d in exact]
        weights = _areas_twice(scaled, queries if self.queries.curved else None)
        lost = ~(weights.sum(axis=1) > 0)
        nearest = np.abs(offsets[lost]).max(axis=2).argmin(axis=1)
        weights[lost] = np.eye(3)[nearest]
        return weights

    def slope(self, derivatives: list[FloatArray]) -> FloatArray:
        """Gradient (m, d, k) of a function of the barycentric coordinates, from its derivatives by each, three (m, k).

        These are as if the coordinates were independent; only differences count, as their sum is one. With edges d, e
        from the first corner and N = d × e the function has the slope G = (f_d e×N + f_e N×d) / N² in the plane of the
        triangle. On the sphere the ray through q meets that plane at tq with t = (a·N)/(q·N), which gives t(G − N
        (G·q)/(q·N)), a tangent vector. Where the side opposite the first corner is by far the shortest, d and e are
        nearly the same; the corner opposite the longest side takes its part.
        """
        a = self.corners[:, 0]
        d, e = (self.sites.minus(self.corners[:, k], self.sites, a) for k in (1, 2))
        first, second = derivatives[1] - derivatives[0], derivatives[2] - derivatives[0]
        size = np.frexp(np.maximum(np.abs(d).max(axis=1), np.abs(e).max(axis=1)))[1][:, None]
        d, e = np.ldexp(d, -size), np.ldexp(e, -size)
        needles = np.flatnonzero(np.abs(e - d).max(axis=1) < NEEDLE)
        up = self._up()
        if up is None:
            area = cross2(d, e)[:, None]
            across = np.stack([e[:, 1], -e[:, 0]], axis=1) / area, np.stack([-d[:, 1], d[:, 0]], axis=1) / area
        else:
            normal = crossed(d, e)
            normal /= lengths(normal)
            area = dot(normal, crossed(d, e))
            depth = dot(normal, up)
            reach = dot(normal, self.sites.rounded[a]) / depth / area
            one, other = crossed(e, normal), crossed(normal, d)
            across = reach * _tangent(one, normal, up, depth), reach * _tangent(other, normal, up, depth)
        by_first, by_second = (np.ldexp(g, -size)[:, :, None] for g in across)
        result = np.asarray(by_first * first[:, None, :] + by_second * second[:, None, :])
        if len(needles):
            longer = np.abs(d[needles]).max(axis=1) > np.abs(e[needles]).max(axis=1)
            order = (np.where(longer, 2, 1)[:, None] + np.arange(3)) % 3
            corners = np.take_along_axis(self.corners[needles], order, axis=1)
            by = np.take_along_axis(np.stack(derivatives, axis=1)[needles], order[:, :, None], axis=1)
            result[needles] = LocatedQueries(self.sites, corners, self.given[needles]).slope(list(by.swapaxes(0, 1)))
        return result


def _tangent(slope: FloatArray, normal: FloatArray, up: FloatArray, depth: FloatArray) -> FloatArray:
    return slope - normal * (dot(slope, up) / depth)


def _areas(offsets: list[FloatArray], up: FloatArray | None) -> FloatArray:
    """Twice the areas of query and opposite edge, (m, 3), as seen along `up`; rounding below zero is cut off."""
    pairs = [(offsets[k - 2], offsets[k - 1]) for k in range(3)]
    areas = [cross2(b, c) if up is None else dot(up, crossed(b, c))[:, 0] for b, c in pairs]
    return np.maximum(np.stack(areas, axis=1), 0.0)


def _areas_twice(offsets: list[DoubleDouble], up: DoubleDouble | None) -> FloatArray:
    """The same in double-double, rounded at the end."""
    pairs = [(offsets[k - 2], offsets[k - 1]) for k in range(3)]
    if up is None:
        areas = [(b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]).hi for b, c in pairs]
    else:
        areas = [double_double.dot(double_double.cross(b, c), up).hi for b, c in pairs]
    return np.maximum(np.stack(areas, axis=1), 0.0)
