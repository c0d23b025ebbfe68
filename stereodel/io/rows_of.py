"""Diagrams, triangulations and contours as rows of maps: columns, and geometries as well-known binary or in a frame.

A side of a face is the index of an arc that two faces share, or ~index where it runs from the arc's end to its start,
as in TopoJSON; the arc of a side is ``np.maximum(side, ~side)``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from typing import Any, Literal, ParamSpec

import numpy as np
import numpy.typing as npt

from stereodel import data
from stereodel._arrays import FloatArray, Indices, IntArray, Packed, as_choice, as_scalar
from stereodel._extras import optional
from stereodel._spaces import SPHERE, surface_of
from stereodel._tasks.progress import Progress
from stereodel.constants import UNIT_ROUNDOFF
from stereodel.curves.borders import Box, Pieces, frame_of
from stereodel.curves.clip import chains_of, closed_along, points_along, together
from stereodel.curves.ragged import Ragged
from stereodel.curves.trace import Arcs, great, sides_of
from stereodel.interpolation import Contour
from stereodel.io.formats import wkb
from stereodel.io.formats.map_rows import MapRows, columns_of, packed, unpacked
from stereodel.io.formats.names import beside, spelled
from stereodel.io.maps.clipping import clipped
from stereodel.io.maps.dissolving import codes_of, dissolved, dividing, grouped, merged
from stereodel.io.maps.on_map import invalid, polygons_on_map, repaired
from stereodel.io.maps.tiles import Net, sphere_lines, sphere_polygons
from stereodel.io.reading import shapes_of
from stereodel.sphere import xyz_to_lonlat
from stereodel.sphere.latitudes import KINDS, Latitude
from stereodel.sphere.vectors import units
from stereodel.triangulation import PlanarVoronoi, SphericalVoronoi
from stereodel.triangulation.delaunay import Triangulation, state_of
from stereodel.triangulation.diagram import Diagram
from stereodel.triangulation.topology import edges_of

Mesh = Triangulation | Diagram[Any]
MESHES = (Triangulation, Diagram)
"""The same, for `isinstance`."""
Columns = dict[str, npt.NDArray[Any]]

What = Literal["cells", "triangles", "edges", "ridges", "sites"]
WHAT = ("cells", "triangles", "edges", "ridges", "sites")
LARGEST_SEGMENT = 90.0
_P = ParamSpec("_P")


def rows_of(
    mesh: Mesh | list[Contour],
    *,
    what: What | None = None,
    columns: Mapping[str, npt.ArrayLike] | None = None,
    latitude: Latitude | None = None,
    radius: float = 1.0,
    max_segment: float = 1.0,
    bounds: npt.ArrayLike | None = None,
    crs: Any = None,
    clip: Any = None,
    dissolve: str | None = None,
    progress: Progress | None = None,
) -> MapRows:
    """Cells, triangles, edges, ridges, sites or contours as a GeoDataFrame.

    Parameters
    ----------
    mesh : SphericalVoronoi, SphericalDelaunay, PlanarVoronoi, PlanarDelaunay, or list of Contour
        Diagram and triangulation are computed from each other where `what` requires it. Contours come from `contours`;
        of the options only `latitude`, `max_segment` and `crs` apply to them.
    what : {"cells", "triangles", "edges", "ridges", "sites"}, optional
        Voronoi cells or ridges, Delaunay triangles or edges, or the points; by default the cells of a diagram and the
        triangles of a triangulation.
    columns : mapping of str to (n,) array_like, optional
        Further columns for cells and sites, one value for each point, such as ``read_points(path).columns``.
    latitude : {"spherical", "geodetic", "authalic"}, optional
        Of the results, as in `xyz_to_lonlat`; by default that of the input points. Sphere only.
    radius : float, optional
        Of the sphere, for areas and lengths: `stereodel.earth.AUTHALIC_RADIUS_KM` gives km² and km. In the plane, the
        length of one coordinate unit.
    max_segment : float, optional
        Longest chord in degrees, in (0, 90], measured along the great circle and in longitude. Sphere only.
    bounds : (4,) array_like, optional
        (xmin, ymin, xmax, ymax) to which cells and ridges of the plane are cut; by default those of the points and a
        tenth of the longer side around them.
    crs : optional
        Coordinate reference system of the plane, in any form that GeoPandas accepts; on the sphere EPSG:4326.
    clip : "land", path-like, GeoDataFrame, geometry or GeoJSON, optional
        Polygons to which cells or triangles of the sphere are clipped, in degrees or their own coordinate system, or
        the land of Natural Earth, 1:50 000 000. What lies outside has no row; ``area`` is the area inside.
    dissolve : str, optional
        One of `columns`: the cells of points with the same value in it, missing values among them, are one feature.
    progress : callable, optional
        Called repeatedly with the name of the stage, how much of it is done, and how much there is.

    Returns
    -------
    geopandas.GeoDataFrame
        ``point`` (index of the point) and ``area`` for cells; ``triangle``, ``a``, ``b``, ``c`` (indices of its
        corners) and ``area`` for triangles; ``a``, ``b`` and ``length`` for edges and ridges; ``point`` for sites;
        ``level`` and ``closed`` for contours, whose lines have higher values on their left; then `columns`, with a
        number and a warning where their names are taken, then ``geometry``. Duplicates and cells outside the bounds
        have no row. With `dissolve` ``point`` is the first of the points, ``cells`` the number of cells, ``area`` that
        of all, rounded once, and of `columns` there is that one alone.

    Raises
    ------
    ImportError
        Without GeoPandas (the extra ``geo``).
    TypeError, ValueError
        If `mesh` is of another type, an option is out of range, or a column has the wrong length.

    Notes
    -----
    Polygons are valid, counterclockwise, cut at ±180° and closed along ±90° around the poles. Those of the sphere tile
    [−180, 180] × [−90, 90] without gaps or overlaps, since neighbours share every point of their sides. Cells and
    triangles narrower than a micrometre are the exception: they are valid or empty, and may overlap others by the
    distance between chords and arcs. `closing` triangles have no row; nor do edges that belong to them alone.

    Polygons are clipped on the map, where the lines of `clip` are straight, as in a GIS. Crossings are rounded to
    doubles separately for each of two neighbours. The area of a clipped polygon is the share that remains, measured on
    the sphere, times the area of the whole cell or triangle, which comes from its arcs. Cells are dissolved before they
    are clipped; their area is the sum of their clipped areas.

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
    as_scalar(max_segment, spelled("max_segment"), low=0.0, high=LARGEST_SEGMENT, open_low=True)
    if isinstance(mesh, list):
        if any(each is not None for each in (what, columns, bounds, clip, dissolve)):
            raise ValueError("what, columns, bounds, clip and dissolve are options of meshes, not of contours")
        return _of_contours(mesh, max_segment, latitude, crs)
    wanted = as_choice(what or usual_kind(mesh), WHAT, "what")
    chosen: Latitude = as_choice(latitude or mesh.latitude or "spherical", KINDS, "latitude")
    scale = as_scalar(radius, "radius", low=0.0, open_low=True)
    box = None if mesh.surface is SPHERE else frame_of(mesh.points, bounds)
    if clip is not None and (box or wanted not in ("cells", "triangles")):
        raise ValueError("clip is for cells and triangles of the sphere; what is in the plane is cut to bounds")
    given = point_columns(columns, len(mesh.points))
    by = None if dissolve is None else dividing(dissolve, given, wanted)
    found: Columns
    if wanted == "sites":
        found, binary = {"point": np.arange(len(mesh.points))}, wkb.points(places_of(mesh, mesh.points, chosen))
    elif wanted in ("cells", "triangles"):
        found, binary = _faces(mesh, wanted, max_segment, chosen, box, progress)
        found["area"] = found["area"] * scale**2
    else:
        found, binary = _lines(mesh, wanted, max_segment, chosen, box)
        found["length"] = found["length"] * scale
    whole = binary
    if clip is not None:
        shapes = shapes_of(data.land() if isinstance(clip, str) and clip == "land" else clip)
        binary, share = clipped(whole, shapes.rings, shapes.ring_polygon, chosen)
        found["area"] = found["area"] * share
    if by is not None:
        there = np.flatnonzero(wkb.is_there(binary))
        given, groups = {str(dissolve): by}, grouped(codes_of(by[there]))
        found = merged({name: values[there] for name, values in found.items()}, groups)
        binary = dissolved(whole[there], groups)
        if clip is not None:
            binary, _ = clipped(binary, shapes.rings, shapes.ring_polygon, chosen)
    if "point" in found:
        named = beside([*found, "geometry"], given)
        found |= {name: values[found["point"]] for name, values in named.items()}
    elif given:
        raise ValueError(f"columns belong to points, which {wanted} have none of; use what='cells' or what='sites'")
    layer = MapRows(found, binary, crs if box else "EPSG:4326")
    kept = wkb.is_there(binary)
    return layer if kept.all() else layer.take(kept)


