"""Motions of films of a globe, functions of time whose values are shots: flights between foci, rotations, paths.

A flight's lens follows the shortest way in hyperbolic space (`stereodel.conformal.flight`). The view follows such a
path of its own, magnified `WIDE` times more, because a lens that magnifies nothing has no focus, but a view a centre.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from copy import copy
from dataclasses import KW_ONLY, dataclass, replace
from functools import cached_property
from typing import Any, Final, Protocol

import numpy as np

from stereodel._arrays import FloatArray, as_lonlat, as_scalar
from stereodel._extras import of_extra
from stereodel.conformal import GroupPath, MoebiusMap, fisheye, flight
from stereodel.constants import MOST_FRAMES, OPPOSITE
from stereodel.curves.view import MapView, View
from stereodel.drawing.page import Page
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.labels import title_height
from stereodel.drawing.page.placing import MARGIN
from stereodel.film.standing import Placed, placed, standing
from stereodel.globe.globe import Globe
from stereodel.globe.layers import AUTO, OfEarth, suited_to
from stereodel.sphere import angular_distance, lonlat_to_xyz, xyz_to_lonlat

Shot = tuple[MoebiusMap, MapView]
"""The lens and the view of a frame."""

NamedShot = tuple[MoebiusMap, MapView, Placed]
"""The same, and where names stand."""

WIDE: Final = 2.0
"""Magnification of the view's path relative to the lens's."""

PACE: Final = 1.0
"""Seconds for magnifying e times in place."""

TURN: Final = 2.0
"""Time for turning the globe by 1 rad, relative to that for magnifying e times.

