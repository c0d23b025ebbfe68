"""Drawings of the plane and cross-sections: what `Scene` is for the globe, without depth.

A `Sketch` collects segments, circles, arcs, regions, dots, graphs and labels in the order in which they are painted and
hands them out as the items of a `Page`. Coordinates are the page's own (x right, y up).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_vectors
from stereodel.drawing.colors import ColorLike, as_color
from stereodel.drawing.page import Beziers, Dots, Fill, Item, Label, Page, Stroke
from stereodel.drawing.space_curves import CircleArc, Segment, page_path
from stereodel.drawing.style import PRINT_WIDTH, WHITE, DotStyle, LineStyle, dot, fill, line

Point = Sequence[float] | FloatArray


class Sketch:
    """A drawing under construction.

    Every `add_…` method appends to the picture and returns the sketch, so that calls chain. `name` says what is added:
    it has the style of that name in `stereodel.drawing.style`, unless another `style` or `color` is given, and is the
    id of its group in vector files.

    Examples
    --------
    >>> sketch = Sketch().add_circle((0, 0), 1, name="circle").add_segment((-1, 0), (1, 0), name="axis")
    >>> [item.name for item in sketch.page((-2, 2, -2, 2)).items]
    ['circle', 'axis']
    """

    def __init__(self) -> None:
        self._items: list[Item] = []

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
        self, x: npt.ArrayLike, y: npt.ArrayLike, slope: npt.ArrayLike, *, name: str, style: LineStyle | None = None
    ) -> Sketch:
        """The graph of a smooth function by values and derivatives (n,) at its knots, as cubic Hermite pieces."""
        knots = np.stack([np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)], axis=-1)
        third = np.diff(knots[:, :1], axis=0) / 3
        tangent = np.stack([np.ones(len(knots)), np.asarray(slope, dtype=np.float64)], axis=-1)
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
        """Text at a point, moved by `offset` points; `options` go to `Label`."""
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
        gap: float = 8.0,
        **options: Any,
    ) -> Sketch:
        """The angle at a vertex, from the direction of a counterclockwise to that of b, with its name beside the arc.

        The name stands on the bisector, `gap` points outside the arc.
        """
        arms = np.array([a, b], dtype=np.float64) - np.asarray(vertex, dtype=np.float64)
        start, stop = np.degrees(np.arctan2(arms[:, 1], arms[:, 0]))
        stop += 360.0 * (stop < start)
        middle = np.radians((start + stop) / 2)
        outward = np.array([np.cos(middle), np.sin(middle)])
        place = np.asarray(vertex, dtype=np.float64) + radius * outward
        self.add_arc(vertex, radius, start, stop, name=name, style=style)
        return self.add_label(place, text, (gap * float(outward[0]), gap * float(outward[1])), **options)

    def add_items(self, items: Iterable[Item]) -> Sketch:
        """Finished items, on top."""
        self._items.extend(items)
        return self

    def page(
        self,
        extent: tuple[float, float, float, float],
        *,
        width: float = PRINT_WIDTH,
        background: ColorLike = WHITE,
    ) -> Page:
        """The picture of (left, right, bottom, top), `width` points wide.

        Raises
        ------
        ValueError
            For an extent without area, a width that is not positive and what is no colour.
        """
        return Page(extent, tuple(self._items), width, as_color(background, "background"))

    def _stroke(self, path: Beziers, name: str, style: LineStyle | None, *, closed: bool = False) -> Sketch:
        drawn = line(name, style)
        return self.add_items([Stroke(path, drawn.color, drawn.width, drawn.dash, closed=closed, name=name)])


def arc_path(center: Point, radius: float, start: float, stop: float) -> Beziers:
    """The arc of a circle of the page between two directions in degrees, counterclockwise, as cubic Béziers."""
    u, v = np.array([radius, 0.0, 0.0]), np.array([0.0, radius, 0.0])
    # Exactly 2π, so that the arc knows that it is closed.
    turn = 2 * np.pi if stop - start == 360.0 else np.radians(stop - start)
    first = float(np.radians(start))
    return page_path([CircleArc(np.zeros(3), u, v, first, first + turn)], (float(center[0]), float(center[1])), 1.0)


def _run(points: Sequence[Point]) -> Beziers:
    corners = [np.array([point[0], point[1], 0.0]) for point in points]
    pieces = [Segment.between(a, b) for a, b in pairwise(corners)]
    return page_path(pieces, (0.0, 0.0), 1.0)
