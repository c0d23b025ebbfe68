"""`stereodel triangulate`: the Delaunay triangulation of points."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from stereodel.cli import options

if TYPE_CHECKING:
    from pathlib import Path

    from stereodel import PlanarDelaunay, SphericalDelaunay
    from stereodel._arrays import Column
    from stereodel.io import PointTable

EXAMPLE = "stereodel triangulate stations.csv -o triangles.geojson"


def command(
    points: options.Points,
    out: options.Out,
    edges: Annotated[bool, typer.Option("--edges", help="Write the edges instead of the triangles.")] = False,
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
    """Write the Delaunay triangles of points, or their edges.

    Each triangle has the row numbers a, b, c of its corners in the table, counterclockwise; map formats also hold its
    shape. If all points lie in one hemisphere, the triangles that close the far side are left out.
    """
    from stereodel import PlanarDelaunay, SphericalDelaunay
    from stereodel.cli.application import reporting, say
    from stereodel.cli.destinations import MESHES, TABLES, Destination
    from stereodel.cli.failures import NothingToDoError
    from stereodel.cli.sources import read

    destination = Destination.of(out, format, TABLES + MESHES, points, overwrite=overwrite)
    table = read(points, lon=lon, lat=lat, plane=plane, layer=layer_name, crs=crs, skip_missing=skip_missing)
    with reporting(f"triangulating {len(table)} points"):
        kind = PlanarDelaunay if table.surface == "plane" else SphericalDelaunay
        triangulation = kind(table.points(latitude.value))
    count = len(_corner_rows(triangulation, "triangles", table)["a"])
    if count == 0:
        raise NothingToDoError(f"{table.name}: no triangles: too few points, or all on one line or great circle")
    what: Literal["triangles", "edges"] = "edges" if edges else "triangles"
    destination.write(lambda path: _save(path, triangulation, what, table, max_segment, latitude))
    say(f"{out}: {count} triangles of {len(table)} points")


def _save(
    path: Path,
    triangulation: PlanarDelaunay | SphericalDelaunay,
    what: Literal["triangles", "edges"],
    table: PointTable,
    max_segment: float,
    latitude: options.Latitude,
) -> None:
    """Write the row numbers of each triangle's corners, or of each edge's endpoints."""
    from stereodel.cli.application import reporting
    from stereodel.cli.destinations import MESHES, TABLES, save, save_csv, save_mesh
    from stereodel.io.rows_of import rows_of

    kind = path.suffix.lower().removeprefix(".")
    if kind == "csv":
        save_csv(path, _corner_rows(triangulation, what, table))
    elif kind in MESHES and what == "edges":
        raise ValueError(f"{path.name}: holds faces, not edges; leave out --edges or choose {', '.join(TABLES)}")
    elif kind in MESHES:
        save_mesh(path, triangulation, latitude)
    else:
        with reporting(f"drawing {what}") as shown:
            layer = rows_of(
                triangulation,
                what=what,
                latitude=latitude.value,
                max_segment=max_segment,
                crs=table.crs,
                progress=shown,
            )
        rows = {name: table.rows[layer.columns[name]] for name in "abc" if name in layer.columns}
        save(path, replace(layer, columns=rows))


def _corner_rows(triangulation: PlanarDelaunay | SphericalDelaunay, what: str, table: PointTable) -> dict[str, Column]:
    """Row numbers of the corners of all triangles except those that close the far side, or of their edges."""
    from stereodel import SphericalDelaunay
    from stereodel.triangulation.topology import edges_of

    simplices = triangulation.simplices
    if isinstance(triangulation, SphericalDelaunay):
        simplices = simplices[~triangulation.closing]
    corners = simplices if what == "triangles" else edges_of(simplices)
    return dict(zip("abc", table.rows[corners].T, strict=False))
