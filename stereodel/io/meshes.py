"""Meshes for other programs: UGRID by xarray, GLB and PLY by trimesh, PyVista."""

from __future__ import annotations

import colorsys
import re
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import Bytes, FloatArray, Indices, IntArray, as_choice, as_floats, as_scalar
from stereodel._extras import optional
from stereodel._spaces import SPHERE
from stereodel.curves.clip import points_along
from stereodel.curves.ragged import Ragged, spans
from stereodel.curves.trace import sides_of
from stereodel.io.formats.columns import as_text, check_held, of_objects, plain_cells
from stereodel.io.formats.names import DataWarning, beside, note
from stereodel.io.rows_of import (
    LARGEST_SEGMENT,
    Columns,
    Mesh,
    diagram_of,
    places_of,
    point_columns,
    ridge_net,
    triangles_of,
    triangulation_of,
    usual_kind,
    voronoi_sides,
)
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import units
from stereodel.triangulation.topology import as_edges

GOLDEN: Final = (np.sqrt(5.0) - 1) / 2
LOOKS: Final = ((0.20, 0.97), (0.38, 0.93), (0.52, 0.84))
"""Saturation and value of pale colours."""

FILL: Final = -1
"""What short rows of a table of nodes are padded with."""

LONLAT: Final = {
    "lon": {"standard_name": "longitude", "units": "degrees_east"},
    "lat": {"standard_name": "latitude", "units": "degrees_north"},
}
CARTESIAN: Final = {axis: {"long_name": f"Cartesian {axis}", "units": "1"} for axis in "xyz"}
"""Names of coordinates, and their attributes by the CF conventions."""


def to_trimesh(
    mesh: Mesh, *, what: str | None = None, colors: npt.ArrayLike | None = None, max_segment: float = 5.0
) -> Any:
    """Triangles or coloured cells as a trimesh.Trimesh, for GLB, PLY and the other formats that trimesh writes.

    Parameters
    ----------
    mesh : SphericalDelaunay, SphericalVoronoi, PlanarDelaunay or PlanarVoronoi
    what : {"triangles", "cells"}, optional
        By default the triangles of a triangulation and the cells of a diagram.
    colors : (n, 3) or (n, 4) array_like, optional
        Of each triangle, or each point's cell: integers from 0 to 255, or floats from 0 to 1. By default cells have
        pale colours, and triangles none.
    max_segment : float, optional
        Longest side, in degrees, of the triangles that make up a cell, in (0, 90]. Sphere only.

    Returns
    -------
    trimesh.Trimesh
        Flat triangles, on the sphere the facets of the convex hull, which share the points as vertices unless they have
        colours. Cells do not share vertices; ``vertex_attributes["point"]`` is the index of each one's point. Unbounded
        cells are left out. The plane is z = 0.

    Raises
    ------
    ValueError, TypeError
        If an argument has the wrong shape, range or type.

    Examples
    --------
    >>> from stereodel import SphericalDelaunay
    >>> globe = to_trimesh(SphericalDelaunay([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]))
    >>> globe.is_watertight, round(float(globe.volume), 6)
    (True, 1.333333)
    """
    step = as_scalar(max_segment, "max_segment", low=0.0, high=LARGEST_SEGMENT, open_low=True)
    trimesh = optional("trimesh", "mesh")
    if as_choice(what or usual_kind(mesh), ("cells", "triangles"), "what") == "cells":
        vertices, faces, owner = _fans(mesh, step)
        paint = _pale(len(mesh.points)) if colors is None else _as_colors(colors, len(mesh.points))
        result = trimesh.Trimesh(_space(vertices), faces, process=False, vertex_colors=paint[owner])
        result.vertex_attributes["point"] = owner.astype(np.float32)  # glTF has no larger integers here
        return result
    simplices, points = triangulation_of(mesh).simplices, _space(_nodes(mesh))
    if colors is None:
        return trimesh.Trimesh(points, simplices, process=False)
    paint = np.repeat(_as_colors(colors, len(simplices)), 3, axis=0)
    apart = np.arange(simplices.size).reshape(-1, 3)
    return trimesh.Trimesh(points[simplices.ravel()], apart, process=False, vertex_colors=paint)


