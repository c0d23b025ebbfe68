"""Interpolators by name, interpolation in one call, and the classes that SciPy has for both."""

from __future__ import annotations

from typing import Any, ClassVar, Final, Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_choice, as_floats
from stereodel._spaces import SPHERE
from stereodel.constants import SAME_LENGTH
from stereodel.interpolation.interpolator import Interpolator
from stereodel.interpolation.smooth import SmoothInterpolator
from stereodel.interpolation.weighted import LinearInterpolator, NaturalNeighborInterpolator, NearestInterpolator
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.delaunay import Triangulation, as_triangulation

Method = Literal["nearest", "linear", "natural", "smooth"]

METHODS: Final[dict[Method, type[Interpolator]]] = {
    "nearest": NearestInterpolator,
    "linear": LinearInterpolator,
    "natural": NaturalNeighborInterpolator,
    "smooth": SmoothInterpolator,
}
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
        `LinearInterpolator`, `NearestInterpolator`, `NaturalNeighborInterpolator` or `SmoothInterpolator`, which
        is what SciPy calls "cubic".
    fill_value : float, optional
        Value outside all triangles; not used by "nearest".
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
    return _as_in_scipy("griddata", as_method(method))(points, values, fill_value, latitude=latitude)(xi)


_ABOUT: Final = """As `scipy.interpolate.{name}`, in the plane and on the sphere: a `{kind}`.

Parameters
----------
points, values, fill_value, latitude
    As for `griddata`; `points` may be a triangulation, too, also one of SciPy's, whose points count.

Attributes
----------
tri : PlanarDelaunay or SphericalDelaunay
function : Interpolator

Raises
------
ValueError, TypeError
    As `griddata`, and for three columns of different lengths, which are directions here and space to SciPy.

Notes
-----
{notes}

Examples
--------
>>> from stereodel.interpolation import {name}
>>> {name}([[0, 0], [4, 0], [0, 4], [4, 4]], [0.0, 4.0, 8.0, 12.0])([1, 3], [0, 3]).round(9).tolist()
{found}
"""


class _Scattered:
    """The interpolator `_kind`, called as SciPy's."""

    _kind: ClassVar[type[Interpolator]]

    def __init__(
        self,
        points: npt.ArrayLike | Triangulation,
        values: npt.ArrayLike,
        fill_value: float = np.nan,
        *,
        latitude: Latitude | None = None,
    ) -> None:
        if not isinstance(points, Triangulation):
            # A triangulation of SciPy's, whose simplices are rounded, gives its points.
            given = _joined(getattr(points, "points", None) if hasattr(points, "simplices") else points, "points")
            by_lonlat: dict[str, Any] = {} if latitude is None else {"lonlat": given, "latitude": latitude}
            points = as_triangulation(None if by_lonlat else given, **by_lonlat)
        self._latitude, self.fill_value = latitude, float(fill_value)
        self.function = self._kind(points, values)
        self.tri = self.function.triangulation
        name, far = type(self).__name__, np.linalg.norm(self.tri.points, axis=1)
        curved = self.tri.surface is SPHERE
        if curved and name != "griddata" and far.max(initial=0.0) > (1 + SAME_LENGTH) * far.min(initial=np.inf):
            said = "points has three columns and rows of different lengths; here they are directions"
            advice = f"For points in space use scipy.interpolate.{name}, for directions of any length griddata"
            raise ValueError(f"{said}. {advice}")

    def __call__(self, *xi: Any) -> FloatArray:
        """Values at places, given as `xi` of `griddata` or coordinate by coordinate."""
        places: Any = _joined(xi[0] if len(xi) == 1 else xi, "xi")
        asked: dict[str, Any] = {"queries" if self._latitude is None else "lonlat": places}
        found = self.function(**asked)
        if self._kind is not NearestInterpolator and not np.isnan(self.fill_value):
            found[np.asarray(self.tri.find_simplex(**asked)) < 0] = self.fill_value
        return found


def _as_in_scipy(name: str, kind: type[Interpolator], found: str = "", notes: str = "") -> type[_Scattered]:
    text = _ABOUT.format(name=name, kind=kind.__name__, notes=notes, found=found)
    return type(name, (_Scattered,), {"__doc__": text, "__module__": __name__, "_kind": kind})


_NAMES: Final[tuple[tuple[str, type[Interpolator], str, str], ...]] = (
    ("LinearND", LinearInterpolator, "[1.0, 9.0]", "SciPy's values, up to rounding, where triangles are unique."),
    ("CloughTocher2D", SmoothInterpolator, "[1.0, 9.0]", "Another smooth function, by local fits, without `tol`."),
    ("NearestND", NearestInterpolator, "[0.0, 12.0]", "Exactly the nearest; `fill_value` is not used."),
)
LinearNDInterpolator, CloughTocher2DInterpolator, NearestNDInterpolator = (
    _as_in_scipy(f"{name}Interpolator", kind, found, notes) for name, kind, found, notes in _NAMES
)


def _joined(coordinates: Any, name: str) -> npt.ArrayLike:
    """Separate coordinates in a tuple, as rows."""
    if not isinstance(coordinates, tuple) or np.ndim(coordinates[0]) == 0:
        return coordinates
    columns = [as_floats(column, f"{name}[{k}]") for k, column in enumerate(coordinates)]
    return np.stack(np.broadcast_arrays(*columns), axis=-1)
