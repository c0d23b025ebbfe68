"""Writing data to a file whose extension selects the format."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, BinaryIO, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import as_choice
from stereodel._extras import optional
from stereodel._tasks.progress import Progress
from stereodel._tasks.whole_files import replacing, said_of, write_netcdf
from stereodel.interpolation import Contour
from stereodel.io.formats import wkb
from stereodel.io.formats.columns import check_held, objects
from stereodel.io.formats.delimited import write_csv
from stereodel.io.formats.gdal import DRIVERS, write_layer
from stereodel.io.formats.geojson import write_geojson
from stereodel.io.formats.map_rows import MapRows
from stereodel.io.formats.names import beside
from stereodel.io.formats.parquet import write_parquet
from stereodel.io.grids import Grid, write_geotiff
from stereodel.io.maps.dissolving import cell_columns, dividing
from stereodel.io.meshes import to_polydata, to_trimesh, to_ugrid
from stereodel.io.reading import read_points
from stereodel.io.rows_of import (
    MESHES,
    Columns,
    Mesh,
    corners_of,
    diagram_of,
    places_of,
    point_columns,
    rows_of,
    usual_kind,
)
from stereodel.io.table import AXES, PointTable
from stereodel.sphere.latitudes import Latitude

SAME: Final = {"json": "geojson", "geoparquet": "parquet", "tiff": "tif"}
"""Alternative extensions of formats."""


def write(
    path: str | os.PathLike[str] | BinaryIO,
    thing: Mesh | PointTable | Grid | list[Contour] | Any,
    *,
    format: str | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> None:
    """Write a triangulation, a diagram, a table of points, a grid of values or a GeoDataFrame as data.

    Parameters
    ----------
    path : path-like or binary stream
        Files are written completely or not at all; an existing file is replaced.
    thing : Mesh, PointTable, Grid, list of Contour, or geopandas.GeoDataFrame
        A triangulation or diagram; a table or frame for formats of tables; a grid for csv, nc or tif; contours for
        formats of lines.
    format : str, optional
        By default the extension of the path. Required for a stream.
    progress : callable, optional
        Called repeatedly with the name of the stage, how much of it is done, and how much there is, as of rows.
    **options
        Of what makes the contents: `to_ugrid` for nc, `to_trimesh` for glb and ply, `to_polydata` for vtp, else
        `to_geodataframe`; for geojson and geojsonl also ``decimals`` of `to_geojson`.

    Raises
    ------
    ValueError, TypeError
        If the extension or format is unknown, the format cannot hold `thing`, or an option does not apply.
    ImportError, OSError
        If the library for the format is missing, or the file cannot be written.

    Notes
    -----
    CSV, which needs no other library, and XLSX have for cells and sites one row for each point, duplicates included,
    with its coordinates, the area of its cell and `columns`, or with `dissolve` one for each value; for triangles and
    edges, the indices of their corners. Their options are `what`, `columns`, `latitude`, `radius` and `dissolve`.

    Examples
    --------
    >>> import io
    >>> from stereodel import SphericalVoronoi
    >>> diagram = SphericalVoronoi.from_lonlat([[10, 50], [10, -50], [190, 0]])
    >>> stream = io.BytesIO()
    >>> write(stream, diagram, format="csv", columns={"name": ["A", "B", "C"]}, radius=2.0)
    >>> print(stream.getvalue().decode().splitlines()[:2])
    ['lon,lat,area,name', '10,50,16.05702911834783,A']
    """
    kind, stem = format, "layer"
    if isinstance(path, str | os.PathLike):
        ending = Path(path).suffix.lower().removeprefix(".")
        kind, stem = format or SAME.get(ending, ending), Path(path).stem
    writer = WRITERS[as_choice(kind, tuple(WRITERS), "format")]
    own = {"decimals"} if kind in ("geojson", "geojsonl") else set()
    if not isinstance(thing, (*MESHES, list)) and (unknown := sorted(options.keys() - own)):
        raise TypeError(f"{', '.join(unknown)} is not an option where tables are written")
    with TemporaryDirectory() as folder:
        made = Path(folder, f"{stem}.{kind}")  # libraries go by the extension, and name the layer after the stem
        if not isinstance(path, str | os.PathLike):
            writer(thing, made, options, progress)
            with made.open("rb") as stream:
                shutil.copyfileobj(stream, path)
            return
        with said_of(path, folder):
            writer(thing, made, options, progress)
        # A shapefile consists of several files; the named one is written last, as the others mean nothing without it.
        for part in sorted(Path(folder).iterdir(), key=lambda part: part == made):
            with replacing(path if part == made else Path(path).with_suffix(part.suffix)) as temporary:
                shutil.copyfile(part, temporary)


def _layer(thing: Any, options: dict[str, Any]) -> MapRows:
    """The rows of a map for any supported `thing`."""
    if isinstance(thing, (*MESHES, list)):
        return rows_of(thing, **options)
    if isinstance(thing, MapRows):
        return thing
    if isinstance(thing, PointTable):
        rows = {name: objects(values.tolist()) if values.ndim > 1 else values for name, values in thing.columns.items()}
        return MapRows(beside(["geometry"], rows), wkb.points(thing.places), thing.crs)
    if not hasattr(thing, "geometry"):
        raise TypeError(f"thing must be a mesh, a PointTable or a GeoDataFrame, not {type(thing).__name__}")
    return MapRows.of_frame(thing)


def _write_table(thing: Any, path: Path, options: dict[str, Any], progress: Progress | None) -> None:
    if isinstance(thing, MESHES):
        columns = _mesh_columns(thing, **options)
    elif isinstance(thing, dict):
        columns = thing
    else:
        table = thing if isinstance(thing, Grid | PointTable) else read_points(_layer(thing, options).frame())
        columns = table.located()
    if path.suffix == ".xlsx":
        count = max((len(values) for values in columns.values()), default=0)
        write_layer(MapRows(columns, np.full(count, None, dtype=object)), path, progress=progress)
        return
    with path.open("w", encoding="utf-8", newline="") as stream:
        write_csv(columns, stream)


def _mesh_columns(
    mesh: Mesh,
    *,
    what: str | None = None,
    columns: Mapping[str, npt.ArrayLike] | None = None,
    latitude: Latitude | None = None,
    radius: float = 1.0,
    dissolve: str | None = None,
) -> Columns:
    kind = as_choice(what or usual_kind(mesh), ("cells", "sites", "triangles", "edges"), "what")
    if kind in ("triangles", "edges"):
        return dict(zip("abc", corners_of(mesh, kind).T, strict=False))
    places = places_of(mesh, mesh.points, latitude or mesh.latitude or "spherical")
    found = dict(zip(AXES[mesh.surface.name], places.T, strict=True))
    given = point_columns(columns, len(places))
    if dissolve is not None:
        by = dividing(dissolve, given, kind)
        found = cell_columns(diagram_of(mesh), radius, by)
        return found | beside(found, {dissolve: by[found["point"]]})
    if kind == "cells":
        found["area"] = diagram_of(mesh).areas(radius=radius)
    return found | beside(found, given)


def _write_rows(thing: Any, path: Path, options: dict[str, Any], progress: Progress | None) -> None:
    kind = path.suffix[1:]
    if kind == "parquet" and hasattr(thing, "to_parquet"):
        optional("pyarrow", "geo")
        thing.to_parquet(path)  # with its index and all its geometry columns
        return
    own = {"decimals": options.pop("decimals", None)} if kind in ("geojson", "geojsonl") else {}
    LAYERS[kind](_layer(thing, options), path, progress=progress, **own)


def _write_grid(thing: Any, path: Path, options: dict[str, Any], progress: Progress | None) -> None:
    if path.suffix == ".tif":
        write_geotiff(thing, path)
    elif isinstance(thing, Grid):
        write_netcdf(thing.to_xarray(), path, form="NETCDF3_64BIT")  # the classic format, which every reader supports
    else:
        check_held(point_columns(options.get("columns"), len(thing.points)), "nc")
        write_netcdf(to_ugrid(thing, **options), path)


def _write_trimesh(thing: Any, path: Path, options: dict[str, Any], progress: Progress | None) -> None:
    path.write_bytes(to_trimesh(thing, **options).export(file_type=path.suffix[1:]))


def _write_polydata(thing: Any, path: Path, options: dict[str, Any], progress: Progress | None) -> None:
    data = to_polydata(thing, **options)
    # In memory first: on a full disk VTK continues, or crashes.
    writer = optional("vtkmodules.vtkIOXML", "vtk").vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetDataModeToBinary()
    writer.WriteToOutputStringOn()
    writer.Write()
    path.write_text(writer.GetOutputString(), encoding="utf-8")


LAYERS: Final[dict[str, Callable[..., None]]] = {
    "geojson": write_geojson,
    "parquet": write_parquet,
    "geojsonl": write_geojson,
    **dict.fromkeys(DRIVERS, write_layer),
}
"""What writes rows of maps, by format."""

WRITERS: Final[dict[str, Callable[[Any, Path, dict[str, Any], Progress | None], None]]] = {
    "csv": _write_table,
    **dict.fromkeys(LAYERS, _write_rows),
    "xlsx": _write_table,
    **dict.fromkeys(("nc", "tif"), _write_grid),
    **dict.fromkeys(("glb", "ply"), _write_trimesh),
    "vtp": _write_polydata,
}
