"""Great-circle arcs as chains of points that a map can join by straight lines.

Each arc is sampled once, whatever borders on it, so that neighbours share every point. The poles and the crossings of
the 180th meridian are points of the chains; cutting a ring there is bookkeeping (`rings`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from stereodel._arrays import BoolArray, FloatArray
from stereodel.constants import AT_POLE, CHORD_CLEARANCE, DEGREE_ROUNDING
from stereodel.io.faces import Indices, spans
from stereodel.sphere import xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude


@dataclass(frozen=True, eq=False)
class Arcs:
    """Arcs of at most half a great circle, counterclockwise about their normals.

    Attributes
    ----------
    start, end : (k, 3) arrays
        Unit vectors.
    normal : (k, 3) array
        Unit normals, which tell antipodal ends apart; zero where the ends are not antipodal for certain.
    sites : (k, 3) array, optional
        Unit vectors of points that must stay on their side of the arc.
    """

    start: FloatArray
    end: FloatArray
    normal: FloatArray
    sites: FloatArray | None = None

    def middles(self) -> FloatArray:
        """The middles of the arcs, (k, 3).

        The middle of an arc of angle 2h is along a + b, of length 2 cos h, and along (b − a) × n, of length 2 sin h:
        the sum of both is never short.
        """
        return _unit(self.start + self.end + np.cross(self.end - self.start, self.normal))


@dataclass(frozen=True, eq=False)
class Chains:
    """Points along arcs, one arc after the other, both ends included.

    Attributes
    ----------
    xyz : (p, 3) array
        Unit vectors.
    lonlat : (p, 2) array
        Degrees; the longitudes of poles and of points of the 180th meridian mean nothing.
    owner : (p,) array of int
        The arc of each point, in order.
    latitude : str
        What kind of latitude `lonlat` has.
    """

    xyz: FloatArray
    lonlat: FloatArray
    owner: Indices
    latitude: Latitude

    @classmethod
    def of(cls, points: FloatArray, owner: Indices, latitude: Latitude) -> Chains:
        """With longitude and latitude computed."""
        return cls(points, xyz_to_lonlat(points, latitude=latitude), owner, latitude)

    @cached_property
    def pole(self) -> BoolArray:
        """Points at the poles, (p,)."""
        return np.asarray((self.xyz[:, :2] == 0).all(axis=1))

    @cached_property
    def seam(self) -> BoolArray:
        """Points on the 180th meridian, without the poles, (p,)."""
        return np.asarray((self.xyz[:, 1] == 0) & (self.xyz[:, 0] < 0))

    @cached_property
    def offsets(self) -> Indices:
        """Where each arc begins, up to the last one's end."""
        return np.concatenate([[0], np.flatnonzero(np.diff(self.owner)) + 1, [len(self.owner)]])

    def steps(self) -> Indices:
        """The points that are not the last ones of their arcs."""
        return np.flatnonzero(self.owner[:-1] == self.owner[1:])

    def on_map(self, step: Indices) -> FloatArray:
        """Longitude and latitude of both ends of steps, (s, 2, 2).

        An end on the 180th meridian is on the other end's side of the map, one at a pole at the other end's longitude.
        """
        return self.between(step, step + 1)

    def between(self, point: Indices, following: Indices) -> FloatArray:
        """The same for steps between any points that follow each other, in either direction."""
        return np.stack([self._seen(point, following), self._seen(following, point)], axis=1)

    def _seen(self, point: Indices, other: Indices) -> FloatArray:
        lonlat = self.lonlat[point].copy()
        lonlat[:, 0] = np.where(self.seam[point], np.copysign(180.0, self.xyz[other, 1]), lonlat[:, 0])
        lonlat[:, 0] = np.where(self.pole[point], self.lonlat[other, 0], lonlat[:, 0])
        return lonlat

    def straying(self, step: Indices, middle: Chains) -> FloatArray:
        """How far the chords' middles are off the arcs', (s, 2), in longitude and latitude."""
        special = self.pole | self.seam
        along = special[step] & special[step + 1]
        return np.where(along[:, None], 0.0, np.abs(middle.lonlat - self.on_map(step).mean(axis=1)))

    def middles(self, steps: Indices) -> Chains:
        """The middles of the steps from the given points to the next ones."""
        middles = _unit(self.xyz[steps] + self.xyz[steps + 1])
        return Chains.of(middles, self.owner[steps], self.latitude)

    def with_middles(self, steps: Indices) -> Chains:
        """The same arcs with further points in the middles of some steps."""
        new = self.middles(steps)
        return Chains(
            np.insert(self.xyz, steps + 1, new.xyz, axis=0),
            np.insert(self.lonlat, steps + 1, new.lonlat, axis=0),
            np.insert(self.owner, steps + 1, new.owner),
            self.latitude,
        )


def sample(arcs: Arcs, max_segment: float, latitude: Latitude) -> Chains:
    """Chains with chords of at most `max_segment` degrees, also in longitude."""
    step_rad = float(np.radians(max_segment))
    chains = chains_along(*_equal_steps(arcs, step_rad), step_rad, latitude)
    while len(steps := _too_near(arcs, chains)):
        chains = chains.with_middles(steps)
    return chains


