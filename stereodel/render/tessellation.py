"""A page as triangles for OpenGL: every item but labels, in painter's order and in pixels of the picture.

Strokes become ribbons of constant width, dots discs; regions are cut into slabs at the height of every corner and
crossing, in which the even-odd rule pairs the edges off, or, if they are polygons, into fans and ears. The triangles of
one item may overlap: `stereodel.render.gl` draws an item as their union.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final, assert_never

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices, Pixels, SingleArray
from stereodel.constants import FLATNESS
from stereodel.curves.fill import triangles
from stereodel.curves.ragged import Ragged, spans
from stereodel.drawing.page import Ball, Beziers, Dots, Fill, Item, Label, Page, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.items import along
from stereodel.render.gl import Disc, Triangles, Window
from stereodel.render.vector.outlines import has_length

Corners = FloatArray
"""Triangles by their corners, (n, 3, 2)."""

MARGIN: Final = 1.0
"""Pixels by which a window is widened to find its triangles: coordinates up to 2²⁴ are rounded by 1/2."""


@dataclass(frozen=True, eq=False)
class Batch:
    """Triangles of one item by their corners (n, 3, 2), pixels, and a colour at each corner (n, 3, 4).

    An item with a texture, which is made when a window is drawn, has one batch; all batches of an item have one ball.
    """

    corners: Corners
    colors: FloatArray
    texture: Callable[[Window], Pixels] | None = None
    ball: Disc | None = None

    @cached_property
    def boxes(self) -> SingleArray:
        """Bounding box of each triangle, (n, 4)."""
        a, b, c = (self.corners[:, i] for i in range(3))
        low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
        return np.concatenate([low, high], axis=1, dtype=np.float32)


class Batches:
    """The triangles of a picture in painter's order; `numbered` has the index of each batch's item, not decreasing."""

    def __init__(self, numbered: Iterable[tuple[int, Batch]]) -> None:
        kept = [(number, batch) for number, batch in numbered if len(batch.corners)]
        self._numbers = np.array([number for number, _ in kept], dtype=np.int32)
        self._batches = [batch for _, batch in kept]
        around = [(*batch.boxes[:, :2].min(axis=0), *batch.boxes[:, 2:].max(axis=0)) for batch in self._batches]
        self._boxes = np.array(around, dtype=np.float32).reshape(-1, 4)

    def within(self, window: Window) -> Triangles:
        """All triangles that touch a window, in order, and possibly others."""
        hit = np.flatnonzero(_touching(self._boxes, window))
        chosen = [(self._batches[i], np.flatnonzero(_touching(self._batches[i].boxes, window))) for i in hit]
        corners = np.concatenate([np.zeros((0, 3, 2)), *(batch.corners[rows] for batch, rows in chosen)])
        colors = np.concatenate([np.zeros((0, 3, 4)), *(batch.colors[rows] for batch, rows in chosen)])
        slots = np.repeat(self._numbers[hit], [3 * len(rows) for _, rows in chosen])
        faces = np.arange(3 * len(corners), dtype=np.int32).reshape(-1, 3)
        seen = (i for i, (_, rows) in zip(hit, chosen, strict=True) if len(rows))
        drawn = [(int(self._numbers[i]), self._batches[i]) for i in seen]
        textures = {number: batch.texture(window) for number, batch in drawn if batch.texture is not None}
        balls = {number: batch.ball for number, batch in drawn if batch.ball is not None}
        return Triangles(corners.reshape(-1, 2), colors.reshape(-1, 4), slots, faces, textures, balls)


def _touching(boxes: SingleArray, window: Window) -> BoolArray:
    left, bottom, right, top = boxes.T
    across = (left < window.left + window.width + MARGIN) & (right > window.left - MARGIN)
    return across & (bottom < window.bottom + window.height + MARGIN) & (top > window.bottom - MARGIN)


def triangulate(page: Page, width: int, height: int) -> Batches:
    """All items of a page except labels as triangles of a picture of `width` by `height` pixels."""
    left, right, bottom, top = page.extent
    scale = np.array([width / (right - left), height / (top - bottom)])
    pixels = _PixelMap(np.array([left, bottom]), scale, page.points_per_unit, width / page.width)
    return Batches((number, batch) for number, item in enumerate(page.items) for batch in pixels.batches(item))


@dataclass(frozen=True, eq=False)
class _PixelMap:
    """The map from page coordinates and points to pixels."""

    origin: FloatArray
    scale: FloatArray
    points_per_unit: float
    pixels_per_point: float

    def batches(self, item: Item) -> list[Batch]:
        """The batches of an item; where they overlap, the first is visible."""
        match item:
            case Stroke():
                return [_colored(self._stroke(item), item.color)] if has_length(item, self.points_per_unit) else []
            case Polylines():
                width = item.width * self.pixels_per_point
                return [_colored(ribbons(self._place(item.points), item.offsets, width), item.color)]
            case Polygons():
                return [self._polygons(item)]
            case Fill():
                return [_colored(region(self._outlines(item.paths)), item.color, self._disc(item.ball))]
            case Dots():
                return self._dots(item)
            case Picture():
                return [self._picture(item)]
            case Label():
                return []  # set over everything else
            case _:
                assert_never(item)

    def _place(self, points: FloatArray) -> FloatArray:
        return (points - self.origin) * self.scale

    def _disc(self, ball: Ball | None) -> Disc | None:
        if ball is None:
            return None
        (x, y), (across, up) = self._place(np.array(ball.center)).tolist(), (ball.radius * self.scale).tolist()
        return x, y, across, up

    def _outlines(self, paths: tuple[Beziers, ...]) -> list[FloatArray]:
        return [flatten(self._place(path)) for path in paths]

    def _stroke(self, stroke: Stroke) -> Corners:
        points = flatten(self._place(stroke.path))
        if stroke.closed:
            points = np.concatenate([points, points[:1]])
        dash = stroke.dash and (stroke.dash[0] * self.pixels_per_point, stroke.dash[1] * self.pixels_per_point)
        width = stroke.width * self.pixels_per_point
        options = {"closed": stroke.closed, "round_caps": stroke.cap == "round"}
        return ribbons(points, np.array([0, len(points)]), width, dash=dash or None, **options)

    def _polygons(self, polygons: Polygons) -> Batch:
        loops = Ragged(self._place(polygons.points), polygons.offsets)
        corners, owner = triangles(loops, polygons.owner)
        return _colored(corners, polygons.colors[owner, None], self._disc(polygons.ball))

    def _dots(self, dots: Dots) -> list[Batch]:
        centers = self._place(dots.centers)
        inner, outer = (r * self.pixels_per_point for r in (dots.radius - dots.rim_width, dots.radius))
        found = [_colored(discs(centers, inner), dots.color)]
        if dots.rim_width:
            found.append(_colored(discs(centers, outer), dots.rim))
        return found

    def _picture(self, picture: Picture) -> Batch:
        width, height = 1 / self.scale

        def texture(window: Window) -> Pixels:
            left, bottom = self.origin + np.array([window.left, window.bottom]) / self.scale
            place = (left, bottom + window.height * height, width, height)
            return picture.painter.paint(place, (window.width, window.height))

        return replace(_colored(region(self._outlines(picture.outline)), (1.0, 1.0, 1.0, 1.0)), texture=texture)


def _colored(corners: Corners, colors: Color | FloatArray, ball: Disc | None = None) -> Batch:
    """Triangles with colours broadcast to their corners (n, 3, 4)."""
    colors = np.asarray(colors)
    if ball is None:
        # Levels of 1/255, rounded half up, so that rounding inside OpenGL has nothing to decide.
        colors = np.floor(255 * colors + 0.5) / 255
    return Batch(corners, np.broadcast_to(colors, (len(corners), 3, 4)), ball=ball)


def flatten(path: Beziers, tolerance: float = FLATNESS) -> FloatArray:
    """Points (m, 2) along a run of cubics, first to last, whose chords are within `tolerance`; neighbours may coincide.

    A cubic cut into n equal parts of its parameter is off by at most (3/4) M/n², M = max |Pᵢ − 2Pᵢ₊₁ + Pᵢ₊₂|
    (Wang's formula).
    """
    bend = np.linalg.norm(path[:, :-2] - 2 * path[:, 1:-1] + path[:, 2:], axis=-1).max(axis=-1)
    parts = np.maximum(1, np.ceil(np.sqrt(0.75 * bend / tolerance))).astype(np.intp)
    piece = np.repeat(np.arange(len(path)), parts)
    s = (spans(np.zeros_like(parts), parts) / parts[piece])[:, None]
    return np.concatenate([along(path[piece], s), path[-1:, 3]])


def ribbons(
    points: FloatArray,
    offsets: Indices,
    width: float,
    *,
    closed: bool = True,
    round_caps: bool = True,
    dash: tuple[float, float] | None = None,
) -> Corners:
    """Polylines of one constant width with round joins, as triangles that overlap.

    offsets: (m + 1,), line i is ``points[offsets[i]:offsets[i + 1]]``.
    closed: whether lines are joined where their ends are equal.
    round_caps: whether ends, also of dashes, are semicircles, and points are discs; else they are cut straight.
    dash: length of dash and gap of the only line; the first dash begins at the first point.
    """
    line = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    kept = _moves(points) | (np.diff(line, prepend=-1) > 0)
    points, line = points[kept], line[kept]
    drawn = line[1:] == line[:-1]
    if not drawn.any():
        return discs(points[: len(points) * round_caps], width / 2)
    first = np.flatnonzero(np.concatenate([[True], ~drawn]))
    last = np.append(first[1:], len(points)) - 1
    alone = points[first[(first == last) & round_caps]]
    if dash is not None:
        points, drawn = _dashed(points, *dash)
        last = np.array([len(points) - 1])
    ring = np.all(points[first] == points[last], axis=1) & (first < last) & closed
    bends = _bends(points, drawn, width / 2, np.stack([first[ring], last[ring]], axis=1), round_caps)
    return np.concatenate([_rectangles(points, drawn, width / 2), bends, discs(alone, width / 2)])


def discs(centers: FloatArray, radius: float) -> Corners:
    """Discs at centres (n, 2)."""
    turn = np.full(len(centers), 2 * np.pi)
    return _wedges(centers, np.zeros(len(centers)), turn, radius)


def region(runs: Sequence[FloatArray]) -> Corners:
    """The region inside closed polygons, (m, 2) each, by the even-odd rule; they may cross."""
    starts = np.concatenate(runs)
    ends = np.concatenate([np.roll(run, -1, axis=0) for run in runs])
    sloping = starts[:, 1] != ends[:, 1]
    down = (starts[:, 1] > ends[:, 1])[:, None]
    low, high = np.where(down, ends, starts)[sloping], np.where(down, starts, ends)[sloping]
    levels = np.unique(np.concatenate([low[:, 1], high[:, 1], _crossing_heights(low, high)]))
    first = np.searchsorted(levels, low[:, 1])
    slabs = np.searchsorted(levels, high[:, 1]) - first
    edge, slab = np.repeat(np.arange(len(low)), slabs), spans(first, slabs)
    bottom, top = levels[slab], levels[slab + 1]
    left_to_right = np.lexsort((_abscissa(low, high, edge, (bottom + top) / 2), slab))
    edge, bottom, top = edge[left_to_right], bottom[left_to_right], top[left_to_right]
    feet = np.stack([_abscissa(low, high, edge, bottom), bottom], axis=1)
    heads = np.stack([_abscissa(low, high, edge, top), top], axis=1)
    quads = np.stack([feet[0::2], feet[1::2], heads[1::2], heads[0::2]], axis=1)
    return _halved(quads)


def _moves(points: FloatArray) -> BoolArray:
    """Which points are not where the one before is."""
    return np.concatenate([[True], np.any(points[1:] != points[:-1], axis=1)])[: len(points)]


def _halved(quads: FloatArray) -> Corners:
    """Quadrilaterals (n, 4, 2) as two triangles each."""
    return quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3, 2)


def _dashed(points: FloatArray, dash: float, gap: float) -> tuple[FloatArray, BoolArray]:
    """The polyline with points added at the ends of dashes, and which of its segments are drawn."""
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    begins = np.arange(0.0, along[-1], dash + gap)
    cuts = np.concatenate([begins, begins + dash])
    at = np.unique(np.concatenate([along, cuts[cuts < along[-1]]]))
    cut = np.stack([np.interp(at, along, points[:, axis]) for axis in (0, 1)], axis=1)
    drawn = (at[:-1] + at[1:]) / 2 % (dash + gap) < dash
    apart = _moves(cut)  # cuts closer than the spacing of doubles coincide
    return cut[apart], drawn[apart[1:]]


def _rectangles(points: FloatArray, drawn: BoolArray, radius: float) -> Corners:
    start, end = points[:-1][drawn], points[1:][drawn]
    along = (end - start) / np.linalg.norm(end - start, axis=1, keepdims=True)
    side = radius * np.stack([-along[:, 1], along[:, 0]], axis=1)
    return _halved(np.stack([start - side, end - side, end + side, start + side], axis=1))


def _bends(points: FloatArray, drawn: BoolArray, radius: float, rings: Indices, round_caps: bool) -> Corners:
    """The outer side of each bend, and half a disc at each end; `rings` are first and last points of closed lines."""
    steps = np.diff(points, axis=0)
    angle = np.arctan2(steps[:, 1], steps[:, 0])
    before, after = np.concatenate([[False], drawn]), np.concatenate([drawn, [False]])
    angle_in, angle_out = np.concatenate([angle[:1], angle]), np.concatenate([angle, angle[-1:]])
    first, last = rings.T
    before[first], angle_in[first] = drawn[last - 1], angle[last - 1]
    after[last] = drawn[first]
    turn = (angle_out - angle_in + np.pi) % (2 * np.pi) - np.pi
    joins = before & after
    joins[last] = False  # a closed line has its bend at its start
    # Turning left (turn > 0) opens the right side, a quarter turn clockwise from the direction of travel.
    wedges = [_wedges(points[joins], (angle_in - np.copysign(np.pi / 2, turn))[joins], turn[joins], radius)]
    if round_caps:
        for ends, way in ((after & ~before, angle_out + np.pi / 2), (before & ~after, angle_in - np.pi / 2)):
            wedges.append(_wedges(points[ends], way[ends], np.full(int(ends.sum()), np.pi), radius))
    return np.concatenate(wedges)


def _wedges(centers: FloatArray, start_rad: FloatArray, turn_rad: FloatArray, radius: float) -> Corners:
    """Sectors of discs from the direction `start_rad` through `turn_rad`, in triangles flat to `FLATNESS`."""
    # A chord of angle a deviates by r(1 − cos(a/2)).
    step = 2 * np.arccos(max(1 - FLATNESS / radius, 0.5)) if radius > 0 else np.pi
    parts = np.ceil(np.abs(turn_rad) / step).astype(np.intp)
    wedge = np.repeat(np.arange(len(parts)), parts)
    size = turn_rad[wedge] / parts[wedge]
    begin = start_rad[wedge] + spans(np.zeros_like(parts), parts) * size
    rim = [radius * np.stack([np.cos(a), np.sin(a)], axis=1) for a in (begin, begin + size)]
    center = centers[wedge]
    return np.stack([center, center + rim[0], center + rim[1]], axis=1)


def _abscissa(low: FloatArray, high: FloatArray, edge: Indices, y: FloatArray) -> FloatArray:
    """Where edges meet horizontal lines; at the heights of their ends, exactly those ends."""
    (x0, y0), (x1, y1) = low[edge].T, high[edge].T
    share = (y - y0) / (y1 - y0)
    return x0 * (1 - share) + x1 * share


def _crossing_heights(low: FloatArray, high: FloatArray) -> FloatArray:
    """Heights at which two edges cross inside both, found among pairs that overlap in height and width."""
    heights = [np.zeros(0)]
    left, right = np.minimum(low[:, 0], high[:, 0]), np.maximum(low[:, 0], high[:, 0])
    for i in range(len(low) - 1):
        later = slice(i + 1, None)
        level = (low[later, 1] < high[i, 1]) & (high[later, 1] > low[i, 1])
        j = i + 1 + np.flatnonzero(level & (left[later] <= right[i]) & (right[later] >= left[i]))
        bottom, top = np.maximum(low[i, 1], low[j, 1]), np.minimum(high[i, 1], high[j, 1])
        mine = np.full(len(j), i)
        gap0 = _abscissa(low, high, mine, bottom) - _abscissa(low, high, j, bottom)
        gap1 = _abscissa(low, high, mine, top) - _abscissa(low, high, j, top)
        swap = (gap0 < 0) != (gap1 < 0)
        heights.append((bottom + (top - bottom) * gap0 / np.where(gap0 == gap1, 1.0, gap0 - gap1))[swap])
    return np.concatenate(heights)