def _framed(rows: Callable[_P, MapRows]) -> Callable[_P, Any]:
    """A function that makes a GeoDataFrame, with the parameters and the docstring of one that makes rows."""

    @wraps(rows)
    def to_geodataframe(*args: _P.args, **options: _P.kwargs) -> Any:
        optional("geopandas", "geo")
        return rows(*args, **options).frame()

    to_geodataframe.__name__ = to_geodataframe.__qualname__ = "to_geodataframe"
    return to_geodataframe


to_geodataframe = _framed(rows_of)
"""`rows_of` for writing to files is without a Shapely geometry for each row."""


def _faces(
    mesh: Mesh, what: str, max_segment: float, latitude: Latitude, box: Box | None, progress: Progress | None
) -> tuple[Columns, Packed]:
    """Cells or triangles: columns, areas among them, and polygons; None where there is none."""
    if what == "cells":
        diagram = diagram_of(mesh)
        columns: Columns = {"point": np.arange(len(diagram.points)), "area": diagram.areas()}
        if box is not None:
            return columns, plane_cells(diagram, box)
        cells = sphere_polygons(ridge_net(diagram), voronoi_sides(diagram), max_segment, latitude, progress)
        kept = np.flatnonzero(diagram.is_kept)
        if len(kept) == 1:
            world = np.array([(180.0, -90.0), (180.0, 90.0), (-180.0, 90.0), (-180.0, -90.0)])
            cells[kept] = wkb.polygons(Ragged.of([world]))
        return columns, cells
    triangulation, number = triangles_of(mesh)
    simplices = triangulation.simplices[number]
    corners = mesh.points[simplices]
    columns = {"triangle": number} | {name: simplices[:, k] for k, name in enumerate("abc")}
    columns["area"] = mesh.surface.areas(*corners.transpose(1, 0, 2))
    if box is not None:
        return columns, wkb.polygons(Ragged(corners.reshape(-1, 2), 3 * np.arange(len(corners) + 1)))
    sides, pairs = triangle_sides(simplices)
    return columns, sphere_polygons(Net(units(mesh.points), pairs), sides, max_segment, latitude, progress)


