"""Borders of charts: where arcs on the sphere cross them, and how rings continue along them.

A chart is a disc, and its border a closed curve. A border has five methods, all that clipping needs: `cut` gives the
visible pieces of arcs that cross it; `flat` the coordinates of points on the chart; `place` the position of a point
along the border, counterclockwise; `between` the points to draw from one position to another; `once` the whole border.

The side on which an arc ends is the sign of one coordinate of its endpoint, and zero counts as positive. The signs
decide *how many* crossings there are, the closed form only *where*; so rounding may move a crossing, but the arcs of a
ring always leave as often as they enter.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, Indices, as_bounds
from stereodel.constants import AT_POLE, CHART_ROUNDING, LIMB_DEPTH, RIM_FINENESS
from stereodel.curves.ragged import Ragged, offsets_of, spans
from stereodel.curves.trace import Arcs
from stereodel.curves.view import MapView
from stereodel.sphere import xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude

TURN = 2 * np.pi
UP = np.array([0.0, 0.0, 1.0])
"""The centre of a view in its axes; on a map, the north pole, on its border as is the south pole."""
MARGIN = 0.1
"""Margin that `frame_of` adds on each side, relative to the longer side of the points' bounding box."""


@dataclass(frozen=True, eq=False)
class Pieces:
    """Arcs that cross no border: which begin and end on it, which are visible, and which run along it."""

    arcs: Arcs
    opens: BoolArray
    shuts: BoolArray
    seen: BoolArray
    along: BoolArray

    @cached_property
    def of_edge(self) -> Indices:
        """Offsets of the pieces of each edge, up to the last edge that has pieces."""
        edge = self.arcs.edge
        return np.searchsorted(edge, np.arange(edge[-1] + 2 if len(edge) else 1))


@dataclass(frozen=True, eq=False)
class Cap:
    """The edge of a view, at its angular radius from (0, 0, 1): the limb of a ball, the rim of a flat map.

    Chains deviate from their curves by a tolerance, the rim by the fraction `fineness` of it, so that chains rarely
    cross the rim. With the nonzero rule such crossings are harmless, and the rim may be as coarse as the chains.
    """

    view: MapView
    tolerance: float
    fineness: float = RIM_FINENESS
    length: float = TURN
    slack: float = CHART_ROUNDING

    @property
    def blur(self) -> float:
        """Bound on the deviation of chains and rim; a sliver thinner than this may be inverted."""
        return self.tolerance

    def cut(self, arcs: Arcs) -> Pieces:
        """Arcs in view axes, cut at the rim; arcs on the rim are visible."""
        # Points where the planes of circle and rim meet, moved onto the rim itself, which closing parts share.
        arc, t, above = crossings(arcs, UP, self._radius + LIMB_DEPTH)
        points = arcs.points(arc, t)
        points[:, :2] *= (np.sin(self._radius + LIMB_DEPTH) / np.hypot(*points[:, :2].T))[:, None]
        points[:, 2] = np.sin(np.pi / 2 - self._radius - LIMB_DEPTH)
        pieces, opens, shuts = _marked(arcs, arc, t, points)
        # Alternately visible and hidden, beginning with the side of the start.
        seen = np.repeat(above, np.bincount(arc, minlength=len(arcs)) + 1)
        number = np.arange(len(seen)) - np.maximum.accumulate(np.where(opens, 0, np.arange(len(seen))))
        middle = pieces.points(np.arange(len(seen)), (pieces.begin + pieces.stop) / 2)
        heights = np.stack([above_circle(points, UP, self._radius) for points in (pieces.start, middle, pieces.end)])
        along: BoolArray = np.all(np.abs(heights) <= 2 * LIMB_DEPTH * np.sin(self._radius), axis=0)
        return Pieces(pieces, opens, shuts, seen ^ (number % 2 == 1), along)

    def holds(self, points: FloatArray) -> BoolArray:
        """Which points (n, 3) in view axes are visible, as ends of arcs are."""
        return above_circle(points, UP, self._radius + LIMB_DEPTH) >= 0

    @property
    def _radius(self) -> float:
        return float(np.radians(self.view.angular_radius))

    def flat(self, chains: Ragged) -> FloatArray:
        """Page coordinates (n, 2) of points in view axes."""
        return self.view.flattened(chains.values)

    def place(self, flat: FloatArray) -> FloatArray:
        """The angle, in [0, 2π)."""
        return np.mod(np.arctan2(flat[:, 1], flat[:, 0]), TURN)

    def between(self, start: FloatArray, stop: FloatArray) -> Ragged:
        """Points of the circle strictly between pairs of angles, in either direction."""
        step = 2 * np.arccos(1 - self.tolerance * self.fineness)
        pieces = np.maximum(1, np.ceil(np.abs(stop - start) / step)).astype(np.intp)
        number, way = spans(np.ones_like(pieces), pieces - 1), np.repeat(np.arange(len(pieces)), pieces - 1)
        angle = start[way] + (stop - start)[way] * number / pieces[way]
        return Ragged(np.stack([np.cos(angle), np.sin(angle)], axis=1), offsets_of(pieces - 1))

    def once(self) -> FloatArray:
        """The whole circle, its first point repeated at the end."""
        first = np.array([[1.0, 0.0]])
        return np.concatenate([first, self.between(np.zeros(1), np.array([TURN])).values, first])


