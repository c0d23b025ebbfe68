"""UGRID: meshes as xarray datasets that follow the conventions for unstructured grids in NetCDF, version 1.0."""

from __future__ import annotations

from typing import Any

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, IntArray
from stereodel._extras import optional
from stereodel.io.maps.meshes_as_rows import Mesh, diagram_of, is_spherical
from stereodel.io.meshes import Surface, surface_of
from stereodel.sphere import lonlat_to_xyz, solid_angle, xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude

FILL = -1
_NAMES = {"lon": ("longitude", "degrees_east"), "lat": ("latitude", "degrees_north")}


def to_ugrid(mesh: Mesh, *, what: str | None = None, latitude: Latitude | None = None) -> Any:
    """Triangles or cells as an xarray Dataset with a UGRID mesh topology.

    Parameters
    ----------
    mesh : SphericalDelaunay, SphericalVoronoi, PlanarDelaunay or PlanarVoronoi
    what : {"triangles", "cells"}, optional
        By default the triangles of a triangulation and the cells of a diagram.
    latitude : {"spherical", "geodetic", "authalic"}, optional
        Kind of latitude of the nodes, as in `xyz_to_lonlat`; by default that of the input points.

    Returns
    -------
    xarray.Dataset
        ``mesh`` holds the topology; ``node_lon`` and ``node_lat`` are in degrees, ``node_x``, ``node_y``, ``node_z``
        unit vectors (in the plane, ``node_x`` and ``node_y`` alone); ``face_node_connectivity`` is counterclockwise,
        counts from 0 and pads short rows with -1; then ``edge_node_connectivity``. Faces have ``face_point`` or
        ``face_triangle``, the index of the point or triangle, and on the sphere ``face_area`` in steradians.
        ``face_lon`` and ``face_lat`` are the sites of cells or the directions of the mean of a triangle's corners,
        ``edge_lon`` and ``edge_lat`` the midpoints of edges (in the plane, ``face_x``, ``face_y``, ``edge_x``,
        ``edge_y``).

    Raises
    ------
    ImportError
        If xarray is missing (the extra ``grid``).

    Notes
    -----
    `closing` triangles, unbounded cells and the cells of duplicates are left out. Cells between two antipodal vertices
    have the midpoints of their ridges as additional nodes. ``uxarray.open_grid`` accepts the dataset. Source: UGRID
    Conventions 1.0, https://ugrid-conventions.github.io/ugrid-conventions.

    Examples
    --------
    >>> from stereodel import SphericalDelaunay
    >>> dataset = to_ugrid(SphericalDelaunay([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]))
    >>> dict(dataset.sizes)
    {'node': 6, 'face': 8, 'edge': 12, 'three': 3, 'two': 2}
    """
    surface, spherical = surface_of(mesh, what), is_spherical(mesh)
    table, edges = surface.table, surface.edges
    width = "three" if table.shape[1] == 3 else "max_corners"
    kind = latitude or mesh.latitude or "spherical"
    middles = {"node": surface.nodes, "face": _centers(mesh, surface), "edge": surface.nodes[edges].sum(axis=1) / 2}
    variables: dict[str, Any] = {}
    for location, points in middles.items():
        variables |= _places(location, points, spherical, kind)
    variables |= {
        "face_node_connectivity": (("face", width), table, _links("face")),
        "edge_node_connectivity": (("edge", "two"), edges, _links("edge")),
    }
    name = "face_point" if surface.cells else "face_triangle"
    variables[name] = (
        "face",
        surface.number,
        {"mesh": "mesh", "location": "face", "long_name": f"number of the {name[5:]}"},
    )
    if spherical:
        variables["face_area"] = ("face", _areas(mesh, surface), {"mesh": "mesh", "location": "face", "units": "sr"})
    variables["mesh"] = ((), np.int32(0), _topology(("lon", "lat") if spherical else ("x", "y")))
    return optional("xarray", "grid").Dataset(variables, attrs={"Conventions": "CF-1.11 UGRID-1.0"})


