"""Edges on the sphere as circular arcs, and their images under a lens: exact until they are sampled.

A conformal map sends circles to circles. So an edge is stored as its circle, axis·x = offset, and an interval on it; a
lens maps the circle in closed form and the endpoints as points, and intermediate points are computed last, as many as
the image needs. Three kinds of edges become arcs: great circles (exact), parallels and other circles (exact), and edges
straight in longitude and latitude (exact along parallels, otherwise approximated by great circles to within a
tolerance).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices
from stereodel.conformal import MoebiusMap
from stereodel.constants import LONGEST_EDGE, MOST_PIECES, WHOLE_TURNS
from stereodel.curves.ragged import Ragged, Rows, offsets_of, spans
from stereodel.sphere import SphereArc, lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import crossed, turned

APEX = np.array([0.36, 0.48, 0.8])
"""A unit vector, no vertex of anything."""


@dataclass(frozen=True, eq=False)
class Arcs(Rows):
    """Arcs of circles of the unit sphere: center + cos t·u + sin t·v for t from `begin` to `stop`, at most one turn.

    The circle is axis·x = offset, counterclockwise about its axis: center = offset·axis, v = axis × u.
    """

    start: FloatArray
    """(n, 3): starts, bitwise equal to the ends of preceding arcs; likewise `end`."""
    end: FloatArray
    axis: FloatArray
    offset: FloatArray
    u: FloatArray
    begin: FloatArray
    stop: FloatArray
    edge: Indices
    """(n,), ascending: the edge of each piece."""

    def __len__(self) -> int:
        return len(self.edge)

    def turned(self, matrix: FloatArray) -> Arcs:
        """The arcs in other axes, the rows of a rotation matrix."""
        start, end, axis, u = (turned(vectors, matrix) for vectors in (self.start, self.end, self.axis, self.u))
        return replace(self, start=start, end=end, axis=axis, u=u)

    def waves(self, direction: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Along each arc direction·x is constant + size·cos(t − phase)."""
        cosine, sine = self.u @ direction, crossed(self.axis, self.u) @ direction
        return self.offset * (self.axis @ direction), np.hypot(cosine, sine), np.arctan2(sine, cosine)

    def points(self, arc: Indices, t: FloatArray) -> FloatArray:
        """Points (k, 3) of arcs (k,) at parameters (k,)."""
        axis, u = self.axis[arc], self.u[arc]
        return axis * self.offset[arc, None] + np.cos(t)[:, None] * u + np.sin(t)[:, None] * crossed(axis, u)

    def cut(self, arc: Indices, t: FloatArray, points: FloatArray) -> Arcs:
        """The arcs cut at parameters t (k,) of arcs (k,), in order; adjacent pieces share the points (k, 3)."""
        if not len(arc):
            return self
        pieces = self.take(np.repeat(np.arange(len(self)), np.bincount(arc, minlength=len(self)) + 1))
        after = arc + np.arange(1, len(arc) + 1)  # each of the k cuts before the k-th adds a piece
        pieces.start[after], pieces.end[after - 1] = points, points
        pieces.begin[after], pieces.stop[after - 1] = t, t
        return pieces

    def through(self, lens: MoebiusMap) -> Arcs:
        """The images under a lens, cut at the apsides."""
        # Arcs are cut where they are nearest to and farthest from the focus. By symmetry the images of these points are
        # opposite on the image circle; between them an image sweeps at most half a turn, which its ends determine.
        if lens.magnification == 1:
            return self.turned(lens.left.matrix @ lens.right.matrix)
        # Both apsides, each within a turn from `begin`; those beyond `stop` are not on the arc.
        _, _, phase = self.waves(lens.right.matrix[2])  # the focus
        t = self.begin[:, None] + np.sort(np.mod(phase[:, None] + [0, np.pi] - self.begin[:, None], 2 * np.pi), axis=1)
        arc, which = np.nonzero((t > self.begin[:, None]) & (t < self.stop[:, None]))
        arcs = self.cut(arc, t[arc, which], self.points(arc, t[arc, which]))
        # (axis, offset) is a vector of Minkowski space, which a lens boosts along the focus.
        size = lens.magnification
        axis = turned(arcs.axis, lens.right.matrix)
        even, odd = (1 / size + size) / 2, (1 / size - size) / 2
        height, offset = axis[:, 2] * even + arcs.offset * odd, axis[:, 2] * odd + arcs.offset * even
        axis[:, 2] = height
        length = np.sqrt(np.sum(axis**2, axis=1))
        length[length == 0] = 1.0  # an arc of length zero has no axis
        axis, offset = turned(axis, lens.left.matrix) / length[:, None], offset / length
        start, end = lens(arcs.start), lens(arcs.end)
        center = axis * offset[:, None]
        u, w = start - center, end - center
        return Arcs(start, end, axis, offset, u, np.zeros(len(u)), _swept(axis, u, w), arcs.edge)

    def sampled(self, tolerance: float, seen: BoolArray | bool = True) -> Ragged:
        """Points of each arc, both ends too, whose chords deviate from it by at most `tolerance`, if it is seen."""
        # A chord of angle a deviates from a circle of radius r by r(1 − cos(a/2)). None sweeps more than a quarter
        # turn, so that a circle smaller than the tolerance still has an area, which determines the side of its region.
        radius = np.sqrt(np.sum(self.u**2, axis=1))
        step = 2 * np.arccos(np.clip(1 - tolerance / np.maximum(radius, tolerance), np.sqrt(0.5), 1.0))
        steps = np.where(seen, np.ceil((self.stop - self.begin) / step), 1)
        return self.spread(np.maximum(1, steps).astype(np.intp))

    def spread(self, pieces: Indices) -> Ragged:
        """Points at equal steps, with a number of steps for each arc."""
        offsets = offsets_of(pieces + 1)
        points = np.empty((offsets[-1], 3))
        points[offsets[:-1]], points[offsets[1:] - 1] = self.start, self.end
        arc = np.repeat(np.arange(len(self)), pieces - 1)
        number = spans(np.ones_like(pieces), pieces - 1)
        t = self.begin[arc] + (self.stop - self.begin)[arc] * number / pieces[arc]
        points[offsets[arc] + number] = self.points(arc, t)
        return Ragged(points, offsets)


