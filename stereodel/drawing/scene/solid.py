"""Pictures in space: the bodies whose visible parts a page shows, placed as there: x right, y up, z to the viewer."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from stereodel._arrays import FloatArray, Pixels
from stereodel._extras import of_extra
from stereodel._notebook import Displayed, drawn
from stereodel.drawing.page import Page
from stereodel.drawing.page.page import output
from stereodel.drawing.scene.scene_items import Layout, SceneItem


@dataclass(frozen=True, eq=False)
class PlacedScene(Displayed):
    """The items of a scene, and its view and position on a page."""

    layout: Layout
    items: tuple[SceneItem, ...]

    @property
    def pose(self) -> FloatArray:
        """Matrix (4, 4) from points (x, y, z, 1) of the scene's space to the page's space."""
        pose = np.eye(4)
        pose[:3, :3] = self.layout.scale * self.layout.matrix
        pose[:2, 3] = self.layout.at
        return pose


@dataclass(frozen=True, eq=False)
class Solid(Displayed):
    """The content of a page in space: balls, lines as tubes, dots as small balls, regions and planes as surfaces.

    Widths are those on the page. The limb of a ball depends on the viewing direction and does not exist in space;
    labels are points with text.

    Parameters
    ----------
    page : Page
        The flat page: its frame, width, background and labels are those of the picture.
    scenes : sequence of PlacedScene
        The scenes in space.

    Examples
    --------
    >>> from stereodel.drawing import Scene, View
    >>> scene = Scene()
    >>> scene.add_points([[1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> solid = scene.solid(View(20, 35), width=200.0)
    >>> sorted(solid.to_trimesh().geometry)
    ['ball', 'sites']
    """

    page: Page
    scenes: Sequence[PlacedScene]
    _mimes = drawn(lambda it: it.page)

    def to_trimesh(self) -> Any:
        """The bodies as a scene of trimesh.

        Returns
        -------
        trimesh.Scene
            Scene with a node for each item, under the name with which it was added, numbered if the name repeats. Dots
            have one child node each, all sharing one mesh; a label is a node without a mesh whose metadata hold the
            text, its size and its offset in points. Several scenes are nodes "scene 1", "scene 2", …
        """
        with of_extra("render"):
            return output("to_trimesh")(self)

    def save(self, path: str | os.PathLike[str], *, size: int | None = None, text: bool = True) -> Path:
        """Write a GLB, or a PNG with shading, according to the extension of `path`, and return that.

        Parameters
        ----------
        path : path-like
            File to write, first under a temporary name in the same folder; an existing file is replaced.
        size, text
            For PNG, as for `Page.save`.

        Raises
        ------
        ValueError
            If the extension is unknown, `size` is out of range, or a GLB would be empty.
        OSError
            If the file cannot be written, or there is no OpenGL, which PNG needs.

        Notes
        -----
        GLB is binary glTF 2.0. Its camera "page" shows what the page shows; other programs open the file from the same
        side, as glTF also has x right, y up and z toward the viewer. Units are those of the page, which glTF interprets
        as metres.
        """
        with of_extra("render"):
            output("save_solid")(self, path, size=size, text=text)
        return Path(path)

    def pixels(self, *, size: int | None = None, text: bool = True) -> Pixels:
        """Draw the bodies with shading: the pixels that `save` writes as PNG, as from `Page.pixels`."""
        with of_extra("render"):
            return output("draw_solid")(self, size=size, text=text)
