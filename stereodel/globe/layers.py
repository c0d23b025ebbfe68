"""What a globe shows, from the ground up: each layer lays itself out on a chart."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from stereodel._arrays import BoolArray, FloatArray
from stereodel.conformal import MoebiusMap
from stereodel.drawing.colors import Color
from stereodel.drawing.page import Ball, Dots, Fill, Item, Label, Mosaic, Patch, Picture, Polylines, Stroke
from stereodel.drawing.style import DotStyle, LineStyle
from stereodel.globe.chart import Chart
from stereodel.globe.lines import SphereLines
from stereodel.globe.raster import Raster, RasterOnDisc
from stereodel.globe.regions import Mesh, SphereMesh
from stereodel.sphere import SphereCircle

FEW_COLORS = 64
"""Colours up to which regions are filled colour by colour, as paths on paper; beyond, they are one picture."""


class MapLayer(Protocol):
    """What a globe holds."""

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Page items in painter's order, without what is out of sight."""


@dataclass(frozen=True)
class Ground:
    """The ball itself, or the disc of a flat map."""

    color: Color
    role: str = "ball"

    def lay(self, chart: Chart) -> Iterator[Item]:
        """The whole disc; that of a ball is lit."""
        ball = Ball(chart.at, chart.scale) if chart.view.round else None
        yield Fill(chart.outline, self.color, self.role, ball)


@dataclass(frozen=True)
class Rim:
    """The edge of what is seen."""

    look: LineStyle
    role: str = "limb"

    def lay(self, chart: Chart) -> Iterator[Item]:
        """A circle."""
        yield Stroke(chart.outline[0], self.look.color, self.look.width, closed=True, name=self.role)


@dataclass(frozen=True, eq=False)
class Lines:
    """Lines of one look."""

    lines: SphereLines
    look: LineStyle
    role: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """All parts that are seen, as one item."""
        points, offsets = chart.lines(self.lines)
        if len(points):
            yield Polylines(points, offsets, self.look.color, self.look.width, self.role)


@dataclass(frozen=True, eq=False)
class Areas:
    """Regions, each in one colour (n, 4)."""

    mesh: SphereMesh
    colors: FloatArray
    role: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Regions of one colour together, or all of them as one picture."""
        yield from filled(chart, *chart.regions(self.mesh), self.colors, self.role)


@dataclass(frozen=True, eq=False)
class Image:
    """A raster, as opaque as it is times `opacity`."""

    raster: Raster
    opacity: float
    role: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """The whole disc as one picture, warped when it is drawn."""
        painter = RasterOnDisc(self.raster, chart.lens, chart.view, chart.at, chart.scale, self.opacity)
        yield Picture(chart.outline, painter, self.role)


@dataclass(frozen=True, eq=False)
class Circles:
    """Circles of the sphere with their interiors, whose images are circles again: Tissot's indicatrices."""

    circles: tuple[SphereCircle, ...]
    tint: Color | None
    look: LineStyle
    role: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Fills first, so that no line is covered."""
        images = [chart.lens.image_of(circle) for circle in self.circles]
        rings = [_ring(circle, chart.slack) for circle in images]
        if self.tint is not None and images:
            tints = np.broadcast_to(self.tint, (len(images), 4))
            yield from filled(chart, *chart.image_regions(_caps(images, rings, chart.slack)), tints, self.role)
        offsets = np.cumsum([0, *(len(ring) + 1 for ring in rings)])
        closed = np.concatenate([np.zeros((0, 3)), *(points for ring in rings for points in (ring, ring[:1]))])
        points, runs = chart.image_lines(closed, offsets)
        if len(points):
            yield Polylines(points, runs, self.look.color, self.look.width, self.role)


@dataclass(frozen=True, eq=False)
class Points:
    """Dots at unit vectors (n, 3)."""

    xyz: FloatArray
    look: DotStyle
    role: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Those whose middle is seen."""
        places, seen = chart.points(self.xyz)
        if seen.any():
            look = self.look
            yield Dots(places[seen], look.radius, look.color, look.rim, look.rim_width, self.role)


@dataclass(frozen=True, eq=False)
class Names:
    """Labels at unit vectors (n, 3), of which those farther ahead matter more."""

    xyz: FloatArray
    labels: tuple[Label, ...]

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Those whose place is seen."""
        places, seen = chart.points(self.xyz)
        for label, (x, y) in ((self.labels[k], places[k]) for k in np.flatnonzero(seen)):
            yield replace(label, anchor=(float(x), float(y)))


def filled(chart: Chart, mesh: Mesh, rim: BoolArray, colors: FloatArray, role: str) -> Iterator[Item]:
    """Page items of triangles in view axes, in the colours (n, 4) of their owners."""
    if len(mesh.faces) == 0:
        return
    page = chart.on_page(mesh.points)
    normals = mesh.points if chart.view.round else None
    distinct, which = np.unique(colors[np.unique(mesh.owners)], axis=0, return_inverse=True)
    number = np.zeros(len(colors), dtype=np.intp)
    number[np.unique(mesh.owners)] = which.ravel()
    tint = number[mesh.owners]
    if len(distinct) > FEW_COLORS:
        shading = None if normals is None else normals[mesh.faces]
        yield Mosaic(page[mesh.faces], shading, distinct[tint, :3], chart.outline, role)
        return
    for k, color in enumerate(distinct):
        used, corners = np.unique(mesh.faces[tint == k], return_inverse=True)
        shades = None if normals is None else normals[used]
        red, green, blue, opacity = color.tolist()
        faces = corners.reshape(-1, 3).astype(np.int32)
        yield Patch(page[used], faces, (red, green, blue, opacity), rim[used], chart.at, shades, role)


def _ring(circle: SphereCircle, tolerance: float) -> FloatArray:
    """Points round a circle whose chords are within a tolerance of it."""
    share = np.clip(1 - tolerance / max(circle.radius, tolerance), 0.5, 1.0)
    return circle.sample(max(8, int(np.ceil(np.pi / np.arccos(share)))))


def _caps(circles: list[SphereCircle], rings: list[FloatArray], tolerance: float) -> Mesh:
    """The interiors of circles as fans of triangles, fine enough to be drawn."""
    corners, faces, owners = [], [], []
    size = 0
    for number, (circle, ring) in enumerate(zip(circles, rings, strict=True)):
        here = np.arange(len(ring)) + size + 1
        corners += [circle.center[None], ring]
        faces.append(np.stack([np.full(len(ring), size), here, np.roll(here, -1)], axis=1))
        owners.append(np.full(len(ring), number))
        size += len(ring) + 1
    mesh = SphereMesh(np.concatenate(corners), np.concatenate(faces), np.concatenate(owners))
    return mesh.through(MoebiusMap.identity(), tolerance=tolerance)