def _lines(mesh: Mesh, what: str, max_segment: float, latitude: Latitude, box: Box | None) -> tuple[Columns, Packed]:
    """Edges or ridges: columns, lengths among them, and lines."""
    diagram = None if what == "edges" else diagram_of(mesh)
    pairs = corners_of(mesh, what) if diagram is None else diagram.ridge_points
    if box is None:
        arcs = (Net(units(mesh.points), pairs.astype(np.intp)) if diagram is None else ridge_net(diagram)).arcs()
        length = np.radians(mesh.surface.distances(arcs.start, arcs.end))
        lines = sphere_lines(arcs, max_segment, latitude)
    else:
        ends = mesh.points[pairs]
        if diagram is not None:
            ends, ridge = diagram.segments((box.left, box.bottom, box.right, box.top))
            pairs = pairs[ridge]
        length = mesh.surface.distances(ends[:, 0], ends[:, 1])
        lines = wkb.lines(Ragged(ends.reshape(-1, 2), 2 * np.arange(len(ends) + 1)))
    return {"a": pairs[:, 0], "b": pairs[:, 1], "length": length}, lines


def ridge_net(diagram: Any) -> Net:
    """The ridges of a diagram on the sphere, each kept clear of the first of its two sites."""
    sites, site = units(diagram.points), diagram.ridge_points[:, 0]
    return Net(diagram.vertices, diagram.ridge_vertices, diagram.ridge_normals, sites, site)


