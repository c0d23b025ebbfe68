"""`stereodel web`: the interactive page as one file."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

from stereodel.cli import options

EXAMPLE = "stereodel web cities.csv -o cities.html --open"


class Land(StrEnum):
    """Land of a page, by the scale of the source map, 1 : 50 or 1 : 110 million."""

    of_50m = "50m"
    of_110m = "110m"


def command(
    points: Annotated[
        str | None,
        typer.Argument(
            metavar="[POINTS]", help="Table of points to open with the page: .csv, .geojson …; - for stdin."
        ),
    ] = None,
    out: Annotated[
        str | None,
        typer.Option(
            "--out", "-o", metavar="FILE", help="File to write, .html, named after the table by default; - for stdout."
        ),
    ] = None,
    open_it: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
    resolution: Annotated[
        Land, typer.Option(help="Land at 1 : 50 or 1 : 110 million; the latter makes a smaller page.")
    ] = Land.of_50m,
    lon: options.Lon = None,
    lat: options.Lat = None,
    layer_name: options.LayerName = None,
    crs: options.Crs = None,
    skip_missing: options.SkipMissing = False,
    latitude: options.LatitudeKind = options.Latitude.authalic,
    overwrite: options.Overwrite = False,
) -> None:
    """Write an interactive page with the sphere, the lift and the globe, for any browser.

    It is one file that needs no server or network and sends no data.
    """
    from functools import partial
    from pathlib import Path

    from stereodel.cli.application import reporting, say
    from stereodel.cli.destinations import Destination
    from stereodel.cli.sources import read
    from stereodel.web import web

    target = out or _named_after(points)
    if open_it and target == "-":
        raise ValueError("--open needs a file; name one with --out")
    destination = Destination.of(target, None, ("html",), points, overwrite=overwrite)
    lonlat, names, name = None, None, ""
    if points is not None:
        table = read(points, lon=lon, lat=lat, layer=layer_name, crs=crs, skip_missing=skip_missing)
        lonlat, name = table.places, Path(table.name).name
        names = next((column.tolist() for key, column in table.columns.items() if key.strip().lower() == "name"), None)
    given = partial(web, lonlat=lonlat, names=names, name=name)
    with reporting(f"writing {target}"):
        destination.write(lambda path: given(path, resolution=resolution.value, latitude=latitude.value))
    say(f"{target}: the page" + ("" if lonlat is None else f" with {len(lonlat)} points, {latitude.value} latitudes"))
    if open_it:
        _show(target)


def _named_after(points: str | None) -> str:
    """Default file name of a table's page, in the current folder."""
    from pathlib import Path

    return "stereodel.html" if points in (None, "-") else f"{Path(points).stem}.html"


def _show(name: str) -> None:
    """Open a file in the system's browser."""
    import webbrowser
    from pathlib import Path

    if not webbrowser.open(Path(name).resolve().as_uri()):
        raise OSError(f"{name}: is written, but there is no browser to open it")
