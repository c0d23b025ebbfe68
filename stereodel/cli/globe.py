"""`stereodel globe`: a picture of points on a globe."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    pass

EXAMPLE = "stereodel globe cities.csv --focus=10,48 --magnify 3 -o globe.png"

PICTURES = ("png", "svg", "pdf")


class Show(StrEnum):
    """What is drawn of the points."""

    points = "points"
    cells = "cells"
    triangles = "triangles"


def command(
    points: options.Points,
    out: options.Out,
    show: Annotated[
        list[Show] | None, typer.Option(help="What is drawn, repeatable; by default points and cells.")
    ] = None,
    view: Annotated[
        str | None, typer.Option(metavar="LON,LAT", help="Middle of the picture; by default the focus or the data's.")
    ] = None,
    focus: Annotated[
        str | None, typer.Option(metavar="LON,LAT", help="What a fisheye magnifies; by default the middle.")
    ] = None,
    magnify: Annotated[
        float, typer.Option(metavar="S", help="How many times the surroundings of the focus are enlarged.")
    ] = 1.0,
    coastlines: Annotated[bool, typer.Option(help="Draw the coasts.")] = True,
    size: Annotated[int, typer.Option(min=1, max=65_535, help="Width of a PNG in pixels.")] = 1600,
    lon: options.Lon = None,
    lat: options.Lat = None,
    latitude: options.LatitudeKind = options.Latitude.spherical,
    format: Annotated[
        str | None, typer.Option(metavar="NAME", help="Format of stdout, when --out is -: png (default), svg, pdf.")
    ] = None,
) -> None:
    """Draw points on a globe, with their Voronoi cells or Delaunay triangles, under a conformal fisheye if wanted."""
    from stereodel.cli.destinations import Destination
    from stereodel.cli.globe_page import GlobePicture, lens_at, middle_of, shores
    from stereodel.cli.progress import stage
    from stereodel.cli.sources import read
    from stereodel.render import View, save_page

    destination = Destination.of(out, format, PICTURES)
    given = {"--view": view, "--focus": focus}
    known = {name: options.pair(text, name, "LON,LAT") for name, text in given.items() if text is not None}
    table = read(points, lon=lon, lat=lat)
    places = table.points(latitude)
    middle = known.get("--view") or known.get("--focus") or middle_of(places)
    picture = GlobePicture(
        places,
        frozenset(show or (Show.points, Show.cells)),
        View(*middle),
        lens_at(known.get("--focus", middle), magnify),
        shores(latitude) if coastlines else (),
    )
    with stage("drawing"):
        page = picture.page()
        destination.write(lambda path: save_page(page, path, size=size))
