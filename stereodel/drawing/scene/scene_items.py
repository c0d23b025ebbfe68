"""Items of a scene, and their layout as page items with hidden parts removed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import Literal

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.constants import ON_BALL
from stereodel.drawing.page import Ball, Beziers, Dots, Fill, Item, Label, Stroke
from stereodel.drawing.page import style as styles
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.style import DotStyle, LineStyle
from stereodel.drawing.scene.space_curves import Curve, Segment, page_path
from stereodel.drawing.scene.visibility import (
    TOWARD,
    Place,
    SphereRegion,
    cut,
    lies_on_ball,
    limb,
    place_of,
    split_by_ball,
)
from stereodel.sphere.vectors import turned

BallStyle = Literal["solid", "glass", "none"]


class Layer(IntEnum):
    """Painter's order: later layers cover earlier ones; within a layer, items keep the order of their addition."""

    UNDER = 0  # lines seen through a sheet that lies below the ball
    GROUND = 1  # sheets that the ball covers
    BESIDE = 2  # lines outside the ball's disc
    FAR_TINT = 3
    FAR_LINE = 4
    FAR_DOT = 5
    INSIDE_SHEET = 6
    INSIDE_LINE = 7
    INSIDE_DOT = 8
    BALL = 9
    TINT = 10  # regions on the near side
    LINE = 11  # lines on the near side
    LIMB = 12
    FREE = 13  # lines in front of the ball
    DOT = 14
    SHEET = 15  # sheets that cover the ball
    OVER = 16  # lines on or above such a sheet
    OVER_DOT = 17
    LABEL = 18


Laid = tuple[Layer, Item]


@dataclass(frozen=True, eq=False)
class Layout:
    """Position of a scene on the page: view, ball, and planes of its sheets in view axes about the ball's centre."""

    matrix: FloatArray
    center: FloatArray
    radius: float
    style: BallStyle
    at: tuple[float, float]
    scale: float
    sheets: tuple[tuple[FloatArray, float, Layer], ...] = ()

    @property
    def origin(self) -> tuple[float, float]:
        """Page coordinates of the ball's centre."""
        x, y, _ = self.scale * turned(self.center, self.matrix)
        return (self.at[0] + float(x), self.at[1] + float(y))

    def axes(self, points: FloatArray) -> FloatArray:
        """Points (..., 3) of the scene in view axes about the ball's centre."""
        return turned(points - self.center, self.matrix)

    def on_page(self, points: FloatArray) -> FloatArray:
        """Page coordinates (..., 2) of points in view axes about the ball's centre."""
        return points[..., :2] * self.scale + np.array(self.origin)

    def path(self, curves: Iterable[Curve]) -> Beziers:
        """Page path of connected curves in view axes about the ball's centre."""
        return page_path(curves, self.origin, self.scale)

    def place(self, point: FloatArray) -> Place:
        """Place of a point in view axes; without a ball every point is in front."""
        return Place.FRONT if self.style == "none" else place_of(point, self.radius)

    @property
    def light(self) -> Ball:
        """The shading of the ball, for items on it."""
        return Ball(self.origin, self.scale * self.radius)

    def split(self, curves: Sequence[Curve]) -> list[list[tuple[Curve, Place]]]:
        """Curves in view axes, each cut by the ball."""
        if self.style == "none":
            return [[(curve, Place.FRONT)] for curve in curves]
        return split_by_ball(curves, self.radius)

    def beyond_sheets(self, point: FloatArray) -> Layer | None:
        """UNDER for a point below a sheet behind the ball, OVER for one on or above a sheet that covers the ball."""
        slack = ON_BALL * self.radius
        heights = [(float(np.sum(normal * point)) - level, layer) for normal, level, layer in self.sheets]
        if any(layer is Layer.GROUND and height < -slack for height, layer in heights):
            return Layer.UNDER
        return Layer.OVER if any(layer is Layer.SHEET and height >= -slack for height, layer in heights) else None


def laid_out(items: Sequence[SceneItem], layout: Layout) -> tuple[Item, ...]:
    """Page items of a scene, in painter's order."""
    planes = [item.plane(layout) for item in items if isinstance(item, SceneSheet)]
    layout = replace(layout, sheets=tuple(plane for plane in planes if plane[2] is not Layer.INSIDE_SHEET))
    laid = [part for item in items for part in item.lay(layout)]
    return tuple(item for _, item in sorted(laid, key=lambda pair: pair[0]))


@dataclass(frozen=True, eq=False)
class SceneLines:
    """Curves drawn as lines of one style."""

    curves: tuple[Curve, ...]
    style: LineStyle
    name: str
    layer: Layer | None = None

    def lay(self, layout: Layout) -> Iterator[Laid]:
        """Pieces in front unchanged, pieces behind fainter, or left out behind an opaque ball."""
        curves = [curve.moved(layout.matrix, layout.center) for curve in self.curves]
        for curve, pieces in zip(curves, layout.split(curves), strict=True):
            on_ball = layout.style != "none" and lies_on_ball(curve, layout.radius)
            for piece, place in pieces:
                if layout.style != "solid" or place not in (Place.BEHIND, Place.INSIDE):
                    yield from self._piece(piece, place, layout, on_ball=on_ball)

    def _piece(self, piece: Curve, place: Place, layout: Layout, *, on_ball: bool) -> Iterator[Laid]:
        style, own = (self.style.hidden, None) if place is Place.BEHIND else (self.style, self.layer)
        usual = {Place.OUTSIDE: Layer.BESIDE, Place.INSIDE: Layer.INSIDE_LINE, Place.BEHIND: Layer.FAR_LINE}
        usual[Place.FRONT] = Layer.LINE if on_ball else Layer.FREE
        slack = ON_BALL * layout.radius
        crossings = [piece.level_parameters(normal, level - slack) for normal, level, _ in layout.sheets]
        for part, beyond in cut(piece, np.unique(np.concatenate([np.zeros(0), *crossings])), layout.beyond_sheets):
            layer = next(layer for layer in (own, beyond, usual[place]) if layer is not None)
            yield layer, _stroke(layout.path([part]), style, self.name, closed=part.closed)


