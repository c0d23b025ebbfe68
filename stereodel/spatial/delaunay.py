"""`scipy.spatial.Delaunay` over the exact triangulation of the plane.

Qhull sees it as the lower hull of the points lifted to a paraboloid.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
import numpy.typing as npt
import scipy.spatial

from stereodel._arrays import FloatArray, IntArray, as_scalar, as_vectors
from stereodel._docs import shared
from stereodel.constants import INSIDE_TOLERANCE
from stereodel.spatial.barycentric import NearMisses, transforms
from stereodel.spatial.compatibility import FAMILY, GrowingPoints, copied
from stereodel.triangulation.topology import adjacency_of


@shared(**FAMILY)
class Delaunay(GrowingPoints, scipy.spatial.Delaunay):
    """Delaunay triangulation of the plane with the interface of `scipy.spatial.Delaunay`, exact.

    {parameters}

    Notes
    -----
    Arrays can be written to, as in SciPy; the triangulation behind them does not change. Source:
    `stereodel.PlanarDelaunay`, whose rows have the same order.

    Examples
    --------
    >>> from stereodel.spatial import Delaunay
    >>> tri = Delaunay([[0, 0], [0, 1.1], [1, 0], [1, 1]])
    >>> tri.find_simplex([(0.1, 0.2), (1.5, 0.5)]) >= 0
    array([ True, False])
    >>> tri.vertex_neighbor_vertices[1].tolist()
    [1, 2, 3, 0, 3, 0, 3, 0, 1, 2]
    """

    simplices: IntArray = copied("_triangulation.simplices", "Triangles (nsimplex, 3), counterclockwise.")
    neighbors: IntArray = copied(
        "_triangulation.neighbors", "Neighbor opposite each corner, (nsimplex, 3), -1 for none."
    )
    convex_hull: IntArray = copied("_triangulation.convex_hull", "Edges of the hull, (nfaces, 2), counterclockwise.")

    @property
    def nsimplex(self) -> int:
        """Number of triangles."""
        return len(self._triangulation.simplices)

    @cached_property
    def good(self) -> IntArray:
        """Ones, (nsimplex,): Qhull's mark of facets that were asked for."""
        return np.ones(self.nsimplex, dtype=np.int32)

    @cached_property
    def coplanar(self) -> IntArray:
        """Rows [point, triangle, vertex] of points exactly equal to a vertex, (ncoplanar, 3); none without "Qc"."""
        dropped, kept = self._triangulation.duplicates.T if "Qc" in self._options else np.zeros((2, 0), dtype=np.int32)
        return np.column_stack([dropped, self._triangle_of_vertex[kept], kept])

    @cached_property
    def _triangle_of_vertex(self) -> IntArray:
        simplices = self._triangulation.simplices
        result = np.full(self.npoints, -1, dtype=np.int32)
        result[simplices[::-1].ravel()] = np.repeat(np.arange(len(simplices), dtype=np.int32)[::-1], 3)
        return result

    @cached_property
    def vertex_to_simplex(self) -> IntArray:
        """The lowest triangle of each point, (npoints,), -1 for none; a duplicate's is that of its vertex."""
        result = self._triangle_of_vertex.copy()
        result[self.coplanar[:, 0]] = self.coplanar[:, 1]
        return result

    @cached_property
    def vertex_neighbor_vertices(self) -> tuple[IntArray, IntArray]:
        """Neighbors of vertex k, ascending: ``indices[indptr[k]:indptr[k + 1]]`` of the tuple (indptr, indices)."""
        return adjacency_of(self._triangulation.edges, self.npoints)

    @cached_property
    def _paraboloid(self) -> tuple[float, float]:
        """Scale and shift: with "Qbb" heights run from 0 to the largest absolute coordinate."""
        points = self._triangulation.points
        if "Qbb" not in self._options or len(points) == 0:
            return 1.0, 0.0
        with np.errstate(over="ignore"):
            heights = (points**2).sum(axis=1)
        # With "Qz", Qhull puts a point at infinity at so many times the height of the highest point.
        low, high = float(heights.min()), float(heights.max()) * (1.1 if "Qz" in self._options else 1.0)
        if not low < high < np.inf:
            return 1.0, 0.0
        scale = float(np.abs(points).max()) / (high - low)
        return scale, -low * scale

    @property
    def paraboloid_scale(self) -> float:
        """Heights are ``paraboloid_scale * (x**2 + y**2) + paraboloid_shift``."""
        return self._paraboloid[0]

    @property
    def paraboloid_shift(self) -> float:
        """Height of the paraboloid at the origin."""
        return self._paraboloid[1]

    @cached_property
    def equations(self) -> FloatArray:
        """Unit normal, which points down, and offset of each triangle's plane on the paraboloid, (nsimplex, 4)."""
        # With d = b − a, e = c − a and the doubled area A = d×e, the circumcentre is a + q/2A where
        # q = (e_y|d|² − d_y|e|², d_x|e|² − e_x|d|²), and the plane is that of the paraboloid's gradient there: its
        # normal is that of (scale·(q + 2Aa), −A). Nothing is divided by the area, so that slivers have planes as well.
        a, b, c = self._corners.transpose(1, 0, 2)
        d, e = b - a, c - a
        dd, ee = (d * d).sum(axis=1), (e * e).sum(axis=1)
        area = np.maximum(d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0], 0.0)  # exactly positive, whatever rounding says
        q = np.column_stack([e[:, 1] * dd - d[:, 1] * ee, d[:, 0] * ee - e[:, 0] * dd])
        normals = np.column_stack([self.paraboloid_scale * (q + 2.0 * area[:, None] * a), -area])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        return np.column_stack([normals, -(normals * self.lift_points(a)).sum(axis=1)])

    @cached_property
    def transform(self) -> FloatArray:
        """Maps to barycentric coordinates, (nsimplex, 3, 2).

        ``transform[i, :2] @ (x - transform[i, 2])`` are those of x for the first two corners; NaN for triangles so thin
        that fewer than three digits would be right.
        """
        return transforms(self._corners)

    @cached_property
    def _corners(self) -> FloatArray:
        return self._triangulation.points[self._triangulation.simplices]

    @cached_property
    def _near_misses(self) -> NearMisses:
        return NearMisses(self._triangulation)

    def lift_points(self, x: npt.ArrayLike) -> FloatArray:
        """Points (..., 2) on the paraboloid, (..., 3)."""
        points = as_vectors(x, 2, "x")
        heights = (points**2).sum(axis=-1) * self.paraboloid_scale + self.paraboloid_shift
        return np.concatenate([points, heights[..., None]], axis=-1)

    def plane_distance(self, xi: npt.ArrayLike) -> FloatArray:
        """Signed distances (..., nsimplex) of lifted points from the planes of all triangles.

        They are positive where the triangle's circle holds the point (..., 2).
        """
        return self.lift_points(as_vectors(xi, 2, "xi")) @ self.equations[:, :3].T + self.equations[:, 3]

    def find_simplex(self, xi: npt.ArrayLike, bruteforce: bool = False, tol: float | None = None) -> IntArray:
        """Triangle that contains each point.

        Parameters
        ----------
        xi : (..., 2) array_like
        bruteforce : bool, optional
            Without effect: points just outside are compared with the nearest triangles alone.
        tol : float, optional
            How far below 0 barycentric coordinates may be, for points outside the hull. Default: 100 times the
            spacing of doubles at 1; 0 for exact answers.

        Returns
        -------
        (...) int32 array
            -1 for points outside, NaN and infinities; the lowest index on shared edges and vertices.

        Raises
        ------
        ValueError, TypeError
            For other shapes, values that are not real numbers, and a negative `tol`.

        Notes
        -----
        As in SciPy, a point in a triangle without `transform` is assigned to a neighbor that has one, if the coordinate
        there is not below -√tol.
        """
        slack = as_scalar(INSIDE_TOLERANCE if tol is None else tol, "tol", low=0.0)
        array = as_vectors(xi, 2, "xi", gaps=True)
        flat = array.reshape(-1, 2)
        finite = np.isfinite(flat).all(axis=1)
        queries = flat[finite]
        exact = np.asarray(self._triangulation.find_simplex(queries), dtype=np.int32)
        result = np.full(len(flat), -1, dtype=np.int32)
        result[finite] = self._near_misses.improve(queries, exact, slack)
        return result.reshape(array.shape[:-1])
