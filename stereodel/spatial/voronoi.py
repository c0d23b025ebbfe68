"""`scipy.spatial.Voronoi` over the exact diagram of the plane."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import scipy.spatial

from stereodel._arrays import FloatArray, Indices, IntArray
from stereodel._docs import shared
from stereodel.spatial.compatibility import FAMILY, GrowingPoints, copied
from stereodel.triangulation import PlanarVoronoi


@shared(**FAMILY)
class Voronoi(GrowingPoints, scipy.spatial.Voronoi):
    """Voronoi diagram of the plane with the interface of `scipy.spatial.Voronoi`, exact.

    {parameters}

    Notes
    -----
    Source: `stereodel.PlanarVoronoi`. Arrays and lists can be written to, as in SciPy.

    Examples
    --------
    >>> from stereodel.spatial import Voronoi
    >>> vor = Voronoi([[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2], [2, 0], [2, 1], [2, 2]])
    >>> vor.regions[vor.point_region[4]], vor.vertices.tolist()
    ([0, 2, 3, 1], [[0.5, 0.5], [0.5, 1.5], [1.5, 0.5], [1.5, 1.5]])
    """

    vertices: FloatArray = copied(
        "_diagram.vertices", "Voronoi vertices, (nvertices, 2): exactly cocircular triangles share one, and no others."
    )
    ridge_points: IntArray = copied("_diagram.ridge_points", "Points on both sides of each ridge, (nridges, 2).")

    @cached_property
    def _diagram(self) -> PlanarVoronoi:
        return PlanarVoronoi(self._triangulation)

    @cached_property
    def ridge_vertices(self) -> list[list[int]]:
        """Ends of each ridge; -1, which comes first, is at infinity."""
        rows = np.array(self._diagram.ridge_vertices)
        rows[rows[:, 1] < 0] = rows[rows[:, 1] < 0, ::-1]
        return rows.tolist()

    @cached_property
    def regions(self) -> list[list[int]]:
        """Vertices of each region, counterclockwise; -1 once where it is unbounded. With "Qz" the first one is []."""
        cells = self._diagram.regions
        at_infinity: list[list[int]] = [[]] if "Qz" in self._options else []
        return at_infinity + [cells[site] for site in np.flatnonzero(self._diagram.is_kept).tolist()]

    @cached_property
    def point_region(self) -> Indices:
        """Region of each point, (npoints,); that of the equal point for a duplicate."""
        kept = self._diagram.is_kept
        number = np.cumsum(kept) - 1 + ("Qz" in self._options)
        result: Indices = number[self._diagram.point_region].astype(np.intp)
        if "Qc" not in self._options:
            result[~kept] = -1
        return result

    @cached_property
    def ridge_dict(self) -> dict[tuple[int, int], list[int]]:
        """Row of `ridge_vertices` by the pair of points, as in `ridge_points`."""
        return dict(zip(map(tuple, self.ridge_points.tolist()), self.ridge_vertices, strict=True))
