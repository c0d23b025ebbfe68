"""Shapely geometries through conformal maps, for libraries that draw longitude and latitude: cartopy, GeoPandas."""

from __future__ import annotations

from typing import Any

import numpy as np

from stereodel._arrays import FloatArray, as_lonlat, as_scalar
from stereodel._extras import optional
from stereodel.conformal import MoebiusMap
from stereodel.constants import FINER_WARPS
from stereodel.io.arcs import Chains, chains_along
from stereodel.io.faces import Indices
from stereodel.io.lines import lines_on_map
from stereodel.io.outlines import Outlines, outlines_of
from stereodel.io.polygons import Geometries, repaired
from stereodel.io.shells import regions_on_map
from stereodel.sphere import lonlat_to_xyz, xyz_to_lonlat

POINT, LINE, RING, POLYGON, MULTIPOINT, MULTILINE, MULTIPOLYGON, COLLECTION = range(8)
"""Types of geometries in Shapely's numbering."""


def warp(shapes: Any, lens: MoebiusMap, *, tolerance: float = 0.01) -> Any:
    """The images of geometries under a conformal map, as geometries of longitude and latitude again.

    Parameters
    ----------
    shapes : geometry, array_like of geometries, GeoSeries or GeoDataFrame
        In degrees, polygons as GeoJSON and shapefiles have them: valid, cut at ±180°, straight in longitude and
        latitude between their vertices. Frames in another coordinate system are transformed to EPSG:4326 first. Heights
        are dropped.
    lens : MoebiusMap
    tolerance : float
        How far what is straight on the resulting map may stray from the image, degrees on the sphere.

    Returns
    -------
    geometry, ndarray of geometries, GeoSeries or GeoDataFrame
        What was given, in the same order, None and empty geometries as they were. In [−180, 180] × [−90, 90], with new
        vertices where edges bend. Polygons are valid, cut at ±180° and led around poles that they hold; parts that met
        at ±180° are one where they no longer do. So a polygon may become a MultiPolygon, and a line a MultiLineString.

    Raises
    ------
    ValueError
        For a latitude outside [−90, 90], or a tolerance outside (0, 45].
    ImportError
        Without Shapely (``pip install stereodel[geo]``).

    Notes
    -----
    The image of a great-circle arc is an arc of a circle, which is followed as such; no image is searched for by
    halving, so that an edge that passes the focus closely is as exact as any other. The inside of a polygon is on the
    left of its border, where a conformal map keeps it, however large it becomes.

    Examples
    --------
    >>> import shapely
    >>> from stereodel import fisheye
    >>> square = shapely.box(0, 40, 5, 45)
    >>> larger = warp(square, fisheye((2.5, 42.5), magnification=4))
    >>> larger.is_valid, [round(side) for side in larger.bounds]
    (True, [-9, 32, 14, 52])
    """
    shapely = optional("shapely", "geo")
    slack = float(np.radians(as_scalar(tolerance, "tolerance", low=0.0, high=45.0, open_low=True)))
    if hasattr(shapes, "set_geometry"):
        return shapes.set_geometry(warp(shapes.geometry, lens, tolerance=tolerance))
    if hasattr(shapes, "crs") and hasattr(shapes, "to_crs"):
        degrees = shapes.to_crs("EPSG:4326") if shapes.crs is not None else shapes
        images = _images(np.asarray(degrees, dtype=object), lens, slack)
        return type(shapes)(images, index=shapes.index, crs=degrees.crs, name=shapes.name)
    array = np.asarray(shapes, dtype=object)
    images = _images(array.ravel(), lens, slack).reshape(array.shape)
    return images[()] if isinstance(shapes, shapely.Geometry) else images


