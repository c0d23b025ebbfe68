"""`stereodel contour`: isolines of values given at points."""

from __future__ import annotations

from typing import Annotated

import typer

from stereodel.cli import options

EXAMPLE = "stereodel contour stations.csv --value temperature --interval 5 -o isotherms.geojson"

LINES = ("geojson", "geojsonl", "parquet", "gpkg", "fgb", "shp", "kml")
MOST_LEVELS = 10_000


@options.grouped
def command(
    *,
    points: options.Points,
    value: Annotated[str, typer.Option(metavar="COLUMN", help="Column of the values.")],
    output: options.Output,
    levels: Annotated[str | None, typer.Option(metavar="VALUE,…", help="Levels, separated by commas.")] = None,
    interval: Annotated[float | None, typer.Option(metavar="STEP", help="Levels at all multiples of this.")] = None,
    max_segment: options.MaxSegment = 1.0,
    columns: options.AnyTable,
    latitude: options.LatitudeKind = "authalic",
) -> None:
    """Write isolines of the function that is linear on each Delaunay triangle of the points.

    Give either --levels or --interval. Higher values lie to the left of a line; lines are cut at ±180°.
    """
    import numpy as np

    from stereodel._arrays import as_scalar
    from stereodel.cli.application import NothingToDoError, reporting, say
    from stereodel.interpolation import contours
    from stereodel.io import write

    if (levels is None) == (interval is None):
        raise ValueError("give either --levels, values separated by commas, or --interval, a step")
    destination = output.of(LINES, points)
    wanted = [] if levels is None else options.numbers(levels, "--levels", "numbers", "-10,0,10")
    values, table = columns.read(points).values([value], skip_missing=columns.skip_missing)
    if interval is not None:
        step = as_scalar(interval, "--interval", low=0.0, open_low=True)
        low, high = (np.ceil(values.min() / step), np.floor(values.max() / step)) if len(table) else (1.0, 0.0)
        if (count := high - low + 1) > MOST_LEVELS:
            raise ValueError(f"--interval is {step:g}, which makes {count:.0f} levels; {MOST_LEVELS} are allowed")
        wanted = (np.arange(low, high + 1) * step).tolist()
    with reporting(f"lines between {len(table)} points"):
        found = contours(table.points(latitude), values[:, 0], wanted)
    if not found:
        raise NothingToDoError(f"{table.name}: no lines: no level lies between the values")
    with reporting(f"writing {output.out}") as told, destination.file() as path:
        write(path, found, progress=told, max_segment=max_segment, latitude=latitude, crs=table.crs)
    say(f"{output.out}: {len(found)} lines of {len(wanted)} levels")