def chains_along(points: FloatArray, owner: Indices, step_rad: float, latitude: Latitude) -> Chains:
    """Chains through unit vectors, which get points at the poles, on the 180th meridian and between far longitudes."""
    points, owner = _with_seam(*_with_poles(_snapped(points), owner))
    return Chains.of(*_with_longitudes(points, owner, step_rad), latitude)


def _too_near(arcs: Arcs, chains: Chains) -> Indices:
    """Steps whose chord strays from the arc by too large a part of its distance from the site."""
    if arcs.sites is None:
        return np.zeros(0, dtype=np.intp)
    step = chains.steps()
    arc, middle, chord = chains.owner[step], chains.middles(step), chains.xyz[step + 1] - chains.xyz[step]
    site = arcs.sites[arc]
    foot = np.abs(np.sum(site * arcs.normal[arc], axis=1))
    away = np.maximum(foot, _length(site - middle.xyz) - _length(chord) / 2)
    off = chains.straying(step, middle)
    off[:, 0] *= np.hypot(middle.xyz[:, 0], middle.xyz[:, 1])
    near: Indices = step[_length(off) > np.maximum(CHORD_CLEARANCE * np.degrees(away), DEGREE_ROUNDING)]
    return near


def _equal_steps(arcs: Arcs, step_rad: float) -> tuple[FloatArray, Indices]:
    """Points at equal angles, and the arc of each."""
    chord, middle = arcs.end - arcs.start, arcs.middles()
    half = np.arctan2(_length(chord), _length(arcs.start + arcs.end))
    along = _unit(chord - np.sum(chord * middle, axis=1, keepdims=True) * middle)
    counts = np.maximum(np.ceil(2 * half / step_rad), 1).astype(np.intp)
    owner = np.repeat(np.arange(len(chord)), counts + 1)
    place = spans(np.zeros_like(counts), counts + 1)
    angle = ((2 * place / counts[owner] - 1) * half[owner])[:, None]
    points = np.cos(angle) * middle[owner] + np.sin(angle) * along[owner]
    points[place == 0], points[place == counts[owner]] = arcs.start, arcs.end
    return points, owner


def _with_poles(points: FloatArray, owner: Indices) -> tuple[FloatArray, Indices]:
    """The same chains with the poles where they pass within rounding."""
    p, q = points[:-1, :2], points[1:, :2]
    chord = q - p
    along, across = -np.sum(p * chord, axis=1), p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    length = _length(chord)
    passed = (owner[:-1] == owner[1:]) & (along > 0) & (along < length**2) & (np.abs(across) <= AT_POLE * length)
    place = np.flatnonzero(passed)
    poles = np.zeros((len(place), 3))
    poles[:, 2] = np.sign(points[place, 2])
    return _inserted(points, owner, place, poles)


def _with_seam(points: FloatArray, owner: Indices) -> tuple[FloatArray, Indices]:
    """The same chains with a point wherever they cross the 180th meridian.

    Where a chord meets the plane y = 0 is a point of its great circle as well.
    """
    p, q = points[:-1], points[1:]
    place = np.flatnonzero((owner[:-1] == owner[1:]) & (p[:, 1] * q[:, 1] < 0))
    meeting = p[place] * np.abs(q[place, 1:2]) + q[place] * np.abs(p[place, 1:2])
    meeting[:, 1] = 0.0
    wanted = meeting[:, 0] < 0
    return _inserted(points, owner, place[wanted], _unit(meeting[wanted]))


def _with_longitudes(points: FloatArray, owner: Indices, step_rad: float) -> tuple[FloatArray, Indices]:
    """The same chains with points between those that are too far apart in longitude, at the middle longitude."""
    while True:
        reach = np.hypot(points[:, 0], points[:, 1])
        horizontal = points / np.where(reach == 0, 1.0, reach)[:, None]
        p, q = horizontal[:-1], horizontal[1:]
        turn = np.abs(np.arctan2(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0], p[:, 0] * q[:, 0] + p[:, 1] * q[:, 1]))
        apart = (owner[:-1] == owner[1:]) & (reach[:-1] > 0) & (reach[1:] > 0) & (turn > step_rad)
        place = np.flatnonzero(apart)
        if not len(place):
            return points, owner
        points, owner = _inserted(points, owner, place, _unit(p[place] + q[place]))


def _inserted(points: FloatArray, owner: Indices, place: Indices, new: FloatArray) -> tuple[FloatArray, Indices]:
    return np.insert(points, place + 1, new, axis=0), np.insert(owner, place + 1, owner[place])


def _snapped(points: FloatArray) -> FloatArray:
    """Points within rounding of a plane of two axes exactly there, those near a pole at the pole."""
    points[np.abs(points) <= AT_POLE] = 0.0
    at_pole = (points[:, 0] == 0) & (points[:, 1] == 0)
    points[at_pole, 2] = np.sign(points[at_pole, 2])
    return points


def _length(vectors: FloatArray) -> FloatArray:
    length: FloatArray = np.sqrt(np.sum(vectors * vectors, axis=-1))
    return length


def _unit(vectors: FloatArray) -> FloatArray:
    """Unit vectors; a zero vector stays."""
    length = _length(vectors)[:, None]
    return vectors / np.where(length == 0, 1.0, length)
