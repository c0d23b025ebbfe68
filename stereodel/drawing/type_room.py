"""Placing labels again on a page whose picture has been scaled relative to its type.

Labels above and below the picture are broken into lines and moved away from it, and the page grows. Labels in the
picture move aside as little as possible where they would overlap other labels, or lines or dots that they were clear
of; labels without room are left out, as on maps.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.drawing.label import GAP, halo_reach, label_box
from stereodel.drawing.page import Beziers, Dots, Fill, Item, Label, Page, Picture, Polygons, Polylines, Stroke

Box = tuple[float, float, float, float]
"""Left, right, bottom, top."""

LEADING: Final = 1.25
"""Line spacing of broken labels, in units of type size."""

GAP_OF_LINES: Final = 0.2
"""Least distance between titles or credits and their neighbours, in units of type size."""

EDGE: Final = 2.0
"""Space between labels and the edge of a page, in points."""

FARTHEST: Final = 1.5
"""Largest displacement of a label, in units of type size."""

STEPS: Final = 6
"""Directions of displacements."""

DIRECTIONS: Final = 16

CHORDS: Final = 8
"""Parameters at which cubics are sampled: chords of an eighth of a circle are off by a thousandth of its radius."""

OPPOSITE: Final[Mapping[str, Any]] = {
    "left": "right",
    "right": "left",
    "bottom": "top",
    "top": "bottom",
    "center": "center",
    "baseline": "top",
}
"""Alignments on the opposite side of an anchor."""

WORD: Final = re.compile(r"\S+")
WORD_OR_FORMULA: Final = re.compile(r"(?:\$[^$]*\$|\S)+")
"""Unbreakable parts: formulas may contain spaces."""


@dataclass(frozen=True)
class Clear:
    """What a label is clear of: lines, and dots, which unlike lines may not lie under its halo either."""

    lines: bool
    dots: bool


def clear_labels(page: Page) -> list[Clear]:
    """For each label of a page, what it is clear of."""
    setter = _Setter.of_picture(page.items, page.points_per_unit, page.extent[:2])
    return [Clear(not setter.crossed(label), not setter.dotted(label)) for label in page.labels]


def set_anew(
    items: Sequence[Item],
    extent: Box,
    points_per_unit: float,
    room: tuple[float, float],
    clear: Sequence[Clear],
) -> tuple[tuple[Item, ...], Box]:
    """Items whose labels have room, and the extent that they need.

    Parameters
    ----------
    items : sequence of Item
    extent : tuple of float
        Left, right, bottom and top of the original page, in page units.
    points_per_unit : float
        Scale of the page.
    room : (float, float)
        Left and right limits for labels, in page units.
    clear : sequence of Clear
        For each label, what to keep it clear of if possible.
    """
    unit = points_per_unit
    picture = [item for item in items if not isinstance(item, Label)]
    labels = [item for item in items if isinstance(item, Label)]
    ink, setter = _ink(picture, extent), _Setter.of_picture(picture, unit, room)
    kept = setter.within(
        [(label, free) for label, free in zip(labels, clear, strict=True) if ink[2] <= label.anchor[1] <= ink[3]]
    )
    taken = setter.boxes(kept)
    kept += setter.beyond([label for label in labels if label.anchor[1] > ink[3]], 1.0, unit * ink[3], taken)
    kept += setter.beyond([label for label in labels if label.anchor[1] < ink[2]], -1.0, unit * ink[2], taken)
    boxes = setter.boxes(kept)
    low = min(extent[2], float(np.min(boxes[:, 0, 1], initial=np.inf) - EDGE) / unit)
    high = max(extent[3], float(np.max(boxes[:, 1, 1], initial=-np.inf) + EDGE) / unit)
    # The picture stays centred.
    middle = (extent[0] + extent[1]) / 2
    aside = float(np.max(np.abs(boxes[:, :, 0] / unit - middle), initial=(extent[1] - extent[0]) / 2))
    return (*picture, *kept), (middle - aside, middle + aside, low, high)


@dataclass(frozen=True)
class _Setter:
    """Places labels at a scale, between two limits in page units.

    Lines are given by their chords (n, 2, 2), dots by boxes (m, 2, 2) in points.
    """

    unit: float
    room: tuple[float, float]
    chords: FloatArray
    dots: FloatArray

    @classmethod
    def of_picture(cls, items: Iterable[Item], unit: float, room: tuple[float, float]) -> _Setter:
        """For the lines and dots among some items."""
        picture = list(items)
        return cls(unit, room, _chords(picture), _dots(picture, unit))

    def box(self, label: Label) -> FloatArray:
        """Lower left and upper right corner of a label as rotated, in points."""
        pivot = self.unit * np.array(label.anchor) + np.array(label.offset)
        return pivot + _box_about_anchor(
            label.text, label.size, label.align, label.valign, label.rotation, label.font, label.formulas
        )

    def boxes(self, labels: Sequence[Label]) -> FloatArray:
        """Boxes of several labels, (n, 2, 2)."""
        return np.array([self.box(label) for label in labels]).reshape(-1, 2, 2)

    def crossed(self, label: Label) -> bool:
        """Whether a line crosses a label."""
        low, high = self.box(label) / self.unit
        (a, b), middle = (self.chords[:, 0], self.chords[:, 1]), (low + high) / 2
        near = ((np.maximum(a, b) > low) & (np.minimum(a, b) < high)).all(axis=1)
        along, to = b[near] - a[near], a[near] - middle
        # A chord that overlaps a box in both directions misses it if all corners are on one side of its line.
        reach = np.abs(along[:, ::-1]) @ ((high - low) / 2)
        return bool((np.abs(along[:, 0] * to[:, 1] - along[:, 1] * to[:, 0]) < reach).any())

    def dotted(self, label: Label) -> bool:
        """Whether a dot lies under a label, or partly under its halo."""
        low, high = self.box(label) + halo_reach(label)
        return bool(((self.dots[:, 0] < high) & (self.dots[:, 1] > low)).all(axis=1).any())

    def kept_clear(self, label: Label, clear: Clear) -> bool:
        """Whether a label is clear of what it is to be clear of."""
        return not (clear.dots and self.dotted(label)) and not (clear.lines and self.crossed(label))

    def within(self, labels: Iterable[tuple[Label, Clear]]) -> list[Label]:
        """Labels in the picture, in place or moved aside so that none overlap, without those that have no room.

        What each is to be kept clear of is waived if there is no such room.
        """
        kept: list[Label] = []
        for label, clear in labels:
            boxes = self.boxes(kept)
            tried = [place for place in map(self._held, _places(label)) if not _meet(self.box(place)[None], boxes)]
            kept += [next((place for place in tried if self.kept_clear(place, clear)), tried[0])] if tried else []
        return kept

    def beyond(self, labels: Sequence[Label], way: float, edge: float, taken: FloatArray) -> list[Label]:
        """Labels above (`way` 1) or below (-1) a picture that ends at `edge` points, broken into lines.

        Starting with the nearest, each moves away until it overlaps neither the picture, nor the boxes `taken`, nor
        other labels.
        """
        kept: list[Label] = []
        for label in sorted(labels, key=lambda label: way * label.anchor[1]):
            lines = [self._held(line) for line in self._broken(label, way)]
            boxes = self.boxes(lines)
            push = np.array([0.0, max(0.0, edge - boxes[:, 0, 1].min() if way > 0 else boxes[:, 1, 1].max() - edge)])
            around = boxes + GAP_OF_LINES * label.size * np.array([[0.0, -1.0], [0.0, 1.0]])
            while _meet(around + way * push, taken):
                push[1] += label.size / STEPS
            kept += [_moved(line, *(way * push)) for line in lines]
            taken = np.concatenate([taken, boxes + way * push])
        return kept

    def _held(self, label: Label) -> Label:
        """A label moved sideways into the limits, if it is not too wide."""
        box, left, right = self.box(label), self.unit * self.room[0] + EDGE, self.unit * self.room[1] - EDGE
        return _moved(label, max(min(0.0, right - box[1, 0]), left - box[0, 0]), 0.0)

    def _broken(self, label: Label, way: float) -> list[Label]:
        """The lines of a label, no wider than the limits; the last or first line keeps the label's position."""
        start = self.unit * label.anchor[0] + label.offset[0]
        left, right = self.unit * self.room[0] + EDGE, self.unit * self.room[1] - EDGE
        room = right - (start if label.align == "left" else left)
        if np.diff(self.box(label)[:, 0]) <= room:
            return [label]
        lines = [""]
        for word in (WORD_OR_FORMULA if label.formulas else WORD).findall(label.text):
            longer = f"{lines[-1]} {word}".lstrip()
            (start, _), (end, _) = self.box(replace(label, text=longer))
            lines = [*lines[:-1], longer] if not lines[-1] or end - start <= room else [*lines, word]
        first = len(lines) - 1 if way > 0 else 0
        drop = LEADING * label.size
        return [_moved(replace(label, text=line), 0.0, drop * (first - k)) for k, line in enumerate(lines)]


