"""Voronoi diagram of the plane, the dual of the Delaunay triangulation (row P3 of the ledger)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, Indices, as_bounds, as_scalar, locked
from stereodel._docs import shared
from stereodel._spaces import PLANE
from stereodel.triangulation.diagram import FAMILY, Diagram
from stereodel.triangulation.planar_delaunay import PlanarDelaunay


@shared(**FAMILY)
class PlanarVoronoi(Diagram[PlanarDelaunay], surface=PLANE):
    """Voronoi diagram of points in the plane.

    Parameters
    ----------
    points : (n, 2) array_like or PlanarDelaunay
        Sites, or their triangulation, which is then not computed again.
    workers : int, optional
        Threads; -1 for all processors. By default as for `PlanarDelaunay`. Does not affect the result.

    Attributes
    ----------
    points : (n, 2) array
    vertices : (v, 2) array
        Circumcentres of the Delaunay triangles; exactly cocircular triangles share one. Their numbers depend on the
        sites alone: in the order of the three lowest sites of each circle.
    regions : list of lists of int
        Vertices of each point's cell, counterclockwise; unbounded cells begin with -1, duplicates have [].
    {flat_regions}
    region_neighbors : array of int32
        The site beyond the ridge from each entry of `region_indices` to the next one of its cell; -1 in strips.
    {ridge_points}
    ridge_vertices : (r, 2) array of int32
        Start and end of each ridge, such that site i is on its left; -1 at infinity.
    {numbers}

    Raises
    ------
    ValueError, TypeError
        For points that are not finite real numbers of shape (n, 2).

    Notes
    -----
    The exact incircle predicate decides which triangles share a vertex, so no ridge has length zero and the
    diagram does not depend on the tie rule. Points on one line have no vertices: parallel ridges [-1, -1] between
    strips. Source: the paper's duality (row P3); F. Aurenhammer, "Voronoi diagrams", ACM Computing Surveys 23 (1991).

    Examples
    --------
    >>> diagram = PlanarVoronoi([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> print(diagram.vertices)
    [[1. 1.]]
    >>> diagram.regions
    [[-1, 0], [-1, 0], [-1, 0], [-1, 0]]
    """

    def _set_flat(self) -> FloatArray:
        cells, ridges = _kernel.plane.flat_diagram(self.points, self._order)
        self._ridges = locked(ridges), locked(np.full_like(ridges, -1))
        self._set_cells(*cells)
        return np.zeros((0, 2))

    def areas(self, *, radius: float = 1.0) -> FloatArray:
        """Area of each point's cell, (n,): 0 for duplicates, infinite for unbounded cells.

        Parameters
        ----------
        radius : float
            Length of the unit of the coordinates, above 0: areas are multiplied by its square.

        Notes
        -----
        The sum over the neighbours q of a site p and the two vertices of their ridge of |D|² E·F / (8 D×E), with r the
        third site of the vertex, D = q − p, E = r − p, F = r − q: the triangle of p, the middle of p and q, and the
        vertex (half of |D|/2 times |D|/2 cot of the angle at r). No rounded vertex enters, so that the areas of tiny
        cells far from the origin are as accurate as others, to some 1e-14 and never worse than 2e-12: where a bound
        says that doubles may not do, double-double takes over, and then as many digits as are needed. Areas beyond the
        range of doubles are infinite or 0.
        """
        scale = as_scalar(radius, "radius", low=0.0, open_low=True)
        if len(self.vertices) == 0:
            return np.where(np.diff(self.region_offsets) > 0, np.inf, 0.0) * scale**2
        return self._cell_areas() * scale**2

    def centroids(self) -> FloatArray:
        """Centroid of each point's cell, (n, 2); NaN for unbounded cells and for duplicates.

        Notes
        -----
        Computed from differences of sites, like `areas`; within 2e-12 of the cell's size, besides rounding.

        Examples
        --------
        >>> print(PlanarVoronoi([[0, 0], [2, 0], [0, 2], [-2, 0], [0, -4]]).centroids()[0])
        [ 0.  -0.5]
        """
        if len(self.vertices) == 0:
            return np.full((len(self.points), 2), np.nan)
        return self._cell_centroids()

    def segments(self, bounds: npt.ArrayLike) -> tuple[FloatArray, Indices]:
        """The parts of the ridges that lie in a rectangle, for drawing.

        Parameters
        ----------
        bounds : (4,) array_like
            (xmin, ymin, xmax, ymax).

        Returns
        -------
        segments : (k, 2, 2) array
            Start and end of each visible piece, in the ridge's direction.
        ridge : (k,) array of int
            Its row in `ridge_points`. Ridges outside are left out.

        Raises
        ------
        ValueError
            Unless xmin < xmax and ymin < ymax.

        Notes
        -----
        Each ridge is a segment t₀ ≤ t ≤ t₁ of the line m + t·d through the midpoint m of its sites, d their difference
        rotated by 90°; the rectangle cuts another segment out of it. A vertex that is very far away costs no accuracy.

        Examples
        --------
        >>> segments, ridge = PlanarVoronoi([[0, 0], [2, 0]]).segments((-1, -1, 3, 1))
        >>> print(segments, ridge)
        [[[ 1. -1.]
          [ 1.  1.]]] [0]
        """
        # The line of each ridge: the middle of its sites, and their difference turned left and scaled to about one.
        left, bottom, right, top = as_bounds(bounds)
        p, q = self.points[self.ridge_points[:, 0]], self.points[self.ridge_points[:, 1]]
        middle = p + (q - p) / 2
        along = np.column_stack([p[:, 1] - q[:, 1], q[:, 0] - p[:, 0]])
        along = np.ldexp(along, -np.frexp(np.abs(along).max(axis=1, keepdims=True))[1])
        # Two stretches of the line, of the ridge and of the rectangle; what both have is seen.
        start, end = np.full(len(middle), -np.inf), np.full(len(middle), np.inf)
        for k, t in enumerate((start, end)):
            bounded = self.ridge_vertices[:, k] >= 0
            offset = self.vertices[self.ridge_vertices[bounded, k]] - middle[bounded]
            t[bounded] = (offset * along[bounded]).sum(axis=1) / (along[bounded] ** 2).sum(axis=1)
        enter, leave = _inside(np.array([left, bottom]), np.array([right, top]), middle, along)
        first, last = np.maximum(start, enter), np.minimum(end, leave)
        seen = np.flatnonzero(first < last)
        ends = middle[seen, None] + np.column_stack([first, last])[seen, :, None] * along[seen, None]
        # An end that is the ridge's own equals its vertex exactly.
        whole = np.column_stack([first == start, last == end])[seen]
        ends[whole] = self.vertices[self.ridge_vertices[seen][whole]]
        return ends, seen


def _inside(low: FloatArray, high: FloatArray, middle: FloatArray, along: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Parameters where lines enter and leave a rectangle (Liang and Barsky, 1984); enter > leave if they miss it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        at_low, at_high = (low - middle) / along, (high - middle) / along
    between = (low <= middle) & (middle <= high)
    parallel = along == 0
    enter = np.where(parallel, np.where(between, -np.inf, np.inf), np.minimum(at_low, at_high))
    leave = np.where(parallel, np.where(between, np.inf, -np.inf), np.maximum(at_low, at_high))
    return enter.max(axis=1), leave.min(axis=1)
