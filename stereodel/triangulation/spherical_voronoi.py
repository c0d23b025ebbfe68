"""Voronoi diagram of the sphere, the dual of the Delaunay triangulation (row P3 of the ledger)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, IntArray, as_floats, locked
from stereodel._double_double import unit
from stereodel.sphere import SphereArc, SphereCircle, solid_angle
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.bisectors import bisector_normals
from stereodel.triangulation.cells import Diagram, Indices, circle_cells
from stereodel.triangulation.circle_order import circle_axis, circle_order
from stereodel.triangulation.circumcenters import spherical_circumcenters
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay


class SphericalVoronoi(Diagram):
    """Voronoi diagram of directions, on the unit sphere.

    Parameters
    ----------
    points : (n, 3) array_like or SphericalDelaunay
        Sites (directions; lengths do not matter), or their triangulation, which is then not computed again.
    workers : int, optional
        Threads; -1 for all processors. By default as for `SphericalDelaunay`. Never changes the result.

    Attributes
    ----------
    points : (n, 3) array
        As given.
    vertices : (v, 3) array
        Unit outward normals of the hull facets, which are the circumcentres of their empty bubbles; exactly cocircular
        facets share one. Their numbers depend on the sites alone: in the order of the three lowest sites of a circle.
    regions : list of lists of int
        Vertices of each point's cell, counterclockwise seen from outside; [] for duplicates and for a single point.
    region_indices, region_offsets : arrays of int
        The same as flat arrays: cell i is ``region_indices[region_offsets[i]:region_offsets[i + 1]]``.
    region_neighbors : array of int32
        The site beyond the ridge from each entry of `region_indices` to the next one of its cell.
    ridge_points : (r, 2) array of int32
        Sites i < j on both sides of each ridge, in lexicographic order.
    ridge_vertices : (r, 2) array of int32
        Start and end of each ridge, such that site i is on its left.
    point_region : (n,) array of int32
        Region of each point; a duplicate's is the kept point's.
    simplex_vertex : (m,) array of int32
        Voronoi vertex of each Delaunay triangle.

    Raises
    ------
    ValueError, TypeError
        For points that are not finite real numbers of shape (n, 3), and for zero vectors.

    Notes
    -----
    A ridge is the arc of the great circle normal to p̂ᵢ − p̂ⱼ from its start to its end, counterclockwise about that
    normal; this says which arc it is even between antipodal vertices (`ridge_arcs`). Points all on one circle, great or
    small, have two antipodal vertices, the ends of the circle's axis; vertex 0 is the end around which the three lowest
    sites are counterclockwise. Two points: vertex 0 is the direction of p₀ × p₁. Two antipodal points: of p₀ × e, e the
    coordinate axis (the first one, if several) along which p₀ is shortest.

    Which facets share a vertex is decided by the exact predicate `in_bubble`, so no ridge has length zero and the
    diagram does not depend on the tie rule. Source: the paper's duality (row P3); R. Renka, "Algorithm 772: STRIPACK",
    ACM TOMS 23 (1997).

    Examples
    --------
    >>> diagram = SphericalVoronoi([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]])
    >>> len(diagram.vertices), diagram.regions[0]
    (8, [0, 2, 3, 1])
    >>> print(diagram.areas() / np.pi)
    [0.66666667 0.66666667 0.66666667 0.66666667 0.66666667 0.66666667]
    """

    def __init__(self, points: npt.ArrayLike | SphericalDelaunay, *, workers: int | None = None) -> None:
        given = isinstance(points, SphericalDelaunay)
        triangulation = points if isinstance(points, SphericalDelaunay) else SphericalDelaunay(points, workers=workers)
        self.points = triangulation.points
        self._dimension = triangulation.dimension
        self._threads = triangulation._thread_count(workers if given else None)
        self._set_point_region(triangulation.duplicates)
        if triangulation.dimension == 2:
            self._set_diagram(triangulation)
        else:
            self._set_circle()

    @classmethod
    def from_lonlat(
        cls, lonlat: npt.ArrayLike, *, latitude: Latitude = "spherical", workers: int | None = None
    ) -> SphericalVoronoi:
        """The diagram of points given by longitude and latitude.

        Parameters
        ----------
        lonlat : (n, 2) array_like
            (longitude, latitude) in degrees; any finite longitude, latitude in [-90, 90].
        latitude : {"spherical", "geodetic", "authalic"}, optional
            As for `lonlat_to_xyz`. With "authalic", ``areas(radius=stereodel.earth.AUTHALIC_RADIUS_KM)`` are areas on
            the WGS84 ellipsoid in km².
        workers : int, optional
            As for the constructor.

        Returns
        -------
        SphericalVoronoi
            Of the unit vectors that `lonlat_to_xyz` gives, which are exact from then on.

        Raises
        ------
        ValueError, TypeError
            For values that are not finite real numbers, latitudes out of range, other shapes, or another `latitude`.

        Examples
        --------
        >>> diagram = SphericalVoronoi.from_lonlat([(0, 60), (120, 60), (-120, 60), (0, -60)], latitude="geodetic")
        >>> [len(region) for region in diagram.regions]
        [3, 3, 3, 3]
        """
        return cls(SphericalDelaunay.from_lonlat(lonlat, latitude=latitude, workers=workers), workers=workers)

    def _set_diagram(self, triangulation: SphericalDelaunay) -> None:
        arrays = self.points, triangulation.simplices, triangulation.neighbors
        *cells, simplex_vertex, sites = _kernel.voronoi_sphere(*arrays, self._threads)
        self._set_cells(*cells)
        self.simplex_vertex = locked(simplex_vertex)
        self._set_vertices(spherical_circumcenters(self.points, sites, workers=self._threads))

    def _set_circle(self) -> None:
        """No triangles: two points or more on one great circle, or fewer than two."""
        self.simplex_vertex = locked(np.zeros(0, dtype=np.int32))
        order = self._around_circle()
        if len(order) > 1:
            self._set_vertices(circle_axis(self.points[order[np.unique(np.arange(3) * len(order) // 3)]]))
        else:
            order = order[:0]
            self._set_vertices(np.zeros((0, 3)))
        self._set_cells(*circle_cells(order, len(self.points)))

    def _around_circle(self) -> Indices:
        """Different sites of one great circle, counterclockwise around vertex 0, beginning with the lowest."""
        kept = np.flatnonzero(self.point_region == np.arange(len(self.points)))
        if len(kept) < 3:
            return kept
        order = circle_order(self.points[kept])
        order = np.roll(order, -int(np.argmin(order)))
        place = np.argsort(order)
        return kept[order if place[1] < place[2] else np.roll(order[::-1], 1)]

    def _set_vertices(self, vertices: FloatArray) -> None:
        if len(vertices) == 2:
            vertices[1] = 0.0 - vertices[0]
        self.vertices = locked(vertices)

    def areas(self, *, radius: float = 1.0) -> FloatArray:
        """Area of each point's cell, (n,): 0 for duplicates; together 4π radius².

        Parameters
        ----------
        radius : float
            Radius of the sphere. With the default the areas are steradians.

        Notes
        -----
        Cells within 60° of their site: signed triangles of the site and each ridge, which keep the digits of tiny
        cells. Wider ones: 2π minus the angles by which the boundary turns (Gauss and Bonnet), from the normals of the
        ridges, which are good however close the sites are; the far vertices of a tight cluster's outer cells are not.
        """
        scale = float(as_floats(radius, "radius"))
        count = len(self.points)
        if len(self.ridge_points) == 0:
            return np.where(self.point_region == np.arange(count), 4 * np.pi, 0.0) * scale**2
        sides = self._sides()
        p, start, end = unit(self.points[sides.cell]).hi, self.vertices[sides.start], self.vertices[sides.end]
        wide = np.bincount(sides.cell, np.sum(p * start, axis=1) < 0.5, minlength=count) > 0
        near = ~wide[sides.cell]
        small = np.bincount(sides.cell[near], solid_angle(p[near], start[near], end[near]), minlength=count)
        turned = np.bincount(sides.cell, sides.turns(), minlength=count)
        return np.where(wide, 2 * np.pi - turned, small) * scale**2

    def _sides(self) -> CellSides:
        pairs, ends, normals = self.ridge_points, self.ridge_vertices, self.ridge_normals()
        return CellSides(
            pairs.T.ravel(), ends.T.ravel(), ends[:, ::-1].T.ravel(), np.concatenate([normals, 0.0 - normals])
        )

    def ridge_normals(self) -> FloatArray:
        """Directions of p̂ᵢ − p̂ⱼ, (r, 3): the unit normal of each ridge's plane, on the side of site i."""
        return bisector_normals(*(self.points[self.ridge_points[:, k]] for k in (0, 1)))

    def ridge_arcs(self) -> list[SphereArc]:
        """The ridges as arcs of great circles, in the order of `ridge_points`, from start to end, site i on the left.

        Examples
        --------
        >>> [arc.angle_rad / np.pi for arc in SphericalVoronoi([[0, 0, 1], [0, 0, -1]]).ridge_arcs()]
        [1.0, 1.0]
        """
        starts, ends = self.vertices[self.ridge_vertices[:, 0]], self.vertices[self.ridge_vertices[:, 1]]
        # Ends that are different but equal as doubles would stand for the whole circle: give the arc a length.
        angles = np.maximum(_angles(starts, ends), np.finfo(np.float64).tiny)
        rows = zip(self.ridge_normals(), starts, ends, angles.tolist(), strict=True)
        return [SphereArc(SphereCircle(n, 0.0), a, b, angle) for n, a, b, angle in rows]

    def delaunay(self) -> SphericalDelaunay:
        """The triangulation, from the topology of the diagram alone, in O(n).

        The sites around a vertex are a triangle, or a polygon whose diagonals the tie rule draws: equal to the direct
        triangulation.
        """
        if self._dimension < 2:
            return SphericalDelaunay(self.points)
        simplices = _kernel.delaunay_of_sphere(self.points, *self._cells(), self._threads)
        return SphericalDelaunay._from_simplices(self.points, simplices, self._duplicates())


class CellSides(NamedTuple):
    """Every ridge from both of its cells, counterclockwise around the cell."""

    cell: IntArray
    start: IntArray
    end: IntArray
    normal: FloatArray
    """Of the ridge's plane, on the side of the cell."""

    def turns(self) -> FloatArray:
        """Angle by which the boundary of the cell turns at the end of each side, radians in [0, π]."""
        turns = np.empty(len(self.cell))
        arriving, leaving = np.lexsort((self.end, self.cell)), np.lexsort((self.start, self.cell))
        m, n = self.normal[arriving], self.normal[leaving]
        turns[arriving] = np.arctan2(np.linalg.norm(np.cross(m, n), axis=1), np.sum(m * n, axis=1))
        return turns


def _angles(start: FloatArray, end: FloatArray) -> FloatArray:
    angles: FloatArray = 2 * np.arctan2(np.linalg.norm(start - end, axis=1), np.linalg.norm(start + end, axis=1))
    return angles
