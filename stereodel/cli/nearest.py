"""`stereodel nearest`: which sites are nearest to points, and how far away."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from stereodel._arrays import FloatArray, IntArray
    from stereodel.cli.sources import Columns, Table

EXAMPLE = "stereodel nearest airports.csv --of cities.csv -o nearest.csv"


def command(
    sites: Annotated[str, typer.Argument(metavar="SITES", help="Table of the points to choose from; - for stdin.")],
    queries: Annotated[str, typer.Option("--of", metavar="FILE", help="Table of the points that ask; - for stdin.")],
    out: options.Out,
    count: Annotated[int, typer.Option("--count", "-k", min=1, help="How many sites of each point.")] = 1,
    keep: Annotated[
        list[str] | None,
        typer.Option(metavar="COLUMN", help="Column of the sites to write, repeatable; by default 'name' if there."),
    ] = None,
    lon: options.Lon = None,
    lat: options.Lat = None,
    of_lon: Annotated[str | None, typer.Option(metavar="COLUMN", help="Longitudes of the points that ask.")] = None,
    of_lat: Annotated[str | None, typer.Option(metavar="COLUMN", help="Latitudes of the points that ask.")] = None,
    plane: options.Plane = None,
    latitude: options.LatitudeKind = options.Latitude.spherical,
    format: options.Format = None,
) -> None:
    """Find the sites that are nearest to each point, and their distances in kilometres.

    Writes the columns of the points that ask, then the row of each site in its table, the columns kept of it, and the
    distance. With several sites a point has several rows, ranked from 1.
    """
    from stereodel.cli.destinations import TABLES, Destination, save_table
    from stereodel.cli.progress import say
    from stereodel.cli.sources import read

    destination = Destination.of(out, format, TABLES)
    if sites == queries == "-":
        raise ValueError("SITES and --of cannot both be stdin")
    chosen = read(sites, lon=lon, lat=lat, plane=plane)
    asking = read(queries, lon=of_lon, lat=of_lat, plane=plane)
    found, distances = _nearest(chosen.points(latitude), asking.points(latitude), min(count, len(chosen)))
    columns = _columns(chosen, asking, found, distances, _kept(chosen, keep))
    destination.write(lambda path: save_table(path, asking.axes, columns))
    say(f"{out}: nearest of {len(chosen)} sites for {len(asking)} points")


def _nearest(sites: FloatArray, queries: FloatArray, count: int) -> tuple[IntArray, FloatArray]:
    """Indices of the nearest sites and distances, kilometres on the sphere, both (n, count)."""
    import numpy as np

    from stereodel import PlanarDelaunay, SphericalDelaunay, angular_distance
    from stereodel.earth import MEAN_RADIUS_KM

    kind = PlanarDelaunay if sites.shape[1] == 2 else SphericalDelaunay
    found = np.reshape(kind(sites).nearest(queries, k=count), (len(queries), count))
    if sites.shape[1] == 2:
        return found, np.hypot(*np.moveaxis(sites[found] - queries[:, None], -1, 0))
    return found, np.radians(angular_distance(queries[:, None], sites[found])) * MEAN_RADIUS_KM


def _kept(sites: Table, keep: list[str] | None) -> Columns:
    """The columns of the sites that are written."""
    names = [name for name in sites.columns if name.lower() == "name"] if keep is None else keep
    return {name: sites.column(name) for name in names}


def _columns(sites: Table, asking: Table, found: IntArray, distances: FloatArray, kept: Columns) -> Columns:
    """One row for each point and each of its sites."""
    import numpy as np

    count = found.shape[1]
    flat = found.ravel()
    table = dict(zip(asking.axes, np.repeat(asking.places, count, axis=0).T, strict=True))
    table |= {name: np.repeat(values, count) for name, values in asking.columns.items()}
    if count > 1:
        table["rank"] = np.tile(np.arange(1, count + 1), len(found))
    table["site_row"] = sites.rows[flat]
    table |= {f"site_{name}": values[flat] for name, values in kept.items()}
    table["distance" if sites.planar else "distance_km"] = distances.ravel()
    return table
