"""Graticules: meridians and parallels, thinned where they would merge.

The distance between neighbours on the page is known in closed form: their distance on the sphere, times the scale of
the lens, times the view's scale across the line. Where it is less than required, only every second line continues, or
every sixth and so on, with strides that divide the grid, so that the remaining lines are evenly spaced.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isqrt
from typing import Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, Indices, as_scalar, as_steps
from stereodel.conformal import MoebiusMap
from stereodel.constants import GRID_SAMPLES, MOST_GRID_LINES, REACH_MARGIN, UNIT_ROUNDOFF
from stereodel.curves.chart import Chart
from stereodel.curves.trace import Arcs, exact, numbered
from stereodel.curves.view import MapView
from stereodel.drawing.scene.space_curves import CircleArc
from stereodel.sphere import graticule_patch, lonlat_to_xyz, xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import crossed, turned

_Box = tuple[float, float, float, float]

WIDTHS_APART: Final = 3.0
"""Least distance between neighbouring lines of a grid, in line widths: closer lines look like a tint."""

LEAST_APART: Final = 0.3
"""The least distance in points, however thin the lines: it bounds the number of lines in a picture."""

LINES_ACROSS: Final = 12
"""Approximate number of meridians or of parallels in a picture with a suitable spacing."""

SPACINGS: Final = (15.0, 10.0, 5.0, *(float(f"{digit}e-{power}") for power in range(12) for digit in (2, 1, 0.5)))
"""Suitable spacings in degrees, down to 1e-13 degrees, where double precision ends."""


@dataclass(frozen=True, eq=False)
class Graticule:
    """Meridians and parallels, and the order in which they are thinned.

    Parameters
    ----------
    arcs : Arcs
        Meridians, then parallels.
    meridians : int
        Number of meridians among them.
    step : float
        Distance between neighbours, radians.
    strides : (n,) array of int
        The line remains as long as every k-th line is drawn, k its stride; 0 if it always remains.

    Examples
    --------
    >>> from stereodel.drawing import View
    >>> grid = Graticule.regular(10)
    >>> len(grid.arcs), len(grid.drawn(MoebiusMap.identity(), View(0, 90), 0.02))
    (53, 53)
    >>> ends = grid.thinned(Chart(MoebiusMap.identity(), View(0, 90)), 0.02).end[:2]
    >>> np.degrees(np.arcsin(ends[:, 2])).round(2).tolist()  # the meridians 180° W and 170° W
    [90.0, 83.42]
    """

    arcs: Arcs
    meridians: int
    step: float
    strides: Indices

    @classmethod
    def regular(cls, spacing: float = 15.0, *, latitude: Latitude = "spherical") -> Graticule:
        """All meridians and parallels, as in `stereodel.sphere.graticule`; those at multiples of 90° always remain."""
        steps = as_steps(180.0, spacing, "spacing")
        half = (steps - 1) // 2
        return cls._numbered(np.arange(-steps, steps), np.arange(-half, half + 1), steps, latitude)

    @classmethod
    def shown(cls, spacing: float, chart: Chart, least: float, *, latitude: Latitude = "spherical") -> Graticule:
        """The lines of `regular` that may be visible in a picture thinned to `least`: some thousands.

        However fine the grid, the cost depends only on its visible part. Parameters are those of `regular` and
        `thinned`; for a glass ball this is the near side. ValueError for more than `MOST_GRID_LINES` of them.

        Examples
        --------
        >>> from stereodel import fisheye
        >>> from stereodel.drawing import View
        >>> chart = Chart(fisheye((2.35, 48.86), magnification=1e9), View(2.35, 48.86))
        >>> grid = Graticule.shown(2e-8, chart, 0.003)  # of 27 billion lines
        >>> 20 < len(grid.arcs) < 100
        True
        """
        steps = as_steps(180.0, spacing, "spacing")
        half, quarter = (steps - 1) // 2, _quarter(steps)
        window = _Window(chart, latitude)
        need = as_scalar(least, "least", low=0.0, open_low=True)
        meridians, parallels = [np.zeros(0, dtype=np.intp)], [np.zeros(0, dtype=np.intp)]
        for stride in _chain(quarter):
            apart = 0.0 if stride == quarter else need / (stride * np.pi / steps)
            meridians.append(window.meridians(stride, steps, apart))
            parallels.append(window.parallels(stride, steps, apart))
        east, north = (np.unique(np.concatenate(found)) for found in (meridians, parallels))
        return cls._numbered(east, north[np.abs(north) <= half], steps, latitude)

    @classmethod
    def _numbered(cls, east: Indices, north: Indices, steps: int, latitude: Latitude) -> Graticule:
        """Meridians and parallels of a graticule by number, counted from those through (0, 0)."""
        arcs = Arcs.joined(_meridians(east * 180.0 / steps), _parallels(north * 180.0 / steps, latitude))
        numbers = np.concatenate([east, north])
        return cls(numbered(arcs), len(east), np.pi / steps, _strides(numbers, _quarter(steps)))

    @classmethod
    def patch(cls, center: npt.ArrayLike, half_width: float, spacing: float) -> Graticule:
        """The grid of a box, as in `stereodel.sphere.graticule_patch`; its borders and its central lines always remain.

        Examples
        --------
        >>> Graticule.patch((0.0, 40.0), 1.5, 0.5).strides.tolist()
        [0, 1, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1, 1, 0]
        """
        arcs = exact(graticule_patch(center, half_width, spacing))
        count = len(arcs) // 2
        steps = count - 1
        strides = _strides(np.arange(count), _quarter(steps))
        return cls(arcs, count, float(np.radians(2 * half_width)) / steps, np.tile(strides, 2))

    def drawn(self, lens: MoebiusMap, view: MapView, least: float) -> list[CircleArc]:
        """The visible lines: the images of `thinned` lines under the lens."""
        thin = self.thinned(Chart(lens, view), least)
        parts = replace(thin, edge=np.arange(len(thin))).through(lens)
        # An image is cut at the apsides of its circle, between which it is an arc.
        first = np.flatnonzero(np.diff(parts.edge, prepend=-1))
        sweeps = np.add.reduceat(parts.stop - parts.begin, first) if len(first) else np.zeros(0)
        parts = parts.take(first)
        centers = parts.axis * parts.offset[:, None]
        u = parts.start - centers
        rows = zip(centers, u, crossed(parts.axis, u), sweeps.tolist(), strict=True)
        return [CircleArc(center, u, v, 0.0, sweep) for center, u, v, sweep in rows]

    def thinned(self, chart: Chart, least: float) -> Arcs:
        """The parts of the lines that a picture shows, before the lens.

        Parameters
        ----------
        chart : Chart
            Near and far sides are treated alike, for glass balls.
        least : float
            Least distance between neighbours on the page, in radii of the disc; closer lines are left out.

        Returns
        -------
        Arcs
            Arcs in the order of the lines, whose indices are their edges. A line ends exactly where its neighbours come
            too close; lines that always remain are whole.
        """
        need = as_scalar(least, "least", low=0.0)
        lines = _GridLines(self, chart)
        t = lines.parameters()
        row = np.broadcast_to(np.arange(len(t))[:, None], t.shape)
        # Lines that always remain are drawn regardless of their neighbours.
        wanted = np.where(self.strides == 0, 0.0, need / np.maximum(self.strides, 1))
        # 512 lines at once, at two hundred places in three coordinates: arrays of 2.4 MB.
        some = np.array_split(np.arange(len(t)), len(t) // 512 + 1)
        enough = np.concatenate([lines.spacing(row[rows], t[rows]) for rows in some]) >= wanted[:, None]
        line, cut, begins = lines.ends(t, enough, wanted)
        starts, stops = enough[:, 0], enough[:, -1]
        every = np.arange(len(t))
        return self._parts(
            np.concatenate([every[starts], line[begins]]),
            np.concatenate([self.arcs.begin[starts], cut[begins]]),
            np.concatenate([line[~begins], every[stops]]),
            np.concatenate([cut[~begins], self.arcs.stop[stops]]),
        )

    def _parts(self, begun: Indices, begin: FloatArray, ended: Indices, stop: FloatArray) -> Arcs:
        """Parts of lines that begin at some parameters and end at as many."""
        begun_order, ended_order = np.lexsort([begin, begun]), np.lexsort([stop, ended])
        line, begin, stop = begun[begun_order], begin[begun_order], stop[ended_order]
        closed = np.sum((self.arcs.start - self.arcs.end) ** 2, axis=1) == 0
        # On a whole circle that was cut, the part up to its first point continues beyond it.
        last = np.flatnonzero(closed[line] & (stop == self.arcs.stop[line]) & (begin > self.arcs.begin[line]))
        first = np.searchsorted(line, line[last])
        joined = begin[first] == self.arcs.begin[line[last]]
        last, first = last[joined], first[joined]
        stop[last] += stop[first] - self.arcs.begin[line[last]]
        kept = stop > begin
        kept[first] = False
        line, begin, stop = line[kept], begin[kept], stop[kept]
        parts = self.arcs.take(line)
        start, end = (self.arcs.points(line, t) for t in (begin, stop))
        start = np.where((begin == parts.begin)[:, None], parts.start, start)
        end = np.where((stop == parts.stop)[:, None], parts.end, end)
        return replace(parts, start=start, end=end, begin=begin, stop=stop)


@dataclass(frozen=True, eq=False)
class _GridLines:
    """The lines of a grid on a page."""

    grid: Graticule
    chart: Chart

    def parameters(self) -> FloatArray:
        """Ascending parameters (n, k) at which each line's spacing is evaluated."""
        # Even steps before the lens are dense where it shrinks, even steps after it where it magnifies; besides, the
        # crossings with the limb of a ball, where all lines merge except those seen end-on.
        arcs = self.grid.arcs
        begin, stop = arcs.begin[:, None], arcs.stop[:, None]
        even = begin + np.linspace(0.0, 1.0, GRID_SAMPLES) * (stop - begin)
        # A lens takes a circle to a circle, and tan(t/2) about its nearest point to the focus to a multiple of itself:
        # the factor is the root of the ratio of the scales there and opposite.
        _, _, nearest = arcs.waves(self.chart.turns[0][2])
        every = np.arange(len(arcs))
        near, far = (self.chart.lens.scale_factor(arcs.points(every, nearest + turn)) for turn in (0.0, np.pi))
        half = np.linspace(-np.pi / 2, np.pi / 2, GRID_SAMPLES)[1:-1]
        bent = nearest[:, None] + 2 * np.arctan(np.tan(half) / np.sqrt(near / far)[:, None])
        limb = self.chart.limb
        middle, size, phase = arcs.waves(limb.normal)
        cosine = np.divide(limb.cosine - middle, size, out=np.ones_like(size), where=size > 0)
        away = np.arccos(np.clip(cosine, -1.0, 1.0))
        there = np.concatenate([bent, phase[:, None] + np.stack([away, -away], axis=1)], axis=1)
        there = begin + np.mod(there - begin, 2 * np.pi)
        return np.sort(np.concatenate([even, np.minimum(there, stop)], axis=1), axis=1)

    def spacing(self, row: Indices, t: FloatArray) -> FloatArray:
        """Distance from neighbouring lines on the page, in radii of the disc, at parameters of lines."""
        arcs = self.grid.arcs
        axis, u = arcs.axis[row], arcs.u[row]
        v, cos, sin = crossed(axis, u), np.cos(t)[..., None], np.sin(t)[..., None]
        place = axis * arcs.offset[row][..., None] + cos * u + sin * v
        across = crossed(place, cos * v - sin * u)
        across /= np.sqrt(np.sum(across**2, axis=-1, keepdims=True))
        gap = np.where(row < self.grid.meridians, np.hypot(place[..., 0], place[..., 1]), 1.0) * self.grid.step
        lens, matrix = self.chart.lens, self.chart.matrix
        image = lens(place)
        turn = self._turned(place, across, image)
        breadth = self.chart.view.breadth(turned(image, matrix), turned(turn, matrix))
        return gap * lens.scale_factor(place) * breadth

    def ends(self, t: FloatArray, enough: BoolArray, wanted: FloatArray) -> tuple[Indices, FloatArray, BoolArray]:
        """Where parts of lines begin and end between samples t (n, k): line, parameter, whether it is a beginning."""
        line, at = np.nonzero(enough[:, 1:] != enough[:, :-1])
        shown, hidden = t[line, at], t[line, at + 1]
        begins = enough[line, at + 1]
        shown[begins], hidden[begins] = hidden[begins], shown[begins]
        for _ in range(40):  # down to a millionth of a millionth of the interval
            middle = (shown + hidden) / 2
            enough_there = self.spacing(line, middle) >= wanted[line]
            shown, hidden = np.where(enough_there, middle, shown), np.where(enough_there, hidden, middle)
        return line, shown, begins

    def _turned(self, place: FloatArray, direction: FloatArray, image: FloatArray) -> FloatArray:
        """Images of unit tangent vectors at places under the lens, normalised."""
        # A fisheye moves places along great circles through its focus and keeps azimuths: the component of a vector
        # along the great circle stays along it, the component across stays across.
        right, left = self.chart.turns
        p, d, q = turned(place, right), turned(direction, right), turned(image, left.T)
        aside = np.hypot(p[..., 0], p[..., 1])
        at_focus = aside == 0
        east = np.where(at_focus, 1.0, p[..., 0]) / np.where(at_focus, 1.0, aside)
        north = np.where(at_focus, 0.0, p[..., 1]) / np.where(at_focus, 1.0, aside)
        outward = (d[..., 0] * east + d[..., 1] * north) * p[..., 2] - d[..., 2] * aside
        around = d[..., 1] * east - d[..., 0] * north
        height, width = q[..., 2], np.hypot(q[..., 0], q[..., 1])
        flat = outward * height
        turn = np.stack([flat * east - around * north, flat * north + around * east, -outward * width], axis=-1)
        return turned(turn, left)


