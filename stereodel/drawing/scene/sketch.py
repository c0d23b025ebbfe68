"""Drawings of the plane and cross-sections: the counterpart of `Scene` without depth.

Ticks and arrowheads are measured in points, so they are created with the page, when its scale is known.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_vectors
from stereodel.constants import STRAIGHT_ARC
from stereodel.curves.view import View
from stereodel.drawing.page import Beziers, Dots, Fill, Item, Label, Page, Stroke
from stereodel.drawing.page.colors import ColorLike, as_color
from stereodel.drawing.page.items import straight
from stereodel.drawing.page.style import PRINT_WIDTH, WHITE, DotStyle, LengthLike, LineStyle, as_length, dot, fill, line
from stereodel.drawing.scene.scene import Scene
from stereodel.drawing.scene.space_curves import CircleArc, page_path

Point = Sequence[float] | FloatArray

InPoints = Callable[[float], Iterable[Item]]
"""Creates items for a number of points per page unit."""

TICK: Final = 3.0
"""Length of a tick of an axis, and of each half of a tick of a dimension line, in points."""

GAP: Final = 3.0
"""Space between a line or tick and its label, in points."""

HEAD: Final = (6.0, 2.0)
"""Length and half width of an arrowhead, in points."""


class Sketch:
    """A drawing under construction.

    Every `add_…` method appends to the picture and returns the sketch, so calls can be chained. `name` selects the
    style of that name in `stereodel.drawing.page.style`, unless a `style` or `color` is given. It is also the id of the
    group in vector files.

    Examples
    --------
    >>> sketch = Sketch().add_circle((0, 0), 1, name="circle").add_segment((-1, 0), (1, 0), name="axis")
    >>> [item.name for item in sketch.page((-2, 2, -2, 2)).items]
    ['circle', 'axis']
    """

    def __init__(self) -> None:
        self._parts: list[Item | InPoints] = []
        self._views: list[FloatArray] = []

    def add_segment(self, a: Point, b: Point, *, name: str, style: LineStyle | None = None) -> Sketch:
        """A straight line from a to b."""
        return self._stroke(_run([a, b]), name, style)

    def add_segments(self, ends: npt.ArrayLike, *, name: str, style: LineStyle | None = None) -> Sketch:
        """Straight lines between the pairs of ends (k, 2, 2)."""
        for a, b in as_vectors(ends, 2, "ends"):
            self.add_segment(a, b, name=name, style=style)
        return self

    def add_edges(
        self, points: npt.ArrayLike, edges: npt.ArrayLike, *, name: str, style: LineStyle | None = None
    ) -> Sketch:
        """Straight lines between points (n, 2) by pairs of indices (e, 2)."""
        return self.add_segments(
            as_vectors(points, 2, "points")[np.asarray(edges, dtype=np.intp)], name=name, style=style
        )

    def add_polyline(
        self, points: npt.ArrayLike, *, name: str, style: LineStyle | None = None, closed: bool = False
    ) -> Sketch:
        """Straight lines from point to point (n, 2), and back to the first when `closed`."""
        corners = list(as_vectors(points, 2, "points"))
        return self._stroke(_run([*corners, corners[0]] if closed else corners), name, style, closed=closed)

    def add_circle(self, center: Point, radius: float, *, name: str, style: LineStyle | None = None) -> Sketch:
        """A whole circle."""
        return self._stroke(arc_path(center, radius, 0.0, 360.0), name, style, closed=True)

    def add_arc(
        self, center: Point, radius: float, start: float, stop: float, *, name: str, style: LineStyle | None = None
    ) -> Sketch:
        """The arc of a circle between two directions in degrees, counterclockwise from the x axis."""
        return self._stroke(arc_path(center, radius, start, stop), name, style)

    def add_graph(
        self,
        x: npt.ArrayLike,
        y: npt.ArrayLike,
        slope: npt.ArrayLike | None = None,
        *,
        name: str,
        style: LineStyle | None = None,
    ) -> Sketch:
        """The graph of a smooth function from values and derivatives (n,) at its knots, as cubic Hermite pieces.

        Without `slope` the derivatives are those of parabolas through three neighbouring knots, so there must be three.
        """
        across, up = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        if slope is None and len(across) < 3:
            raise ValueError(f"x has {len(across)} knots, but a parabola needs 3; give more of them, or slope=")
        steep = np.gradient(up, across, edge_order=2) if slope is None else np.asarray(slope, dtype=np.float64)
        knots, tangent = np.stack([across, up], axis=-1), np.stack([np.ones(len(across)), steep], axis=-1)
        third = np.diff(knots[:, :1], axis=0) / 3
        controls = [knots[:-1], knots[:-1] + third * tangent[:-1], knots[1:] - third * tangent[1:], knots[1:]]
        return self._stroke(np.stack(controls, axis=1), name, style)

    def add_polygon(self, corners: npt.ArrayLike, *, name: str, color: ColorLike | None = None) -> Sketch:
        """A filled region with straight sides (n, 2)."""
        points = list(as_vectors(corners, 2, "corners"))
        return self.add_items([Fill((_run([*points, points[0]]),), fill(name, color), name)])

    def add_disc(self, center: Point, radius: float, *, name: str, color: ColorLike | None = None) -> Sketch:
        """A filled disc."""
        return self.add_items([Fill((arc_path(center, radius, 0.0, 360.0),), fill(name, color), name)])

    def add_points(self, points: npt.ArrayLike, *, name: str, style: DotStyle | None = None) -> Sketch:
        """Dots at (n, 2) or (2,)."""
        drawn = dot(name, style)
        centers = np.atleast_2d(as_vectors(points, 2, "points"))
        return self.add_items([Dots(centers, drawn.radius, drawn.color, drawn.rim, drawn.rim_width, name)])

    def add_label(self, at: Point, text: str, offset: tuple[float, float] = (0.0, 0.0), **options: Any) -> Sketch:
        """Text at a point, shifted by `offset` points; `options` are passed to `Label`.

        Text between two dollar signs is a formula, unless `formulas` is false.
        """
        if "color" in options:
            options["color"] = as_color(options["color"])
        return self.add_items([Label(text, (float(at[0]), float(at[1])), offset, **options)])

    def add_angle(
        self,
        vertex: Point,
        a: Point,
        b: Point,
        radius: float,
        text: str,
        *,
        name: str,
        style: LineStyle | None = None,
        fill: ColorLike | None = None,
        gap: float = 8.0,
        **options: Any,
    ) -> Sketch:
        """The angle at a vertex, counterclockwise from the direction of a to that of b, with a label at the arc.

        The label, if given, is on the bisector, `gap` points outside the arc. `fill` tints the sector.
        """
        arms = np.array([a, b], dtype=np.float64) - np.asarray(vertex, dtype=np.float64)
        start, stop = np.degrees(np.arctan2(arms[:, 1], arms[:, 0]))
        stop += 360.0 * (stop < start)
        middle = np.radians((start + stop) / 2)
        outward = np.array([np.cos(middle), np.sin(middle)])
        place = np.asarray(vertex, dtype=np.float64) + radius * outward
        if fill is not None:
            arc = arc_path(vertex, radius, start, stop)
            sector = np.concatenate([arc, _run([arc[-1, -1], vertex, arc[0, 0]])])
            self.add_items([Fill((sector,), as_color(fill), name)])
        self.add_arc(vertex, radius, start, stop, name=name, style=style)
        if not text:
            return self
        return self.add_label(place, text, (gap * float(outward[0]), gap * float(outward[1])), **options)

    def add_dimension(
        self, a: Point, b: Point, text: str, *, name: str, style: LineStyle | None = None, **options: Any
    ) -> Sketch:
        """A dimension line from a to b, with a tick across each end and a label along it.

        The label, if given, is on the left of the direction from a to b, and never upside down; `options` are passed to
        `Label`. ValueError if a and b coincide.
        """
        first, last = (np.array(end, dtype=np.float64) for end in (a, b))
        ahead, left = _frame(first, last)
        self.add_segment(first, last, name=name, style=style)
        for end in (first, last):
            self._add_tick(end, left, name, style, both_ways=True)
        if not text:
            return self
        turn = float(np.degrees(np.arctan2(ahead[1], ahead[0])))
        upright = -90.0 < turn <= 90.0
        beside: dict[str, Any] = {"rotation": turn if upright else turn - np.copysign(180.0, turn)}
        beside["valign"] = "bottom" if upright else "top"
        offset = (GAP * float(left[0]), GAP * float(left[1]))
        return self.add_label((first + last) / 2, text, offset, **beside | options)

    def add_arrow(self, a: Point, b: Point, *, name: str, style: LineStyle | None = None) -> Sketch:
        """An arrow from a to b, whose head is filled; ValueError if they coincide."""
        drawn = line(name, style)
        tail, tip = (np.array(end, dtype=np.float64) for end in (a, b))
        ahead, left = _frame(tail, tip)

        def arrow(points_per_unit: float) -> list[Item]:
            length, half = (size / points_per_unit for size in HEAD)
            foot = tip - length * ahead
            head = _run([tip, foot + half * left, foot - half * left, tip])
            return [_line(_run([tail, foot]), name, drawn), Fill((head,), drawn.color, name)]

        self._parts.append(arrow)
        return self

    def add_axes(
        self,
        corner: Point,
        width: float,
        height: float,
        across: Mapping[float, str],
        up: Mapping[float, str],
        *,
        name: str,
        style: LineStyle | None = None,
        **options: Any,
    ) -> Sketch:
        """The axes of a graph: lines along the left and the lower side of a rectangle, with ticks and numbers.

        Parameters
        ----------
        corner, width, height : (float, float), float, float
            Lower left corner of the rectangle, and its size in page units.
        across, up : mapping of float to str
            Numbers and their texts, below and to the left of the rectangle. The smallest and the largest are at its
            corners. Further `options` of these are passed to `Label`.
        """
        origin = np.array(corner, dtype=np.float64)
        right, above = np.array([1.0, 0.0]), np.array([0.0, 1.0])
        self.add_polyline([origin + height * above, origin, origin + width * right], name=name, style=style)
        for foot, text in _spaced(origin, width * right, across):
            self._add_tick(foot, -above, name, style)
            self.add_label(foot, text, (0.0, -GAP - TICK), valign="top", **options)
        for foot, text in _spaced(origin, height * above, up):
            self._add_tick(foot, -right, name, style)
            self.add_label(foot, text, (-GAP - TICK, 0.0), align="right", **options)
        return self

    def add_scene(
        self, scene: Scene, view: View, *, at: tuple[float, float] = (0.0, 0.0), scale: float = 1.0
    ) -> Sketch:
        """A scene in a view, with the origin of space at a point and `scale` page units per unit."""
        self._views.append(view.matrix)
        return self.add_items(scene.layout(view, at=at, scale=scale))

    def add_items(self, items: Iterable[Item]) -> Sketch:
        """Page items, on top."""
        self._parts.extend(items)
        return self

    def page(
        self,
        extent: tuple[float, float, float, float],
        *,
        width: LengthLike = PRINT_WIDTH,
        background: ColorLike = WHITE,
    ) -> Page:
        """The page of the extent (left, right, bottom, top), `width` points or another length wide.

        ValueError if the extent has no area, the width is not positive, or a colour is invalid.
        """
        blank = Page(extent, (), as_length(width, "width"), as_color(background, "background"), tuple(self._views))
        scale = blank.points_per_unit
        items = [item for part in self._parts for item in (part(scale) if callable(part) else (part,))]
        return replace(blank, items=tuple(items))

    def _add_tick(
        self, at: FloatArray, way: FloatArray, name: str, style: LineStyle | None, *, both_ways: bool = False
    ) -> None:
        """A tick from a point in one direction, or in both."""

        def tick(points_per_unit: float) -> list[Item]:
            reach = TICK / points_per_unit * way
            return [_line(_run([at - both_ways * reach, at + reach]), name, style)]

        self._parts.append(tick)

    def _stroke(self, path: Beziers, name: str, style: LineStyle | None, *, closed: bool = False) -> Sketch:
        return self.add_items([_line(path, name, style, closed=closed)])


def _frame(a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit vectors from a to b, and to the left of that direction."""
    away = b - a
    length = float(np.hypot(*away))
    if length == 0:
        raise ValueError(f"a and b must be two points, got ({a[0]:g}, {a[1]:g}) twice")
    ahead = away / length
    return ahead, np.array([-ahead[1], ahead[0]])


