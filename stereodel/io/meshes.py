"""Meshes in space, for PyVista and for trimesh, which writes GLB and PLY."""

from __future__ import annotations

import colorsys
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import Bytes, FloatArray, Indices, IntArray, as_choice, as_floats, as_scalar
from stereodel._extras import optional
from stereodel.curves.clip import points_along
from stereodel.curves.ragged import Ragged, spans
from stereodel.io.maps.meshes_as_rows import (
    Mesh,
    diagram_of,
    is_spherical,
    ridge_arcs,
    triangulation_of,
    usual_kind,
    voronoi_sides,
)
from stereodel.io.maps.rows_of import LARGEST_SEGMENT
from stereodel.sphere.vectors import units
from stereodel.triangulation import SphericalVoronoi

GOLDEN = (np.sqrt(5.0) - 1) / 2


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
        Colour of each triangle, or of each point's cell: integers from 0 to 255, or floats from 0 to 1. By default
        cells have pale colours that vary with their index, and triangles have none.
    max_segment : float, optional
        Longest side, in degrees, of the triangles that make up a cell, in (0, 90]. Sphere only.

    Returns
    -------
    trimesh.Trimesh
        Made with ``process=False``: vertices are unchanged. Triangles are flat; on the sphere they are the facets of
        the convex hull. They share the points as vertices unless they have colours. Cells do not share vertices, so
        that colours end at their boundaries; ``vertex_attributes["point"]`` is the index of each vertex's point.
        Unbounded cells are left out. The plane is z = 0.

    Raises
    ------
    ValueError, TypeError
        If `colors` has the wrong shape, an option is out of range, or `mesh` is of another type.

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
        vertices, faces, owner = _sphere_fans(diagram_of(mesh), step) if is_spherical(mesh) else _plane_fans(mesh)
        paint = _pale(len(mesh.points)) if colors is None else _as_colors(colors, len(mesh.points))
        result = trimesh.Trimesh(_space(vertices), faces, process=False, vertex_colors=paint[owner])
        result.vertex_attributes["point"] = owner.astype(np.float32)  # glTF has no larger integers here
        return result
    simplices = triangulation_of(mesh).simplices
    points = _space(units(mesh.points) if is_spherical(mesh) else mesh.points)
    if colors is None:
        return trimesh.Trimesh(points, simplices, process=False)
    paint = np.repeat(_as_colors(colors, len(simplices)), 3, axis=0)
    apart = np.arange(simplices.size).reshape(-1, 3)
    return trimesh.Trimesh(points[simplices.ravel()], apart, process=False, vertex_colors=paint)


def to_polydata(mesh: Mesh, *, what: str | None = None) -> Any:
    """Triangles or cells as a pyvista.PolyData.

    Parameters
    ----------
    mesh : SphericalDelaunay, SphericalVoronoi, PlanarDelaunay or PlanarVoronoi
    what : {"triangles", "cells"}, optional
        By default triangles of a triangulation and cells of a diagram.

    Returns
    -------
    pyvista.PolyData
        Flat polygons between unit vectors, or in the plane z = 0, with ``cell_data["point"]`` or
        ``cell_data["triangle"]``, the index of each polygon's point or triangle, and for cells ``cell_data["area"]``,
        in steradians on the sphere. Points of a triangulation are in input order, so values can be assigned to
        ``point_data`` directly. Closing triangles, unbounded cells and the cells of duplicates are left out.

    Raises
    ------
    ImportError
        Without PyVista (the extra ``mesh``).

    Examples
    --------
    >>> from stereodel import SphericalVoronoi
    >>> cells = to_polydata(SphericalVoronoi([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]))
    >>> cells.n_cells, cells.n_points, round(float(cells["area"].sum() / 3.141592653589793), 6)
    (6, 8, 4.0)
    """
    surface = surface_of(mesh, what)
    polygons = surface.polygons
    faces = np.insert(polygons.values, polygons.offsets[:-1], polygons.sizes)
    result = optional("pyvista", "mesh").PolyData(_space(surface.nodes), faces=faces)
    result.cell_data["point" if surface.cells else "triangle"] = surface.number
    if surface.cells:
        result.cell_data["area"] = diagram_of(mesh).areas()[surface.number]
    return result


def _space(points: FloatArray) -> FloatArray:
    """Points of the plane as points in space, with z = 0."""
    return points if points.shape[1] == 3 else np.column_stack([points, np.zeros(len(points))])


