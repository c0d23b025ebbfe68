"""What `Delaunay` and `Voronoi` of SciPy have in common: options to Qhull, and points of the plane that can grow."""

from __future__ import annotations

import warnings
from functools import cached_property
from operator import attrgetter
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from scipy.spatial import QhullError

from stereodel._arrays import FloatArray, as_floats, as_points
from stereodel.triangulation import PlanarDelaunay

KNOWN = frozenset({"Qbb", "Qc", "Qz", "QJ", "Qs", "Qt", "Qx", "Q11", "Q12", "Q14", "Pp"})
"""All but the first three prevent, report or repair what rounding does to Qhull, or concern other dimensions."""

FAMILY: Final = {
    "parameters": """
        Parameters
        ----------
        points : (npoints, 2) array_like
            Finite numbers. Copied. Points of more dimensions are handed over to SciPy, with an `InexactWarning`.
        furthest_site : bool, optional
            True is handed over to SciPy as well.
        incremental : bool, optional
            Whether `add_points` may be called.
        qhull_options : str, optional
            "Qbb" (scaled paraboloid), "Qc" (points that are not vertices are listed and have a region, else -1) and
            "Qz" (a point at infinity, with an empty region) have the same meaning as in Qhull; "QJ", "Qs", "Qt", "Qx",
            "Q11", "Q12", "Q14" and "Pp" are accepted and ignored. Default: "Qbb Qc Qz", in incremental mode "Qc".
        strict : bool, optional
            Raise where SciPy does: `QhullError` for points on one line, two and one, ValueError for none.

        Raises
        ------
        ValueError, TypeError
            For points that are not finite real numbers of shape (npoints, 2), and unknown options.
        QhullError
            Only if `strict`; otherwise there are no triangles, and collinear points have ridges [-1, -1].
        """,
}
"""What the docstrings of both classes have in common."""


class InexactWarning(UserWarning):
    """Exactness ends here: the object is SciPy's own, computed by Qhull, where this library has nothing exact.

    That is with points of other dimensions, and with furthest sites.

    Examples
    --------
    >>> import warnings
    >>> from stereodel.spatial import Delaunay, InexactWarning
    >>> with warnings.catch_warnings(action="ignore", category=InexactWarning):
    ...     Delaunay([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]).simplices.shape
    (1, 4)
    """


def hand_over(one: Any, what: str, *arguments: Any) -> None:
    """Make an object under construction one of SciPy's class, which it is derived from, and say so."""
    theirs = next(base for base in type(one).__mro__ if base.__module__.startswith("scipy."))
    warnings.warn(
        f"points has {what}: exactness ends here, scipy.spatial.{theirs.__name__} takes over and rounds. To accept "
        'that: warnings.simplefilter("ignore", stereodel.spatial.InexactWarning)',
        InexactWarning,
        stacklevel=3,  # who constructs
    )
    one.__class__ = theirs
    one.__init__(*arguments)


def as_options(qhull_options: Any, incremental: bool) -> frozenset[str]:
    """Options to Qhull; TypeError or ValueError for what has no meaning here or that Qhull refuses.

    Left of them are "Qbb", the height of the paraboloid is scaled to the size of the coordinates; "Qz", there is a
    point at infinity, with an empty Voronoi region; "Qc", points that are not vertices are listed.
    """
    if not isinstance(qhull_options, str | None):
        raise TypeError(f"qhull_options must be a string or None, got {qhull_options!r}")
    if qhull_options is None:
        return frozenset({"Qc"} if incremental else {"Qbb", "Qc", "Qz"})
    words = frozenset(qhull_options.split())
    if unknown := sorted(words - KNOWN):
        said = f"qhull_options has {', '.join(map(repr, unknown))}; known here are {', '.join(sorted(KNOWN))}"
        raise ValueError(f"{said}. Leave it out, or use the class of scipy.spatial")
    if incremental and (refused := sorted(words & {"Qbb", "Qz"})):
        raise ValueError(f"qhull_options {', '.join(map(repr, refused))} cannot be used with incremental=True")
    return words


def copied(path: str, doc: str) -> Any:
    """A property: the array at a path of attributes, copied once, so that it can be written to."""
    made = cached_property(lambda owner: np.array(attrgetter(path)(owner)))
    made.__doc__ = doc
    return made


class GrowingPoints:
    """The constructor, the bounds and the life of both classes; arrays are made when asked for, and writable."""

    furthest_site = False
    ndim = 2

    def __init__(
        self,
        points: npt.ArrayLike,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: str | None = None,
        *,
        strict: bool = False,
    ) -> None:
        array = as_floats(points, "points")
        space = array.size > 0 and array.ndim == 2 and array.shape[1] > 2
        if space or furthest_site:
            what = f"{array.shape[1]} dimensions" if space else "furthest_site=True beside it"
            hand_over(self, what, array, furthest_site, incremental, qhull_options)
            return
        self._options = as_options(qhull_options, bool(incremental))
        self._incremental = bool(incremental)
        self._triangulation = PlanarDelaunay(as_points(array, 2, hint="columns are dimensions"))
        if strict and self._triangulation.dimension < 2:
            raise (QhullError if self.npoints else ValueError)(
                f"points has {self.npoints} rows, all on one line: no triangle; strict=False takes them"
            )

    points: FloatArray = copied("_triangulation.points", "Coordinates of the points, (npoints, 2).")

    @property
    def npoints(self) -> int:
        """Number of points."""
        return len(self._triangulation.points)

    @cached_property
    def min_bound(self) -> FloatArray:
        """Lowest coordinates, (2,); infinite without points."""
        return np.min(self._triangulation.points, axis=0, initial=np.inf)

    @cached_property
    def max_bound(self) -> FloatArray:
        """Highest coordinates, (2,); minus infinite without points."""
        return np.max(self._triangulation.points, axis=0, initial=-np.inf)

    def add_points(self, points: npt.ArrayLike, restart: bool = False) -> None:
        """Add points at the end; the result is that of all points at once.

        Parameters
        ----------
        points : (k, 2) array_like
        restart : bool, optional
            Without effect: the triangles are those of a fresh start in either case.

        Raises
        ------
        RuntimeError
            Unless constructed with ``incremental=True``, and after `close`.
        ValueError, TypeError
            For points that are not finite real numbers of shape (k, 2); nothing is added then.
        """
        if not self._incremental:
            raise RuntimeError("incremental mode not enabled or already closed; construct with incremental=True")
        added = as_points(points, 2)
        self._triangulation.insert(added)
        kept = "_options", "_incremental", "_triangulation"  # all else is computed anew when it is asked for
        self.__dict__ = {name: value for name, value in vars(self).items() if name in kept}

    def close(self) -> None:
        """End the incremental mode: no more points can be added."""
        self._incremental = False
