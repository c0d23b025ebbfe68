"""Cells, triangles and edges as files: what is known of each as a table, with its shape in map formats; meshes."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from stereodel import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi
from stereodel._extras import optional
from stereodel.cli.options import Latitude
from stereodel.cli.sources import Columns, Table
from stereodel.cli.tables import TABLES, save_table
from stereodel.io import to_geodataframe, write
from stereodel.triangulation.topology import edges_of

PICTURES = ("svg", "pdf")
MESHES = ("nc", "glb", "ply", "vtp", *PICTURES)
SHAPES = TABLES + MESHES


def save_cells(
    path: Path,
    diagram: PlanarVoronoi | SphericalVoronoi,
    table: Table,
    areas: Columns,
    *,
    max_segment: float,
    latitude: Latitude,
) -> None:
    """Write the cells of a table's points with the table's columns and their areas, (n,)."""
    if path.suffix.lower() == ".csv":
        save_table(path, table.axes, table.all_columns() | areas)
        return
    if save_mesh(path, diagram, latitude):
        return
    cells = to_geodataframe(diagram, what="cells", latitude=latitude.value, max_segment=max_segment)
    point = cells["point"].to_numpy()
    columns = {name: values[point] for name, values in ({"row": table.rows} | table.columns | areas).items()}
    write(path, optional("geopandas", "geo").GeoDataFrame(columns, geometry=cells.geometry, crs=cells.crs))


def save_simplices(
    path: Path,
    triangulation: PlanarDelaunay | SphericalDelaunay,
    what: Literal["triangles", "edges"],
    table: Table,
    *,
    max_segment: float,
    latitude: Latitude,
) -> None:
    """Write the rows in the table of each triangle's corners, or of each edge's ends."""
    if path.suffix.lower() == ".csv":
        save_table(path, ("a", "b"), corner_rows(triangulation, what, table))
        return
    if save_mesh(path, triangulation, latitude, faces=what == "triangles"):
        return
    frame = to_geodataframe(triangulation, what=what, latitude=latitude.value, max_segment=max_segment)
    corners = [name for name in "abc" if name in frame]
    write(path, frame[[*corners, "geometry"]].assign(**{name: table.rows[frame[name]] for name in corners}))


def save_mesh(
    path: Path,
    mesh: PlanarDelaunay | PlanarVoronoi | SphericalDelaunay | SphericalVoronoi,
    latitude: Latitude,
    *,
    faces: bool = True,
) -> bool:
    """Write cells or triangles alone where the format is one of meshes or pictures; whether it is."""
    kind = path.suffix.lower().removeprefix(".")
    if kind not in MESHES:
        return False
    if not faces:
        raise ValueError(f"{path.name}: holds faces, not edges; leave out --edges or choose {', '.join(TABLES)}")
    if kind in PICTURES:
        from stereodel.drawing import diagram_page
        from stereodel.render import save_page

        save_page(diagram_page(mesh), path)
    else:
        write(path, mesh, **({"latitude": latitude.value} if kind == "nc" else {}))
    return True


def corner_rows(triangulation: PlanarDelaunay | SphericalDelaunay, what: str, table: Table) -> Columns:
    """Rows of the corners of all triangles that are no part of the far side, or of their edges."""
    simplices = triangulation.simplices
    if isinstance(triangulation, SphericalDelaunay):
        simplices = simplices[~triangulation.closing]
    corners = simplices if what == "triangles" else edges_of(simplices)
    return dict(zip("abc", table.rows[corners].T, strict=False))
