"""What a globe shows, from the ground up: each layer lays itself out on a chart."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.drawing.colors import Color
from stereodel.drawing.graticule import LEAST_APART, WIDTHS_APART, Graticule, usual_spacing
from stereodel.drawing.label import within_disc
from stereodel.drawing.label_placement import placed_apart
from stereodel.drawing.page import Dots, Fill, Item, Label, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.style import DotStyle, LineStyle
from stereodel.globe.chart import Chart
from stereodel.globe.lines import SphereLines
from stereodel.globe.raster import Raster, RasterOnDisc
from stereodel.globe.regions import SphereRegions
from stereodel.sphere.latitudes import Latitude


class MapLayer(Protocol):
    """What a globe holds."""

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Page items in painter's order, without what is out of sight."""


@dataclass(frozen=True)
class Ground:
    """The ball itself, or the disc of a flat map."""

    color: Color
    name: str = "ball"

    def lay(self, chart: Chart) -> Iterator[Item]:
        """The whole disc; that of a ball is lit."""
        yield Fill(chart.outline, self.color, self.name, chart.ball)


@dataclass(frozen=True)
class Rim:
    """The edge of what is seen."""

    style: LineStyle
    name: str = "limb"

    def lay(self, chart: Chart) -> Iterator[Item]:
        """A circle."""
        yield Stroke(chart.outline[0], self.style.color, self.style.width, closed=True, name=self.name)


@dataclass(frozen=True, eq=False)
class Lines:
    """Lines of one style."""

    lines: SphereLines
    style: LineStyle
    name: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """All parts that are seen, as one item."""
        seen = chart.lines(self.lines)
        if len(seen):
            yield Polylines(seen.values, seen.offsets, self.style.color, self.style.width, self.name)


@dataclass(frozen=True, eq=False)
class GridLines:
    """Meridians and parallels, thinned where they would run together.

    They are `spacing` degrees apart, or, with None, as suits what a chart shows.
    """

    spacing: float | None
    latitude: Latitude
    style: LineStyle
    name: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """As `Lines`, of which some end where they come nearer to each other than `WIDTHS_APART` widths."""
        lens, view = chart.lens, chart.view
        spacing = usual_spacing(lens, view) if self.spacing is None else self.spacing
        least = max(WIDTHS_APART * self.style.width, LEAST_APART) / (chart.unit * chart.scale)
        grid = Graticule.shown(spacing, lens, view, least, latitude=self.latitude)
        shown = SphereLines.alone(grid.thinned(lens, view, least))
        yield from Lines(shown, self.style, self.name).lay(chart)


@dataclass(frozen=True, eq=False)
class Areas:
    """Regions, each in one colour (n, 4)."""

    regions: SphereRegions
    colors: FloatArray
    name: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Regions of one colour together, or all of them where there are too many colours.

        Those of different colours may overlap, if they are few: the later ones in the order of colours cover.
        """
        loops, owner = chart.regions(self.regions)
        if len(loops) == 0:
            return
        whole = Polygons(loops.values, loops.offsets, owner, self.colors, chart.ball, self.name)
        if whole.pictured:
            yield whole
            return
        _, number = whole.by_color
        for color in range(int(number.max()) + 1):
            some, region = loops.take(number == color), owner[number == color]
            yield replace(whole, points=some.values, offsets=some.offsets, owner=region)


@dataclass(frozen=True, eq=False)
class Outside:
    """All that is in none of some regions, in one colour: the sea about the land."""

    regions: SphereRegions
    color: Color
    name: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """The disc with the regions as holes."""
        holes, _ = chart.regions(self.regions)
        disc = np.concatenate([chart.rim, chart.rim[:1]])
        # Backwards, regions are holes of the disc.
        points = np.concatenate([disc, holes.values[::-1]])
        offsets = np.concatenate([[0], len(disc) + np.cumsum([0, *holes.sizes[::-1]])])
        owner = np.zeros(len(offsets) - 1, dtype=np.intp)
        yield Polygons(points, offsets, owner, np.array([self.color]), chart.ball, self.name)


@dataclass(frozen=True, eq=False)
class Image:
    """A raster, as opaque as it is times `opacity`."""

    raster: Raster
    opacity: float
    name: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """The whole disc as one picture, warped when it is drawn."""
        painter = RasterOnDisc(self.raster, chart.lens, chart.view, chart.at, chart.scale, self.opacity)
        yield Picture(chart.outline, painter, self.name)


@dataclass(frozen=True, eq=False)
class Points:
    """Dots at unit vectors (n, 3)."""

    xyz: FloatArray
    style: DotStyle
    name: str

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Those whose middle is seen."""
        places, seen = chart.points(self.xyz)
        if seen.any():
            style = self.style
            yield Dots(places[seen], style.radius, style.color, style.rim, style.rim_width, self.name)


@dataclass(frozen=True, eq=False)
class Names:
    """Labels at unit vectors (n, 3), of which those farther ahead matter more."""

    xyz: FloatArray
    labels: tuple[Label, ...]
    on_ground: bool = False
    """Whether halos have the colour of the ground below, which `Globe.items` knows."""
    distance: float | None = None
    """From its place to a label that may stand on any side of it, points; None where it stands where it is."""

    def lay(self, chart: Chart) -> Iterator[Item]:
        """Those whose place is seen, inside the disc where there is room."""
        yield from self.beside(chart, ())

    def beside(self, chart: Chart, items: Sequence[Item]) -> Iterator[Label]:
        """As `lay`, beside what is on the chart already."""
        if self.distance is None:
            for label in self._seen(chart):
                yield within_disc(label, chart.at, chart.scale, chart.unit)
            return
        yield from placed_apart(
            self._seen(chart),
            self.distance,
            center=chart.at,
            radius=chart.scale,
            points_per_unit=chart.unit,
            before=[item for item in items if isinstance(item, Label)],
            dots=np.concatenate([np.zeros((0, 2)), *(item.centers for item in items if isinstance(item, Dots))]),
        )

    def _seen(self, chart: Chart) -> Iterator[Label]:
        places, seen = chart.points(self.xyz)
        for label, (x, y) in ((self.labels[k], places[k]) for k in np.flatnonzero(seen)):
            yield replace(label, anchor=(float(x), float(y)))
