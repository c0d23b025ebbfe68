"""Items of a scene as complete bodies in space, whether visible or not, and scenes of them by trimesh."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import optional
from stereodel.drawing.page import colors
from stereodel.drawing.page.colors import Color
from stereodel.drawing.scene.scene_items import (
    Layer,
    Layout,
    SceneBall,
    SceneDots,
    SceneLabel,
    SceneLines,
    SceneRegion,
    SceneSheet,
)
from stereodel.drawing.scene.solid import PlacedScene, Solid
from stereodel.drawing.scene.visibility import lies_on_ball
from stereodel.render.space import surfaces
from stereodel.render.space.surfaces import CURVE_ERROR, TriangleMesh
from stereodel.sphere.vectors import turned

ROUGHNESS: Final = 0.65
"""Roughness of all glTF materials, from 0 (mirror) to 1: a soft sheen without reflections of lamps."""


@dataclass(frozen=True, eq=False)
class Body:
    """Copies of a surface in one colour.

    layer: position in painter's order, for transparent bodies.
    places: (k, 4), centre and scale of each copy in the scene's space.
    """

    name: str
    color: Color
    layer: Layer
    surface: TriangleMesh
    places: FloatArray

    @property
    def poses(self) -> FloatArray:
        """Transformation of each copy in the scene's space, (k, 4, 4)."""
        poses = self.places[:, 3, None, None] * np.eye(4)
        poses[:, :3, 3], poses[:, 3, 3] = self.places[:, :3], 1.0
        return poses


UNMOVED: Final = np.array([[0.0, 0.0, 0.0, 1.0]])
"""One unscaled copy."""


def bodies_of(placed: PlacedScene, points_per_unit: float) -> Iterator[Body]:
    """The bodies of a scene in its own space, in the order in which they were added; lines are as thick as on the page.

    Lines on the ball lie `CURVE_ERROR` radii above those with the preceding name: chords of the same arc may be that
    far apart, and later names cover earlier ones, as on the page. Regions lie above all triangles of the ball, each
    above its predecessors.
    """
    layout, point = placed.layout, 1 / (points_per_unit * placed.layout.scale)
    # Triangles of a ball are within a tenth of a point, so that even thin lines do not sink in.
    levels, near = surfaces.BALL_LEVELS, 0.1 * point / layout.radius
    level = next((level for level in levels if surfaces.ball(level).depth <= near), levels[-1])
    names = dict.fromkeys(item.name for item in placed.items if isinstance(item, SceneLines))
    heights = {name: 1 + CURVE_ERROR * number for number, name in enumerate(names)}
    above = 1.0
    for item in placed.items:
        match item:
            case SceneBall():
                yield Body("ball", item.color, Layer.BALL, surfaces.ball(level), _sphere(layout, 1.0))
            case SceneLines():
                yield from _tubes(item, layout, point, heights[item.name])
            case SceneDots() if len(item.points):
                radius = np.full((len(item.points), 1), point * (item.style.radius - item.style.rim_width))
                places = np.hstack([item.points, radius])
                yield Body(item.name, item.style.color, Layer.DOT, surfaces.ball(surfaces.DOT_LEVEL), places)
            case SceneRegion():
                surface = surfaces.patch(item.region, level)
                above /= 1 - surface.depth
                yield Body(item.name, item.color, Layer.TINT, surface, _sphere(layout, above))
            case SceneSheet():
                normal, _, layer = item.plane(layout)
                surface = surfaces.polygon(item.corners, turned(normal, layout.matrix.T))
                if len(surface.faces):
                    yield Body(item.name, item.color, layer, surface, UNMOVED)


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
        curves = [piece for curve in curves for piece in surfaces.dashed(curve, dash[0] * point, dash[1] * point)]
    radius, error = item.style.width * point / 2, CURVE_ERROR * layout.radius
    tubes = [made for curve in curves if (made := surfaces.tube(curve, radius, error)) is not None]
    if tubes:
        yield Body(item.name, item.style.color, Layer.LINE, TriangleMesh.joined(tubes), UNMOVED)


def linear(color: Color) -> list[float]:
    """An sRGB colour in linear light (IEC 61966-2-1); opacity is unchanged."""
    return [*colors.linear(color[:3]).tolist(), float(color[3])]


def to_trimesh(solid: Solid) -> Any:
    """Implementation of `Solid.to_trimesh`: unique names, and equal meshes once."""
    trimesh = optional("trimesh", "render")
    scene: Any = trimesh.Scene()
    base: str = scene.graph.base_frame
    taken, meshes = {base}, dict[tuple[str, Color, bytes, bytes], str]()

    def node(name: str, above: str, pose: FloatArray, **more: Any) -> str:
        free = _free(name, taken)
        taken.add(free)
        scene.graph.update(free, above, matrix=pose, **more)
        return free

    for number, placed in enumerate(solid.scenes, start=1):
        root = node("scene" if len(solid.scenes) == 1 else f"scene {number}", base, placed.pose)
        for body in bodies_of(placed, solid.page.points_per_unit):
            key = (body.name, body.color, body.surface.points.tobytes(), body.surface.faces.tobytes())
            if key not in meshes:
                meshes[key] = _free(body.name, scene.geometry)
                scene.geometry[meshes[key]] = _mesh(trimesh, body, meshes[key])
            if len(body.places) == 1:
                node(body.name, root, body.poses[0], geometry=meshes[key])
                continue
            group = node(body.name, root, np.eye(4))
            for copy, pose in enumerate(body.poses):
                node(f"{group}[{copy}]", group, pose, geometry=meshes[key])
        for mark in (item for item in placed.items if isinstance(item, SceneLabel)):
            pose = np.eye(4)
            pose[:3, 3] = mark.point
            about = {"text": mark.label.text, "size": mark.label.size, "offset": list(mark.label.offset)}
            node(f"label {mark.label.text}", root, pose, metadata=about)
    return scene


def _mesh(trimesh: Any, body: Body, name: str) -> Any:
    see_through = body.color[3] < 1
    material = trimesh.visual.material.PBRMaterial(
        name=name,
        baseColorFactor=linear(body.color),
        metallicFactor=0.0,
        roughnessFactor=ROUGHNESS,
        alphaMode="BLEND" if see_through else "OPAQUE",
        # A ball is seen from outside; through a glass ball, regions and sheets are seen from inside.
        doubleSided=see_through and body.layer is not Layer.BALL,
    )
    return trimesh.Trimesh(
        body.surface.points,
        body.surface.faces,
        vertex_normals=body.surface.normals,
        process=False,
        visual=trimesh.visual.TextureVisuals(material=material),
        metadata={"color": list(body.color), "layer": int(body.layer)},
    )


def _free(name: str, taken: Any) -> str:
    number, free = 1, name
    while free in taken:
        number += 1
        free = f"{name} {number}"
    return free
