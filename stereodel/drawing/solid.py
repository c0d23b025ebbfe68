"""Pictures in space: scenes as bodies, where a page shows what is seen of them.

A page is flat, and what is hidden is not on it. A `Solid` has the page and the scenes that it was laid out from, placed
as on the page: x right, y up, z toward the viewer, in page units. It is written as glTF, or drawn with light and shade,
what is in front hiding what is behind.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from stereodel._arrays import FloatArray, Pixels
from stereodel._extras import of_extra
from stereodel.drawing.page import Item, Page
from stereodel.drawing.scene_items import Layout, SceneItem, laid_out


@dataclass(frozen=True, eq=False)
class PlacedScene:
    """A scene in its place on a page.

    Parameters
    ----------
    layout : Layout
        Its view and its place.
    items : tuple of SceneItem
        What it holds.
    """

    layout: Layout
    items: tuple[SceneItem, ...]

    @property
    def pose(self) -> FloatArray:
        """Turns points (x, y, z, 1) of the scene's space into those of the page's space, (4, 4)."""
        pose = np.eye(4)
        pose[:3, :3] = self.layout.scale * self.layout.matrix
        pose[:2, 3] = self.layout.at
        return pose

    def page_items(self) -> tuple[Item, ...]:
        """What a page shows of it, in painter's order, as of `Scene.layout`."""
        return laid_out(self.items, self.layout)


@dataclass(frozen=True, eq=False)
class Solid:
    """What a page shows, in space: balls, lines as tubes, dots as small balls, regions and planes as surfaces.

    Widths are those on the page. What is bound to a side from which one looks, the limb of a ball, is not in space;
    labels are places with a name.

    Parameters
    ----------
    page : Page
        The same flat: its frame, width, ground and labels are those of the picture.
    scenes : sequence of PlacedScene
        What stands in space.

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

    def to_trimesh(self) -> Any:
        """The bodies as a scene of trimesh.

        Returns
        -------
        trimesh.Scene
            A node for each item of a scene, under the name that it was added with, numbered where a name comes again;
            for dots one node each below it, all of one mesh; for a label a node without a mesh whose metadata hold
            the text, its size and its offset in points. Several scenes are nodes "panel 1", "panel 2", …

        Raises
        ------
        ImportError
            Without trimesh (``pip install stereodel[render]``).
        """
        with of_extra("render"):
            from stereodel.render.solid import to_trimesh

            return to_trimesh(self)

    def save(
        self, path: str | os.PathLike[str], *, size: int | None = None, text: bool = True, platform: str | None = None
    ) -> Path:
        """Write a GLB, or a PNG with light and shade, as the ending of `path` says.

        Parameters
        ----------
        path : path-like
            Written under a temporary name in the same folder first; an existing file is replaced.
        size, text, platform
            Of a PNG, as for `Page.save`.

        Returns
        -------
        Path
            The file.

        Raises
        ------
        ValueError
            For another ending, a size that is out of range, and a GLB of nothing.
        OSError
            Where the file cannot be written; where there is no OpenGL, which a PNG needs.

        Notes
        -----
        GLB is binary glTF 2.0. Its camera named "page" sees what the page shows; other programs look from the same side
        when they open the file, as x is right, y up and z toward the viewer in glTF too. A unit is the page's, which
        glTF calls a metre.
        """
        with of_extra("render"):
            from stereodel.render.solid import save_solid

            save_solid(self, path, size=size, text=text, platform=platform)
        return Path(path)

    def pixels(self, *, size: int | None = None, text: bool = True, platform: str | None = None) -> Pixels:
        """Draw the bodies with light and shade: what `save` writes as PNG.

        Parameters
        ----------
        size, text, platform
            As for `Page.pixels`.

        Returns
        -------
        (height, width, 3) uint8 array
            sRGB, rows from the top.
        """
        with of_extra("render"):
            from stereodel.render.solid import draw_solid

            return draw_solid(self, size=size, text=text, platform=platform)
