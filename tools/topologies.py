"""World maps whose neighbours share their borders: from TopoJSON on the sphere to arcs and rings on the flat map.

The rings of the source are joined across ±180° and around the pole, and clockwise. GeoJSON wants them cut there, and
counterclockwise: every arc is cut where it crosses ±180°, and open ends are joined along the edges of the map.
Coordinates are whole numbers, of 1e-4 degrees, from here on: two countries have the very same ones at their border.
"""

from __future__ import annotations

from itertools import chain, pairwise
from typing import Any

import numpy as np
import shapely

from stereodel.data.natural_earth import end_to_end

Arc = np.ndarray
"""(k, 2) longitudes and latitudes, whole numbers."""
Ring = list[int]
"""Arcs in order; ~i is arc i from its end to its start."""

DIGITS = 4
HALF = 180 * 10**DIGITS
"""Half a turn: the map is 2 HALF wide and HALF high."""
CAP = 899 * 10 ** (DIGITS - 1)
"""A ring of the source that stays beyond this latitude is a pole, drawn as the lower edge of a map."""


def arcs_of(topology: dict[str, Any]) -> list[np.ndarray]:
    """The arcs of a topology in degrees."""
    scale, translate = (np.array(topology["transform"][key]) for key in ("scale", "translate"))
    return [np.cumsum(steps, axis=0) * scale + translate for steps in topology["arcs"]]


class Atlas:
    """The arcs of a topology, cut at ±180°; rings are made of them, and of sides along the edges of the map."""

    def __init__(self, topology: dict[str, Any]) -> None:
        self.arcs: list[Arc] = []
        self._pieces: list[range] = []
        for degrees in arcs_of(topology):
            start = len(self.arcs)
            self.arcs += cut(np.rint(degrees * 10**DIGITS).astype(np.int64))
            self._pieces.append(range(start, len(self.arcs)))
        self._sides: dict[tuple[tuple[int, int], ...], int] = {}

    def polygons(self, geometry: dict[str, Any]) -> list[list[Ring]]:
        """The polygons of an object, each a list of rings: the outline counterclockwise, then holes clockwise."""
        if geometry["type"] == "GeometryCollection":
            return list(chain.from_iterable(map(self.polygons, geometry["geometries"])))
        parts = geometry.get("arcs", [])
        return list(chain.from_iterable(map(self._cut_polygon, [parts] if geometry["type"] == "Polygon" else parts)))

    def line(self, index: int) -> Arc:
        """An arc in the direction that a ring uses it."""
        return self.arcs[index] if index >= 0 else self.arcs[~index][::-1]

    def _cut_polygon(self, rings: list[Ring]) -> list[list[Ring]]:
        """A polygon of the source as polygons of the flat map."""
        outlines, holes = [], []
        for ring in chain.from_iterable(map(self._cut_ring, rings)):
            shape = shapely.Polygon(end_to_end(self.arcs, ring))
            if shape.area == 0:  # an islet that the source's rounding made one point
                continue
            (outlines if shape.exterior.is_ccw else holes).append((shape, [ring]))
        for hole, ring in holes:
            inside = hole.representative_point()
            (home,) = outlines if len(outlines) == 1 else [pair for pair in outlines if pair[0].contains(inside)]
            home[1].extend(ring)
        return [rings for _, rings in outlines]

    def _cut_ring(self, ring: Ring) -> list[Ring]:
        """A ring of the source, turned round, as rings of the flat map."""
        pieces = [i for arc in reversed(ring) for i in self._turned(arc)]
        if all((np.abs(self.arcs[max(i, ~i)][:, 1]) > CAP).all() for i in pieces):
            return []
        chains = self._chains(pieces)
        return self._joined(chains) if chains else [pieces]

    def _turned(self, arc: int) -> Ring:
        pieces = self._pieces[max(arc, ~arc)]
        return list(pieces) if arc < 0 else [~i for i in reversed(pieces)]

    def _chains(self, pieces: Ring) -> list[Ring]:
        """A cycle of pieces, parted where one does not end at the start of the next; nothing if it is closed."""
        follows = [np.array_equal(self.line(i)[-1], self.line(j)[0]) for i, j in pairwise([*pieces, pieces[0]])]
        if all(follows):
            return []
        first = follows.index(False) + 1
        pieces, follows = pieces[first:] + pieces[:first], follows[first:] + follows[:first]
        ends = [k + 1 for k, follow in enumerate(follows) if not follow]
        return [pieces[i:j] for i, j in pairwise([0, *ends])]

    def _joined(self, chains: list[Ring]) -> list[Ring]:
        """Chains from edge to edge of the map, closed along its edges with the inside on the left."""
        starts = [place_on_edge(self.line(chain[0])[0]) for chain in chains]
        ends = [place_on_edge(self.line(chain[-1])[-1]) for chain in chains]
        after = [min(range(len(chains)), key=lambda j: (starts[j] - end) % EDGES) for end in ends]
        rings, left = [], set(range(len(chains)))
        while left:
            ring, here = [], min(left)
            while here in left:
                left.remove(here)
                ring += [*chains[here], *self._side(ends[here], starts[after[here]])]
                here = after[here]
            rings.append(ring)
        return rings

    def _side(self, start: int, end: int) -> Ring:
        """A new arc along the edges of the map, none where the two places are one."""
        length = (end - start) % EDGES
        if length == 0:
            return []
        corners = sorted((corner - start) % EDGES for corner in CORNERS)
        between = [(start + way) % EDGES for way in corners if 0 < way < length]
        points = tuple(edge_point(place) for place in (start, *between, end))
        if points not in self._sides:
            self._sides[points] = len(self.arcs)
            self.arcs.append(np.array(points))
        return [self._sides[points]]


