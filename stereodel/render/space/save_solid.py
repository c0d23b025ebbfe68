"""Scenes in space as files and pictures: scenes → bodies → trimesh → glTF, or pyrender → rows of pixels → labels.

The PNG shows exactly the bodies that are written to GLB. trimesh writes it, but rounds colours to 1/255 of linear
light, has only cameras with perspective, does not say what buffers are for, and takes four bytes an index.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray, Pixels
from stereodel._tasks.whole_files import write_whole
from stereodel.drawing.page.colors import Color
from stereodel.drawing.scene.scene_items import Layer
from stereodel.drawing.scene.solid import Solid
from stereodel.render import gl
from stereodel.render.pixel_rows import SUPERSAMPLING, averaged, labelled, over_white
from stereodel.render.save import write_png
from stereodel.render.space.bodies import ROUGHNESS, linear, to_trimesh

CAMERA: Final = "page"
"""Name of the camera that shows what the page shows."""

SPACE: Final = 1.0
"""Page units between the camera and the scene, and behind the scene."""

STRIDE: Final = 12
"""Size in bytes of a point or normal: three single-precision numbers."""

SHORT: Final = 2**16 - 1
"""Number of points that two bytes can index; the last value is reserved."""

VERTICES, INDICES, UNSIGNED_SHORT = 34962, 34963, 5123
"""Constants of the glTF specification: targets of buffers, and the type of indices of two bytes."""

GAMMA: Final = 2.2
"""Exponent by which pyrender decodes colours, in place of sRGB."""

AMBIENT: Final = 0.45
"""Ambient light: fraction of the brightness, in linear light, where a surface faces away from the lamps."""

LAMPS: Final = (((-0.35, 0.45, 0.82), 0.75), ((0.0, 0.0, 1.0), 0.25), ((-0.2, 0.9, 0.1), 0.15))
"""Directions toward the lamps and their shares of the remaining light: one from the upper left, as on pages; one from
the viewer, which softens the edge of the first lamp's light; and one from above.
"""


def save_solid(solid: Solid, path: str | os.PathLike[str], *, size: int | None, text: bool) -> None:
    """Implementation of `Solid.save`."""
    target = Path(path)
    match target.suffix.lower():
        case ".glb":
            write_whole(target, glb_bytes(solid))
        case ".png":
            page, width = solid.page if text else solid.page.without_labels(), solid.page.pixels_across(size)
            write_png(labelled(lit_rows(solid, width), page, width), page, target, width)
        case _:
            raise ValueError(f"path must end in .glb or .png, got {target.name!r}")


def glb_bytes(solid: Solid) -> bytes:
    """The bytes of a GLB file, which are the same for the same picture."""
    scene = to_trimesh(solid)
    if not scene.geometry:
        raise ValueError("scenes hold no body, and a GLB must; add a ball, lines, dots or regions")

    def finished(tree: dict[str, Any]) -> None:
        tree["asset"]["generator"] = "stereodel"
        for mesh in tree["meshes"]:
            color = linear(mesh.pop("extras")["color"])
            for primitive in mesh["primitives"]:
                tree["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorFactor"] = color
                _view(tree, primitive["indices"])["target"] = INDICES
                for accessor in primitive["attributes"].values():
                    # Points of a ball are also its normals, and are stored once.
                    _view(tree, accessor).update(target=VERTICES, byteStride=STRIDE)
        (left, right), (bottom, top), (low, high) = page_box(solid, scene)
        lens = {"xmag": (right - left) / 2, "ymag": (top - bottom) / 2, "znear": SPACE, "zfar": SPACE + high - low}
        place = [(left + right) / 2, (bottom + top) / 2, high + SPACE]
        tree["cameras"] = [{"type": "orthographic", "name": CAMERA, "orthographic": lens}]
        tree["scenes"][0].setdefault("nodes", []).append(len(tree["nodes"]))
        tree["nodes"].append({"name": CAMERA, "camera": 0, "translation": place})

    options = {"include_normals": True, "buffer_postprocessor": _shorten, "tree_postprocessor": finished}
    return scene.export(file_type="glb", **options)


def _shorten(buffers: Any, tree: dict[str, Any]) -> None:
    """Store indices in two bytes where there are few enough points."""
    accessors, keys = list(tree["accessors"].values()), list(buffers)
    for primitive in (primitive for mesh in tree["meshes"] for primitive in mesh["primitives"]):
        indices, points = accessors[primitive["indices"]], accessors[primitive["attributes"]["POSITION"]]
        if points["count"] <= SHORT and indices["componentType"] != UNSIGNED_SHORT:
            key = keys[indices["bufferView"]]
            short = np.frombuffer(buffers[key], dtype="<u4")[: indices["count"]].astype("<u2").tobytes()
            buffers[key] = short + b"\0" * (-len(short) % 4)
            indices["componentType"] = UNSIGNED_SHORT


def _view(tree: dict[str, Any], accessor: int) -> dict[str, Any]:
    return tree["bufferViews"][tree["accessors"][accessor]["bufferView"]]


def page_box(solid: Solid, scene: Any) -> list[list[float]]:
    """Left and right, bottom and top of a page, smallest and largest z of its trimesh scene, and some space."""
    left, right, bottom, top = map(float, solid.page.extent)
    low, high = (0.0, 0.0) if scene.bounds is None else scene.bounds[:, 2].tolist()
    return [[left, right], [bottom, top], [low - SPACE, high + SPACE]]


def draw_solid(solid: Solid, *, size: int | None, text: bool) -> Pixels:
    """Implementation of `Solid.pixels`."""
    page, width = solid.page if text else solid.page.without_labels(), solid.page.pixels_across(size)
    return np.concatenate(list(labelled(lit_rows(solid, width), page, width)))


def lit_rows(solid: Solid, width: int) -> Iterator[Pixels]:
    """A picture `width` pixels wide, without its labels, in blocks of rows (k, width, 3)."""
    scene, large = to_trimesh(solid), (SUPERSAMPLING * width, SUPERSAMPLING * solid.page.pixels_up(width))
    make = partial(_lit, scene=scene, ground=over_white(solid.page.background))
    return gl.space_bands(make, page_box(solid, scene), *large, finish=averaged)


def _lit(pyrender: Any, scene: Any, ground: Color) -> Any:
    """A trimesh scene as a pyrender scene with lamps."""
    made = pyrender.Scene(bg_color=[*map(float, ground[:3]), 1.0], ambient_light=[AMBIENT] * 3)
    for toward, share in LAMPS:
        lamp = pyrender.DirectionalLight(intensity=np.pi * (1 - AMBIENT) * share)
        # It shines along its −z.
        z = np.array(toward) / np.sqrt(np.sum(np.array(toward) ** 2))
        x = np.cross([0.0, 1.0, 0.0], z)
        x /= np.sqrt(np.sum(x**2))
        pose = np.eye(4)
        pose[:3, :3] = np.column_stack([x, np.cross(z, x), z])
        made.add(lamp, pose=pose)
    nodes = scene.graph.geometry_nodes
    parts = [part for name in scene.geometry for part in _parts(pyrender, scene, name, nodes[name])]
    # Opaque bodies first, then transparent ones from back to front.
    for number, (_, primitive) in enumerate(sorted(parts, key=lambda part: part[0])):
        made.add(pyrender.Mesh([primitive]), name=gl.node_name(number))
    return made


def _parts(pyrender: Any, scene: Any, name: str, nodes: list[str]) -> Iterator[tuple[int, Any]]:
    """Primitives of a mesh with their position in painter's order; 0 for opaque ones."""
    mesh = scene.geometry[name]
    poses = np.array([scene.graph.get(node)[0] for node in nodes])
    color, layer = mesh.metadata["color"], mesh.metadata["layer"]
    if color[3] == 1:
        yield 0, _primitive(pyrender, mesh, color, poses)
    elif layer == Layer.BALL:
        for pose in poses:
            # Toward the limb the path through glass is longer and more light is reflected.
            normals = mesh.vertex_normals @ pose[:3, :3].T
            facing = np.abs(normals[:, 2]) / np.sqrt(np.sum(normals**2, axis=1))
            opacity = color[3] + (1 - color[3]) * (1 - facing) ** 3.0
            yield layer, _primitive(pyrender, mesh, color, pose[None], opacity=opacity)
    else:
        if layer == Layer.TINT:
            yield Layer.FAR_TINT, _primitive(pyrender, mesh, color, poses, side=-1)
        yield layer, _primitive(pyrender, mesh, color, poses)


def _primitive(
    pyrender: Any, mesh: Any, color: Color, poses: FloatArray, side: int = 1, opacity: FloatArray | None = None
) -> Any:
    base = [*(np.array(color[:3]) ** GAMMA).tolist(), color[3] if opacity is None else 1.0]
    mode = "OPAQUE" if color[3] == 1 else "BLEND"
    material = pyrender.MetallicRoughnessMaterial(
        baseColorFactor=base, metallicFactor=0.0, roughnessFactor=ROUGHNESS, alphaMode=mode
    )
    tints = None if opacity is None else np.column_stack([np.ones((len(opacity), 3)), opacity])
    normals, faces = side * mesh.vertex_normals, mesh.faces[:, ::side]
    return pyrender.Primitive(
        mesh.vertices, normals=normals, color_0=tints, indices=faces, material=material, poses=poses
    )