def _sphere_fans(diagram: SphericalVoronoi, max_segment: float) -> tuple[FloatArray, Indices, Indices]:
    """Triangles around each site in rings at most `max_segment` apart; and the point of each vertex."""
    arcs = ridge_arcs(diagram)
    pieces = np.maximum(np.ceil(np.degrees(arcs.stop) / max_segment), 1).astype(np.intp)
    # Around each cell; its first point is repeated at the end and left out.
    around = points_along(voronoi_sides(diagram), arcs.spread(pieces))
    inner = np.ones(len(around.values), dtype=bool)
    inner[around.offsets[1:] - 1] = False
    border, owner, center = around.values[inner], around.row[inner], units(diagram.points)
    reach = np.zeros(len(center))
    np.maximum.at(reach, owner, np.degrees(np.arccos(np.clip(np.sum(border * center[owner], axis=1), -1, 1))))
    levels = np.maximum(np.ceil(reach / max_segment), 1).astype(np.intp)
    return _rings(border, owner, center, levels)


def _plane_fans(mesh: Mesh) -> tuple[FloatArray, Indices, Indices]:
    surface = surface_of(mesh, "cells")
    owner = surface.number[surface.polygons.row]
    return _rings(surface.nodes[surface.polygons.values], owner, mesh.points, np.ones(len(mesh.points), dtype=np.intp))


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
    if border.shape[1] == 3:
        vertices = units(vertices)
    after = Ragged.grouped(owner, owner, len(center)).following
    here, there = first[source] + level, first[after[source]] + level
    outer, inner = level > 0, level > 1
    return (
        vertices,
        np.concatenate(
            [
                np.column_stack([here[outer] - 1, here[outer], there[outer]]),
                np.column_stack([here[inner] - 1, there[inner], there[inner] - 1]),
            ]
        ),
        owner[source],
    )


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
    looks = ((0.20, 0.97), (0.38, 0.93), (0.52, 0.84))
    wheel = np.array([[colorsys.hsv_to_rgb(k / 360, *look) for k in range(360)] for look in looks])
    number = np.arange(count)
    return _as_colors(wheel[number % 3, (360 * (GOLDEN * number % 1.0)).astype(np.intp)], count)


@dataclass(frozen=True, eq=False)
class Surface:
    """Polygons of nodes, counterclockwise: triangles, or `cells`."""

    nodes: FloatArray  # (n, 2) of the plane, or (n, 3), unit vectors
    polygons: Ragged  # the nodes of each
    number: Indices  # (f,): index of each cell's point, or of each triangle
    cells: bool

    @property
    def table(self) -> IntArray:
        """The polygons as rows, (f, largest number of corners), padded with -1."""
        sizes = self.polygons.sizes
        rows = np.full((len(sizes), int(sizes.max(initial=3))), -1, dtype=np.int32)
        rows[self.polygons.row, spans(np.zeros_like(sizes), sizes)] = self.polygons.values
        return rows

    @property
    def edges(self) -> IntArray:
        """Edges as pairs of nodes, (e, 2), each once."""
        here = self.polygons.values
        sides = np.column_stack([here, here[self.polygons.following]])
        return np.unique(np.sort(sides, axis=1), axis=0).astype(np.int32)


def surface_of(mesh: Mesh, what: str | None) -> Surface:
    """Cells or triangles; unbounded cells of the plane and closing triangles of the sphere are left out."""
    kind = as_choice(what or usual_kind(mesh), ("cells", "triangles"), "what")
    return _cells(diagram_of(mesh)) if kind == "cells" else _triangles(mesh)


def _triangles(mesh: Mesh) -> Surface:
    triangulation, spherical = triangulation_of(mesh), is_spherical(mesh)
    number = np.flatnonzero(~triangulation.closing) if spherical else np.arange(len(triangulation.simplices))
    corners = triangulation.simplices[number].astype(np.intp).ravel()
    nodes = units(mesh.points) if spherical else mesh.points
    return Surface(nodes, Ragged(corners, 3 * np.arange(len(number) + 1)), number, cells=False)


def _cells(diagram: Any) -> Surface:
    if isinstance(diagram, SphericalVoronoi) and len(diagram.vertices) == 2:
        return _lunes(diagram)
    regions = Ragged(diagram.region_indices.astype(np.intp), diagram.region_offsets)
    unbounded = np.bincount(regions.row, regions.values < 0, minlength=len(regions)) > 0
    number = np.flatnonzero((regions.sizes > 0) & ~unbounded)
    return Surface(diagram.vertices, regions.take(number), number, cells=True)


def _lunes(diagram: SphericalVoronoi) -> Surface:
    """Cells between two antipodal vertices, with the midpoint of each ridge as an additional node."""
    sides, arcs = voronoi_sides(diagram), ridge_arcs(diagram)
    ridge = np.maximum(sides.values, ~sides.values)
    start = diagram.ridge_vertices[ridge, (sides.values < 0).astype(np.intp)].astype(np.intp)
    corners = Ragged(np.column_stack([start, 2 + ridge]).ravel(), 2 * sides.offsets)
    number = np.flatnonzero(sides.sizes)
    middles = arcs.points(np.arange(len(arcs)), arcs.stop / 2)
    return Surface(np.concatenate([diagram.vertices, middles]), corners.take(number), number, cells=True)
