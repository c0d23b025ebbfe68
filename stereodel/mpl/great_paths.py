"""Paths of great-circle edges on the page: seen through a conformal map, cut where the view ends.

The image of a great-circle arc under a conformal map is an arc of a circle again, which three points of it fix. So
nothing is searched for: where it leaves the cap that a view shows is a root of a linear form in cosine and sine, and
how many straight pieces it takes on the page follows from its radius.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray
from stereodel.conformal import MoebiusMap
from stereodel.constants import LIMB_DEPTH, SHORT_ARC
from stereodel.drawing.view import MapView
from stereodel.sphere.vectors import turned

Indices = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class ImageArcs:
    """Images of great-circle arcs in view axes: center + cos(s·sweep)·u + sin(s·sweep)·v for s from 0 to 1.

    Those shorter than `SHORT_ARC` are taken as straight: `sweep` is 0, u their start, v their chord, center 0.
    """

    center: FloatArray
    u: FloatArray
    v: FloatArray
    sweep: FloatArray

    @classmethod
    def through(cls, lens: MoebiusMap, view: MapView, start: FloatArray, end: FloatArray) -> ImageArcs:
        """Of the shorter arcs between unit vectors (k, 3); between opposite ones, of one over the north."""
        images = turned(lens(np.concatenate([start, _middles(start, end), end])), view.matrix)
        a, m, b = np.split(images, 3)
        first, second = m - a, b - m
        axis = np.cross(first, second)
        size = _length(axis)
        short = (_length(first) + _length(second) < SHORT_ARC) | (size == 0)
        axis /= np.where(size == 0, 1.0, size)[:, None]
        center = axis * np.sum(axis * a, axis=1, keepdims=True)
        u, w = a - center, b - center
        v = np.cross(axis, u)
        sweep = np.mod(np.arctan2(np.sum(w * v, axis=1), np.sum(w * u, axis=1)), 2 * np.pi)
        straight = short[:, None]
        return cls(
            np.where(straight, 0.0, center),
            np.where(straight, a, u),
            np.where(straight, b - a, v),
            np.where(short, 0.0, sweep),
        )

    def points(self, arc: Indices, s: FloatArray) -> FloatArray:
        """Points (p, 3) of arcs (p,) at shares s (p,) of the way."""
        angle = s * self.sweep[arc]
        straight = self.sweep[arc] == 0
        cosine, sine = np.where(straight, 1.0, np.cos(angle)), np.where(straight, s, np.sin(angle))
        points: FloatArray = self.center[arc] + cosine[:, None] * self.u[arc] + sine[:, None] * self.v[arc]
        return points

    def crossings(self, level: float) -> FloatArray:
        """Shares (k, 2) of the way at which the height is `level`; 0 in place of those that are not there."""
        constant, c, s = self.center[:, 2] - level, self.u[:, 2], self.v[:, 2]
        amplitude = np.hypot(c, s)
        with np.errstate(divide="ignore", invalid="ignore"):
            half = np.arccos(-constant / amplitude)
            middle = np.arctan2(s, c)
            turns = np.mod(np.stack([middle - half, middle + half], axis=1), 2 * np.pi) / self.sweep[:, None]
            line = np.stack([-(constant + c) / s, np.zeros_like(s)], axis=1)
        found = np.where((self.sweep == 0)[:, None], line, turns)
        return np.where((found > 0) & (found < 1), found, 0.0)

    def pieces(self, tolerance: float) -> FloatArray:
        """Into how many chords a whole arc must be cut for them to stray from it by `tolerance` at most, (k,).

        A chord over the angle θ of a circle of radius r strays by r(1 − cos(θ/2)) ≤ r θ²/8.
        """
        return self.sweep * np.sqrt(_length(self.u) / (8 * tolerance))


@dataclass(frozen=True, eq=False)
class Chains:
    """Polylines on the page, one after the other: chain i is ``points[offsets[i]:offsets[i + 1]]``."""

    points: FloatArray
    """(n, 2)."""
    offsets: Indices
    """(m + 1,)."""
    ring: Indices
    """(m,): the line that each is a part of, in order."""
    whole: BoolArray
    """(m,): whether the chain is a closed line of which nothing is hidden; its ends are equal."""

    def split(self) -> list[FloatArray]:
        """The chains, each (k, 2)."""
        return [self.points[a:b] for a, b in pairwise(self.offsets.tolist())]


@dataclass(frozen=True, eq=False)
class Lines:
    """Lines of vertices, one after the other, on the unit sphere; the last vertex of a closed one is its first."""

    vertices: FloatArray
    """(n, 3)."""
    offsets: Indices
    """(m + 1,)."""

    def edges(self) -> tuple[FloatArray, FloatArray, Indices]:
        """Starts and ends (k, 3) of the edges and the line of each, (k,); edges without length are left out."""
        line = np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))
        start, end = self.vertices[:-1], self.vertices[1:]
        kept = (line[:-1] == line[1:]) & (start != end).any(axis=1)
        return start[kept], end[kept], line[:-1][kept]


def chains_of(lines: Lines, lens: MoebiusMap, view: MapView, tolerance: float) -> Chains:
    """The visible parts of lines, as polylines that stray from them by `tolerance` page units at most."""
    start, end, line = lines.edges()
    arcs = ImageArcs.through(lens, view, start, end)
    arc, begin, stop = _visible(arcs, view.edge)
    if not len(arc):
        return Chains(np.zeros((0, 2)), np.zeros(1, dtype=np.intp), np.zeros(0, dtype=np.intp), np.zeros(0, dtype=bool))
    joined = np.zeros(len(arc), dtype=bool)
    joined[1:] = _follows(arc[:-1], stop[:-1], arc[1:], begin[1:]) & (line[arc[1:]] == line[arc[:-1]])
    share = stop - begin
    counts = np.maximum(1, np.ceil(arcs.pieces(tolerance / view.stretch)[arc] * share)).astype(np.intp)
    piece = np.repeat(np.arange(len(arc)), counts + 1)
    place = np.arange(len(piece)) - np.repeat(np.cumsum(counts + 1) - counts - 1, counts + 1)
    s = begin[piece] + share[piece] * (place / counts[piece])
    kept = (place > 0) | ~joined[piece]
    piece, s = piece[kept], s[kept]
    page = view.flattened(arcs.points(arc[piece], s))
    firsts = np.flatnonzero(~joined)
    offsets = np.append(np.searchsorted(piece, firsts), len(piece))
    ring = line[arc[firsts]]
    lasts = np.append(firsts[1:], len(arc)) - 1
    edge_first, edge_last = np.searchsorted(line, ring), np.searchsorted(line, ring, side="right") - 1
    closed = (start[edge_first] == end[edge_last]).all(axis=1)
    entered = closed & (arc[firsts] == edge_first) & (begin[firsts] == 0)
    left = closed & (arc[lasts] == edge_last) & (stop[lasts] == 1)
    return _rejoined(Chains(page, offsets, ring, entered & left), entered, left)


def _rejoined(chains: Chains, entered: BoolArray, left: BoolArray) -> Chains:
    """Closed lines that begin in sight, but are not wholly seen: their last chain goes on as the first one.

    Where only one of both is there, the line begins on the edge of the view and comes out of sight, or goes there.
    """
    both = np.intersect1d(chains.ring[left & ~chains.whole], chains.ring[entered & ~chains.whole])
    if not len(both):
        return chains
    chosen = np.isin(chains.ring, both)
    first, last = np.flatnonzero(entered & chosen), np.flatnonzero(left & chosen)
    pieces = chains.split()
    for before, after in zip(last.tolist(), first.tolist(), strict=True):
        pieces[before] = np.concatenate([pieces[before], pieces[after][1:]])
    kept = np.ones(len(pieces), dtype=bool)
    kept[first] = False
    pieces = [pieces[i] for i in np.flatnonzero(kept)]
    offsets = np.concatenate([[0], np.cumsum([len(piece) for piece in pieces])])
    return Chains(np.concatenate(pieces), offsets, chains.ring[kept], chains.whole[kept])


def _visible(arcs: ImageArcs, level: float) -> tuple[Indices, FloatArray, FloatArray]:
    """The visible pieces of arcs in order: the arc, and the shares of its way where they begin and stop, (p,) each."""
    count = len(arcs.sweep)
    cuts = np.sort(np.hstack([np.zeros((count, 1)), arcs.crossings(level), np.ones((count, 1))]), axis=1)
    arc = np.repeat(np.arange(count), 3)
    begin, stop = cuts[:, :-1].ravel(), cuts[:, 1:].ravel()
    height = arcs.points(arc, (begin + stop) / 2)[:, 2]
    seen = (stop > begin) & (height >= level - LIMB_DEPTH)
    return arc[seen], begin[seen], stop[seen]


def _follows(arc: Indices, stop: FloatArray, following: Indices, begin: FloatArray) -> BoolArray:
    """Whether a piece goes on where the one before it, of the same line, stops."""
    same = (arc == following) & (stop == begin)
    joined: BoolArray = same | ((arc + 1 == following) & (stop == 1) & (begin == 0))
    return joined


def _middles(start: FloatArray, end: FloatArray) -> FloatArray:
    """The middles of the shorter arcs between unit vectors (k, 3)."""
    total = start + end
    size = _length(total)
    opposite = np.flatnonzero(size == 0)
    if len(opposite):
        a = start[opposite]
        # Perpendicular to a, as far north as can be; from a pole, on the meridian 0.
        toward = np.where((np.abs(a[:, 2]) == 1)[:, None], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0])
        total[opposite] = toward - np.sum(toward * a, axis=1, keepdims=True) * a
        size[opposite] = _length(total[opposite])
    return total / size[:, None]


def _length(vectors: FloatArray) -> FloatArray:
    length: FloatArray = np.sqrt(np.sum(vectors * vectors, axis=-1))
    return length
