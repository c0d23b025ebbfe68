"""Where names stand: one after another, in order of priority, each on the side of its place where it hides least.

A name is never where it would leave the disc, meet an earlier name or a leader, or hide more than `MOST_HIDDEN` of
dots; of the other sides it takes the cheapest. Prices are in square points: the ink of dots and lines under its words,
and a little for each side that comes earlier. Without any side it is left out, or led to from afar. All of this,
leaders too, is boxes, which are arrays (..., 2, 2) of a lower left and an upper right corner in points.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Final

import numpy as np

from stereodel._arrays import BoolArray, FloatArray
from stereodel.curves.chart import Chart
from stereodel.drawing.page.items import Dots, Item, Label, Polygons, Polylines, Stroke, corners_along, straight
from stereodel.drawing.page.labels import label_box
from stereodel.drawing.page.style import LineStyle

GAP: Final = 1.0
"""Least distance between labels, and from a leader to dots and labels, in points; a leader keeps as much free."""

SIDES: Final = np.exp(0.25j * np.pi * np.array([0, 4, 2, 6, 1, 7, 3, 5])).round(12)
"""Directions around a place, right and up, in the order in which they are tried; first those along the axes."""

RISE, SHIFTS = 0.2, (0.8, 1.6)
"""In units of its size, how far type extends up or down beyond its box, and the name of a sea moves from its place."""

FAR, STEPS = (14.0, 19.0, 26.0, 34.0, 42.0), 30
"""Distances of a name with a leader from its place, in points; number of boxes in a leader."""

OUTWARD: Final = np.array([[-1.0], [1.0]])
"""Directions in which the corners of a box move as it grows."""

MARGIN: Final = 0.03
"""Margin around a disc, in its radii, in which names stand that are not movable and too long for the disc."""

CELL, MOST_CELLS = 0.5, 2048
"""Side of the cells in which ink is summed, points; cells across a disc at most."""

DOT_PLACES, LARGE_DOT = 19, 3.0
"""Places in a dot; its radius in points from which dots weigh the same, as names may touch a bubble."""

BORDER_WEIGHT: Final = 1.5
"""Width of a line that weighs as a border does, drawn or not, as type is worse to read on two grounds."""

MOST_HIDDEN: Final = 6.0
"""Weight of dots that a name may hide: a third of a usual dot, or several of a cloud of tiny ones."""

OF_LINES, MOST_LINES = 0.4, 20.0
"""Price of the ink of lines, which words cross more easily than dots, and of all lines under a name at most."""

OF_SIDE, OF_SHIFT, OF_LEADER = 0.25, 0.05, 30.0
"""Price of each earlier position, around a place or on it, and of a leader, which is more than that of any side."""


@dataclass(frozen=True, eq=False)
class Seats:
    """The candidate positions of a name, the first its own, as boxes (n, 2, 2) about its place.

    rooms: what is reserved for each of them, so that its halo covers no earlier type (n, 2, 2).
    leaders: what leads to the last of them, as boxes in a row (m, k, 2, 2).
    """

    labels: tuple[Label, ...]
    boxes: FloatArray
    rooms: FloatArray
    leaders: FloatArray
    movable: bool

    @classmethod
    def of(cls, label: Label, distance: float | None, own: float = 0.0, *, led: bool = False) -> Seats:
        """Around a place with a dot of radius `own`, and far from it if `led`.

        With the distance None, a label is where it was put, or on the opposite side, or at right angles; with 0 it
        stands on its place, or moves a little from it.
        """
        near = SIDES[:4] * complex(*label.offset) if distance is None else SIDES * max(distance, own + label.halo)
        if distance == 0:
            near = label.size * np.append(0.0, np.outer(SHIFTS, SIDES))
        around = np.exp(0.125j * np.pi * np.arange(16)).round(12)  # between the sides, too: more names have room
        far = np.outer(own + np.array(FAR[: len(FAR) * led]), around).ravel()
        labels = [placed_label(label, (at.real, at.imag)) for at in (*near.tolist(), *far.tolist())]
        if distance == 0:
            labels[: len(near)] = [replace(label, offset=each.offset) for each in labels[: len(near)]]
        boxes = np.array([label_box(replace(each, anchor=(0.0, 0.0)), 1.0) for each in labels])
        toward = far / np.abs(far)
        row = np.linspace((own + GAP) * toward, far - 2 * GAP * toward, STEPS, axis=1)
        leaders = np.stack([row.real, row.imag], axis=-1)[:, :, None] + OUTWARD * GAP / 2
        margin = np.array([label.halo, label.halo + RISE * label.size]) if distance is not None else 0.0
        return cls(tuple(labels), boxes, boxes + margin * OUTWARD, leaders, distance is not None)


@dataclass(eq=False)
class Placer:
    """Places names on a disc with items, where there is room between these and the names placed before.

    >>> from stereodel import MoebiusMap
    >>> from stereodel.drawing import View
    >>> placer = Placer(Chart(MoebiusMap.identity(), View(0.0, 0.0), unit=100.0), ())
    >>> names = [Label(name, (0.0, 0.0)) for name in ("Ulm", "Neu-Ulm", "Wiblingen")]
    >>> [(label.text, label.align) for name in names for label in placer.place(Seats.of(name, 8.0))]
    [('Ulm', 'left'), ('Neu-Ulm', 'right'), ('Wiblingen', 'center')]
    """

    chart: Chart
    items: Iterable[Item]

    def __post_init__(self) -> None:
        labels = (item for item in self.items if isinstance(item, Label))
        self.boxes = np.array([label_box(label, self.chart.unit) for label in labels]).reshape(-1, 2, 2)

    @cached_property
    def sums(self) -> FloatArray:
        """The ink of dots and of lines to the left of and below each corner of cells, (2, n + 1, n + 1)."""
        (x, y), radius, unit = self.chart.at, self.chart.scale, self.chart.unit
        edges = unit * np.linspace(-radius, radius, min(int(np.ceil(2 * radius * unit / CELL)), MOST_CELLS) + 1)
        sums = np.zeros((2, len(edges), len(edges)))
        for item in self.items:
            right, up, weight = ink(item, unit)
            found, _, _ = np.histogram2d(up - unit * y, right - unit * x, (edges, edges), weights=weight)
            sums[0 if isinstance(item, Dots) else 1, 1:, 1:] += found
        return sums.cumsum(axis=1).cumsum(axis=2)

    def under(self, boxes: FloatArray) -> FloatArray:
        """Ink of dots and of lines (2, ...) in boxes, in square points."""
        center, radius, unit = np.array(self.chart.at), self.chart.scale, self.chart.unit
        share = np.clip((boxes / unit - center) / radius, -1.0, 1.0) / 2 + 0.5
        cell = np.rint(share * (self.sums.shape[1] - 1)).astype(np.intp)
        (left, low), (right, high) = np.moveaxis(cell, (-2, -1), (0, 1))
        ends, starts = (self.sums[:, row, right] - self.sums[:, row, left] for row in (high, low))
        return np.asarray(ends - starts)

    def prices(self, seats: Seats, at: FloatArray) -> FloatArray:
        """The price (n,) of each position of a name at a place in points; infinite if it cannot be there."""
        center, radius, unit = np.array(self.chart.at), self.chart.scale, self.chart.unit
        boxes, halo, number = seats.boxes + at, seats.labels[0].halo, np.arange(len(seats.boxes))
        price: FloatArray = np.multiply(number, OF_SIDE if any(seats.labels[0].offset) else OF_SHIFT)
        price[len(number) - len(seats.leaders) :] += OF_LEADER
        # A halo is round about the corners of the box.
        price[np.hypot(*np.abs(boxes - unit * center).max(axis=1).T) + halo > unit * radius] = np.inf
        if seats.movable:
            dots, lines = self.under(boxes + halo * OUTWARD)
            price += np.where(dots > MOST_HIDDEN, np.inf, dots + np.minimum(OF_LINES * lines, MOST_LINES))
        return price

    def taken(self, seats: Seats, at: FloatArray) -> BoolArray:
        """Which positions (n,) of a name at a place in points are those of others, or outside the margin."""
        center, radius, unit = np.array(self.chart.at), self.chart.scale, self.chart.unit
        boxes, leaders = seats.boxes + at, seats.leaders + at
        outside = np.abs(boxes - unit * center) > (1 + MARGIN) * radius * unit
        found = outside.any(axis=(1, 2)) | meets(seats.rooms + at, self.boxes)
        if len(leaders):
            found[-len(leaders) :] |= (meets(leaders, self.boxes) | (self.under(leaders)[0] > 0)).any(axis=1)
        return np.asarray(found)

    def place(self, seats: Seats, leader: LineStyle | None = None) -> Iterator[Label | Stroke]:
        """A label where it has room, and its leader if it has one; nothing without room."""
        unit = self.chart.unit
        at = unit * np.array(seats.labels[0].anchor)
        price, taken = self.prices(seats, at), self.taken(seats, at)
        if seats.movable:  # other names move for the disc alone
            price[taken] = np.inf
        chosen = int(price.argmin())
        fits = np.isfinite(price[chosen])
        if taken[chosen] or (seats.movable and not fits):
            return
        self.boxes = np.concatenate([self.boxes, at + seats.boxes[chosen, None]])
        number = chosen - len(seats.boxes) + len(seats.leaders)
        if leader is not None and number >= 0:
            boxes = at + seats.leaders[number]
            self.boxes = np.concatenate([self.boxes, boxes])
            path = straight(boxes[[0, -1]].mean(axis=1) / unit)
            yield Stroke(path, leader.color, leader.width, leader.dash, name="leader")
        # The halo of a name that leaves the disc would interrupt its edge.
        yield seats.labels[chosen] if fits else replace(seats.labels[chosen], halo=0.0)


def meets(boxes: FloatArray, others: FloatArray) -> BoolArray:
    """Whether boxes (..., 2, 2) are nearer than `GAP` to one of others (..., n, 2, 2), in points."""
    low, high = boxes[..., None, 0, :], boxes[..., None, 1, :]
    # Boxes overlap if they do so in both directions.
    return np.asarray(((low < others[..., 1, :] + GAP) & (others[..., 0, :] < high + GAP)).all(axis=-1).any(axis=-1))


def ink(item: Item, unit: float) -> FloatArray:
    """Places x, y in points, and the weights (3, n) that an item has there for names: those of dots, or areas of lines.

    Of a dot this is the area times the radius, as a dot says more than as much of a cloud.
    """
    match item:
        case Dots():
            k = np.arange(DOT_PLACES)  # in a spiral
            turn = np.sqrt((k + 0.5) / DOT_PLACES) * np.exp(1j * np.pi * (3 - 5**0.5) * k)
            radius = np.broadcast_to(np.asarray(item.radius, dtype=np.float64), len(item.centers))[:, None]
            x, y = unit * item.centers.T[..., None] + radius * np.stack([turn.real, turn.imag])[:, None]
            weight = np.pi * np.minimum(radius, LARGE_DOT) ** 3 / DOT_PLACES
            return np.stack([x, y, np.broadcast_to(weight, x.shape)]).reshape(3, -1)
        case Stroke():
            points, ends = np.concatenate([corners_along(item.path), item.path[-1:, 3]]), np.zeros(0, dtype=np.intp)
        case Polylines() | Polygons():
            points, ends = item.points, item.offsets[1:-1]
        case _:
            return np.zeros((3, 0))
    width = BORDER_WEIGHT if isinstance(item, Polygons) else item.width * item.color[3]
    length = unit * np.hypot(*np.diff(points, axis=0).T)
    length[ends - 1] = 0.0  # from line to line
    along = np.append(0.0, length.cumsum())
    steps = np.linspace(0.0, along[-1], 2 * int(np.ceil(along[-1])) + 1)[1::2]  # 1 point long
    x, y = (unit * np.interp(steps, along, way) for way in points.T)
    return np.stack([x, y, np.full(len(x), width * along[-1] / max(len(x), 1))])


def placed_label(label: Label, offset: tuple[float, float]) -> Label:
    """A label on the side of its place given by an offset in points, to which its edge or a corner is turned."""
    x, y = offset
    look: dict[str, Any] = {
        "align": "left" if 2 * x > abs(y) else "right" if -2 * x > abs(y) else "center",
        "valign": "bottom" if y >= abs(x) > -y else "top" if -y >= abs(x) > y else "center",
    }
    return replace(label, offset=offset, **look)
