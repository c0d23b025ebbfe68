"""The options of `stereodel globe`, with what its help says of each."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer


class Show(StrEnum):
    """What is drawn of the points."""

    points = "points"
    cells = "cells"
    triangles = "triangles"


class Projection(StrEnum):
    """How the sphere becomes flat."""

    globe = "globe"
    stereographic = "stereographic"
    hemispheres = "hemispheres"


Points = Annotated[
    str | None,
    typer.Argument(metavar="[POINTS]", help="Table of points: .csv, .geojson, .parquet, .gpkg; - for stdin."),
]
Shows = Annotated[
    list[Show] | None,
    typer.Option("--show", help="What is drawn of the points, repeatable; by default points and cells."),
]
Focus = Annotated[
    str | None, typer.Option(metavar="LON,LAT", help="What a fisheye magnifies; by default the middle of the picture.")
]
Magnify = Annotated[float, typer.Option(metavar="S", help="How many times the surroundings of the focus are enlarged.")]
View = Annotated[
    str | None,
    typer.Option(metavar="LON,LAT", help="Middle of the picture; by default the focus, or that of the points."),
]
Flattened = Annotated[
    Projection, typer.Option("--projection", help="A ball, a flat stereographic map, or both halves as flat maps.")
]
AngularRadius = Annotated[
    float, typer.Option(metavar="DEGREES", help="What a stereographic map shows: up to so far from its middle.")
]
Layers = Annotated[
    list[str] | None,
    typer.Option(
        "--layer",
        metavar="FILE[,color=…,width=…]",
        help="Points, lines, polygons to draw: .geojson, .gpkg …, with color, width, outline, size or column; "
        "repeatable.",
    ),
]
Labels = Annotated[
    str | None,
    typer.Option(metavar="COLUMN", help="Names to write at the points, as many as have room, the first rows first."),
]
Rank = Annotated[str | None, typer.Option(metavar="COLUMN", help="Numbers by which names matter, the largest first.")]
PointColor = Annotated[
    str | None, typer.Option("--color", metavar="COLOR", help="Of the points: a name such as firebrick, or #rrggbb.")
]
PointSize = Annotated[
    str | None, typer.Option(metavar="LENGTH", help="Of the points, across: 3pt, 1mm; by default as fits.")
]
Title = Annotated[str, typer.Option(metavar="TEXT", help="Written above the picture.")]
Legend = Annotated[bool, typer.Option("--legend", help="Say below the picture what points and layers are.")]
Styles = Annotated[
    list[str] | None,
    typer.Option("--style", metavar="STYLE", help="column, slide, dark, or a file .toml of colours; repeatable."),
]
Width = Annotated[str, typer.Option(metavar="LENGTH", help="Of the page: 17cm, 120mm, 6.5in, 480pt.")]
Dpi = Annotated[float | None, typer.Option(metavar="NUMBER", help="Pixels per inch of a PNG, instead of --size.")]
Transparent = Annotated[bool, typer.Option("--transparent", help="Leave out the paper beside the globe.")]
Texture = Annotated[
    str | None,
    typer.Option(metavar="IMAGE", help="Picture in longitude and latitude, a file, or blue-marble, which is here."),
]
TextureBox = Annotated[
    str | None, typer.Option(metavar="W,S,E,N", help="Borders of the texture in degrees; by default the whole Earth.")
]
Land = Annotated[
    bool | None, typer.Option("--land/--no-land", help="Fill the land; by default, unless there is a texture.")
]
Coastlines = Annotated[bool, typer.Option(help="Draw the coasts.")]
Borders = Annotated[bool, typer.Option(help="Draw the borders between countries.")]
Rivers = Annotated[bool, typer.Option(help="Draw large rivers.")]
Lakes = Annotated[bool, typer.Option(help="Fill lakes.")]
Graticule = Annotated[
    float | None,
    typer.Option(metavar="DEGREES", help="Spacing of meridians and parallels; 0 for none; by default as fits."),
]
Font = Annotated[
    list[str] | None,
    typer.Option("--font", metavar="NAME", help="Family of the names, or the file of a font; repeatable."),
]
Spin = Annotated[bool, typer.Option("--spin", help="Of a film: the globe turns once.")]
Fly = Annotated[
    list[str] | None,
    typer.Option(metavar="LON,LAT", help="Of a film: the way from the focus goes there; repeatable."),
]
Seconds = Annotated[float, typer.Option(metavar="SECONDS", help="How long a film without --fly is.")]
Fps = Annotated[float, typer.Option(metavar="RATE", help="Frames of a film in a second.")]
Size = Annotated[
    int | None, typer.Option(min=1, max=65_535, help="Width in pixels; by default 1600, and 720 for films.")
]
Format = Annotated[
    str | None, typer.Option("--format", metavar="NAME", help="Format of stdout, when --out is -: png (default), svg …")
]
