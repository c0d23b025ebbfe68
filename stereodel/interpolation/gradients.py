"""Gradients at the points, estimated from the values around them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, BoolArray, FloatArray, keep_freed_memory
from stereodel._docs import shared
from stereodel.constants import UNDETERMINED
from stereodel.curves.ragged import spans
from stereodel.interpolation.interpolator import FAMILY, PrecisePoints, as_site_values
from stereodel.interpolation.located import crossed, inner, lengths
from stereodel.triangulation.delaunay import Triangulation, as_triangulation, state_of
from stereodel.triangulation.topology import adjacency_of, edges_of

_UNKNOWNS = 5


@shared(**FAMILY)
def estimate_gradients(points: npt.ArrayLike | Triangulation, values: npt.ArrayLike) -> FloatArray:
    """Gradients at the points of a function known only at these points.

    {points}
    {values}

    Returns
    -------
    (n, ..., 2) or (n, ..., 3) array
        Per unit of length, or tangent vectors per radian. NaN where the value is NaN and where there is no triangle.
        Correct at every scale of the points; on overflow, as for a rise of 1e10 over 1e-300, not finite.

    {raises}

    Notes
    -----
    At each point the quadratic polynomial of the tangent plane that has the point's value and best fits those of
    its neighbours and their neighbours: least squares of the differences times (1/r − 1/R)², where r is the distance
    and R a little more than the largest one. The three nearest count like the third: else a very close one would
    decide alone, by its rounding. On the sphere the polynomial is in the tangential components ξ, η of the
    difference d of the unit vectors, with |d|² in place of ξ² + η². So quadratic polynomials of the plane and linear
    functions of (x, y, z) have their exact gradients; for smooth functions the error is of order h². What the
    neighbours do not determine is left out, second derivatives first. Neighbours without a value are skipped; equal
    points take the mean of their values and have the same gradient.

    References
    ----------
    R. J. Renka, "Interpolation of data on the surface of a sphere", ACM TOMS 10 (1984): local quadratic fits.

    Examples
    --------
    >>> x, y = np.mgrid[:3, :3].reshape(2, -1).astype(float)
    >>> estimate_gradients(np.column_stack([x, y]), x * x + 3 * y)[4].round(9).tolist()
    [2.0, 3.0]
    """
    triangulation = as_triangulation(points)
    flat, shape = as_site_values(triangulation, values)
    gradients = fit_gradients(triangulation, flat, PrecisePoints(triangulation.points))
    return np.ascontiguousarray(gradients.T).reshape(len(flat), *shape, triangulation.points.shape[1])


def fit_gradients(triangulation: Triangulation, values: FloatArray, sites: PrecisePoints) -> FloatArray:
    """The same (d, k, n) for values (n, k), one a place."""
    size, dimension = triangulation.points.shape
    fields = np.ascontiguousarray(values.T)
    keep_freed_memory()
    gradients = np.full((dimension, len(fields), size), np.nan)
    known = ~np.isnan(fields)
    # Fields without values at the same points share the work of the fit.
    groups = [slice(None)] if known.all() else [slice(k, k + 1) for k in range(len(fields))]
    for block, others, present in rings_in_blocks(triangulation):
        for columns in groups:
            usable = present if known[columns].all() else present & known[columns].all(axis=0).take(others)
            gradients[:, columns, block] = _fit(sites, fields[columns], block, others, usable)
    dropped, kept = triangulation.duplicates.T
    gradients[:, :, dropped] = gradients[:, :, kept]
    return gradients


def _fit(
    sites: PrecisePoints, values: FloatArray, block: AnyIndices, others: AnyIndices, usable: BoolArray
) -> FloatArray:
    """Gradients (d, k, b) at the points `block`, each with a column of others (s, b), of which some count."""
    here = sites.take(block[None])
    axes = _axes(here)
    with np.errstate(all="ignore"):
        columns, weights, unit = _columns(sites.take(others) - here, axes, usable)
        rises = np.where(usable, values.take(others, axis=1) - values.take(block, axis=1)[:, None], 0.0) * weights
        one, other = _solve(*_normal_equations(columns, rises))[:2] / unit
        # The first two unknowns are the slopes along the axes, per unit of length of each point.
        return np.asarray(axes[0] * one + axes[1] * other)


def _normal_equations(columns: list[FloatArray], rises: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Systems (5, 5, b) and right sides (5, k, b) of columns (5, s, b) and (k, s, b), summed over what a point has."""
    normal = np.empty((_UNKNOWNS, _UNKNOWNS, rises.shape[-1]))
    right = np.empty((_UNKNOWNS, len(rises), rises.shape[-1]))
    for i, column in enumerate(columns):
        for j in range(i + 1):
            normal[i, j] = normal[j, i] = _sums(column * columns[j])
        for j, rise in enumerate(rises):
            right[i, j] = _sums(column * rise)
    return normal, right


def _sums(rows: FloatArray) -> FloatArray:
    """Of each column, in pieces: rounding does not grow with thousands of neighbours."""
    return np.asarray(sum(np.add.reduce(rows[k : k + 64]) for k in range(0, len(rows), 64)))


