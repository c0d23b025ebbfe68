"""Natural neighbour interpolation (R. Sibson) in the plane and on the sphere."""

from __future__ import annotations

from typing import Any

import numpy as np

from stereodel._arrays import FloatArray, Indices
from stereodel._docs import shared
from stereodel.interpolation.interpolator import FAMILY, PrecisePoints
from stereodel.interpolation.weights import Shares, WeightedInterpolator
from stereodel.triangulation.delaunay import closing_triangles, threads_of


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
        if self._nearest_outside:
            outside = self._outside(queries, workers)
            result[outside] = self._of_nearest(queries[outside], workers)
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
        if (closing := closing_triangles(mesh)) is None:
            return space, (mesh.points, mesh.simplices, mesh.neighbors), (queries,), threads
        sites, asked = self._sites.exact, PrecisePoints(queries).exact
        triangles = mesh.points, sites.hi, sites.lo, mesh.simplices, mesh.neighbors
        return space, triangles, (queries, asked.hi, asked.lo, closing), threads