@lru_cache(maxsize=4096)
def _box_about_anchor(
    text: str, size: float, align: Any, valign: Any, rotation: float, font: tuple[str, ...], formulas: bool
) -> FloatArray:
    """Lower left and upper right corner of a label about its anchor, in points; cached, as measuring type is slow."""
    label = Label(text, (0.0, 0.0), (0.0, 0.0), align, valign, size, font=font, formulas=formulas)
    box = label_box(label, 1.0)
    corners = np.array([(x, y) for x in box[:, 0] for y in box[:, 1]])
    cos, sin = np.cos(np.radians(rotation)), np.sin(np.radians(rotation))
    turned = np.stack([cos * corners[:, 0] - sin * corners[:, 1], sin * corners[:, 0] + cos * corners[:, 1]], axis=1)
    found = np.stack([turned.min(axis=0), turned.max(axis=0)])
    found.flags.writeable = False
    return found


def _places(label: Label) -> Iterator[Label]:
    """Candidate positions of a label: in place, close by, on the other sides of its anchor, and farther away."""
    step = label.size * FARTHEST / STEPS
    turn = np.arange(DIRECTIONS) * (2 * np.pi / DIRECTIONS)
    yield label
    for ring in range(1, STEPS + 1):
        yield from (_moved(label, ring * step * np.cos(angle), ring * step * np.sin(angle)) for angle in turn)
        if ring == STEPS // 3:
            yield from _other_sides(label)