def to_polydata(mesh: Mesh, *, what: str | None = None, columns: Mapping[str, npt.ArrayLike] | None = None) -> Any:
    """Triangles or cells as a pyvista.PolyData (the extra ``vtk``).

    Parameters
    ----------
    mesh : SphericalDelaunay, SphericalVoronoi, PlanarDelaunay or PlanarVoronoi
    what : {"triangles", "cells"}, optional
        By default triangles of a triangulation and cells of a diagram.
    columns : mapping of str to (n,) array_like, optional
        Values of the points, for cells as ``cell_data``, for triangles as ``point_data``; dates are text here.

    Returns
    -------
    pyvista.PolyData
        Flat polygons between unit vectors, or in the plane z = 0, with their ``point`` or ``triangle``, the index of
        it, and for cells their ``area``, as ``cell_data``. Points of a triangulation are in input order. What
        `to_ugrid` leaves out is left out.

    Examples
    --------
    >>> from stereodel import SphericalVoronoi
    >>> cells = to_polydata(SphericalVoronoi([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]))
    >>> cells.n_cells, cells.n_points, round(float(cells["area"].sum() / 3.141592653589793), 6)
    (6, 8, 4.0)
    """
    faces = Faces.of(mesh, what)
    table = np.insert(faces.polygons.values, faces.polygons.offsets[:-1], faces.polygons.sizes)
    result = optional("pyvista", "vtk").PolyData(_space(faces.nodes), faces=table)
    result.cell_data[faces.what] = faces.number
    if faces.what == "point":
        result.cell_data["area"] = faces.areas(mesh)
    into = result.cell_data if faces.what == "point" else result.point_data
    for name, values in faces.valued(mesh, columns, list(into)).items():
        cells = values.astype(str) if values.dtype.kind == "M" else values
        if cells.dtype.kind != "U" or "".join(cells.tolist()).isascii():
            into[name] = cells
        else:
            note(f"column {name!r} is left out, as it has text beyond ASCII, which PyVista does not hold")
    return result


def to_ugrid(
    mesh: Mesh,
    *,
    what: str | None = None,
    columns: Mapping[str, npt.ArrayLike] | None = None,
    latitude: Latitude | None = None,
) -> Any:
    """Triangles or cells as an xarray Dataset with a UGRID mesh topology (the extra ``grid``).

    Parameters
    ----------
    mesh : SphericalDelaunay, SphericalVoronoi, PlanarDelaunay or PlanarVoronoi
    what : {"triangles", "cells"}, optional
        By default the triangles of a triangulation and the cells of a diagram.
    columns : mapping of str to (n,) array_like, optional
        Values of the points, which become data on the faces of cells, and on the nodes of triangles. What is neither
        number, truth, date nor text becomes text, and missing text is empty.
    latitude : {"spherical", "geodetic", "authalic"}, optional
        Kind of latitude of the nodes, as in `xyz_to_lonlat`; by default that of the input points.

    Returns
    -------
    xarray.Dataset
        ``mesh`` holds the topology; ``node_lon`` and ``node_lat`` are in degrees, ``node_x``, ``node_y``, ``node_z``
        unit vectors (in the plane, ``node_x`` and ``node_y`` alone); ``face_node_connectivity`` is counterclockwise,
        counts from 0 and pads short rows with -1; then ``edge_node_connectivity``. ``face_point`` or ``face_triangle``
        is the index of the point or triangle, on the sphere ``face_area`` in steradians. ``face_lon``, ``face_lat`` (in
        the plane ``face_x``, ``face_y``) are sites or means of corners, ``edge_lon``, ``edge_lat`` midpoints of edges.

    Notes
    -----
    `closing` triangles, unbounded cells, the cells of duplicates and, where all points lie on one great circle, cells
    between two antipodal vertices are left out. ``uxarray.open_grid`` accepts the dataset. Source: UGRID
    Conventions 1.0, https://ugrid-conventions.github.io/ugrid-conventions.

    Examples
    --------
    >>> from stereodel import SphericalDelaunay
    >>> dataset = to_ugrid(SphericalDelaunay([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]))
    >>> dict(dataset.sizes)
    {'node': 6, 'face': 8, 'edge': 12, 'three': 3, 'two': 2}
    """
    faces = Faces.of(mesh, what)
    table, edges = faces.table, faces.edges
    width = "three" if table.shape[1] == 3 else "max_corners"
    middles = {"node": faces.nodes, "face": faces.centers(mesh), "edge": faces.nodes[edges].sum(axis=1) / 2}
    axes = LONLAT if mesh.surface is SPHERE else {axis: CARTESIAN[axis] for axis in "xy"}
    variables: dict[str, Any] = {}
    for at, points in middles.items():  # on the sphere directions of any length
        places = places_of(mesh, points, latitude or mesh.latitude or "spherical")
        variables |= {f"{at}_{axis}": (at, places[:, k], axes[axis]) for k, axis in enumerate(axes)}
        if at == "node":
            cartesian = zip(CARTESIAN.items(), points.T, strict=False)
            variables |= {f"node_{axis}": (at, column, known) for (axis, known), column in cartesian}
    for at, dimension, links in (("face", width, table), ("edge", "two", edges)):
        known = {"cf_role": f"{at}_node_connectivity", "start_index": np.int32(0), "_FillValue": np.int32(FILL)}
        variables[f"{at}_node_connectivity"] = ((at, dimension), links, known)
    of_face = {"mesh": "mesh", "location": "face"}
    variables[f"face_{faces.what}"] = ("face", faces.number, {**of_face, "long_name": f"number of the {faces.what}"})
    if axes is LONLAT:
        variables["face_area"] = ("face", faces.areas(mesh), {**of_face, "units": "sr"})
    topology = {
        "cf_role": "mesh_topology",
        "topology_dimension": np.int32(2),
        **{f"{at}_coordinates": " ".join(f"{at}_{axis}" for axis in axes) for at in middles},
        **{f"{at}_node_connectivity": f"{at}_node_connectivity" for at in ("face", "edge")},
        **{f"{at}_dimension": at for at in ("face", "edge")},
    }
    variables["mesh"] = ((), np.int32(0), topology)
    at = "face" if faces.what == "point" else "node"
    named = point_columns(columns, len(mesh.points))
    check_held(named, "nc")
    given = faces.valued(mesh, named, [*variables, "node", "face", "edge", "two", width])
    for (name, values), own in zip(given.items(), named, strict=True):
        variables[name] = (at, values, {"mesh": "mesh", "location": at, "long_name": own})
    return optional("xarray", "grid").Dataset(variables, attrs={"Conventions": "CF-1.11 UGRID-1.0"})


