"""`stereodel globe`: pictures and films of globes under conformal maps.

What people rarely type is in style files (`--style`), in the table itself, or in Python (`stereodel.globe`).
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from stereodel._arrays import FloatArray
    from stereodel.conformal import MoebiusMap
    from stereodel.curves.view import MapView
    from stereodel.drawing import DotStyle
    from stereodel.drawing.scene.legend import LegendEntry
    from stereodel.film.shots import Motion
    from stereodel.globe import Globe
    from stereodel.io import PointTable

EXAMPLE = "stereodel globe --focus=2.35,48.86 --magnify 20 -o paris.png"

FILMS = ("gif", "webp", "apng", "mp4")
SECONDS: Final = 10.0
"""Duration of a film that flies nowhere."""
FPS: Final = 25.0
GIF_FPS: Final = 12.5
"""Frames per second; of a GIF, whose frames are large."""
MAPS = ("land", "lakes", "graticule", "rivers", "coastlines", "borders")
"""What `--show` may name of the Earth, from the bottom up."""
GROUND = frozenset(MAPS[:2])
"""What of it fills regions."""
OF_POINTS = ("triangles", "cells", "points")
"""What it may name of the points."""
USUAL = "land,graticule,coastlines,cells,points"
LAYER_KEYS = ("color", "width", "outline", "size", "column", "id")
"""Of `--layer FILE,key=…`."""

Resolution = Literal["auto", "10m", "50m", "110m"]
Projection = Literal["globe", "stereographic", "hemispheres"]


@options.grouped
def command(
    *,
    output: options.File,
    points: Annotated[str | None, typer.Argument(metavar="POINTS", help="Table of points; - is stdin.")] = None,
    show: Annotated[
        str | None, typer.Option(metavar="NAMES", help=f"Of {', '.join(MAPS + OF_POINTS)}; or none. Else {USUAL}.")
    ] = None,
    focus: options.Focus = None,
    magnify: options.Magnify = 1.0,
    view: Annotated[
        str | None, typer.Option(metavar="LON,LAT", help="Centre; else the focus, or the middle of the points.")
    ] = None,
    projection: Annotated[Projection, typer.Option(help="A globe, or flat maps of half or all of it.")] = "globe",
    texture: Annotated[str | None, typer.Option(metavar="IMAGE", help="Image of the Earth; or blue-marble.")] = None,
    layer: Annotated[
        list[str] | None, typer.Option(metavar="FILE[,KEY=…]", help=f"Shapes; {', '.join(LAYER_KEYS)}; repeatable.")
    ] = None,
    resolution: Annotated[Resolution, typer.Option(help="Of the maps; auto suits the scale on the page.")] = "auto",
    labels: Annotated[str | None, typer.Option(metavar="COLUMN", help="Labels of points, as many as fit.")] = None,
    fly: Annotated[list[str] | None, typer.Option(metavar="LON,LAT", help="For films: fly there; repeatable.")] = None,
    valued: options.ValueOptions,
    picture: options.PictureOptions,
    columns: options.Table,
) -> None:
    """Draw a globe under a conformal fisheye, with maps, points and their cells, and layers from files.

    A film (.gif, .webp, .apng or .mp4) flies to places with --fly; otherwise the focus grows and shrinks again, or the
    globe makes one turn if nothing is magnified.
    """
    from stereodel.cli.application import reporting
    from stereodel.drawing import ColorScale
    from stereodel.io.formats.names import naming, note
    from stereodel.io.reading import shapes_of

    layers, styles = [layer_of(text) for text in layer or ()], picture.style or ()
    read_from = (points, texture, *(str(path) for path, _ in layers), *styles)
    destination = output.of(("png", "svg", "pdf", *FILMS), *read_from)
    filming = destination.kind in FILMS
    if points is None:
        of_points = {"--labels": labels, "--point-size": valued.point_size, "--point-color": valued.point_color}
        options.refuse({**of_points, **columns.given}, "POINTS; give a table")
    for name in styles:
        if name != "dark" and not name.lower().endswith(".toml"):
            raise ValueError(f"--style is {name!r}; give dark or a file .toml")
    if filming:
        options.refuse({"--style": styles}, "pictures, not for films")
    else:
        options.refuse({"--fly": fly}, f"films, but {output.out} is none; the endings are .{', .'.join(FILMS)}")
    at = None if focus is None else options.place(focus, "--focus")
    middle = None if view is None else options.place(view, "--view")
    aim = Aim(at, magnify, middle, projection)
    shown, table = shown_of(show, texture), None if points is None else columns.read(points)
    with reporting("reading maps"):
        contents = [(path, shapes_of(path), looks) for path, looks in layers]
        if show is None and (own := [str(path) for path, shapes, _ in contents if len(shapes.polygon_feature)]):
            shown -= {"land", "coastlines"}
            said = f"{', '.join(own)}: polygons replace the land and the coastlines of the package"
            note(f"{said}; --show={USUAL} draws them, too")
        drawing = new_globe(texture)
        drawing.title = picture.title
        for ground in (True, False):  # regions of layers lie on land and water, below all lines and points
            add_maps(drawing, shown & GROUND if ground else shown - GROUND, resolution, 15.0 if filming else None)
            for path, shapes, looks in contents:
                if ground == (len(shapes.polygon_feature) > 0):
                    with naming(str(path)):
                        drawing.add_layer(shapes, scale=valued.of if valued.given else None, **looks)
        if table is not None:
            aim = aim.with_middle_of(table.points("authalic"))
            add_points(drawing, table, shown, labels, valued)
        if not any(isinstance(entry, ColorScale) for entry in drawing.legend.values()):
            options.refuse(valued.given, "colours by value; name a column of numbers in --point-color or --layer")
        drawing.legend = renamed(drawing.legend, picture.legend_text or ())
    legend = picture.legend or bool(picture.legend_text)
    if filming:
        from stereodel.film import Film, FrameError

        motion, size = motion_of(aim, [options.place(text, "--fly") for text in fly or ()]), picture.size or 720
        rate = GIF_FPS if destination.kind == "gif" else FPS
        film = Film.of_globe(drawing, motion, size=(size, size), fps=rate, legend=legend)
        try:
            with destination.file() as target:
                film.save(target, progress=sys.stderr.isatty())
        except FrameError as error:
            raise OSError(str(error)) from error
        except KeyboardInterrupt:  # what is drawn is kept next to the file
            raise KeyboardInterrupt("interrupted; the same command draws the missing frames") from None
        return
    with reporting("drawing"), destination.file() as target:
        size = picture.size or 1600
        drawing.save(target, aim.lens, aim.views, style=styles, legend=legend, size=size)


@dataclass(frozen=True)
class Aim:
    """Focus, magnification, centre of the view and projection, with defaults for missing options."""

    focus: options.Place | None
    magnification: float
    middle: options.Place | None
    projection: Projection

    def with_middle_of(self, points: FloatArray) -> Aim:
        """The aim centred on the mean of unit vectors (n, 3), if they have one and no centre or focus was given."""
        import numpy as np

        from stereodel import xyz_to_lonlat
        from stereodel.constants import NO_MIDDLE

        mean = points.sum(axis=0)
        if self.middle or self.focus or np.sqrt(np.sum(mean**2)) <= NO_MIDDLE * len(points):
            return self
        lon, lat = xyz_to_lonlat(mean)
        return replace(self, middle=(float(lon), float(lat)))

    @property
    def place(self) -> options.Place:
        """The focus, which is also the default centre of the view."""
        return self.focus or self.middle or (0.0, 0.0)

    @property
    def lens(self) -> MoebiusMap:
        """The fisheye; the identity for magnification 1, whatever the focus."""
        from stereodel import MoebiusMap, fisheye

        if self.magnification == 1:
            return MoebiusMap.identity()
        return fisheye(self.place, magnification=self.magnification)

    @property
    def views(self) -> tuple[MapView, ...]:
        """One view, or two side by side."""
        from stereodel.drawing import StereographicView, View
        from stereodel.globe import hemispheres

        lon, lat = self.middle or self.place
        if self.projection == "hemispheres":
            return hemispheres(lon, lat, flat=True)
        return (View(lon, lat) if self.projection == "globe" else StereographicView(lon, lat),)


def shown_of(text: str | None, texture: str | None) -> frozenset[str]:
    """What `--show` names."""
    names = (USUAL if text is None else text).split(",") if text != "none" else []
    known = MAPS + OF_POINTS
    if unknown := [name for name in names if name not in known]:
        raise ValueError(f"--show has {unknown[0]!r}; the names are {', '.join(known)}, separated by commas, or none")
    return frozenset(names) - ({"land"} if text is None and texture else set())


def new_globe(texture: str | None) -> Globe:
    """A globe, with an image if there is one."""
    from stereodel.data import blue_marble
    from stereodel.globe import Globe

    globe = Globe(latitude="authalic")
    if texture is not None:
        globe.add_raster(blue_marble() if texture == "blue-marble" else texture)
    return globe


def add_maps(globe: Globe, shown: frozenset[str], resolution: str, spacing: float | None) -> None:
    """Maps of the Earth from the bottom up; a graticule that suited each frame of a film, by None, would flicker."""
    for name in (name for name in MAPS if name in shown):
        given: dict[str, Any] = {"spacing": spacing} if name == "graticule" else {"resolution": resolution}
        getattr(globe, f"add_{name}")(**given)


def layer_of(text: str) -> tuple[Path, dict[str, Any]]:
    """The file and the arguments of `Globe.add_layer` that ``FILE,color=…,width=…`` stands for.

    An existing file whose name contains commas and equals signs is taken literally.
    """
    from stereodel.drawing.page.colors import as_color
    from stereodel.drawing.page.style import MAP_DOT, MAP_LINES, as_length

    path, *given = [text] if Path(text).exists() else re.split(r",(?=\w+=)", text)
    looks = dict(part.split("=", 1) for part in given)
    if unknown := [key for key in looks if key not in LAYER_KEYS]:
        raise ValueError(f"--layer {text}: {unknown[0]} is unknown; the keys are {', '.join(LAYER_KEYS)}")
    columns = {"column": looks.pop("column", None), "id_column": looks.pop("id", None)}
    bare = looks.get("outline") == "none" and bool(looks.pop("outline"))
    readers: dict[str, Any] = {"color": as_color, "outline": as_color, "width": as_length, "size": as_length}
    read = {key: readers[key](value, f"--layer: {key}") for key, value in looks.items()}
    color, width = ({of: read[of] for of in read if of == key} for key in ("color", "width"))
    edge = {"color": read["outline"]} if "outline" in read else {}
    radius = read.get("size", 2 * MAP_DOT.radius) / 2
    return Path(path), {
        **color,
        "outline": None if bare else replace(MAP_LINES["outline"], **width, **edge),
        "style": replace(MAP_LINES["line"], **color, **width),
        "dot_style": replace(MAP_DOT, **color, radius=radius, rim_width=min(MAP_DOT.rim_width, radius / 3)),
        **columns,
        "legend": columns["column"] or Path(path).stem,
    }


def renamed(legend: dict[str, LegendEntry], texts: Sequence[str]) -> dict[str, LegendEntry]:
    """A legend with other texts, as ``NAME=TEXT``."""
    given = dict(text.partition("=")[::2] for text in texts)
    if unknown := [name for name in given if name not in legend]:
        raise ValueError(f"--legend-text names {unknown[0]!r}, but the entries are {', '.join(legend) or 'none'}")
    return {given.get(name, name): entry for name, entry in legend.items()}


def of_column(table: PointTable, text: str, option: str, reader: Callable[[str, str], Any]) -> tuple[Any, str]:
    """What an option says: the values of a column and its name, or what else is read of its text and no name."""
    if text not in table.columns:
        try:
            return reader(text, option), ""
        except ValueError as error:
            raise ValueError(f"{error}; or a column: {', '.join(table.columns) or 'there is none'}") from None
    column = table.column(text)
    return (column if column.dtype.kind in "OU" else table.numbers(text)), text


def looks_of(table: PointTable, valued: options.ValueOptions, dots: DotStyle) -> dict[str, Any]:
    """How points look, as `Globe.add_points` takes it."""
    from stereodel.drawing.page.colors import as_color
    from stereodel.drawing.page.style import MAP_DOT, as_length

    looks: dict[str, Any] = {"style": dots, "legend": Path(table.name).stem}
    if valued.point_size is not None:
        size, title = of_column(table, valued.point_size, "--point-size", as_length)
        looks |= {"size": size, "size_legend": title} | ({"style": MAP_DOT, "legend": ""} if title else {})
    if valued.point_color is not None:
        color, title = of_column(table, valued.point_color, "--point-color", as_color)
        scale = valued.of if valued.given else None
        looks |= {"values": color, "legend": title, "scale": scale} if title else {"color": color}
    return looks


def add_points(
    globe: Globe, table: PointTable, shown: frozenset[str], labels: str | None, valued: options.ValueOptions
) -> None:
    """Draw points, the ridges of their cells, the edges of their triangles, and labels; finer where there are many."""
    import numpy as np

    from stereodel import SphericalDelaunay, SphericalVoronoi
    from stereodel.drawing.page.style import DOTS, LINES

    places = table.points("authalic")
    weight = max(0.2, min(1.0, float(np.sqrt(500 / max(1, len(places))))))  # so that cells stay visible
    triangulation = SphericalDelaunay(places)
    edges, ridges = (LINES[name].scaled(weight) for name in ("delaunay", "voronoi"))
    dots = DOTS["sites"].scaled(weight)
    if "triangles" in shown:
        globe.add_triangulation(triangulation, style=edges, name="delaunay")
        globe.legend["triangles"] = edges
    if "cells" in shown:
        globe.add_cells(SphericalVoronoi(triangulation), style=ridges, name="voronoi")
        globe.legend["cells"] = ridges
    if "points" not in shown:
        given = {"--point-size": valued.point_size, "--point-color": valued.point_color}
        options.refuse(given, "points; name them in --show, too")
    else:
        globe.add_points(table.places, name="sites", **looks_of(table, valued, dots))
    if labels is not None:
        texts = ["" if value is None else str(value).strip() for value in table.column(labels).tolist()]
        named = [k for k, text in enumerate(texts) if text not in ("", "nan")]
        globe.add_labels(table.places[named], [texts[k] for k in named], movable=True)


def motion_of(aim: Aim, stops: Sequence[options.Place]) -> Motion:
    """A flight if there are stops, a turn if nothing is magnified, otherwise a growing lens."""
    from stereodel import MoebiusMap
    from stereodel.conformal import GroupPath
    from stereodel.film import Flight, Morph, Spin, Stop

    grows = aim.magnification != 1 and not stops
    if aim.projection == "hemispheres" or (aim.projection != "globe" and not grows):
        raise ValueError(f"--projection {aim.projection} cannot move; films are of the globe")
    if grows:
        return Morph(GroupPath(MoebiusMap.identity(), aim.lens), aim.views[0], seconds=SECONDS, back=True)
    if stops:
        return Flight([Stop(place, aim.magnification) for place in (aim.place, *stops)])
    lon, lat = aim.middle or aim.place
    return Spin(aim.lens, seconds=SECONDS, lon=lon, lat=lat)
