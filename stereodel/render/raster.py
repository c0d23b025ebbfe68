"""A page as triangles for OpenGL: every item but labels, in painter's order."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.drawing.colors import Color
from stereodel.drawing.page import (
    Ball,
    Beziers,
    Dots,
    Fill,
    Item,
    Mosaic,
    Page,
    Patch,
    Picture,
    Polylines,
    Stroke,
)
from stereodel.render.pieces import Piece, Pieces
from stereodel.render.ribbons import Corners, discs, flatten, region, ribbon, ribbons
from stereodel.render.triangles import Pixels, Window

LIGHT: Final = np.array([-0.35, 0.45, 0.82]) / np.linalg.norm([-0.35, 0.45, 0.82])
"""Direction toward the light in view axes: from the upper left, in front."""

SHADE: Final = 0.36
"""How much darker a surface is that is turned away from the light."""


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
            case Patch():
                return [self._patch(item)]
            case Fill():
                return [self._lit_by(item.ball, region(self._outlines(item.paths)), item.color)]
            case Dots():
                return self._dots(item)
            case Mosaic():
                return [self._mosaic(item)]
            case Picture():
                return [self._picture(item)]
        return []

    def _place(self, points: FloatArray) -> FloatArray:
        placed: FloatArray = (points - self.origin) * self.scale
        return placed

    def _lit_by(self, ball: Ball | None, corners: Corners, color: Color) -> Piece:
        if ball is None:
            return _flat(corners, color)
        (x, y), (across, up) = self._place(np.array(ball.center)).tolist(), (ball.radius * self.scale).tolist()
        return Piece(corners, np.broadcast_to(color, (len(corners), 3, 4)), ball=(x, y, across, up))

    def _outlines(self, paths: tuple[Beziers, ...]) -> list[FloatArray]:
        return [flatten(self._place(path)) for path in paths]

    def _stroke(self, stroke: Stroke) -> Corners:
        points = flatten(self._place(stroke.path))
        dash = stroke.dash and (stroke.dash[0] * self.pixels_per_point, stroke.dash[1] * self.pixels_per_point)
        width = stroke.width * self.pixels_per_point
        return ribbon(points, width, closed=stroke.closed, round_caps=stroke.cap == "round", dash=dash or None)

    def _polylines(self, lines: Polylines) -> Corners:
        return ribbons(self._place(lines.points), lines.offsets, lines.width * self.pixels_per_point)

    def _patch(self, patch: Patch) -> Piece:
        corners = self._place(patch.points)[patch.faces]
        if patch.normals is None:
            return _flat(corners, patch.color)
        colors = np.repeat([patch.color], len(patch.points), axis=0)
        colors[:, :3] *= _brightness(patch.normals)[:, None]
        return Piece(corners, colors[patch.faces])

    def _dots(self, dots: Dots) -> list[Piece]:
        centers = self._place(dots.centers)
        inner, outer = (r * self.pixels_per_point for r in (dots.radius - dots.rim_width, dots.radius))
        pieces = [_flat(discs(centers, inner), dots.color)]
        if dots.rim_width:
            pieces.append(_flat(discs(centers, outer), dots.rim))
        return pieces

    def _mosaic(self, mosaic: Mosaic) -> Piece:
        colors = np.ones((len(mosaic.corners), 3, 4))
        colors[..., :3] = mosaic.colors[:, None]
        if mosaic.normals is not None:
            colors[..., :3] *= _brightness(mosaic.normals)[..., None]
        return Piece(self._place(mosaic.corners), colors)

    def _picture(self, picture: Picture) -> Piece:
        width, height = 1 / self.scale

        def texture(window: Window) -> Pixels:
            left, bottom = self.origin + np.array([window.left, window.bottom]) / self.scale
            place = (left, bottom + window.height * height, width, height)
            return picture.painter.paint(place, (window.width, window.height))

        return replace(_flat(region(self._outlines(picture.outline)), (1.0, 1.0, 1.0, 1.0)), texture=texture)


def _brightness(normals: FloatArray) -> FloatArray:
    """Smooth from the lit point to the opposite one: Lambert's law would show its terminator as an edge."""
    brightness: FloatArray = 1 - SHADE * ((1 - normals @ LIGHT) / 2) ** 2
    return brightness


def _flat(corners: Corners, color: Color) -> Piece:
    # Levels of 1/255, rounded half up, so that rounding inside OpenGL has nothing to decide.
    levels = np.floor(255 * np.array(color) + 0.5) / 255
    return Piece(corners, np.broadcast_to(levels, (len(corners), 3, 4)))
