"""Layers of a globe, from the bottom up; each lays itself out on a chart."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Final, Protocol

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.curves.chart import Chart, Place
from stereodel.drawing.page import Ball, Beziers, Fill, Item, Label, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.items import FEW_COLORS, Tags
from stereodel.drawing.page.placing import Placer, Seats
from stereodel.drawing.page.style import LineStyle, with_opacity
from stereodel.drawing.scene.by_value import DotLooks
from stereodel.drawing.scene.graticule import LEAST_APART, WIDTHS_APART, Graticule, usual_spacing
from stereodel.drawing.scene.space_curves import page_path
from stereodel.drawing.scene.visibility import limb
from stereodel.earth import AUTHALIC_RADIUS_KM
from stereodel.globe.outlines_on_sphere import SphereLines, SphereRegions, earth_lines, earth_regions
from stereodel.globe.raster import Raster, RasterOnDisc
from stereodel.sphere.latitudes import Latitude

AUTO: Final = "auto"
"""The resolution that suits the scale on the page."""

RESOLUTIONS: Final = {"10m": 25e6, "50m": 130e6, "110m": np.inf}
"""Resolutions of maps of the Earth, and the scale 1 : n from which on the next one is fine enough."""

FINE: Final = 0.02
"""Tolerance in points of pages in print."""


def outline(chart: Chart) -> Beziers:
    """The edge of a disc, counterclockwise."""
    return page_path([limb(1.0)], chart.at, chart.scale)


def ball(chart: Chart) -> Ball | None:
    """The shading of a disc, if it is a ball."""
    return Ball(chart.at, chart.scale) if chart.view.round else None


def suited(chart: Chart) -> str:
    """The resolution of maps of the Earth that suits the scale of a chart where it is largest."""
    peak, scale = chart.lens.peak
    # The nearest that is seen to the place where the lens enlarges most, as an angle.
    away = 2 * np.arcsin(min(1.0, float(np.sqrt(np.sum((chart.source.normal - peak) ** 2))) / 2)) - chart.source.radius
    half = max(0.0, float(away)) / 2
    flat = 1.0 if chart.view.round else 2 * float(np.tan(np.radians(chart.view.angular_radius) / 2))
    largest = scale / (np.cos(half) ** 2 + (scale * np.sin(half)) ** 2) * chart.scale / flat
    # Of a page with many pixels, whose curves are finer.
    return suited_to(largest * chart.unit * max(1.0, FINE / (chart.tolerance * chart.unit)))


def suited_to(points: float) -> str:
    """The resolution that suits a map with so many points to a radian of the Earth."""
    scale = AUTHALIC_RADIUS_KM * 1e5 / 2.54 * 72 / points
    return next(name for name, least in RESOLUTIONS.items() if scale < least)


class MapLayer(Protocol):
    """Interface of the layers of a globe."""

    def lay(self, chart: Chart) -> Iterator[Item]:
        """The visible page items in painter's order."""


@dataclass(frozen=True)
class Ground:
    """The surface of the ball, or the disc of a flat map."""

    color: Color

    def lay(self, chart: Chart) -> Iterator[Item]:
        """The whole disc, shaded if it is a ball."""
        yield Fill((outline(chart),), self.color, "ball", ball(chart))


@dataclass(frozen=True)
class Limb:
    """The edge of the disc."""

    style: LineStyle

    def lay(self, chart: Chart) -> Iterator[Item]:
        """A circle."""
        yield Stroke(outline(chart), self.style.color, self.style.width, closed=True, name="limb")


@dataclass(frozen=True, eq=False)
class LineLayer:
    """Lines of one style."""

    lines: SphereLines
    style: LineStyle
    name: str
    told: tuple[str, ...] = ()
    tags: Tags | None = None

    def lay(self, chart: Chart) -> Iterator[Item]:
        """All visible parts, as one item."""
        seen, line = self.lines.on(chart)
        if len(seen):
            look, tags = (self.style.color, self.style.width), self.tags and self.tags.some(line)
            yield Polylines(seen.values, seen.offsets, *look, self.name, self.told, tags=tags)


@dataclass(frozen=True, eq=False)
class GridLines:
    """Meridians and parallels `spacing` degrees apart, or as suits the chart; thinned where they would merge."""

    spacing: float | None
    latitude: Latitude
    style: LineStyle

    def lay(self, chart: Chart) -> Iterator[Item]:
        """As for `LineLayer`; some lines end where they are less than `WIDTHS_APART` line widths apart."""
        spacing = usual_spacing(chart) if self.spacing is None else self.spacing
        least = max(WIDTHS_APART * self.style.width, LEAST_APART) / (chart.unit * chart.scale)
        grid = Graticule.shown(spacing, chart, least, latitude=self.latitude)
        yield from LineLayer(SphereLines.alone(grid.thinned(chart, least)), self.style, "graticule").lay(chart)


@dataclass(frozen=True, eq=False)
class Areas:
    """Regions, each in one colour (n, 4)."""

    regions: SphereRegions
    colors: FloatArray
    name: str
    tags: Tags | None = None

    def lay(self, chart: Chart) -> Iterator[Item]:
        """One item for each colour, later ones above, or one for all regions if there are too many colours."""
        loops, owner = self.regions.on(chart)
        if len(loops) == 0:
            return
        told = ("color",) if (self.colors != self.colors[0]).any() else ()
        tags = self.tags and self.tags.some(owner)
        whole = Polygons(loops.values, loops.offsets, owner, self.colors, ball(chart), self.name, told, tags=tags)
        colors, number = whole.by_color
        if len(colors) > FEW_COLORS:
            yield whole
        else:
            yield from (whole.some(number == color) for color in range(len(colors)))


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
    looks: DotLooks
    name: str
    tags: Tags | None = None

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Dots whose centres are visible."""
        places, seen = chart.points(self.xyz)
        if seen.any():
            yield from self.looks.items(places, np.flatnonzero(seen), 1 / chart.unit, self.name, self.tags)


@dataclass(frozen=True)
class OfEarth:
    """A layer made of a map of the Earth, at a resolution or, "auto", at that which suits the scale on each page.

    look: a colour for land or lakes, or for the ocean, all but the land; a style for their outlines, or for lines.
    """

    what: str
    latitude: Latitude
    look: Color | LineStyle
    name: str
    resolution: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """As the layers do that are made of lines and regions."""
        given = self.what, suited(chart) if self.resolution == AUTO else self.resolution, self.latitude
        if isinstance(self.look, LineStyle):
            lines = earth_regions(*given).outlines if self.what in ("land", "lakes") else earth_lines(*given)
            yield from LineLayer(lines, self.look, self.name).lay(chart)
            return
        land = earth_regions(*given)
        regions = land.complement if self.name == "ocean" else land
        yield from Areas(regions, np.tile(self.look, (regions.count, 1)), self.name).lay(chart)


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


def radii(layers: Iterable[MapLayer]) -> dict[bytes, float]:
    """The radius of the dot at each place that has one, by the bytes of its unit vector."""
    dots = (layer for layer in layers if isinstance(layer, Points))
    pairs = (zip(layer.xyz, layer.looks.radii(len(layer.xyz)), strict=True) for layer in dots)
    return {place.tobytes(): radius for some in pairs for place, radius in some}