@dataclass(frozen=True, eq=False)
class Box:
    """A rectangle, its border measured from the lower right corner: the frame of a plane, and the map of the Earth."""

    left: float
    right: float
    bottom: float
    top: float
    blur: float = 0.0

    @property
    def length(self) -> float:
        """Around the rectangle."""
        return 2 * (self.right - self.left + (self.top - self.bottom))

    @property
    def slack(self) -> float:
        """Bound on rounding errors of coordinates."""
        return CHART_ROUNDING * max(map(abs, (self.left, self.right, self.bottom, self.top)))

    @property
    def _marks(self) -> FloatArray:
        """Positions of the corners (4, 1)."""
        width, height = self.right - self.left, self.top - self.bottom
        return np.array([[0], [height], [height + width], [2 * height + width]])

    @property
    def corners(self) -> FloatArray:
        """Corners counterclockwise from the lower right, (4, 2)."""
        x, y = np.array([self.right, self.right, self.left, self.left]), np.array([self.bottom, self.top] * 2)
        return np.stack([x, y[[0, 1, 1, 0]]], axis=1)

    def flat(self, chains: Ragged) -> FloatArray:
        """Points of the plane (n, 2), unchanged."""
        return chains.values

    def place(self, flat: FloatArray) -> FloatArray:
        """Positions of border points along the border; other points use the nearest side."""
        x, y = np.clip(flat, [self.left, self.bottom], [self.right, self.top]).T
        away = np.abs([x - self.right, y - self.top, x - self.left, y - self.bottom])
        along = self._marks + away[[3, 0, 1, 2]]
        return along[np.argmin(away, axis=0), np.arange(len(x))] % self.length

    def between(self, start: FloatArray, stop: FloatArray) -> Ragged:
        """The corners strictly between pairs of positions, in either direction."""
        marks = self._marks.T + self.length * np.arange(-2, 3)[:, None]
        ahead = (marks.ravel() - start[:, None]) * np.where(stop < start, -1, 1)[:, None]
        way, mark = np.nonzero((ahead > 0) & (ahead < np.abs(stop - start)[:, None]))
        order = np.lexsort((ahead[way, mark], way))
        return Ragged.grouped(self.corners[mark[order] % 4], way[order], len(start))

    def once(self) -> FloatArray:
        """All corners, the first one repeated at the end."""
        return self.corners[[0, 1, 2, 3, 0]]


def frame_of(points: FloatArray, bounds: npt.ArrayLike | None = None) -> Box:
    """The rectangle bounds = (xmin, ymin, xmax, ymax), by default the bounding box of points (n, 2) with a margin."""
    if bounds is not None:
        left, bottom, right, top = as_bounds(bounds)
        return Box(left, right, bottom, top)
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(2), np.zeros(2))
    margin = MARGIN * float((high - low).max()) or 1.0
    (left, bottom), (right, top) = (low - margin).tolist(), (high + margin).tolist()
    return Box(left, right, bottom, top)