def fans(apex: FloatArray, rows: Ragged) -> tuple[FloatArray, FloatArray]:
    """Areas (m,) of triangles between an apex, (3,) or (m, 3), and the steps of rows of points; sums of the steps."""
    # Areas on the left of the steps are positive. The place opposite to the apex counts as outside.
    first, sides = sides_of(rows)
    a, b = rows.values[first, :3], rows.values[first + 1, :3]
    apex = np.broadcast_to(apex, (len(rows), 3))[sides.row]
    # tan(area/2) = n·(a × b)/(1 + n·a + n·b + a·b), whose terms cancel where a and b are opposite to n.
    far = np.sum((a + apex) ** 2, axis=1) * np.sum((b + apex) ** 2, axis=1) / 4
    height = far + np.sum(crossed(apex, a) * crossed(apex, b), axis=1)
    area = 2 * np.arctan2(np.sum(apex * crossed(a, b - a), axis=1), height)
    step = np.sqrt(np.sum((b - a) ** 2, axis=1))
    total, length = (np.bincount(sides.row, of, minlength=len(rows)).astype(np.float64) for of in (area, step))
    return total, length


def great_axes(start: FloatArray, end: FloatArray) -> FloatArray:
    """Normals of the great circles through unit vectors (n, 3), counterclockwise from `start`; zero if collinear."""
    # a × b = (a − b) × (a + b) / 2, whose first factor is exact for close points.
    axis = crossed(start - end, start + end)
    length = np.sqrt(np.sum(axis**2, axis=1, keepdims=True))
    return np.divide(axis, length, out=np.zeros_like(axis), where=length > 0)


def great(start: FloatArray, end: FloatArray, normal: FloatArray | None = None) -> Arcs:
    """The shorter great-circle arcs between unit vectors (n, 3); `normal` decides where ends may be antipodal."""
    axis = great_axes(start, end)
    if normal is not None:
        far = (np.sum(start * end, axis=1) < 0) & normal.any(axis=1)
        axis[far] = normal[far]
    none, edge = np.zeros((2, len(start))), np.arange(len(start))
    return Arcs(start, end, axis, none[0], start.copy(), none[1], _swept(axis, start, end), edge)


