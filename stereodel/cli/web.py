"""`stereodel web`: the interactive page as one file."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import typer

from stereodel.cli import options

EXAMPLE = "stereodel web cities.csv -o cities.html --open"


@options.grouped
def command(
    *,
    points: Annotated[str | None, typer.Argument(metavar="POINTS", help="Table to open with; - is stdin.")] = None,
    out: Annotated[str | None, typer.Option("--out", "-o", metavar="FILE", help="File, .html; - is stdout.")] = None,
    open_it: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
    resolution: Annotated[Literal["50m", "110m"], typer.Option(help="Of the land; 110m is a smaller page.")] = "50m",
    columns: options.Table,
    latitude: options.LatitudeKind = "authalic",
    overwrite: options.Overwrite = False,
) -> None:
    """Write an interactive page with the sphere, the lift and the globe, for any browser.

    It is one file that needs no server or network and sends no data.
    """
    import webbrowser
    from pathlib import Path

    from stereodel.cli.application import reporting, say
    from stereodel.web import web

    named = "stereodel" if points in (None, "-") else Path(points or "").stem
    target = out or f"{named}.html"
    if open_it and target == "-":
        raise ValueError("--open needs a file; name one with --out")
    destination = options.File(target, overwrite).of(("html",), points)
    given: dict[str, Any] = {}
    if points is not None:
        table = columns.read(points)
        names = next((column.tolist() for key, column in table.columns.items() if key.strip().lower() == "name"), None)
        given = {"lonlat": table.places, "names": names, "name": Path(table.name).name}
    with reporting(f"writing {target}"), destination.file() as path:
        web(path, **given, resolution=resolution, latitude=latitude)
    say(f"{target}: the page" + (f" with {len(table)} points, {latitude} latitudes" if given else ""))
    if open_it and not webbrowser.open(Path(target).resolve().as_uri()):
        raise OSError(f"{target}: is written, but there is no browser to open it")
