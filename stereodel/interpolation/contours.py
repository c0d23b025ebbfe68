"""Contours of values in triangles, as oriented polylines (row P22 of the ledger: triangulated networks)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, BoolArray, FloatArray, Keyed, as_levels, as_values, read_only
from stereodel._docs import shared
from stereodel._notebook import Displayed
from stereodel.interpolation.interpolator import FAMILY, PrecisePoints, one_value_a_place
from stereodel.sphere.coordinates import as_told
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.delaunay import Triangulation, as_triangulation, state_of


@dataclass(frozen=True, eq=False)
class Contour(Keyed, Displayed):
    """A connected component of a contour.

    Parameters
    ----------
    level : float
        The value along it.
    points : (k, 2) or (k, 3) array
        Vertices of the polyline, at least two: points of the plane, joined by segments, or unit vectors, joined by
        great-circle arcs. Higher values lie on the left, as seen from outside the sphere. Read-only.
    closed : bool
        Whether it is a ring; then the last point repeats the first. Otherwise it ends at the hull or next to a NaN.
    latitude : str, optional
        The kind of latitude by which the points of the triangulation were given.

    Examples
    --------
    >>> Contour(0.5, np.array([[0.0, 1.0], [1.0, 1.0]]), False).closed
    False
    """

    level: float
    points: FloatArray
    closed: bool
    latitude: Latitude | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", read_only(self.points))

    @property
    def _key(self) -> tuple[object, ...]:
        return (self.level, self.closed, self.latitude, self.points.shape, *self.points.ravel().tolist())

    @property
    def lonlat(self) -> FloatArray:
        """Longitude and latitude of `points`, (k, 2) in degrees, if the triangulation is one of such points."""
        return as_told(self.points, self.latitude)


@shared(**FAMILY)
def contours(points: npt.ArrayLike | Triangulation, values: npt.ArrayLike, levels: npt.ArrayLike) -> list[Contour]:
    """Contours of the function that is linear in each triangle, `LinearInterpolator`.

    {points}
    values : (n,) array_like
        One number for each point; triangles with a NaN are skipped.
    levels : float or (l,) array_like
        Values along the contours.

    Returns
    -------
    list of Contour
        Contours level by level, in the order given; with `lonlat` if the triangulation was made from longitude and
        latitude.

    Raises
    ------
    ValueError, TypeError
        As for the triangulation; if a value is infinite or not a real number, their number differs from that of the
        points, or a level is not finite.

    Notes
    -----
    A value equal to the level counts as above it. So a triangle has one piece of a contour or none, and each piece
    joins the next across an edge: contours neither break nor branch, and meet at most in points that have the level's
    value. Contours that shrink to such a point are omitted. The topology follows from comparisons alone; only the
    points where contours cross edges are rounded.

    For smoother contours, evaluate a `SmoothInterpolator` at more points first.

    Examples
    --------
    >>> (ridge,) = contours([[0, 0], [2, 0], [2, 2], [0, 2]], [0, 4, 4, 0], 1)
    >>> ridge.closed, ridge.points.tolist()
    (False, [[0.5, 2.0], [0.5, 1.5], [0.5, 0.0]])
    """
    triangulation = as_triangulation(points)
    array = as_values(values, len(triangulation.points))
    if array.ndim != 1:
        raise ValueError(f"values must be one number for each point, got shape {array.shape}")
    merged = one_value_a_place(triangulation, array[:, None])[:, 0]
    places = PrecisePoints(triangulation.points)
    inside: BoolArray = state_of(triangulation).open & ~np.isnan(merged[triangulation.simplices]).any(axis=1)
    return [
        Contour(level, piece, closed, triangulation.latitude)
        for level in as_levels(levels).tolist()
        for piece, closed in _pieces(triangulation, places, merged, inside, level)
    ]


def _pieces(
    triangulation: Triangulation, places: PrecisePoints, values: FloatArray, inside: BoolArray, level: float
) -> Iterator[tuple[FloatArray, bool]]:
    """All pieces of one level in the triangles inside, and which of them are rings."""
    simplices = triangulation.simplices
    corners_above = (values >= level)[simplices]
    count = corners_above.sum(axis=1)
    crossed = np.flatnonzero(inside & (count > 0) & (count < 3))
    # The corner that differs from the two others; the contour keeps it on the left if it is above.
    lone_above = count[crossed] == 1
    lone = (corners_above[crossed] == lone_above[:, None]).argmax(axis=1)
    entry, exit_ = (lone + np.where(lone_above, 2, 1)) % 3, (lone + np.where(lone_above, 1, 2)) % 3
    number = np.full(len(simplices) + 1, -1)
    number[crossed] = np.arange(len(crossed))

    def crossings(opposite: AnyIndices) -> FloatArray:
        """Where the contour crosses the edges opposite these corners, alike from both sides."""
        one, other = (simplices[crossed, (opposite + k) % 3] for k in (1, 2))
        swap = values[one] < level
        high, low = np.where(swap, other, one), np.where(swap, one, other)
        # Halves: the difference of two large values of opposite sign may overflow.
        drop = values[high] / 2 - level / 2
        fraction = (drop / (values[high] / 2 - values[low] / 2))[:, None]
        begin = places.take(high)
        start = begin.rounded.T
        points = start + fraction * (places.take(low) - begin).T
        if places.curved:
            points = np.where(fraction > 0, points / np.sqrt((points**2).sum(axis=1, keepdims=True)), start)
        return points

    ins, outs = crossings(entry), crossings(exit_)
    for chain, closed in chains(number[triangulation.neighbors[crossed, exit_]]):
        points = np.concatenate([ins[chain], outs[chain[-1:]]])
        points = points[np.concatenate([[True], (points[1:] != points[:-1]).any(axis=1)])]
        if len(points) > 1:
            yield points, closed


def chains(following: AnyIndices) -> list[tuple[list[int], bool]]:
    """Chains of indices of a one-to-one map, -1 where it ends, open ones first, and which of them are rings."""
    after = following.tolist()
    begins = np.setdiff1d(np.arange(len(after)), following)
    seen = [False] * len(after)
    found = []
    for start in [*begins.tolist(), *range(len(after))]:
        if seen[start]:
            continue
        chain, at = [], start
        while at >= 0 and not seen[at]:
            seen[at] = True
            chain.append(at)
            at = after[at]
        found.append((chain, at >= 0))
    return found
