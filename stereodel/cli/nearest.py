"""`stereodel nearest`: which sites are nearest to points, and how far away."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from stereodel._arrays import Column, FloatArray, Indices

EXAMPLE = "stereodel nearest airports.csv --of cities.csv -o nearest.csv"


@options.grouped
def command(
    *,
    sites: Annotated[str, typer.Argument(metavar="SITES", help="Table of sites, or lines and polygons; - is stdin.")],
    queries: Annotated[str, typer.Option("--of", metavar="FILE", help="Table of the query points; - is stdin.")],
    output: options.Output,
    count: Annotated[int, typer.Option("--count", "-k", metavar="N", min=1, help="Sites for each query point.")] = 1,
    keep: Annotated[
        list[str] | None, typer.Option(metavar="COLUMN", help="Column of the sites to write, repeatable; else 'name'.")
    ] = None,
    max_distance: Annotated[
        float | None, typer.Option(metavar="KM", min=0, help="Leave out sites farther away; in a plane, in its unit.")
    ] = None,
    exclude_self: Annotated[bool, typer.Option("--exclude-self", help="Leave out sites at the query point.")] = False,
    columns: options.AnyTable,
    of_columns: Annotated[options.SecondTable, "--of"],
    latitude: options.LatitudeKind = "authalic",
) -> None:
    """Find the sites nearest to each query point, and their distances in kilometres, 0 within a polygon.

    Writes the columns of the query points, then the row number of each site in its table, the columns kept from it, and
    the distance. A query point with several sites has several rows, ranked from 1; a query point with no site has none.
    """
    import numpy as np

    from stereodel.cli.application import reporting, say
    from stereodel.io import nearest_shapes, write
    from stereodel.io.formats.names import beside
    from stereodel.io.reading import ShapeTable, read_sites

    destination = output.of(options.TABLES, sites, queries)
    chosen, limit = columns.read(sites, read_sites), np.inf if max_distance is None else max_distance
    asking = of_columns.read(queries, columns)
    if isinstance(chosen, ShapeTable):
        reason = f"{sites} has lines or polygons, of which the nearest one alone is found; leave out what is for points"
        options.refuse({"--count": count > 1, "--exclude-self": exclude_self}, f"points, and {reason}")
        site, distance = nearest_shapes(asking.lonlat, chosen.shapes, latitude=latitude)
        query = np.flatnonzero(distance <= limit)
        site, rank, distance = site[query], np.ones_like(query), distance[query]
    else:
        places = chosen.points(latitude), asking.points(latitude)
        query, site, rank, distance = _pairs(*places, count, limit, exclude_self)
    kept = [name for name in chosen.columns if name.lower() == "name"] if keep is None else keep
    results: dict[str, Column] = {"rank": rank} if count > 1 else {}
    results["site_row"] = chosen.rows[site]
    distances: dict[str, Column] = {"distance" if chosen.surface == "plane" else "distance_km": distance}
    of_sites = {f"site_{name}": chosen.column(name)[site] for name in kept}
    table = asking.taken(query).beside(results | beside([*results, *distances], of_sites) | distances)
    with reporting(f"writing {output.out}") as told, destination.file() as path:
        write(path, table, progress=told)
    say(f"{output.out}: nearest of {len(chosen)} sites for {len(asking)} points")


def _pairs(
    sites: FloatArray, queries: FloatArray, count: int, limit: float, exclude_self: bool
) -> tuple[Indices, Indices, Indices, FloatArray]:
    """Indices of query points, each with one of its up to `count` nearest sites, that one's rank, and the distance.

    Ranks count from 1; distances on the sphere are in kilometres.
    """
    import numpy as np

    from stereodel.curves.ragged import Ragged, spans
    from stereodel.earth import MEAN_RADIUS_KM
    from stereodel.triangulation.delaunay import as_triangulation

    # Sites that share a place are all at a query point or none is: search distinct places, and one more than wanted.
    number = np.arange(len(sites))
    if exclude_self:  # of places, in the order of their first sites
        _, first, place = np.unique(sites + 0.0, axis=0, return_index=True, return_inverse=True)
        number = np.unique(first[place.ravel()], return_inverse=True)[1]
    groups = Ragged.grouped(np.argsort(number, kind="stable"), number, int(number.max(initial=-1)) + 1)
    places = sites[groups.values[groups.offsets[:-1]]]
    asked = min(count + exclude_self, len(places))
    searched = as_triangulation(places)
    found = np.reshape(searched.nearest(queries, k=asked), (len(queries), asked))
    distance = searched.surface.distances(queries[:, None], places[found])
    if searched.surface.name == "sphere":
        distance = np.radians(distance) * MEAN_RADIUS_KM
    kept = distance <= limit
    if exclude_self:
        kept &= (places[found] != queries[:, None]).any(axis=-1)
    sizes = np.where(kept, groups.sizes[found], 0)
    before = np.cumsum(sizes, axis=1) - sizes
    taken = np.clip(count - before, 0, sizes)
    some = np.nonzero(taken)
    times = taken[some]
    site = groups.values[spans(groups.offsets[found[some]], times)]
    return np.repeat(some[0], times), site, spans(before[some] + 1, times), np.repeat(distance[some], times)
