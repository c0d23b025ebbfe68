"""`stereodel interpolate`: values between points, at other points or on a grid."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from pathlib import Path

    from stereodel._arrays import FloatArray
    from stereodel.cli.sources import Table

GRIDS = ("csv", "nc")
EXAMPLE = "stereodel interpolate stations.csv --value temperature --grid 5 -o temperature.csv"


class Method(StrEnum):
    """How values are found between the points."""

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
        str | None, typer.Option(metavar="FILE", help="Table of the points where values are wanted; - for stdin.")
    ] = None,
    grid: Annotated[float | None, typer.Option(metavar="DEGREES", help="Spacing of a grid of values instead.")] = None,
    box: Annotated[
        str | None, typer.Option(metavar="W,S,E,N", help="Borders of the grid in degrees; the whole Earth by default.")
    ] = None,
    method: Annotated[Method, typer.Option(help="How values are found between the points.")] = Method.linear,
    skip_missing: options.SkipMissing = False,
    lon: options.Lon = None,
    lat: options.Lat = None,
    plane: options.Plane = None,
    at_lon: Annotated[str | None, typer.Option(metavar="COLUMN", help="Longitudes of the points of --at.")] = None,
    at_lat: Annotated[str | None, typer.Option(metavar="COLUMN", help="Latitudes of the points of --at.")] = None,
    layer_name: options.LayerName = None,
    at_layer_name: Annotated[
        str | None, typer.Option(metavar="NAME", help="Layer of the points of --at, where a file has several.")
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

    Give either --at or --grid. Where the points do not reach, linear, smooth and natural leave the value empty.
    """
    import numpy as np

    from stereodel.cli.destinations import TABLES, Destination, save_table
    from stereodel.cli.sources import read
    from stereodel.sphere import lonlat_to_xyz

    if (at is None) == (grid is None):
        raise ValueError("give either --at, a table of points, or --grid, a spacing in degrees")
    if at is None and plane is not None:
        raise ValueError("--grid is one of longitudes and latitudes; give the points of a plane with --at")
    if at == points == "-":
        raise ValueError("POINTS and --at cannot both be stdin")
    destination = Destination.of(out, format, TABLES if grid is None else GRIDS, points, at, overwrite=overwrite)
    wanted = None if grid is None else _grid(grid, box)
    table = read(points, lon=lon, lat=lat, plane=plane, layer=layer_name, crs=crs, skip_missing=skip_missing)
    interpolated = _interpolator(table, value, method, latitude, skip_missing)
    if wanted is not None:
        places = np.stack(np.meshgrid(*wanted), axis=-1).reshape(-1, 2)
        values = dict(zip(value, interpolated(lonlat_to_xyz(places, latitude=latitude.value)).T, strict=True))
        destination.write(lambda path: _save_grid(path, *wanted, values))
        return
    asking = read(
        str(at), lon=at_lon, lat=at_lat, plane=plane, layer=at_layer_name, crs=at_crs, skip_missing=skip_missing
    )
    results = dict(zip(value, interpolated(asking.points(latitude)).T, strict=True))
    columns = asking.beside(results, taken=["geometry"])
    destination.write(lambda path: save_table(path, asking.axes, columns))


def _interpolator(
    table: Table, names: list[str], method: Method, latitude: options.Latitude, skip_missing: bool
) -> Callable[[FloatArray], FloatArray]:
    """A function from points to values, (n, number of columns), that shows how far it is."""
    import numpy as np

    from stereodel import interpolation
    from stereodel.cli.progress import in_pieces, stage

    values, table = _values(table, names, skip_missing)
    kinds = {
        Method.nearest: interpolation.NearestInterpolator,
        Method.linear: interpolation.LinearInterpolator,
        Method.smooth: interpolation.SmoothInterpolator,
        Method.natural: interpolation.NaturalNeighborInterpolator,
    }
    with stage("triangulating"):
        interpolator = kinds[method](table.points(latitude), values)

    def interpolated(queries: FloatArray) -> FloatArray:
        pieces = in_pieces(len(queries), "interpolating")
        return np.concatenate([np.zeros((0, len(names))), *(interpolator(queries[piece]) for piece in pieces)])

    return interpolated


def _values(table: Table, names: list[str], skip_missing: bool) -> tuple[FloatArray, Table]:
    """Values (n, number of columns) and their points, without those that lack one if they may be left out."""
    import numpy as np

    values = np.column_stack([table.numbers(name) for name in names])
    missing = np.argwhere(~np.isfinite(values))
    if len(missing) and not skip_missing:
        row, column = missing[0]
        raise ValueError(
            f"{table.name}: row {table.rows[row]}: {names[column]} is missing; leave such rows out with --skip-missing"
        )
    kept = np.ones(len(values), dtype=np.bool_)
    kept[missing[:, 0]] = False
    return values[kept], table.taken(kept)


def _grid(spacing: float, box: str | None) -> tuple[FloatArray, FloatArray]:
    """Longitudes from west to east, running on past 180, and latitudes from south to north.

    Of the whole Earth, −180 without 180, or of a box "W,S,E,N" with its borders.
    """
    import numpy as np

    from stereodel._arrays import as_scalar, as_steps
    from stereodel.constants import GRID_ROUNDING

    if box is None:
        steps = as_steps(180.0, spacing, "--grid")
        return np.arange(-steps, steps) * 180.0 / steps, np.linspace(-90.0, 90.0, steps + 1)

    def steps_between(low: float, high: float) -> FloatArray:
        step = as_scalar(spacing, "--grid", low=0.0, high=high - low, open_low=True)
        count = int(np.floor((high - low) / step + GRID_ROUNDING))
        return np.minimum(low + step * np.arange(count + 1), high)

    west, south, east, north = options.box_of(box, "--box")
    return steps_between(west, east), steps_between(south, north)


def _save_grid(path: Path, lon: FloatArray, lat: FloatArray, columns: dict[str, FloatArray]) -> None:
    """Write values (h·w,) by name, in rows from south to north, as a table or as NetCDF with CF attributes."""
    import numpy as np

    from stereodel._extras import optional
    from stereodel._files import replacing
    from stereodel.cli.destinations import save_table
    from stereodel.cli.sources import LONLAT

    if path.suffix.lower() == ".csv":
        grid = (axis.ravel() for axis in np.meshgrid(lon, lat))
        save_table(path, LONLAT, {**dict(zip(LONLAT, grid, strict=True)), **columns})
        return
    netcdf_file = optional("scipy.io", "scipy").netcdf_file
    with replacing(path) as temporary, netcdf_file(temporary, "w", version=2) as file:
        file.Conventions = "CF-1.8"
        axes = (("lat", lat, "degrees_north", "latitude"), ("lon", lon, "degrees_east", "longitude"))
        for name, places, units, meaning in axes:
            file.createDimension(name, len(places))
            axis = file.createVariable(name, "f8", (name,))
            axis[:], axis.units, axis.standard_name = places, units, meaning
        for name, values in columns.items():
            variable = file.createVariable(name, "f8", ("lat", "lon"))
            variable[:], variable._FillValue = values.reshape(len(lat), len(lon)), np.nan