def _stroke(path: Beziers, style: LineStyle, name: str, *, closed: bool) -> Stroke:
    cap: Literal["round", "butt"] = "butt" if style.dash else "round"
    return Stroke(path, style.color, style.width, style.dash, cap, closed, name)


@dataclass(frozen=True, eq=False)
class SceneDots:
    """Dots at points of space."""

    points: FloatArray
    style: DotStyle
    name: str

    def lay(self, layout: Layout) -> Iterator[Laid]:
        """Dots whose centres are visible; on a glass ball hidden dots are fainter."""
        points = layout.axes(self.points)
        layers = np.array([self._layer(point, layout) for point in points], dtype=int)
        for layer in np.unique(layers[layers >= 0]):
            style = self.style.hidden if layer == Layer.FAR_DOT else self.style
            centers = layout.on_page(points[layers == layer])
            yield Layer(layer), Dots(centers, style.radius, style.color, style.rim, style.rim_width, self.name)

    def _layer(self, point: FloatArray, layout: Layout) -> int:
        place = layout.place(point)
        if place in (Place.BEHIND, Place.INSIDE):
            hidden = Layer.FAR_DOT if place is Place.BEHIND else Layer.INSIDE_DOT
            return -1 if layout.style == "solid" else hidden
        beyond = layout.beyond_sheets(point)
        return Layer.OVER_DOT if beyond is Layer.OVER else Layer.DOT if beyond is None else beyond


@dataclass(frozen=True, eq=False)
class SceneRegion:
    """A tinted region of the ball's surface."""

    region: SphereRegion
    color: Color
    name: str

    def lay(self, layout: Layout) -> Iterator[Laid]:
        """The part on the near side shaded, the part on the far side of a glass ball flat and faint."""
        region = self.region.turned(layout.matrix)
        near = region.visible_outline()
        if near:
            yield Layer.TINT, Fill(tuple(map(layout.path, near)), self.color, self.name, layout.light)
        far = region.far_side().visible_outline() if layout.style != "solid" else []
        if far:
            yield Layer.FAR_TINT, Fill(tuple(map(layout.path, far)), styles.fainter(self.color), self.name)


@dataclass(frozen=True, eq=False)
class SceneSheet:
    """A flat polygon, tinted; it does not cut the ball, or lies inside it."""

    corners: FloatArray
    color: Color
    name: str

    def plane(self, layout: Layout) -> tuple[FloatArray, float, Layer]:
        """Normal toward the viewer and level of the plane in view axes, and the polygon's layer."""
        corners = layout.axes(self.corners)
        normal = _newell(corners)
        normal = -normal if normal[2] < 0 else normal
        level = float(np.mean(np.sum(corners * normal, axis=-1)))
        limit = (1 - ON_BALL) * layout.radius
        if layout.style == "none" or level <= -limit:
            return normal, level, Layer.GROUND
        if level >= limit:
            return normal, level, Layer.SHEET
        if np.all(np.sqrt(np.sum(corners**2, axis=-1)) <= (1 + ON_BALL) * layout.radius):
            return normal, level, Layer.INSIDE_SHEET
        raise ValueError(  # no painter's order is correct
            f"the polygon {self.name!r} cuts the ball; give one that touches it, avoids it or is inside it"
        )

    def lay(self, layout: Layout) -> Iterator[Laid]:
        """The polygon as one fill; nothing if it is inside an opaque ball."""
        _, _, layer = self.plane(layout)
        if layer is Layer.INSIDE_SHEET and layout.style == "solid":
            return
        corners = layout.axes(self.corners)
        edges: list[Curve] = [Segment.between(a, b) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
        yield layer, Fill((layout.path(edges),), self.color, self.name)


@dataclass(frozen=True, eq=False)
class SceneBall:
    """The shaded ball and its outline."""

    color: Color
    outline: LineStyle

    def lay(self, layout: Layout) -> Iterator[Laid]:
        """Its near half, and the limb on top."""
        path = layout.path([limb(layout.radius)])
        yield Layer.BALL, Fill((path,), self.color, "ball", layout.light)
        yield Layer.LIMB, _stroke(path, self.outline, "limb", closed=True)


@dataclass(frozen=True, eq=False)
class SceneLabel:
    """Text at a point of space."""

    label: Label
    point: FloatArray
    always: bool

    def lay(self, layout: Layout) -> Iterator[Laid]:
        """The label at the point's image, unless the ball hides the point."""
        point = layout.axes(self.point)
        if self.always or layout.place(point) is not Place.BEHIND:
            x, y = layout.on_page(point)
            yield Layer.LABEL, replace(self.label, anchor=(float(x), float(y)))


SceneItem = SceneLines | SceneDots | SceneRegion | SceneSheet | SceneBall | SceneLabel
"""Its `lay` yields its visible parts as page items with their layers."""


def _newell(corners: FloatArray) -> FloatArray:
    """Unit normal of a flat polygon by Newell's method; TOWARD if the polygon has no area."""
    edges = corners - corners[0]
    normal = np.cross(edges, np.roll(edges, -1, axis=0)).sum(axis=0)
    length = float(np.sqrt(np.sum(normal**2)))
    return normal / length if length else TOWARD