def _other_sides(label: Label) -> Iterator[Label]:
    """A label on the other sides of its anchor."""
    (x, y), align, valign = label.offset, OPPOSITE[label.align], OPPOSITE[label.valign]
    yield replace(label, offset=(-x, y), align=align)
    yield replace(label, offset=(x, -y), valign=valign)
    yield replace(label, offset=(-x, -y), align=align, valign=valign)


def _moved(label: Label, x: float, y: float) -> Label:
    """A label shifted by x and y points."""
    return replace(label, offset=(label.offset[0] + float(x), label.offset[1] + float(y)))


def _meet(boxes: FloatArray, others: FloatArray) -> bool:
    """Whether any of some boxes (n, 2, 2) is closer to any of others (m, 2, 2) than labels may be."""
    a, b = boxes[:, None], others[None]
    return bool(((a[..., 0, :] < b[..., 1, :] + GAP) & (b[..., 0, :] < a[..., 1, :] + GAP)).all(axis=-1).any())


def _chords(items: Iterable[Item]) -> FloatArray:
    """Chords (n, 2, 2) of all lines."""
    runs = []
    for item in items:
        if isinstance(item, Stroke):
            points = _flat(item.path)
            runs.append(np.stack([points[:-1], points[1:]], axis=1))
        elif isinstance(item, Polylines):
            chords = np.stack([item.points[:-1], item.points[1:]], axis=1)
            runs.append(np.delete(chords, item.offsets[1:-1] - 1, axis=0))
    return np.concatenate([np.zeros((0, 2, 2)), *runs])


def _dots(items: Iterable[Item], unit: float) -> FloatArray:
    """Lower left and upper right corners (n, 2, 2) of the boxes of all dots, in points."""
    dots = [item for item in items if isinstance(item, Dots)]
    corner = np.array([[-1.0], [1.0]])
    boxes = [unit * item.centers[:, None] + (item.radius + item.rim_width / 2) * corner for item in dots]
    return np.concatenate([np.zeros((0, 2, 2)), *boxes])


def _ink(picture: Sequence[Item], extent: Box) -> Box:
    """Left, right, bottom and top of the items other than labels, within the page; the page if there are none."""
    found = [points.reshape(-1, 2) for item in picture for points in _outlines(item)]
    low, high = np.array(extent[::2]), np.array(extent[1::2])
    if found:
        points = np.concatenate(found)
        low, high = np.clip(points.min(axis=0), low, high), np.clip(points.max(axis=0), low, high)
    return (float(low[0]), float(high[0]), float(low[1]), float(high[1]))


def _flat(path: Beziers) -> FloatArray:
    """Points along a run, (m, 2)."""
    s = np.arange(CHORDS)[None, :, None] / CHORDS
    p0, p1, p2, p3 = (path[:, i, None] for i in range(4))
    points = (1 - s) ** 3 * p0 + 3 * s * (1 - s) ** 2 * p1 + 3 * s**2 * (1 - s) * p2 + s**3 * p3
    return np.concatenate([points.reshape(-1, 2), path[-1:, 3]])


def _outlines(item: Item) -> Sequence[FloatArray]:
    """Points between which an item lies."""
    match item:
        case Stroke():
            return (item.path,)
        case Fill():
            return item.paths
        case Picture():
            return item.outline
        case Dots():
            return (item.centers,)
        case Polylines() | Polygons():
            return (item.points,)
        case Label():
            return ()