def exact(arcs: Sequence[SphereArc]) -> Arcs:
    """Arcs from a sequence of circular arcs, each at most one turn."""
    rows = [(arc.start, arc.end, arc.circle.normal, arc.frame()[1]) for arc in arcs]
    start, end, axis, u = np.array(rows, dtype=np.float64).reshape(-1, 4, 3).swapaxes(0, 1)
    offset, stop = (
        np.array(values, dtype=np.float64) for values in ([a.circle.offset for a in arcs], [a.angle_rad for a in arcs])
    )
    return Arcs(start, end, axis, offset, u, np.zeros(len(arcs)), stop, np.arange(len(arcs)))


def _swept(axis: FloatArray, u: FloatArray, w: FloatArray) -> FloatArray:
    """Angle about an axis from u to w, at most half a turn; rounding must not turn π into −π."""
    return np.arctan2(np.abs(np.sum(crossed(axis, u) * w, axis=1)), np.sum(u * w, axis=1))


def sides_of(lines: Ragged) -> tuple[Indices, Ragged]:
    """For lines of vertices: the vertices followed by another, and the edges of each line, in this numbering."""
    inner = np.ones(len(lines.values), dtype=bool)
    inner[lines.offsets[1:] - 1] = False
    first = np.flatnonzero(inner)
    return first, Ragged(np.arange(len(first)), lines.offsets - np.arange(len(lines) + 1))


@dataclass(frozen=True, eq=False)
class Edges:
    """Edges before any lens, prepared once, as arcs, from which edges straight in longitude and latitude deviate.

    The deviation of images depends on the lens, so `arcs_under` cuts such edges into as many arcs as necessary.
    """

    arcs: Arcs
    """One arc for each edge: the edge itself, or the great circle through its ends."""
    length: FloatArray
    """(n,): upper bounds, radians; no point of an edge is farther from its start."""
    exact: BoolArray
    """(n,): which edges are equal to their arcs."""
    bend: FloatArray
    """(n,): bounds on the deviation of the other edges from their arcs, in radians."""
    lonlat: FloatArray
    """(n, 2, 2): their ends in degrees."""
    latitude: Latitude = "spherical"

    @classmethod
    def of(cls, arcs: Arcs) -> Edges:
        """Edges that are arcs."""
        length = (arcs.stop - arcs.begin) * np.sqrt(np.sum(arcs.u**2, axis=1))
        count = len(arcs)
        return cls(arcs, length, np.ones(count, dtype=bool), np.zeros(count), np.zeros((count, 2, 2)))

    @classmethod
    def straight(
        cls,
        a: FloatArray,
        b: FloatArray,
        latitude: Latitude = "spherical",
        ends: tuple[FloatArray, FloatArray] | None = None,
    ) -> Edges:
        """Edges straight in degrees from a (k, 2) to b; `ends` are their points on the sphere, if already known."""
        p, q = ends or (lonlat_to_xyz(a, latitude=latitude), lonlat_to_xyz(b, latitude=latitude))
        length, bend = measures_in_lonlat(a, b, p, q)
        # A parallel is a circle: followed exactly. At the poles it is a point.
        level = (a[:, 1] == b[:, 1]) & (a[:, 0] != b[:, 0]) & (np.abs(a[:, 1]) < 90) & (np.abs(b - a)[:, 0] <= 360)
        arcs = great(p, q)
        # A parallel replaces its great circle: about the Earth's axis, east or west, over the difference in longitude.
        east = np.sign((b - a)[level, 0])
        arcs.axis[level] = np.stack([0 * east, 0 * east, east], axis=1)
        arcs.offset[level] = east * p[level, 2]
        arcs.u[level] = p[level] * [1, 1, 0]
        arcs.stop[level] = np.radians(np.abs((b - a)[level, 0]))
        return cls(arcs, length, level, bend, np.stack([a, b], axis=1), latitude)

    def __len__(self) -> int:
        return len(self.arcs)

    @cached_property
    def _swept(self) -> FloatArray:
        """Areas (n,) between the edges and a point of the sphere, on its left if positive, modulo a whole sphere.

        The point is the north pole for edges straight in degrees, ∫ (1 − sin φ) dλ, and `APEX` for arcs: triangles of
        quarters of each, and its segments, the sector θ(1 − offset) about its centre less the triangles there.
        """
        if self.lonlat.any():
            lat, (turn, rise) = np.radians(self.lonlat[:, 0, 1]), np.radians(np.diff(self.lonlat, axis=1)[:, 0].T)
            return turn * (1 - np.sin(lat + rise / 2) * np.sinc(rise / (2 * np.pi)))
        arcs = self.arcs
        quarters = arcs.spread(np.full(len(arcs), 4))
        inner = (arcs.stop - arcs.begin) * (1 - arcs.offset) - fans(arcs.axis, quarters)[0]
        return fans(APEX, quarters)[0] + np.where(arcs.offset == 0, 0.0, inner)

    def left(self, rings: Ragged) -> FloatArray:
        """Areas on the left of rings of edges, modulo a whole sphere, 4π, sizes of their terms, and lengths, (r, 3).

        The areas are off by `CHART_ROUNDING` of the sizes.
        """
        edge, back = np.maximum(rings.values, ~rings.values), rings.values < 0
        area = np.where(back, -1.0, 1.0) * self._swept[edge]
        length = self.length[edge]
        size = length + np.abs(area)
        # At the south pole, where meridians end, the next edge may begin on another one.
        start, end = (np.where(back[:, None], self.lonlat[edge, 1 - k], self.lonlat[edge, k]) for k in (0, 1))
        jump = start[rings.following, 0] - end[:, 0]
        area += np.where(end[:, 1] == -90.0, 2 * np.radians(jump), 0.0)
        return np.stack([np.bincount(rings.row, part, minlength=len(rings)) for part in (area, size, length)], axis=1)

    def take(self, chosen: Indices | BoolArray) -> Edges:
        """Some of the edges, renumbered."""
        arcs = numbered(self.arcs.take(chosen))
        length, exact = self.length[chosen], self.exact[chosen]
        return Edges(arcs, length, exact, self.bend[chosen], self.lonlat[chosen], self.latitude)

    def within(self, center: FloatArray, reach: float) -> BoolArray:
        """Which edges may come within `reach` radians of a point of the sphere."""
        chord = np.sqrt(np.sum((self.arcs.start - center) ** 2, axis=1))
        return 2 * np.arcsin(np.minimum(chord / 2, 1.0)) <= reach + self.length

    def arcs_under(self, lens: MoebiusMap, tolerance: float) -> Arcs:
        """Arcs whose images under a lens are within `tolerance`, in radii, of those of the edges."""
        start = self.arcs.start
        wanted = _wanted(lens, tolerance, start, self.length, self.bend)
        long = np.flatnonzero(~self.exact & (wanted > 1))
        if not len(long):
            return self.arcs
        # The edges to be cut, from vertex to vertex.
        some, zero = self.arcs.take(long), np.zeros(len(long))
        a, b = self.lonlat[long].swapaxes(0, 1)
        cut = _Stretches(long, zero, zero + 1, wanted[long], a, b, some.start, some.end)
        parts = cut.halved(lens, tolerance, self.latitude).arcs(self.latitude)
        whole = np.ones(len(self), dtype=bool)
        whole[long] = False
        both = Arcs.joined(self.arcs.take(whole), parts)
        return both.take(np.argsort(both.edge, kind="stable"))


