"""`stereodel interpolate`: values between points, at other points or on a grid."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options
from stereodel.cli.failures import naming_options

if TYPE_CHECKING:
    from stereodel._arrays import FloatArray
    from stereodel.io import Grid, PointTable

GRIDS = ("csv", "nc", "tif", "tiff")
PIECE = 100_000  # rows between two signs of progress
EXAMPLE = "stereodel interpolate stations.csv --value temperature --grid 5 -o temperature.csv"


class Method(StrEnum):
    """Methods of interpolation."""

    nearest = "nearest"
    linear = "linear"
    smooth = "smooth"
    natural = "natural"


def command(
    points: options.Points,
    value: Annotated[
        list[str], typer.Option(metavar="COLUMN", help="Column of the values; repeatable for several at once.")
    ],
    out: options.Out,
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
    method: Annotated[Method, typer.Option(help="Method of interpolation.")] = Method.linear,
    skip_missing: options.SkipMissing = False,
    lon: options.Lon = None,
    lat: options.Lat = None,
    plane: options.Plane = None,
    at_lon: Annotated[str | None, typer.Option(metavar="COLUMN", help="Column of longitudes of --at.")] = None,
    at_lat: Annotated[str | None, typer.Option(metavar="COLUMN", help="Column of latitudes of --at.")] = None,
    layer_name: options.LayerName = None,
    at_layer_name: Annotated[
        str | None, typer.Option(metavar="NAME", help="Layer of --at, if the file has several.")
    ] = None,
    crs: options.Crs = None,
    at_crs: Annotated[
        str | None, typer.Option(metavar="NAME", help="Coordinate system of the columns of --at.")
    ] = None,
    latitude: options.LatitudeKind = options.Latitude.authalic,
    format: options.Format = None,
    overwrite: options.Overwrite = False,
) -> None:
    """Interpolate values at other points, or on a grid of longitude and latitude.

    Give either --at or --grid. Outside the convex hull of the points, linear, smooth and natural leave values empty.
    """
    from stereodel.cli.destinations import TABLES, Destination, save
    from stereodel.cli.sources import read, read_second
    from stereodel.io import write
    from stereodel.sphere import lonlat_to_xyz

    if (at is None) == (grid is None):
        raise ValueError("give either --at, a table of points, or --grid, a spacing in degrees")
    of_at = {"--at-lon": at_lon, "--at-lat": at_lat, "--at-layer-name": at_layer_name, "--at-crs": at_crs}
    if at is None:
        options.refuse(of_at, "the table --at, and there is none")
    else:
        options.refuse({"--box": box, "--centers": centers, "--unit": unit}, "a --grid, and there is none")
    if unit is not None and len(unit) != len(value):
        raise ValueError(f"there are {len(unit)} of --unit, but {len(value)} of --value; give each its own")
    if at is None and plane is not None:
        raise ValueError("--grid is one of longitudes and latitudes; give the points of a plane with --at")
    if at == points == "-":
        raise ValueError("POINTS and --at cannot both be stdin")
    destination = Destination.of(out, format, TABLES if grid is None else GRIDS, points, at, overwrite=overwrite)
    wanted = None if grid is None else _grid(grid, box, centers)
    table = read(points, lon=lon, lat=lat, plane=plane, layer=layer_name, crs=crs, skip_missing=skip_missing)
    interpolated = _interpolator(table, value, method, latitude, skip_missing)
    if wanted is not None:
        found = interpolated(lonlat_to_xyz(wanted.lonlat.reshape(-1, 2), latitude=latitude.value))
        shape = wanted.lonlat.shape[:2]
        values = {name: column.reshape(shape) for name, column in zip(value, found.T, strict=True)}
        filled = replace(wanted, values=values, units=dict(zip(value, unit or (), strict=False)))
        destination.write(lambda path: write(path, filled))
        return
    asking = read_second(
        str(at),
        "--at",
        lon=at_lon,
        lat=at_lat,
        layer=at_layer_name,
        crs=at_crs,
        first_crs=crs,
        plane=plane,
        skip_missing=skip_missing,
    )
    results = dict(zip(value, interpolated(asking.points(latitude.value)).T, strict=True))
    destination.write(lambda path: save(path, asking.beside(results)))


def _interpolator(
    table: PointTable, names: list[str], method: Method, latitude: options.Latitude, skip_missing: bool
) -> Callable[[FloatArray], FloatArray]:
    """A function from points to values, (n, number of columns), that reports its progress."""
    import numpy as np

    from stereodel.cli.application import reporting
    from stereodel.interpolation.methods import METHODS

    values, table = table.values(names, skip_missing=skip_missing)
    with reporting("triangulating"):
        interpolator = METHODS[method.value](table.points(latitude.value), values)

    def interpolated(queries: FloatArray) -> FloatArray:
        found = np.empty((len(queries), len(names)))
        with reporting("interpolating") as shown:
            for start in range(0, len(queries), PIECE):
                piece = slice(start, min(start + PIECE, len(queries)))
                found[piece] = interpolator(queries[piece])
                shown("interpolating", piece.stop, len(queries))
        return found

    return interpolated


def _grid(spacing: float, box: str | None, centers: bool) -> Grid:
    """A grid of the whole Earth, or of the box "W,S,E,N"."""
    from stereodel.io import Grid

    bounds = None if box is None else options.box_of(box, "--box")
    with naming_options(spacing="--grid", lon="--grid", lat="--grid", bounds="--box"):
        return Grid.regular(spacing, bounds, centers=centers)
