"""`stereodel interpolate`: values between points, at other points or on a grid."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options
from stereodel.interpolation.methods import METHODS, Method

if TYPE_CHECKING:
    from stereodel._arrays import FloatArray

GRIDS = ("csv", "nc", "tif")
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
        float | None, typer.Option(metavar="DEGREES", help="Spacing of a grid of values, instead of --at.")
    ] = None,
    box: Annotated[
        str | None, typer.Option(metavar="W,S,E,N", help="Bounds of the grid in degrees; the whole Earth by default.")
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
    """Interpolate values at other points, or on a grid of longitude and latitude.

    Give either --at or --grid. Outside the convex hull of the points, linear, smooth and natural leave values empty.
    """
    from stereodel.cli.application import reporting
    from stereodel.io import Grid, PointTable, write
    from stereodel.sphere import lonlat_to_xyz

    if (at is None) == (grid is None):
        raise ValueError("give either --at, a table of points, or --grid, a spacing in degrees")
    if at is None:
        options.refuse(at_columns.given, "the table --at, and there is none")
    else:
        options.refuse({"--box": box, "--centers": centers, "--unit": unit}, "a --grid, and there is none")
    if unit is not None and len(unit) != len(value):
        raise ValueError(f"there are {len(unit)} of --unit, but {len(value)} of --value; give each its own")
    if at is None and columns.plane is not None:
        raise ValueError("--grid is one of longitudes and latitudes; give the points of a plane with --at")
    if at == points == "-":
        raise ValueError("POINTS and --at cannot both be stdin")
    destination = output.of(options.TABLES if grid is None else GRIDS, points, at)
    if grid is not None:
        sides = box and options.numbers(box, "--box", "W,S,E,N in degrees", "-25,34,45,72", 4)
        empty = Grid.regular(grid, sides or None, centers=centers)
    values, table = columns.read(points).values(value, skip_missing=columns.skip_missing)
    sites = table.points(latitude)
    if at is None:
        nodes = lonlat_to_xyz(empty.lonlat.reshape(-1, 2), latitude=latitude)
        found = _interpolated(sites, values, method, nodes)
        shaped = {name: column.reshape(empty.lonlat.shape[:2]) for name, column in zip(value, found.T, strict=True)}
        result: Grid | PointTable = replace(empty, values=shaped, units=dict(zip(value, unit or (), strict=False)))
    else:
        asking = at_columns.read(at, columns)
        found = _interpolated(sites, values, method, asking.points(latitude))
        result = asking.beside(dict(zip(value, found.T, strict=True)))
    with reporting(f"writing {output.out}") as told, destination.file() as path:
        write(path, result, progress=told)


def _interpolated(points: FloatArray, values: FloatArray, method: Method, queries: FloatArray) -> FloatArray:
    """Values at queries, (n, number of columns)."""
    import numpy as np

    from stereodel.cli.application import reporting

    with reporting("triangulating"):
        interpolator = METHODS[method](points, values)
    found = np.empty((len(queries), values.shape[1]))
    with reporting("interpolating") as shown:
        for start in range(0, len(queries), PIECE):
            piece = slice(start, min(start + PIECE, len(queries)))
            found[piece] = interpolator(queries[piece])
            shown("interpolating", piece.stop, len(queries))
    return found
