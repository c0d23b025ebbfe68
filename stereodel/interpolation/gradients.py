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
from stereodel.interpolation.located import dot, lengths
from stereodel.sphere.vectors import crossed
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
    gradients = np.moveaxis(fit_gradients(triangulation, flat), 1, 2)
    return gradients.reshape(len(flat), *shape, triangulation.points.shape[1])


def fit_gradients(triangulation: Triangulation, values: FloatArray) -> FloatArray:
    """The same (n, d, k) for values (n, k), one a place."""
    gradients = np.full((*triangulation.points.shape, values.shape[1]), np.nan)
    sites = PrecisePoints(triangulation.points)
    known = ~np.isnan(values)
    # Columns without values at the same points share the work of the fit.
    groups = [slice(None)] if known.all() else [slice(k, k + 1) for k in range(values.shape[1])]
    for block, owners, others in rings_in_blocks(triangulation):
        for columns in groups:
            usable = known[others, columns].all(axis=1)
            fitted = _fit(sites, values[:, columns], block, owners[usable], others[usable])
            gradients[block, :, columns] = fitted
    dropped, kept = triangulation.duplicates.T
    gradients[dropped] = gradients[kept]
    return gradients


def _fit(
    sites: PrecisePoints, values: FloatArray, block: AnyIndices, owners: AnyIndices, others: AnyIndices
) -> FloatArray:
    """Gradients (b, d, k) at the points `block`; pairs of a place in it, sorted, and one of its neighbours."""
    axes = _axes(sites, block)
    gradients = np.full((len(block), axes.shape[2], values.shape[1]), np.nan)
    if len(owners) == 0:
        return gradients
    # Pairs are sorted by owner: sums over an owner's neighbours run from its start to the next.
    starts = np.flatnonzero(np.diff(owners, prepend=-1))
    fitted = owners[starts]
    columns, weights, unit = _columns(sites, block, owners, others, axes, starts)
    rises = (values[others] - values[block[owners]]).T * weights
    slopes = _solve(*_normal_equations(columns, np.ascontiguousarray(rises), starts))[:, :2]
    # The first two unknowns are the slopes along the axes, per unit of length of each point.
    with np.errstate(over="ignore", invalid="ignore"):
        gradients[fitted] = np.einsum("bij,bik->bjk", axes[fitted], slopes / unit[:, None, None])
    return gradients


def _normal_equations(columns: FloatArray, rises: FloatArray, starts: AnyIndices) -> tuple[FloatArray, FloatArray]:
    """Systems (b, 5, 5) and right sides (b, 5, k) of columns (5, p) and (k, p), summed from each start to the next."""
    normal = np.empty((len(starts), _UNKNOWNS, _UNKNOWNS))
    right = np.empty((len(starts), _UNKNOWNS, len(rises)))
    for i, column in enumerate(columns):
        for j in range(i + 1):
            normal[:, i, j] = normal[:, j, i] = np.add.reduceat(column * columns[j], starts)
        for j, rise in enumerate(rises):
            right[:, i, j] = np.add.reduceat(column * rise, starts)
    return normal, right