@dataclass(frozen=True, eq=False)
class _Window:
    """The part of the sphere that a picture shows, and where the lines of a grid have room in it."""

    chart: Chart
    latitude: Latitude

    def meridians(self, stride: int, steps: int, apart: float) -> Indices:
        """Numbers of the meridians, by a stride, that may have room in the picture, neighbours at the scale `apart`."""
        box = self._room(apart, meeting=True)
        if box is None:
            return np.zeros(0, dtype=np.intp)
        step, (west, east) = stride * 180.0 / steps, box[2:]
        if east - west + 2 * step >= 360.0:
            return _multiples(-(steps // stride), -(-steps // stride), stride)
        numbers = _multiples(np.floor(west / step), np.ceil(east / step) + 1, stride)
        return np.mod(numbers + steps, 2 * steps) - steps

    def parallels(self, stride: int, steps: int, apart: float) -> Indices:
        """The same for parallels; indices may reach the poles and beyond."""
        box = self._room(apart, meeting=False)
        if box is None:
            return np.zeros(0, dtype=np.intp)
        step = stride * 180.0 / steps
        south, north = xyz_to_lonlat(lonlat_to_xyz([(0.0, lat) for lat in box[:2]]), latitude=self.latitude)[:, 1]
        return _multiples(np.floor(south / step), np.ceil(north / step) + 1, stride)

    def _room(self, apart: float, *, meeting: bool) -> _Box | None:
        """South, north, west, east of the part visible at this scale or a larger one; `meeting` is for meridians."""
        cap, view, focus = self.chart.source, self.chart.view, self.chart.turns[0][2]
        peak = focus if self.chart.lens.magnification >= 1 else -focus  # where the scale of the lens is largest
        edge = np.radians(view.angular_radius)  # where that of the view is
        widest = float(view.breadth(np.array([np.sin(edge), 0.0, np.cos(edge)]), np.array([0.0, 1.0, 0.0])))
        # The distance of the visible part from the peak, near which a box would reach round the sphere.
        apart_rad = 2 * np.arcsin(min(1.0, float(np.sqrt(np.sum((cap.normal - peak) ** 2))) / 2)) - cap.radius
        away = float(apart_rad) * (1 - REACH_MARGIN) - 8 * UNIT_ROUNDOFF
        box = _box_around(xyz_to_lonlat(cap.normal), cap.radius)
        for _ in range(8 if meeting else 1):  # where meridians meet, they have room in less and less of it
            nearest = 0.0 if box[0] <= 0 <= box[1] else min(abs(box[0]), abs(box[1]))
            breadth = float(np.cos(np.radians(nearest))) if meeting else 1.0
            radius = self._reach(apart / max(breadth, UNIT_ROUNDOFF) / widest)
            if radius is None or radius < away:
                return None
            around = _box_around(xyz_to_lonlat(peak), radius)
            south, north = max(box[0], around[0]), min(box[1], around[1])
            if south > north:
                return None
            narrower = around if around[3] - around[2] < box[3] - box[2] else box
            box = (south, north, *narrower[2:])
        return box

    def _reach(self, scale: float) -> float | None:
        """Distance in radians from the peak where the lens has this scale: L / (cos² + L² sin²) of half of it."""
        size = self.chart.lens.magnification
        larger = max(size, 1 / size)
        if scale > larger * (1 + REACH_MARGIN):
            return None
        if larger == 1 or scale == 0:
            return float(np.pi)
        return float(2 * np.arcsin(np.sqrt(np.clip((larger / scale - 1) / (larger**2 - 1), 0.0, 1.0))))


def _meridians(lons: FloatArray) -> Arcs:
    """Half great circles from the south pole to the north pole, as `stereodel.sphere.arcs.meridian`."""
    south = np.tile([0.0, 0.0, -1.0], (len(lons), 1))
    # Counterclockwise about lon − 90 is northwards at lon.
    axis = lonlat_to_xyz(np.stack([lons - 90.0, np.zeros(len(lons))], axis=1))
    zero = np.zeros(len(lons))
    return Arcs(south, -south, axis, zero, south, zero, np.full(len(lons), np.pi), np.arange(len(lons)))


def _parallels(lats: FloatArray, latitude: Latitude) -> Arcs:
    """Whole circles eastwards from longitude 0, as `stereodel.sphere.arcs.parallel`."""
    zero = np.zeros(len(lats))
    start = lonlat_to_xyz(np.stack([zero, lats], axis=1), latitude=latitude)
    axis = np.tile([0.0, 0.0, 1.0], (len(lats), 1))
    radius = start * [1.0, 1.0, 0.0]
    return Arcs(start, start, axis, start[:, 2], radius, zero, np.full(len(lats), 2 * np.pi), np.arange(len(lats)))


def _box_around(lonlat: FloatArray, radius: float) -> _Box:
    """South, north, west and east, degrees, of a cap about a place in degrees; `radius` in radians."""
    reach = float(np.degrees(radius * (1 + REACH_MARGIN) + 8 * UNIT_ROUNDOFF))
    lon, lat = lonlat.tolist()
    south, north = max(-90.0, lat - reach), min(90.0, lat + reach)
    if abs(lat) + reach >= 90.0:
        return (south, north, -180.0, 180.0)
    side = float(np.degrees(np.arcsin(min(1.0, np.sin(np.radians(reach)) / np.cos(np.radians(lat))))))
    return (south, north, lon - side, lon + side)


def usual_spacing(chart: Chart) -> float:
    """The spacing of `SPACINGS`, in degrees, that gives about `LINES_ACROSS` lines across a picture."""
    across = max(2 * float(np.degrees(chart.source.radius)), SPACINGS[-1])
    return min(SPACINGS, key=lambda spacing: abs(np.log(across / LINES_ACROSS / spacing)))


def _multiples(first: float, end: float, stride: int) -> Indices:
    """Multiples of a stride, from one up to another."""
    if end - first > MOST_GRID_LINES:
        raise ValueError(f"spacing is too small: over {MOST_GRID_LINES} lines have room; give wider lines or spacing")
    return np.arange(first, end).astype(np.intp) * stride


def _quarter(steps: int) -> int:
    """The stride of the lines that always remain: half of the number of steps, if it is even."""
    return steps // 2 if steps % 2 == 0 else steps


def _chain(whole: int) -> list[int]:
    """Strides 1, p, p·q … `whole`, by prime factors from the smallest on."""
    chain = [1]
    while (rest := whole // chain[-1]) > 1:
        chain.append(chain[-1] * next((k for k in range(2, isqrt(rest) + 1) if rest % k == 0), rest))
    return chain


def _strides(numbers: Indices, whole: int) -> Indices:
    """The largest stride of the chain that divides each line's number; 0 for multiples of the whole chain."""
    strides = np.ones(len(numbers), dtype=np.intp)
    for stride in _chain(whole):
        strides[numbers % stride == 0] = stride
    return np.where(numbers % whole == 0, 0, strides)
