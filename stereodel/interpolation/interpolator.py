"""The common base of all interpolators: triangulation, values, and behaviour outside."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any, Final, Self

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, FloatArray, as_choice, as_values, keep_freed_memory, locked
from stereodel._docs import by_name, shared
from stereodel._double_double import DoubleDouble, unit
from stereodel._spaces import SPHERE, surface_of
from stereodel.constants import UNDECIDED
from stereodel.sphere.coordinates import BY_NAME, IN_ROWS, LONLAT, as_asked
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.delaunay import Triangulation, as_triangulation

FAMILY: Final = {
    "points": """
        Parameters
        ----------
        points : (n, 2) or (n, 3) array_like, PlanarDelaunay or SphericalDelaunay
            Points of the plane, directions, or a triangulation of them; for longitude and latitude, one made by
            `SphericalDelaunay.from_lonlat`, or the method of this name.
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
    """Points of the plane, or unit vectors in double-double, and their differences to full relative precision."""

    # A unit vector rounded to doubles is off by 1e-16: much for its difference from a neighbour 1e-15 away.

    def __init__(self, points: FloatArray) -> None:
        self.curved = surface_of(points) is SPHERE
        # Or unit vectors with errors below 2⁻¹⁰². Components come first, here and in what is computed of them: NumPy
        # is several times as fast along many points as along two or three components.
        self.exact = DoubleDouble(np.ascontiguousarray(points.T), np.zeros((2, 0)))
        if self.curved:
            exact = unit(points)
            self.exact = DoubleDouble(exact.hi.T, exact.lo.T)

    @property
    def rounded(self) -> FloatArray:
        """Points, or unit vectors (d, n)."""
        return self.exact.hi

    def take(self, index: AnyIndices) -> PrecisePoints:
        """Some of them."""
        result = copy.copy(self)
        lo = self.exact.lo.take(index, axis=1) if self.curved else self.exact.lo
        result.exact = DoubleDouble(self.exact.hi.take(index, axis=1), lo)
        return result

    def __sub__(self, other: PrecisePoints) -> FloatArray:
        """Differences (d, n), rounded: errors below 2⁻⁵² of the result and 2⁻¹⁰¹."""
        p, q = self.exact, other.exact
        rough = p.hi - q.hi
        return rough + (p.lo - q.lo) if self.curved else rough


BLOCK = 8192
"""Queries in a block, of one field: vectors take 200 KB, so that a few stay in the second-level cache."""


