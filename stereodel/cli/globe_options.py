"""The options of `stereodel globe` with their help."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer


class Show(StrEnum):
    """What to draw for the points."""

    points = "points"
    cells = "cells"
    triangles = "triangles"


class Projection(StrEnum):
    """Projections of the sphere to the page."""

    globe = "globe"
    stereographic = "stereographic"
    hemispheres = "hemispheres"


Points = Annotated[
    str | None,
    typer.Argument(metavar="[POINTS]", help="Table of points: .csv, .geojson, .parquet, .gpkg; - for stdin."),
]
Shows = Annotated[
    list[Show] | None,
    typer.Option("--show", help="What to draw for the points, repeatable; by default points and cells."),
]
Focus = Annotated[
    str | None, typer.Option(metavar="LON,LAT", help="Focus of the fisheye; by default the centre of the picture.")
]
Magnify = Annotated[float, typer.Option(metavar="S", help="Magnification at the focus.")]
View = Annotated[
    str | None,
    typer.Option(metavar="LON,LAT", help="Centre of the picture; by default the focus, else the centre of the points."),
]
Flattened = Annotated[
    Projection, typer.Option("--projection", help="A globe, a stereographic map, or maps of both hemispheres.")
]
AngularRadius = Annotated[float, typer.Option(metavar="DEGREES", help="Angular radius of a stereographic map.")]
Layers = Annotated[
    list[str] | None,
    typer.Option(
        "--layer",
        metavar="FILE[,color=…,width=…]",
        help="Points, lines or polygons to draw: .geojson, .gpkg …, with color, width, outline, size or column; "
        "repeatable.",
    ),
]
Labels = Annotated[
    str | None,
    typer.Option(metavar="COLUMN", help="Labels of the points, as many as fit, in the order of the rows."),
]
Rank = Annotated[str | None, typer.Option(metavar="COLUMN", help="Priority of labels, a number; the largest first.")]
PointColor = Annotated[
    str | None,
    typer.Option("--color", metavar="COLOR", help="Colour of the points: a name, or #rrggbb."),
]
PointSize = Annotated[
    str | None,
    typer.Option(metavar="LENGTH", help="Diameter of the points: 3pt, 1mm; by default chosen by their number."),
]
Title = Annotated[str, typer.Option(metavar="TEXT", help="Title above the picture.")]
Legend = Annotated[bool, typer.Option("--legend", help="Explain points and layers below the picture.")]
Styles = Annotated[
    list[str] | None,
    typer.Option("--style", metavar="STYLE", help="dark, or a .toml file of styles; repeatable."),
]
Width = Annotated[str, typer.Option(metavar="LENGTH", help="Width of the page: 17cm, 120mm, 6.5in, 480pt.")]
Dpi = Annotated[float | None, typer.Option(metavar="NUMBER", help="Pixels per inch of a PNG, instead of --size.")]
Transparent = Annotated[bool, typer.Option("--transparent", help="Make the background transparent.")]
Texture = Annotated[
    str | None,
    typer.Option(metavar="IMAGE", help="Image in longitude and latitude, a file, or the built-in blue-marble."),
]
TextureBox = Annotated[
    str | None, typer.Option(metavar="W,S,E,N", help="Bounds of the texture in degrees; by default the whole Earth.")
]
Land = Annotated[
    bool | None, typer.Option("--land/--no-land", help="Fill the land; the default unless there is a texture.")
]
Coastlines = Annotated[bool, typer.Option(help="Draw coastlines.")]
Borders = Annotated[bool, typer.Option(help="Draw borders of countries.")]
Rivers = Annotated[bool, typer.Option(help="Draw large rivers.")]
Lakes = Annotated[bool, typer.Option(help="Fill lakes.")]
Graticule = Annotated[
    float | None,
    typer.Option(
        metavar="DEGREES", help="Spacing of meridians and parallels; 0 for none; chosen automatically by default."
    ),
]
Font = Annotated[
    list[str] | None,
    typer.Option("--font", metavar="NAME", help="Font of the labels, a family or a file; repeatable."),
]
Spin = Annotated[bool, typer.Option("--spin", help="For films: turn the globe once.")]
Fly = Annotated[
    list[str] | None,
    typer.Option(metavar="LON,LAT", help="For films: fly from the focus to this place; repeatable."),
]
Seconds = Annotated[float, typer.Option(metavar="SECONDS", help="Duration of a film without --fly.")]
Fps = Annotated[float, typer.Option(metavar="RATE", help="Frames per second of a film.")]
Size = Annotated[
    int | None, typer.Option(min=1, max=65_535, help="Width in pixels; by default 1600, and 720 for films.")
]
Format = Annotated[
    str | None, typer.Option("--format", metavar="NAME", help="Format of stdout, when --out is -: png (default), svg …")
]
