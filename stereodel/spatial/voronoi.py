"""`scipy.spatial.Voronoi` over the exact diagram of the plane."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import scipy.spatial

from stereodel._arrays import FloatArray, Indices, IntArray
from stereodel.spatial.compatibility import GrowingPoints
from stereodel.triangulation import PlanarVoronoi


class Voronoi(GrowingPoints, scipy.spatial.Voronoi):
    """Voronoi diagram of the plane with the interface of `scipy.spatial.Voronoi`, exact.

    Parameters
    ----------
    points : (npoints, 2) array_like
        Finite numbers. Copied. Points of more dimensions are handed over to SciPy, with an `InexactWarning`.
    furthest_site : bool, optional
        True is handed over to SciPy as well.
    incremental : bool, optional
        Whether `add_points` may be called.
    qhull_options : str, optional
        "Qc" (duplicates get the region of their point, else -1) and "Qz" (an empty region for a point at infinity) have
        the same meaning as in Qhull; "Qbb", "QJ", "Qs", "Qt", "Qx", "Q11", "Q12", "Q14" and "Pp" are accepted and
        ignored. Default: "Qbb Qc Qz", in incremental mode "Qc".
    strict : bool, optional
        Raise where SciPy does: `QhullError` for points on one line, two and one, ValueError for none.

    Attributes
    ----------
    points : (npoints, 2) array
    vertices : (nvertices, 2) array
        Exactly cocircular triangles share one, and no others.
    ridge_points : (nridges, 2) array of int32
        Points on both sides of each ridge.
    ridge_vertices : list of lists of int
        Both ends of each ridge; -1, which comes first, is at infinity.
    regions : list of lists of int
        Vertices of each region, counterclockwise; -1 once where it is unbounded. With "Qz" the first one is [].
    point_region : (npoints,) array of intp
        Region of each point; that of the equal point for a duplicate.
    ridge_dict : dict
        From pairs of points, as in `ridge_points`, to the row of `ridge_vertices`.
    ndim, npoints, min_bound, max_bound, furthest_site
        As in SciPy.

    Raises
    ------
    ValueError, TypeError
        For points that are not finite real numbers of shape (npoints, 2), and unknown options.
    QhullError
        Only if `strict`; otherwise collinear points have ridges [-1, -1] and no vertices.

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

    @cached_property
    def _diagram(self) -> PlanarVoronoi:
        return PlanarVoronoi(self._triangulation)

    @cached_property
    def vertices(self) -> FloatArray:
        """Voronoi vertices, (nvertices, 2)."""
        return np.array(self._diagram.vertices)

    @cached_property
    def ridge_points(self) -> IntArray:
        """Points on both sides of each ridge, (nridges, 2)."""
        return np.array(self._diagram.ridge_points)

    @cached_property
    def ridge_vertices(self) -> list[list[int]]:
        """Ends of each ridge; -1, which comes first, is at infinity."""
        rows = np.array(self._diagram.ridge_vertices)
        rows[rows[:, 1] < 0] = rows[rows[:, 1] < 0, ::-1]
        return rows.tolist()

    @cached_property
    def regions(self) -> list[list[int]]:
        """Vertices of each region, counterclockwise."""
        cells = self._diagram.regions
        return [[] for _ in range(self._empty)] + [
            cells[site] for site in np.flatnonzero(self._diagram.is_kept).tolist()
        ]

    @cached_property
    def point_region(self) -> Indices:
        """Region of each point, (npoints,)."""
        kept = self._diagram.is_kept
        number = np.cumsum(kept) - 1 + self._empty
        result: Indices = number[self._diagram.point_region].astype(np.intp)
        if "Qc" not in self._options:
            result[~kept] = -1
        return result

    @cached_property
    def ridge_dict(self) -> dict[tuple[int, int], list[int]]:
        """Ends of each ridge by its pair of points."""
        return dict(zip(map(tuple, self.ridge_points.tolist()), self.ridge_vertices, strict=True))

    @property
    def _empty(self) -> int:
        """Number of regions of points at infinity."""
        return int("Qz" in self._options)
