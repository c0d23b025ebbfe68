"""Points with values: exact differences of points, and one value for each place."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, FloatArray, as_values
from stereodel._double_double import DoubleDouble, unit
from stereodel.sphere.chunks import ROWS
from stereodel.triangulation.dispatch import Triangulation

FAMILY: Final = {
    "points": """
        Parameters
        ----------
        points : (n, 2) or (n, 3) array_like, PlanarDelaunay or SphericalDelaunay
            Points of the plane, directions, or a triangulation of them. For longitude and latitude use `from_lonlat`.
        """,
    "sites": """
        Parameters
        ----------
        points : (n, 2) or (n, 3) array_like, PlanarDelaunay or SphericalDelaunay
            Points of the plane, directions, or a triangulation of them; for longitude and latitude, one made by
            `SphericalDelaunay.from_lonlat`.
        """,
    "values": """
        values : (n, ...) array_like
            A number or an array of numbers for each point; NaN or masked where missing.
        """,
    "extrapolate": """
        extrapolate : "nearest", optional
            Outside all triangles use the value of the nearest point, with gradient zero; by default NaN.
        """,
    "attributes": """
        Attributes
        ----------
        triangulation : PlanarDelaunay or SphericalDelaunay
        values : (n, ...) array
            Values as used: coincident points have the mean of their values.
        latitude : str or None
            The kind of latitude by which the points were given.
        """,
    "raises": """
        Raises
        ------
        ValueError, TypeError
            As for the triangulation; if a value is infinite or not a real number, or their number differs from that of
            the points.
        """,
    "function": """
        {points}
        {values}
        {extrapolate}

        {attributes}

        {raises}
        """,
}
"""Parts shared by the docstrings of this package."""


def one_value_a_place(triangulation: Triangulation, values: FloatArray) -> FloatArray:
    """Values (n, k) in which coincident points all have the mean of theirs; NaN if one of them is NaN."""
    dropped, kept = triangulation.duplicates.T
    if len(dropped) == 0:
        return values
    # Means of differences from the kept point: equal values stay bitwise equal.
    total, count = np.zeros_like(values), np.ones(len(values))
    np.add.at(total, kept, values[dropped] - values[kept])
    np.add.at(count, kept, 1.0)
    merged = values + total / count[:, None]
    merged[dropped] = merged[kept]
    return merged


def as_site_values(triangulation: Triangulation, values: npt.ArrayLike) -> tuple[FloatArray, tuple[int, ...]]:
    """Checked values as (n, k), one for each place, and the shape of a single value."""
    array = as_values(values, len(triangulation.points))
    shape = array.shape[1:]
    flat = array.reshape(len(array), int(np.prod(shape, dtype=np.intp)))
    return one_value_a_place(triangulation, flat), shape


class PrecisePoints:
    """Points of the plane, or unit vectors in double-double, and their differences to full relative precision.

    A unit vector rounded to doubles is off by 1e-16, which is negligible for its place but not for its difference from
    a neighbour 1e-15 away.
    """

    def __init__(self, points: FloatArray) -> None:
        self.curved = points.shape[1] == 3
        self.exact = DoubleDouble(points)  # or unit vectors with errors below 2⁻¹⁰², (n, d)
        if self.curved and len(points):
            blocks = [unit(points[i : i + ROWS]) for i in range(0, len(points), ROWS)]
            self.exact = DoubleDouble(np.concatenate([b.hi for b in blocks]), np.concatenate([b.lo for b in blocks]))

    @property
    def rounded(self) -> FloatArray:
        """Points, or unit vectors (n, d)."""
        return self.exact.hi

    def minus(self, a: AnyIndices, other: PrecisePoints, b: AnyIndices) -> FloatArray:
        """Points `a` less points `b` of the other places, rounded: errors below 2⁻⁵² of the result and 2⁻¹⁰¹."""
        p, q = self.exact, other.exact
        rough = p.hi.take(a, axis=0) - q.hi.take(b, axis=0)
        return rough + (p.lo.take(a, axis=0) - q.lo.take(b, axis=0)) if self.curved else rough
