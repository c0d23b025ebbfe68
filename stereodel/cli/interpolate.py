"""`stereodel interpolate`: values between points, at other points or on a grid."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from stereodel._arrays import FloatArray

GRIDS = ("csv", "nc", "tif")
PLANE = ("xmin,ymin,xmax,ymax", "0,0,5000,9000")
"""What --bounds must be in a plane, with an example."""
Method = Literal["nearest", "linear", "smooth", "natural"]
PIECE = 100_000  # rows between two signs of progress
EXAMPLE = "stereodel interpolate stations.csv --value temperature --grid 5 -o temperature.csv"


@options.grouped
def command(
    *,
    points: options.Points,
    value: Annotated[
        list[str], typer.Option(metavar="COLUMN", help="Column of the values; repeatable for several at once.")
    ],
    output: options.Output,
    at: Annotated[
        str | None, typer.Option(metavar="FILE", help="Table of the points where values are wanted; - is stdin.")
    ] = None,
    grid: Annotated[
        float | None, typer.Option(metavar="STEP", help="Spacing of a grid, instead of --at: degrees, or of the plane.")
    ] = None,
    bounds: Annotated[
        str | None,
        typer.Option(metavar="W,S,E,N", help="Bounds of the grid, formerly --box, or world; else those of points."),
    ] = None,
    centers: Annotated[
        bool, typer.Option("--centers", help="Values at the centres of the cells of the grid, instead of at its nodes.")
    ] = False,
    unit: Annotated[
        list[str] | None, typer.Option(metavar="NAME", help="Unit of the values, for grids; one for each --value.")
    ] = None,
    method: Annotated[Method, typer.Option(help="Method of interpolation.")] = "linear",
    columns: options.AnyTable,
    at_columns: Annotated[options.SecondTable, "--at"],
    latitude: options.LatitudeKind = "authalic",
) -> None:
    """Interpolate values at other points, or on a grid of longitude and latitude or of a plane.

    Give either --at or --grid. Outside the convex hull of the points, linear, smooth and natural leave values empty.
    """
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
    if at == points == "-":
        raise ValueError("POINTS and --at cannot both be stdin")
    destination = output.of(options.TABLES if grid is None else GRIDS, points, at)
    meant = ("W,S,E,N in degrees", "-25,34,45,72") if columns.plane is None else PLANE
    sides = bounds if bounds in (None, "world") else options.numbers(bounds, "--bounds", *meant, 4)
    values, table = columns.read(points).values(value, skip_missing=columns.skip_missing)
    sites = table.points(latitude)
    if grid is not None:
        empty = Grid.regular(grid, sides, of=table, centers=centers)
        nodes = PointTable(empty.places.reshape(-1, 2), surface=table.surface).points(latitude)
        found = _interpolated(sites, values, method, nodes)
        shaped = {name: column.reshape(empty.places.shape[:2]) for name, column in zip(value, found.T, strict=True)}
        result: Grid | PointTable = replace(empty, values=shaped, units=dict(zip(value, unit or (), strict=False)))
    elif at is not None:
        asking = at_columns.read(at, columns)
        found = _interpolated(sites, values, method, asking.points(latitude))
        result = asking.beside(dict(zip(value, found.T, strict=True)))
    with reporting(f"writing {output.out}") as told, destination.file() as path:
        write(path, result, progress=told)


def _interpolated(points: FloatArray, values: FloatArray, method: Method, queries: FloatArray) -> FloatArray:
    """Values at queries, (n, number of columns)."""
    import numpy as np

    from stereodel.cli.application import reporting
    from stereodel.interpolation.methods import METHODS

    with reporting("triangulating"):
        interpolator = METHODS[method](points, values)
    found = np.empty((len(queries), values.shape[1]))
    with reporting("interpolating") as shown:
        for start in range(0, len(queries), PIECE):
            piece = slice(start, min(start + PIECE, len(queries)))
            found[piece] = interpolator(queries[piece])
            shown("interpolating", piece.stop, len(queries))
    return found
