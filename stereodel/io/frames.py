"""Diagrams as tables of geometries: GeoDataFrames, from which GeoPandas writes nearly everything."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_choice, as_scalar
from stereodel._extras import optional
from stereodel.io.arcs import Arcs
from stereodel.io.faces import triangle_faces, voronoi_faces
from stereodel.io.lines import sphere_lines
from stereodel.io.plane import frame_of, plane_cells
from stereodel.io.polygons import Geometries, sphere_polygons
from stereodel.io.rings import WORLD
from stereodel.sphere import angular_distance, solid_angle, xyz_to_lonlat
from stereodel.sphere.latitudes import KINDS, Latitude
from stereodel.sphere.vectors import units
from stereodel.triangulation import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi

What = Literal["cells", "triangles", "edges", "ridges", "sites"]
Mesh = PlanarDelaunay | PlanarVoronoi | SphericalDelaunay | SphericalVoronoi
Columns = dict[str, npt.NDArray[Any]]
LARGEST_SEGMENT = 90.0


@dataclass(frozen=True)
class Drawing:
    """How geometries are made: the options of `to_geodataframe`."""

    max_segment: float
    latitude: Latitude
    radius: float
    extent: npt.ArrayLike | None


def to_geodataframe(
    mesh: Mesh,
    *,
    what: What | None = None,
    columns: Mapping[str, npt.ArrayLike] | None = None,
    latitude: Latitude = "spherical",
    radius: float = 1.0,
    max_segment: float = 1.0,
    extent: npt.ArrayLike | None = None,
    crs: Any = None,
) -> Any:
    """Cells, triangles, edges, ridges or sites as a GeoDataFrame.

    Parameters
    ----------
    mesh : SphericalVoronoi, SphericalDelaunay, PlanarVoronoi or PlanarDelaunay
        The other one of the two is computed where `what` asks for it.
    what : {"cells", "triangles", "edges", "ridges", "sites"}, optional
        Voronoi cells, Delaunay triangles, Delaunay edges, Voronoi ridges or the points themselves. By default cells of
        a diagram and triangles of a triangulation.
    columns : mapping of str to (n,) array_like, optional
        Further columns for cells and sites, one value for each point, such as ``read_points(path).columns``.
    latitude : {"spherical", "geodetic", "authalic"}, optional
        What the points were made with, as in `xyz_to_lonlat`. Sphere only.
    radius : float, optional
        Of the sphere: areas are steradians times its square, lengths radians times it; with
        `stereodel.earth.AUTHALIC_RADIUS_KM`, km² and km. In the plane the length of the unit of the coordinates.
    max_segment : float, optional
        Longest chord in degrees, in (0, 90], on the great circle and in longitude. Sphere only.
    extent : (4,) array_like, optional
        (xmin, xmax, ymin, ymax) to which cells and ridges of the plane are cut; by default the points' own with a
        tenth of its longer side around it.
    crs : optional
        Coordinate system of the plane's coordinates, as GeoPandas takes it. The sphere's is EPSG:4326.

    Returns
    -------
    geopandas.GeoDataFrame
        ``point`` (index of the point) and ``area`` for cells; ``triangle``, ``a``, ``b``, ``c`` (indices of its
        corners) and ``area`` for triangles; ``a``, ``b`` and ``length`` for edges and ridges; ``point`` for sites; then
        `columns`, then ``geometry``, longitude before latitude. Duplicates and cells outside the extent have no row.

    Raises
    ------
    ImportError
        Without GeoPandas (``pip install stereodel[geo]``).
    TypeError, ValueError
        For another mesh, options out of range, columns of another length.

    Notes
    -----
    Polygons are valid, counterclockwise, cut at ±180° and led along ±90° around the poles; those of the
    sphere tile [−180, 180] × [−90, 90] without gaps or overlaps, since every arc is sampled once for both of its sides
    and chords are halved where straight lines on the map would cross. Cells and triangles narrower than a micrometre
    are the exception: they are valid or empty, and may overlap others as far as chords stray from arcs. Triangles that
    are `closing` are no part of the sphere's surface and have no row; nor have edges that only they have.

    Examples
    --------
    >>> from stereodel import SphericalVoronoi
    >>> from stereodel.io import to_geodataframe
    >>> diagram = SphericalVoronoi.from_lonlat([[0, 0], [90, 0], [180, 0], [-90, 0], [0, 90], [0, -90]])
    >>> frame = to_geodataframe(diagram, columns={"name": ["A", "B", "C", "D", "N", "S"]}, max_segment=5)
    >>> print(frame.assign(kind=frame.geom_type)[["point", "name", "area", "kind"]].round(3))
       point name   area          kind
    0      0    A  2.094       Polygon
    1      1    B  2.094       Polygon
    2      2    C  2.094  MultiPolygon
    3      3    D  2.094       Polygon
    4      4    N  2.094       Polygon
    5      5    S  2.094       Polygon
    """
    geopandas = optional("geopandas", "geo")
    wanted = as_choice(what or usual_kind(mesh), tuple(SPHERE), "what")
    drawing = Drawing(
        as_scalar(max_segment, "max_segment", low=0.0, high=LARGEST_SEGMENT, open_low=True),
        as_choice(latitude, KINDS, "latitude"),
        as_scalar(radius, "radius", low=0.0, open_low=True),
        extent,
    )
    found, geometry = (SPHERE if is_spherical(mesh) else PLANE)[wanted](mesh, drawing)
    given = point_columns(columns, len(mesh.points))
    if "point" in found:
        found |= {name: values[found["point"]] for name, values in given.items()}
    elif given:
        raise ValueError(f"columns belong to points, which {wanted} have none of; use what='cells' or what='sites'")
    kept = ~optional("shapely", "geo").is_empty(geometry)
    table = {name: values[kept] for name, values in found.items()}
    return geopandas.GeoDataFrame(table, geometry=geometry[kept], crs="EPSG:4326" if is_spherical(mesh) else crs)


def usual_kind(mesh: Mesh) -> str:
    """Cells of a diagram, triangles of a triangulation; a TypeError for anything else."""
    if not isinstance(mesh, Mesh):
        raise TypeError(f"mesh must be a triangulation or a Voronoi diagram of stereodel, not {type(mesh).__name__}")
    return "cells" if isinstance(mesh, PlanarVoronoi | SphericalVoronoi) else "triangles"


def is_spherical(mesh: Mesh) -> bool:
    """Whether the mesh is on the sphere."""
    return isinstance(mesh, SphericalDelaunay | SphericalVoronoi)


def point_columns(columns: Mapping[str, npt.ArrayLike] | None, count: int) -> Columns:
    """A caller's columns as arrays with a value for each of `count` points."""
    given = {name: np.asarray(values) for name, values in (columns or {}).items()}
    for name, values in given.items():
        if values.ndim < 1 or len(values) != count:
            raise ValueError(f"columns[{name!r}] has shape {values.shape}, but there are {count} points")
    return given


