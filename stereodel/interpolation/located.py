"""Barycentric coordinates of queries in the triangles that contain them, and gradients there.

On the sphere the triangle is the plane one with the same corners, met by the ray through the query: with unit vectors
a, b, c and q the barycentric coordinates are det[q b c], det[a q c] and det[a b q], divided by their sum.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from stereodel._arrays import AnyIndices, FloatArray
from stereodel._double_double import DoubleDouble, scaled, shift_exponent
from stereodel.constants import NEEDLE, PLAIN_SQUARES, THIN_TRIANGLE
from stereodel.interpolation.interpolator import PrecisePoints


def cross2(a: Any, b: Any) -> Any:
    """Third component of the product a × b of vectors (2, ...)."""
    return a[0] * b[1] - a[1] * b[0]


def cross3(a: Any, b: Any) -> list[Any]:
    """Components of the products a × b of vectors (3, ...)."""
    return [a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1))]


def crossed(a: FloatArray, b: FloatArray) -> FloatArray:
    """The same as an array."""
    found = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for k in range(3):
        np.subtract(a[k - 2] * b[k - 1], a[k - 1] * b[k - 2], out=found[k])
    return found


def inner(a: Any, b: Any) -> Any:
    """Inner product along the first axis, of two or three components."""
    first = a[0] * b[0] + a[2] * b[2] if len(b) == 3 else a[0] * b[0]
    return first + a[1] * b[1]


def dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """The same, with the axis kept."""
    return np.asarray(inner(a, b))[None]


def lengths(vectors: FloatArray) -> FloatArray:
    """Lengths (1, ...) of vectors (d, ...), also where squares would overflow or underflow."""
    with np.errstate(over="ignore"):
        squares = vectors * vectors
        plain = np.sqrt(sum(squares[1:], squares[0]))[None]
    least, largest = PLAIN_SQUARES
    if not (plain.min(initial=1.0) > least and plain.max(initial=1.0) < largest):
        odd_ones = ~((plain[0] > least) & (plain[0] < largest))
        near, exponent = scaled(vectors[:, odd_ones].T)
        root = np.sqrt(np.sum(np.square(near), axis=1))
        plain[0, odd_ones] = np.ldexp(np.ldexp(root, exponent // 2), exponent - exponent // 2)
    return plain


def heaviest(weights: FloatArray, of: FloatArray) -> FloatArray:
    """Of arrays (3, ...), what belongs to the corner with the largest weight, the first of these."""
    a, b, c = weights
    return np.where((a >= b) & (a >= c), of[0], np.where(b >= c, of[1], of[2]))


class LocatedQueries:
    """Queries (m, d), each with the corners (m, 3) of the triangle that contains it, counterclockwise.

    All that is computed has components first, and queries last.
    """

    def __init__(self, sites: PrecisePoints, corners: AnyIndices, queries: FloatArray) -> None:
        self.sites, self.numbers = sites, np.ascontiguousarray(corners.T, dtype=np.intp)
        self.given, self.queries = queries, PrecisePoints(queries)
        self.up = self.queries.rounded if self.queries.curved else None
        self.corners = [sites.take(numbers) for numbers in self.numbers]

    def weights(self) -> FloatArray:
        """Barycentric coordinates (3, m): not negative, of sum one."""
        # From differences scaled by a power of two, so that the largest component is between 1/2 and 1. A sum below
        # THIN_TRIANGLE, twice the area of a thin triangle, is computed again in double-double; what cancels even there
        # leaves the nearest corner.
        offsets = np.stack([corner - self.queries for corner in self.corners])
        exponent = np.frexp(np.abs(offsets).max(axis=(0, 1), initial=0.0))[1]
        weights = _areas(np.ldexp(offsets, -exponent), self.up)
        total = weights[0] + weights[1] + weights[2]
        thin = np.flatnonzero(~(total > THIN_TRIANGLE))
        if len(thin):
            weights[:, thin] = self._weights_of_thin(thin, exponent[thin], offsets[:, :, thin])
            total = weights[0] + weights[1] + weights[2]
        return weights / total

    def _weights_of_thin(self, columns: AnyIndices, exponent: AnyIndices, offsets: FloatArray) -> FloatArray:
        def some(points: PrecisePoints) -> DoubleDouble:
            found = points.take(columns).exact
            return found if points.curved else DoubleDouble(found.hi)

        queries = some(self.queries)
        exact = [shift_exponent(some(corner) - queries, -exponent) for corner in self.corners]
        weights = _areas(exact, queries if self.queries.curved else None)
        lost = ~(weights.sum(axis=0) > 0)
        nearest = np.abs(offsets[:, :, lost]).max(axis=1).argmin(axis=0)
        weights[:, lost] = np.eye(3)[nearest].T
        return weights

    def slope(self, derivatives: list[FloatArray]) -> FloatArray:
        """Gradient (d, k, m) of a function of the barycentric coordinates, from its derivatives by each, three (k, m).

        These are as if the coordinates were independent; only differences count, as their sum is one. With edges d, e
        from the first corner and N = d × e the function has the slope G = (f_d e×N + f_e N×d) / N² in the plane of the
        triangle. On the sphere the ray through q meets that plane at tq with t = (a·N)/(q·N), which gives t(G − N
        (G·q)/(q·N)), a tangent vector. Where the side opposite the first corner is by far the shortest, d and e are
        nearly the same; the corner opposite the longest side takes its part.
        """
        a, *others = self.corners
        d, e = (other - a for other in others)
        first, second = derivatives[1] - derivatives[0], derivatives[2] - derivatives[0]
        size = np.frexp(np.maximum(np.abs(d).max(axis=0), np.abs(e).max(axis=0)))[1]
        d, e = np.ldexp(d, -size), np.ldexp(e, -size)
        needles = np.flatnonzero(np.abs(e - d).max(axis=0) < NEEDLE)
        if (up := self.up) is None:
            area = cross2(d, e)
            across = np.stack([e[1], -e[0]]) / area, np.stack([-d[1], d[0]]) / area
        else:
            normal = crossed(d, e)
            normal /= lengths(normal)
            area = dot(normal, crossed(d, e))
            depth = dot(normal, up)
            reach = dot(normal, a.rounded) / depth / area
            one, other = crossed(e, normal), crossed(normal, d)
            across = reach * _tangent(one, normal, up, depth), reach * _tangent(other, normal, up, depth)
        by_first, by_second = (np.ldexp(g, -size)[:, None] for g in across)
        result = np.asarray(by_first * first + by_second * second)
        if len(needles):
            longer = np.abs(d[:, needles]).max(axis=0) > np.abs(e[:, needles]).max(axis=0)
            order = (np.where(longer, 2, 1) + np.arange(3)[:, None]) % 3
            corners = np.take_along_axis(self.numbers[:, needles], order, axis=0)
            by = np.take_along_axis(np.stack(derivatives)[:, :, needles], order[:, None], axis=0)
            result[:, :, needles] = LocatedQueries(self.sites, corners.T, self.given[needles]).slope(list(by))
        return result


def _tangent(slope: FloatArray, normal: FloatArray, up: FloatArray, depth: FloatArray) -> FloatArray:
    return slope - normal * (dot(slope, up) / depth)


def _areas(offsets: Any, up: Any) -> FloatArray:
    """Twice the areas of query and opposite edge, (3, m), as seen along `up`; rounding below zero is cut off."""
    pairs = [(offsets[k - 2], offsets[k - 1]) for k in range(3)]
    areas = [cross2(b, c) if up is None else inner(up, cross3(b, c)) for b, c in pairs]
    return np.maximum(np.stack([area.hi if isinstance(area, DoubleDouble) else area for area in areas]), 0.0)