def _of_contours(contours: Sequence[Contour], max_segment: float, latitude: Latitude | None, crs: Any) -> MapRows:
    """A row for each contour: its level, whether it is closed, and its line, cut at ±180° on the sphere."""
    for number, contour in enumerate(contours):
        if not isinstance(contour, Contour):
            raise TypeError(f"mesh[{number}] must be a Contour, not {type(contour).__name__}")
    known = latitude or next((contour.latitude for contour in contours if contour.latitude), "spherical")
    kind: Latitude = as_choice(known, KINDS, "latitude")
    columns: Columns = {
        "level": np.array([contour.level for contour in contours], dtype=np.float64),
        "closed": np.array([contour.closed for contour in contours], dtype=np.bool_),
    }
    nothing = contours[0].points[:0] if contours else np.zeros((0, 3))
    points = Ragged.of([contour.points for contour in contours], nothing)
    if surface_of(points.values) is not SPHERE:
        return MapRows(columns, wkb.lines(points), crs)
    first, lines = sides_of(points)
    arcs = great(points.values[first], points.values[first + 1])
    return MapRows(columns, sphere_lines(arcs, max_segment, kind, lines), "EPSG:4326")


def plane_cells(diagram: PlanarVoronoi, box: Box) -> Packed:
    """A Polygon for each point, None where its cell is outside; neighbours share points, as ridges are cut once."""
    count = len(diagram.points)
    segments, ridge = _segments(diagram, box)
    # The ridges are already cut: only the endpoints of these arcs are used.
    none = np.zeros((len(ridge), 0))
    arcs = Arcs(segments[:, 0], segments[:, 1], none, none, none, none, none, ridge)
    low, high = [box.left, box.bottom], [box.right, box.top]
    opens, shuts = ((segments == low) | (segments == high)).any(axis=2).T
    pieces = Pieces(arcs, opens, shuts, np.ones(len(ridge), dtype=bool), np.zeros(len(ridge), dtype=bool))
    samples = Ragged(segments.reshape(-1, 2), 2 * np.arange(len(ridge) + 1))
    chains = chains_of(voronoi_sides(diagram), pieces)
    points = points_along(chains.pieces, samples)
    joined, owner = closed_along(box, points.take(~chains.whole), chains.row[~chains.whole])
    loops, owner = together(points.take(chains.whole), joined), np.append(chains.row[chains.whole], owner)
    if not len(ridge) and count:
        # One cell fills the rectangle: that of the site nearest to any place in it.
        middle = (box.corners[0] + box.corners[2]) / 2
        loops = Ragged.of([box.once()])
        owner = np.argmin(np.sum((diagram.points - middle) ** 2, axis=1), keepdims=True)
    there = loops.sizes > 3
    cells, _ = polygons_on_map(loops.take(there), owner[there], count)
    if (wrong := invalid(cells, loops.take(there), owner[there])).any():
        cells[wrong] = packed(repaired(unpacked(cells[wrong]), wrong[wrong]))
    return cells


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