def _images(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    """The images of geometries (n,), those of one kind together."""
    shapely = optional("shapely", "geo")
    images = np.array(shapely.force_2d(geometries), dtype=object)
    as_lonlat(shapely.get_coordinates(images), "shapes")
    kinds = np.where(shapely.is_empty(images), -1, shapely.get_type_id(images))
    for wanted, image in (
        ((POINT, MULTIPOINT), _points),
        ((LINE, RING, MULTILINE), _lines),
        ((POLYGON, MULTIPOLYGON), _polygons),
        ((COLLECTION,), _collections),
    ):
        chosen = np.flatnonzero(np.isin(kinds, wanted))
        if len(chosen):
            images[chosen] = image(images[chosen], lens, slack)
    return images


def _points(geometries: Geometries, lens: MoebiusMap, _: float) -> Geometries:
    moved: Geometries = optional("shapely", "geo").transform(
        geometries, lambda lonlat: xyz_to_lonlat(lens(lonlat_to_xyz(lonlat)))
    )
    return moved


def _collections(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    shapely = optional("shapely", "geo")
    parts, owner = shapely.get_parts(geometries, return_index=True)
    images = _images(parts, lens, slack)
    moved: Geometries = np.array(
        [shapely.GeometryCollection(images[owner == number].tolist()) for number in range(len(geometries))]
    )
    return moved


def _lines(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    shapely = optional("shapely", "geo")
    parts, owner = shapely.get_parts(geometries, return_index=True)
    lonlat, part = shapely.get_coordinates(parts, return_index=True)
    offsets = np.searchsorted(part, np.arange(len(parts) + 1))
    lines = lines_on_map(chains_of(lonlat, offsets, lens, slack), len(parts))
    pieces, number = shapely.get_parts(lines, return_index=True)
    return joined(pieces, owner[number], len(geometries))


def joined(pieces: Geometries, owner: Indices, count: int) -> Geometries:
    """One geometry for each owner, several pieces as one of many parts; none is an empty line."""
    shapely = optional("shapely", "geo")
    result = np.full(count, shapely.LineString())
    counts = np.bincount(owner, minlength=count)
    result[counts == 1] = pieces[counts[owner] == 1]
    for number in np.flatnonzero(counts > 1):
        result[number] = shapely.line_merge(shapely.multilinestrings(pieces[owner == number]))
    return result


def chains_of(lonlat: FloatArray, offsets: Indices, lens: MoebiusMap, slack: float) -> Chains:
    """The images of lines straight in longitude and latitude, as points that straight lines on the map may join.

    With chords of the length c, at most, in longitude and latitude a great circle strays from what is straight on the
    map by |sin φ|·√((c² cos φ)² + (2 c²)²)/8 ≤ c²/4. Images are followed to half the slack, with chords that stray from
    their circles by a quarter of it: of a circle of radius r ≤ 1 by c²/(8 r), so that c² ≤ 2 slack, and all is within
    the slack.
    """
    from stereodel.globe.lines import SphereLines  # which brings the libraries of pictures with it

    points, ends = SphereLines.of_lonlat(lonlat, offsets).through(lens, tolerance=slack / 2)
    owner = np.repeat(np.arange(len(ends) - 1), np.diff(ends))
    return chains_along(np.array(points), owner, float(np.sqrt(2 * slack)), "spherical")


def _polygons(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    """The images of polygons; those that cross themselves, where they are narrow, are followed more closely."""
    shapely = optional("shapely", "geo")
    outlines = outlines_of(geometries)
    images = _filled(outlines, lens, slack)
    wrong = ~shapely.is_valid(images)
    for finer in FINER_WARPS:
        if not wrong.any():
            break
        some = np.flatnonzero(wrong)
        images[some] = _filled(outlines.subset(some), lens, slack * finer)
        wrong[some] = ~shapely.is_valid(images[some])
    return repaired(images, wrong)


def _filled(outlines: Outlines, lens: MoebiusMap, slack: float) -> Geometries:
    chains = chains_of(outlines.lonlat, outlines.offsets, lens, slack)
    return regions_on_map(chains, outlines.owner, outlines.everything)