def diagram_of(mesh: Mesh) -> Any:
    """The Voronoi diagram of a triangulation, or the diagram itself."""
    if isinstance(mesh, PlanarDelaunay):
        return PlanarVoronoi(mesh)
    return SphericalVoronoi(mesh) if isinstance(mesh, SphericalDelaunay) else mesh


def triangulation_of(mesh: Mesh) -> Any:
    """The triangulation of a Voronoi diagram, or the triangulation itself."""
    return mesh.delaunay() if isinstance(mesh, PlanarVoronoi | SphericalVoronoi) else mesh


def ridge_arcs(diagram: SphericalVoronoi) -> Arcs:
    """The ridges as arcs."""
    ends = diagram.vertices[diagram.ridge_vertices] if len(diagram.vertices) else np.zeros((0, 2, 3))
    normals = diagram.ridge_normals() if len(ends) else np.zeros((0, 3))
    return Arcs(ends[:, 0], ends[:, 1], normals, units(diagram.points)[diagram.ridge_points[:, 0]])


def edge_arcs(points: FloatArray, edges: npt.NDArray[Any]) -> Arcs:
    """The shorter arcs between pairs of points, given as directions."""
    unit = units(points)
    return Arcs(unit[edges[:, 0]], unit[edges[:, 1]], np.zeros((len(edges), 3)))


def _sphere_cells(mesh: Mesh, drawing: Drawing) -> tuple[Columns, Geometries]:
    diagram = diagram_of(mesh)
    geometry = sphere_polygons(ridge_arcs(diagram), voronoi_faces(diagram), drawing.max_segment, drawing.latitude)
    alone = np.flatnonzero(diagram._is_kept)
    if len(alone) == 1:
        geometry[alone] = optional("shapely", "geo").Polygon(WORLD.corners())
    return {"point": np.arange(len(geometry)), "area": diagram.areas(radius=drawing.radius)}, geometry


