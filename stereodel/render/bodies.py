"""Items of a scene as complete bodies in space, whether visible or not."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.drawing.page.colors import Color
from stereodel.drawing.scene.scene_items import (
    Layer,
    Layout,
    SceneBall,
    SceneDots,
    SceneItem,
    SceneLabel,
    SceneLines,
    SceneRegion,
    SceneSheet,
)
from stereodel.drawing.scene.solid import PlacedScene
from stereodel.drawing.scene.visibility import lies_on_ball
from stereodel.render.surfaces import (
    CURVE_ERROR,
    DOT_LEVEL,
    Surface,
    ball,
    ball_level,
    dashed,
    patch,
    polygon,
    tube,
)
from stereodel.sphere.vectors import turned

BALL_POINTS: Final = 0.1
"""Largest distance of a ball from its triangles, in points on the page, so that even thin lines do not sink in."""

ROUGHNESS: Final = 0.65
"""Roughness of all glTF materials, from 0 (mirror) to 1: a soft sheen without reflections of lamps."""


@dataclass(frozen=True, eq=False)
class Body:
    """Copies of a surface in one colour.

    layer: position in painter's order, for transparent bodies.
    places: (k, 4), centre and scale of each copy in the scene's space; by default one unscaled copy.
    """

    name: str
    color: Color
    layer: Layer
    surface: Surface
    places: FloatArray | None = None

    @property
    def poses(self) -> FloatArray:
        """Transformation of each copy in the scene's space, (k, 4, 4)."""
        places = np.array([[0.0, 0.0, 0.0, 1.0]]) if self.places is None else self.places
        poses = places[:, 3, None, None] * np.eye(4)
        poses[:, :3, 3], poses[:, 3, 3] = places[:, :3], 1.0
        return poses


def bodies_of(placed: PlacedScene, points_per_unit: float) -> Iterator[Body]:
    """The bodies of a scene in its own space, in the order in which they were added; lines are as thick as on the page.

    Lines on the ball lie `CURVE_ERROR` radii above those with the preceding name: chords of the same arc may be that
    far apart, and later names cover earlier ones, as on the page. Regions lie above all triangles of the ball, each
    above its predecessors.
    """
    layout, point = placed.layout, 1 / (points_per_unit * placed.layout.scale)
    level = ball_level(BALL_POINTS * point / layout.radius)
    names = dict.fromkeys(item.name for item in placed.items if isinstance(item, SceneLines))
    heights = {name: 1 + CURVE_ERROR * number for number, name in enumerate(names)}
    above = 1.0
    for item in placed.items:
        match item:
            case SceneBall():
                yield Body("ball", item.color, Layer.BALL, ball(level), _sphere(layout, 1.0))
            case SceneLines():
                yield from _tubes(item, layout, point, heights[item.name])
            case SceneDots() if len(item.points):
                radius = np.full((len(item.points), 1), point * (item.style.radius - item.style.rim_width))
                yield Body(item.name, item.style.color, Layer.DOT, ball(DOT_LEVEL), np.hstack([item.points, radius]))
            case SceneRegion():
                surface = patch(item.region, level)
                above /= 1 - surface.depth
                yield Body(item.name, item.color, Layer.TINT, surface, _sphere(layout, above))
            case SceneSheet():
                normal, _, layer = item.plane(layout)
                toward = turned(normal, layout.matrix.T)
                surface = polygon(item.corners, toward)
                if len(surface.faces):
                    yield Body(item.name, item.color, layer, surface)


def marks_of(items: tuple[SceneItem, ...]) -> list[SceneLabel]:
    """The labels of a scene."""
    return [item for item in items if isinstance(item, SceneLabel)]


def _sphere(layout: Layout, factor: float) -> FloatArray:
    """Centre and radius of the ball, enlarged by a factor."""
    return np.array([[*layout.center, factor * layout.radius]])


def _tubes(item: SceneLines, layout: Layout, point: float, above: float) -> Iterator[Body]:
    curves = [
        curve.moved(above * np.eye(3), layout.center - layout.center / above)
        if layout.style != "none" and lies_on_ball(curve.moved(np.eye(3), layout.center), layout.radius)
        else curve
        for curve in item.curves
    ]
    dash = item.style.dash
    if dash:
        curves = [piece for curve in curves for piece in dashed(curve, dash[0] * point, dash[1] * point)]
    radius, error = item.style.width * point / 2, CURVE_ERROR * layout.radius
    tubes = [made for curve in curves if (made := tube(curve, radius, error)) is not None]
    if tubes:
        yield Body(item.name, item.style.color, Layer.LINE, Surface.joined(tubes))