def _columns(
    sites: PrecisePoints,
    block: AnyIndices,
    owners: AnyIndices,
    others: AnyIndices,
    axes: FloatArray,
    starts: AnyIndices,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Weighted ξ, η, |d|², ξ² − η², 2ξη of each pair (5, p), its weight, and the unit of length of each point."""
    # The unit u is the distance of the third neighbour. Weights are smaller by (u/r)² where r is longer; so columns are
    # made of d/max(u, r), which is one at most, however much longer the longest distance is.
    differences = sites.minus(others, sites, block[owners])
    size = lengths(differences)[:, 0]
    counts = np.diff(starts, append=len(owners))
    unit = _third_least(size, owners, starts)
    of_pair = np.repeat(unit, counts)
    longer = np.maximum(size, of_pair)
    # (1 − r/R)², R a tenth beyond the farthest: the weight without its 1/r², which (u/max(u, r))² replaces below.
    share = (1.0 - size / np.repeat(1.1 * np.maximum.reduceat(size, starts), counts)) ** 2
    # Coordinates along the axes of the owner, of d over max(u, r).
    nearer = of_pair / longer
    xi, eta = np.einsum("pij,pj->ip", axes[owners], differences / longer[:, None])
    r = size / longer
    columns = np.stack([xi * nearer, eta * nearer, r * r, xi * xi - eta * eta, 2.0 * xi * eta])
    return columns * share, share * nearer * nearer, unit


def _third_least(size: FloatArray, owners: AnyIndices, starts: AnyIndices) -> FloatArray:
    """The third smallest length of each owner, equal lengths counted separately; the largest if fewer than three."""
    # Twice, one smallest of the remaining lengths is set aside; the smallest of the rest is the third.
    rest, counts = size.copy(), np.diff(starts, append=len(owners))
    for _ in range(2):
        least = np.flatnonzero(rest == np.repeat(np.minimum.reduceat(rest, starts), counts))
        rest[least[np.flatnonzero(np.diff(owners[least], prepend=-1))]] = np.inf
    return np.minimum(np.minimum.reduceat(rest, starts), np.maximum.reduceat(size, starts))


def _axes(sites: PrecisePoints, block: AnyIndices) -> FloatArray:
    """Two unit vectors of the tangent plane at each point, (b, 2, d)."""
    if not sites.curved:
        return np.broadcast_to(np.eye(2), (len(block), 2, 2))
    up = sites.rounded[block]
    first = crossed(np.eye(3)[np.abs(up).argmin(axis=1)], up)
    first /= np.sqrt(dot(first, first))
    return np.stack([first, crossed(up, first)], axis=1)


def _solve(normal: FloatArray, right: FloatArray) -> FloatArray:
    """Solve symmetric systems (b, 5, 5) by elimination in order; unknowns that are not determined are zero."""
    # A pivot is the part of a column's square that the columns before it do not explain.
    squares = np.einsum("bii->bi", normal).copy()
    matrix = np.concatenate([normal, right], axis=2)
    inverse = np.zeros((len(normal), _UNKNOWNS))
    for i in range(_UNKNOWNS):
        determined = matrix[:, i, i] > UNDETERMINED * squares[:, i]
        np.divide(1.0, matrix[:, i, i], out=inverse[:, i], where=determined)
        factors = matrix[:, i + 1 :, i] * inverse[:, i, None]
        matrix[:, i + 1 :] -= factors[:, :, None] * matrix[:, None, i]
    solution = matrix[:, :, _UNKNOWNS:]
    for i in reversed(range(_UNKNOWNS)):
        known = np.einsum("bj,bjk->bk", matrix[:, i, i + 1 : _UNKNOWNS], solution[:, i + 1 :])
        solution[:, i] = (solution[:, i] - known) * inverse[:, i, None]
    return solution


BLOCK = 4096
"""Points in a block, with about 80 000 neighbours of neighbours."""


def rings_in_blocks(triangulation: Triangulation) -> Iterator[tuple[AnyIndices, AnyIndices, AnyIndices]]:
    """Points (b,) that have triangles, and pairs: a place among them, in order, and a point of the two rings there.

    Each pair comes once. Edges of triangles that close a set within a hemisphere do not count.
    """
    simplices = triangulation.simplices[state_of(triangulation).open]
    size = len(triangulation.points)
    used = np.unique(simplices)
    indptr, ends = adjacency_of(edges_of(simplices), size)
    starts, counts = indptr[:-1].astype(np.int64), np.diff(indptr)

    def around(points: AnyIndices) -> tuple[AnyIndices, AnyIndices]:
        """Pairs of a place in `points` and a point that an edge joins to the point there."""
        number = counts[points]
        return np.repeat(np.arange(len(points)), number), ends[spans(starts[points], number)].astype(np.int64)

    for first in range(0, len(used), BLOCK):
        points = used[first : first + BLOCK]
        owners, ring = around(points)
        places, second = around(ring)
        # A pair is one number, owner · size + neighbour, so that sorting finds what both rings have twice.
        pairs = np.sort(np.concatenate([owners * size + ring, owners[places] * size + second]))
        owners, others = np.divmod(pairs[np.diff(pairs, prepend=-1) > 0], size)
        apart = others != points[owners]
        yield points, owners[apart], others[apart]
