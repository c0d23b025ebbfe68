"""Interpolators by name, interpolation in one call, and the classes that SciPy has for both."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, ClassVar, Final, Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_choice, as_floats, as_points
from stereodel._docs import shared
from stereodel.interpolation.interpolator import Interpolator
from stereodel.interpolation.smooth import SmoothInterpolator
from stereodel.interpolation.weighted import LinearInterpolator, NaturalNeighborInterpolator, NearestInterpolator
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.delaunay import Triangulation, as_triangulation

Method = Literal["nearest", "linear", "natural", "smooth"]

METHODS: Final[MappingProxyType[Method, type[Interpolator]]] = MappingProxyType(
    {
        "nearest": NearestInterpolator,
        "linear": LinearInterpolator,
        "natural": NaturalNeighborInterpolator,
        "smooth": SmoothInterpolator,
    }
)
"""Interpolators by name."""


def as_method(method: str) -> type[Interpolator]:
    """The interpolator of this name."""
    return METHODS[as_choice(method, tuple(METHODS), "method")]


def griddata(
    points: npt.ArrayLike,
    values: npt.ArrayLike,
    xi: npt.ArrayLike,
    *,
    method: Method = "linear",
    fill_value: float = np.nan,
    rescale: bool = False,
    latitude: Latitude | None = None,
) -> FloatArray:
    """Values between scattered points in one call, as `scipy.interpolate.griddata`.

    Parameters
    ----------
    points : (n, 2) or (n, 3) array_like, or tuple of (n,) arrays
        Points of the plane, or directions; with `latitude`, (longitude, latitude) in degrees. A tuple holds separate
        coordinates: x and y, or longitude and latitude.
    values : (n, ...) array_like
        A number or an array of numbers for each point; NaN or masked where missing.
    xi : (..., 2) or (..., 3) array_like, or tuple of arrays
        Query points, in the form of `points`; the arrays of a tuple are broadcast against each other, so that
        ``np.ix_``, ``np.mgrid`` and ``np.meshgrid`` give grids.
    method : {"linear", "nearest", "natural", "smooth"}, optional
        `LinearInterpolator`, `NearestInterpolator`, `NaturalNeighborInterpolator` or `SmoothInterpolator`.
    fill_value : float, optional
        Value outside all triangles; not used by "nearest".
    rescale : bool, optional
        Shift and scale the coordinates of the plane first, x and y apart, so that the points fill a unit square.
    latitude : {"spherical", "geodetic", "authalic"}, optional
        If given, `points` and `xi` are longitude and latitude, with this kind of latitude, as in `lonlat_to_xyz`.

    Returns
    -------
    array of the leading shape of `xi`, then the shape of one value
        NaN where a missing value takes part.

    Raises
    ------
    ValueError, TypeError
        As for the interpolators; if `method` is unknown.

    Notes
    -----
    For several fields or sets of queries, create the interpolator once; for time series use its `weights`.

    Examples
    --------
    >>> from stereodel.interpolation import griddata
    >>> x, y = np.mgrid[0:2, 0:3]
    >>> griddata([[0, 0], [4, 0], [0, 4], [4, 4]], [0.0, 4.0, 8.0, 12.0], (x, y)).tolist()
    [[0.0, 2.0, 4.0], [1.0, 3.0, 5.0]]
    >>> stations, celsius = [(10.0, 48.4), (2.3, 48.9), (12.5, 41.9)], [8.1, 11.4, 15.9]
    >>> print(griddata(stations, celsius, [(9.2, 45.5), (0.0, 0.0)], latitude="geodetic", fill_value=-99).round(2))
    [ 12.8 -99. ]
    """

    class OfMethod(_Scattered):
        _kind, _in_space = as_method(method), True

    return OfMethod(points, values, fill_value, rescale=rescale, latitude=latitude)(xi)


class _Scattered:
    """The interpolator `_kind`, called as SciPy's."""

    _kind: ClassVar[type[Interpolator]]
    _in_space: ClassVar[bool] = False  # whether directions may have different lengths

    def __init__(
        self,
        points: npt.ArrayLike | Triangulation,
        values: npt.ArrayLike,
        fill_value: float = np.nan,
        *,
        rescale: bool = False,
        latitude: Latitude | None = None,
        **without_effect: Any,
    ) -> None:
        if unknown := sorted(without_effect.keys() - _WITHOUT_EFFECT):
            raise TypeError(f"{unknown[0]} is not an option; known are fill_value, rescale, latitude")
        # A triangulation of SciPy's, whose simplices are rounded, gives its points.
        foreign = not isinstance(points, Triangulation) and hasattr(points, "simplices")
        sites: Any = _joined(getattr(points, "points", None) if foreign else points, "points")
        self._origin, self._size = np.zeros(2), np.ones(2)
        if rescale and len(sites := as_points(sites, 2, hint="rescale=True is for points of the plane")):
            extent = np.ptp(sites, axis=0)
            self._origin, self._size = sites.mean(axis=0), np.where(extent > 0, extent, 1.0)
            sites = (sites - self._origin) / self._size
        self._rescale, self._latitude, self.fill_value = rescale, latitude, float(fill_value)
        by_lonlat = latitude is not None and not isinstance(sites, Triangulation)
        named: dict[str, Any] = {"lonlat": sites, "latitude": latitude} if by_lonlat else {}
        self.tri = as_triangulation(None if by_lonlat else sites, **named)
        self.function = self._kind(self.tri, values)
        far = np.linalg.norm(self.tri.points, axis=1) if self.tri.points.shape[1] == 3 else np.ones(1)
        if not self._in_space and far.max(initial=0.0) > (1 + 1e-6) * far.min(initial=np.inf):
            raise ValueError(
                "points has three columns and rows of different lengths; here they are directions. For points in space "
                f"use scipy.interpolate.{type(self).__name__}, for directions of any length griddata"
            )

    def __call__(self, *xi: Any) -> FloatArray:
        """Values at places, given as `xi` of `griddata` or coordinate by coordinate."""
        places: Any = _joined(xi[0] if len(xi) == 1 else xi, "xi")
        if self._rescale:
            places = (as_floats(places, "xi") - self._origin) / self._size
        asked: dict[str, Any] = {"queries" if self._latitude is None else "lonlat": places}
        found = self.function(**asked)
        if self._kind is not NearestInterpolator and not np.isnan(self.fill_value):
            found[np.asarray(self.tri.find_simplex(**asked)) < 0] = self.fill_value
        return found


