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
    Lines and sides of polygons are straight on the map of longitude and latitude, as in GIS and GeoJSON; distances are
    those of the sphere to arcs that follow them within 1e-8 radians, 6 cm on the Earth. Of shapes as near within twice
    that, those that contain the place come first, then the first of all. With authalic latitudes and the mean radius,
    distances are within 0.12 % of those on the ellipsoid.

    Examples
    --------
    >>> from stereodel import data
    >>> countries = data.countries("110m")
    >>> shape, distance = nearest_shapes([(2.2, 41.2), (10.0, 48.4)], countries)
    >>> print(countries.name[shape], distance.round(1))
    ['Spain' 'Germany'] [8.2 0. ]
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
    # Of great circles, of parallels too. Bounds of what these deviate are those of the sphere's own latitudes: f(φ) for
    # geodetic φ has |f' − 1| ≤ e² and |f''| ≤ 2e² |sin 2φ|, which adds up to 3e² of them, 2 %.
    edges = replace(Edges.straight(a, b, latitude), exact=np.zeros(len(shape), dtype=np.bool_))
    arcs = edges.arcs_under(MoebiusMap.identity(), OUTLINE_TOLERANCE / 1.03)
    # Cut to their mean length, arcs become at most twice as many.
    length = arcs.stop - arcs.begin
    parts = np.ceil(np.divide(length, length.mean(), out=np.ones(len(arcs)), where=length > 0))
    chords = arcs.spread(parts.astype(np.intp))
    first, sides = sides_of(chords)
    points, row = np.unique(lonlat_to_xyz(places, latitude=latitude), axis=0, return_inverse=True)
    nearest = _nearest(points, chords.values[first], chords.values[first + 1], shape[arcs.edge[sides.row]])
    number, distance = (of[row.ravel()] for of in nearest)
    for begin in range(0, len(places), BLOCK // 32):
        block = slice(begin, begin + BLOCK // 32)
        polygons = found.rings, found.ring_polygon, len(found.polygon_feature)
        place, polygon = on_the_left(*polygons, places[block], straight=True)[1]
        number[block][place[distance[block][place] > STORED_ERROR]], distance[block][place] = len(shape), 0.0
        np.minimum.at(number[block], place, found.polygon_feature[polygon])
    return number, distance * scale


def _nearest(points: FloatArray, start: FloatArray, end: FloatArray, shape: Indices) -> tuple[Indices, FloatArray]:
    """The shape of the arc nearest to each point, of those within the tolerance the first; and the angle."""
    axis, middle, count = great_axes(start, end), units(start + end), len(shape)
    sides, half = (crossed(axis, start), crossed(end, axis)), _angles(start, end).max() / 2
    middles, number, angle = as_triangulation(middle), np.zeros(len(points), dtype=np.intp), np.zeros(len(points))
    rest, looked_at = np.arange(len(points)), min(FEW, count)
    while len(rest):
        unsure = []
        for rows in np.array_split(rest, len(rest) * looked_at // BLOCK + 1):
            arc, asked = np.asarray(middles.nearest(points[rows], k=looked_at)), points[rows, None]
            foot = asked - (height := _dots(asked, axis[arc]))[..., None] * axis[arc]
            # The foot is on the arc if it is between the planes through the axis and an end; if not, an end is nearest.
            between = (_dots(asked, sides[0][arc]) > 0) & (_dots(asked, sides[1][arc]) > 0)
            across = np.arctan2(np.abs(height), np.sqrt(_dots(foot, foot)))
            far = np.where(between, across, np.minimum(_angles(asked, start[arc]), _angles(asked, end[arc])))
            angle[rows] = far.min(axis=1)
            tied = angle[rows] + 2 * OUTLINE_TOLERANCE
            number[rows] = np.where(far <= tied[:, None], shape[arc], shape.max()).min(axis=1)
            # No arc farther on is nearer than the last middle less half the length of the longest.
            unsure.append(rows[_angles(points[rows], middle[arc[:, -1]]) - half <= tied])
        rest = np.concatenate(unsure if looked_at < count else [rest[:0]])
        looked_at = min(4 * looked_at, count)
    return number, angle


def _angles(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(2 * np.arctan2(*(np.sqrt(_dots(c, c)) for c in (a - b, a + b))))


def _dots(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("...i,...i->...", a, b))
