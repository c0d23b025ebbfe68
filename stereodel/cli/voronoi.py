"""`stereodel voronoi`: the part of the Earth or the plane that is nearest to each point."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from pathlib import Path

    from stereodel import PlanarVoronoi, SphericalVoronoi
    from stereodel._arrays import FloatArray
    from stereodel.cli.sources import Columns, Table

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
    """Write the Voronoi cell of each point: what is nearer to it than to any other, with its area.

    A table has the columns of the points and the area; map formats have the cell's shape and the point's row too. Of
    points at one place the first has the cell, the others none and the area 0.
    """
    from stereodel import PlanarVoronoi, SphericalVoronoi
    from stereodel.cli.destinations import MESHES, TABLES, Destination
    from stereodel.cli.progress import say, stage
    from stereodel.cli.sources import read

    destination = Destination.of(out, format, TABLES + MESHES, points, overwrite=overwrite)
    table = read(points, lon=lon, lat=lat, plane=plane, layer=layer_name, crs=crs, skip_missing=skip_missing)
    with stage(f"cells of {len(table)} points"):
        places = table.points(latitude)
        diagram = PlanarVoronoi(places) if table.planar else SphericalVoronoi(places)
        name, area = _areas(diagram, area_unit)
    with stage(f"writing {out}"):
        destination.write(lambda path: _save(path, diagram, table, {name: area}, max_segment, latitude))
    say(f"{out}: cells of {len(table)} points")


def _areas(diagram: PlanarVoronoi | SphericalVoronoi, unit: AreaUnit) -> tuple[str, FloatArray]:
    """The name of the column and the areas."""
    from stereodel import PlanarVoronoi
    from stereodel.earth import AUTHALIC_RADIUS_KM

    if isinstance(diagram, PlanarVoronoi):
        return "area", diagram.areas()
    radius = AUTHALIC_RADIUS_KM if unit is AreaUnit.km2 else 1.0
    return f"area_{unit.value}", diagram.areas(radius=radius)


def _save(
    path: Path,
    diagram: PlanarVoronoi | SphericalVoronoi,
    table: Table,
    areas: Columns,
    max_segment: float,
    latitude: options.Latitude,
) -> None:
    """Write the cells of a table's points with the table's columns and their areas, (n,)."""
    from stereodel._extras import optional
    from stereodel.cli.destinations import MESHES, save_csv, save_mesh
    from stereodel.io import to_geodataframe, write

    kind = path.suffix.lower().removeprefix(".")
    if kind == "csv":
        save_csv(path, table.beside(areas))
    elif kind in MESHES:
        save_mesh(path, diagram, latitude)
    else:
        cells = to_geodataframe(diagram, latitude=latitude.value, max_segment=max_segment)
        point = cells["point"].to_numpy()
        rows = table.beside(areas, first={"row": table.rows}, taken=["geometry"])
        columns = {name: values[point] for name, values in rows.items()}
        write(path, optional("geopandas", "geo").GeoDataFrame(columns, geometry=cells.geometry, crs=cells.crs))