def usual_kind(mesh: Mesh) -> str:
    """What a mesh shows by default: cells of a diagram, triangles of a triangulation; TypeError for anything else."""
    if not isinstance(mesh, MESHES):
        raise TypeError(f"mesh must be a triangulation or a Voronoi diagram of stereodel, not {type(mesh).__name__}")
    return "cells" if isinstance(mesh, Diagram) else "triangles"


def point_columns(columns: Any, count: int) -> Columns:
    """The columns of a mapping or a frame as arrays with a value for each of `count` points."""
    given = {name: np.asarray(values) for name, values in columns_of({} if columns is None else columns).items()}
    for name, values in given.items():
        if values.ndim < 1 or len(values) != count:
            raise ValueError(f"columns[{name!r}] has shape {values.shape}, but there are {count} points")
    return given


def places_of(mesh: Mesh, points: FloatArray, latitude: Latitude) -> FloatArray:
    """Points on the surface of a mesh as (n, 2): longitude and latitude, or as they are in the plane."""
    return xyz_to_lonlat(points, latitude=latitude) if mesh.surface is SPHERE else points


def diagram_of(mesh: Mesh) -> Any:
    """The Voronoi diagram of a triangulation, or the diagram itself."""
    return mesh if isinstance(mesh, Diagram) else mesh.surface.voronoi(mesh)


def triangulation_of(mesh: Mesh) -> Any:
    """The triangulation of a Voronoi diagram, or the triangulation itself."""
    return mesh.delaunay() if isinstance(mesh, Diagram) else mesh


def triangles_of(mesh: Mesh) -> tuple[Any, Indices]:
    """The triangulation, and its triangles but for those that close the far side of the sphere."""
    triangulation = triangulation_of(mesh)
    return triangulation, np.flatnonzero(state_of(triangulation).open)


def corners_of(mesh: Mesh, what: str) -> IntArray:
    """Indices of the corners of these triangles, or of the ends of their edges."""
    triangulation, number = triangles_of(mesh)
    simplices: IntArray = triangulation.simplices[number]
    return edges_of(simplices) if what == "edges" else simplices


def voronoi_sides(diagram: PlanarVoronoi | SphericalVoronoi) -> Ragged:
    """The ridges around the cell of each point, counterclockwise; a duplicate's cell has none.

    In a cell each vertex is the start of one side, so the sides follow the order of the cell's vertices. The strips
    between collinear points have no vertices; their sides are in no particular order.
    """
    pairs, ends = diagram.ridge_points.astype(np.intp), diagram.ridge_vertices.astype(np.intp)
    cell, count = pairs.T.ravel(), len(diagram.points)
    ridge = np.arange(len(pairs))
    if not len(diagram.vertices):
        order = np.argsort(cell, kind="stable")
    else:
        # Sorted by (cell, corner), the corners of cells and the sides by starting corner are the same list.
        base = len(diagram.vertices) + 1
        corners = np.repeat(np.arange(count), np.diff(diagram.region_offsets)) * base + diagram.region_indices + 1
        order = np.empty_like(cell)
        order[np.argsort(corners)] = np.argsort(cell * base + ends.T.ravel() + 1)
    return Ragged.grouped(np.concatenate([ridge, ~ridge])[order], cell, count)


def triangle_sides(simplices: IntArray) -> tuple[Ragged, Indices]:
    """The sides of triangles (m, 3), and the endpoints of the edges (e, 2), lower index first."""
    start, end = simplices.ravel().astype(np.intp), np.roll(simplices, -1, axis=1).ravel().astype(np.intp)
    keys = np.minimum(start, end) << 32 | np.maximum(start, end)
    edges, number = np.unique(keys, return_inverse=True)
    sides = np.where(start > end, ~number.ravel(), number.ravel())
    return Ragged(sides, np.arange(0, len(start) + 1, 3)), np.column_stack([edges >> 32, edges & 0xFFFFFFFF])