_WITHOUT_EFFECT: Final = frozenset({"tol", "maxiter", "tree_options"})
_ABOUT: Final = {
    "about": """
        points, values, fill_value, rescale, latitude
            As for `griddata`; `points` may be a triangulation, too, also one of SciPy's, whose points count. SciPy's
            `tol`, `maxiter` and `tree_options` have no effect: nothing iterates, and there is no tree.

        Attributes
        ----------
        tri : PlanarDelaunay or SphericalDelaunay
        function : Interpolator

        Raises
        ------
        ValueError, TypeError
            As `griddata`, and for three columns of different lengths, which are directions here and space to SciPy.
        """
}


@shared(**_ABOUT)
class LinearNDInterpolator(_Scattered):
    """As SciPy's, in the plane and on the sphere: `LinearInterpolator`; the same values where triangles are unique.

    Parameters
    ----------
    {about}

    Examples
    --------
    >>> from stereodel.interpolation import LinearNDInterpolator
    >>> plane = LinearNDInterpolator([[0, 0], [4, 0], [0, 4], [4, 4]], [0.0, 4.0, 8.0, 12.0], fill_value=-1)
    >>> plane([1, 3, 9], [2, 3, 9]).tolist()
    [5.0, 9.0, -1.0]
    """

    _kind = LinearInterpolator


@shared(**_ABOUT)
class CloughTocher2DInterpolator(_Scattered):
    """In place of SciPy's: `SmoothInterpolator`, once differentiable as well but another function, by local fits.

    Parameters
    ----------
    {about}

    Examples
    --------
    >>> from stereodel.interpolation import CloughTocher2DInterpolator
    >>> x, y = np.mgrid[:3, :3].reshape(2, -1).astype(float)
    >>> CloughTocher2DInterpolator((x, y), x * (2 - x))(0.5, 1.25).round(9).item()
    0.75
    """

    _kind = SmoothInterpolator


@shared(**_ABOUT)
class NearestNDInterpolator(_Scattered):
    """As SciPy's, in the plane and on the sphere: `NearestInterpolator`, of equally near points the first.

    Parameters
    ----------
    {about}

    Examples
    --------
    >>> from stereodel.interpolation import NearestNDInterpolator
    >>> NearestNDInterpolator([[0, 0], [4, 0], [0, 4]], [1.0, 2.0, 3.0])([[1, 0], [3, 1], [-9, 9]]).tolist()
    [1.0, 2.0, 3.0]
    """

    _kind = NearestInterpolator


def _joined(coordinates: Any, name: str) -> npt.ArrayLike:
    """Separate coordinates in a tuple, as rows."""
    if not isinstance(coordinates, tuple) or np.ndim(coordinates[0]) == 0:
        return coordinates
    columns = [as_floats(column, f"{name}[{k}]") for k, column in enumerate(coordinates)]
    return np.stack(np.broadcast_arrays(*columns), axis=-1)
