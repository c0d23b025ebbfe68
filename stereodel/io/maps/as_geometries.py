"""Cells, triangles, edges, ridges, sites and contours as geometries, each with its columns.

Imported only where Shapely is needed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Geometries, Indices, Packed
from stereodel._tasks.progress import Progress
from stereodel.constants import UNIT_ROUNDOFF
from stereodel.curves import clip
from stereodel.curves.borders import Box, Pieces
from stereodel.curves.ragged import Ragged
from stereodel.curves.trace import Arcs, great
from stereodel.interpolation import Contour
from stereodel.io.formats import wkb
from stereodel.io.formats.map_rows import packed
from stereodel.io.maps.meshes_as_rows import Columns, Mesh, diagram_of, triangle_sides, triangulation_of, voronoi_sides
from stereodel.io.maps.on_map import polygons_on_map, repaired, shapely
from stereodel.io.maps.tiles import Net, sphere_lines, sphere_polygons
from stereodel.sphere import angular_distance, solid_angle, xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.vectors import units
from stereodel.triangulation import PlanarVoronoi


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


def isolines(contours: Sequence[Contour], max_segment: float, latitude: Latitude | None) -> tuple[Columns, Geometries]:
    """A row for each contour: its level, whether it is closed, and its line, cut at ±180° on the sphere."""
    columns: Columns = {
        "level": np.array([contour.level for contour in contours], dtype=np.float64),
        "closed": np.array([contour.closed for contour in contours], dtype=np.bool_),
    }
    if not contours:
        return columns, np.zeros(0, dtype=object)
    points = Ragged.of([contour.points for contour in contours])
    if points.values.shape[1] == 2:
        return columns, np.asarray(shapely.linestrings(points.values, indices=points.row))
    ends = np.ones(len(points.values), dtype=np.bool_)
    ends[points.offsets[1:] - 1] = False
    first = np.flatnonzero(ends)
    arcs = great(points.values[first], points.values[first + 1])
    lines = Ragged(np.arange(len(first)), points.offsets - np.arange(len(points) + 1))
    kind = latitude or next((contour.latitude for contour in contours if contour.latitude), None) or "spherical"
    return columns, sphere_lines(arcs, max_segment, kind, lines)


def plane_cells(diagram: PlanarVoronoi, box: Box) -> Geometries:
    """A Polygon for each point, empty where its cell is outside; neighbours share points, as ridges are cut once."""
    count = len(diagram.points)
    segments, ridge = _segments(diagram, box)
    # The ridges are already cut: only the endpoints of these arcs are used.
    none = np.zeros((len(ridge), 0))
    arcs = Arcs(segments[:, 0], segments[:, 1], none, none, none, none, none, ridge)
    low, high = [box.left, box.bottom], [box.right, box.top]
    opens, shuts = ((segments == low) | (segments == high)).any(axis=2).T
    pieces = Pieces(arcs, opens, shuts, np.ones(len(ridge), dtype=bool), np.zeros(len(ridge), dtype=bool))
    samples = Ragged(segments.reshape(-1, 2), 2 * np.arange(len(ridge) + 1))
    chains = clip.chains_of(voronoi_sides(diagram), pieces)
    points = clip.points_along(chains.pieces, samples)
    joined, owner = clip.closed_along(box, points.take(~chains.whole), chains.row[~chains.whole])
    loops, owner = clip.together(points.take(chains.whole), joined), np.append(chains.row[chains.whole], owner)
    if not len(ridge) and count:
        # One cell fills the rectangle: that of the site nearest to any place in it.
        middle = (box.corners[0] + box.corners[2]) / 2
        loops = Ragged.of([box.once()])
        owner = np.argmin(np.sum((diagram.points - middle) ** 2, axis=1), keepdims=True)
    there = loops.sizes > 3
    cells, _ = polygons_on_map(loops.take(there), owner[there], count)
    return repaired(cells, ~shapely.is_valid(cells))


def _segments(diagram: PlanarVoronoi, box: Box) -> tuple[FloatArray, Indices]:
    """The parts of ridges in the rectangle, in order, whose endpoints are vertices or lie exactly on its border.

    A vertex within rounding error of the border is placed on it for all its ridges; parts along the border are left
    out.
    """
    low, high = np.array([box.left, box.bottom]), np.array([box.right, box.top])
    pieces, ridge = diagram.segments((box.left, box.bottom, box.right, box.top))
    ends = diagram.ridge_vertices[ridge]
    vertices = diagram.vertices[ends] if len(diagram.vertices) else np.full_like(pieces, np.nan)
    size = max(map(abs, (box.left, box.right, box.bottom, box.top)))
    at_vertex = (ends >= 0) & (np.abs(pieces - vertices).max(axis=-1) <= 8 * UNIT_ROUNDOFF * size)
    pieces = np.clip(np.where(at_vertex[..., None], vertices, pieces), low, high)
    # Other endpoints move to the nearest side.
    gaps = np.concatenate([pieces - low, high - pieces], axis=-1)
    row, end = np.nonzero(~at_vertex)
    side = np.argmin(gaps[row, end], axis=-1)
    pieces[row, end, side % 2] = np.concatenate([low, high])[side]
    on_side = ((pieces[:, 0] == low) & (pieces[:, 1] == low)) | ((pieces[:, 0] == high) & (pieces[:, 1] == high))
    inward = ~on_side.any(axis=1) & (pieces[:, 0] != pieces[:, 1]).any(axis=1)
    return pieces[inward], ridge[inward]
