"""Points of the plane to which more can be added: the common part of SciPy's `Delaunay` and `Voronoi`."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_points
from stereodel.spatial.options import Options, as_options
from stereodel.triangulation import PlanarDelaunay


def other_dimensions(kind: type) -> str:
    """What helps who has points of other dimensions: to compute these inexactly in silence would break a promise."""
    return f"for other dimensions: from scipy.spatial import {kind.__name__}"


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
    ) -> None:
        self._options: Options = as_options(qhull_options, furthest_site, bool(incremental))
        self._incremental = bool(incremental)
        self._triangulation = PlanarDelaunay(as_points(points, 2, hint=other_dimensions(type(self))))

    @cached_property
    def points(self) -> FloatArray:
        """Coordinates of the points, (npoints, 2)."""
        return np.array(self._triangulation.points)

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
            Whether to start from scratch, which changes only the order of rows.

        Raises
        ------
        RuntimeError
            Unless constructed with ``incremental=True``, and after `close`.
        ValueError, TypeError
            For points that are not finite real numbers of shape (k, 2); nothing is added then.
        """
        if not self._incremental:
            raise RuntimeError("incremental mode not enabled or already closed; construct with incremental=True")
        added = as_points(points, 2, hint=other_dimensions(type(self)))
        if restart:
            self._triangulation = PlanarDelaunay(np.concatenate([self._triangulation.points, added]))
        else:
            self._triangulation.insert(added)
        self._forget()

    def close(self) -> None:
        """End the incremental mode: no more points can be added."""
        self._incremental = False

    def _forget(self) -> None:
        for name in [name for name in vars(self) if isinstance(getattr(type(self), name, None), cached_property)]:
            del vars(self)[name]