def _spaced(origin: FloatArray, away: FloatArray, names: Mapping[float, str]) -> list[tuple[FloatArray, str]]:
    """Positions of labels on an axis, from the smallest number at the origin to the largest."""
    low, high = min(names), max(names)
    return [(origin + (number - low) / (high - low) * away, text) for number, text in names.items()]


def _line(path: Beziers, name: str, style: LineStyle | None, *, closed: bool = False) -> Stroke:
    drawn = line(name, style)
    return Stroke(path, drawn.color, drawn.width, drawn.dash, closed=closed, name=name)


def arc_path(center: Point, radius: float, start: float, stop: float) -> Beziers:
    """The arc of a circle of the page between two directions in degrees, counterclockwise, as cubic Béziers."""
    u, v = np.array([radius, 0.0, 0.0]), np.array([0.0, radius, 0.0])
    # Exactly 2π, so that the arc is recognised as closed.
    turn = 2 * np.pi if stop - start == 360.0 else np.radians(stop - start)
    first = float(np.radians(start))
    return page_path([CircleArc(np.zeros(3), u, v, first, first + turn)], (float(center[0]), float(center[1])), 1.0)


def arc_through(a: Point, middle: Point, b: Point) -> Beziers:
    """The arc of a circle of the page from a to b by way of a point between, straight where the three are on a line."""
    start, chord = complex(*a), complex(*b) - complex(*a)
    along = (complex(*middle) - start) / chord
    if abs(along.imag) < STRAIGHT_ARC:
        return _run([a, b])
    rise = (abs(along) ** 2 - along.real) / (2 * along.imag)  # of the centre above the middle of the chord
    center = start + chord * complex(0.5, rise)
    ends = (start, start + chord) if along.imag < 0 else (start + chord, start)
    first, last = (float(np.degrees(np.angle(end - center))) for end in ends)
    path = arc_path((center.real, center.imag), abs(start - center), first, last + 360.0 * (last < first))
    return path if along.imag < 0 else path[::-1, ::-1]


def _run(points: Sequence[Point]) -> Beziers:
    return straight(as_vectors([(point[0], point[1]) for point in points], 2, "points"))
