"""`stereodel interpolate`: values between points, at other points or on a grid."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import typer

from stereodel.cli import options
from stereodel.interpolation.methods import METHODS, Method

GRIDS = ("csv", "nc", "tif")
PLANE = ("xmin,ymin,xmax,ymax", "0,0,5000,9000")
"""What --bounds must be in a plane, with an example."""
PIECE = 100_000  # rows between two signs of progress
EXAMPLE = "stereodel interpolate stations.csv --value temperature --grid 5 -o temperature.csv"


@options.grouped
def command(
    *,
    points: options.Points,
    value: Annotated[list[str], typer.Option(metavar="COLUMN", help="Column of the values; repeatable.")],
    output: options.Output,
    at: Annotated[str | None, typer.Option(metavar="FILE", help="Table of the points wanted; - is stdin.")] = None,
    grid: Annotated[float | None, typer.Option(metavar="STEP", help="Spacing of a grid, instead of --at.")] = None,
    bounds: Annotated[
        str | None, typer.Option(metavar="W,S,E,N", help="Bounds of the grid, or world; else those of the points.")
    ] = None,
    centers: Annotated[bool, typer.Option("--centers", help="Values at the centres of a grid's cells.")] = False,
    unit: Annotated[list[str] | None, typer.Option(metavar="NAME", help="Unit of each --value, for grids.")] = None,
    method: Annotated[Method, typer.Option(help="Method of interpolation.")] = "linear",
    columns: options.AnyTable,
    at_columns: Annotated[options.SecondTable, "--at"],
    latitude: options.LatitudeKind = "authalic",
) -> None:
    """Interpolate values at other points, or on a grid of longitude and latitude or of a plane.

    Give either --at or --grid. Outside the convex hull of the points, linear, smooth and natural leave values empty.
    """
    import numpy as np

    from stereodel.cli.application import reporting
    from stereodel.io import Grid, PointTable, write

    if (at is None) == (grid is None):
        raise ValueError("give either --at, a table of points, or --grid, a spacing")
    if at is None:
        options.refuse(at_columns.given, "the table --at, and there is none")
    else:
        options.refuse({"--bounds": bounds, "--centers": centers, "--unit": unit}, "a --grid, and there is none")
    if unit is not None and len(unit) != len(value):
        raise ValueError(f"there are {len(unit)} of --unit, but {len(value)} of --value; give each its own")
    destination = output.of(options.TABLES if grid is None else GRIDS, points, at)
    meant = ("W,S,E,N in degrees", "-25,34,45,72") if columns.plane is None else PLANE
    sides = bounds if bounds in (None, "world") else options.numbers(bounds, "--bounds", *meant, 4)
    values, table = columns.read(points).values(value, skip_missing=columns.skip_missing)
    empty = None if grid is None else Grid.regular(grid, sides, of=table, centers=centers)
    if empty is not None:
        asking = PointTable(empty.places.reshape(-1, 2), surface=table.surface)
    elif at is not None:
        asking = at_columns.read(at, columns)
    queries = asking.points(latitude)
    with reporting("triangulating"):
        interpolator = METHODS[method](table.points(latitude), values)
    found = np.empty((len(queries), len(value)))
    with reporting("interpolating") as shown:
        for start in range(0, len(queries), PIECE):
            piece = slice(start, min(start + PIECE, len(queries)))
            found[piece] = interpolator(queries[piece])
            shown("interpolating", piece.stop, len(queries))
    if empty is None:
        result: Grid | PointTable = asking.beside(dict(zip(value, found.T, strict=True)))
    else:
        shaped = zip(value, found.T.reshape(-1, *empty.places.shape[:2]), strict=True)
        result = replace(empty, values=dict(shaped), units=dict(zip(value, unit or (), strict=False)))
    with reporting(f"writing {output.out}") as told, destination.file() as path:
        write(path, result, progress=told)