@dataclass(frozen=True, eq=False)
class _Stretches(Rows):
    """Parts of edges straight in degrees, from a (k, 2) to b, on the sphere from p (k, 3) to q."""

    edge: Indices
    before: FloatArray
    """Fraction of the edge before each part; `share` is the fraction of the part."""
    share: FloatArray
    pieces: FloatArray
    """Number of great circles into which each is divided."""
    a: FloatArray
    b: FloatArray
    p: FloatArray
    q: FloatArray

    def halved(self, lens: MoebiusMap, tolerance: float, latitude: Latitude) -> _Stretches:
        """Parts halved, in order, until none needs more than `MOST_PIECES`: few where nothing is magnified."""
        done, rest = [], self
        while len(rest.edge):
            middle = (rest.a + rest.b) / 2
            # Parts that rounding prevents from being halved are as short as possible.
            between = (middle != rest.a).any(axis=1) & (middle != rest.b).any(axis=1)
            long = between & (rest.pieces > MOST_PIECES)
            done.append(rest.take(~long))
            rest, middle = rest.take(long), middle[long]
            center, share = lonlat_to_xyz(middle, latitude=latitude), rest.share / 2
            first = replace(rest, share=share, b=middle, q=center)
            second = replace(rest, share=share, before=rest.before + share, a=middle, p=center)
            halves = _Stretches.joined(first, second)
            length, bend = measures_in_lonlat(halves.a, halves.b, halves.p, halves.q)
            rest = replace(halves, pieces=_wanted(lens, tolerance, halves.p, length, bend))
        found = _Stretches.joined(*done)
        return found.take(np.lexsort([found.before, found.edge]))

    def arcs(self, latitude: Latitude) -> Arcs:
        """Great circles at equal steps in degrees."""
        pieces = np.ceil(np.clip(self.pieces, 1, MOST_PIECES)).astype(np.intp)
        number, row = spans(np.zeros_like(pieces), pieces), np.repeat(np.arange(len(pieces)), pieces)
        cut = np.flatnonzero(number)
        p, q, a, b = self.p[row], self.q[row], self.a[row[cut]], self.b[row[cut]]
        share = (number[cut] / pieces[row[cut]])[:, None]
        # In this form rounding cannot exceed the ends, and therefore not a pole.
        p[cut] = q[cut - 1] = lonlat_to_xyz(a + share * (b - a), latitude=latitude)
        return replace(great(p, q), edge=self.edge[row])


