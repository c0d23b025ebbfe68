"""Interpolators by weights: nearest point, linear in triangles, natural neighbours.

Linear interpolation is of row P22 of the ledger, triangulated networks.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, FloatArray, Indices
from stereodel._docs import shared
from stereodel.curves.ragged import offsets_of
from stereodel.interpolation.interpolator import FAMILY, PrecisePoints, TriangleInterpolator
from stereodel.interpolation.located import LocatedQueries, heaviest
from stereodel.interpolation.weights import Shares, WeightedInterpolator
from stereodel.triangulation.delaunay import Triangulation, state_of, threads_of


@shared(**FAMILY)
class NearestInterpolator(WeightedInterpolator):
    """The value of the nearest point, exactly the nearest: constant on Voronoi cells.

    {points}
    values : (n, ...) array_like
        A number or an array of numbers for each point; NaN is a value like any other.

    {attributes}

    {raises}

    Notes
    -----
    Defined everywhere; NaN if there are no points. Of several equally near points, the lowest index counts. The
    gradient is zero.

    Examples
    --------
    >>> height = NearestInterpolator([[0, 0], [4, 0], [0, 4]], [1.0, 2.0, 3.0])
    >>> height([[1, 0], [3, 1], [-9, 9]]).tolist()
    [1.0, 2.0, 3.0]
    """

    def __init__(self, points: npt.ArrayLike | Triangulation, values: npt.ArrayLike) -> None:
        super().__init__(points, values)

    def _evaluate(self, queries: FloatArray, workers: int | None) -> FloatArray:
        if len(self._values) == 0:
            return np.full((len(queries), self._values.shape[1]), np.nan)
        return self._values[self.triangulation.nearest(queries, workers=workers)]

    def _evaluate_gradient(self, queries: FloatArray, workers: int | None) -> FloatArray:
        return np.full((*queries.shape, self._values.shape[1]), 0.0 if len(self._values) else np.nan)

    def _shares(self, queries: FloatArray, workers: int | None) -> Shares:
        if len(self._values) == 0:
            return Shares(np.zeros(len(queries) + 1, dtype=np.intp), np.zeros(0, dtype=np.int32), np.zeros(0))
        nearest = np.asarray(self.triangulation.nearest(queries, workers=workers))
        return Shares(np.arange(len(queries) + 1), nearest, np.ones(len(queries)))


@shared(**FAMILY)
class LinearInterpolator(WeightedInterpolator, TriangleInterpolator):
    """Linear in each triangle, continuous across them.

    {function}

    Notes
    -----
    In a triangle with corners a, b, c the value is λ_a f_a + λ_b f_b + λ_c f_c with barycentric coordinates λ. On the
    sphere they are those of the point where the ray through the query meets the plane triangle of the unit vectors,
    λ_a = det[q b c] / (det[q b c] + det[a q c] + det[a b q]), and so on.

    Values at the points are reproduced exactly, and lie between those of the corners everywhere. Linear functions of
    the plane are reproduced; on the sphere constants are, and linear functions of (x, y, z), the harmonics of degree
    1, are those of the point on the plane triangle: too small in amount by its depth below the sphere. The error for
    smooth functions is of order h² for edges of length h, that of the gradient, which jumps at edges, of order h. On
    an edge or at a point the gradient is that of the triangle of lowest index. A NaN value propagates to all triangles
    at its point. Outside means in no triangle: beyond the convex hull, on the sphere in triangles that are
    `closing`.

    The triangle that contains a query is decided exactly; weights are accurate even in the thinnest triangles.

    References
    ----------
    R. J. Renka, "Interpolation of data on the surface of a sphere", ACM TOMS 10 (1984): coordinates in the plane of the
    triangle.

    Examples
    --------
    >>> plane = LinearInterpolator([[0, 0], [4, 0], [0, 4], [4, 4]], [0.0, 4.0, 8.0, 12.0])
    >>> plane([[1, 2], [3, 3], [5, 0]]).tolist(), plane.gradient([1, 2]).tolist()
    ([5.0, 9.0, nan], [1.0, 2.0])
    >>> octahedron = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
    >>> LinearInterpolator(octahedron, [6.0, 9.0, 0.0, 0.0, 3.0, 0.0])([1, 1, 1]).item()
    6.0
    """

    def _within(self, corners: AnyIndices, queries: FloatArray) -> FloatArray:
        located = LocatedQueries(self._sites, corners, queries)
        weights, values = located.weights()[:, :, None], self._values.take(located.numbers, axis=0)
        # From the heaviest corner, so that values at points are reproduced exactly.
        first = heaviest(weights, values)
        one, two, three = weights * (values - first)
        return np.asarray(first + (one + two + three))

    def _slope_within(self, corners: AnyIndices, queries: FloatArray) -> FloatArray:
        found = LocatedQueries(self._sites, corners, queries).slope([self._values[corners[:, k]].T for k in range(3)])
        return np.moveaxis(found, -1, 0)

    def _shares(self, queries: FloatArray, workers: int | None) -> Shares:
        weights = np.empty((len(queries), 3))
        found = self._in_blocks(
            weights, queries, workers, lambda corners, at: LocatedQueries(self._sites, corners, at).weights().T
        )
        inside = found >= 0
        corners = self.triangulation.simplices[found[inside]]
        shares = Shares(offsets_of(3 * inside), corners.ravel(), weights[inside].ravel())
        return self._with_nearest(shares, queries, np.flatnonzero(~inside), workers)


@shared(**FAMILY)
class NaturalNeighborInterpolator(WeightedInterpolator):
    """Each point is weighted by the area that a Voronoi cell around the query would take from its own (Sibson).

    {function}

    Notes
    -----
    If the query were a point, its cell would take the area A_i from the cell of point i; the value is
    Σ A_i f_i / Σ A_i. On the sphere cells and areas are spherical. How cocircular points are triangulated does not
    matter. The function is continuous, and differentiable except at the points, where the gradient is NaN; with the
    edge between the new cell and that of point i, ∇A_i = ∫ (y − q) dy / |p_i − q|.

    Values at the points are reproduced exactly, and lie between those of the neighbours everywhere. Linear functions of
    the plane are reproduced, on the sphere constants; the error for smooth functions is of order h². On the hull of the
    plane the values are linear along its edges, and the gradient is NaN. A NaN value propagates to where its point
    takes part. Outside means in no triangle, as in `LinearInterpolator`.

    The cells that lose area are decided exactly; areas are rounded.

    References
    ----------
    R. Sibson, "A brief description of natural neighbour interpolation", in: V. Barnett (ed.), Interpreting Multivariate
    Data (1981). B. Piper, "Properties of local coordinates based on Dirichlet tesselations", Computing Suppl. 8 (1993).

    Examples
    --------
    >>> square = NaturalNeighborInterpolator([[0, 0], [4, 0], [4, 4], [0, 4]], [0.0, 1.0, 2.0, 1.0])
    >>> square([[2, 2], [1, 2]]).tolist(), square.gradient([2, 2]).tolist()
    ([1.0, 0.75], [0.25, 0.25])
    """

    def _evaluate(self, queries: FloatArray, workers: int | None) -> FloatArray:
        result = self._ask(queries, workers, gradients=False)[:, 0]
        if self._fills_outside:
            rows, points = self._beyond(queries, self._outside(queries, workers), workers)
            result[rows] = self._values[points]
        return result

    def _evaluate_gradient(self, queries: FloatArray, workers: int | None) -> FloatArray:
        result = self._ask(queries, workers, gradients=True)
        if self._nearest_outside:
            result[self._outside(queries, workers)] = 0.0
        return result

    def _outside(self, queries: FloatArray, workers: int | None) -> Indices:
        return np.flatnonzero(np.asarray(self.triangulation.find_simplex(queries, workers=workers)) < 0)

    def _ask(self, queries: FloatArray, workers: int | None, *, gradients: bool) -> FloatArray:
        space, mesh, places, threads = self._for_kernel(queries, workers)
        return space.natural_neighbors(*mesh, self._values, *places, gradients, threads, True)

    def _shares(self, queries: FloatArray, workers: int | None) -> Shares:
        space, mesh, places, threads = self._for_kernel(queries, workers)
        shares = Shares(*space.natural_neighbor_weights(*mesh, *places, threads, True))
        return self._with_nearest(shares, queries, self._outside(queries, workers), workers)

    def _for_kernel(
        self, queries: FloatArray, workers: int | None
    ) -> tuple[Any, tuple[Any, ...], tuple[Any, ...], int]:
        """The kernel's space, mesh, queries (on the sphere with what double-doubles add), and number of threads."""
        mesh, space = self.triangulation, self.triangulation.surface.kernel
        threads = threads_of(mesh, workers, len(queries))
        if (closing := state_of(mesh).closing) is None:
            return space, (mesh.points, mesh.simplices, mesh.neighbors), (queries,), threads
        exact = self._sites.exact, PrecisePoints(queries).exact
        sites, asked = ((np.ascontiguousarray(e.hi.T), np.ascontiguousarray(e.lo.T)) for e in exact)
        return space, (mesh.points, *sites, mesh.simplices, mesh.neighbors), (queries, *asked, closing), threads
