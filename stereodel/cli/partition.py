"""`stereodel partition`: the Voronoi cells of more points than memory holds, in partitions, as files in a folder."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from stereodel._tasks.interrupts import stop_if_interrupted
from stereodel.cli import options
from stereodel.cli.application import ARGUMENTS, NothingToDoError, reporting, say
from stereodel.io.formats.names import spelling

EXAMPLE = "stereodel partition points/*.parquet -o cells"

KEPT = "interrupted; what is done is kept, and the same command goes on from there"


@options.grouped
def command(
    *,
    points: Annotated[list[str], typer.Argument(metavar="POINTS", help="Parquet files, folders, or a HATS catalogue.")],
    out: Annotated[str, typer.Option("--out", "-o", metavar="FOLDER", help="Folder of the results.")],
    lon: Annotated[str | None, typer.Option(metavar="COLUMN", help="Column of longitudes, given with --lat.")] = None,
    lat: Annotated[str | None, typer.Option(metavar="COLUMN", help="Column of latitudes, given with --lon.")] = None,
    plane: Annotated[tuple[str, str] | None, typer.Option(metavar="X Y", help="Columns of a plane instead.")] = None,
    latitude: options.LatitudeKind = "authalic",
    partition: Annotated[int | None, typer.Option(metavar="COUNT", min=1, help="Points of each; else 650000.")] = None,
    shapes: Annotated[bool, typer.Option("--shapes", help="Write the shapes of the cells too.")] = False,
    keep: Annotated[list[str] | None, typer.Option(metavar="COLUMN", help="Column to keep; repeatable.")] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Begin anew, replacing the results.")] = False,
) -> None:
    """Write the areas and neighbours of Voronoi cells, as Parquet files in a folder.

    It gets rows/ with the area in steradians, the number of neighbours, the nearest point and its distance, in as many
    files and rows as the points have. An interrupted command goes on where it stopped.
    """
    from stereodel.partitioned import Execution, triangulate

    if (lon is None) != (lat is None):
        raise ValueError("--lon and --lat are given together")
    names = {**ARGUMENTS, "columns": "--plane" if plane else "--lon"}
    written: dict[str, Any] = {"keep": keep or [], "triangles": False, "cells": shapes}
    with reporting() as progress, spelling(names):
        try:
            run = triangulate(
                points[0] if len(points) == 1 else points,
                out,
                columns=plane or (None if lon is None or lat is None else (lon, lat)),
                surface="plane" if plane else "sphere",
                latitude=latitude,
                **written,
                execution=Execution(partition or Execution.partition, resume=not overwrite, progress=progress),
            )
        except KeyboardInterrupt:
            raise KeyboardInterrupt(KEPT) from None
        except (RuntimeError, TypeError) as error:  # another run holds the folder; a column has no numbers
            raise ValueError(str(error)) from error
    stop_if_interrupted()
    found = run.statistics
    if not found["points"]:
        raise NothingToDoError(f"{', '.join(points)}: there are no points")
    kind = "" if plane else f", with {latitude} latitudes"
    say(f"{out}: cells of {found['points']} points, in {found['partitions']} partitions{kind}")
