"""`stereodel voronoi`: the part of the Earth or plane that is nearest to each point."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, Literal

import typer

from stereodel.cli import options

EXAMPLE = "stereodel voronoi cities.csv -o cells.gpkg"


@options.grouped
def command(
    *,
    points: options.Points,
    output: options.Output,
    area_unit: Annotated[Literal["km2", "sr"], typer.Option(help="Unit of the areas, not in a plane.")] = "km2",
    max_segment: options.MaxSegment = 1.0,
    clip: Annotated[
        str | None,
        typer.Option(
            metavar="land|FILE", help="Clip the cells to land, or to the polygons of a file; areas are those inside."
        ),
    ] = None,
    columns: options.AnyTable,
    latitude: options.LatitudeKind = "authalic",
) -> None:
    """Write the Voronoi cell of each point, the region nearer to it than to any other, with its area.

    A table has the columns of the points and the area; map formats also hold the cell's shape and the point's row. Of
    several points at one place the first gets the cell, the others no cell and area 0. With --clip, cells are clipped
    to land or to the polygons of a file. For more points than memory holds there is the command partition.
    """
    import numpy as np

    from stereodel import PlanarVoronoi, SphericalVoronoi
    from stereodel.cli.application import reporting, say
    from stereodel.earth import AUTHALIC_RADIUS_KM
    from stereodel.io import write
    from stereodel.io.formats.names import beside, naming
    from stereodel.io.rows_of import rows_of

    destination = output.of(options.TABLES + options.MESHES, points, clip)
    kind = destination.kind
    if kind in options.MESHES:
        options.refuse({"--clip": clip}, f"{', '.join(options.TABLES)}, and {output.out} holds whole cells")
    if columns.plane is not None:
        options.refuse({"--clip": clip}, "cells of the sphere, not of a plane")
    table = columns.read(points)
    with reporting(f"cells of {len(table)} points"):
        diagram = (PlanarVoronoi if columns.plane else SphericalVoronoi)(table.points(latitude))
    name = "area" if columns.plane else f"area_{area_unit}"
    radius = 1.0 if columns.plane or area_unit == "sr" else AUTHALIC_RADIUS_KM
    found: Any = diagram
    if kind == "csv" and clip is None:
        found = table.beside({name: diagram.areas(radius=radius)})
    elif kind not in options.MESHES:
        drawn: dict[str, Any] = {"latitude": latitude, "radius": radius, "max_segment": max_segment, "clip": clip}
        with reporting(f"drawing {len(table)} cells") as told, naming(clip):
            cells = rows_of(diagram, crs=table.crs, progress=told, **drawn)
        point, area = cells.columns["point"], np.zeros(len(table))
        area[point] = cells.columns["area"]
        if kind == "csv":
            found = table.beside({name: area})
        else:
            rows = table.beside({name: area}, first={"row": table.rows}).taken(point)
            found = replace(cells, columns=beside(["geometry"], rows.located()))
    with reporting(f"writing {output.out}") as told, destination.file() as path:
        if kind in options.PICTURES:
            from stereodel.drawing import diagram_page

            diagram_page(diagram).save(path)
        else:
            write(path, found, progress=told, **({"latitude": latitude} if kind == "nc" else {}))
    said = "" if columns.plane else f", with {latitude} latitudes"
    say(f"{output.out}: cells of {len(table)} points{said}")
