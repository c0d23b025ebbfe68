"""`stereodel voronoi`: the part of the Earth or plane that is nearest to each point."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from pathlib import Path

    from stereodel import PlanarVoronoi, SphericalVoronoi
    from stereodel.io import PointTable

EXAMPLE = "stereodel voronoi cities.csv -o cells.gpkg"


class AreaUnit(StrEnum):
    """Units of areas on the sphere."""

    km2 = "km2"
    sr = "sr"


def command(
    points: Annotated[
        list[str],
        typer.Argument(metavar="POINTS...", help="Table of points: .csv, .gpkg …, - is stdin; for a folder .parquet."),
    ],
    out: Annotated[
        str,
        typer.Option(
            "--out", "-o", metavar="FILE|FOLDER/", help="File, whose extension is the format, or folder; - is stdout."
        ),
    ],
    area_unit: Annotated[
        AreaUnit | None, typer.Option(help="Unit of the areas, km2 by default; in a folder they are sr.")
    ] = None,
    max_segment: options.MaxSegment = 1.0,
    clip: Annotated[
        str | None,
        typer.Option(
            metavar="land|FILE", help="Clip the cells to land, or to the polygons of a file; areas are those inside."
        ),
    ] = None,
    lon: options.Lon = None,
    lat: options.Lat = None,
    plane: options.Plane = None,
    layer_name: options.LayerName = None,
    crs: options.Crs = None,
    skip_missing: options.SkipMissing = False,
    latitude: options.LatitudeKind = options.Latitude.authalic,
    format: options.Format = None,
    overwrite: options.Overwrite = False,
    partition: Annotated[
        int | None, typer.Option(metavar="COUNT", min=1, help="Points of a partition, for a folder; 650000 by default.")
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Scheduler of Dask whose workers compute, for a folder.")
    ] = None,
    shapes: Annotated[bool, typer.Option("--shapes", help="Write the shapes of the cells too, for a folder.")] = False,
    keep: Annotated[
        list[str] | None,
        typer.Option(metavar="COLUMN", help="Column to write beside the results, repeatable; for a folder."),
    ] = None,
) -> None:
    """Write the Voronoi cell of each point, the region nearer to it than to any other, with its area.

    A table has the columns of the points and the area; map formats also hold the cell's shape and the point's row. Of
    several points at one place the first gets the cell, the others no cell and area 0. With --clip, cells are clipped
    to land or to the polygons of a file.

    A folder, which ends in / or is there, is for more points than memory holds: Parquet files, folders of them or a
    HATS catalogue. It gets rows/ with the area, the number of neighbours, the nearest point and its distance, in as
    many files and rows as the points have. An interrupted command goes on where it stopped.
    """
    from stereodel.cli.partitions import Work, is_folder

    if is_folder(out):
        work = Work(points, out, lon, lat, plane, latitude.value, partition, shapes, keep or [], overwrite)
        of_files = {
            "--clip": clip,
            "--layer-name": layer_name,
            "--crs": crs,
            "--skip-missing": skip_missing,
            "--format": format,
            "--area-unit km2": area_unit is AreaUnit.km2,
        }
        options.refuse(of_files, f"results in a file, not in the folder {out}")
        work.run(scheduler)
        return
    of_folders = {"--partition": partition, "--scheduler": scheduler, "--shapes": shapes, "--keep": keep}
    options.refuse(of_folders, f"results in a folder, such as --out cells/, not in {out}")
    if len(points) > 1:
        raise ValueError(f"results of {len(points)} files need a folder, such as --out cells/, not {out}")
    from stereodel import PlanarVoronoi, SphericalVoronoi
    from stereodel.cli.application import reporting, say
    from stereodel.cli.destinations import MESHES, TABLES, Destination
    from stereodel.cli.sources import read

    name = points[0]
    destination = Destination.of(out, format, TABLES + MESHES, name, clip, overwrite=overwrite)
    if destination.kind in MESHES:
        options.refuse({"--clip": clip}, f"{', '.join(TABLES)}, and {out} holds whole cells")
    if plane is not None:
        options.refuse({"--clip": clip}, "cells of the sphere, not of a plane")
    table = read(name, lon=lon, lat=lat, plane=plane, layer=layer_name, crs=crs, skip_missing=skip_missing)
    planar = table.surface == "plane"
    with reporting(f"cells of {len(table)} points"):
        kind = PlanarVoronoi if planar else SphericalVoronoi
        diagram = kind(table.points(latitude.value))
    destination.write(lambda path: _save(path, diagram, table, area_unit or AreaUnit.km2, clip, max_segment, latitude))
    say(f"{out}: cells of {len(table)} points" + ("" if planar else f", with {latitude.value} latitudes"))


def _save(
    path: Path,
    diagram: PlanarVoronoi | SphericalVoronoi,
    table: PointTable,
    unit: AreaUnit,
    clip: str | None,
    max_segment: float,
    latitude: options.Latitude,
) -> None:
    """Write the cells of a table's points with the table's columns and their areas."""
    import numpy as np

    from stereodel.cli.application import reporting
    from stereodel.cli.destinations import MESHES, save, save_mesh
    from stereodel.earth import AUTHALIC_RADIUS_KM
    from stereodel.io.formats.names import beside
    from stereodel.io.reading import naming
    from stereodel.io.rows_of import rows_of

    kind = path.suffix.lower().removeprefix(".")
    planar = table.surface == "plane"
    name = "area" if planar else f"area_{unit.value}"
    radius = 1.0 if planar or unit is AreaUnit.sr else AUTHALIC_RADIUS_KM
    if kind in MESHES:
        save_mesh(path, diagram, latitude)
        return
    if kind == "csv" and clip is None:
        save(path, table.beside({name: diagram.areas(radius=radius)}))
        return
    with reporting(f"drawing {len(table)} cells") as shown, naming(clip) if clip else nullcontext():
        cells = rows_of(
            diagram,
            latitude=latitude.value,
            radius=radius,
            max_segment=max_segment,
            clip=clip,
            crs=table.crs,
            progress=shown,
        )
    point, area = cells.columns["point"], np.zeros(len(table))
    area[point] = cells.columns["area"]
    if kind == "csv":
        save(path, table.beside({name: area}))
        return
    rows = table.beside({name: area}, first={"row": table.rows}).located()
    columns = {name: values[point] for name, values in beside(["geometry"], rows).items()}
    save(path, replace(cells, columns=columns))
