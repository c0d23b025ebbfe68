"""`stereodel contour`: isolines of values given at points."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from stereodel._arrays import FloatArray

EXAMPLE = "stereodel contour stations.csv --value temperature --interval 5 -o isotherms.geojson"

LINES = ("geojson", "geojsonl", "parquet", "gpkg", "fgb", "shp", "kml")
MOST_LEVELS = 10_000


def command(
    points: options.Points,
    value: Annotated[str, typer.Option(metavar="COLUMN", help="Column of the values.")],
    out: options.Out,
    levels: Annotated[
        str | None, typer.Option(metavar="VALUE,…", help="Levels of the isolines, separated by commas.")
    ] = None,
    interval: Annotated[
        float | None, typer.Option(metavar="STEP", help="Isolines at all multiples of this step, instead of --levels.")
    ] = None,
    max_segment: options.MaxSegment = 1.0,
    skip_missing: options.SkipMissing = False,
    lon: options.Lon = None,
    lat: options.Lat = None,
    plane: options.Plane = None,
    layer_name: options.LayerName = None,
    crs: options.Crs = None,
    latitude: options.LatitudeKind = options.Latitude.authalic,
    format: options.Format = None,
    overwrite: options.Overwrite = False,
) -> None:
    """Write isolines of the function that is linear on each Delaunay triangle of the points.

    Give either --levels or --interval. Higher values lie to the left of a line; lines are cut at ±180°.
    """
    from stereodel import PlanarDelaunay, SphericalDelaunay
    from stereodel.cli.application import reporting, say
    from stereodel.cli.destinations import Destination
    from stereodel.cli.failures import NothingToDoError
    from stereodel.cli.sources import read
    from stereodel.interpolation import contours
    from stereodel.io import write

    if (levels is None) == (interval is None):
        raise ValueError("give either --levels, values separated by commas, or --interval, a step")
    destination = Destination.of(out, format, LINES, points, overwrite=overwrite)
    table = read(points, lon=lon, lat=lat, plane=plane, layer=layer_name, crs=crs, skip_missing=skip_missing)
    values, table = table.values([value], skip_missing=skip_missing)
    wanted = _values_of(levels) if levels is not None else _multiples(values[:, 0], interval or 0.0)
    with reporting(f"lines between {len(table)} points"):
        kind = PlanarDelaunay if table.surface == "plane" else SphericalDelaunay
        found = contours(kind(table.points(latitude.value)), values[:, 0], wanted)
    if not found:
        raise NothingToDoError(f"{table.name}: no lines: no level lies between the values")
    with reporting(f"writing {out}") as shown:
        destination.write(
            lambda path: write(
                path, found, max_segment=max_segment, latitude=latitude.value, crs=table.crs, progress=shown
            )
        )
    say(f"{out}: {len(found)} lines of {len(wanted)} levels")


def _values_of(text: str) -> list[float]:
    """Numbers separated by commas."""
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise ValueError(f"--levels is {text!r}, but must be numbers, e.g. --levels=-10,0,10") from None


def _multiples(values: FloatArray, interval: float) -> list[float]:
    """The multiples of an interval between the smallest value and the largest."""
    import numpy as np

    from stereodel._arrays import as_scalar

    step = as_scalar(interval, "--interval", low=0.0, open_low=True)
    low, high = np.ceil(np.min(values, initial=np.inf) / step), np.floor(np.max(values, initial=-np.inf) / step)
    if high - low >= MOST_LEVELS:
        raise ValueError(f"--interval is {step:g}, which makes {high - low + 1:.0f} levels; {MOST_LEVELS} are allowed")
    return [float(k) * step for k in np.arange(low, high + 1)]