At constant hyperbolic speed a flight would spend its time on the zoom, and the globe would spin too fast in between.
"""

STEPS: Final = 256
"""Number of parts of a leg in which its speed is measured."""

POINTS_PER_PIXEL: Final = 0.375
"""Width in points of a page whose globe is `FULL` pixels across or more: a line of 1 pt is 2⅔ pixels wide."""

FULL: Final = 720
"""Diameter in pixels above which line widths and type have a fixed size; below, it scales with the square root."""

SCREEN: Final = 72 / 96
"""Points of a pixel on a screen, as browsers take it."""

SAMPLED: Final = 32
"""Number of shots by which the largest scale of a film is found."""

FINE: Final = 0.2
"""Largest deviation of the drawing from the exact image, in pixels."""


class Motion(Protocol):
    """Interface of motions: shots from time 0 to `seconds`."""

    @property
    def seconds(self) -> float:
        """Duration."""

    def __call__(self, time: float) -> Shot:
        """Lens and view at a time."""


@dataclass(frozen=True, eq=False)
class GlobePages:
    """Draws a globe, with its title above and its legend below it if wanted, centred on a page of any aspect ratio."""

    globe: Globe
    width: int
    height: int
    background: Color
    legend: bool = False
    motion: Motion | None = None

    @property
    def point(self) -> float:
        """Points in a pixel."""
        return POINTS_PER_PIXEL * max(1.0, FULL / min(self.width, self.height)) ** 0.5

    @property
    def across(self) -> float:
        """Points across the globe and its margin."""
        across = min(self.width * self.point, self.height * self.point - self._below - title_height(self.globe.title))
        if across <= 0:
            size = f"{self.width} × {self.height}"
            raise ValueError(f"size is {size}, which leaves no room for the globe beside its legend")
        return across

    @cached_property
    def steady(self) -> Globe:
        """The globe with its maps of the Earth at one resolution, or coasts would change from one frame to the next."""
        auto = [layer for layer in self.globe.layers if isinstance(layer, OfEarth) and layer.resolution == AUTO]
        if self.motion is None or not auto:
            return self.globe
        peak = max(self.motion(time)[0].peak[1] for time in np.linspace(0.0, self.motion.seconds, SAMPLED).tolist())
        resolution = suited_to(peak * min(self.width, self.height) / 2 * SCREEN)
        globe, chosen = copy(self.globe), {id(layer): replace(layer, resolution=resolution) for layer in auto}
        globe.layers = [chosen.get(id(layer), layer) for layer in globe.layers]
        return globe

    @cached_property
    def _below(self) -> float:
        """Height of the legend in points."""
        blank = Page((0.0, 1.0, 0.0, 1.0), width=self.width * self.point)
        return self.globe.told(blank).height - blank.height if self.legend else 0.0

    def __call__(self, shot: Shot | NamedShot) -> Page:
        """The page of a shot, with names where they were placed for the whole film, or for this one alone."""
        (lens, view), names, point = shot[:2], shot[2:], self.point
        globe = standing(self.steady, *names) if names else self.steady
        page = globe.page(lens, view, width=self.across, tolerance=FINE * point)
        left, right, bottom, top = page.extent
        x, y, half = (left + right) / 2, (bottom + top) / 2, 0.5 / page.points_per_unit
        wide, high = self.width * point, self.height * point - self._below
        extent = (x - half * wide, x + half * wide, y - half * high, y + half * high)
        page = replace(page, extent=extent, width=wide, background=self.background)
        return self.globe.told(page) if self.legend else page


@dataclass(frozen=True, eq=False)
class Samples(Sequence[Shot]):
    """Shots of a motion at the times k / `rate`, evaluated on access, with where names stand on pages that have names.

    That is found for all of them when the first is asked for, so that frames may be drawn in any order.
    Raises ValueError if the motion is too short for one frame, or has more than `MOST_FRAMES`.
    """

    motion: Motion
    rate: float
    pages: GlobePages

    def __post_init__(self) -> None:
        seconds = as_scalar(self.motion.seconds, "seconds of the motion", low=0.0)
        count, rate = seconds * self.rate, f"{self.rate:g} frames a second"
        if count > MOST_FRAMES:
            raise ValueError(
                f"a motion of {seconds:g} s has {count:.7g} frames at {rate}, and at most {MOST_FRAMES} are drawn; "
                "give fewer seconds or a smaller fps"
            )
        if round(count) < 1:
            raise ValueError(f"a motion of {seconds:g} s has no frame at {rate}; give a larger fps")

    def __len__(self) -> int:
        return round(self.motion.seconds * self.rate)

    def __getitem__(self, number: Any) -> Any:
        """One shot."""
        return (*self.motion(range(len(self))[number] / self.rate), *self.names[number : number + 1 or None])

    @cached_property
    def names(self) -> list[Placed]:
        """Where they stand, by frames; empty if there are none."""
        shots = (self.motion(number / self.rate) for number in range(len(self)))
        with of_extra("render"):  # which brings what sets type, too
            return placed(self.pages.steady, shots, len(self), self.pages.across / (2 * (1 + MARGIN)))


@dataclass(frozen=True)
class Stop:
    """A stop of a flight.

    Parameters
    ----------
    focus : (float, float)
        Longitude and latitude in degrees of the focus, which is at the centre.
    magnification : float
        Magnification S ≥ 1 of the fisheye; 1 leaves the globe unchanged.
    hold : float
        Duration of the stop in seconds.

    Raises
    ------
    ValueError
        If the magnification is below 1 or not finite, the latitude outside [−90, 90], or the duration negative.
    """

    focus: tuple[float, float]
    magnification: float = 1.0
    hold: float = 1.0

    def __post_init__(self) -> None:
        as_lonlat(self.focus, "focus")
        as_scalar(self.magnification, "magnification", low=1.0)
        as_scalar(self.hold, "hold", low=0.0)

    @property
    def lens(self) -> MoebiusMap:
        """The fisheye."""
        return fisheye(self.focus, magnification=self.magnification)


@dataclass(frozen=True)
class Flight:
    """A flight from stop to stop: the lens weakens, the globe turns, and the lens magnifies the next place.

    Parameters
    ----------
    stops : sequence of Stop
        Two or more; consecutive stops must not be antipodal. North is up at each.
    pace : float
        Seconds for magnifying e times in place; turning the globe by 1 rad takes twice as long.

    Raises
    ------
    ValueError
        If there are fewer than two stops, consecutive stops are antipodal, or the pace is not positive.

    Examples
    --------
    >>> trip = Flight([Stop((2.35, 48.86), 8.0), Stop((-74.0, 40.7), 8.0, hold=2.0)])
    >>> lens, view = trip(0.5)
    >>> round(lens.magnification, 12), round(view.lon, 12), round(view.lat, 12)
    (8.0, 2.35, 48.86)
    >>> lens, view = trip(trip.seconds / 2 - 0.5)  # half-way: as far from one as from the other
    >>> round(lens.magnification, 3), round(view.lon, 1), round(view.lat, 1)
    (3.782, -39.0, 51.6)
    """

    stops: Sequence[Stop]
    _: KW_ONLY
    pace: float = PACE

    def __post_init__(self) -> None:
        as_scalar(self.pace, "pace", low=0.0, open_low=True)
        object.__setattr__(self, "stops", tuple(self.stops))
        if len(self.stops) < 2:
            raise ValueError(f"stops has {len(self.stops)} entries, but a flight has two or more")
        for number, (one, other) in enumerate(zip(self.stops, self.stops[1:], strict=False)):
            if np.linalg.norm(lonlat_to_xyz([one.focus, other.focus]).sum(axis=0)) < OPPOSITE:
                raise ValueError(
                    f"stops[{number + 1}] is opposite stops[{number}], so no way is the shortest; add a stop between"
                )

    @property
    def seconds(self) -> float:
        """Duration, including the stops."""
        return sum(stop.hold for stop in self.stops) + sum(leg.seconds for leg in self._legs)

    def __call__(self, time: float) -> Shot:
        """Lens and view at a time; before 0 and after the end, those of the first and last stop."""
        left = max(as_scalar(time, "time") - self.stops[0].hold, 0.0)
        for leg, stop in zip(self._legs, self.stops[1:], strict=True):
            if left < leg.seconds:
                return leg(left / leg.seconds)
            left -= leg.seconds
            if left < stop.hold:
                return leg(1.0)
            left -= stop.hold
        return self._legs[-1](1.0)

    @cached_property
    def _legs(self) -> list[_Leg]:
        return [_Leg(a, b, self.pace) for a, b in zip(self.stops, self.stops[1:], strict=False)]


class _Leg:
    """The leg from one stop to the next."""

    def __init__(self, start: Stop, end: Stop, pace: float) -> None:
        self._start, self._end = start, end
        self._lens = flight(start.focus, end.focus, magnification=start.magnification, arrival=end.magnification)
        near, far = WIDE * start.magnification, WIDE * end.magnification
        self._middle_length = flight(start.focus, end.focus, magnification=near, arrival=far).length
        self._times = np.linspace(0.0, 1.0, STEPS + 1)
        # Distance travelled up to each of the times.
        places = self._middles(self._times)
        zoom = np.diff(np.arcsinh(np.linalg.norm(places, axis=1)))
        turn = np.radians(angular_distance(places[1:], places[:-1]))
        self._way = np.concatenate([[0.0], np.cumsum(np.hypot(zoom, TURN * turn))])
        self.seconds = pace * float(self._way[-1])

    def __call__(self, share: float) -> Shot:
        t = float(np.interp(eased(share) * self._way[-1], self._way, self._times))
        return self._lens(t), self._view(t)

    def _middles(self, t: FloatArray) -> FloatArray:
        """Centres (n, 3) of the view at times (n,) times sinh η, η the distance of the view's path from the identity.

        A point of the hyperboloid has the components sinh η · f and cosh η; along a geodesic of length d they are
        combined with weights proportional to sinh (1 − t) d and sinh t d.
        """
        stops = (self._start, self._end)
        start, end = (np.sinh(np.log(WIDE * stop.magnification)) * lonlat_to_xyz(stop.focus) for stop in stops)
        d = self._middle_length
        if d == 0:
            return np.tile(start, (len(t), 1))
        return (np.sinh((1 - t[:, None]) * d) * start + np.sinh(t[:, None] * d) * end) / np.sinh(d)

    def _view(self, t: float) -> View:
        """View from above the centre; up turns uniformly relative to the great circle between the stops."""
        if t in {0.0, 1.0}:
            return View(*(self._end if t else self._start).focus)
        middle = self._middles(np.array([t]))[0]
        lon, lat = (float(angle) for angle in xyz_to_lonlat(middle))
        start, end = lonlat_to_xyz([self._start.focus, self._end.focus])
        normal = np.cross(start, end)
        if not normal.any():
            return View(lon, lat)
        normal /= np.linalg.norm(normal)
        before, now, after = (_north(place, normal) for place in (self._start.focus, (lon, lat), self._end.focus))
        share = float(angular_distance(start, middle) / angular_distance(start, end))
        # Up direction, counterclockwise from north: the picture is rotated the other way.
        up = before + share * _half_turns(after - before) - now
        return View(lon, lat, _half_turns(-up))


@dataclass(frozen=True)
class Spin:
    """A rotating globe, whose lens rotates with it.

    Parameters
    ----------
    lens : MoebiusMap, optional
        By default none.
    seconds : float
        For all turns.
    turns : float
        Eastward, as the Earth does; negative: westward.
    lon, lat : float
        Initial centre of the view in degrees; its latitude does not change.

    Examples
    --------
    >>> Spin(seconds=10.0)(2.5)[1]
    View(lon=-90.0, lat=20.0, roll=0.0)
    """

    lens: MoebiusMap | None = None
    _: KW_ONLY
    seconds: float = 10.0
    turns: float = 1.0
    lon: float = 0.0
    lat: float = 20.0

    def __post_init__(self) -> None:
        as_scalar(self.seconds, "seconds", low=0.0, open_low=True)
        as_scalar(self.turns, "turns")
        View(self.lon, self.lat)

    def __call__(self, time: float) -> Shot:
        """Lens and view at a time."""
        lens = MoebiusMap.identity() if self.lens is None else self.lens
        return lens, View(self.lon - 360.0 * self.turns * time / self.seconds, self.lat)


@dataclass(frozen=True)
class Morph:
    """A path from one lens to another in the Möbius group, with a fixed view.

    Parameters
    ----------
    path : stereodel.conformal.GroupPath
    view : View or StereographicView
    seconds : float
        Duration, including the way back if there is one.
    back : bool
        Whether the path is followed back, so that the film can loop.

    Examples
    --------
    >>> from stereodel.conformal import GroupPath
    >>> grow = Morph(GroupPath(MoebiusMap.identity(), fisheye((10.0, 50.0), magnification=16.0)), View(10.0, 50.0))
    >>> [round(grow(time)[0].magnification, 9) for time in (0.0, 2.0, 4.0)]
    [1.0, 4.0, 16.0]
    """

    path: GroupPath
    view: MapView
    _: KW_ONLY
    seconds: float = 4.0
    back: bool = False

    def __post_init__(self) -> None:
        as_scalar(self.seconds, "seconds", low=0.0, open_low=True)

    def __call__(self, time: float) -> Shot:
        """Lens and view at a time; before 0 and after the end, those of the ends."""
        share = min(max(as_scalar(time, "time") / self.seconds, 0.0), 1.0)
        return self.path(eased(1.0 - abs(2.0 * share - 1.0) if self.back else share)), self.view


def eased(share: float) -> float:
    """Easing from 0 to 1 with zero speed at both ends: 3s² − 2s³."""
    return share * share * (3.0 - 2.0 * share)


def _north(lonlat: tuple[float, float], normal: FloatArray) -> float:
    """Angle in degrees, counterclockwise, from the direction of travel around `normal` to north, at a point."""
    right, up, toward = View(*lonlat).matrix
    ahead = np.cross(normal, toward)
    return 90.0 - math.degrees(math.atan2(float(ahead @ up), float(ahead @ right)))


def _half_turns(angle: float) -> float:
    """The angle in [−180, 180), degrees."""
    return (angle + 180.0) % 360.0 - 180.0
