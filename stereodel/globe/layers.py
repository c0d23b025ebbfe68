"""Layers of a globe, from the bottom up; each lays itself out on a chart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.curves.chart import Chart, Place
from stereodel.drawing.page import Ball, Beziers, Dots, Fill, Item, Label, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.items import FEW_COLORS, Tags
from stereodel.drawing.page.placing import Placer, Seats
from stereodel.drawing.page.style import DotStyle, LineStyle, with_opacity
from stereodel.drawing.scene.graticule import LEAST_APART, WIDTHS_APART, Graticule, usual_spacing
from stereodel.drawing.scene.space_curves import page_path
from stereodel.drawing.scene.visibility import limb
from stereodel.globe.outlines_on_sphere import SphereLines, SphereRegions
from stereodel.globe.raster import Raster, RasterOnDisc
from stereodel.sphere.latitudes import Latitude


def outline(chart: Chart) -> Beziers:
    """The edge of a disc, counterclockwise."""
    return page_path([limb(1.0)], chart.at, chart.scale)


def ball(chart: Chart) -> Ball | None:
    """The shading of a disc, if it is a ball."""
    return Ball(chart.at, chart.scale) if chart.view.round else None


class MapLayer(Protocol):
    """Interface of the layers of a globe."""

    def lay(self, chart: Chart) -> Iterator[Item]:
        """The visible page items in painter's order."""


@dataclass(frozen=True)
class Ground:
    """The surface of the ball, or the disc of a flat map."""

    color: Color
    name: str = "ball"

    def lay(self, chart: Chart) -> Iterator[Item]:
        """The whole disc, shaded if it is a ball."""
        yield Fill((outline(chart),), self.color, self.name, ball(chart))


@dataclass(frozen=True)
class Limb:
    """The edge of the disc."""

    style: LineStyle
    name: str = "limb"

    def lay(self, chart: Chart) -> Iterator[Item]:
        """A circle."""
        yield Stroke(outline(chart), self.style.color, self.style.width, closed=True, name=self.name)


@dataclass(frozen=True, eq=False)
class LineLayer:
    """Lines of one style."""

    lines: SphereLines
    style: LineStyle
    name: str
    tags: Tags | None = None

    def lay(self, chart: Chart) -> Iterator[Item]:
        """All visible parts, as one item."""
        seen, line = self.lines.on(chart)
        if len(seen):
            look, tags = (self.style.color, self.style.width), self.tags and self.tags.some(line)
            yield Polylines(seen.values, seen.offsets, *look, self.name, tags=tags)


@dataclass(frozen=True, eq=False)
class GridLines:
    """Meridians and parallels, thinned where they would merge.

    They are `spacing` degrees apart; None chooses a spacing that suits the chart.
    """

    spacing: float | None
    latitude: Latitude
    style: LineStyle
    name: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """As for `LineLayer`; some lines end where they are less than `WIDTHS_APART` line widths apart."""
        spacing = usual_spacing(chart) if self.spacing is None else self.spacing
        least = max(WIDTHS_APART * self.style.width, LEAST_APART) / (chart.unit * chart.scale)
        grid = Graticule.shown(spacing, chart, least, latitude=self.latitude)
        shown = SphereLines.alone(grid.thinned(chart, least))
        yield from LineLayer(shown, self.style, self.name).lay(chart)


@dataclass(frozen=True, eq=False)
class Areas:
    """Regions, each in one colour (n, 4)."""

    regions: SphereRegions
    colors: FloatArray
    name: str
    tags: Tags | None = None

    def lay(self, chart: Chart) -> Iterator[Item]:
        """One item for each colour, or one for all regions if there are too many colours.

        With few colours, regions of different colours may overlap; later colours cover earlier ones.
        """
        loops, owner = self.regions.on(chart)
        if len(loops) == 0:
            return
        tags = self.tags and self.tags.some(owner)
        whole = Polygons(loops.values, loops.offsets, owner, self.colors, ball(chart), self.name, tags=tags)
        colors, number = whole.by_color
        if len(colors) > FEW_COLORS:
            yield whole
            return
        for color in range(len(colors)):
            yield whole.some(number == color)