def _columns(
    differences: FloatArray, axes: FloatArray, usable: BoolArray
) -> tuple[list[FloatArray], FloatArray, FloatArray]:
    """Weighted ξ, η, |d|², ξ² − η², 2ξη of each pair (5, s, b), its weight, and the unit of length of each point."""
    # The unit u is the distance of the third neighbour. Weights are smaller by (u/r)² where r is longer; so columns are
    # made of d/max(u, r), which is one at most, however much longer the longest distance is.
    size = lengths(differences)[0]
    farthest = np.where(usable, size, 0.0).max(axis=0)
    unit = np.minimum(_third_least(np.where(usable, size, np.inf)), farthest)
    longer = np.maximum(size, unit)
    # (1 − r/R)², R a tenth beyond the farthest: the weight without its 1/r², which (u/max(u, r))² replaces below.
    share = np.where(usable, np.square(1.0 - size / (1.1 * farthest)), 0.0)
    # Coordinates along the axes of the owner, of d over max(u, r).
    nearer = unit / longer
    differences /= longer
    xi, eta = (inner(axis, differences) for axis in axes)
    r = size / longer
    part = share * nearer
    columns = [part * xi, part * eta, share * (r * r), share * (xi * xi - eta * eta), 2.0 * share * (xi * eta)]
    return columns, part * nearer, unit


def _third_least(rows: FloatArray) -> FloatArray:
    """The third smallest number of each column, equal ones counted separately."""
    first, second, third = np.sort(rows[:3], axis=0)
    for row in rows[3:]:
        third = np.minimum(third, np.maximum(second, row))
        second = np.minimum(second, np.maximum(first, row))
        first = np.minimum(first, row)
    return third


def _axes(places: PrecisePoints) -> FloatArray:
    """Two unit vectors of the tangent plane at each point, (2, d, 1, b)."""
    up = places.rounded
    if not places.curved:
        return np.broadcast_to(np.eye(2)[:, :, None, None], (2, *up.shape))
    first = crossed(np.eye(3)[:, np.abs(up).argmin(axis=0)], up)
    first /= np.sqrt(inner(first, first))
    return np.stack([first, crossed(up, first)])


def _solve(normal: FloatArray, right: FloatArray) -> FloatArray:
    """Solve symmetric systems (5, 5, b) by elimination in order; unknowns that are not determined are zero."""
    # A pivot is the part of a column's square that the columns before it do not explain.
    squares = np.einsum("iib->ib", normal).copy()
    matrix = np.concatenate([normal, right], axis=1)
    inverse = np.zeros_like(squares)
    for i in range(_UNKNOWNS):
        determined = matrix[i, i] > UNDETERMINED * squares[i]
        np.divide(1.0, matrix[i, i], out=inverse[i], where=determined)
        factors = matrix[i + 1 :, i] * inverse[i]
        matrix[i + 1 :] -= factors[:, None] * matrix[i]
    solution = matrix[:, _UNKNOWNS:]
    for i in reversed(range(_UNKNOWNS)):
        known = np.einsum("jb,jkb->kb", matrix[i, i + 1 : _UNKNOWNS], solution[i + 1 :])
        solution[i] = (solution[i] - known) * inverse[i]
    return solution


BLOCK = 1024
"""Points in a block: numbers of their 20 000 neighbours of neighbours stay in the second-level cache."""

PAIRS = 300 * BLOCK
"""Neighbours of neighbours looked up at a time, those of eight blocks."""


def rings_in_blocks(triangulation: Triangulation) -> Iterator[tuple[AnyIndices, AnyIndices, BoolArray]]:
    """Points (b,) that have triangles, for each a column of points (s, b), and which of these count, s being 3 or more.

    Those of the two rings around the point, each once. Edges of triangles that close a set within a hemisphere do not
    count.
    """
    simplices = triangulation.simplices[state_of(triangulation).open]
    size = len(triangulation.points)
    indptr, ends = adjacency_of(edges_of(simplices), size)
    starts, counts = indptr[:-1].astype(np.int64), np.diff(indptr)
    # In the order of their first triangles, which lie near one another: so do the neighbours, in memory as well.
    earliest = np.empty(size, dtype=np.int32)
    earliest[simplices.ravel()[::-1]] = np.arange(simplices.size, dtype=np.int32)[::-1]
    used = np.flatnonzero(counts)
    if not len(used):
        return
    order = np.argsort(earliest[used])
    sums = np.cumsum(np.add.reduceat(counts.take(ends), starts[used])[order], dtype=np.int64)
    cuts = np.flatnonzero(np.diff(sums * (sums[-1] // PAIRS + 1) // (sums[-1] + 1))) + 1
    bits = size.bit_length()
    for points in np.split(used[order], cuts):
        # A pair is one number, place and neighbour, so that sorting finds what comes twice; a short one if that does.
        own: AnyIndices = np.arange(len(points), dtype=np.int32 if len(points) << bits < 2**31 else np.int64)
        number = counts[points]
        ring = ends[spans(starts[points], number)]
        further = counts[ring]
        # The ring of the ring, which holds the ring, as each of its points is in a triangle with another.
        places = np.repeat(np.repeat(own << bits, number), further)
        pairs = np.sort(places | ends[spans(starts[ring], further)])
        pairs = pairs.take(np.flatnonzero(np.concatenate([[True], pairs[1:] != pairs[:-1]])))
        begin = pairs.searchsorted(own << bits)
        number = np.diff(begin, append=len(pairs))
        order = np.argsort(number)
        while stop := len(order):
            # Of the rings that are about equally long: a column has room for the longest.
            slots = np.arange(max(3, number[order[-1]]))[:, None]
            order, some = np.split(order, [max(0, stop - max(1, min(BLOCK, 64 * BLOCK // len(slots))))])
            others = pairs.take(begin[some] + np.minimum(slots, number[some] - 1)) & ((1 << bits) - 1)
            itself = others == points[some]
            usable = (slots < number[some]) & ~itself
            yield points[some], np.where(itself, ends[starts[points[some]]], others), usable
