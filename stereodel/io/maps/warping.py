"""Conformal maps of Shapely geometries, for libraries that draw longitude and latitude: cartopy, GeoPandas."""

from __future__ import annotations

from typing import Any

import numpy as np

from stereodel._arrays import Geometries, Indices, as_lonlat, as_scalar
from stereodel._extras import optional
from stereodel.conformal import MoebiusMap
from stereodel.constants import FINER_WARPS
from stereodel.curves import clip
from stereodel.curves.borders import Antimeridian, Pieces
from stereodel.curves.insides import oriented
from stereodel.curves.ragged import Ragged
from stereodel.curves.seams import stitched
from stereodel.curves.trace import Edges, sides_of, unwrapped
from stereodel.io.formats.map_rows import shapely, unpacked
from stereodel.io.maps.on_map import close_in_longitude, lines_on_map, polygons_on_map, repaired
from stereodel.sphere import lonlat_to_xyz, xyz_to_lonlat


def warp(shapes: Any, lens: MoebiusMap, *, tolerance: float = 0.01) -> Any:
    """The images of geometries under a conformal map, as geometries of longitude and latitude.

    Parameters
    ----------
    shapes : geometry, array_like of geometries, GeoSeries or GeoDataFrame
        In degrees; frames in another coordinate system are transformed. Polygons are valid, cut at ±180°, with edges
        straight in longitude and latitude; lines that jump by more than 180° continue across ±180°. Heights are lost.
    lens : MoebiusMap
    tolerance : float
        Largest deviation of the straight segments of the result from the exact image, in degrees on the sphere.

    Returns
    -------
    geometry, ndarray of geometries, GeoSeries or GeoDataFrame
        Same type and order as the input, None and empty geometries unchanged, with new vertices where edges bend.
        Polygons are valid, cut at ±180° and closed along ±90° around poles that they contain; parts that met at ±180°
        are merged if they no longer lie there. A polygon may become a MultiPolygon, a line a MultiLineString.

    Raises
    ------
    ValueError
        If a latitude is outside [−90, 90], or `tolerance` outside (0, 45].
    ImportError
        If Shapely is missing (the extra ``geo``).

    Notes
    -----
    The image of a great-circle arc is a circular arc in closed form: an edge near the focus is as exact as any other.
    The chords of a polygon narrower than 2⁻⁸ of the tolerance may cross: it becomes a row of slivers that deviate by no
    more than the tolerance. Below 1e-8 degrees, and at a pole, its sides may have the same chords: it is then empty.

    Examples
    --------
    >>> import shapely
    >>> from stereodel import fisheye
    >>> square = shapely.box(0, 40, 5, 45)
    >>> larger = warp(square, fisheye((2.5, 42.5), magnification=4))
    >>> larger.is_valid, [round(side) for side in larger.bounds]
    (True, [-9, 32, 14, 52])
    """
    optional("shapely", "geo")
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
    """The images of geometries (n,), computed by type; chords on the map deviate from them by at most `slack`."""
    images = np.array(shapely.force_2d(geometries), dtype=object)
    as_lonlat(shapely.get_coordinates(images), "shapes")
    kinds = np.where(shapely.is_empty(images), -1, shapely.get_type_id(images))
    of = shapely.GeometryType
    for wanted, image in (
        ((of.POINT, of.MULTIPOINT), _points),
        ((of.LINESTRING, of.LINEARRING, of.MULTILINESTRING), _lines),
        ((of.POLYGON, of.MULTIPOLYGON), _polygons),
        ((of.GEOMETRYCOLLECTION,), _collections),
    ):
        chosen = np.flatnonzero(np.isin(kinds, wanted))
        if len(chosen):
            images[chosen] = image(images[chosen], lens, slack)
    return images


def _points(geometries: Geometries, lens: MoebiusMap, _: float) -> Geometries:
    return np.asarray(shapely.transform(geometries, lambda lonlat: xyz_to_lonlat(lens(lonlat_to_xyz(lonlat)))))


def _collections(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    parts, owner = shapely.get_parts(geometries, return_index=True)
    images = _images(parts, lens, slack)
    return np.array([shapely.GeometryCollection(images[owner == number].tolist()) for number in range(len(geometries))])


def _lines(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    parts, owner = shapely.get_parts(geometries, return_index=True)
    lonlat, part = shapely.get_coordinates(parts, return_index=True)
    lines = unwrapped(Ragged.grouped(lonlat, part, len(parts)))
    first, sides = sides_of(lines)
    edges = Edges.straight(lines.values[first], lines.values[first + 1])
    border = Antimeridian()
    pieces = border.cut(edges.arcs_under(lens, slack / 4).through(lens))
    images = lines_on_map(sides, owner, len(geometries), pieces, _sampled(pieces, slack), border)
    return unpacked(images, shapely.LineString())


def _polygons(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    """The images of polygons; those that cross themselves are sampled as finely as they are wide: 2 area/length."""
    polygons, geometry = shapely.get_parts(geometries, return_index=True)
    rings, polygon = shapely.get_rings(polygons, return_index=True)
    lonlat, ring = shapely.get_coordinates(rings, return_index=True)
    hole = np.append(False, polygon[1:] == polygon[:-1])
    outlines, _ = oriented(Ragged.grouped(lonlat, ring, len(rings)), hole)
    owner = geometry[polygon]
    images = _filled(outlines, owner, len(geometries), lens, slack)
    wrong = ~shapely.is_valid(images)
    length = shapely.length(geometries)
    width = np.radians(2 * shapely.area(geometries) * shapely.length(images) / length**2) / slack
    for finer in FINER_WARPS:
        some = np.flatnonzero(wrong & (width >= 16 * finer))
        wrong[some] = False
        if len(some):
            chosen = np.isin(owner, some)
            number = np.searchsorted(some, owner[chosen])
            images[some] = _filled(outlines.take(chosen), number, len(some), lens, slack * finer)
    return repaired(images, ~shapely.is_valid(images))


def _filled(outlines: Ragged, owner: Indices, count: int, lens: MoebiusMap, slack: float) -> Geometries:
    start, end, rings, owner = stitched(outlines, owner)
    edges, border = Edges.straight(start, end), Antimeridian(blur=slack)
    pieces = border.cut(edges.arcs_under(lens, slack / 4).through(lens))
    loops, region = clip.regions(rings, owner, count, pieces, _sampled(pieces, slack), border, left=edges.left(rings))
    images = unpacked(polygons_on_map(loops, region, count)[0], shapely.Polygon())
    # A polygon without a border on the sphere covers all of it.
    images[np.setdiff1d(np.arange(count), owner)] = shapely.box(-180.0, -90.0, 180.0, 90.0)
    return images


def _sampled(pieces: Pieces, slack: float) -> Ragged:
    """Points on pieces, close enough that chords on the map deviate from the images of edges by at most `slack`.

    A quarter of it is taken by `straight`, another quarter by the distance between chord and circle: c²/(8 r) for a
    chord of length c on a circle of radius r ≤ 1, so that c² ≤ 2 slack. The rest is for the map: between the ends of
    such a chord a great circle deviates from the straight line in longitude and latitude by |sin φ|·√((c² cos φ)² + (2
    c²)²)/8 ≤ c²/4.
    """
    return close_in_longitude(pieces.arcs.sampled(slack / 4), float(np.sqrt(2 * slack)))
