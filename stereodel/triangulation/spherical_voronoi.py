"""Voronoi diagram of the sphere, the dual of the Delaunay triangulation (row P3 of the ledger)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, as_scalar
from stereodel._docs import by_name, shared
from stereodel._spaces import SPHERE
from stereodel.sphere import SphereArc, SphereCircle
from stereodel.sphere.coordinates import IN_ROWS, LONLAT, as_told
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.diagram import FAMILY, Diagram
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay


@shared(**FAMILY)
class SphericalVoronoi(Diagram[SphericalDelaunay], surface=SPHERE):
    """Voronoi diagram of points on the sphere.

    Parameters
    ----------
    points : (n, 3) array_like or SphericalDelaunay
        Sites (directions; lengths do not matter), or their triangulation, which is then not computed again.
    workers : int, optional
        Threads; -1 for all processors. By default as for `SphericalDelaunay`. Does not affect the result.

    Attributes
    ----------
    points : (n, 3) array
        As given.
    vertices : (v, 3) array
        Unit outward normals of the hull facets, which are the circumcentres of their empty bubbles; exactly cocircular
        facets share one. Their numbers depend on the sites alone: in the order of the three lowest sites of a circle.
    regions : list of lists of int
        Vertices of each point's cell, counterclockwise seen from outside; [] for duplicates and for a single point.
    {flat_regions}
    region_neighbors : array of int32
        The site beyond the ridge from each entry of `region_indices` to the next one of its cell.
    {ridge_points}
    ridge_vertices : (r, 2) array of int32
        Start and end of each ridge, such that site i is on its left.
    {numbers}
    latitude : str or None
        The kind of latitude by which the points were given (`from_lonlat`); None for directions.

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

    The exact predicate `in_bubble` decides which facets share a vertex, so no ridge has length zero and the
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

    @classmethod
    @by_name(IN_ROWS)
    @shared(**LONLAT)
    def from_lonlat(
        cls, lonlat: npt.ArrayLike, *, latitude: Latitude = "spherical", workers: int | None = None
    ) -> SphericalVoronoi:
        """The diagram of points given by longitude and latitude; results are then available in them too.

        Parameters
        ----------
        {lonlat}
        {latitude}
            With "authalic", ``areas(radius=stereodel.earth.AUTHALIC_RADIUS_KM)`` are areas on the WGS84 ellipsoid in
            km².
        workers : int, optional
            As for the constructor.

        Returns
        -------
        SphericalVoronoi
            Diagram of the unit vectors from `lonlat_to_xyz`, which are then taken as exact.

        {lonlat_raises}

        Examples
        --------
        >>> diagram = SphericalVoronoi.from_lonlat([(0, 60), (120, 60), (-120, 60), (0, -60)], latitude="geodetic")
        >>> [len(region) for region in diagram.regions]
        [3, 3, 3, 3]
        >>> print(diagram.vertices_lonlat.round(1))
        [[   0.    90. ]
         [  60.     0. ]
         [ -60.     0. ]
         [-180.   -23.7]]
        """
        return cls(SphericalDelaunay.from_lonlat(lonlat, latitude=latitude, workers=workers), workers=workers)

    @property
    def lonlat(self) -> FloatArray:
        """Longitude and latitude of `points`, (n, 2) in degrees, if the points were given by them."""
        return as_told(self.points, self.latitude)

    @property
    def vertices_lonlat(self) -> FloatArray:
        """Longitude and latitude of `vertices`, (v, 2) in degrees, if the points were given by them."""
        return as_told(self.vertices, self.latitude)

    def _set_flat(self) -> FloatArray:
        cells, vertices = _kernel.sphere.flat_diagram(self.points, self._order)
        self._set_cells(*cells)
        return vertices

    def areas(self, *, radius: float = 1.0) -> FloatArray:
        """Area of each point's cell, (n,): 0 for duplicates; together 4π radius².

        Areas are those of the sphere of the directions: of the Earth's ellipsoid, for sites that were given with
        ``latitude="authalic"`` and the radius `stereodel.earth.AUTHALIC_RADIUS_KM`.

        Parameters
        ----------
        radius : float
            Radius of the sphere, above 0. With the default the areas are steradians.

        Notes
        -----
        The sum over the neighbours q of a site p and the two vertices of their ridge of the right-angled triangle of p,
        the middle of p and q, and the vertex: tan(ω/2) = tan(h/2) tan(l/2) with sin h = |D|/2 and
        tan l = |D| E·F / (2 det[p q r]), r the third site of the vertex, D = q − p, E = r − p, F = r − q. No rounded
        vertex enters, so that cells of any size are accurate to some 1e-14 of themselves, and never worse than 2e-12:
        where a bound says that doubles may not do, double-double takes over, and where its bound says so, as many
        digits as are needed. An area below the least double is 0. Points of one great circle have lunes.
        """
        scale = as_scalar(radius, "radius", low=0.0, open_low=True)
        areas = self._cell_areas() if self._dimension == 2 else _kernel.sphere.flat_areas(self.points, self._order)
        return areas * scale**2

    def centroids(self) -> FloatArray:
        """Direction of the mean of each point's cell, (n, 3) unit vectors; NaN for duplicates.

        Notes
        -----
        The integral of x over a polygon of the sphere is half the sum, over its sides, of the side's angle times the
        normal of its plane toward the inside (Stokes' theorem; J. Arvo, "Applications of irradiance tensors to the
        simulation of non-Lambertian phenomena", SIGGRAPH 1995). It is summed over the triangles of `areas`, relative to
        the site, so that nothing cancels in small cells. The cell of a single point is the whole sphere, whose mean has
        no direction: the point itself. Centroids are within 2e-12 of the cell's size, besides their rounding.

        Examples
        --------
        >>> print(SphericalVoronoi([[0, 0, 1], [0, 1, 0]]).centroids().round(15))
        [[ 0.         -0.70710678  0.70710678]
         [ 0.          0.70710678 -0.70710678]]
        """
        if self._dimension < 2:
            return _kernel.sphere.flat_centroids(self.points, self._order)
        return self._cell_centroids()

    def ridge_normals(self) -> FloatArray:
        """Directions of p̂ᵢ − p̂ⱼ, (r, 3): the unit normal of each ridge's plane, on the side of site i."""
        p, q = (self.points.take(self.ridge_points[:, k], axis=0) for k in (0, 1))
        return _kernel.sphere.bisector_normals(p, q, self._threads)

    def ridge_arcs(self) -> list[SphereArc]:
        """The ridges as arcs of great circles, in the order of `ridge_points`, from start to end, site i on the left.

        Examples
        --------
        >>> [arc.angle_rad / np.pi for arc in SphericalVoronoi([[0, 0, 1], [0, 0, -1]]).ridge_arcs()]
        [1.0, 1.0]
        """
        starts, ends = self.vertices[self.ridge_vertices[:, 0]], self.vertices[self.ridge_vertices[:, 1]]
        # Ends that are different but equal as doubles would stand for the whole circle: give the arc a length.
        angles = 2 * np.arctan2(*(np.linalg.norm(chord, axis=1) for chord in (starts - ends, starts + ends)))
        angles = np.maximum(angles, np.finfo(np.float64).tiny)
        rows = zip(self.ridge_normals(), starts, ends, angles.tolist(), strict=True)
        return [SphereArc(SphereCircle(n, 0.0), a, b, angle) for n, a, b, angle in rows]
