"""Cells, triangles, edges, ridges and sites as geometries, each with its columns.

Imported only where Shapely is needed.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Packed
from stereodel.curves.borders import Box
from stereodel.io.diagrams import Columns, Mesh, diagram_of, triangulation_of
from stereodel.io.faces import triangle_sides, voronoi_sides
from stereodel.io.formats import wkb
from stereodel.io.layers import Progress, packed
from stereodel.io.on_map import shapely
from stereodel.io.plane import plane_cells
from stereodel.io.tiles import Net, sphere_lines, sphere_polygons
from stereodel.sphere import angular_distance, solid_angle, xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import units


def on_sphere(
    mesh: Mesh, what: str, max_segment: float, latitude: Latitude, radius: float, progress: Progress | None = None
) -> tuple[Columns, Packed]:
    """Columns and geometries, in degrees, of a mesh on the sphere; None where there is no geometry."""
    if what == "cells":
        return _sphere_cells(diagram_of(mesh), max_segment, latitude, radius, progress)
    if what == "triangles":
        return _sphere_triangles(triangulation_of(mesh), max_segment, latitude, radius, progress)
    if what == "sites":
        return _sites(xyz_to_lonlat(mesh.points, latitude=latitude))
    if what == "edges":
        triangulation = triangulation_of(mesh)
        _, pairs = triangle_sides(triangulation.simplices[~triangulation.closing])
        net = Net(units(mesh.points), pairs)
    else:
        pairs, net = diagram_of(mesh).ridge_points, ridge_net(diagram_of(mesh))
    arcs = net.arcs()
    length = np.radians(angular_distance(arcs.start, arcs.end)) * radius
    return _pair_columns(pairs) | {"length": length}, packed(sphere_lines(arcs, max_segment, latitude))


def in_plane(mesh: Mesh, what: str, box: Box, radius: float) -> tuple[Columns, Packed]:
    """The same for a mesh of the plane; cells and ridges are clipped to a rectangle."""
    if what == "cells":
        diagram = diagram_of(mesh)
        columns = {"point": np.arange(len(diagram.points)), "area": diagram.areas(radius=radius)}
        return columns, packed(plane_cells(diagram, box))
    if what == "triangles":
        simplices = triangulation_of(mesh).simplices
        corners = mesh.points[simplices]
        (ux, uy), (vx, vy) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
        columns = _triangle_columns(np.arange(len(simplices)), simplices)
        return columns | {"area": (ux * vy - uy * vx) / 2 * radius**2}, packed(shapely.polygons(corners))
    if what == "sites":
        return _sites(mesh.points)
    if what == "edges":
        pairs = triangulation_of(mesh).edges
        ends = mesh.points[pairs]
    else:
        diagram = diagram_of(mesh)
        ends, ridge = diagram.segments((box.left, box.bottom, box.right, box.top))
        pairs = diagram.ridge_points[ridge]
    length = np.hypot(*(ends[:, 1] - ends[:, 0]).T) * radius
    return _pair_columns(pairs) | {"length": length}, packed(shapely.linestrings(ends))


def ridge_net(diagram: Any) -> Net:
    """The ridges of a diagram on the sphere, each kept clear of the first of its two sites."""
    sites, site = units(diagram.points), diagram.ridge_points[:, 0]
    return Net(diagram.vertices, diagram.ridge_vertices, diagram.ridge_normals, sites, site)


def _sphere_cells(
    diagram: Any, max_segment: float, latitude: Latitude, radius: float, progress: Progress | None
) -> tuple[Columns, Packed]:
    cells = sphere_polygons(ridge_net(diagram), voronoi_sides(diagram), max_segment, latitude, progress)
    kept = np.flatnonzero(diagram.is_kept)
    if len(kept) == 1:
        cells[kept] = packed(np.array([shapely.box(-180.0, -90.0, 180.0, 90.0)]))
    return {"point": np.arange(len(cells)), "area": diagram.areas(radius=radius)}, cells


def _sphere_triangles(
    triangulation: Any, max_segment: float, latitude: Latitude, radius: float, progress: Progress | None
) -> tuple[Columns, Packed]:
    chosen = np.flatnonzero(~triangulation.closing)
    simplices = triangulation.simplices[chosen]
    faces, pairs = triangle_sides(simplices)
    geometry = sphere_polygons(Net(units(triangulation.points), pairs), faces, max_segment, latitude, progress)
    corners = triangulation.points[simplices]
    area = solid_angle(corners[:, 0], corners[:, 1], corners[:, 2]) * radius**2
    return _triangle_columns(chosen, simplices) | {"area": area}, geometry


def _sites(points: FloatArray) -> tuple[Columns, Packed]:
    return {"point": np.arange(len(points))}, wkb.points(points)


def _triangle_columns(numbers: npt.NDArray[Any], simplices: npt.NDArray[Any]) -> Columns:
    return {"triangle": numbers} | {name: simplices[:, k] for k, name in enumerate("abc")}


def _pair_columns(pairs: npt.NDArray[Any]) -> Columns:
    return {"a": pairs[:, 0], "b": pairs[:, 1]}