# Places on the edges of the map: up the right side from 0, along the top, down the left side, along the bottom.
EDGES = 6 * HALF
CORNERS = (0, HALF, 3 * HALF, 4 * HALF)


def place_on_edge(point: np.ndarray) -> int:
    """How far a point of the sides lies from the lower right corner, counterclockwise."""
    lon, lat = point.tolist()
    if abs(lon) != HALF:
        raise ValueError(f"a ring ends at {point}, which is not on an edge of the map")
    return lat + HALF // 2 if lon > 0 else 3 * HALF + HALF // 2 - lat


def edge_point(place: int) -> tuple[int, int]:
    """The point of a side, or the corner, at a place."""
    return (HALF, place - HALF // 2) if place <= HALF else (-HALF, 3 * HALF + HALF // 2 - place)


def cut(arc: Arc) -> list[Arc]:
    """An arc as pieces that meet ±180° with their ends alone; what runs along ±180° is left out."""
    steps = np.diff(arc[:, 0])
    lon = np.concatenate([arc[:1, 0], arc[0, 0] + np.cumsum(steps - 2 * HALF * np.rint(steps / (2 * HALF)))])
    if np.abs(lon).max() < HALF:
        return [arc]
    points = with_crossings(np.column_stack([lon.astype(np.int64), arc[:, 1]]))
    on_line = (points[:, 0] + HALF) % (2 * HALF) == 0
    bounds = sorted({0, len(points) - 1, *np.flatnonzero(on_line).tolist()})
    pieces = [points[i : j + 1] for i, j in pairwise(bounds) if j - i > 1 or not (on_line[i] and on_line[j])]
    return [piece - (2 * HALF * round(piece[:, 0].mean() / (2 * HALF)), 0) for piece in pieces]


def with_crossings(points: Arc) -> Arc:
    """Points whose longitudes go on beyond ±180°, and one more wherever a side crosses an odd multiple of 180°."""
    found = [points[0].tolist()]
    for (x0, y0), (x1, y1) in pairwise(points.tolist()):
        line = (max(x0, x1) + HALF) // (2 * HALF) * 2 * HALF - HALF
        if min(x0, x1) < line < max(x0, x1):
            found.append([line, round(y0 + (y1 - y0) * (line - x0) / (x1 - x0))])
        found.append([x1, y1])
    return np.array(found)