def from_ugrid(dataset: Any) -> tuple[FloatArray, IntArray]:
    """Nodes and faces of a UGRID mesh.

    Parameters
    ----------
    dataset : xarray.Dataset
        Dataset with a mesh topology of dimension 2, from this library or another.

    Returns
    -------
    nodes : (n, 3) or (n, 2) ndarray
        Directions, from ``node_x``, ``node_y``, ``node_z`` if present, else from longitude and latitude; plane
        coordinates for a mesh of the plane.
    faces : (f, k) ndarray of int32
        Nodes of each face, counted from 0; short rows are padded with -1.

    Raises
    ------
    ValueError
        If there is no such mesh, its variables are missing, or a face has too few nodes or one that is not there.

    Examples
    --------
    >>> from stereodel import SphericalDelaunay, check_delaunay
    >>> points, faces = from_ugrid(to_ugrid(SphericalDelaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])))
    >>> check_delaunay(points, faces).ties
    0
    """
    meshes = [name for name in dataset.variables if dataset[name].attrs.get("cf_role") == "mesh_topology"]
    if len(meshes) != 1:
        found = ", ".join(meshes) or "none"
        raise ValueError(f"the dataset must have one mesh topology, it has {len(meshes)}: {found}")
    topology = dataset[meshes[0]].attrs
    links = _variable(dataset, topology.get("face_node_connectivity", ""))
    nodes = _coordinates(dataset, str(topology.get("node_coordinates", "")).split())
    rows, start, count = np.asarray(links), int(links.attrs.get("start_index", 0)), len(nodes)
    fill = {links.attrs.get("_FillValue"), links.encoding.get("_FillValue")} - {None}
    missing = np.isnan(rows) | np.isin(rows, list(fill))
    wrong = np.argwhere(~missing & ((rows < start) | (rows >= start + count) | (rows != np.floor(rows))))
    if len(wrong):
        face, corner = wrong[0].tolist()
        said = f"face {face} names node {rows[face, corner]:.15g}, but the nodes are {start} to {start + count - 1}"
        advice = "its attributes start_index and _FillValue say where counting starts and which number stands for none"
        raise ValueError(f"{said}; {advice}")
    few = np.flatnonzero((~missing).sum(axis=1) < 3)
    if len(few):
        raise ValueError(f"face {few[0]} has {(~missing[few[0]]).sum()} nodes, but a face has at least three")
    return nodes, np.where(missing, FILL, np.where(missing, 0, rows).astype(np.int64) - start).astype(np.int32)


