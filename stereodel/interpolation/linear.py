"""Linear interpolation in triangles, on the sphere along rays (row P22 of the ledger: triangulated networks)."""

from __future__ import annotations

import numpy as np

from stereodel._arrays import AnyIndices, FloatArray
from stereodel._docs import shared
from stereodel.curves.ragged import offsets_of
from stereodel.interpolation.interpolator import FAMILY, TriangleInterpolator
from stereodel.interpolation.triangles import LocatedQueries
from stereodel.interpolation.weights import Shares, WeightedInterpolator


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
        weights = LocatedQueries(self._sites, corners, queries).weights()
        values = self._values[corners]
        # From the heaviest corner, so that values at points are reproduced exactly.
        first = np.take_along_axis(values, weights.argmax(axis=1)[:, None, None], axis=1)
        one, two, three = np.moveaxis(weights[:, :, None] * (values - first), 1, 0)
        return first[:, 0] + (one + two + three)

    def _slope_within(self, corners: AnyIndices, queries: FloatArray) -> FloatArray:
        return LocatedQueries(self._sites, corners, queries).slope([self._values[corners[:, k]] for k in range(3)])

    def _shares(self, queries: FloatArray, workers: int | None) -> Shares:
        weights = np.empty((len(queries), 3))
        outside = self._in_blocks(
            weights, queries, workers, lambda corners, at: LocatedQueries(self._sites, corners, at).weights()
        )
        found = np.asarray(self.triangulation.find_simplex(queries, workers=workers))
        inside = found >= 0
        corners = self.triangulation.simplices[found[inside]]
        shares = Shares(offsets_of(3 * inside), corners.ravel(), weights[inside].ravel())
        return self._with_nearest(shares, queries, outside, workers)
