"""`stereodel voronoi`: the part of the Earth or the plane that is nearest to each point."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from stereodel import PlanarVoronoi, SphericalVoronoi
    from stereodel._arrays import FloatArray

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
    latitude: options.LatitudeKind = options.Latitude.spherical,
    format: options.Format = None,
) -> None:
    """Write the Voronoi cell of each point: what is nearer to it than to any other, with its area.

    A table has the columns of the points and the area; map formats have the cell's shape too. Of points at one place
    the first has the cell, the others none and the area 0.
    """
    from stereodel import PlanarVoronoi, SphericalVoronoi
    from stereodel.cli.destinations import Destination
    from stereodel.cli.progress import say, stage
    from stereodel.cli.shapes import SHAPES, save_cells
    from stereodel.cli.sources import read

    destination = Destination.of(out, format, SHAPES)
    table = read(points, lon=lon, lat=lat, plane=plane)
    with stage(f"cells of {len(table)} points"):
        places = table.points(latitude)
        diagram = PlanarVoronoi(places) if table.planar else SphericalVoronoi(places)
        areas = dict([_areas(diagram, area_unit)])
    with stage(f"writing {out}"):
        destination.write(
            lambda path: save_cells(path, diagram, table, areas, max_segment=max_segment, latitude=latitude)
        )
    say(f"{out}: cells of {len(table)} points")


def _areas(diagram: PlanarVoronoi | SphericalVoronoi, unit: AreaUnit) -> tuple[str, FloatArray]:
    """The name of the column and the areas."""
    from stereodel import PlanarVoronoi
    from stereodel.earth import AUTHALIC_RADIUS_KM

    if isinstance(diagram, PlanarVoronoi):
        return "area", diagram.areas()
    radius = AUTHALIC_RADIUS_KM if unit is AreaUnit.km2 else 1.0
    return f"area_{unit.value}", diagram.areas(radius=radius)