def _sphere_triangles(mesh: Mesh, drawing: Drawing) -> tuple[Columns, Geometries]:
    triangulation = triangulation_of(mesh)
    chosen = np.flatnonzero(~triangulation.closing)
    simplices = triangulation.simplices[chosen]
    faces, edges = triangle_faces(simplices)
    geometry = sphere_polygons(edge_arcs(mesh.points, edges), faces, drawing.max_segment, drawing.latitude)
    corners = mesh.points[simplices]
    area = solid_angle(corners[:, 0], corners[:, 1], corners[:, 2]) * drawing.radius**2
    return _triangle_columns(chosen, simplices) | {"area": area}, geometry


def _sphere_edges(mesh: Mesh, drawing: Drawing) -> tuple[Columns, Geometries]:
    triangulation = triangulation_of(mesh)
    edges = triangle_faces(triangulation.simplices[~triangulation.closing])[1]
    return _lines(edges, edge_arcs(mesh.points, edges), drawing)


def _sphere_ridges(mesh: Mesh, drawing: Drawing) -> tuple[Columns, Geometries]:
    diagram = diagram_of(mesh)
    return _lines(diagram.ridge_points, ridge_arcs(diagram), drawing)


def _lines(pairs: npt.NDArray[Any], arcs: Arcs, drawing: Drawing) -> tuple[Columns, Geometries]:
    length = np.radians(angular_distance(arcs.start, arcs.end)) * drawing.radius
    return _pair_columns(pairs) | {"length": length}, sphere_lines(arcs, drawing.max_segment, drawing.latitude)


def _sphere_sites(mesh: Mesh, drawing: Drawing) -> tuple[Columns, Geometries]:
    return _sites(xyz_to_lonlat(mesh.points, latitude=drawing.latitude))


def _plane_cells(mesh: Mesh, drawing: Drawing) -> tuple[Columns, Geometries]:
    diagram = diagram_of(mesh)
    geometry = plane_cells(diagram, frame_of(diagram.points, drawing.extent))
    return {"point": np.arange(len(geometry)), "area": diagram.areas(radius=drawing.radius)}, geometry


def _plane_triangles(mesh: Mesh, drawing: Drawing) -> tuple[Columns, Geometries]:
    simplices = triangulation_of(mesh).simplices
    corners = mesh.points[simplices]
    (ux, uy), (vx, vy) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    area = (ux * vy - uy * vx) / 2 * drawing.radius**2
    columns = _triangle_columns(np.arange(len(simplices)), simplices) | {"area": area}
    return columns, np.asarray(optional("shapely", "geo").polygons(corners))


def _plane_edges(mesh: Mesh, drawing: Drawing) -> tuple[Columns, Geometries]:
    edges = triangulation_of(mesh).edges
    return _segments(edges, mesh.points[edges], drawing)


def _plane_ridges(mesh: Mesh, drawing: Drawing) -> tuple[Columns, Geometries]:
    diagram = diagram_of(mesh)
    box = frame_of(diagram.points, drawing.extent)
    segments, ridge = diagram.segments((box.left, box.right, box.bottom, box.top))
    return _segments(diagram.ridge_points[ridge], segments, drawing)


def _segments(pairs: npt.NDArray[Any], ends: FloatArray, drawing: Drawing) -> tuple[Columns, Geometries]:
    length = np.hypot(*(ends[:, 1] - ends[:, 0]).T) * drawing.radius
    return _pair_columns(pairs) | {"length": length}, np.asarray(optional("shapely", "geo").linestrings(ends))


def _plane_sites(mesh: Mesh, _: Drawing) -> tuple[Columns, Geometries]:
    return _sites(mesh.points)


def _sites(points: FloatArray) -> tuple[Columns, Geometries]:
    return {"point": np.arange(len(points))}, np.asarray(optional("shapely", "geo").points(points))


def _triangle_columns(numbers: npt.NDArray[Any], simplices: npt.NDArray[Any]) -> Columns:
    return {"triangle": numbers} | {name: simplices[:, k] for k, name in enumerate("abc")}


def _pair_columns(pairs: npt.NDArray[Any]) -> Columns:
    return {"a": pairs[:, 0], "b": pairs[:, 1]}


Maker = Callable[[Mesh, Drawing], tuple[Columns, Geometries]]
SPHERE: dict[str, Maker] = {
    "cells": _sphere_cells,
    "triangles": _sphere_triangles,
    "edges": _sphere_edges,
    "ridges": _sphere_ridges,
    "sites": _sphere_sites,
}
PLANE: dict[str, Maker] = {
    "cells": _plane_cells,
    "triangles": _plane_triangles,
    "edges": _plane_edges,
    "ridges": _plane_ridges,
    "sites": _plane_sites,
}