@dataclass(frozen=True, eq=False)
class Antimeridian(Box):
    """The border of the map of longitude and latitude: the 180th meridian from both sides, and a side for each pole.

    Everything is visible. Points on the meridian are at 180° unless their arcs determine the side.
    """

    left: float = -180.0
    right: float = 180.0
    bottom: float = -90.0
    top: float = 90.0
    latitude: Latitude = "spherical"

    def cut(self, arcs: Arcs) -> Pieces:
        """Arcs cut at the 180th meridian and at the poles."""
        arcs = self._with_poles(_snapped(arcs))
        # The plane of the meridian also cuts arcs at longitude 0; those cuts are left out.
        arc, t, _ = crossings(arcs, np.array([0.0, 1.0, 0.0]), np.pi / 2, slack=AT_POLE)
        points = arcs.points(arc, t)
        west = points[:, 0] < -AT_POLE
        arc, t, points = arc[west], t[west], points[west]
        points[:, 1] = 0.0
        points /= np.sqrt(np.sum(points**2, axis=1, keepdims=True))
        # Arcs cross the meridian exactly at a vertex that lies on it.
        for end, at in ((arcs.start, arcs.begin), (arcs.end, arcs.stop)):
            same = (t == at[arc]) & (end[arc, 1] == 0)
            points[same] = end[arc[same]]
        pieces, _, _ = _marked(arcs, arc, t, points)
        # Vertices on the border are cuts, too; an arc whose endpoints and midpoint are there runs along it.
        opens, shuts = _on_border(pieces.start), _on_border(pieces.end)
        both = np.flatnonzero(opens & shuts)
        along = np.zeros(len(pieces), dtype=bool)
        along[both] = _on_border(pieces.points(both, (pieces.begin + pieces.stop)[both] / 2), AT_POLE)
        return Pieces(pieces, opens, shuts, np.ones(len(pieces), dtype=bool), along)

    def _with_poles(self, arcs: Arcs) -> Arcs:
        """Arcs cut where they pass a pole within rounding error."""
        for up in (1.0, -1.0):
            pole = np.array([0.0, 0.0, up])
            # From the distance of the circle to the pole: the height 1 − d²/2 would lose half the digits.
            near = np.flatnonzero(np.abs(arcs.axis[:, 2] * up - arcs.offset) <= AT_POLE)
            some = arcs.take(near)
            _, _, phase = some.waves(pole)
            t = some.begin + np.mod(phase - some.begin, TURN)
            # An arc that ends at a pole needs no cut.
            inner = (some.start[:, :2] != 0).any(axis=1) & (some.end[:, :2] != 0).any(axis=1)
            passing = inner & (t > some.begin) & (t < some.stop)
            arc, t = near[passing], t[passing]
            arcs = arcs.cut(arc, t, np.broadcast_to(pole, (len(arc), 3)))
        return arcs

    def flat(self, chains: Ragged) -> FloatArray:
        """Longitude and latitude (n, 2); points (n, 5) already contain them."""
        # An endpoint on the meridian is on the side from which its chain arrives; a pole has its neighbour's longitude.
        points = chains.values
        lonlat = points[:, 3:].copy() if points.shape[1] == 5 else xyz_to_lonlat(points, latitude=self.latitude)
        if not len(points):
            return lonlat
        # The next point of the chain; for the last point, the previous one.
        x, y = points[:, :2].T
        beside = np.arange(len(points)) + 1
        beside[chains.offsets[1:] - 1] -= 2
        beside = np.minimum(beside, len(points) - 1)
        meridian = (np.abs(y) <= AT_POLE) & (x < -AT_POLE)
        lonlat[meridian, 0] = np.where(meridian[beside] | (y[beside] >= 0), 180.0, -180.0)[meridian]
        pole = (np.abs(y) <= AT_POLE) & (np.abs(x) <= AT_POLE)
        lonlat[pole, 0] = lonlat[beside[pole], 0]
        return lonlat


Outline = Cap | Box
"""The border of a chart, for curves that are already cut."""


def _on_border(points: FloatArray, slack: float = 0.0) -> BoolArray:
    """Which points are on the 180th meridian or at a pole."""
    return (np.abs(points[:, 1]) <= slack) & (points[:, 0] <= slack)


def above_circle(points: FloatArray, direction: FloatArray, radius: float) -> FloatArray:
    """Heights of unit vectors (n, 3) along a direction above the circle of an angular radius about it."""
    # Near the direction from distances to it, whose squares keep the digits that the cosines of a small circle lose.
    height = points @ direction
    aside = np.sum((points - height[:, None] * direction) ** 2, axis=1)
    near = 2 * np.sin(radius / 2) ** 2 - aside / (1 + np.maximum(height, 0.0))
    return np.where(height > 0.5, near, height - np.sin(np.pi / 2 - radius))


