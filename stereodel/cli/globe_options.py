"""The options of `stereodel globe`, with what its help says of each."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
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
    list[Path] | None,
    typer.Option("--layer", metavar="FILE", help="Points, lines, polygons to draw: .geojson, .gpkg …; repeatable."),
]
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
