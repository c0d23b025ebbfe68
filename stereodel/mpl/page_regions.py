"""Regions of the sphere bounded by great-circle edges, as loops on the page that close along the edge of the view.

Which side of a ring is the inside is told as on the map of longitude and latitude, where matplotlib, GeoJSON and
shapefiles mean it: the bounded one, whichever way the ring runs. A ring that goes once around the Earth without
visiting a pole is not closed on that map; of its two sides the smaller one is meant.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from stereodel._arrays import BoolArray, FloatArray
from stereodel.conformal import MoebiusMap
from stereodel.drawing.view import MapView
from stereodel.mpl.great_paths import Chains, Indices, Lines, chains_of
from stereodel.sphere import xyz_to_lonlat

GOLDEN_TURN_RAD = np.pi * (3 - np.sqrt(5))

POLAR_LATITUDE = 80.0
"""Degrees beyond which a jump in longitude of an edge is not taken for one across ±180°."""


@lru_cache(maxsize=32)
def inverse_of(lens: MoebiusMap) -> MoebiusMap:
    """The inverse of a map, remembered: one is asked for with every polygon of a globe."""
    return lens.inverse()


def region_loops(
    rings: Lines, lonlat: FloatArray, lens: MoebiusMap, view: MapView, tolerance: float
) -> list[FloatArray]:
    """The visible part of the region that rings bound by the even-odd rule, as closed loops (k, 2) on the page.

    Parameters
    ----------
    rings : Lines
        Closed lines; where they touch or overlap the rule decides.
    lonlat : (n, 2) array
        Their vertices in degrees as they were given: at a pole, and there only, the longitude tells more than `rings`.
    lens, view, tolerance
        As for `chains_of`.
    """
    chains = chains_of(rings, lens, view, tolerance)
    spot = _clear_spot(chains.points)
    inside = _covers(rings, lonlat, inverse_of(lens)(view.matrix.T @ view.raised(spot)))
    pieces = chains.split()
    whole = [piece for piece, closed in zip(pieces, chains.whole, strict=True) if closed]
    cut = [piece for piece, closed in zip(pieces, chains.whole, strict=True) if not closed]
    if cut:
        return whole + _closed_along_edge(cut, chains, spot, inside, tolerance)
    if inside ^ _crossed_odd(chains, spot, np.array([1.0, 0.0])):
        return [*whole, _edge(whole, tolerance)]
    return whole


def _edge(loops: list[FloatArray], tolerance: float) -> FloatArray:
    """The whole edge of the view, against the largest of the loops inside it, which is a hole."""
    areas = [doubled_area(loop) for loop in loops]
    circle = _edge_arc(0.0, 2 * np.pi, tolerance)
    return circle[::-1] if areas and max(areas, key=abs) > 0 else circle


def doubled_area(loop: FloatArray) -> float:
    """Twice the signed area of a closed loop, positive counterclockwise."""
    x, y = loop.T
    return float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))


def _edge_arc(start: float, end: float, tolerance: float) -> FloatArray:
    """Points of the unit circle from one angle to another, radians, whose chords stray from it by the tolerance."""
    count = max(1, int(np.ceil(abs(end - start) / np.sqrt(8 * tolerance))))
    angle = np.linspace(start, end, count + 1)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _closed_along_edge(
    cut: list[FloatArray], chains: Chains, spot: FloatArray, inside: bool, tolerance: float
) -> list[FloatArray]:
    """Loops of chains from edge to edge: the stretches of the edge between their ends are in and out by turns."""
    ends = np.array([end for piece in cut for end in (piece[0], piece[-1])])
    angle = np.arctan2(ends[:, 1], ends[:, 0])
    order = np.argsort(angle, kind="stable")
    widths = np.diff(angle[order], append=angle[order[0]] + 2 * np.pi)
    widest = int(np.argmax(widths))
    halfway = angle[order[widest]] + widths[widest] / 2
    within = inside ^ _crossed_odd(chains, spot, np.array([np.cos(halfway), np.sin(halfway)]))
    # Stretch k runs from end order[k] to the next one; those with the parity of `first` are in the region.
    first = widest % 2 if within else (widest + 1) % 2
    partner = np.empty(len(ends), dtype=np.intp)
    along = np.empty(len(ends))
    for k in range(first, len(order), 2):
        a, b = order[k], order[(k + 1) % len(order)]
        partner[a], partner[b] = b, a
        along[a], along[b] = widths[k], -widths[k]
    return _traced(cut, angle, partner, along, tolerance)


def _traced(
    cut: list[FloatArray], angle: FloatArray, partner: Indices, along: FloatArray, tolerance: float
) -> list[FloatArray]:
    """Loops that go along a chain, then along the edge to the partner of its end, and so on."""
    loops, waiting = [], set(range(len(cut)))
    while waiting:
        at = 2 * min(waiting)
        loop = []
        while at // 2 in waiting:
            waiting.remove(at // 2)
            loop.append(cut[at // 2] if at % 2 == 0 else cut[at // 2][::-1])
            leave = at ^ 1
            loop.append(_edge_arc(angle[leave], angle[leave] + along[leave], tolerance)[1:-1])
            at = int(partner[leave])
        loops.append(np.concatenate([*loop, loop[0][:1]]))
    return loops


def _clear_spot(points: FloatArray) -> FloatArray:
    """A point of the page, of a few that are tried, as far as may be from the points of all chains."""
    number = np.arange(12)
    radius, turn = np.sqrt((number + 0.3) / len(number)) * 0.9, number * GOLDEN_TURN_RAD
    tried = np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=1)
    gaps = [np.min(np.sum((points - spot) ** 2, axis=1), initial=4.0) for spot in tried]
    clearest: FloatArray = tried[int(np.argmax(gaps))]
    return clearest


def _crossed_odd(chains: Chains, start: FloatArray, end: FloatArray) -> bool:
    """Whether a segment of the page crosses chains an odd number of times."""
    points, same = chains.points, np.ones(max(0, len(chains.points) - 1), dtype=bool)
    same[chains.offsets[1:-1] - 1] = False
    side = _side(start, end, points) >= 0
    place = np.flatnonzero((side[:-1] != side[1:]) & same) if len(points) else np.zeros(0, dtype=np.intp)
    p, q = points[place], points[place + 1]
    step = q - p
    there = [step[:, 0] * (x[1] - p[:, 1]) - step[:, 1] * (x[0] - p[:, 0]) >= 0 for x in (start, end)]
    return bool(np.count_nonzero(there[0] != there[1]) % 2)


def _side(start: FloatArray, end: FloatArray, points: FloatArray) -> FloatArray:
    x, y = end - start
    side: FloatArray = x * (points[:, 1] - start[1]) - y * (points[:, 0] - start[0])
    return side


def _covers(rings: Lines, lonlat: FloatArray, point: FloatArray) -> bool:
    """Whether a point (3,) away from the rings is inside by the even-odd rule, told on the meridian to the north pole.

    On the map, the meridian goes on beyond the pole to where no ring is. On its way it crosses edges of rings, and
    stretches that rings run along the upper border of the map.
    """
    edge = _edges_of(rings)
    a, b = rings.vertices[edge], rings.vertices[edge + 1]
    lon, (meridian, height) = lonlat[:, 0], xyz_to_lonlat(point).tolist()
    given = lon[edge + 1] - lon[edge]
    # Where both ends are nearer to a pole than the point is, either way round the pole has the same outcome there: the
    # one given is that of maps, on which a ring may go along the border or, as a hull does, close to it.
    near = np.minimum(np.abs(a[:, 2]), np.abs(b[:, 2])) > np.sin(
        np.radians(max(POLAR_LATITUDE, (90 + abs(height)) / 2))
    )
    polar = near & (a[:, 2] * b[:, 2] > 0)
    step = np.where(polar, given, np.mod(given + 180.0, 360.0) - 180.0)
    at_pole = (rings.vertices[:, :2] == 0).all(axis=1)
    ends_there = at_pole[edge] | at_pole[edge + 1]
    north = (polar | ends_there) & (a[:, 2] + b[:, 2] > 0)
    crossed = _is_south(a, b, step, point) & ~(polar | ends_there)
    hits = np.count_nonzero(_passed(lon[edge], step, meridian) & (crossed | north))
    return bool((hits + _wound_small(rings, edge, step)) % 2)


def _edges_of(rings: Lines) -> Indices:
    """The vertices that another one of their ring follows."""
    first = np.ones(len(rings.vertices), dtype=bool)
    first[np.minimum(rings.offsets[1:], len(first)) - 1] = False
    return np.flatnonzero(first)


def _passed(start: FloatArray, step: FloatArray, meridian: float) -> BoolArray:
    """Whether steps in longitude pass a meridian an odd number of times, all in degrees."""
    turns = np.floor((start - meridian) / 360.0), np.floor((start + step - meridian) / 360.0)
    passed: BoolArray = (turns[1] - turns[0]) % 2 == 1
    return passed


def _is_south(a: FloatArray, b: FloatArray, step: FloatArray, point: FloatArray) -> BoolArray:
    """Whether a point lies south of the great circles of edges that pass its meridian."""
    north = np.cross(a, b) @ point < 0
    return np.where(step > 0, north, ~north)


def _wound_small(rings: Lines, edge: Indices, step: FloatArray) -> int:
    """How many rings wind around the pole and have it on their smaller side."""
    ring = np.searchsorted(rings.offsets, edge, side="right") - 1
    count = len(rings.offsets) - 1
    turn = np.bincount(ring, weights=step, minlength=count)
    height = (rings.vertices[edge, 2] + rings.vertices[edge + 1, 2]) / 2
    # Area of the side with the north pole, ∮ (1 − sin φ) dλ, in terms of the sphere's: below a half it is the smaller.
    area = np.abs(np.bincount(ring, weights=step * (1 - height), minlength=count)) / 720.0
    return int(np.count_nonzero((np.abs(turn) > 180.0) & (area < 0.5)))
