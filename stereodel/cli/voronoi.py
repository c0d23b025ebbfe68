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
    from stereodel.cli.sources import Table

EXAMPLE = "stereodel voronoi cities.csv -o cells.gpkg"


class AreaUnit(StrEnum):
    """Units of areas on the sphere."""

    km2 = "km2"
    sr = "sr"


def command(
    points: options.Points,
    out: options.Out,
    area_unit: Annotated[AreaUnit, typer.Option(help="Unit of the areas.")] = AreaUnit.km2,
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
) -> None:
    """Write the Voronoi cell of each point, the region nearer to it than to any other, with its area.

    A table has the columns of the points and the area; map formats have the cell's shape and the point's row too. Of
    points at one place the first has the cell, the others none and the area 0. With --clip a cell is what lies on land,
    or in the polygons of a file.
    """
    from stereodel import PlanarVoronoi, SphericalVoronoi
    from stereodel.cli.destinations import MESHES, TABLES, Destination
    from stereodel.cli.progress import say, stage
    from stereodel.cli.sources import read

    destination = Destination.of(out, format, TABLES + MESHES, points, clip, overwrite=overwrite)
    if destination.kind in MESHES:
        options.refuse({"--clip": clip}, f"{', '.join(TABLES)}, and {out} holds whole cells")
    if plane is not None:
        options.refuse({"--clip": clip}, "cells of the sphere, not of a plane")
    table = read(points, lon=lon, lat=lat, plane=plane, layer=layer_name, crs=crs, skip_missing=skip_missing)
    with stage(f"cells of {len(table)} points"):
        places = table.points(latitude)
        diagram = PlanarVoronoi(places) if table.planar else SphericalVoronoi(places)
    destination.write(lambda path: _save(path, diagram, table, area_unit, clip, max_segment, latitude))
    say(f"{out}: cells of {len(table)} points")


def _save(
    path: Path,
    diagram: PlanarVoronoi | SphericalVoronoi,
    table: Table,
    unit: AreaUnit,
    clip: str | None,
    max_segment: float,
    latitude: options.Latitude,
) -> None:
    """Write the cells of a table's points with the table's columns and their areas."""
    import numpy as np

    from stereodel.cli.destinations import MESHES, save_csv, save_layer, save_mesh
    from stereodel.cli.progress import bar
    from stereodel.cli.sources import naming
    from stereodel.earth import AUTHALIC_RADIUS_KM
    from stereodel.io.frames import layer_of

    kind = path.suffix.lower().removeprefix(".")
    name = "area" if table.planar else f"area_{unit.value}"
    radius = 1.0 if table.planar or unit is AreaUnit.sr else AUTHALIC_RADIUS_KM
    if kind in MESHES:
        save_mesh(path, diagram, latitude)
        return
    if kind == "csv" and clip is None:
        save_csv(path, table.beside({name: diagram.areas(radius=radius)}))
        return
    with bar(f"drawing {len(table)} cells") as shown, naming(clip) if clip else nullcontext():
        cells = layer_of(
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
        save_csv(path, table.beside({name: area}))
        return
    rows = table.beside({name: area}, first={"row": table.rows}, taken=["geometry"])
    save_layer(path, replace(cells, columns={name: values[point] for name, values in rows.items()}))
