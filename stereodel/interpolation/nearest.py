"""The value of the nearest point."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray
from stereodel._docs import shared
from stereodel.interpolation.interpolator import FAMILY
from stereodel.interpolation.weights import Shares, WeightedInterpolator
from stereodel.triangulation.delaunay import Triangulation


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
        return self._of_nearest(queries, workers)

    def _evaluate_gradient(self, queries: FloatArray, workers: int | None) -> FloatArray:
        size = 1 if len(self._values) else np.nan
        return np.zeros((*queries.shape, self._values.shape[1])) * size

    def _shares(self, queries: FloatArray, workers: int | None) -> Shares:
        if len(self._values) == 0:
            return Shares(np.zeros(len(queries) + 1, dtype=np.intp), np.zeros(0, dtype=np.int32), np.zeros(0))
        nearest = np.asarray(self.triangulation.nearest(queries, workers=workers))
        return Shares(np.arange(len(queries) + 1), nearest, np.ones(len(queries)))
