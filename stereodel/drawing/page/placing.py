"""Where names stand: one after another, in order of priority, each on the side of its place where it hides least.

A name is never where it would leave the disc, meet an earlier name or a leader, or hide more than `MOST_HIDDEN` of
dots; of the other sides it takes the cheapest. Prices are in square points: the ink of dots and lines under its words,
and a little for each side that comes earlier. Without any side it is left out, or led to from afar.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final, Literal

import numpy as np

from stereodel._arrays import BoolArray, FloatArray
from stereodel.drawing.page.items import Dots, Item, Label, Stroke, straight
from stereodel.drawing.page.labels import label_box
from stereodel.drawing.page.style import LineStyle

GAP: Final = 1.0
"""Least distance between labels, and between a label and its leader, points."""

SIDES: Final = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))
"""Candidate positions around a place, right and up, in the order in which they are tried."""

RISE: Final = 0.2
"""How far lines of type may extend beyond the box of their letters, up or down, in units of their size."""

SLANT: Final = 0.75
"""Factor on the distance, along both axes, for positions at a corner of the place."""

SHIFTS: Final = (0.6, 1.2)
"""How far a name moves that stands on its place, as that of a sea does, in units of its size."""

FAR: Final = (14.0, 21.0, 30.0, 42.0)
"""Distances of a name with a leader from its place, in points."""

DIRECTIONS: Final = 16
"""In which such a name may stand."""

CELL, MOST_CELLS, LEAST_DOT = 0.5, 2048, 1e-6
"""Side of the cells in which ink is summed, points; cells across a disc at most; weight below which there is no dot."""

MOST_HIDDEN: Final = 6.0
"""Weight of dots that a name may hide: a third of a usual dot, or several of a cloud of tiny ones."""

OF_LINES, MOST_LINES = 0.4, 20.0
"""Price of the ink of lines, which words cross more easily than dots, and of all lines under a name at most."""

OF_SIDE, OF_SHIFT = 0.25, 0.05
"""Price of each position that comes earlier in the order, around a place and where a name stands on it."""

OF_LEADER, BESIDE = 0.5, 30.0
"""Price of a point of a leader, and of having one, which is more than that of any side."""


Disc = tuple[tuple[float, float], float, float]
"""Centre and radius of a disc of a page, in page units, and the points in one of them."""


@dataclass(frozen=True, eq=False)
class Ink:
    """What dots and lines cover of a disc, as sums (n + 1, n + 1, 2) over cells from its lower left corner."""

    corner: FloatArray
    cell: float
    sums: FloatArray

    @classmethod
    def of(cls, items: Iterable[Item], disc: Disc) -> Ink:
        """The ink of items of a page."""
        center, radius, unit = disc
        corner, size = unit * (np.array(center) - radius), max(CELL, 2 * radius * unit / MOST_CELLS)
        count = int(np.ceil(2 * radius * unit / size))
        sums = np.zeros((2, count + 1, count + 1))
        for item in items:
            if (found := item.ink_at(unit)) is not None:
                cell = np.floor((found[:, :2] - corner) / size).astype(np.intp)
                inside = ((cell >= 0) & (cell < count)).all(axis=1)
                place = cell[inside] @ [1, count]
                table = np.bincount(place, found[inside, 2], minlength=count**2).reshape(count, count)
                sums[0 if isinstance(item, Dots) else 1, 1:, 1:] += table
        return cls(corner, size, np.moveaxis(sums.cumsum(axis=1).cumsum(axis=2), 0, -1))

    def under(self, boxes: FloatArray) -> FloatArray:
        """Ink of dots and of lines (..., 2) in boxes (..., 2, 2), in square points."""
        cell = np.clip(np.rint((boxes - self.corner) / self.cell), 0, len(self.sums) - 1).astype(np.intp)
        (left, right), (low, high) = np.moveaxis(cell, (-1, -2), (0, 1))
        found: FloatArray = (
            self.sums[high, right] - self.sums[high, left] - self.sums[low, right] + self.sums[low, left]
        )
        return found

    def price(self, boxes: FloatArray) -> FloatArray:
        """What words in boxes hide (...), infinite if that is too much."""
        dots, lines = np.moveaxis(self.under(boxes), -1, 0)
        return np.where(dots > MOST_HIDDEN, np.inf, dots + np.minimum(OF_LINES * lines, MOST_LINES))


@dataclass(frozen=True, eq=False)
class Seats:
    """The candidate positions of a name, the first its own, as boxes (n, 2, 2) about its place, in points.

    lines: what leads to each of them from the place (n, 2, 2); NaN beside it, where nothing does.
    cost: price of each, wherever the place is (n,).
    """

    labels: tuple[Label, ...]
    boxes: FloatArray
    lines: FloatArray
    cost: FloatArray
    movable: bool

    @classmethod
    def of(cls, label: Label, distance: float | None, own: float = 0.0, *, led: bool = False) -> Seats:
        """Around a place with a dot of radius `own`, and far from it if `led`.

        With the distance None, a label is where it was put, or on the opposite side, or at right angles.
        """
        if distance is None:
            right, up = label.offset
            near = [label, *(placed_label(label, turn) for turn in ((-right, -up), (-up, right), (up, -right)))]
        else:
            near = list(on_its_sides(label, max(distance, own + label.halo) if distance else 0.0))
        angle = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
        toward = np.stack([np.cos(angle), np.sin(angle)], axis=1).round(12)
        away = np.tile(toward, (len(FAR), 1)) if led else toward[:0]
        ends = (own + np.repeat(FAR, DIRECTIONS)[: len(away), None]) * away
        # A steep leader comes to the middle of a name from below or above, any other to its end.
        far = (placed_label(label, (x if 2 * abs(x) > abs(y) else 0.0, y)) for x, y in ends.tolist())
        labels = (*near, *(replace(each, offset=(x, y)) for each, (x, y) in zip(far, ends.tolist(), strict=True)))
        boxes = np.array([label_box(replace(each, anchor=(0.0, 0.0)), 1.0) for each in labels])
        lines = np.stack([(own + GAP) * away, ends - 2 * GAP * away], axis=1)
        near_cost = (OF_SIDE if distance else OF_SHIFT) * np.arange(len(near))
        cost = np.concatenate([near_cost, BESIDE + OF_LEADER * np.repeat(FAR, DIRECTIONS)[: len(away)]])
        lines = np.concatenate([np.full((len(near), 2, 2), np.nan), lines])
        return cls(labels, boxes, lines, cost, distance is not None)

    def prices(self, places: FloatArray, disc: Disc, ink: Ink | None) -> FloatArray:
        """The price (..., n) of each position of a name at places (..., 2) in points; infinite if it is impossible."""
        center, radius, unit = disc
        halo, boxes = self.labels[0].halo, self.boxes + places[..., None, None, :]
        reach = np.hypot(*np.moveaxis(np.abs(boxes - unit * np.array(center)).max(axis=-2), -1, 0))
        # A halo is round about the corners of the box.
        price = np.where(reach + halo <= unit * radius, self.cost, np.inf)
        return price if ink is None else price + ink.price(boxes + halo * np.array([[-1.0], [1.0]]))

    def claimed(self, places: FloatArray) -> FloatArray:
        """The boxes (..., n, 2, 2) reserved for a name at places (..., 2), so that its halo covers no earlier type."""
        label, boxes = self.labels[0], self.boxes + places[..., None, None, :]
        margin = np.array([label.halo, label.halo + RISE * label.size])
        return boxes + np.stack([-margin, margin]) if self.movable else boxes


@dataclass(eq=False)
class Placer:
    """Places names on a disc with items, where there is room between these and the names placed before.

    >>> placer = Placer(((0.0, 0.0), 1.0, 100.0), ())
    >>> names = [Label(name, (0.0, 0.0)) for name in ("Ulm", "Neu-Ulm", "Wiblingen")]
    >>> [(label.text, label.align) for name in names for label in placer.place(Seats.of(name, 8.0))]
    [('Ulm', 'left'), ('Neu-Ulm', 'right'), ('Wiblingen', 'center')]
    """

    disc: Disc
    items: Iterable[Item]

    def __post_init__(self) -> None:
        self.leaders = np.zeros((0, 2, 2))
        labels = (item for item in self.items if isinstance(item, Label))
        self.boxes = np.array([label_box(label, self.disc[2]) for label in labels]).reshape(-1, 2, 2)

    @cached_property
    def ink(self) -> Ink:
        """That of the items."""
        return Ink.of(self.items, self.disc)

    def place(self, seats: Seats, leader: LineStyle | None = None) -> Iterator[Label | Stroke]:
        """A label where it has room, and its leader if it has one; nothing without room."""
        unit = self.disc[2]
        at = unit * np.array(seats.labels[0].anchor)
        price = seats.prices(at, self.disc, self.ink if seats.movable else None)
        if not seats.movable:  # the first in the disc, or without a halo, which would interrupt its edge
            first = int(np.isfinite(price).argmax())
            halo = seats.labels[0].halo if np.isfinite(price[first]) else 0.0
            only = replace(seats.labels[first], halo=halo)
            seats = replace(seats, labels=(only,), boxes=seats.boxes[[first]], lines=seats.lines[[first]])
            price = np.zeros(1)
        boxes, lines = seats.claimed(at), seats.lines + at
        taken = meets(boxes, self.boxes) | crosses(self.leaders, boxes).any(axis=0)
        taken |= crosses(lines, self.boxes).any(axis=1) | meet(lines, self.leaders).any(axis=1)
        if (led := np.isfinite(lines[:, 0, 0])).any():
            along = np.linspace(lines[led, 0], lines[led, 1], round(FAR[-1]), axis=1)[:, :, None]
            hidden = self.ink.under(along + self.ink.cell * np.array([[-1.0], [1.0]]))[..., 0]
            taken[led] |= hidden.max(axis=1) > LEAST_DOT
        price = np.where(taken, np.inf, price)
        chosen = int(price.argmin())
        if np.isfinite(price[chosen]):
            self.boxes = np.concatenate([self.boxes, at + seats.boxes[chosen, None]])
            if leader is not None and np.isfinite(lines[chosen]).all():
                self.leaders = np.concatenate([self.leaders, lines[chosen, None]])
                yield Stroke(straight(lines[chosen] / unit), leader.color, leader.width, leader.dash, name="leader")
            yield seats.labels[chosen]


def meets(boxes: FloatArray, others: FloatArray) -> BoolArray:
    """Whether boxes (..., 2, 2) are nearer than `GAP` to one of others (..., n, 2, 2), in points."""
    low, high = boxes[..., None, 0, :], boxes[..., None, 1, :]
    # Boxes overlap if they do so in both directions.
    return np.asarray(((low < others[..., 1, :] + GAP) & (others[..., 0, :] < high + GAP)).all(axis=-1).any(axis=-1))


def crosses(lines: FloatArray, boxes: FloatArray) -> BoolArray:
    """Which segments (n, 2, 2) pass within `GAP` of which boxes (k, 2, 2): (n, k)."""
    start, way = lines[:, None, 0], lines[:, None, 1] - lines[:, None, 0]
    way = np.where(way == 0, 1e-9, way)
    sides = np.stack([(boxes[:, 0] - GAP - start) / way, (boxes[:, 1] + GAP - start) / way])
    first, last = sides.min(axis=0).max(axis=-1), sides.max(axis=0).min(axis=-1)
    return np.asarray(np.maximum(first, 0.0) <= np.minimum(last, 1.0))


def meet(lines: FloatArray, others: FloatArray) -> BoolArray:
    """Which segments (n, 2, 2) meet which others (k, 2, 2): (n, k)."""
    (a, b), (c, d) = np.moveaxis(lines[:, None], 2, 0), np.moveaxis(others[None], 2, 0)

    def side(p: FloatArray, q: FloatArray, r: FloatArray) -> FloatArray:
        turn: FloatArray = (q - p)[..., 0] * (r - p)[..., 1] - (q - p)[..., 1] * (r - p)[..., 0]
        return turn

    return np.asarray((side(a, b, c) * side(a, b, d) <= 0) & (side(c, d, a) * side(c, d, b) <= 0))


def placed_label(label: Label, offset: tuple[float, float]) -> Label:
    """A label on the side of its place given by an offset in points."""
    align: Literal["left", "center", "right"] = "left" if offset[0] > 0 else "right" if offset[0] < 0 else "center"
    valign: Literal["bottom", "center", "top"] = "bottom" if offset[1] > 0 else "top"
    if offset[0] or not offset[1]:
        valign = "center"
    return replace(label, offset=offset, align=align, valign=valign)


def on_its_sides(label: Label, distance: float) -> Iterator[Label]:
    """The label at each candidate position; at a distance of 0 it stands on its place, or moves a little from it."""
    if not distance:
        steps = [(0.0, 0.0), *((step * x, step * y) for step in SHIFTS for x, y in SIDES)]
        yield from (replace(label, offset=(label.size * x, label.size * y)) for x, y in steps)
        return
    for right, up in SIDES:
        away = distance if not (right and up) else SLANT * distance
        candidate = placed_label(label, (right * away, up * away))
        # At a corner position, a corner of the label is nearest to the place.
        yield replace(candidate, valign="bottom" if up > 0 else "top") if right and up else candidate


def with_room(items: Iterable[Item], extent: tuple[float, float, float, float], points_per_unit: float) -> list[Item]:
    """Page items without labels that would overlap an earlier label or leave (left, right, bottom, top)."""
    low, high = points_per_unit * np.array(extent[::2]), points_per_unit * np.array(extent[1::2])
    kept: list[Item] = []
    boxes = np.zeros((0, 2, 2))
    for item in items:
        if isinstance(item, Label):
            box = label_box(item, points_per_unit)
            if meets(box, boxes) or (box[0] < low).any() or (box[1] > high).any():
                continue
            boxes = np.concatenate([boxes, box[None]])
        kept.append(item)
    return kept
