"""`stereodel voronoi`: the part of the Earth or plane that is nearest to each point."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, Literal

import typer

from stereodel.cli import options
from stereodel.cli.triangulate import written

EXAMPLE = "stereodel voronoi cities.csv -o cells.gpkg"


@options.grouped
def command(
    *,
    points: options.Points,
    output: options.Output,
    area_unit: Annotated[Literal["km2", "sr"], typer.Option(help="Unit of the areas, not in a plane.")] = "km2",
    max_segment: options.MaxSegment = 1.0,
    clip: Annotated[str | None, typer.Option(metavar="land|FILE", help="Clip to land or a file's polygons.")] = None,
    dissolve: Annotated[str | None, typer.Option(metavar="COLUMN", help="One feature for equal values.")] = None,
    of: Annotated[str | None, typer.Option(metavar="FILE", help="Points to gather by cells.")] = None,
    sums: Annotated[list[str] | None, typer.Option("--sum", metavar="COLUMN", help="Column of --of to add up.")] = None,
    means: Annotated[list[str] | None, typer.Option("--mean", metavar="COLUMN", help="The same to average.")] = None,
    rows: Annotated[bool, typer.Option("--rows", help="Count the rows of --of.")] = False,
    columns: options.AnyTable,
    of_columns: Annotated[options.SecondTable, "--of"],
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
    from stereodel.io.formats.names import beside, naming, note
    from stereodel.io.maps.dissolving import added, averaged, cell_columns, codes_of, grouped
    from stereodel.io.rows_of import rows_of

    destination = output.of(options.TABLES + options.MESHES, points, clip, of)
    kind = destination.kind
    if kind in options.MESHES:
        whole = {"--clip": clip, "--dissolve": dissolve, "--of": of}
        options.refuse(whole, f"{', '.join(options.TABLES)}, and {output.out} holds whole cells")
    if columns.plane is not None:
        options.refuse({"--clip": clip}, "cells of the sphere, not of a plane")
    if of is None:
        asked = {"--sum": sums, "--mean": means, "--rows": rows}
        options.refuse(asked | of_columns.given, "the table --of, and there is none")
    elif not (sums or means or rows):
        raise ValueError("--of needs --sum, --mean or --rows, which say what to gather of its points")
    table = columns.read(points)
    by = np.arange(len(table)) if dissolve is None else table.column(dissolve)
    with reporting(f"cells of {len(table)} points"):
        diagram = (PlanarVoronoi if columns.plane else SphericalVoronoi)(table.points(latitude))
    unit, ending = ("", "") if columns.plane else (f"_{area_unit}", f", with {latitude} latitudes")
    radius = AUTHALIC_RADIUS_KM if unit == "_km2" else 1.0
    found: Any = diagram
    if kind not in options.MESHES:
        if kind in options.FLAT and clip is None:
            drawn: dict[str, Any] = cell_columns(diagram, radius, None if dissolve is None else by)
        else:
            said: dict[str, Any] = {} if dissolve is None else {"columns": {"by": by}, "dissolve": "by"}
            said |= {"latitude": latitude, "radius": radius, "max_segment": max_segment, "crs": table.crs}
            with reporting(f"drawing {len(table)} cells") as told, naming(clip):
                cells = rows_of(diagram, clip=clip, progress=told, **said)
            drawn = dict(cells.columns)
        point, area = drawn["point"], drawn["area"]
        shown, count = int(np.sum(drawn.get("cells", len(point)))), int(np.sum(diagram.is_kept))
        if clip is not None and shown < count:
            note(f"{count - shown} of {count} cells have no part inside --clip")
        if kind in options.FLAT and dissolve is None:  # all points have a row
            point, area = np.arange(len(table)), np.zeros(len(table))
            area[drawn["point"]] = drawn["area"]
        codes = by if dissolve is None else codes_of(by)
        row = np.full(len(table), -1)
        row[codes[point]] = np.arange(len(point))
        results: dict[str, Any] = {f"area{unit}": area}
        if of is not None:
            others = of_columns.read(of, columns)
            with reporting(f"cells of {len(others)} points"):
                nearest = diagram.delaunay().nearest(others.points(latitude))
            cell = row[codes[nearest]]
            for what, names, together in (("sum", sums, added), ("mean", means, averaged)):
                for each in names or ():
                    values = others.numbers(each, gaps=columns.skip_missing)
                    results[f"{what}_{each}"] = together(values, grouped(cell, ~np.isnan(values), len(point)))
            results |= {"rows": grouped(cell, True, len(point)).sizes} if rows else {}
        if dissolve is None:
            numbered = {} if kind in options.FLAT else {"row": table.rows[point]}
            found = table.taken(point).beside(results, first=numbered).located()
        else:
            results = {"cells": drawn["cells"], **results}
            found = beside(results, {dissolve: by[point]}) | results
        if kind not in options.FLAT:
            found = replace(cells, columns=beside(["geometry"], found))
    written(destination, diagram, found, table.columns, latitude)
    say(f"{output.out}: cells of {len(table)} points{ending}")
