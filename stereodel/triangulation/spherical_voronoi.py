"""Voronoi diagram of the sphere, the dual of the Delaunay triangulation (row P3 of the ledger)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, IntArray, as_floats
from stereodel._double_double import unit
from stereodel.predicates import in_bubble
from stereodel.predicates.rays import turn_signs
from stereodel.sphere import SphereArc, SphereCircle, solid_angle
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.bisectors import bisector_normals
from stereodel.triangulation.cells import (
    Diagram,
    HalfRidges,
    Indices,
    canonical_names,
    circle_half_ridges,
    from_ridges,
    half_ridges,
    polygons,
    spread_triples,
    twins,
)
from stereodel.triangulation.circle_order import circle_axis, circle_order
from stereodel.triangulation.circumcenters import spherical_circumcenters
from stereodel.triangulation.direction_ties import direction_ranks, displaced_outward
from stereodel.triangulation.polygon_diagonals import triangulate_polygons
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay


class SphericalVoronoi(Diagram):
    """Voronoi diagram of directions, on the unit sphere.

    Parameters
    ----------
    points : (n, 3) array_like or SphericalDelaunay
        Sites (directions; lengths do not matter), or their triangulation, which is then not computed again.

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

    def __init__(self, points: npt.ArrayLike | SphericalDelaunay) -> None:
        triangulation = points if isinstance(points, SphericalDelaunay) else SphericalDelaunay(points)
        self.points = triangulation.points
        self._dimension = triangulation.dimension
        self._set_point_region(triangulation.duplicates)
        self.simplex_vertex = np.zeros(0, dtype=np.int32)
        if triangulation.dimension == 2:
            self._set_diagram(triangulation)
        else:
            self._set_circle()
        self._freeze()

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
            Threads of the triangulation, as for `SphericalDelaunay`.

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
        return cls(SphericalDelaunay.from_lonlat(lonlat, latitude=latitude, workers=workers))

    def _set_diagram(self, triangulation: SphericalDelaunay) -> None:
        simplices = triangulation.simplices
        twin = twins(simplices)
        half, labels = half_ridges(simplices, twin, spherical_ties(self.points, simplices, twin))
        names = self._set_vertices(half)
        self.simplex_vertex = names[labels].astype(np.int32)

    def _set_circle(self) -> None:
        """No triangles: two points or more on one great circle, or fewer than two."""
        kept = np.flatnonzero(self.point_region == np.arange(len(self.points)))
        if len(kept) > 1:
            self._set_vertices(circle_half_ridges(kept[circle_order(self.points[kept])]))
            return
        self.vertices = np.zeros((0, 3))
        self._set_cells(circle_half_ridges(np.zeros(0, dtype=np.intp)))

    def _set_vertices(self, half: HalfRidges) -> Indices:
        """Cells with vertices in canonical order, and their names in terms of the given numbers."""
        names = canonical_names(polygons(half))
        half = half.relabelled(names)
        self._set_cells(half)
        around = polygons(half)
        sites = spread_triples(around)
        if self._dimension < 2:
            self.vertices = circle_axis(self.points[around.members[:2] if around.offsets[1] == 2 else sites[0]])
        else:
            self.vertices = spherical_circumcenters(self.points[sites])
        if len(self.vertices) == 2:
            self.vertices[1] = 0.0 - self.vertices[0]
        return names

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
        cycles = polygons(from_ridges(self.ridge_points, self.ridge_vertices))
        rank = direction_ranks(self.points, cycles)
        simplices = triangulate_polygons(cycles, rank, displaced_outward(self.points, cycles))
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


def spherical_ties(points: FloatArray, simplices: IntArray, twin: Indices) -> BoolArray:
    """Half-edges whose opposite corner lies on the circle of their triangle, both triangles facing the same way.

    Points all on one small circle form a flat, two-sided polygon: across its rim the corners are cocircular as well.
    """
    tied = np.zeros(len(twin), dtype=np.bool_)
    inner = np.flatnonzero(twin > np.arange(len(twin)))
    corners = points[simplices[inner // 3]]
    opposite = points[simplices.ravel()[twin[inner]]]
    on_circle = np.asarray(in_bubble(corners[:, 0], corners[:, 1], corners[:, 2], opposite)) == 0
    corners = points[simplices]
    facing = np.repeat(turn_signs(corners[:, 0], corners[:, 1], corners[:, 2]), 3)
    tied[inner] = on_circle & (facing[inner] == facing[twin[inner]])
    tied[twin[inner]] = tied[inner]
    return tied


def _angles(start: FloatArray, end: FloatArray) -> FloatArray:
    angles: FloatArray = 2 * np.arctan2(np.linalg.norm(start - end, axis=1), np.linalg.norm(start + end, axis=1))
    return angles
