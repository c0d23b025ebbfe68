"""`stereodel nearest`: which sites are nearest to points, and how far away."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from stereodel._arrays import Column, FloatArray, Indices
    from stereodel.curves.ragged import Ragged
    from stereodel.io import PointTable

EXAMPLE = "stereodel nearest airports.csv --of cities.csv -o nearest.csv"


def command(
    sites: Annotated[str, typer.Argument(metavar="SITES", help="Table of the sites; - is stdin.")],
    queries: Annotated[str, typer.Option("--of", metavar="FILE", help="Table of the query points; - is stdin.")],
    out: options.Out,
    count: Annotated[int, typer.Option("--count", "-k", min=1, help="Number of sites for each query point.")] = 1,
    keep: Annotated[
        list[str] | None,
        typer.Option(
            metavar="COLUMN", help="Column of the sites to write, repeatable; by default 'name', if it exists."
        ),
    ] = None,
    lon: options.Lon = None,
    lat: options.Lat = None,
    of_lon: Annotated[
        str | None, typer.Option(metavar="COLUMN", help="Column of longitudes of the query points.")
    ] = None,
    of_lat: Annotated[
        str | None, typer.Option(metavar="COLUMN", help="Column of latitudes of the query points.")
    ] = None,
    plane: options.Plane = None,
    layer_name: options.LayerName = None,
    of_layer_name: Annotated[
        str | None, typer.Option(metavar="NAME", help="Layer of the query points, if the file has several.")
    ] = None,
    crs: options.Crs = None,
    of_crs: Annotated[
        str | None, typer.Option(metavar="NAME", help="Coordinate system of the columns of the query points.")
    ] = None,
    skip_missing: options.SkipMissing = False,
    max_distance: Annotated[
        float | None, typer.Option(metavar="KM", min=0, help="Leave out sites farther away; in a plane, in its unit.")
    ] = None,
    exclude_self: Annotated[
        bool, typer.Option("--exclude-self", help="Leave out sites at exactly the position of the query point.")
    ] = False,
    latitude: options.LatitudeKind = options.Latitude.authalic,
    format: options.Format = None,
    overwrite: options.Overwrite = False,
) -> None:
    """Find the sites nearest to each query point, and their distances in kilometres.

    Writes the columns of the query points, then the row number of each site in its table, the columns kept from it, and
    the distance. A query point with several sites has several rows, ranked from 1; a query point with no site has none.
    """
    from stereodel.cli.application import say
    from stereodel.cli.destinations import TABLES, Destination, save
    from stereodel.cli.sources import read, read_second

    destination = Destination.of(out, format, TABLES, sites, queries, overwrite=overwrite)
    if sites == queries == "-":
        raise ValueError("SITES and --of cannot both be stdin")
    chosen = read(sites, lon=lon, lat=lat, plane=plane, layer=layer_name, crs=crs, skip_missing=skip_missing)
    asking = read_second(
        queries,
        "--of",
        lon=of_lon,
        lat=of_lat,
        layer=of_layer_name,
        crs=of_crs,
        first_crs=crs,
        plane=plane,
        skip_missing=skip_missing,
    )
    pairs = _pairs(chosen.points(latitude.value), asking.points(latitude.value), count, max_distance, exclude_self)
    found = asking.taken(pairs.query)
    table = _with_sites(found, chosen, pairs, _kept(chosen, keep), ranked=count > 1)
    destination.write(lambda path: save(path, table))
    say(f"{out}: nearest of {len(chosen)} sites for {len(asking)} points")


@dataclass(frozen=True, eq=False)
class Pairs:
    """Indices of query points, each with one of its sites, that site's rank from 1 and its distance; (m,) each."""

    query: Indices
    site: Indices
    rank: Indices
    distance: FloatArray


def _pairs(sites: FloatArray, queries: FloatArray, count: int, max_distance: float | None, exclude_self: bool) -> Pairs:
    """The nearest sites of each query point, up to `count`; distances on the sphere are in kilometres."""
    import numpy as np

    from stereodel import PlanarDelaunay, SphericalDelaunay, angular_distance
    from stereodel.curves.ragged import Ragged, spans
    from stereodel.earth import MEAN_RADIUS_KM

    planar = sites.shape[1] == 2
    # Sites that share a place are all at a query point or none is: search distinct places, and one more than wanted.
    groups = _by_place(sites) if exclude_self else Ragged(np.arange(len(sites)), np.arange(len(sites) + 1))
    places = sites[groups.values[groups.offsets[:-1]]]
    triangulation = PlanarDelaunay(places) if planar else SphericalDelaunay(places)
    asked = min(count + exclude_self, len(places))
    found = np.reshape(triangulation.nearest(queries, k=asked), (len(queries), asked))
    if planar:
        distance = np.hypot(*np.moveaxis(places[found] - queries[:, None], -1, 0))
    else:
        distance = np.radians(angular_distance(queries[:, None], places[found])) * MEAN_RADIUS_KM
    kept = np.ones(found.shape, dtype=np.bool_)
    if exclude_self:
        kept &= (places[found] != queries[:, None]).any(axis=-1)
    if max_distance is not None:
        kept &= distance <= max_distance
    sizes = np.where(kept, groups.sizes[found], 0)
    before = np.cumsum(sizes, axis=1) - sizes
    taken = np.clip(count - before, 0, sizes)
    some = np.nonzero(taken)
    times = taken[some]
    return Pairs(
        np.repeat(some[0], times),
        groups.values[spans(groups.offsets[found[some]], times)],
        spans(before[some] + 1, times),
        np.repeat(distance[some], times),
    )


def _by_place(sites: FloatArray) -> Ragged:
    """The sites at each place, in order; places in the order of their first sites."""
    import numpy as np

    from stereodel.curves.ragged import Ragged

    _, first, place = np.unique(sites + 0.0, axis=0, return_index=True, return_inverse=True)
    number = np.argsort(np.argsort(first))[place.ravel()]
    return Ragged.grouped(np.argsort(number, kind="stable"), number, len(first))


def _kept(sites: PointTable, keep: list[str] | None) -> dict[str, Column]:
    """The columns of the sites to write."""
    names = [name for name in sites.columns if name.lower() == "name"] if keep is None else keep
    return {name: sites.column(name) for name in names}


def _with_sites(
    found: PointTable, sites: PointTable, pairs: Pairs, kept: dict[str, Column], *, ranked: bool
) -> PointTable:
    """One row for each pair of a query point and a site."""
    from stereodel.io.formats.names import beside

    results: dict[str, Column] = {"rank": pairs.rank} if ranked else {}
    results["site_row"] = sites.rows[pairs.site]
    distance: dict[str, Column] = {"distance" if sites.surface == "plane" else "distance_km": pairs.distance}
    of_sites = {f"site_{name}": values[pairs.site] for name, values in kept.items()}
    results |= beside([*results, *distance], of_sites) | distance
    return found.beside(results)
