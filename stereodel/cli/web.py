"""`stereodel web`: the interactive page as one file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from stereodel.io import PointTable

EXAMPLE = "stereodel web cities.csv -o cities.html --open"


@options.grouped
def command(
    *,
    points: Annotated[str | None, typer.Argument(metavar="POINTS", help="Table to open with; - is stdin.")] = None,
    out: Annotated[str | None, typer.Option("--out", "-o", metavar="FILE", help="File, .html; - is stdout.")] = None,
    open_it: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
    resolution: Annotated[Literal["50m", "110m"], typer.Option(help="Of the land; 110m is a smaller page.")] = "50m",
    owner: options.OwnerOptions,
    valued: options.ValueOptions,
    columns: options.Table,
    latitude: options.LatitudeKind = "authalic",
    overwrite: options.Overwrite = False,
) -> None:
    """Write an interactive page with the sphere, the lift and the globe, for any browser.

    It is one file that needs no server or network and sends no data. With a table it opens on the globe, fitted to its
    places.
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
    if points is None:
        said = {f"--{name.replace('_', '-')}": value for name, value in vars(owner).items()}
        sized = {"--point-size": valued.point_size, "--point-color": valued.point_color}
        options.refuse({**said, **sized, **valued.given, **columns.given}, "POINTS; give a table")
    else:
        table = columns.read(points)
        names = owner.labels or next((key for key in table.columns if key.strip().lower() == "name"), None)
        given = {
            "lonlat": table.places,
            "names": None if names is None else table.column(names).tolist(),
            "name": Path(table.name).name,
            "title": owner.title,
            "source": owner.source,
            **looks_on_page(table, valued, owner.legend_text or ()),
        }
    with reporting(f"writing {target}"), destination.file() as path:
        web(path, **given, resolution=resolution, latitude=latitude)
    say(f"{target}: the page" + (f" with {len(table)} points, {latitude} latitudes" if given else ""))
    if open_it and not webbrowser.open(Path(target).resolve().as_uri()):
        raise OSError(f"{target}: is written, but there is no browser to open it")


def looks_on_page(table: PointTable, valued: options.ValueOptions, texts: Sequence[str]) -> dict[str, Any]:
    """How points look, as `web` takes it: as on pictures, but without a legend where nothing is by value."""
    from stereodel.cli.globe import looks_of, renamed
    from stereodel.drawing.page.style import MAP_DOT

    looks = looks_of(table, valued, MAP_DOT)
    del looks["style"]
    if "values" not in looks:
        options.refuse(valued.given, "colours by value; name a column of numbers in --point-color")
        del looks["legend"]
    titles = dict.fromkeys(looks[key] for key in ("legend", "size_legend") if looks.get(key))
    other = dict(zip(titles, renamed(titles, texts), strict=True))  # type: ignore[arg-type]
    return looks | {key: other[looks[key]] for key in ("legend", "size_legend") if looks.get(key)}