def crossings(
    arcs: Arcs, direction: FloatArray, radius: float, slack: float = 0.0
) -> tuple[Indices, FloatArray, BoolArray]:
    """Where arcs cross a circle about a direction: arcs (k,), parameters (k,), in order; which start above its plane.

    An arc of less than a turn crosses once if its ends are on different sides, otherwise never or twice: twice if its
    highest (lowest) point is on the arc and beyond the plane by more than the slack.
    """
    first, last = above_circle(arcs.start, direction, radius), above_circle(arcs.end, direction, radius)
    above, ending = first >= 0, last >= 0
    # The sides of the ends and the bound |height − h(start)| ≤ length leave few arcs to examine.
    size = np.sqrt(np.sum(arcs.u**2, axis=1))
    near = np.flatnonzero((above != ending) | (np.abs(first) + np.abs(last) <= size * (arcs.stop - arcs.begin)))
    some, begin, stop = arcs.take(near), arcs.begin[near], arcs.stop[near]
    _, _, phase = some.waves(direction)
    # Its nearest and farthest points are at the difference and the sum of its radius and its axis' angle; how far they
    # are above and below the plane are differences of cosines, as products. The half angle between crossings follows.
    tilt = np.arctan2(np.sqrt(np.sum(np.cross(some.axis, direction) ** 2, axis=1)), some.axis @ direction)
    own = np.arctan2(size[near], some.offset)
    peak, depth = (
        2 * np.sin((a + b) / 2) * np.sin((a - b) / 2) for a, b in ((radius, tilt - own), (tilt + own, radius))
    )
    half = 2 * np.arctan2(np.sqrt(np.maximum(peak, 0.0)), np.sqrt(np.maximum(depth, 0.0)))
    rising, falling = (_from(begin, stop, phase + turn) for turn in (-half, half))
    once = above[near] != ending[near]
    # Ends on different sides: the one crossing is where the height passes the level downwards from an arc that starts
    # above, upwards from one below; at an end that is on the plane, exactly there.
    single = np.where(above[near], falling, rising)
    single = np.where(last[near] == 0, stop, np.where(first[near] == 0, begin, single))
    # Ends on the same side: two crossings about the lowest (highest) point, if it is on the arc and beyond the level.
    bulge = begin + np.mod(phase + np.where(above[near], np.pi, 0) - begin, TURN)
    far = np.where(above[near], depth, peak) > slack
    twice = ~once & (bulge > begin) & (bulge < stop) & far
    out = np.where(above[near], np.pi - half, half)
    both = np.stack([np.maximum(bulge - out, begin), np.minimum(bulge + out, stop)], axis=1)
    arc = np.concatenate([near[once], np.repeat(near[twice], 2)])
    t = np.concatenate([single[once], both[twice].ravel()])
    order = np.lexsort((t, arc))
    return arc[order], t[order], above


def _from(begin: FloatArray, stop: FloatArray, t: FloatArray) -> FloatArray:
    """Angles reduced to the interval from `begin` to `stop`, clamped to its nearer end where rounding exceeds it."""
    t = begin + np.mod(t - begin, TURN)
    return np.where(t <= stop, t, np.where(t - stop < begin + TURN - t, stop, begin))


def _marked(arcs: Arcs, arc: Indices, t: FloatArray, points: FloatArray) -> tuple[Arcs, BoolArray, BoolArray]:
    """Arcs cut at parameters, and which pieces begin and end at a cut."""
    pieces = arcs.cut(arc, t, points)
    opens = np.zeros(len(pieces), dtype=bool)
    opens[arc + np.arange(1, len(arc) + 1)] = True
    return pieces, opens, np.append(opens[1:], False)


def _snapped(arcs: Arcs) -> Arcs:
    """Arcs whose ends are snapped to planes of two axes, and to the poles, within rounding error."""
    ends = []
    for given in (arcs.start, arcs.end):
        points = np.where(np.abs(given) <= AT_POLE, 0.0, given)
        pole = (points[:, 0] == 0) & (points[:, 1] == 0)
        points[pole, 2] = np.sign(points[pole, 2])
        ends.append(points)
    start, end = ends
    return replace(arcs, start=start, end=end)
