"""The interior of rings: rings in any direction, oriented so that their region is on the left.

It is defined on the map of longitude and latitude, as in matplotlib, GeoJSON and shapefiles: the interior is the
bounded side, whatever the direction of the ring. Which rings are holes is given (`oriented`), or nested rings are
alternately holes and islands, by the even-odd rule (`on_the_left`). A ring that goes once around the Earth without
visiting a pole is not closed on that map; its interior is the smaller side.

Areas are computed on the equal-area map (λ, sin φ). The area to the left of a ring that is closed there is −∮ sin φ dλ,
which has a closed form for both kinds of edges.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices
from stereodel.constants import DEGREE_ROUNDING
from stereodel.curves.ragged import Ragged, spans
from stereodel.curves.trace import sides_of, unwrapped

POLAR_LATITUDE: Final = 80.0
"""Span in degrees above which an edge follows the border of the map, over the pole.

Such edges occur in hulls of scattered points, and in rings cut at ±180° that are not closed along ±90°.
"""

PROBE: Final = (3 - 5**0.5) / 2
"""Position on an edge where its ring's depth is measured: not a simple fraction, to avoid meridians of vertices."""


def oriented(rings: Ragged, hole: BoolArray) -> tuple[Ragged, FloatArray]:
    """Closed rings, straight on the map and wherever their longitudes lead, with their region on the left.

    Also their areas on the equal-area map, of 720 square degrees, negative for holes.
    """
    first, sides = sides_of(rings)
    (lon, lat), (turn, rise) = rings.values[first].T, np.diff(rings.values, axis=0)[first].T
    area, left, _ = _Edges(sides.row, lon, lat, turn, rise, np.zeros(len(lon)), straight=True).lefts(len(rings))
    return rings.reversed(left == hole), np.where(hole, -1.0, 1.0) * np.abs(area)


def on_the_left(
    rings: Ragged, owner: Indices, count: int, spots: FloatArray, *, straight: bool
) -> tuple[Ragged, tuple[Indices, Indices]]:
    """Closed rings with their region on the left, and pairs of spots, (m, 2) in degrees, and regions they are in.

    rings: (k, 2) in degrees, the first point repeated at the end.
    owner, count: the region of each ring, (r,), and the number of regions.
    straight: whether edges are straight on the map; otherwise they are the shorter great-circle arcs.
    """
    edges = _Edges.of(rings, straight=straight)
    _, left, around = edges.lefts(len(rings))
    total = partial(_total, edges.ring, len(rings))
    # The upper border of the map is above all edges: rings may follow it, or contain the pole without visiting it.
    over = np.rint(total(np.where(edges.lat > 0, edges.border, 0.0)) / 360.0).astype(np.intp)
    over += around & ((total(edges.turn) > 0) == left)
    hole = _is_hole(edges, rings, owner, count, left, over)
    edge, spot, ahead = edges.passing(spots[:, 0])
    # For the pole itself, test a place next to it, below the border of the map.
    above = edges.height(edge, ahead) > np.minimum(spots[spot, 1], 90.0 - DEGREE_ROUNDING)
    polar = np.flatnonzero(np.bincount(owner, over, minlength=count) % 2)
    pairs = spot[above] * count + owner[edges.ring[edge[above]]], np.arange(len(spots))[:, None] * count + polar
    pair, times = np.unique(np.append(*pairs), return_counts=True)
    return rings.reversed(left == hole), np.divmod(pair[times % 2 == 1], count)


