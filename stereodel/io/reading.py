"""Reading tables of points, and shapes, from files of any known format, frames and geometries."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Final, Literal

import numpy as np

from stereodel._arrays import FloatArray, Geometries, Indices
from stereodel._tasks.progress import Progress
from stereodel.curves.ragged import Ragged
from stereodel.io.formats import Content, FileFormat, FormatName, Source, Wanted, delimited, gdal, geojson, parquet
from stereodel.io.formats.foreign import SourceFile
from stereodel.io.formats.map_rows import Frame, content_of, is_frame, shapely
from stereodel.io.formats.names import DataWarning, NoPointError, naming, spelled
from stereodel.io.inspection import Inspection, summary
from stereodel.io.table import PointTable, degrees, located

FORMATS: Final[dict[FormatName, FileFormat]] = {
    "csv": delimited.FORMAT,
    "geojson": geojson.FORMAT,
    "parquet": parquet.FORMAT,
    "vector": gdal.FORMAT,
}


def read_points(
    source: Source | Any,
    *,
    lon: str | None = None,
    lat: str | None = None,
    plane: tuple[str, str] | None = None,
    format: FormatName | None = None,
    layer: str | None = None,
    crs: str | None = None,
    encoding: str | None = None,
    decimal: Literal[".", ","] | None = None,
    skip_rows: int = 0,
    missing: Sequence[str | float] = (),
    skip_missing: bool = False,
    skip_invalid: bool = False,
    wrap: bool = False,
    progress: Progress | None = None,
) -> PointTable:
    r"""Read a table of points with longitude and latitude, or with coordinates of a plane.

    Parameters
    ----------
    source : path-like, stream or frame
        A file, an open stream of text or bytes, or a frame: of GeoPandas (with points), pandas, polars, Arrow, DuckDB
        or anything that speaks Arrow's interface.
    lon, lat : str, optional
        Names of the columns, in degrees. By default the columns whose names are or contain the words for longitude and
        latitude in one of ten languages or lon, lng, long and lat, else x and y, ignoring case; else a column that has
        both, as well-known text or as ``48.4, 10``. Give the name of such a column for both. Files with geometries
        need none.
    plane : tuple of str, optional
        Names of the columns of both coordinates of a plane, in place of `lon` and `lat`. Geometries that the file has
        beside are left out.
    format : {"csv", "geojson", "parquet", "vector"}, optional
        By default taken from the extension of the path, else from the first bytes. "vector" is any format that GDAL
        reads: GeoPackage, Shapefile (also zipped), FlatGeobuf, KML, GPX, spreadsheets (.xlsx, .ods).
    layer : str, optional
        Name of the layer or sheet, where a file has several with rows; of a file of GDAL's formats alone.
    crs : str, optional
        Coordinate reference system of the columns `lon` and `lat` (easting first), such as "EPSG:25832"; by default
        they are in degrees. Files with geometries state their own. Coordinates of a `plane` stay as they are.
    encoding : str, optional
        Encoding of text, such as "cp1252". By default UTF-8 or UTF-16; what is neither is guessed, with a
        `DataWarning`: cp1252, or what ``charset-normalizer`` finds if it is installed.
    decimal : {".", ","}, optional
        The decimal mark of text; the other one separates thousands. Recognised by default.
    skip_rows : int
        Number of lines of text above the header. By default the header is found.
    missing : sequence of str or float
        Values that stand for missing ones, such as -9999, in any column.
    skip_missing : bool
        Whether to leave out rows without a place, which are an error by default.
    skip_invalid : bool
        Whether to leave out rows with a wrong place or number of fields, too, with a `DataWarning` that counts them.
    wrap : bool
        Whether to accept longitudes beyond ±360°, which in tables mostly stand for missing ones.
    progress : callable, optional
        Called repeatedly with the name of the stage, and how many characters of a text table are read, of how many.

    Returns
    -------
    PointTable
        The points and all other columns, in the order of the source.

    Raises
    ------
    ValueError
        If the file is damaged; if a coordinate is missing, not a number or out of range, or a geometry is not a point
        (the message gives the row, 1 for the first row of data); if no column or several may be longitude or latitude.
    ImportError
        Without the extra ``geo``, for formats other than CSV and GeoJSON and for coordinate systems.

    Notes
    -----
    Text may be compressed with gzip or bzip2. CSV is separated by commas, semicolons, tabs, vertical bars or blanks;
    decimal commas are accepted with any but the comma; leading lines that begin with # are comments. A column becomes
    numeric if all its values are numbers whose digits a double can hold and none is a code such as 007 or 1E3. Degrees
    may be angles, such as 10°59'07"E, 170 41.4 W and 48.5 Nord. Titles above the header, a row of units below it and
    one of totals at the end are left out; what is guessed a `DataWarning` tells.

    The page on files says which marks separate thousands, and more. Geometries in another coordinate system (in
    GeoJSON, with a member ``crs``) are transformed to EPSG:4326; without one they are in degrees.

    Examples
    --------
    >>> import io
    >>> text = "name;Longitude;Latitude;people\nQuito;-78,5;-0,2;1763000\nUlm;10,0;48,4;129000"
    >>> table = read_points(io.StringIO(text))
    >>> table.lonlat.tolist(), table.columns["people"].tolist()
    ([[-78.5, -0.2], [10.0, 48.4]], [1763000, 129000])
    >>> read_points(io.StringIO("site,east,north\nA,3500,5400"), plane=("east", "north")).places.tolist()
    [[3500.0, 5400.0]]
    >>> read_points(io.StringIO("lon,lat\n5,7\n7,95.2"))  # doctest: +ELLIPSIS
    Traceback (most recent call last):
        ...
    ValueError: row 2: latitude 95.2 is outside [-90, 90]; is it the longitude, or not in degrees? ...
    """
    options = Wanted(
        *(lon, lat, plane, layer, crs, skip_missing, skip_invalid, missing, encoding, decimal, skip_rows, wrap),
        progress=progress,
    )
    with naming(source):
        content, named, _ = _content(source, options, format)
        return located(content, options, named)


def _content(source: Any, wanted: Wanted, kind: FormatName | None = None) -> tuple[Content, str, str]:
    """What a source holds, its name for messages, and its format."""
    if is_frame(source):
        return content_of(source), "", "frame"
    if not isinstance(source, str | os.PathLike) and not hasattr(source, "read"):
        raise TypeError(f"source must be a path, a stream or a frame, not {type(source).__name__}; make a frame of it")
    file = SourceFile(source, FORMATS, kind)
    if wanted.layer is not None and file.kind != "vector":
        said = f"{spelled('layer')} is {wanted.layer!r}, but a file of the kind {file.kind} has no layers"
        raise ValueError(f"{said}; leave it out")
    named = os.fspath(source) if isinstance(source, str | os.PathLike) else ""
    return FORMATS[file.kind].read(file, wanted), named, file.kind


def inspect(source: Source | Any, *, format: FormatName | None = None, **options: Any) -> Inspection:
    r"""What `read_points` understands of a source, without reading it for good.

    Parameters
    ----------
    source, format, **options
        As for `read_points`; rows that are wrong are left out and named.

    Returns
    -------
    Inspection
        Also where reading would fail, unless the file is damaged or an option is wrong, which is a ValueError.

    Examples
    --------
    >>> import io
    >>> report = inspect(io.StringIO("lon,lat,temp\n10,48,-9999\n11,49,12\n12,99,14\n13,50,15"))
    >>> report.found["left_out"], report.found["far"], report.found["options"]["missing"]
    ({3: 'latitude 99.0 is outside [-90, 90]'}, {'temp': {-9999.0: 1}}, [-9999.0])
    """
    wanted = Wanted(**options | {"skip_invalid": True})
    with naming(source), warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", DataWarning)
        content, named, kind = _content(source, wanted, format)
        report = summary(named, content, wanted, kind)
    report.found["notes"] = [str(each.message) for each in said]
    return report


@dataclass(frozen=True, eq=False)
class Shapes:
    """All points, lines and polygons of a source, with the numbers of their features; degrees, longitude first.

    Rings are closed, with the first point repeated at the end, the outer one of each polygon before its holes;
    orientations are those of the source.
    """

    properties: Sequence[Mapping[str, Any]]
    points: FloatArray
    point_feature: Indices
    lines: Ragged
    line_feature: Indices
    rings: Ragged
    ring_polygon: Indices
    polygon_feature: Indices

    @property
    def polygons(self) -> list[list[FloatArray]]:
        """The rings of each polygon, the outer one first."""
        rings, first = list(self.rings), np.searchsorted(self.ring_polygon, np.arange(len(self.polygon_feature) + 1))
        return [rings[a:b] for a, b in pairwise(first.tolist())]

    def in_degrees(self, crs: str | None) -> Shapes:
        """The same of coordinates in another system; ValueError names the row of a place that has no degrees."""
        ring_feature = self.polygon_feature[self.ring_polygon]
        return replace(
            self,
            points=degrees(self.points, crs, self.point_feature + 1),
            lines=replace(self.lines, values=degrees(self.lines.values, crs, self.line_feature[self.lines.row] + 1)),
            rings=replace(self.rings, values=degrees(self.rings.values, crs, ring_feature[self.rings.row] + 1)),
        )

    def values(self, name: str) -> list[Any]:
        """A property of each feature, None for those that lack it; ValueError if all do."""
        if not any(name in entry for entry in self.properties):
            known = sorted({str(key) for entry in self.properties for key in entry})
            said = ", ".join(known) or "none"
            raise ValueError(f"column {name!r} is not a property of the features; they have {said}")
        return [entry.get(name) for entry in self.properties]

    def column(self, name: str) -> FloatArray:
        """A property of each feature as a number, NaN if lacking; ValueError if none has it, or for other values."""
        values = self.values(name)
        try:
            return np.array([np.nan if value is None else float(value) for value in values])
        except (TypeError, ValueError):
            raise ValueError(f"column {name!r} holds something that is not a number; name another") from None

    def words(self, name: str) -> list[str | None] | None:
        """A property of each feature as text, None for features that lack it; None if any value is not text."""
        values = [entry.get(name) for entry in self.properties]
        kinds = {type(value) for value in values} - {type(None)}
        return values if kinds and all(issubclass(kind, str) for kind in kinds) else None


@dataclass(frozen=True, eq=False)
class ShapeTable(PointTable):
    """Shapes and their columns, as a table whose places mean nothing."""

    shapes: Shapes | None = None


def read_sites(source: Source, **options: Any) -> PointTable:
    """What `read_points` reads; of a source in which others than points are, a `ShapeTable`."""
    wanted = Wanted(**options)
    with naming(source):
        found, *_ = _content(source, wanted)
        try:
            return located(found, wanted)
        except NoPointError:
            shapes = _shapes_in(found)
        return ShapeTable(np.zeros((len(shapes.properties), 2)), found.columns(), shapes=shapes)


def shapes_of(source: Any) -> Shapes:
    """The shapes of a file, of GeoJSON, of a frame, or of geometries: one feature for each row.

    source: a GeoJSON file (also a sequence, or compressed) or object, any other file that GeoPandas reads, a frame, a
    geometry or a sequence of them, or anything with ``__geo_interface__``. Coordinates in another system (of GeoJSON,
    by a member ``crs``) are transformed; without one they are in degrees. Null and empty geometries have no shapes.
    """
    if isinstance(source, Shapes):
        return source
    if isinstance(source, str | os.PathLike):
        with naming(source):
            return _shapes_in(_content(source, Wanted())[0])
    if is_frame(source):
        return _shapes_in(content_of(source))
    alone = isinstance(source, Mapping) or hasattr(source, "geom_type")
    if alone or isinstance(getattr(source, "__geo_interface__", None), Mapping):
        return of_items([source])
    if isinstance(source, Iterable) and not isinstance(source, bytes):
        return of_items(list(source))
    raise TypeError(f"source must be a file, GeoJSON, a GeoDataFrame or geometries, got {type(source).__name__}")


def _shapes_in(found: Content) -> Shapes:
    if isinstance(found, geojson.Features):
        return of_features(found)
    if not isinstance(found, Frame) or not hasattr(found.frame, "to_crs"):
        raise ValueError("this is a table without geometries; it can be read as points, not as shapes")
    frame = found.frame if found.frame.crs is None else found.frame.to_crs("EPSG:4326")
    others = frame.drop(columns=frame.geometry.name).to_dict("records") if hasattr(frame, "columns") else None
    return of_geometries(np.asarray(frame.geometry, dtype=object), others)


def of_items(items: list[Any]) -> Shapes:
    """Shapes of Shapely's geometries, or of other objects with `__geo_interface__`, one feature each."""
    if all(item is None or hasattr(item, "geom_type") for item in items):
        geometries = np.empty(len(items), dtype=object)
        geometries[:] = items
        return of_geometries(geometries)
    contents = [item if isinstance(item, Mapping) else getattr(item, "__geo_interface__", None) for item in items]
    for number, content in enumerate(contents):
        if not isinstance(content, Mapping):
            raise TypeError(f"source[{number}] must be a geometry or GeoJSON, got {type(items[number]).__name__}")
    return of_features(geojson.Features.of(*contents))


