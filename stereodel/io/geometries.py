"""Cells, triangles, edges, ridges and sites as Shapely geometries, each with its columns.

Imported where something needs Shapely, and not before.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Geometries
from stereodel.curves.borders import Box
from stereodel.curves.trace import Arcs, great
from stereodel.io.diagrams import Columns, Mesh, diagram_of, ridge_arcs, triangulation_of
from stereodel.io.faces import triangle_sides, voronoi_sides
from stereodel.io.on_map import shapely
from stereodel.io.plane import plane_cells
from stereodel.io.tiles import sphere_lines, sphere_polygons
from stereodel.sphere import angular_distance, solid_angle, xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import units


def on_sphere(
    mesh: Mesh, what: str, max_segment: float, latitude: Latitude, radius: float
) -> tuple[Columns, Geometries]:
    """Columns and geometries of a mesh on the sphere, in degrees; empty geometries where there is none."""
    if what == "cells":
        return _sphere_cells(diagram_of(mesh), max_segment, latitude, radius)
    if what == "triangles":
        return _sphere_triangles(triangulation_of(mesh), max_segment, latitude, radius)
    if what == "sites":
        return _sites(xyz_to_lonlat(mesh.points, latitude=latitude))
    if what == "edges":
        triangulation = triangulation_of(mesh)
        _, pairs = triangle_sides(triangulation.simplices[~triangulation.closing])
        arcs = _edge_arcs(mesh.points, pairs)
    else:
        pairs, arcs = diagram_of(mesh).ridge_points, ridge_arcs(diagram_of(mesh))
    length = np.radians(angular_distance(arcs.start, arcs.end)) * radius
    return _pair_columns(pairs) | {"length": length}, sphere_lines(arcs, max_segment, latitude)


def in_plane(mesh: Mesh, what: str, box: Box, radius: float) -> tuple[Columns, Geometries]:
    """The same for a mesh of the plane; cells and ridges as far as they lie in a rectangle."""
    if what == "cells":
        diagram = diagram_of(mesh)
        columns = {"point": np.arange(len(diagram.points)), "area": diagram.areas(radius=radius)}
        return columns, plane_cells(diagram, box)
    if what == "triangles":
        simplices = triangulation_of(mesh).simplices
        corners = mesh.points[simplices]
        (ux, uy), (vx, vy) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
        columns = _triangle_columns(np.arange(len(simplices)), simplices)
        return columns | {"area": (ux * vy - uy * vx) / 2 * radius**2}, np.asarray(shapely.polygons(corners))
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
    return _pair_columns(pairs) | {"length": length}, np.asarray(shapely.linestrings(ends))


def _sphere_cells(diagram: Any, max_segment: float, latitude: Latitude, radius: float) -> tuple[Columns, Geometries]:
    sites = units(diagram.points)[diagram.ridge_points[:, 0]]
    cells = sphere_polygons(ridge_arcs(diagram), voronoi_sides(diagram), max_segment, latitude, sites)
    kept = np.flatnonzero(diagram.is_kept)
    if len(kept) == 1:
        cells[kept] = shapely.box(-180.0, -90.0, 180.0, 90.0)
    return {"point": np.arange(len(cells)), "area": diagram.areas(radius=radius)}, cells


def _sphere_triangles(
    triangulation: Any, max_segment: float, latitude: Latitude, radius: float
) -> tuple[Columns, Geometries]:
    chosen = np.flatnonzero(~triangulation.closing)
    simplices = triangulation.simplices[chosen]
    faces, pairs = triangle_sides(simplices)
    geometry = sphere_polygons(_edge_arcs(triangulation.points, pairs), faces, max_segment, latitude)
    corners = triangulation.points[simplices]
    area = solid_angle(corners[:, 0], corners[:, 1], corners[:, 2]) * radius**2
    return _triangle_columns(chosen, simplices) | {"area": area}, geometry


def _edge_arcs(points: FloatArray, pairs: npt.NDArray[Any]) -> Arcs:
    """The shorter arcs between pairs of points, given as directions."""
    unit = units(points)
    return great(unit[pairs[:, 0]], unit[pairs[:, 1]])


def _sites(points: FloatArray) -> tuple[Columns, Geometries]:
    return {"point": np.arange(len(points))}, np.asarray(shapely.points(points))


def _triangle_columns(numbers: npt.NDArray[Any], simplices: npt.NDArray[Any]) -> Columns:
    return {"triangle": numbers} | {name: simplices[:, k] for k, name in enumerate("abc")}


def _pair_columns(pairs: npt.NDArray[Any]) -> Columns:
    return {"a": pairs[:, 0], "b": pairs[:, 1]}