@dataclass(frozen=True, eq=False)
class _Edges:
    """Edges of rings on the map in degrees, (e,) each: from (lon, lat) by `turn` and `rise`."""

    ring: Indices
    lon: FloatArray
    lat: FloatArray
    turn: FloatArray
    rise: FloatArray
    border: FloatArray
    """Additional whole turns along the upper or lower border of the map."""
    straight: bool

    @classmethod
    def of(cls, rings: Ragged, *, straight: bool) -> _Edges:
        first, sides = sides_of(rings)
        (lon, lat), (given, rise) = rings.values[first].T, np.diff(rings.values, axis=0)[first].T
        shorter = given - 360.0 * np.rint(given / 360.0)
        turn = np.diff(unwrapped(rings).values[:, 0])[first] if straight else shorter
        polar = np.minimum(np.abs(lat), np.abs(lat + rise)) > POLAR_LATITUDE
        return cls(
            sides.row, lon, lat, turn, rise, np.where(polar & (lat * (lat + rise) > 0), given - turn, 0.0), straight
        )

    def lefts(self, count: int) -> tuple[FloatArray, BoolArray, BoolArray]:
        """Of each of `count` rings: the area to its left, whether its region is there, and whether it goes around."""
        total = partial(_total, self.ring, count)
        area = -total(self.swept() + self.border * np.sign(self.lat))
        # Whole turns, up to rounding.
        around = np.abs(total(self.turn + self.border)) > 180.0
        # Eastwards around the Earth the left is the north, 360 + area large where the sphere is 720; westwards it is
        # the south, again 360 + area: in both cases the smaller side where the area is negative.
        return area, (area > 0) ^ around, around

    def swept(self) -> FloatArray:
        """∫ sin φ dλ along the edges, in degrees: the areas between them and the equator."""
        middle, half = np.radians(self.lat + self.rise / 2), np.radians(self.rise / 2)
        if self.straight:
            return self.turn * np.sin(middle) * np.sinc(half / np.pi)
        turn = np.radians(self.turn / 2)
        return 2 * np.degrees(np.arctan2(np.sin(turn) * np.sin(middle), np.cos(turn) * np.cos(half)))

    def height(self, edge: Indices, ahead: FloatArray) -> FloatArray:
        """Latitudes of edges (k,) at longitudes `ahead` of their starts, from 0 to `turn`, (k,)."""
        lat, turn, rise = self.lat[edge], self.turn[edge], self.rise[edge]
        if self.straight:
            return lat + rise * (ahead / turn)
        whole, gone = np.radians(np.abs(turn)), np.radians(np.abs(ahead))
        start, end = np.tan(np.radians(lat)), np.tan(np.radians(lat + rise))
        # On a great circle tan φ is a sine function of the longitude.
        return np.degrees(np.arctan2(start * np.sin(whole - gone) + end * np.sin(gone), np.sin(whole)))

    def passing(self, lon: FloatArray) -> tuple[Indices, Indices, FloatArray]:
        """Pairs of edges and meridians (m,) that they cross: indices of edges, indices of meridians, distance ahead.

        With the meridians in order, repeated for each turn, an edge crosses a contiguous range. The range includes the
        eastern end of the edge but not the western one, so of two edges that meet, exactly one crosses.
        """
        west = np.mod(np.minimum(self.lon, self.lon + self.turn), 360.0)
        east = west + np.abs(self.turn)
        lon = np.mod(lon, 360.0)
        order = np.argsort(lon)
        turns = np.arange(int(east.max(initial=0.0) // 360.0) + 1)
        meridians = (lon[order] + 360.0 * turns[:, None]).ravel()
        first, last = np.searchsorted(meridians, west, side="right"), np.searchsorted(meridians, east, side="right")
        edge, at = np.repeat(np.arange(len(west)), last - first), spans(first, last - first)
        since, turn = meridians[at] - west[edge], self.turn[edge]
        return edge, np.tile(order, len(turns))[at], np.where(turn > 0, since, since + turn)


def _total(ring: Indices, count: int, of_edges: FloatArray) -> FloatArray:
    return np.bincount(ring, of_edges, minlength=count).astype(np.float64)


def _is_hole(edges: _Edges, rings: Ragged, owner: Indices, count: int, left: BoolArray, over: Indices) -> BoolArray:
    """Which rings lie within an odd number of other rings of their region.

    For one place on the widest edge of each ring, the edges above it on the meridian to the north pole are counted.
    """
    hole = np.zeros(len(rings), dtype=np.bool_)
    several = np.bincount(owner, minlength=count)[owner] > 1
    if not several.any():
        return hole
    # The widest edge of each ring on the sphere; edges at a pole have no width.
    width = np.abs(edges.turn) * np.cos(np.radians(edges.lat + edges.rise / 2))
    width[np.minimum(np.abs(edges.lat), np.abs(edges.lat + edges.rise)) == 90.0] = 0.0
    order = np.lexsort((-width, edges.ring))
    ring, at = np.unique(edges.ring[order], return_index=True)
    own = order[at][several[ring] & (width[order[at]] > 0)]
    mine = edges.ring[own]
    ahead = PROBE * edges.turn[own]
    lat = edges.height(own, ahead)
    # The interior of a ring is on its left, north of edges that run eastwards, once it is oriented by `left`.
    north = (edges.turn[own] > 0) == left[mine]
    edge, place, ahead = edges.passing(edges.lon[own] + ahead)
    theirs = edges.ring[edge]
    others = (theirs != mine[place]) & (owner[theirs] == owner[mine[place]])
    edge, place, ahead = edge[others], place[others], ahead[others]
    above = edges.height(edge, ahead) - lat[place]
    # If two rings share the edge, the place is taken slightly inside its own ring.
    crossed = np.where(np.abs(above) <= DEGREE_ROUNDING, ~north[place], above > 0)
    depth = np.bincount(place[crossed], minlength=len(own)) - over[mine]
    hole[mine] = (depth + np.bincount(owner, over, minlength=count)[owner[mine]]) % 2 == 1
    return hole