def of_features(features: geojson.Features) -> Shapes:
    """Shapes of what was read from GeoJSON."""
    parts = list(features.parts())
    polygons = [(number, part) for number, kind, part in parts if kind.endswith("Polygon")]
    points = [(number, part[0]) for number, kind, part in parts if kind.endswith("Point")]
    lines = [(number, part[0]) for number, kind, part in parts if not kind.endswith(("Polygon", "Point"))]
    rings = [(k, ring) for k, (_, part) in enumerate(polygons) for ring in part]
    (of, at), (line_feature, along), (ring_polygon, around) = map(_unzipped, (points, lines, rings))
    polygon_feature = np.array([number for number, _ in polygons], dtype=np.intp)
    point_feature = np.repeat(of, at.sizes)
    shapes = (at.values, point_feature, along, line_feature, around, ring_polygon, polygon_feature)
    return Shapes(features.properties, *shapes).in_degrees(features.crs)


def of_geometries(geometries: Geometries, properties: list[Mapping[str, Any]] | None = None) -> Shapes:
    """Shapes of Shapely's geometries, one feature each."""
    # A copy, as pandas gives arrays that are read-only, which Shapely takes since 2.2.
    parts, feature, of = np.array(geometries), np.arange(len(geometries)), shapely.GeometryType
    while (shapely.get_type_id(parts) > of.POLYGON).any():  # multi-part
        parts, inner = shapely.get_parts(parts, return_index=True)
        feature = feature[inner]
    there = ~(shapely.is_missing(parts) | shapely.is_empty(parts))
    parts, feature = parts[there], feature[there]
    kind = shapely.get_type_id(parts)
    point, line, polygon = kind == of.POINT, ~np.isin(kind, (of.POINT, of.POLYGON)), kind == of.POLYGON
    rings, owner = shapely.get_rings(parts[polygon], return_index=True)
    rows = [
        Ragged.grouped(lonlat.reshape(-1, 2), row, len(some))
        for some in (parts[line], rings)
        for lonlat, row in [shapely.get_coordinates(some, return_index=True)]
    ]
    points = shapely.get_coordinates(parts[point]).reshape(-1, 2)
    named = properties or [{}] * len(geometries)
    found = Shapes(named, points, feature[point], rows[0], feature[line], rows[1], owner, feature[polygon])
    return found.in_degrees(None)


def _unzipped(rows: list[tuple[int, FloatArray]]) -> tuple[Indices, Ragged]:
    numbers, places = [number for number, _ in rows], [positions for _, positions in rows]
    return np.array(numbers, dtype=np.intp), Ragged.of(places, np.zeros((0, 2)))