class Interpolator(ABC):
    """A function on the plane or the sphere that takes given values at given points."""

    triangulation: Triangulation
    values: FloatArray

    def __init__(
        self, points: npt.ArrayLike | Triangulation, values: npt.ArrayLike, *, extrapolate: str | None = None
    ) -> None:
        self.triangulation = as_triangulation(points)
        flat, shape = as_site_values(self.triangulation, values)
        self._values = locked(flat.copy())
        self.values = self._values.reshape(len(flat), *shape)
        self._sites = PrecisePoints(self.triangulation.points)
        self._nearest_outside = extrapolate is not None and bool(as_choice(extrapolate, ("nearest",), "extrapolate"))

    @classmethod
    @by_name(IN_ROWS)
    @shared(**LONLAT)
    def from_lonlat(
        cls, lonlat: npt.ArrayLike, values: npt.ArrayLike, *, latitude: Latitude = "spherical", **options: Any
    ) -> Self:
        """From values at points given by longitude and latitude; queries may then use them too.

        Parameters
        ----------
        {lonlat}
        values : (n, ...) array_like
            As for the constructor.
        {latitude}
        **options
            As for the constructor.

        {lonlat_raises}

        Examples
        --------
        >>> from stereodel.interpolation import LinearInterpolator
        >>> lonlat, celsius = [(10.0, 48.4), (2.3, 48.9), (12.5, 41.9)], [8.1, 11.4, 15.9]
        >>> temperature = LinearInterpolator.from_lonlat(lonlat, celsius, latitude="geodetic")
        >>> round(float(temperature(lonlat=(9.2, 45.5))), 2)
        12.8
        """
        return cls(as_triangulation(lonlat=lonlat, latitude=latitude), values, **options)

    @property
    def latitude(self) -> Latitude | None:
        """The kind of latitude by which the points were given, None if they were not given by one."""
        return self.triangulation.latitude

    @by_name(BY_NAME)
    @shared(**LONLAT)
    def __call__(
        self,
        queries: npt.ArrayLike | None = None,
        *,
        lonlat: npt.ArrayLike | None = None,
        workers: int | None = None,
    ) -> FloatArray:
        """Interpolated values.

        {asked}

        Returns
        -------
        array of the leading shape, then the shape of one value
            NaN outside, unless `extrapolate` is given, and where a NaN of `values` takes part.

        {asked_raises}
        """
        array, flat = self._as_queries(queries, lonlat)
        with np.errstate(all="ignore"):
            result = self._evaluate(flat, workers)
        return result.reshape(array.shape[:-1] + self.values.shape[1:])

    @shared(**LONLAT)
    def gradient(
        self,
        queries: npt.ArrayLike | None = None,
        *,
        lonlat: npt.ArrayLike | None = None,
        workers: int | None = None,
    ) -> FloatArray:
        """Gradients of the interpolated function, per unit of length of the plane or per radian.

        {asked}

        Returns
        -------
        array of the leading shape, then the shape of one value, then 2 or 3
            Last axis: a vector of the plane, or a tangent vector of the unit sphere at the query, (x, y, z), for
            `lonlat` too. NaN as for a call.

        {asked_raises}
        """
        array, flat = self._as_queries(queries, lonlat)
        with np.errstate(all="ignore"):
            result = np.moveaxis(self._evaluate_gradient(flat, workers), 1, 2)
        return result.reshape(array.shape[:-1] + self.values.shape[1:] + array.shape[-1:])

    def _as_queries(self, queries: npt.ArrayLike | None, lonlat: npt.ArrayLike | None) -> tuple[FloatArray, FloatArray]:
        array = self.triangulation.surface.as_queries(as_asked(queries, lonlat, self.latitude))
        return array, array.reshape(-1, array.shape[-1])

    @abstractmethod
    def _evaluate(self, queries: FloatArray, workers: int | None) -> FloatArray:
        """Values (m, k) at queries (m, d)."""

    @abstractmethod
    def _evaluate_gradient(self, queries: FloatArray, workers: int | None) -> FloatArray:
        """Gradients (m, d, k) at queries (m, d)."""

    @property
    def _fills_outside(self) -> bool:
        """Whether queries outside can have values: by extrapolation, or at points that have no triangles."""
        return self._nearest_outside or self.triangulation.dimension < 2

    def _beyond(self, queries: FloatArray, outside: AnyIndices, workers: int | None) -> tuple[AnyIndices, AnyIndices]:
        """Those of the queries `outside` that take the value of a point, and the points."""
        if not self._fills_outside or not len(outside) or not len(self._values):
            return outside[:0], outside[:0]
        points = np.asarray(self.triangulation.nearest(queries[outside], workers=workers))
        if not self._nearest_outside:
            gaps = PrecisePoints(queries[outside]) - self._sites.take(points)
            at = np.abs(gaps).max(axis=0) <= (UNDECIDED if self._sites.curved else 0.0)
            outside, points = outside[at], points[at]
        return outside, points

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.triangulation!r}, values {self.values.shape})"


class TriangleInterpolator(Interpolator):
    """An interpolator on the triangle that contains each query; outside all triangles, NaN or the nearest value."""

    def _evaluate(self, queries: FloatArray, workers: int | None) -> FloatArray:
        result = np.full((len(queries), self._values.shape[1]), np.nan)
        found = self._in_blocks(result, queries, workers, self._within)
        rows, points = self._beyond(queries, np.flatnonzero(found < 0), workers)
        result[rows] = self._values[points]
        return result

    def _evaluate_gradient(self, queries: FloatArray, workers: int | None) -> FloatArray:
        result = np.full((*queries.shape, self._values.shape[1]), np.nan)
        found = self._in_blocks(result, queries, workers, self._slope_within)
        if self._nearest_outside:
            result[found < 0] = 0.0
        return result

    def _in_blocks(
        self,
        result: FloatArray,
        queries: FloatArray,
        workers: int | None,
        function: Callable[[AnyIndices, FloatArray], FloatArray],
    ) -> AnyIndices:
        """Fill the rows of `result` for queries inside triangles, and return the triangle of each, -1 outside."""
        found = np.asarray(self.triangulation.find_simplex(queries, workers=workers))
        inside = np.flatnonzero(found >= 0)
        keep_freed_memory()
        size = BLOCK // max(1, min(result.shape[-1], BLOCK // 256))
        for first in range(0, len(inside), size):
            rows = inside[first : first + size]
            result[rows] = function(self.triangulation.simplices.take(found[rows], axis=0), queries.take(rows, axis=0))
        return found

    @abstractmethod
    def _within(self, corners: AnyIndices, queries: FloatArray) -> FloatArray:
        """Values (m, k) at queries (m, d) in the triangles of these corners (m, 3)."""

    @abstractmethod
    def _slope_within(self, corners: AnyIndices, queries: FloatArray) -> FloatArray:
        """Gradients (m, d, k)."""
