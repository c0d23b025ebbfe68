"""Images of Shapely geometries under conformal maps, one function for each geometry type.

Imported only where Shapely is needed.
"""

from __future__ import annotations

import numpy as np

from stereodel._arrays import Geometries, Indices, as_lonlat
from stereodel.conformal import MoebiusMap
from stereodel.constants import FINER_WARPS
from stereodel.curves import clip
from stereodel.curves.borders import Antimeridian, Pieces
from stereodel.curves.ragged import Ragged
from stereodel.curves.seams import left_inside, stitched
from stereodel.curves.trace import Edges, sides_of, unwrapped
from stereodel.io.map_shapes import COLLECTION, LINE, MULTILINE, MULTIPOINT, MULTIPOLYGON, POINT, POLYGON, RING
from stereodel.io.maps.on_map import close_in_longitude, lines_on_map, polygons_on_map, repaired, shapely
from stereodel.sphere import lonlat_to_xyz, xyz_to_lonlat

BORDER = Antimeridian()


def images_of(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    """The images of geometries (n,), computed by type; chords on the map deviate from them by at most `slack`."""
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
    return np.asarray(shapely.transform(geometries, lambda lonlat: xyz_to_lonlat(lens(lonlat_to_xyz(lonlat)))))


def _collections(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    parts, owner = shapely.get_parts(geometries, return_index=True)
    images = images_of(parts, lens, slack)
    return np.array([shapely.GeometryCollection(images[owner == number].tolist()) for number in range(len(geometries))])


def _lines(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    parts, owner = shapely.get_parts(geometries, return_index=True)
    lonlat, part = shapely.get_coordinates(parts, return_index=True)
    lines = unwrapped(Ragged.grouped(lonlat, part, len(parts)))
    first, sides = sides_of(lines)
    edges = Edges.straight(lines.values[first], lines.values[first + 1])
    pieces = BORDER.cut(edges.arcs_under(lens, slack / 4).through(lens))
    return lines_on_map(sides, owner, len(geometries), pieces, _sampled(pieces, slack), BORDER)


def _polygons(geometries: Geometries, lens: MoebiusMap, slack: float) -> Geometries:
    """The images of polygons; those that cross themselves are sampled as finely as they are wide: 2 area/length."""
    polygons, geometry = shapely.get_parts(geometries, return_index=True)
    rings, polygon = shapely.get_rings(polygons, return_index=True)
    lonlat, ring = shapely.get_coordinates(rings, return_index=True)
    outer = np.append(True, polygon[1:] != polygon[:-1])
    outlines, owner = left_inside(Ragged.grouped(lonlat, ring, len(rings)), outer), geometry[polygon]
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
    images, _ = polygons_on_map(loops, region, count)
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
