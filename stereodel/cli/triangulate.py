"""`stereodel triangulate`: the Delaunay triangulation of points."""

from __future__ import annotations

from typing import Annotated, Literal

import typer

from stereodel.cli import options

EXAMPLE = "stereodel triangulate stations.csv -o triangles.geojson"


def command(
    points: options.Points,
    out: options.Out,
    edges: Annotated[bool, typer.Option("--edges", help="Write the edges instead of the triangles.")] = False,
    max_segment: options.MaxSegment = 1.0,
    lon: options.Lon = None,
    lat: options.Lat = None,
    plane: options.Plane = None,
    latitude: options.LatitudeKind = options.Latitude.spherical,
    format: options.Format = None,
) -> None:
    """Write the Delaunay triangles of points, or their edges.

    Each triangle has the rows of its corners a, b, c in the table, counterclockwise; map formats have its shape too. Of
    points in one hemisphere, the triangles that close the far side are left out.
    """
    from stereodel import PlanarDelaunay, SphericalDelaunay
    from stereodel.cli.destinations import Destination
    from stereodel.cli.failures import NothingToDoError
    from stereodel.cli.progress import say, stage
    from stereodel.cli.shapes import SHAPES, corner_rows, save_simplices
    from stereodel.cli.sources import read

    destination = Destination.of(out, format, SHAPES)
    table = read(points, lon=lon, lat=lat, plane=plane)
    with stage(f"triangulating {len(table)} points"):
        kind = PlanarDelaunay if table.planar else SphericalDelaunay
        triangulation = kind(table.points(latitude))
    count = len(corner_rows(triangulation, "triangles", table)["a"])
    if count == 0:
        raise NothingToDoError(f"{table.name}: no triangles: too few points, or all on one line or great circle")
    what: Literal["triangles", "edges"] = "edges" if edges else "triangles"
    with stage(f"writing {out}"):
        destination.write(
            lambda path: save_simplices(path, triangulation, what, table, max_segment=max_segment, latitude=latitude)
        )
    say(f"{out}: {count} triangles of {len(table)} points")
