"""`stereodel voronoi`: the part of the Earth or plane that is nearest to each point."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace
from typing import Annotated, Literal

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

    from stereodel.cli.application import reporting, say
    from stereodel.cli.destinations import MESHES, TABLES
    from stereodel.earth import AUTHALIC_RADIUS_KM
    from stereodel.io.formats.names import beside
    from stereodel.io.maps.meshes_as_rows import diagram_of
    from stereodel.io.reading import naming
    from stereodel.io.rows_of import rows_of
    from stereodel.triangulation.delaunay import as_triangulation

    destination = output.of(TABLES + MESHES, points, clip)
    kind = destination.kind
    if kind in MESHES:
        options.refuse({"--clip": clip}, f"{', '.join(TABLES)}, and {output.out} holds whole cells")
    if columns.plane is not None:
        options.refuse({"--clip": clip}, "cells of the sphere, not of a plane")
    table = columns.read(points)
    with reporting(f"cells of {len(table)} points"):
        diagram = diagram_of(as_triangulation(table.points(latitude)))
    name = "area" if columns.plane else f"area_{area_unit}"
    radius = 1.0 if columns.plane or area_unit == "sr" else AUTHALIC_RADIUS_KM
    if kind in MESHES:
        destination.put(diagram, **({"latitude": latitude} if kind == "nc" else {}))
    elif kind == "csv" and clip is None:
        destination.put(table.beside({name: diagram.areas(radius=radius)}))
    else:
        with reporting(f"drawing {len(table)} cells") as shown, naming(clip) if clip else nullcontext():
            cells = rows_of(
                diagram,
                latitude=latitude,
                radius=radius,
                max_segment=max_segment,
                clip=clip,
                crs=table.crs,
                progress=shown,
            )
        point, area = cells.columns["point"], np.zeros(len(table))
        area[point] = cells.columns["area"]
        if kind == "csv":
            destination.put(table.beside({name: area}))
        else:
            rows = table.beside({name: area}, first={"row": table.rows}).located()
            named = {name: values[point] for name, values in beside(["geometry"], rows).items()}
            destination.put(replace(cells, columns=named))
    said = "" if columns.plane else f", with {latitude} latitudes"
    say(f"{output.out}: cells of {len(table)} points{said}")
