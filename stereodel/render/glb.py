"""Scenes in space as scenes of trimesh, and as glTF 2.0 in its binary form, GLB.

trimesh writes the file. Details that it leaves open are set beforehand: short indices where they suffice, the targets
of buffers, colours that are not rounded to 1/255 of linear light, the camera of the page, and the generator.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import of_extra
from stereodel.drawing.page import colors
from stereodel.drawing.page.colors import Color
from stereodel.drawing.scene.scene_items import Layer
from stereodel.drawing.scene.solid import PlacedScene, Solid
from stereodel.render.bodies import ROUGHNESS, Body, bodies_of, marks_of

CAMERA: Final = "page"
"""Name of the camera that shows what the page shows."""

SPACE: Final = 1.0
"""Page units between the camera and the scene, and behind the scene."""

SHORT: Final = 2**16 - 1
"""Number of points that two bytes can index; the last value is reserved."""

UNSIGNED_SHORT: Final = 5123
STRIDE: Final = 12
"""Size in bytes of a point or normal: three single-precision numbers."""

VERTICES: Final = 34962
INDICES: Final = 34963
"""Constants of the glTF specification: a component type and buffer targets."""


def linear(color: Color) -> list[float]:
    """An sRGB colour in linear light (IEC 61966-2-1); opacity is unchanged.

    >>> [round(part, 6) for part in linear((1.0, 0.5, 0.0, 0.25))]
    [1.0, 0.214041, 0.0, 0.25]
    """
    return [*colors.linear(color[:3]).tolist(), float(color[3])]


def to_trimesh(solid: Solid) -> Any:
    """Implementation of `Solid.to_trimesh`."""
    with of_extra("render"):
        import trimesh

    scene = trimesh.Scene()
    builder = _Builder(trimesh, scene)
    for number, placed in enumerate(solid.scenes, start=1):
        builder.add(placed, solid.page.points_per_unit, "scene" if len(solid.scenes) == 1 else f"scene {number}")
    return scene


class _Builder:
    """Builder of a trimesh scene with unique names and shared meshes."""

    def __init__(self, trimesh: Any, scene: Any) -> None:
        self._trimesh, self._scene = trimesh, scene
        self._taken = {scene.graph.base_frame}
        self._meshes: dict[tuple[str, Color, bytes, bytes], str] = {}

    def add(self, placed: PlacedScene, points_per_unit: float, name: str) -> None:
        """Add a scene below a node that places it."""
        above = self._node(name, self._scene.graph.base_frame, placed.pose)
        for body in bodies_of(placed, points_per_unit):
            mesh, poses = self._mesh(body), body.poses
            if len(poses) == 1:
                self._node(body.name, above, poses[0], geometry=mesh)
                continue
            group = self._node(body.name, above, np.eye(4))
            for number, pose in enumerate(poses):
                self._node(f"{group}[{number}]", group, pose, geometry=mesh)
        for mark in marks_of(placed.items):
            pose = np.eye(4)
            pose[:3, 3] = mark.point
            about = {"text": mark.label.text, "size": mark.label.size, "offset": list(mark.label.offset)}
            self._node(f"label {mark.label.text}", above, pose, metadata=about)

    def _node(self, name: str, above: str, pose: FloatArray, **more: Any) -> str:
        free = self._free(name, self._taken)
        self._taken.add(free)
        self._scene.graph.update(free, above, matrix=pose, **more)
        return free

    def _mesh(self, body: Body) -> str:
        surface = body.surface
        key = (body.name, body.color, surface.points.tobytes(), surface.faces.tobytes())
        if key not in self._meshes:
            name = self._free(body.name, self._scene.geometry)
            self._meshes[key] = name
            self._scene.geometry[name] = self._trimesh.Trimesh(
                surface.points,
                surface.faces,
                vertex_normals=surface.normals,
                process=False,
                visual=self._trimesh.visual.TextureVisuals(material=self._material(body, name)),
                metadata={"color": list(body.color), "layer": int(body.layer)},
            )
        return self._meshes[key]

    def _material(self, body: Body, name: str) -> Any:
        return self._trimesh.visual.material.PBRMaterial(
            name=name,
            baseColorFactor=linear(body.color),
            metallicFactor=0.0,
            roughnessFactor=ROUGHNESS,
            alphaMode="BLEND" if body.color[3] < 1 else "OPAQUE",
            # A ball is seen from outside; through a glass ball, regions and sheets are seen from inside.
            doubleSided=body.color[3] < 1 and body.layer is not Layer.BALL,
        )

    @staticmethod
    def _free(name: str, taken: Any) -> str:
        number, free = 1, name
        while free in taken:
            number += 1
            free = f"{name} {number}"
        return free


def glb_bytes(solid: Solid) -> bytes:
    """The bytes of a GLB file, which are the same for the same picture."""
    scene = to_trimesh(solid)
    if not scene.geometry:
        raise ValueError("scenes hold no body, and a GLB must; add a ball, lines, dots or regions")

    def finished(tree: dict[str, Any]) -> None:
        tree["asset"]["generator"] = "stereodel"
        for mesh in tree.get("meshes", ()):
            color = linear(mesh.pop("extras")["color"])
            for primitive in mesh["primitives"]:
                tree["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorFactor"] = color
                _set_targets(tree, primitive)
        _add_camera(tree, solid.page.extent, depths(scene))

    options = {"include_normals": True, "buffer_postprocessor": _shorten, "tree_postprocessor": finished}
    data: bytes = scene.export(file_type="glb", **options)
    return data


def depths(scene: Any) -> tuple[float, float]:
    """The smallest and the largest z of a trimesh scene, at least slightly apart."""
    low, high = (0.0, 0.0) if scene.bounds is None else scene.bounds[:, 2]
    return float(low) - SPACE, float(high) + SPACE


def _shorten(buffers: Any, tree: dict[str, Any]) -> None:
    """Store indices in two bytes where there are few enough points."""
    accessors, keys = list(tree["accessors"].values()), list(buffers)
    for primitive in (primitive for mesh in tree.get("meshes", ()) for primitive in mesh["primitives"]):
        indices, points = accessors[primitive["indices"]], accessors[primitive["attributes"]["POSITION"]]
        if points["count"] <= SHORT and indices["componentType"] != UNSIGNED_SHORT:
            key = keys[indices["bufferView"]]
            short = np.frombuffer(buffers[key], dtype="<u4")[: indices["count"]].astype("<u2").tobytes()
            buffers[key] = short + b"\0" * (-len(short) % 4)
            indices["componentType"] = UNSIGNED_SHORT


def _set_targets(tree: dict[str, Any], primitive: dict[str, Any]) -> None:
    used = [(primitive["indices"], INDICES), *((number, VERTICES) for number in primitive["attributes"].values())]
    for accessor, target in used:
        view = tree["bufferViews"][tree["accessors"][accessor]["bufferView"]]
        view["target"] = target
        if target == VERTICES:
            # Points of a ball are also its normals, and are stored once.
            view["byteStride"] = STRIDE


def _add_camera(tree: dict[str, Any], extent: tuple[float, float, float, float], depth: tuple[float, float]) -> None:
    (left, right, bottom, top), (low, high) = extent, depth
    lens = {"xmag": (right - left) / 2, "ymag": (top - bottom) / 2, "znear": SPACE, "zfar": SPACE + high - low}
    place = [(left + right) / 2, (bottom + top) / 2, high + SPACE]
    tree["cameras"] = [{"type": "orthographic", "name": CAMERA, "orthographic": lens}]
    tree["scenes"][0].setdefault("nodes", []).append(len(tree["nodes"]))
    tree["nodes"].append({"name": CAMERA, "camera": 0, "translation": place})
