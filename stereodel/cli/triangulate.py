"""`stereodel triangulate`: the Delaunay triangulation of points."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, Literal

import typer

from stereodel.cli import options
from stereodel.sphere.latitudes import Latitude

EXAMPLE = "stereodel triangulate stations.csv -o triangles.geojson"


@options.grouped
def command(
    *,
    points: options.Points,
    output: options.Output,
    edges: Annotated[bool, typer.Option("--edges", help="Write the edges instead of the triangles.")] = False,
    max_segment: options.MaxSegment = 1.0,
    columns: options.AnyTable,
    latitude: options.LatitudeKind = "authalic",
) -> None:
    """Write the Delaunay triangles of points, or their edges.

    Each triangle has the row numbers a, b, c of its corners in the table, counterclockwise; map formats also hold its
    shape. If all points lie in one hemisphere, the triangles that close the far side are left out.
    """
    from stereodel.cli.application import NothingToDoError, reporting, say
    from stereodel.io.rows_of import corners_of, rows_of
    from stereodel.triangulation.delaunay import as_triangulation

    destination = output.of(options.TABLES + options.MESHES, points)
    kind = destination.kind
    if edges and kind in options.MESHES:
        raise ValueError(f"{output.out}: holds faces, not edges; drop --edges or choose {', '.join(options.TABLES)}")
    table = columns.read(points)
    with reporting(f"triangulating {len(table)} points"):
        triangulation = as_triangulation(table.points(latitude))
    count = len(corners_of(triangulation, "triangles"))
    if count == 0:
        raise NothingToDoError(f"{table.name}: no triangles: too few points, or all on one line or great circle")
    what: Literal["triangles", "edges"] = "edges" if edges else "triangles"
    found: Any = triangulation
    if kind in options.FLAT:
        found = dict(zip("abc", table.rows[corners_of(triangulation, what)].T, strict=False))
    elif kind not in options.MESHES:
        with reporting(f"drawing {what}") as shown:
            said: dict[str, Any] = {"what": what, "latitude": latitude, "max_segment": max_segment, "crs": table.crs}
            layer = rows_of(triangulation, progress=shown, **said)
        rows = {name: table.rows[layer.columns[name]] for name in "abc" if name in layer.columns}
        found = replace(layer, columns=rows)
    written(destination, triangulation, found, table.columns, latitude)
    say(f"{output.out}: {count} triangles of {len(table)} points")


def written(place: options.Destination, mesh: Any, found: Any, columns: Any, latitude: Latitude) -> None:
    """Write what was found, or draw the triangulation or diagram that it is of."""
    from stereodel.cli.application import reporting
    from stereodel.io import write

    own: dict[str, Any] = {"columns": columns} if place.kind in options.VALUED else {}
    own |= {"latitude": latitude} if place.kind == "nc" else {}
    with reporting(f"writing {place.name}") as told, place.file() as path:
        if place.kind in options.PICTURES:
            from stereodel.drawing import diagram_page

            diagram_page(mesh).save(path)
        else:
            write(path, found, progress=told, **own)
