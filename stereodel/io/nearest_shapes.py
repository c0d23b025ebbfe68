"""Which points, lines and polygons are nearest to places of the Earth, and how far away."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Indices, as_lonlat, as_points, as_scalar
from stereodel.conformal import MoebiusMap
from stereodel.constants import OUTLINE_TOLERANCE, STORED_ERROR
from stereodel.curves.clip import together
from stereodel.curves.insides import on_the_left
from stereodel.curves.trace import Edges, great_axes, sides_of, unwrapped
from stereodel.earth import MEAN_RADIUS_KM
from stereodel.io.reading import Shapes, shapes_of
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import crossed, units
from stereodel.triangulation.delaunay import as_triangulation

FEW: Final = 8
"""Arcs looked at first for each place; then four times as many, for those that need it."""

BLOCK: Final = 2**19
"""Pairs of places and arcs at a time: 100 MB."""


def nearest_shapes(
    lonlat: npt.ArrayLike, shapes: Any, *, latitude: Latitude = "authalic", radius: float = MEAN_RADIUS_KM
) -> tuple[Indices, FloatArray]:
    """The shape nearest to each place, and how far away it is: 0 within a polygon, else the distance to its outline.

    Parameters
    ----------
    lonlat : (n, 2) array_like
        Longitude and latitude of the places, degrees.
    shapes : path-like, GeoDataFrame, geometries or GeoJSON
        Points, lines and polygons, in degrees or with a coordinate system of their own; a row or feature is a shape.
    latitude : {"spherical", "geodetic", "authalic"}
        As in `lonlat_to_xyz`: kind of latitude, of places and shapes.
    radius : float
        Of the sphere; distances are in its unit, by default kilometres.

    Returns
    -------
    shape, distance : (n,) arrays
        Number of the shape, from 0, and how far away it is.

    Raises
    ------
    ValueError
        If there are no shapes, or for coordinates or an option out of range.

    Notes
    -----
    Lines and sides of polygons are straight on the map of longitude and latitude, as in GIS and GeoJSON. Distances are
    those of the sphere to arcs that follow them within 1e-8 radians, 6 cm on the Earth. So no other shape is nearer by
    more than twice that. Of shapes as near, those that contain the place come first, then the first of all. With
    authalic latitudes and the mean radius, distances are within 0.12 % of those on the ellipsoid.

    Examples
    --------
    >>> from stereodel import data
    >>> shape, distance = nearest_shapes([(-30.0, 40.0), (10.0, 48.4)], data.countries())
    >>> print(data.countries().name[shape], distance.round(1))
    """
    places, scale = as_lonlat(as_points(lonlat, 2, "lonlat")), as_scalar(radius, "radius", low=0.0, open_low=True)
    found = shapes if isinstance(shapes, Shapes) else shapes_of(shapes)
    drawn = unwrapped(together(found.lines, found.rings))
    first, sides = sides_of(drawn)
    owner = np.append(found.line_feature, found.polygon_feature[found.ring_polygon])
    shape = np.append(found.point_feature, owner[sides.row])
    if not len(shape):
        raise ValueError("shapes hold no points, lines or polygons; give a source that does")
    a, b = (np.concatenate([found.points, drawn.values[at]]) for at in (first, first + 1))
    edges = Edges.straight(a, b, latitude)
    edges = replace(edges, exact=np.zeros(len(shape), dtype=np.bool_))  # arcs of parallels become great circles, too
    arcs = edges.arcs_under(MoebiusMap.identity(), OUTLINE_TOLERANCE)
    # Cut to their mean length, arcs become at most twice as many.
    length = arcs.stop - arcs.begin
    parts = np.ceil(np.divide(length, length.mean(), out=np.ones(len(arcs)), where=length > 0))
    chords = arcs.spread(parts.astype(np.intp))
    first, sides = sides_of(chords)
    near = _Arcs(chords.values[first], chords.values[first + 1], shape[arcs.edge[sides.row]])
    points, row = np.unique(lonlat_to_xyz(places, latitude=latitude), axis=0, return_inverse=True)
    number, distance = (of[row.ravel()] for of in near.nearest(points))
    for begin in range(0, len(places), BLOCK // 32):
        block = slice(begin, begin + BLOCK // 32)
        polygons = found.rings, found.ring_polygon, len(found.polygon_feature)
        place, polygon = on_the_left(*polygons, places[block], straight=True)[1]
        number[block][place[distance[block][place] > STORED_ERROR]], distance[block][place] = len(shape), 0.0
        np.minimum.at(number[block], place, found.polygon_feature[polygon])
    return number, distance * scale


class _Arcs:
    """Arcs of great circles, between unit vectors, in any order, and the shape of each."""

    def __init__(self, start: FloatArray, end: FloatArray, shape: Indices) -> None:
        self._ends, self._axis, self._shape = (start, end), great_axes(start, end), shape
        self._middle = units(start + end)
        self._sides = crossed(self._axis, start), crossed(end, self._axis)
        self._half = _angles(start, end).max() / 2

    def angles(self, points: FloatArray, arc: Indices) -> FloatArray:
        """To arcs: across, if the foot is between the planes through axis and ends, or else to an end."""
        axis = self._axis[arc]
        height = _dots(points, axis)
        across = np.arctan2(np.abs(height), np.sqrt(_dots(foot := points - height[..., None] * axis, foot)))
        between = (_dots(points, self._sides[0][arc]) > 0) & (_dots(points, self._sides[1][arc]) > 0)
        return np.where(between, across, np.minimum(*(_angles(points, end[arc]) for end in self._ends)))

    def nearest(self, points: FloatArray) -> tuple[Indices, FloatArray]:
        """The shape nearest to each point (n, 3), and the angle; of those within the tolerance the first."""
        middles, count = as_triangulation(self._middle), len(self._shape)
        number, angle = np.zeros(len(points), dtype=np.intp), np.zeros(len(points))
        rest, looked_at = np.arange(len(points)), min(FEW, count)
        while len(rest):
            unsure = []
            for rows in np.array_split(rest, len(rest) * looked_at // BLOCK + 1):
                arc = np.asarray(middles.nearest(points[rows], k=looked_at))
                far = self.angles(points[rows, None], arc)
                least = far.min(axis=1) + 2 * OUTLINE_TOLERANCE
                angle[rows] = far.min(axis=1)
                number[rows] = np.where(far <= least[:, None], self._shape[arc], count).min(axis=1)
                # No further arc is nearer than the last middle less half the length of the longest.
                unsure.append(rows[_angles(points[rows], self._middle[arc[:, -1]]) - self._half <= least])
            rest = np.concatenate(unsure if looked_at < count else [rest[:0]])
            looked_at = min(4 * looked_at, count)
        return number, angle


def _angles(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(2 * np.arctan2(*(np.sqrt(_dots(c, c)) for c in (a - b, a + b))))


def _dots(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("...i,...i->...", a, b))
