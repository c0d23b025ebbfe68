"""`stereodel interpolate`: values between points, at other points or on a grid."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options
from stereodel.interpolation.methods import METHODS, Method

if TYPE_CHECKING:
    from stereodel._arrays import FloatArray

GRIDS = ("csv", "nc", "tif", "tiff")
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
    from stereodel.cli.destinations import TABLES
    from stereodel.io import Grid
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
    destination = output.of(TABLES if grid is None else GRIDS, points, at)
    if grid is not None:
        empty = Grid.regular(grid, None if box is None else options.box_of(box, "--box"), centers=centers)
    values, table = columns.read(points).values(value, skip_missing=columns.skip_missing)
    interpolated = _interpolator(table.points(latitude), values, method)
    if at is None:
        found = interpolated(lonlat_to_xyz(empty.lonlat.reshape(-1, 2), latitude=latitude))
        shaped = {name: column.reshape(empty.lonlat.shape[:2]) for name, column in zip(value, found.T, strict=True)}
        filled = replace(empty, values=shaped, units=dict(zip(value, unit or (), strict=False)))
        destination.put(filled)
        return
    asking = at_columns.read(at, columns)
    results = dict(zip(value, interpolated(asking.points(latitude)).T, strict=True))
    destination.put(asking.beside(results))


def _interpolator(points: FloatArray, values: FloatArray, method: Method) -> Callable[[FloatArray], FloatArray]:
    """A function from queries to values, (n, number of columns), that reports its progress."""
    import numpy as np

    from stereodel.cli.application import reporting

    with reporting("triangulating"):
        interpolator = METHODS[method](points, values)

    def interpolated(queries: FloatArray) -> FloatArray:
        found = np.empty((len(queries), values.shape[1]))
        with reporting("interpolating") as shown:
            for start in range(0, len(queries), PIECE):
                piece = slice(start, min(start + PIECE, len(queries)))
                found[piece] = interpolator(queries[piece])
                shown("interpolating", piece.stop, len(queries))
        return found

    return interpolated