def _centers(mesh: Mesh, surface: Surface) -> FloatArray:
    """The sites of cells, or the means of triangles' corners."""
    if surface.cells:
        points: FloatArray = mesh.points[surface.number]
        return points
    return surface.nodes[surface.polygons.values.reshape(-1, 3)].mean(axis=1)


def _places(location: str, points: FloatArray, spherical: bool, latitude: Latitude) -> dict[str, Any]:
    """Coordinates of nodes, faces or edges; on the sphere, points are directions of any length."""
    variables: dict[str, Any] = {}
    if spherical:
        lonlat = xyz_to_lonlat(points, latitude=latitude).T
        for (name, (standard, units)), column in zip(_NAMES.items(), lonlat, strict=True):
            variables[f"{location}_{name}"] = (location, column, {"standard_name": standard, "units": units})
    if location == "node" or not spherical:
        for name, column in zip("xyz", points.T, strict=False):
            variables[f"{location}_{name}"] = (location, column, {"long_name": f"Cartesian {name}", "units": "1"})
    return variables


def _links(kind: str) -> dict[str, Any]:
    return {"cf_role": f"{kind}_node_connectivity", "start_index": np.int32(0), "_FillValue": np.int32(FILL)}


def _topology(axes: tuple[str, str]) -> dict[str, Any]:
    coordinates = {f"{at}_coordinates": " ".join(f"{at}_{axis}" for axis in axes) for at in ("node", "face", "edge")}
    return {
        "cf_role": "mesh_topology",
        "topology_dimension": np.int32(2),
        **coordinates,
        "face_node_connectivity": "face_node_connectivity",
        "edge_node_connectivity": "edge_node_connectivity",
        "face_dimension": "face",
        "edge_dimension": "edge",
    }


def _areas(mesh: Mesh, surface: Surface) -> FloatArray:
    if surface.cells:
        areas: FloatArray = diagram_of(mesh).areas()[surface.number]
        return areas
    corners = surface.nodes[surface.polygons.values.reshape(-1, 3)]
    return solid_angle(corners[:, 0], corners[:, 1], corners[:, 2])


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
        If there is no such mesh, its variables are missing, or a face has fewer than three nodes or one that is not
        there.

    Examples
    --------
    >>> from stereodel import SphericalDelaunay, check_delaunay
    >>> points, faces = from_ugrid(to_ugrid(SphericalDelaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])))
    >>> check_delaunay(points, faces).ties
    0
    """
    meshes = [name for name in dataset.variables if dataset[name].attrs.get("cf_role") == "mesh_topology"]
    if len(meshes) != 1:
        raise ValueError(
            f"the dataset must have one mesh topology, it has {len(meshes)}: {', '.join(meshes) or 'none'}"
        )
    topology = dataset[meshes[0]].attrs
    links = _variable(dataset, topology.get("face_node_connectivity", ""))
    rows = np.asarray(links)
    fill = {links.attrs.get("_FillValue"), links.encoding.get("_FillValue")} - {None}
    missing = np.isnan(rows) | np.isin(rows, list(fill))
    start = int(links.attrs.get("start_index", 0))
    nodes = _coordinates(dataset, str(topology.get("node_coordinates", "")).split())
    _check_faces(rows, missing, start, len(nodes))
    return nodes, np.where(missing, FILL, np.where(missing, 0, rows).astype(np.int64) - start).astype(np.int32)


def _check_faces(rows: FloatArray, missing: BoolArray, start: int, count: int) -> None:
    """Raise ValueError for a face with a node that is not there, or with fewer than three."""
    wrong = np.argwhere(~missing & ((rows < start) | (rows >= start + count) | (rows != np.floor(rows))))
    if len(wrong):
        face, corner = wrong[0].tolist()
        raise ValueError(
            f"face {face} names node {rows[face, corner]:.15g}, but the nodes are {start} to {start + count - 1}; its "
            "attributes start_index and _FillValue say where counting starts and which number stands for none"
        )
    few = np.flatnonzero((~missing).sum(axis=1) < 3)
    if len(few):
        raise ValueError(f"face {few[0]} has {(~missing[few[0]]).sum()} nodes, but a face has at least three")


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