@dataclass(frozen=True, eq=False)
class Image:
    """A raster, whose own opacity is multiplied by `opacity`."""

    raster: Raster
    opacity: float
    name: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """The whole disc as one image, warped when it is drawn."""
        yield Picture((outline(chart),), RasterOnDisc(self.raster, chart, self.opacity), self.name)


@dataclass(frozen=True, eq=False)
class Points:
    """Dots at unit vectors (n, 3)."""

    xyz: FloatArray
    style: DotStyle
    name: str
    tags: Tags | None = None

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Dots whose centres are visible."""
        places, seen = chart.points(self.xyz)
        if seen.any():
            style = self.style
            tags, look = self.tags and self.tags.some(seen), (style.radius, style.color, style.rim)
            yield Dots(places[seen], *look, style.rim_width, self.name, tags=tags)


Standing = tuple[int, int, float]
"""In a frame of a film: the row of a name, its position among `Seats`, and how strong it is, in (0, 1]."""


@dataclass(frozen=True, eq=False)
class Names:
    """Labels at unit vectors (n, 3), in order of decreasing priority."""

    xyz: FloatArray
    labels: tuple[Label, ...]
    distance: float | None = None
    """Distance in points of a movable label from its place; None for labels that are fixed."""
    leader: LineStyle | None = None
    """Lines to labels that have no room beside their places; None for no such labels."""
    standing: tuple[Standing, ...] | None = None
    """Where they were placed before; None places them now."""

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Labels whose places are visible, inside the disc where there is room."""
        yield from self.beside(chart, Placer(chart, ()), {})

    def beside(self, chart: Chart, placer: Placer, dots: Mapping[bytes, float]) -> Iterator[Item]:
        """As for `lay`, where items and earlier names leave room; `dots` as found by `radii`."""
        places, seen = chart.points(self.xyz)
        standing = [(row, 0, 1.0) for row in np.flatnonzero(seen).tolist()] if self.standing is None else self.standing
        for row, side, strength in standing:
            seats = self.seats(row, dots, (float(places[row, 0]), float(places[row, 1])))
            if self.standing is None:
                yield from placer.place(seats, self.leader)
            else:
                label = seats.labels[side]
                yield replace(label, color=with_opacity(label.color, strength * label.color[3]))

    def seats(self, row: int, dots: Mapping[bytes, float], anchor: Place = (0.0, 0.0)) -> Seats:
        """The positions of one of the names."""
        label, own = replace(self.labels[row], anchor=anchor), dots.get(self.xyz[row].tobytes(), 0.0)
        return Seats.of(label, self.distance, own, led=self.leader is not None and self.standing is None)


def radii(globe: Layered) -> dict[bytes, float]:
    """The radius of the dot at each place that has one, by the bytes of its unit vector."""
    layers = (layer for layer in globe.layers if isinstance(layer, Points))
    return {place.tobytes(): layer.style.radius for layer in layers for place in layer.xyz}


class Layered(Protocol):
    """Interface of what a panel shows, such as a `Globe`."""

    layers: list[MapLayer]
    limb: Limb


def laid(globe: Layered, chart: Chart) -> tuple[Item, ...]:
    """The page items of a chart, in painter's order; names are placed when all else is there."""
    layers = (*globe.layers, globe.limb)
    items = [[] if isinstance(layer, Names) else list(layer.lay(chart)) for layer in layers]
    placer, dots = Placer(chart, [item for some in items for item in some]), radii(globe)
    for layer, some in zip(layers, items, strict=True):
        if isinstance(layer, Names):
            some += layer.beside(chart, placer, dots)
    return tuple(item for some in items for item in some)
