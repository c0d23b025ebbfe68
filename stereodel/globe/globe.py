"""Globes: layered maps of the sphere, drawn through any lens and from any side."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from numbers import Real
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import (
    FloatArray,
    Pixels,
    as_choice,
    as_count,
    as_directions,
    as_lonlat,
    as_scalar,
    as_steps,
    as_values,
)
from stereodel._extras import of_extra
from stereodel._notebook import Displayed, drawn
from stereodel.conformal import MoebiusMap
from stereodel.curves.chart import Chart
from stereodel.curves.view import MapView
from stereodel.drawing.page import Item, Label, Page, picture_extra
from stereodel.drawing.page.colors import ColorLike, as_color, as_colors
from stereodel.drawing.page.fonts import FontLike, as_font, filled
from stereodel.drawing.page.items import Tags
from stereodel.drawing.page.labels import with_title
from stereodel.drawing.page.page import LARGEST_SIZE
from stereodel.drawing.page.placing import Placer, placed_label
from stereodel.drawing.page.scales import SizeScale
from stereodel.drawing.page.sheets import Style, styled
from stereodel.drawing.page.style import (
    BLACK,
    HALO,
    LABEL_SIZE,
    MAP_DOT,
    MAP_FILLS,
    MAP_LINES,
    PRINT_DPI,
    PRINT_WIDTH,
    WHITE,
    DotStyle,
    LengthLike,
    LineStyle,
    as_length,
)
from stereodel.drawing.scene.by_value import DotLooks, ScaleLike
from stereodel.drawing.scene.legend import LegendEntry, described, with_legend
from stereodel.globe.layers import (
    AUTO,
    FINE,
    RESOLUTIONS,
    Areas,
    GridLines,
    Ground,
    Image,
    Limb,
    LineLayer,
    MapLayer,
    Names,
    OfEarth,
    Points,
    radii,
)
from stereodel.globe.outlines_on_sphere import Rings, SphereLines, SphereRegions
from stereodel.globe.pages import Panel, default_view, panels
from stereodel.globe.raster import Raster
from stereodel.io.reading import shapes_of
from stereodel.io.rows_of import ridge_net
from stereodel.sphere import SphereCircle, lonlat_to_xyz
from stereodel.sphere.latitudes import KINDS, Latitude
from stereodel.sphere.vectors import units
from stereodel.triangulation import SphericalDelaunay, SphericalVoronoi


class Globe(Displayed):
    """A map of the sphere in layers, the first at the bottom, drawn through a conformal lens from any side.

    Layers are added once; each picture then has its own view and, optionally, a lens.

    Parameters
    ----------
    ocean : color-like
        Colour of the ground, in any form that matplotlib accepts.
    latitude : {"spherical", "geodetic", "authalic"}
        Kind of all latitudes passed to this globe; see `stereodel.lonlat_to_xyz`. "spherical" uses them unchanged, as
        map projections of a sphere do.
    limb : LineStyle, optional
        Style of the edge of the globe.
    font : str, path-like, or sequence of them, optional
        Font families or font files; by default STIX, a serif. Fonts of the system supply characters that these lack;
        see `stereodel.drawing.page.fonts.as_font`.
    title : str
        Title above pictures, in matplotlib's mathtext.

    Attributes
    ----------
    legend : dict of str to LineStyle, DotStyle, color-like, ColorScale or SizeScale
        Entries of the legend below pictures: descriptions with what they describe. What is coloured or sized by value
        is added automatically; other entries may be added.

    Examples
    --------
    >>> from stereodel import fisheye
    >>> globe = Globe()
    >>> globe.add_land(resolution="110m")
    >>> globe.add_graticule(30)
    >>> page = globe.page(fisheye((2.35, 48.86), magnification=20.0))
    >>> [type(item).__name__ for item in page.items]
    ['Fill', 'Polygons', 'Polylines', 'Stroke']
    """

    _mimes = drawn(lambda it: it.page(width=340.0, tolerance=0.2, legend=True))

    def __init__(
        self,
        *,
        ocean: ColorLike = MAP_FILLS["ocean"],
        latitude: Latitude = "spherical",
        limb: LineStyle = MAP_LINES["limb"],
        font: FontLike | None = None,
        title: str = "",
    ) -> None:
        self.latitude: Latitude = as_choice(latitude, KINDS, "latitude")
        self.layers: list[MapLayer] = [Ground(as_color(ocean, "ocean"))]
        self.limb = Limb(limb)
        self.font = as_font(font)
        self.title = title
        self.legend: dict[str, LegendEntry] = {}

    def add(self, layer: MapLayer) -> None:
        """Put any layer on top: an object whose method ``lay(chart)`` returns page items."""
        self.layers.append(layer)

    def add_raster(
        self,
        raster: Raster | Pixels | str | os.PathLike[str],
        *,
        bounds: tuple[float, float, float, float] | None = None,
        opacity: float = 1.0,
        name: str = "raster",
    ) -> None:
        """Cover the globe, or part of it, with an image in longitude and latitude.

        Parameters
        ----------
        raster : Raster, pixels as for `Raster`, or path-like
            Layers below show through transparent pixels. Arrays and files use the kind of latitude of this globe, a
            `Raster` its own.
        bounds : tuple of float, optional
            Of an array or file, as for `Raster`.
        opacity : float
            In [0, 1], multiplied with that of pixels.
        name : str
            Name of the image in vector files.

        Raises
        ------
        OSError, ValueError
            As for `Raster` and `Raster.open`; also if `opacity` is out of range, or `bounds` are given with a `Raster`.
        """
        if isinstance(raster, Raster) and bounds is not None:
            raise ValueError("bounds belong to pixels and files; a Raster has its own")
        if isinstance(raster, np.ndarray):
            raster = Raster(raster, bounds, latitude=self.latitude)
        if not isinstance(raster, Raster):
            raster = Raster.open(raster, bounds=bounds, latitude=self.latitude)
        self.add(Image(raster, as_scalar(opacity, "opacity", low=0.0, high=1.0), name))

    def add_land(
        self, *, color: ColorLike = MAP_FILLS["land"], outline: LineStyle | None = None, resolution: str = AUTO
    ) -> None:
        """Fill the land of the Earth (Natural Earth), and draw its outline if a style is given.

        A resolution of the Earth's maps is "10m", "50m", "110m", or "auto", which suits the largest scale on each page.
        """
        self._add_earth("land", resolution, {"land": color, "land-outline": outline})

    def add_ocean(self, *, color: ColorLike = MAP_FILLS["ocean"], resolution: str = AUTO) -> None:
        """Fill everything but the land of the Earth (Natural Earth); layers below then show on land only."""
        self._add_earth("land", resolution, {"ocean": color})

    def add_lakes(
        self, *, color: ColorLike = MAP_FILLS["ocean"], outline: LineStyle | None = None, resolution: str = AUTO
    ) -> None:
        """Fill the lakes of the Earth (Natural Earth)."""
        self._add_earth("lakes", resolution, {"lakes": color, "lakes-outline": outline})

    def add_rivers(self, *, style: LineStyle = MAP_LINES["rivers"], resolution: str = AUTO) -> None:
        """Draw the large rivers of the Earth (Natural Earth)."""
        self._add_earth("rivers", resolution, {"rivers": style})

    def add_coastlines(self, *, style: LineStyle = MAP_LINES["coast"], resolution: str = AUTO) -> None:
        """Draw the coastlines of the Earth (Natural Earth)."""
        self._add_earth("coastlines", resolution, {"coast": style})

    def add_borders(self, *, style: LineStyle = MAP_LINES["borders"], resolution: str = AUTO) -> None:
        """Draw the borders between the countries of the Earth (Natural Earth)."""
        self._add_earth("borders", resolution, {"borders": style})

    def add_graticule(self, spacing: float | None = 15.0, *, style: LineStyle = MAP_LINES["graticule"]) -> None:
        """Draw meridians and parallels, `spacing` degrees apart, which must divide 180.

        With None the spacing suits each picture: about twelve lines across the visible part. Where neighbouring lines
        would be less than three line widths apart, as near the poles, some of them end.
        """
        if spacing is not None:
            as_steps(180.0, spacing, "spacing")
        self.add(GridLines(spacing, self.latitude, style))

    def add_lines(
        self,
        lines: Iterable[npt.ArrayLike],
        *,
        style: LineStyle = MAP_LINES["line"],
        name: str = "lines",
        ids: Iterable[object] | None = None,
    ) -> None:
        """Draw lines, (k, 2) each, in degrees, whose segments are straight in longitude and latitude.

        A segment that spans more than 180° of longitude takes the shorter way, across ±180°. With `ids`, a text for
        each, lines are paths with these ids in SVG.
        """
        rows = list(lines)
        self._add_lines(rows, style, name, Tags.of({"id": ids}, len(rows)))

    def add_great_circles(
        self, starts: npt.ArrayLike, ends: npt.ArrayLike, *, style: LineStyle = MAP_LINES["line"], name: str = "arcs"
    ) -> None:
        """Draw the shorter great-circle arcs between places as for `add_points`; one start may serve all ends."""
        first, last = np.broadcast_arrays(self._xyz(starts, "starts"), self._xyz(ends, "ends"))
        self.add(LineLayer(SphereLines.great(first, last), style, name))

    def add_polygons(
        self,
        polygons: Iterable[Rings],
        *,
        color: ColorLike | npt.ArrayLike = MAP_FILLS["area"],
        outline: LineStyle | None = MAP_LINES["outline"],
        name: str = "areas",
        ids: Iterable[object] | None = None,
    ) -> None:
        """Fill polygons given by rings in degrees, the outer one first.

        Parameters
        ----------
        polygons : iterable of sequences of (k, 2) array_like
            Rings of each polygon; sides are straight in longitude and latitude, as in GeoJSON. A ring may cross ±180°,
            be cut there, or enclose a pole.
        color : color-like, (n, 3) or (n, 4) array
            Colour of all polygons, or of each.
        outline : LineStyle, optional
            Style of outlines; None for no outlines.
        name : str
            Name of the group in vector files.
        ids : iterable, optional
            A text for each polygon. In SVG polygons are then paths with these ids, in the form of names in XML and made
            unique, and the texts as they are in ``data-id``; without, those of a colour are one path, and those of many
            colours an image.
        """
        regions = SphereRegions.of_lonlat(polygons, latitude=self.latitude)
        self._add_polygons(regions, color, outline, name, Tags.of({"id": ids}, regions.count))

    def add_points(
        self,
        places: npt.ArrayLike,
        *,
        size: LengthLike | npt.ArrayLike | None = None,
        color: ColorLike | npt.ArrayLike | None = None,
        values: npt.ArrayLike | None = None,
        scale: ScaleLike | None = None,
        legend: str = "",
        size_scale: SizeScale | None = None,
        size_legend: str = "",
        style: DotStyle = MAP_DOT,
        name: str = "points",
        ids: Iterable[object] | None = None,
    ) -> None:
        """Draw dots at places, in degrees (n, 2) or as directions (n, 3), all alike or by value.

        Parameters
        ----------
        places : array_like
        size : float, str or (n,) array_like, optional
            Diameter of all dots, in points or with a unit, such as "2mm"; or amounts, to which the areas of dots are in
            proportion. Of amounts that are negative or missing nothing is drawn, and a `DataWarning` says so. Smaller
            dots lie on larger ones, half transparent if all have one colour.
        color : color-like, sequence of them or array, optional
            Colour of all dots, or of each; by default that of `style`.
        values : (n,) array_like, optional
            In place of `color`: numbers that a scale turns into the colours of dots, NaN where one is missing; or
            words, at most eight different ones.
        scale : ColorScale, or function of values that returns one, optional
            By default `ColorScale.of`.
        legend : str
            Title of the scale in the legend, with its unit, such as "area, km²"; without values, the entry of the dots.
        size_scale : SizeScale, optional
            By default one in which the largest dot has a diameter of 24 points.
        size_legend : str
            Title of the sizes in the legend.
        style : DotStyle
            Radius, colour and rim of dots without a size or colour of their own.
        name : str
            Name of the dots in vector files.
        ids : iterable, optional
            Names of the dots in SVG, as for `add_polygons`.

        Examples
        --------
        >>> globe = Globe()
        >>> globe.add_points([(2.4, 48.9), (13.4, 52.5)], size=[11.2e6, 6.1e6], size_legend="people", color="teal")
        >>> print(globe.legend["people"].description)
        areas of dots in proportion to the amount, 11.2 M the largest
        """
        xyz = self._xyz(places, "places")
        looks = DotLooks.of(len(xyz), style, size, color, values, scale, legend, size_scale, size_legend)
        self.legend |= looks.entries
        self.add(Points(xyz, looks, name, Tags.of({"id": ids}, len(xyz))))

    def add_labels(
        self,
        places: npt.ArrayLike,
        texts: Iterable[str],
        *,
        offset: tuple[float, float] = (4.0, 0.0),
        size: float = LABEL_SIZE,
        color: ColorLike | tuple[ColorLike, ColorLike] = (BLACK, WHITE),
        halo: float = HALO,
        halo_color: ColorLike | None = None,
        font: FontLike | None = None,
        formulas: bool = False,
        rank: npt.ArrayLike | None = None,
        movable: bool | LineStyle = False,
    ) -> None:
        """Write labels with halos at places as for `add_points`, shifted by `offset` points; the first have priority.

        With `rank`, numbers (n,), labels with larger numbers have priority. A label that would overlap one of higher
        priority is left out, and so is one whose place is not visible; a label that would leave the disc moves to
        another side of its place with room. A `movable` label stands on the side of its place where it hides least of
        dots and lines, at the distance given by `offset`, and beyond a dot at the place; with (0, 0) it moves a little
        from its place. A `LineStyle` as `movable` also leads to labels farther away, by lines that never meet; see
        `stereodel.drawing.page.placing`. In films each label keeps its side while it fits, and has no such lines.

        Of two colours, the one that contrasts more with the ground below the words is the ink. Without `halo_color`,
        halos have the colour of this ground at 80 % opacity, or where it has several, their mean at 60 %; lighter or
        darker as type needs it.

        Labels may be in any script, see `Globe` on fonts; `font` replaces the globe's, or is a face of it: "bold",
        "italic" or "bold italic". With `formulas`, text between two dollar signs is a formula in matplotlib's mathtext.
        """
        xyz = self._xyz(places, "places")
        given: Any = color
        two = isinstance(given, tuple | list) and len(given) == 2 and not isinstance(given[1], Real)  # no opacity
        inks = tuple(map(as_color, given if two else (given,)))
        paper = WHITE if halo_color is None else as_color(halo_color, "halo_color")
        bare = Label("", (0.0, 0.0), size=size, color=inks[0], halo=halo, halo_color=paper, formulas=formulas)
        bare = replace(bare, on_ground=halo_color is None, inks=inks if len(inks) > 1 else ())
        bare = replace(bare, font=filled(as_font(font), self.font))
        labels = tuple(placed_label(replace(bare, text=text), offset) for text in texts)
        if len(labels) != len(xyz):
            raise ValueError(f"texts has {len(labels)} entries, but there are {len(xyz)} places")
        if rank is not None:
            numbers = as_values(rank, len(xyz), "rank")
            # Labels without a number have the lowest priority.
            order = np.argsort(-np.where(np.isnan(numbers), -np.inf, numbers), kind="stable")
            xyz, labels = xyz[order], tuple(labels[k] for k in order.tolist())
        distance = float(np.hypot(*offset)) if movable else None
        self.add(Names(xyz, labels, distance, movable if isinstance(movable, LineStyle) else None))

    def add_cells(
        self,
        voronoi: SphericalVoronoi,
        *,
        colors: npt.ArrayLike | None = None,
        style: LineStyle | None = MAP_LINES["line"],
        name: str = "cells",
        ids: Iterable[object] | None = None,
    ) -> None:
        """Draw the ridges of a Voronoi diagram; fill its cells if colours (n, 3) or (n, 4) are given.

        Filled cells may have `ids` in SVG, as for `add_polygons`.
        """
        if colors is not None:
            cells = SphereRegions.cells(voronoi)
            self.add(Areas(cells, as_colors(colors, cells.count), name, Tags.of({"id": ids}, cells.count)))
        if style is not None:
            self.add(LineLayer(SphereLines.alone(ridge_net(voronoi).arcs()), style, name))

    def add_triangulation(
        self,
        triangulation: SphericalDelaunay,
        *,
        colors: npt.ArrayLike | None = None,
        style: LineStyle | None = MAP_LINES["line"],
        name: str = "triangles",
    ) -> None:
        """Draw the edges of a triangulation; fill triangles, except closing ones, if colours (m, 3 or 4) are given."""
        if colors is not None:
            triangles = SphereRegions.triangles(triangulation)
            self.add(Areas(triangles, as_colors(colors, len(triangulation.simplices)), name))
        if style is not None:
            starts, ends = units(triangulation.points)[triangulation.edges].transpose(1, 0, 2)
            self.add(LineLayer(SphereLines.great(starts, ends), style, name))

    def add_circles(
        self,
        circles: Iterable[SphereCircle],
        *,
        color: ColorLike | None = MAP_FILLS["circle"],
        style: LineStyle = MAP_LINES["outline"],
        name: str = "circles",
    ) -> None:
        """Draw circles of the sphere and fill their interiors; their images are exact circles."""
        regions = SphereRegions.circles(circles)
        if color is not None:
            self.add(Areas(regions, as_colors(color, regions.count, "color"), name))
        self.add(LineLayer(regions.outlines, style, name))

    def add_tissot(
        self,
        spacing: float = 30.0,
        radius: float = 4.0,
        *,
        color: ColorLike | None = MAP_FILLS["circle"],
        style: LineStyle = MAP_LINES["outline"],
    ) -> None:
        """Draw Tissot's indicatrices: equal circles of `radius` degrees, on parallels `spacing` degrees apart."""
        steps = as_steps(180.0, spacing, "spacing")
        size = as_scalar(radius, "radius", low=0.0, high=90.0, open_low=True)
        places = []
        for lat in np.arange(steps + 1) * (180.0 / steps) - 90.0:
            count = max(1, round(2 * steps * float(np.cos(np.radians(lat)))))
            places += [(360.0 * k / count - 180.0, lat) for k in range(count)]
        xyz = lonlat_to_xyz(places, latitude=self.latitude)
        self.add_circles([SphereCircle.around(place, size) for place in xyz], color=color, style=style, name="tissot")

    def add_layer(
        self,
        source: Any,
        *,
        color: ColorLike = MAP_FILLS["area"],
        column: str | None = None,
        scale: ScaleLike | None = None,
        outline: LineStyle | None = MAP_LINES["outline"],
        style: LineStyle = MAP_LINES["line"],
        dot_style: DotStyle = MAP_DOT,
        name: str = "layer",
        legend: str = "",
        id_column: str | None = None,
    ) -> None:
        """Draw the contents of a file or table of shapes: polygons, lines above them, points on top.

        Parameters
        ----------
        source : path-like, mapping, or object with __geo_interface__
            A GeoJSON file or object; any other file that GeoPandas reads; a GeoDataFrame or Shapely geometry. What
            names another coordinate system (GeoJSON by a member ``crs``) is transformed to degrees.
        color : color-like
            Colour of polygons without a column.
        column : str, optional
            Property by which polygons, lines and points are coloured, numbers or words as the `values` of `add_points`.
        scale : ColorScale, or function of values that returns one, optional
            By default `ColorScale.of`.
        outline, style, dot_style : LineStyle, LineStyle, DotStyle
            Styles of the polygons' outlines (None for no outlines; by default white with a column), the lines and the
            points.
        name : str
            Name of the groups in vector files.
        legend : str
            Entry in the legend; of a column of numbers the title of its scale, by default the name of the column.
        id_column : str, optional
            Property by which SVG names the shapes, as by the `ids` of `add_polygons`; the values of `id_column` and
            `column` are there as they are, in ``data-name`` of a column NAME.

        Raises
        ------
        OSError
            If a file cannot be read.
        ValueError
            If the source is not valid GeoJSON, a latitude is outside [−90, 90], the column does not exist or has more
            than eight different texts.
        """
        shapes = shapes_of(source)
        count, entry = len(shapes.properties), legend or column or ""
        values: Any = None if column is None else shapes.words(column) or shapes.column(column)
        looks = DotLooks.of(count, dot_style, values=values, scale=scale, legend=entry)
        colors = looks.colors
        keys = (id_column, column) if id_column is not None else ()
        tags = Tags.of({key: shapes.values(key) for key in keys if key is not None}, count)
        if len(shapes.polygon_feature):
            owners = shapes.polygon_feature
            polygons = SphereRegions.of_lonlat(shapes.polygons, owners=owners, latitude=self.latitude)
            if column is not None and outline == MAP_LINES["outline"]:
                outline = MAP_LINES["parting"]
            own = as_colors(color, count, "color") if colors is None else colors
            self._add_polygons(polygons, own[: polygons.count], outline, name, tags)
        if len(shapes.lines):
            of_lines = None if colors is None else colors[shapes.line_feature]
            self._add_lines(list(shapes.lines), style, name, tags and tags.some(shapes.line_feature), of_lines)
        if len(shapes.points):
            of_points = None if colors is None else colors[shapes.point_feature]
            named = tags and tags.some(shapes.point_feature)
            self.add(Points(self._xyz(shapes.points, "places"), replace(looks, colors=of_points), name, named))
        self.legend |= looks.entries
        if legend and colors is None and len(shapes.polygons) + len(shapes.lines):
            self.legend[legend] = as_color(color) if len(shapes.polygons) else style

    def items(self, chart: Chart) -> tuple[Item, ...]:
        """The page items of a chart, in painter's order; names are placed when all else is there."""
        layers = (*self.layers, self.limb)
        items = [[] if isinstance(layer, Names) else list(layer.lay(chart)) for layer in layers]
        placer, dots = Placer(chart, [item for some in items for item in some]), radii(self.layers)
        for layer, some in zip(layers, items, strict=True):
            if isinstance(layer, Names):
                some += layer.beside(chart, placer, dots)
        return tuple(item for some in items for item in some)

    def page(
        self,
        lens: MoebiusMap | None = None,
        view: MapView | Sequence[MapView] | None = None,
        *,
        width: LengthLike = PRINT_WIDTH,
        tolerance: float = FINE,
        style: Style | Sequence[Style] = (),
        legend: bool = False,
    ) -> Page:
        """A picture of the globe as a page, to be written as pixels or vector paths.

        Parameters
        ----------
        lens : MoebiusMap, optional
            By default the identity.
        view : View, StereographicView or a sequence of them, optional
            By default orthographic from above the focus of the lens; several views, such as `hemispheres`, are placed
            side by side.
        width : float or str
            Width of the page in points, or with a unit, such as "17cm"; line widths and type keep their size in points.
        tolerance : float
            Largest deviation of the drawing from the exact image, in points.
        style : str, path-like, or sequence of them
            Styles for `stereodel.drawing.styled`: "dark", or TOML files.
        legend : bool
            Whether to draw `Globe.legend` below the picture.
        """
        bend = MoebiusMap.identity() if lens is None else lens
        views = view if isinstance(view, Sequence) else [default_view(bend) if view is None else view]
        contents = [Panel(self, bend, each) for each in views]
        page = with_title(panels(contents, width=as_length(width, "width"), tolerance=tolerance), self.title)
        page = self.told(page) if legend else described(page, self.legend)
        return styled(page, *([style] if isinstance(style, str | os.PathLike) else style), font=self.font)

    def told(self, page: Page) -> Page:
        """The page with `Globe.legend` below it."""
        return with_legend(page, self.legend, columns=3, indent=24.0) if self.legend else page

    def save(
        self,
        path: str | os.PathLike[str],
        lens: MoebiusMap | None = None,
        view: MapView | Sequence[MapView] | None = None,
        *,
        size: int = 2000,
        width: LengthLike = PRINT_WIDTH,
        style: Style | Sequence[Style] = (),
        legend: bool = False,
        transparent: bool = False,
    ) -> Path:
        """Write a picture as PNG, SVG or PDF, by the extension of `path`; see `page`.

        Parameters
        ----------
        path : path-like
            File to write, first under a temporary name; an existing file is replaced.
        lens, view, width, style, legend
            As for `page`.
        size : int
            Width of a PNG in pixels, at most 65 535, with curves accurate to a twelfth of a pixel.
        transparent : bool
            Whether to make the background of the page transparent.

        Raises
        ------
        OSError
            If the file cannot be written, or there is no OpenGL for a PNG.
        ValueError
            If the extension is unknown; also as for `page`.
        """
        wide, pixels = as_length(width, "width"), as_count(size, "size", high=LARGEST_SIZE)
        tolerance = FINE * min(1.0, PRINT_DPI / 72 * wide / pixels)
        with of_extra(picture_extra(Path(path).suffix)):
            page = self.page(lens, view, width=wide, tolerance=tolerance, style=style, legend=legend)
            return page.save(path, size=pixels, transparent=transparent)

    def _xyz(self, places: npt.ArrayLike, name: str) -> FloatArray:
        """Unit vectors from places in degrees, (n, 2), or directions, (n, 3); a single place may be one-dimensional."""
        rows = np.atleast_2d(np.asarray(places))
        if rows.shape[-1] == 3:
            return units(as_directions(rows, name, points=True))
        return lonlat_to_xyz(as_lonlat(rows, name), latitude=self.latitude)

    def _add_earth(self, what: str, resolution: str, looks: Mapping[str, LineStyle | ColorLike | None]) -> None:
        as_choice(resolution, (AUTO, *RESOLUTIONS), "resolution")
        for name, look in looks.items():
            if look is not None:
                drawn = look if isinstance(look, LineStyle) else as_color(look)
                self.add(OfEarth(what, self.latitude, drawn, name, resolution))

    def _add_lines(
        self,
        lines: Sequence[npt.ArrayLike],
        style: LineStyle,
        name: str,
        tags: Tags | None,
        colors: FloatArray | None = None,
    ) -> None:
        """Lines in one colour, or in colours (n, 4), those of one colour together."""
        several, which = np.unique(np.array([style.color]) if colors is None else colors, axis=0, return_inverse=True)
        told = () if colors is None else ("color",)
        long = np.array([np.size(line) > 2 for line in lines], dtype=bool)
        for k, color in enumerate(several):
            rows = np.flatnonzero(np.broadcast_to(which.ravel() == k, len(lines)))
            some = SphereLines.straight_in_lonlat([lines[row] for row in rows.tolist()], self.latitude)
            tagged = tags and tags.some(rows[long[rows]])
            self.add(LineLayer(some, replace(style, color=as_color(color)), name, told, tagged))

    def _add_polygons(
        self,
        regions: SphereRegions,
        color: ColorLike | npt.ArrayLike,
        outline: LineStyle | None,
        name: str,
        tags: Tags | None = None,
    ) -> None:
        self.add(Areas(regions, as_colors(color, regions.count, "color"), name, tags))
        if outline is not None:
            self.add(LineLayer(regions.outlines, outline, f"{name}-outline"))
