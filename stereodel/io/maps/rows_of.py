"""Diagrams as GeoDataFrames, which GeoPandas writes in nearly every format."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy.typing as npt

from stereodel._arrays import as_choice, as_scalar
from stereodel._extras import optional
from stereodel._tasks.progress import Progress
from stereodel.curves.borders import frame_of
from stereodel.interpolation import Contour
from stereodel.io.formats.map_rows import MapRows, packed
from stereodel.io.formats.names import beside
from stereodel.io.formats.wkb import is_there
from stereodel.io.maps.meshes_as_rows import Mesh, is_spherical, point_columns, usual_kind
from stereodel.sphere.latitudes import KINDS, Latitude

What = Literal["cells", "triangles", "edges", "ridges", "sites"]
WHAT = ("cells", "triangles", "edges", "ridges", "sites")
LARGEST_SEGMENT = 90.0


def to_geodataframe(
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
) -> Any:
    """Cells, triangles, edges, ridges, sites or contours as a GeoDataFrame.

    Parameters
    ----------
    mesh : SphericalVoronoi, SphericalDelaunay, PlanarVoronoi, PlanarDelaunay, or list of Contour
        Diagram and triangulation are computed from each other where `what` requires it. Contours come from `contours`;
        of the options only `latitude`, `max_segment` and `crs` apply to them.
    what : {"cells", "triangles", "edges", "ridges", "sites"}, optional
        Voronoi cells, Delaunay triangles, Delaunay edges, Voronoi ridges or the points themselves. By default the cells
        of a diagram and the triangles of a triangulation.
    columns : mapping of str to (n,) array_like, optional
        Further columns for cells and sites, one value for each point, such as ``read_points(path).columns``.
    latitude : {"spherical", "geodetic", "authalic"}, optional
        Kind of latitude of the results, as in `xyz_to_lonlat`; by default that of the input points. Sphere only.
    radius : float, optional
        Radius of the sphere. Areas are steradians times its square, lengths radians times it; with
        `stereodel.earth.AUTHALIC_RADIUS_KM`, they are in km² and km. In the plane, the length of one coordinate unit.
    max_segment : float, optional
        Longest chord in degrees, in (0, 90], measured along the great circle and in longitude. Sphere only.
    bounds : (4,) array_like, optional
        (xmin, ymin, xmax, ymax) to which cells and ridges of the plane are cut; by default the rectangle of the points
        extended on all sides by a tenth of its longer side.
    crs : optional
        Coordinate reference system of plane coordinates, in any form that GeoPandas accepts. On the sphere it is
        EPSG:4326.
    clip : "land", path-like, GeoDataFrame, geometry or GeoJSON, optional
        Polygons to which cells or triangles of the sphere are clipped, in degrees or with a coordinate system of their
        own; "land" is the land of Natural Earth, 1:50 000 000. What lies outside has no row; ``area`` is the area
        inside.

    Returns
    -------
    geopandas.GeoDataFrame
        ``point`` (index of the point) and ``area`` for cells; ``triangle``, ``a``, ``b``, ``c`` (indices of its
        corners) and ``area`` for triangles; ``a``, ``b`` and ``length`` for edges and ridges; ``point`` for sites;
        ``level`` and ``closed`` for contours, whose lines have higher values on their left; then `columns`, then
        ``geometry``, longitude before latitude. Duplicates and cells outside the bounds have no row. A column of
        `columns` whose name is taken gets a number appended, with a warning.

    Raises
    ------
    ImportError
        Without GeoPandas (the extra ``geo``).
    TypeError, ValueError
        If `mesh` is of another type, an option is out of range, or a column has the wrong length.

    Notes
    -----
    Polygons are valid, counterclockwise, cut at ±180° and closed along ±90° around the poles. Those of the sphere tile
    [−180, 180] × [−90, 90] without gaps or overlaps, since every arc is sampled once for the two faces that share it
    and chords are halved where straight lines on the map would cross. Cells and triangles narrower than a micrometre
    are the exception: they are valid or empty, and may overlap others by the distance between chords and arcs.
    `closing` triangles are not part of the sphere's surface and have no row; nor do edges that belong to them alone.

    Polygons are clipped on the map, where the lines of `clip` are straight, as in a GIS, and arcs are chords no longer
    than `max_segment`. Crossings are rounded to doubles separately for each of two neighbours. The area of a clipped
    polygon is the share of the polygon on the map that remains, measured on the sphere, times the area of the whole
    cell or triangle, which comes from its arcs.

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
    optional("geopandas", "geo")
    return rows_of(
        mesh,
        what=what,
        columns=columns,
        latitude=latitude,
        radius=radius,
        max_segment=max_segment,
        bounds=bounds,
        crs=crs,
        clip=clip,
    ).frame()


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
    progress: Progress | None = None,
) -> MapRows:
    """The rows of `to_geodataframe` for writing to files, without creating a Shapely geometry for each."""
    # The parameters are written out in both functions: the documentation, type checkers and, for options of `write`,
    # error messages read them from the signatures, and options passed on as a mapping would be a third list.
    as_scalar(max_segment, "max_segment", low=0.0, high=LARGEST_SEGMENT, open_low=True)
    if isinstance(mesh, list):
        if what is not None or columns or bounds is not None or clip is not None:
            raise ValueError(
                "what, columns, bounds and clip are options of triangulations and diagrams, not of contours"
            )
        return _of_contours(mesh, max_segment, latitude, crs)
    wanted = as_choice(what or usual_kind(mesh), WHAT, "what")
    chosen: Latitude = as_choice(latitude or mesh.latitude or "spherical", KINDS, "latitude")
    as_scalar(radius, "radius", low=0.0, open_low=True)
    spherical = is_spherical(mesh)
    if clip is not None and not (spherical and wanted in ("cells", "triangles")):
        raise ValueError("clip is for cells and triangles of the sphere; what is in the plane is cut to bounds")
    from stereodel.io.maps import as_geometries

    if spherical:
        found, binary = as_geometries.on_sphere(mesh, wanted, max_segment, chosen, radius, progress)
    else:
        found, binary = as_geometries.in_plane(mesh, wanted, frame_of(mesh.points, bounds), radius)
    if clip is not None:
        from stereodel.io.maps.clipping import clipped

        binary, share = clipped(binary, clip, chosen)
        found["area"] = found["area"] * share
    given = point_columns(columns, len(mesh.points))
    if "point" in found:
        named = beside([*found, "geometry"], given)
        found |= {name: values[found["point"]] for name, values in named.items()}
    elif given:
        raise ValueError(f"columns belong to points, which {wanted} have none of; use what='cells' or what='sites'")
    layer = MapRows(found, binary, "EPSG:4326" if spherical else crs)
    kept = is_there(binary)
    return layer if kept.all() else layer.take(kept)


def _of_contours(contours: Sequence[Contour], max_segment: float, latitude: Latitude | None, crs: Any) -> MapRows:
    """A row for each contour."""
    from stereodel.io.maps.as_geometries import isolines

    for number, contour in enumerate(contours):
        if not isinstance(contour, Contour):
            raise TypeError(f"mesh[{number}] must be a Contour, not {type(contour).__name__}")
    chosen = None if latitude is None else as_choice(latitude, KINDS, "latitude")
    found, lines = isolines(contours, max_segment, chosen)
    spherical = not contours or contours[0].points.shape[1] == 3
    return MapRows(found, packed(lines), "EPSG:4326" if spherical else crs)