def _wanted(lens: MoebiusMap, tolerance: float, start: FloatArray, length: FloatArray, bend: FloatArray) -> FloatArray:
    """Numbers of great circles with images within `tolerance` of those of edges, by the largest scale along them."""
    # Long edges are cut because of their length alone: antipodal points do not determine a great circle.
    wanted = np.sqrt(bend * largest_scale(lens, start, length) / tolerance)
    return np.asarray(np.maximum(wanted, length / np.radians(LONGEST_EDGE)))


def largest_scale(lens: MoebiusMap, points: FloatArray, radius: FloatArray) -> FloatArray:
    """The largest local scale within angular distances `radius` (n,) of unit vectors (n, 3), radians."""
    there = turned(points, lens.right.matrix)
    size = lens.magnification
    height = there[:, 2] if size >= 1 else -there[:, 2]
    across = np.sqrt(there[:, 0] ** 2 + there[:, 1] ** 2)
    # At the place nearest to the point of largest scale: the focus, or its antipode if the map shrinks.
    half = np.maximum(np.arctan2(across, height) - radius, 0.0) / 2
    larger = max(size, 1 / size)
    return larger / (np.cos(half) ** 2 + (larger * np.sin(half)) ** 2)


def numbered(arcs: Arcs) -> Arcs:
    """The same arcs, each an edge of its own."""
    return replace(arcs, edge=np.arange(len(arcs)))


def unwrapped(lines: Ragged, *, turns: bool = True) -> Ragged:
    """Lines in degrees whose longitude continues across ±180° instead of jumping, except for steps along a pole.

    A step of 360° is a turn around the Earth, as in polygons that go around it, or with `turns` false no step at all.
    """
    # Longitudes are rounded to `WHOLE_TURNS`, so that a ring around the Earth ends exactly one turn from its start.
    step = np.diff(lines.values, axis=0, prepend=lines.values[:1])
    step[lines.offsets[:-1][lines.sizes > 0]] = 0.0
    polar = (np.abs(lines.values[:, 1]) == 90) & (step[:, 1] == 0)
    far = (np.abs(step[:, 0]) > 180) & ((np.abs(step[:, 0]) < 360) | (not turns)) & ~polar
    jumps = np.where(far, -360.0 * np.sign(step[:, 0]), 0.0)
    if not jumps.any():
        return lines
    total = np.cumsum(jumps)
    shift = total - np.repeat(total[lines.offsets[:-1]], lines.sizes)
    lon = np.rint(lines.values[:, 0] / WHOLE_TURNS) * WHOLE_TURNS + shift
    return Ragged(np.stack([lon, lines.values[:, 1]], axis=1), lines.offsets)


def measures_in_lonlat(
    start: FloatArray, end: FloatArray, p: FloatArray, q: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Upper bounds in radians of the lengths of edges straight in (lon, lat) and their distances from great circles."""
    # With steps a in longitude and b in latitude the covariant acceleration is (sin φ cos φ a², −2 sin φ a b) north and
    # east; a curve deviates from the great-circle arc between its ends by an eighth of it.
    a, b = np.abs(np.radians(end - start)).T
    sine = np.maximum(np.abs(p[:, 2]), np.abs(q[:, 2]))
    lowest = np.where(p[:, 2] * q[:, 2] < 0, 0.0, np.minimum(np.abs(p[:, 2]), np.abs(q[:, 2])))
    cosine = np.sqrt(np.maximum(0.0, 1 - lowest**2))
    return np.hypot(cosine * a, b), sine * np.hypot(cosine * a**2, 2 * a * b) / 8