def _coordinates(dataset: Any, names: list[str]) -> FloatArray:
    cartesian = [f"node_{axis}" for axis in "xyz"]
    if all(name in dataset for name in cartesian):
        return np.column_stack([_variable(dataset, name) for name in cartesian]).astype(np.float64)
    columns = [_variable(dataset, name) for name in names]
    kinds = [column.attrs.get("standard_name") for column in columns]
    if set(kinds) == {"longitude", "latitude"}:
        return lonlat_to_xyz(np.column_stack([columns[kinds.index(kind)] for kind in ("longitude", "latitude")]))
    if len(columns) != 2:
        raise ValueError(f"node_coordinates must name two variables, it names {names}")
    return np.column_stack(columns).astype(np.float64)


def _variable(dataset: Any, name: str) -> Any:
    if name not in dataset:
        raise ValueError(f"the mesh topology names {name!r}, which is not in the dataset")
    return dataset[name]


def _space(points: FloatArray) -> FloatArray:
    """Points of the plane as points in space, with z = 0."""
    return np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))])


def _nodes(mesh: Mesh) -> FloatArray:
    """The points of a mesh, on the sphere as unit vectors."""
    return units(mesh.points) if mesh.surface is SPHERE else mesh.points


def _fans(mesh: Mesh, max_segment: float) -> tuple[FloatArray, Indices, Indices]:
    """Triangles around each site, on the sphere in rings at most `max_segment` apart; and the point of each vertex."""
    center, levels = _nodes(mesh), np.ones(len(mesh.points), dtype=np.intp)
    if mesh.surface is not SPHERE:
        faces = Faces.of(mesh, "cells")
        return _rings(faces.nodes[faces.polygons.values], faces.number[faces.polygons.row], center, levels)
    diagram = diagram_of(mesh)
    arcs = ridge_net(diagram).arcs()
    pieces = np.maximum(np.ceil(np.degrees(arcs.stop) / max_segment), 1).astype(np.intp)
    # Around each cell; its first point is repeated at the end and left out.
    around = points_along(voronoi_sides(diagram), arcs.spread(pieces))
    inner, _ = sides_of(around)
    border, owner = around.values[inner], around.row[inner]
    reach = np.zeros(len(center))
    np.maximum.at(reach, owner, np.degrees(np.arccos(np.clip(np.sum(border * center[owner], axis=1), -1, 1))))
    levels = np.maximum(np.ceil(reach / max_segment), levels).astype(np.intp)
    vertices, triangles, owner = _rings(border, owner, center, levels)
    return units(vertices), triangles, owner


def _rings(
    border: FloatArray, owner: Indices, center: FloatArray, levels: Indices
) -> tuple[FloatArray, Indices, Indices]:
    """Vertices level by level from the centre outwards, and the triangles between neighbouring levels.

    Border point b of a cell with k levels has the vertices first[b] … first[b] + k; at level 0 it is the centre.
    """
    count = levels[owner] + 1
    first = np.cumsum(count) - count
    source, level = np.repeat(np.arange(len(owner)), count), spans(np.zeros_like(count), count)
    share = (level / levels[owner[source]])[:, None]
    vertices = center[owner[source]] * (1 - share) + border[source] * share
    after = Ragged.grouped(owner, owner, len(center)).following
    here, there = first[source] + level, first[after[source]] + level
    outer, inner = level > 0, level > 1
    out = np.column_stack([here[outer] - 1, here[outer], there[outer]])
    back = np.column_stack([here[inner] - 1, there[inner], there[inner] - 1])
    return vertices, np.concatenate([out, back]), owner[source]


