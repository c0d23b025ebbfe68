"""Reading tables of points, and shapes: detection of the format, and a reader for each."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, BinaryIO, Final, Literal, TextIO

import numpy as np

from stereodel._arrays import Column, Indices, as_choice
from stereodel._extras import optional
from stereodel._tasks.progress import Progress
from stereodel.io.formats import geojson
from stereodel.io.formats.delimited import split_columns
from stereodel.io.formats.gdal import read_frame, told
from stereodel.io.formats.geojson import Features
from stereodel.io.formats.names import beside, find_lonlat, index_columns, listed, spelled
from stereodel.io.formats.packed import unpacked
from stereodel.io.formats.parquet import read_parquet
from stereodel.io.formats.text import column, decoded, texts
from stereodel.io.map_shapes import MULTIPOINT, POINT, Shapes, of_features, of_geometries, of_items
from stereodel.io.table import PointTable, table_of

Source = str | os.PathLike[str] | BinaryIO | TextIO
Format = Literal["csv", "geojson", "parquet", "vector"]
TEXT: Final = (".csv", ".tsv", ".txt")
PACKED: Final = (".gz", ".bz2")
ENDINGS: dict[str, Format] = {
    **dict.fromkeys(TEXT, "csv"),
    **dict.fromkeys((".geojson", ".json", ".geojsonl", ".geojsons"), "geojson"),
    **dict.fromkeys((".parquet", ".geoparquet"), "parquet"),
    **dict.fromkeys((".gpkg", ".shp", ".fgb", ".kml", ".kmz", ".gml", ".gpx", ".zip", ".xlsx", ".ods"), "vector"),
}
BEGINNINGS: Final[dict[bytes, str]] = {
    b"PAR1": ".parquet",
    b"SQLite format 3": ".gpkg",
    b"fgb": ".fgb",
    b"PK\x03\x04": ".zip",
    b"\x00\x00\x27\x0a": ".shp",
    b"<": ".kml",
    b"{": ".geojson",
    b"\x1e{": ".geojson",
}
"""First bytes of files and matching extensions; XML may be KML or GPX, a zip archive a spreadsheet or a shapefile."""


@dataclass(frozen=True)
class Asked:
    """Options of `read_points` that describe the table."""

    lon: str | None = None
    lat: str | None = None
    plane: tuple[str, str] | None = None
    crs: str | None = None
    skip_missing: bool = False
    progress: Progress | None = None
    name: str = ""

    def axes(self, names: Sequence[str]) -> tuple[str, str]:
        """The columns of the coordinates; ValueError lists the columns if they are not among them."""
        if self.plane is None:
            return find_lonlat(names, self.lon, self.lat)
        missing = [name for name in self.plane if name not in names]
        if missing:
            raise ValueError(f"there is no column {missing[0]!r}; the columns are {listed(names)}")
        return self.plane

    def table(self, columns: dict[str, Column], rows: Indices | None = None) -> PointTable:
        """A table with coordinates in two of its columns; rows are counted from 1 unless they have numbers."""
        where = self.axes(list(columns))
        pair = [columns[name] for name in where]
        kept = {name: values for name, values in columns.items() if name not in where}
        return self.of(pair, kept, rows, plane=self.plane, crs=self.crs)

    def of(
        self, pair: Sequence[Column], columns: dict[str, Column], rows: Indices | None = None, **on: Any
    ) -> PointTable:
        """A table with coordinates beside its columns: in degrees, or on what `table_of` is told."""
        numbered = np.arange(1, len(pair[0]) + 1) if rows is None else rows
        return table_of(pair, columns, numbered, skip_missing=self.skip_missing, name=self.name, **on)


def read_points(
    source: Source,
    *,
    lon: str | None = None,
    lat: str | None = None,
    plane: tuple[str, str] | None = None,
    format: Format | None = None,
    layer: str | None = None,
    crs: str | None = None,
    skip_missing: bool = False,
    progress: Progress | None = None,
) -> PointTable:
    r"""Read a table of points with longitude and latitude, or with coordinates of a plane.

    Parameters
    ----------
    source : path-like or stream
        A file, or an open stream of text or bytes.
    lon, lat : str, optional
        Names of the columns, in degrees. By default the columns whose names are or contain one of the words lon, lng,
        long, longitude and lat, latitude, else x and y, ignoring case. Files with geometries need none.
    plane : tuple of str, optional
        Names of the columns of both coordinates of a plane, in place of `lon` and `lat`. The file must be a table;
        geometries that it has beside are left out.
    format : {"csv", "geojson", "parquet", "vector"}, optional
        By default taken from the extension of the path, else from the first bytes. "vector" is any format that GDAL
        reads: GeoPackage, Shapefile (also zipped), FlatGeobuf, KML, GPX, spreadsheets (.xlsx, .ods).
    layer : str, optional
        Name of the layer or sheet, where a file has several with rows; of a file of GDAL's formats alone.
    crs : str, optional
        Coordinate reference system of the columns `lon` and `lat` (easting first), such as "EPSG:25832"; by default
        they are in degrees. Files with geometries state their own. Coordinates of a `plane` stay as they are.
    skip_missing : bool
        Whether to leave out rows without a place, which are an error by default.
    progress : callable, optional
        Called repeatedly with the name of the stage, and how many characters of a text table are read, of how many.

    Returns
    -------
    PointTable
        The points and all other columns, in the order of the source.

    Raises
    ------
    ValueError
        If the file is damaged; if a coordinate is missing or not a number, or a latitude is outside [−90, 90] (the
        message gives the row, counted from 1 for the first row of data); if no column or several may be longitude or
        latitude (the message lists the columns); or if a geometry is not a point.
    ImportError
        If libraries for formats other than CSV and GeoJSON, or for coordinate systems, are missing (the extra
        ``geo``).
    OSError
        If the file cannot be read.

    Notes
    -----
    Text is UTF-8, or UTF-16 with a byte order mark, and may be compressed with gzip or bzip2. CSV: separated by commas,
    semicolons, tabs, vertical bars or blanks; decimal commas are accepted with any separator but the comma; the first
    line is a header unless most of its fields are numbers; leading lines that begin with # are comments. A column
    becomes numeric if all its values are numbers whose digits a double can hold and none has a leading zero followed by
    digits. Where each point or comma in a column may separate thousands (128.928, 1,234), the other numbers of the
    table decide: if theirs is the same decimal mark, and no other, it is decimal, and so is a point if they have none;
    else the column stays text, with a `DataWarning`. Marks in degrees are decimal. If columns of a GeoJSON file's
    properties would have more than a million cells, and more than fifty for each property of a feature, those that
    fewer than one in fifty features have are together, as mappings, in a column ``others``, with a `DataWarning`.
    Geometries in another coordinate system (in GeoJSON, with a member ``crs``) are transformed to EPSG:4326; without
    one they are taken as longitude and latitude in degrees. A MultiPoint with one point counts as a point.

    Examples
    --------
    >>> import io
    >>> text = "name;Longitude;Latitude;people\nQuito;-78,5;-0,2;1763000\nUlm;10,0;48,4;129000"
    >>> table = read_points(io.StringIO(text))
    >>> table.lonlat.tolist(), table.columns["people"].tolist()
    ([[-78.5, -0.2], [10.0, 48.4]], [1763000, 129000])
    >>> read_points(io.StringIO("site,east,north\nA,3500,5400"), plane=("east", "north")).places.tolist()
    [[3500.0, 5400.0]]
    >>> read_points(io.StringIO("lon,lat\n5,7\n7,95.2"))
    Traceback (most recent call last):
        ...
    ValueError: row 2: latitude 95.2 is outside [-90, 90]; is it the longitude, or not in degrees?
    """
    if plane is not None and (lon is not None or lat is not None):
        raise ValueError("plane names the columns of both coordinates; leave out lon and lat")
    name = os.fspath(source) if isinstance(source, str | os.PathLike) else ""
    asked = Asked(lon, lat, plane, crs, skip_missing, progress, name)
    with naming(source):
        file = _File(source, format, layer)
        return _of_frame(file.frame(), asked) if file.kind == "vector" else READERS[file.kind](file.content, asked)


def shapes_of(source: Any) -> Shapes:
    """The shapes of a file, of GeoJSON, of a frame, or of geometries: one feature for each row.

    source: a GeoJSON file (also a sequence, or compressed) or object, any other file that GeoPandas reads, a frame, a
    geometry or a sequence of them, or anything with ``__geo_interface__``. Coordinates in another system (of GeoJSON,
    by a member ``crs``) are transformed; without one they are in degrees. Null and empty geometries have no shapes.

    >>> square = {"type": "Polygon", "coordinates": [[[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]]}
    >>> shapes = shapes_of({"type": "Feature", "properties": {"people": 3}, "geometry": square})
    >>> len(shapes.rings), shapes.rings.values[1].tolist(), shapes.column("people").tolist()
    (1, [10.0, 0.0], [3.0])
    """
    if isinstance(source, str | os.PathLike):
        return _shapes_of_file(Path(source))
    if isinstance(source, Mapping):
        return of_features(Features.of(source))
    if hasattr(source, "to_crs"):
        degrees = source if source.crs is None else source.to_crs("EPSG:4326")
        others = degrees.drop(columns=degrees.geometry.name).to_dict("records") if hasattr(degrees, "columns") else None
        return of_geometries(np.asarray(degrees.geometry, dtype=object), others)
    if hasattr(source, "geom_type"):
        return of_geometries(np.array([source], dtype=object))
    if isinstance(getattr(source, "__geo_interface__", None), Mapping):
        return of_features(Features.of(source.__geo_interface__))
    if isinstance(source, Iterable) and not isinstance(source, bytes):
        return of_items(list(source))
    raise TypeError(f"source must be a file, GeoJSON, a GeoDataFrame or geometries, got {type(source).__name__}")


def _shapes_of_file(path: Path) -> Shapes:
    path.stat()  # the system's own message says best that there is none
    with naming(path):
        file = _File(path, None if path.suffix.lower() in (*ENDINGS, *PACKED) else "vector")
        if file.kind == "geojson":
            return of_features(Features.of(geojson.parsed(decoded(file.content))))
        frame = read_parquet(file.content) if file.kind == "parquet" else file.frame("give a file with one")
        if not hasattr(frame, "to_crs"):
            raise ValueError("the file is a table without geometries")
        return shapes_of(frame)


@contextmanager
def naming(source: Any) -> Iterator[None]:
    """Begin errors with the name of the file, unless it stands there already."""
    try:
        yield
    except ValueError as error:
        if not isinstance(source, str | os.PathLike) or str(error).startswith(f"{os.fspath(source)}: "):
            raise
        raise ValueError(f"{os.fspath(source)}: {error}") from error


class _File:
    """The source of a table: its format, and its bytes, read on demand."""

    def __init__(self, source: Source, format: Format | None = None, layer: str | None = None) -> None:
        self._source, self._layer = source, layer
        self._path = Path(source) if isinstance(source, str | os.PathLike) else None
        self.kind: Format = as_choice(format or self._found(), (*READERS, "vector"), "format")
        if layer is not None and self.kind != "vector":
            raise ValueError(
                f"{spelled('layer')} is {layer!r}, but a file of the kind {self.kind} has no layers; leave it out"
            )

    def _found(self) -> Format:
        """The format from the extension of the path, ignoring that of compression, else from the first bytes."""
        endings = [ending.lower() for ending in self._path.suffixes[-2:]] if self._path is not None else []
        for ending in (endings[-1:], endings[:1] if endings[-1:] and endings[-1] in PACKED else []):
            if ending and ending[0] in ENDINGS:
                return ENDINGS[ending[0]]
        return ENDINGS[_ending(self.content)]

    @cached_property
    def content(self) -> bytes:
        """The decompressed bytes."""
        return _content(self._source)

    def frame(self, choice: str = "") -> Any:
        """The frame in a file of a GDAL format; by path, as GDAL needs the extension and any companion files."""
        choice = choice or f"say which with {spelled('layer', '=')}"
        if self._path is not None and self._path.suffix.lower() not in PACKED:
            if not self._path.is_dir():  # as some formats are
                self._path.open("rb").close()  # the system's own message says best why it cannot be read
            return read_frame(self._path, layer=self._layer, choice=choice)
        with TemporaryDirectory() as folder:
            within = Path(self._path.stem).suffix if self._path is not None else ""
            named = Path(folder, f"points{within or _ending(self.content)}")
            named.write_bytes(self.content)
            return read_frame(named, layer=self._layer, choice=choice)


def _ending(content: bytes) -> str:
    """The extension that matches these bytes."""
    start = content[:64].lstrip(b"\xef\xbb\xbf \t\r\n")
    found = next((ending for mark, ending in BEGINNINGS.items() if start.startswith(mark)), ".csv")
    if found == ".zip" and b"xl/workbook.xml" in content:
        return ".xlsx"
    if found == ".zip" and b"opendocument.spreadsheet" in content[:100]:
        return ".ods"
    return ".gpx" if found == ".kml" and b"<gpx" in content[:1000] else found


def _content(source: Source) -> bytes:
    content = Path(source).read_bytes() if isinstance(source, str | os.PathLike) else source.read()
    return content.encode() if isinstance(content, str) else unpacked(content)


def _read_csv(content: bytes, asked: Asked) -> PointTable:
    named = [name for name in asked.plane or (asked.lon, asked.lat) if name is not None]
    table = split_columns(decoded(content), named, asked.progress)
    degrees = asked.axes(list(table.columns)) if asked.crs is None and asked.plane is None else ()
    return asked.table(table.typed(degrees=degrees), table.rows)


def _read_geojson(content: bytes, asked: Asked) -> PointTable:
    if asked.plane is not None:
        raise ValueError("columns of a plane are those of tables, not of GeoJSON")
    lon, lat, features = geojson.points(decoded(content), skip_missing=asked.skip_missing)
    return asked.of((lon, lat), features.columns(), crs=features.crs)


def _read_parquet(content: bytes, asked: Asked) -> PointTable:
    table = read_parquet(content)
    if hasattr(table, "geometry"):
        return _of_frame(table, asked)
    return asked.table({name: _of_arrow(table[name]) for name in table.column_names})


def _of_arrow(values: Any) -> Column:
    """An Arrow column as an array; integers with missing values do not become doubles if that would round them."""
    whole = optional("pyarrow", "geo").types.is_integer(values.type)
    with told():
        return column(values.to_pylist()) if whole and values.null_count else _plain(values.to_numpy())


def from_geodataframe(frame: Any) -> PointTable:
    """Points of a GeoDataFrame or GeoSeries.

    Parameters
    ----------
    frame : geopandas.GeoDataFrame or geopandas.GeoSeries
        Rows of points. Those in another coordinate system are transformed to EPSG:4326; without one they are taken as
        longitude and latitude in degrees.

    Returns
    -------
    PointTable
        With the columns that are not geometries, preceded by the index where GeoPandas writes it to files: if it has a
        name or several levels, or is not made of integers.

    Raises
    ------
    ValueError
        If a geometry is missing, empty or not a point, or its latitude is outside [−90, 90].

    Examples
    --------
    >>> import geopandas
    >>> frame = geopandas.GeoDataFrame({"name": ["Ulm"]}, geometry=geopandas.points_from_xy([10.0], [48.4]), crs=4326)
    >>> from_geodataframe(frame).lonlat.tolist()
    [[10.0, 48.4]]
    """
    return _of_frame(frame, Asked())


def _of_frame(frame: Any, asked: Asked) -> PointTable:
    """Points of a frame: from its geometries, or from two columns if it has none or they are those of a plane."""
    if not hasattr(frame, "geometry") or asked.plane is not None:
        if not hasattr(frame, "columns"):
            raise TypeError(f"frame must be a GeoDataFrame or GeoSeries, not {type(frame).__name__}")
        return asked.table(_columns_of(frame))
    shapely = optional("shapely", "geo")
    series = frame.geometry
    if series.crs is not None:
        series = series.to_crs("EPSG:4326")
    geometry = np.asarray(series, dtype=object)
    alone = (shapely.get_type_id(geometry) == MULTIPOINT) & (shapely.get_num_geometries(geometry) == 1)
    geometry = np.where(alone, shapely.get_geometry(geometry, 0), geometry)
    nothing = shapely.is_missing(geometry) | shapely.is_empty(geometry)
    wrong = np.flatnonzero((nothing & (not asked.skip_missing)) | (~nothing & (shapely.get_type_id(geometry) != POINT)))
    if len(wrong):
        first = geometry[wrong[0]]
        kind = "no geometry" if first is None or first.is_empty else first.geom_type
        raise geojson.no_point(wrong[0] + 1, kind)
    return asked.of((shapely.get_x(geometry), shapely.get_y(geometry)), _columns_of(frame))


def _columns_of(frame: Any) -> dict[str, Column]:
    """The columns of a frame that are not geometries, and its index if that is more than row numbers."""
    names = [name for name in getattr(frame, "columns", ()) if frame[name].dtype != "geometry"]
    columns = {str(name): frame[name] for name in names}
    return {
        name: _plain(values.to_numpy()) for name, values in (beside(columns, index_columns(frame)) | columns).items()
    }


def _plain(values: Any) -> Column:
    """Objects of one type as an array of that type."""
    array = np.asarray(values)
    if array.dtype.kind != "O" or not len(array):
        return array
    cells = array.tolist()
    if all(isinstance(cell, str) for cell in cells):
        return texts(cells)
    whole = all(cell is None or type(cell) is int for cell in cells)
    return column(cells) if whole else array


READERS: dict[Format, Callable[[bytes, Asked], PointTable]] = {
    "csv": _read_csv,
    "geojson": _read_geojson,
    "parquet": _read_parquet,
}
