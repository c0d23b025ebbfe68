"""Once differentiable interpolation from gradients at the points."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, FloatArray, as_values, locked
from stereodel._docs import shared
from stereodel.interpolation.gradients import fit_gradients
from stereodel.interpolation.interpolator import FAMILY, TriangleInterpolator, one_value_a_place
from stereodel.interpolation.side_vertex import side_vertex, side_vertex_slope
from stereodel.interpolation.triangles import LocatedQueries, dot
from stereodel.triangulation.delaunay import Triangulation


@shared(**FAMILY)
class SmoothInterpolator(TriangleInterpolator):
    """Smooth: the function and its gradient are continuous, by Renka's method on the sphere, by Nielson's in the plane.

    {points}
    {values}
    gradients : (n, ..., 2) or (n, ..., 3) array_like, optional
        Gradients at the points, per unit of length or per radian; on the sphere their radial components are ignored. By
        default those of `estimate_gradients`.
    {extrapolate}

    {attributes}
    gradients : (n, ..., 2) or (n, ..., 3) array
        As used, read-only.

    Raises
    ------
    ValueError, TypeError
        As for the triangulation; if a value or gradient is infinite or not real, or their number differs from that of
        the points.

    Notes
    -----
    In each triangle three functions are blended. Each joins one corner to the points of the opposite side by cubics,
    along the side and along the line from the corner, which have the given values and slopes at their ends; the slope
    across a side is linear. Lines are straight in the plane and great circles on the sphere, without tension.

    Values and gradients at the points are reproduced. With exact gradients, so are quadratic polynomials of the plane
    and constants on the sphere; the error for smooth functions is of order h³ for edges of length h, that of the
    gradient of order h², with estimated gradients too. The function may leave the range of the values, and in
    thin triangles, as between two points that nearly meet and a far one, its gradient may be large. NaN values and
    gradients that are not finite propagate only to the triangles at their point. Coordinates may be as small
    and as large as doubles are. Outside means in no triangle, as in
    `LinearInterpolator`.

    References
    ----------
    G. M. Nielson, "The side-vertex method for interpolation in triangles", J. Approx. Theory 25 (1979). R. J. Renka,
    "Interpolation of data on the surface of a sphere", ACM TOMS 10 (1984), and Algorithm 623 there.

    Examples
    --------
    >>> x, y = np.mgrid[:3, :3].reshape(2, -1).astype(float)
    >>> hill = SmoothInterpolator(np.column_stack([x, y]), x * (2 - x))
    >>> hill([0.5, 1.25]).round(9).item(), (hill.gradient([0.5, 1.25]).round(9) + 0.0).tolist()
    (0.75, [1.0, 0.0])
    """

    def __init__(
        self,
        points: npt.ArrayLike | Triangulation,
        values: npt.ArrayLike,
        *,
        gradients: npt.ArrayLike | None = None,
        extrapolate: str | None = None,
    ) -> None:
        super().__init__(points, values, extrapolate=extrapolate)
        slopes = fit_gradients(self.triangulation, self._values) if gradients is None else self._given(gradients)
        self._gradients = locked(slopes)
        shaped = np.moveaxis(slopes, 1, 2).reshape(*self.values.shape, slopes.shape[1])
        self.gradients = locked(np.ascontiguousarray(shaped))

    def _given(self, gradients: npt.ArrayLike) -> FloatArray:
        """Checked gradients (n, d, k), tangent, one a place."""
        size, dimension = self.triangulation.points.shape
        array = as_values(gradients, size, "gradients")
        expected = (*self.values.shape, dimension)
        if array.shape != expected:
            raise ValueError(f"gradients must have shape {expected}, a vector for each value, got {array.shape}")
        merged = one_value_a_place(self.triangulation, array.reshape(size, -1))
        vectors = merged.reshape(size, self._values.shape[1], dimension)
        if self._sites.curved:
            up = self._sites.rounded[:, None, :]
            vectors = vectors - up * dot(vectors, np.broadcast_to(up, vectors.shape))
        return np.array(np.moveaxis(vectors, 2, 1))

    def _within(self, corners: AnyIndices, queries: FloatArray) -> FloatArray:
        located = LocatedQueries(self._sites, corners, queries)
        return side_vertex(located, self._values[corners], self._gradients[corners])

    def _slope_within(self, corners: AnyIndices, queries: FloatArray) -> FloatArray:
        located = LocatedQueries(self._sites, corners, queries)
        return side_vertex_slope(located, self._values[corners], self._gradients[corners])
