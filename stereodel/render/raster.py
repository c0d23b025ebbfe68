"""A page as triangles for OpenGL: every item but labels, in painter's order."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from stereodel._arrays import FloatArray, Pixels
from stereodel.curves.fill import triangles
from stereodel.curves.ragged import Ragged
from stereodel.drawing.colors import Color
from stereodel.drawing.page import (
    Ball,
    Beziers,
    Dots,
    Fill,
    Item,
    Page,
    Picture,
    Polygons,
    Polylines,
    Stroke,
)
from stereodel.render.pieces import Piece, Pieces
from stereodel.render.ribbons import Corners, discs, flatten, region, ribbon, ribbons
from stereodel.render.triangles import Disc, Window


def triangulate(page: Page, width: int, height: int) -> Pieces:
    """Everything on a page but its labels as triangles of a picture of `width` by `height` pixels."""
    left, right, bottom, top = page.extent
    scale = np.array([width / (right - left), height / (top - bottom)])
    canvas = _Canvas(np.array([left, bottom]), scale, width / page.width)
    return Pieces((number, piece) for number, item in enumerate(page.items) for piece in canvas.pieces(item))


@dataclass(frozen=True, eq=False)
class _Canvas:
    """Where page coordinates and points lie in a picture."""

    origin: FloatArray
    scale: FloatArray
    pixels_per_point: float

    def pieces(self, item: Item) -> list[Piece]:
        """What an item is made of; where pieces overlap, the first is seen."""
        match item:
            case Stroke():
                return [_flat(self._stroke(item), item.color)]
            case Polylines():
                return [_flat(self._polylines(item), item.color)]
            case Polygons():
                return [self._polygons(item)]
            case Fill():
                return [_colored(region(self._outlines(item.paths)), np.array(item.color), self._disc(item.ball))]
            case Dots():
                return self._dots(item)
            case Picture():
                return [self._picture(item)]
        return []

    def _place(self, points: FloatArray) -> FloatArray:
        placed: FloatArray = (points - self.origin) * self.scale
        return placed

    def _disc(self, ball: Ball | None) -> Disc | None:
        if ball is None:
            return None
        (x, y), (across, up) = self._place(np.array(ball.center)).tolist(), (ball.radius * self.scale).tolist()
        return x, y, across, up

    def _outlines(self, paths: tuple[Beziers, ...]) -> list[FloatArray]:
        return [flatten(self._place(path)) for path in paths]

    def _stroke(self, stroke: Stroke) -> Corners:
        points = flatten(self._place(stroke.path))
        dash = stroke.dash and (stroke.dash[0] * self.pixels_per_point, stroke.dash[1] * self.pixels_per_point)
        width = stroke.width * self.pixels_per_point
        return ribbon(points, width, closed=stroke.closed, round_caps=stroke.cap == "round", dash=dash or None)

    def _polylines(self, lines: Polylines) -> Corners:
        return ribbons(self._place(lines.points), lines.offsets, lines.width * self.pixels_per_point)

    def _polygons(self, polygons: Polygons) -> Piece:
        loops = Ragged(self._place(polygons.points), polygons.offsets)
        corners, owner = triangles(loops, polygons.owner)
        return _colored(corners, polygons.colors[owner, None], self._disc(polygons.ball))

    def _dots(self, dots: Dots) -> list[Piece]:
        centers = self._place(dots.centers)
        inner, outer = (r * self.pixels_per_point for r in (dots.radius - dots.rim_width, dots.radius))
        pieces = [_flat(discs(centers, inner), dots.color)]
        if dots.rim_width:
            pieces.append(_flat(discs(centers, outer), dots.rim))
        return pieces

    def _picture(self, picture: Picture) -> Piece:
        width, height = 1 / self.scale

        def texture(window: Window) -> Pixels:
            left, bottom = self.origin + np.array([window.left, window.bottom]) / self.scale
            place = (left, bottom + window.height * height, width, height)
            return picture.painter.paint(place, (window.width, window.height))

        return replace(_flat(region(self._outlines(picture.outline)), (1.0, 1.0, 1.0, 1.0)), texture=texture)


def _flat(corners: Corners, color: Color) -> Piece:
    return _colored(corners, np.array(color), None)


def _colored(corners: Corners, colors: FloatArray, ball: Disc | None) -> Piece:
    """Triangles in colours that spread to their corners (n, 3, 4)."""
    if ball is None:
        # Levels of 1/255, rounded half up, so that rounding inside OpenGL has nothing to decide.
        colors = np.floor(255 * colors + 0.5) / 255
    return Piece(corners, np.broadcast_to(colors, (len(corners), 3, 4)), ball=ball)
