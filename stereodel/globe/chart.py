"""Charts: how the sphere gets onto a page, through a lens and a view."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray
from stereodel.conformal import MoebiusMap
from stereodel.drawing.page import Beziers
from stereodel.drawing.regions import limb
from stereodel.drawing.space_curves import page_path
from stereodel.drawing.view import MapView
from stereodel.globe.lines import SphereLines, clipped_lines, thinned
from stereodel.globe.regions import Mesh, SphereMesh
from stereodel.sphere.vectors import turned

Indices = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Chart:
    """A conformal map of the sphere, then a view of its image, on a disc of the page.

    Parameters
    ----------
    lens : MoebiusMap
    view : MapView
    at : tuple of float
        Page position of the middle of the disc.
    scale : float
        Radius of the disc in page units.
    tolerance : float
        How far what is drawn may be from what it stands for, page units.
    """

    lens: MoebiusMap
    view: MapView
    at: tuple[float, float] = (0.0, 0.0)
    scale: float = 1.0
    tolerance: float = 1e-4

    @cached_property
    def outline(self) -> tuple[Beziers, ...]:
        """The edge of the disc, counterclockwise."""
        return (page_path([limb(1.0)], self.at, self.scale),)

    def on_page(self, axes: FloatArray) -> FloatArray:
        """Page coordinates (..., 2) of unit vectors of the cap in view axes."""
        placed: FloatArray = self.scale * self.view.flattened(axes) + np.array(self.at)
        return placed

    def axes(self, images: FloatArray) -> FloatArray:
        """Images of the lens (..., 3) in view axes."""
        return turned(images, self.view.matrix)

    def lines(self, lines: SphereLines) -> tuple[FloatArray, Indices]:
        """Polylines (points (n, 2), offsets) on the page: the parts that are seen of lines on the sphere."""
        return self.image_lines(*lines.through(self.lens, tolerance=self.slack))

    def image_lines(self, points: FloatArray, offsets: Indices) -> tuple[FloatArray, Indices]:
        """The same of polylines that the lens has seen already."""
        seen, runs = clipped_lines(self.axes(points), offsets, self.view.edge)
        return thinned(self.on_page(seen), runs, self.tolerance)

    def regions(self, mesh: SphereMesh) -> tuple[Mesh, BoolArray]:
        """What is seen of regions, in view axes, and which corners are on the edge of the disc."""
        return self.image_regions(
            mesh.through(self.lens, tolerance=self.slack, cap=(self.view.matrix[2], self.view.edge))
        )

    def image_regions(self, mesh: Mesh) -> tuple[Mesh, BoolArray]:
        """The same of triangles that the lens has seen already."""
        return replace(mesh, points=self.axes(mesh.points)).clipped(self.view.edge, tolerance=self.slack)

    def points(self, xyz: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Page coordinates (n, 2) of unit vectors, and whether they are seen; what is not has no meaning."""
        axes = self.axes(self.lens(xyz))
        return self.on_page(axes), axes[:, 2] >= self.view.edge

    @property
    def slack(self) -> float:
        """The tolerance on the sphere, in radii, that is within that of the page wherever it is."""
        return self.tolerance / (self.scale * self.view.stretch)
