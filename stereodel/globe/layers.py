"""Layers of a globe, from the bottom up; each lays itself out on a chart."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final, Protocol

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.curves.chart import Chart
from stereodel.drawing.page import Ball, Beziers, Dots, Fill, Item, Label, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.labels import placed_apart, within_disc
from stereodel.drawing.page.style import LineStyle
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

RADIUS_POINTS: Final = AUTHALIC_RADIUS_KM * 1e5 / 2.54 * 72
"""Radius of the Earth in points."""

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
    points = largest * chart.unit * max(1.0, FINE / (chart.tolerance * chart.unit))
    return suited_to(points)


def suited_to(points: float) -> str:
    """The resolution that suits a map with so many points to a radian of the Earth."""
    scale = RADIUS_POINTS / points
    return next(name for name, least in RESOLUTIONS.items() if scale < least)


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
    told: tuple[str, ...] = ()

    def lay(self, chart: Chart) -> Iterator[Item]:
        """All visible parts, as one item."""
        seen = self.lines.on(chart)
        if len(seen):
            yield Polylines(seen.values, seen.offsets, self.style.color, self.style.width, self.name, self.told)


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

    def lay(self, chart: Chart) -> Iterator[Item]:
        """One item for each colour, or one for all regions if there are too many colours.

        With few colours, regions of different colours may overlap; later colours cover earlier ones.
        """
        loops, owner = self.regions.on(chart)
        if len(loops) == 0:
            return
        told = ("color",) if (self.colors != self.colors[0]).any() else ()
        whole = Polygons(loops.values, loops.offsets, owner, self.colors, ball(chart), self.name, told)
        if whole.pictured:
            yield whole
            return
        _, number = whole.by_color
        for color in range(int(number.max()) + 1):
            some, region = loops.take(number == color), owner[number == color]
            yield replace(whole, points=some.values, offsets=some.offsets, owner=region)


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

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Dots whose centres are visible."""
        places, seen = chart.points(self.xyz)
        if seen.any():
            yield from self.looks.items(places, np.flatnonzero(seen), 1 / chart.unit, self.name)


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
        if not isinstance(self.look, LineStyle):
            land = earth_regions(*given)
            regions = land.complement if self.name == "ocean" else land
            yield from Areas(regions, np.tile(self.look, (regions.count, 1)), self.name).lay(chart)
        else:
            lines = earth_regions(*given).outlines if self.what in ("land", "lakes") else earth_lines(*given)
            yield from LineLayer(lines, self.look, self.name).lay(chart)


@dataclass(frozen=True, eq=False)
class Names:
    """Labels at unit vectors (n, 3), in order of decreasing priority."""

    xyz: FloatArray
    labels: tuple[Label, ...]
    distance: float | None = None
    """Distance in points of a movable label from its place; None for labels that are fixed."""

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Labels whose places are visible, inside the disc where there is room."""
        yield from self.beside(chart, ())

    def beside(self, chart: Chart, items: Sequence[Item]) -> Iterator[Label]:
        """As for `lay`, avoiding items that are already on the chart."""
        disc = chart.at, chart.scale, chart.unit
        if self.distance is None:
            yield from (within_disc(label, disc) for label in self._seen(chart))
            return
        before = [item for item in items if isinstance(item, Label)]
        dots = np.concatenate([np.zeros((0, 2)), *(item.centers for item in items if isinstance(item, Dots))])
        yield from placed_apart(self._seen(chart), self.distance, disc, before, dots)

    def _seen(self, chart: Chart) -> Iterator[Label]:
        places, seen = chart.points(self.xyz)
        for label, (x, y) in ((self.labels[k], places[k]) for k in np.flatnonzero(seen)):
            yield replace(label, anchor=(float(x), float(y)))


class Layered(Protocol):
    """Interface of what a panel shows, such as a `Globe`."""

    layers: list[MapLayer]
    limb: Limb


def laid(globe: Layered, chart: Chart) -> tuple[Item, ...]:
    """The page items of a chart, in painter's order."""
    items: list[Item] = []
    for layer in (*globe.layers, globe.limb):
        items += layer.beside(chart, items) if isinstance(layer, Names) else layer.lay(chart)
    return tuple(items)
