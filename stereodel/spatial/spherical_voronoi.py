"""`scipy.spatial.SphericalVoronoi` over the exact diagram of directions."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import scipy.spatial

from stereodel import triangulation as exact
from stereodel._arrays import FloatArray, as_floats, as_points, as_scalar, as_shaped
from stereodel.curves.ragged import cycles
from stereodel.spatial.compatibility import hand_over


class ExactOnSphere(scipy.spatial.SphericalVoronoi):
    """Voronoi diagram of a sphere with the interface of `scipy.spatial.SphericalVoronoi`, exact.

    Parameters
    ----------
    points : (npoints, 3) array_like
        Points of the sphere. Copied. Points of other dimensions, as of a circle, are handed over to SciPy, with an
        `InexactWarning`.
    radius : float, optional
        Radius of the sphere.
    center : (3,) array_like, optional
        Center of the sphere; default the origin.
    threshold : float, optional
        How far points may be from the sphere, relative to the radius. There is no limit to how close points may be to
        one another.

    Attributes
    ----------
    points, radius, center
        As given.
    vertices : (nvertices, 3) array
        Centers of the empty circles: one for each of the 2·npoints − 4 triangles, bitwise equal ones for cocircular
        triangles; two if all points lie on one circle, its poles; none for a single point.
    regions : list of lists of int
        Vertices of each point's region, counterclockwise seen from outside. Empty for a single point, and for points
        in the same direction as an earlier one.

    Raises
    ------
    ValueError, TypeError
        For points that are not finite real numbers of shape (npoints, 3) or not on the sphere, and for a radius that
        is not positive.

    Notes
    -----
    Directions are those of ``points - center``, as rounded: with the center at the origin, exactly those of the points.
    Results for points that SciPy refuses, those on one circle, close together, equal, one or none, are those of
    `stereodel.SphericalVoronoi`, on which this is built. Arrays can be written to, as in SciPy.

    Examples
    --------
    >>> from stereodel.spatial import SphericalVoronoi
    >>> sv = SphericalVoronoi([[0, 0, 1], [0, 0, -1], [1, 0, 0], [0, 1, 0], [0, -1, 0], [-1, 0, 0]])
    >>> len(sv.vertices), [len(region) for region in sv.regions]
    (8, [4, 4, 4, 4, 4, 4])
    >>> print(sv.calculate_areas() / np.pi)
    [0.66666667 0.66666667 0.66666667 0.66666667 0.66666667 0.66666667]
    """

    def __init__(
        self,
        points: npt.ArrayLike,
        radius: float = 1,
        center: npt.ArrayLike | None = None,
        threshold: float = 1e-06,
    ) -> None:
        if radius is None:
            raise ValueError("`radius` is `None`. Please provide a floating point number (i.e. `radius=1`).")
        array = as_floats(points, "points")
        if array.size > 0 and array.ndim == 2 and array.shape[1] not in (1, 3):
            hand_over(self, f"{array.shape[1]} dimensions", array, radius, center, threshold)
            return
        self.radius = as_scalar(radius, "radius", low=0.0, open_low=True)
        self.points = np.array(as_points(array, 3))
        self.center = np.zeros(3) if center is None else np.array(as_shaped(center, (3,), "center"))
        directions = self.points - self.center
        distances = np.linalg.norm(directions, axis=1)
        off = np.abs(distances - self.radius)
        if off.max(initial=0.0) >= as_scalar(threshold, "threshold", low=0.0) * self.radius:
            worst = int(off.argmax())
            said = f"points[{worst}] is {float(distances[worst])} from the center, but radius is {self.radius}"
            advice = "scale the points, or allow more by threshold"
            raise ValueError(f"Radius inconsistent with generators: {said}; {advice}")
        triangles = exact.SphericalDelaunay(directions)
        self._diagram = exact.SphericalVoronoi(triangles)
        self._simplices = np.array(triangles.simplices)
        # Two poles, one vertex for each triangle, or nothing.
        units = self._diagram.vertices
        several = len(units) > 2
        self.regions: list[list[int]] = _fans(triangles) if several else self._diagram.regions
        self.vertices = self.radius * (units[self._diagram.simplex_vertex] if several else units) + self.center

    def sort_vertices_of_regions(self) -> None:
        """Nothing to do: regions are counterclockwise from the start."""

    def calculate_areas(self) -> FloatArray:
        """Area of each region, (npoints,); together 4π·radius²."""
        return np.array(self._diagram.areas(radius=self.radius))


SphericalVoronoi = ExactOnSphere  # under the name that SciPy has, for pickles and help as well
SphericalVoronoi.__name__ = SphericalVoronoi.__qualname__ = "SphericalVoronoi"


def _fans(triangles: exact.SphericalDelaunay) -> list[list[int]]:
    """Triangles around each point, counterclockwise from the lowest one.

    A corner of a triangle has the number 3·triangle + place. After corner k the fan goes on in the triangle opposite
    corner k + 1.
    """
    corners = triangles.simplices.ravel()
    around = np.roll(triangles.neighbors, -1, axis=1).ravel()
    place = (triangles.simplices[around] == corners[:, None]).argmax(axis=1)
    result: list[list[int]] = [[] for _ in triangles.points]
    for fan in cycles(3 * around.astype(np.intp) + place):
        result[corners[fan[0]]] = (fan // 3).tolist()
    return result
