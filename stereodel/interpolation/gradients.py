"""Gradients at the points, estimated from the values around them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, FloatArray
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
    gradients = np.full((dimension, len(fields), size), np.nan)
    known = ~np.isnan(fields)
    # Fields without values at the same points share the work of the fit.
    groups = [slice(None)] if known.all() else [slice(k, k + 1) for k in range(len(fields))]
    for block, owners, others in rings_in_blocks(triangulation):
        for columns in groups:
            usable = slice(None) if known[columns].all() else known[columns, others].all(axis=0)
            fitted = _fit(sites, fields[columns], block, owners[usable], others[usable])
            gradients[:, columns, block] = fitted
    dropped, kept = triangulation.duplicates.T
    gradients[:, :, dropped] = gradients[:, :, kept]
    return gradients


def _fit(
    sites: PrecisePoints, values: FloatArray, block: AnyIndices, owners: AnyIndices, others: AnyIndices
) -> FloatArray:
    """Gradients (d, k, b) at the points `block`; pairs of a place in it, sorted, and one of its neighbours."""
    gradients = np.full((len(sites.rounded), len(values), len(block)), np.nan)
    if len(owners) == 0:
        return gradients
    # Pairs are sorted by owner: sums over an owner's neighbours run from its start to the next.
    starts = np.flatnonzero(np.concatenate([[True], owners[1:] != owners[:-1]]))
    fitted, counts = owners[starts], np.diff(starts, append=len(owners))
    here = sites.take(block[fitted])
    axes = _axes(here)
    differences = sites.take(others) - here.take(np.repeat(np.arange(len(fitted)), counts))
    columns, weights, unit = _columns(differences, axes, starts, counts)
    rises = (values.take(others, axis=1) - np.repeat(values.take(block[fitted], axis=1), counts, axis=1)) * weights
    slopes = _solve(*_normal_equations(columns, rises, starts))[:2]
    # The first two unknowns are the slopes along the axes, per unit of length of each point.
    with np.errstate(over="ignore", invalid="ignore"):
        one, other = slopes / unit
        gradients[:, :, fitted] = axes[0][:, None] * one + axes[1][:, None] * other
    return gradients


def _normal_equations(columns: FloatArray, rises: FloatArray, starts: AnyIndices) -> tuple[FloatArray, FloatArray]:
    """Systems (5, 5, b) and right sides (5, k, b) of columns (5, p) and (k, p), summed from each start to the next."""
    normal = np.empty((_UNKNOWNS, _UNKNOWNS, len(starts)))
    right = np.empty((_UNKNOWNS, len(rises), len(starts)))
    for i, column in enumerate(columns):
        for j in range(i + 1):
            normal[i, j] = normal[j, i] = np.add.reduceat(column * columns[j], starts)
        for j, rise in enumerate(rises):
            right[i, j] = np.add.reduceat(column * rise, starts)
    return normal, right


def _columns(
    differences: FloatArray, axes: FloatArray, starts: AnyIndices, counts: AnyIndices
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Weighted ξ, η, |d|², ξ² − η², 2ξη of each pair (5, p), its weight, and the unit of length of each point."""
    # The unit u is the distance of the third neighbour. Weights are smaller by (u/r)² where r is longer; so columns are
    # made of d/max(u, r), which is one at most, however much longer the longest distance is.
    size = lengths(differences)[0]
    unit = _third_least(size, starts, counts)
    of_pair = np.repeat(unit, counts)
    longer = np.maximum(size, of_pair)
    # (1 − r/R)², R a tenth beyond the farthest: the weight without its 1/r², which (u/max(u, r))² replaces below.
    share = (1.0 - size / np.repeat(1.1 * np.maximum.reduceat(size, starts), counts)) ** 2
    # Coordinates along the axes of the owner, of d over max(u, r).
    nearer = of_pair / longer
    differences /= longer
    xi, eta = (inner(np.repeat(axis, counts, axis=1), differences) for axis in axes)
    r = size / longer
    columns = np.stack([xi * nearer, eta * nearer, r * r, xi * xi - eta * eta, 2.0 * xi * eta])
    return columns * share, share * nearer * nearer, unit


def _third_least(size: FloatArray, starts: AnyIndices, counts: AnyIndices) -> FloatArray:
    """The third smallest length of each owner, equal lengths counted separately; the largest if fewer than three."""
    # Twice, one smallest of the remaining lengths is set aside; the smallest of the rest is the third.
    rest, owners = size.copy(), np.repeat(np.arange(len(starts)), counts)
    for _ in range(2):
        least = np.flatnonzero(rest == np.repeat(np.minimum.reduceat(rest, starts), counts))
        rest[least[np.flatnonzero(np.diff(owners[least], prepend=-1))]] = np.inf
    return np.minimum(np.minimum.reduceat(rest, starts), np.maximum.reduceat(size, starts))


def _axes(places: PrecisePoints) -> FloatArray:
    """Two unit vectors of the tangent plane at each point, (2, d, b)."""
    up = places.rounded
    if not places.curved:
        return np.broadcast_to(np.eye(2)[:, :, None], (2, *up.shape))
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


def rings_in_blocks(triangulation: Triangulation) -> Iterator[tuple[AnyIndices, AnyIndices, AnyIndices]]:
    """Points (b,) that have triangles, and pairs: a place among them, in order, and a point of the two rings there.

    Each pair comes once. Edges of triangles that close a set within a hemisphere do not count.
    """
    simplices = triangulation.simplices[state_of(triangulation).open]
    size = len(triangulation.points)
    indptr, ends = adjacency_of(edges_of(simplices), size)
    starts, counts = indptr[:-1].astype(np.int64), np.diff(indptr)
    # A pair is one number, place and neighbour, so that sorting finds what comes twice; a short one if that is enough.
    bits = size.bit_length()
    kind = np.int32 if BLOCK << bits < 2**31 else np.int64
    ends = ends.astype(kind)
    # In the order of their first triangles, which lie near one another: so do the neighbours, in memory as well.
    earliest = np.empty(size, dtype=np.int32)
    earliest[simplices.ravel()[::-1]] = np.arange(simplices.size, dtype=np.int32)[::-1]
    used = np.flatnonzero(counts)
    used = used[np.argsort(earliest[used])]

    for first in range(0, len(used), BLOCK):
        points = used[first : first + BLOCK]
        number = counts[points]
        ring = ends[spans(starts[points], number)]
        further = counts[ring]
        # The ring of the ring, which holds the ring, as each of its points is in a triangle with another.
        own: AnyIndices = np.arange(len(points), dtype=kind)
        places = np.repeat(np.repeat(own << bits, number), further)
        pairs = np.sort(places | ends[spans(starts[ring], further)])
        pairs = pairs.take(np.flatnonzero(np.concatenate([[True], pairs[1:] != pairs[:-1]])))
        owners, others = pairs >> bits, pairs & ((1 << bits) - 1)
        apart = np.flatnonzero(others != points.take(owners))
        yield points, owners.take(apart), others.take(apart)