def _as_colors(colors: npt.ArrayLike, count: int) -> Bytes:
    """Red, green, blue and opacity from 0 to 255, (count, 4)."""
    given = np.asarray(colors)
    values = as_floats(colors, "colors") * (1 if given.dtype.kind in "iu" else 255)
    if values.shape not in ((count, 3), (count, 4)):
        raise ValueError(f"colors must have shape ({count}, 3) or ({count}, 4), got {values.shape}")
    if values.size and (values.min() < 0 or values.max() > 255):
        raise ValueError("colors must be integers from 0 to 255 or floats from 0 to 1")
    opaque = np.full((count, 4), 255, dtype=np.uint8)
    opaque[:, : values.shape[1]] = np.round(values)
    return opaque


def _pale(count: int) -> Bytes:
    """Hues spaced by the golden ratio, so that successive ones differ strongly, in three saturations."""
    wheel = np.array([[colorsys.hsv_to_rgb(k / 360, *look) for k in range(360)] for look in LOOKS])
    number = np.arange(count)
    return _as_colors(wheel[number % 3, (360 * (GOLDEN * number % 1.0)).astype(np.intp)], count)


def _held(values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """A column of a type that NetCDF and VTK know."""
    array = of_objects(values)
    if array.ndim == 1 and array.dtype.kind in "biufUM":
        return array.astype({"e": np.float32, "g": np.float64}.get(array.dtype.char, array.dtype), copy=False)
    return np.array(["" if cell is None else as_text(cell) for cell in plain_cells(array)], dtype=np.str_)


@dataclass(frozen=True, eq=False)
class Faces:
    """Polygons of nodes, counterclockwise, without unbounded cells, those of two nodes, and closing triangles."""

    nodes: FloatArray  # (n, 2) of the plane, or (n, 3), unit vectors
    polygons: Ragged  # the nodes of each
    number: Indices  # (f,): index of each cell's point, or of each triangle
    what: str  # "point" or "triangle"

    @classmethod
    def of(cls, mesh: Mesh, what: str | None) -> Faces:
        """Cells or triangles."""
        if as_choice(what or usual_kind(mesh), ("cells", "triangles"), "what") == "triangles":
            triangulation, number = triangles_of(mesh)
            corners = triangulation.simplices[number].astype(np.intp).ravel()
            return cls(_nodes(mesh), Ragged(corners, 3 * np.arange(len(number) + 1)), number, "triangle")
        diagram = diagram_of(mesh)
        regions = Ragged(diagram.region_indices.astype(np.intp), diagram.region_offsets)
        unbounded = np.bincount(regions.row, regions.values < 0, minlength=len(regions)) > 0
        number = np.flatnonzero((regions.sizes > 2) & ~unbounded)
        return cls(diagram.vertices, regions.take(number), number, "point")

    @property
    def table(self) -> IntArray:
        """The polygons as rows, (f, largest number of corners), padded."""
        sizes = self.polygons.sizes
        rows = np.full((len(sizes), int(sizes.max(initial=3))), FILL, dtype=np.int32)
        rows[self.polygons.row, spans(np.zeros_like(sizes), sizes)] = self.polygons.values
        return rows

    @property
    def edges(self) -> IntArray:
        """Edges as pairs of nodes, (e, 2), each once."""
        here = self.polygons.values
        return as_edges(here, here[self.polygons.following])

    def centers(self, mesh: Mesh) -> FloatArray:
        """The sites of cells, or the means of triangles' corners."""
        return mesh.points[self.number] if self.what == "point" else self.nodes[self.table].mean(axis=1)

    def valued(self, mesh: Mesh, columns: Mapping[str, Any] | None, taken: list[str]) -> Columns:
        """Columns of the points as the data of cells or of the nodes of triangles, under names that are not taken."""
        given, count = point_columns(columns, len(mesh.points)), len(mesh.points)
        some = self.number if self.what == "point" else np.arange(count)
        if given and len(some) < count:
            said = f"{count - len(some)} of {count} points have no bounded cell of their own: their values are left out"
            warnings.warn(said, DataWarning, stacklevel=4)
        held = {re.sub(r"^(?=\W)|(?<=\s)$|/", "_", name): _held(values[some]) for name, values in given.items()}
        return beside(taken, held)

    def areas(self, mesh: Mesh) -> FloatArray:
        """The areas of cells or triangles, on the sphere in steradians."""
        if self.what == "triangle":
            return mesh.surface.areas(*self.nodes[self.table].transpose(1, 0, 2))
        return np.asarray(diagram_of(mesh).areas()[self.number])
