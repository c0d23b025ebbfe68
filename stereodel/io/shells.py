"""Rings on the sphere that bound regions of any size and shape, as polygons on the map."""

from __future__ import annotations

import numpy as np

from stereodel._arrays import BoolArray, FloatArray
from stereodel._extras import optional
from stereodel.io.arcs import Chains
from stereodel.io.boxes import close_along
from stereodel.io.faces import Indices
from stereodel.io.polygons import Geometries, grouped
from stereodel.io.rings import WORLD, border_pieces, gathered


def regions_on_map(chains: Chains, owner: Indices, everything: BoolArray) -> Geometries:
    """Polygons and MultiPolygons of regions by their borders, which are closed chains with the inside on the left.

    Parameters
    ----------
    chains : Chains
        As many as `owner` has entries.
    owner : (r,) array of int
        The region of each chain, in order.
    everything : (g,) array of bool
        Whether a region without a border is the whole sphere, and not nothing.
    """
    shapely = optional("shapely", "geo")
    count = len(everything)
    regions = np.full(count, shapely.Polygon())
    regions[everything] = shapely.Polygon(WORLD.corners())
    if not len(owner):
        return regions
    touched = np.bincount(chains.owner, chains.pole | chains.seam, minlength=len(owner)) > 0
    clockwise = np.bincount(chains.owner, _crosses(chains.lonlat, chains.owner), minlength=len(owner)) <= 0
    plain = np.bincount(owner, touched | clockwise, minlength=count) == 0
    chosen = plain[owner][chains.owner]
    rings = gathered(chains.lonlat[chosen], owner[chains.owner[chosen]], chains.owner[chosen])
    if len(rings.face):
        parts = shapely.polygons(shapely.linearrings(rings.points, indices=rings.ring))
        regions = grouped(parts, rings.face, regions, shapely.multipolygons)
    for number in np.flatnonzero(~plain).tolist():
        regions[number] = _region(chains, touched, np.flatnonzero(owner == number))
    return regions


def _crosses(lonlat: FloatArray, owner: Indices) -> FloatArray:
    """Of each point and the next of its chain, twice the area of the triangle with the chain's first point."""
    first = lonlat[np.searchsorted(owner, owner)]
    p = lonlat - first
    q = np.roll(p, -1, axis=0)
    q[np.append(owner[1:] != owner[:-1], True)] = 0.0
    cross: FloatArray = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    return cross


def _region(chains: Chains, touched: BoolArray, rings: Indices) -> object:
    """The polygon or polygons of a region whose rings are cut by the border of the map, or run clockwise on it."""
    shapely = optional("shapely", "geo")
    loops, pieces = [], []
    for ring in rings.tolist():
        index = np.arange(chains.offsets[ring], chains.offsets[ring + 1] - 1)
        if touched[ring]:
            pieces += border_pieces(chains, index)
        else:
            loops.append(chains.lonlat[index])
    loops += close_along(WORLD, pieces)
    number = np.repeat(np.arange(len(loops)), [len(loop) for loop in loops])
    clean = gathered(np.concatenate([np.zeros((0, 2)), *loops]), np.zeros(len(number), dtype=np.intp), number)
    if not len(clean.face):
        return shapely.Polygon()
    outlines = shapely.linearrings(clean.points, indices=clean.ring)
    sizes, outer = shapely.area(shapely.polygons(outlines)), shapely.is_ccw(outlines)
    shells = outlines[outer]
    # What is outside of a ring that runs clockwise, and of all others, is inside.
    if not outer[np.argmax(sizes)]:
        shells = np.append(shells, shapely.LinearRing(WORLD.corners()))
    return _nested(shells, outlines[~outer])


def _nested(shells: Geometries, holes: Geometries) -> object:
    """Shells with the holes that they hold, each hole in the smallest."""
    shapely = optional("shapely", "geo")
    solid = shapely.polygons(shells)
    hole, shell = shapely.STRtree(solid).query(shapely.get_point(holes, 0), predicate="intersects")
    order = np.lexsort((shapely.area(solid)[shell], hole))
    hole, shell = hole[order], shell[order]
    smallest = np.append(True, hole[1:] != hole[:-1]) if len(hole) else np.zeros(0, dtype=np.bool_)
    hole, shell = hole[smallest], shell[smallest]
    parts = [shapely.polygons(shells[k], holes=holes[hole[shell == k]]) for k in range(len(shells))]
    return parts[0] if len(parts) == 1 else shapely.multipolygons(parts)
