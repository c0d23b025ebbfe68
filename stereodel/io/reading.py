"""Reading tables of points: what a file is, and the readers that need libraries."""

from __future__ import annotations

import gzip
import io
import json
import os
import zlib
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, BinaryIO, Literal, TextIO

import numpy as np

from stereodel._arrays import Column, FloatArray, Indices, as_choice
from stereodel._extras import optional
from stereodel.io.columns import find_lonlat, listed
from stereodel.io.csv_text import read_csv, split_columns, typed
from stereodel.io.shapes import POINT
from stereodel.io.tables import PointTable, numbers, table_of

Source = str | os.PathLike[str] | BinaryIO | TextIO
Format = Literal["csv", "geojson", "parquet", "gpkg"]
ENDINGS: dict[str, Format] = {
    ".csv": "csv",
    ".tsv": "csv",
    ".txt": "csv",
    ".geojson": "geojson",
    ".json": "geojson",
    ".parquet": "parquet",
    ".geoparquet": "parquet",
    ".gpkg": "gpkg",
}


def read_points(
    source: Source,
    *,
    lon: str | None = None,
    lat: str | None = None,
    format: Format | None = None,
) -> PointTable:
    r"""Read a table of points with longitude and latitude.

    Parameters
    ----------
    source : path-like or stream
        A file, or an open one, of text or bytes.
    lon, lat : str, optional
        Names of the columns in degrees. By default the one whose name is or has in it one of the words lon, lng, long,
        longitude and lat, latitude, else x and y, in any case. Files with geometries need none.
    format : {"csv", "geojson", "parquet", "gpkg"}, optional
        By default what the ending of the path says, else what the first bytes are.

    Returns
    -------
    PointTable
        The points and all other columns, in the order of the source.

    Raises
    ------
    ValueError
        For a wrong row, naming its number (the first row of data is 1): a missing value, one that is not a number, a
        latitude outside [−90, 90]; where no column or several look like longitude or latitude, listing the columns;
        for geometries other than points.
    ImportError
        For Parquet and GeoPackage without their libraries (``pip install stereodel[geo]``). CSV and GeoJSON need none.
    OSError
        Where the file cannot be read.

    Notes
    -----
    Text is UTF-8, or UTF-16 with its mark, compressed by gzip or not. CSV: commas, semicolons, tabs, bars or blanks; a
    decimal comma beside another separator; a line of names unless the first line has numbers. Columns become numbers
    where all their values are, but not where digits follow a leading zero. Geometries in another coordinate system are
    transformed to EPSG:4326; those without any are taken for longitude and latitude in degrees.

    Examples
    --------
    >>> import io
    >>> text = "name;Longitude;Latitude;people\nQuito;-78,5;-0,2;1763000\nUlm;10,0;48,4;129000"
    >>> table = read_points(io.StringIO(text))
    >>> table.lonlat.tolist(), table.columns["people"].tolist()
    ([[-78.5, -0.2], [10.0, 48.4]], [1763000, 129000])
    >>> read_points(io.StringIO("lon,lat\n5,7\n7,95.2"))
    Traceback (most recent call last):
        ...
    ValueError: row 2: latitude 95.2 is outside [-90, 90]; is it the longitude, or not in degrees?
    """
    content = _content(source)
    kind = _kind(source, content)
    return READERS[as_choice(format or kind, tuple(READERS), "format")](content, lon, lat)


def read_plane_points(source: Source, x: str, y: str) -> tuple[FloatArray, dict[str, Column], Indices]:
    r"""Points of a plane by the names of two columns of a CSV or Parquet table: (n, 2), other columns, row numbers.

    Raises
    ------
    ValueError
        For other files, columns that are not there, and rows without finite numbers, by number.

    Examples
    --------
    >>> import io
    >>> text = "site,east,north\nA,3500,5400\nB,3600,5410"
    >>> points, others, rows = read_plane_points(io.StringIO(text), "east", "north")
    >>> points.tolist(), others["site"].tolist()
    ([[3500.0, 5400.0], [3600.0, 5410.0]], ['A', 'B'])
    """
    content = _content(source)
    kind = _kind(source, content)
    if kind == "csv":
        table, rows = split_columns(_text(content))
    elif kind == "parquet":
        read = optional("pyarrow.parquet", "geo").read_table(io.BytesIO(content))
        table = {name: read[name].to_numpy() for name in read.column_names if name != "geometry"}
        rows = np.arange(1, read.num_rows + 1)
    else:
        raise ValueError(f"columns of coordinates are those of CSV and Parquet, not of {kind}")
    missing = [name for name in (x, y) if name not in table]
    if missing:
        raise ValueError(f"there is no column {missing[0]!r}; the columns are {listed(list(table))}")
    places = np.column_stack([numbers(table[name], name, rows) for name in (x, y)])
    others = {name: typed(values) if kind == "csv" else _plain(values) for name, values in table.items()}
    return places, {name: values for name, values in others.items() if name not in (x, y)}, rows


def _kind(source: Source, content: bytes) -> Format:
    """By the ending of a path, else by the first bytes."""
    ending = Path(source).suffix.lower() if isinstance(source, str | os.PathLike) else ""
    return ENDINGS.get(ending) or _by_content(content)


def _content(source: Source) -> bytes:
    content = Path(source).read_bytes() if isinstance(source, str | os.PathLike) else source.read()
    if isinstance(content, str):
        return content.encode()
    if not content.startswith(b"\x1f\x8b"):
        return content
    try:
        return gzip.decompress(content)
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        raise ValueError(f"the compressed file is damaged: {error}") from error


def _by_content(content: bytes) -> Format:
    if content.startswith(b"PAR1"):
        return "parquet"
    if content.startswith(b"SQLite format 3"):
        return "gpkg"
    return "geojson" if content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{") else "csv"


def _text(content: bytes) -> str:
    marked = content.startswith((b"\xff\xfe", b"\xfe\xff"))
    try:
        return content.decode("utf-16" if marked else "utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise ValueError(f"line {line} is not text in UTF-8; save the file in that encoding") from error


def _read_csv(content: bytes, lon: str | None, lat: str | None) -> PointTable:
    return read_csv(_text(content), lon=lon, lat=lat)


def _read_geojson(content: bytes, lon: str | None, lat: str | None) -> PointTable:
    try:
        collection = json.loads(_text(content))
    except json.JSONDecodeError as error:
        raise ValueError(f"the file is not JSON: {error}") from error
    features = collection.get("features") if isinstance(collection, dict) else None
    if not isinstance(features, list):
        raise ValueError("the file is not a GeoJSON FeatureCollection of points")
    for row, feature in enumerate(features, 1):
        if not isinstance(feature, dict) or not isinstance(feature.get("properties") or {}, dict):
            raise ValueError(f"row {row}: is not a GeoJSON Feature with properties by name; see RFC 7946")
    rows = np.arange(1, len(features) + 1)
    places = [_position(feature.get("geometry"), row) for row, feature in enumerate(features, 1)]
    names = dict.fromkeys(name for feature in features for name in feature.get("properties") or {})
    columns = {name: _property(features, name) for name in names}
    return table_of(np.array([p[0] for p in places]), np.array([p[1] for p in places]), columns, rows)


def _position(geometry: Any, row: int) -> tuple[float, float]:
    if not isinstance(geometry, dict) or geometry.get("type") != "Point":
        kind = geometry.get("type") if isinstance(geometry, dict) else "no geometry"
        raise ValueError(f"row {row}: a Point is needed, not {kind}; take e.g. centroids first")
    coordinates = geometry.get("coordinates") or (np.nan, np.nan)
    if not isinstance(coordinates, list | tuple) or len(coordinates) < 2:
        raise ValueError(f"row {row}: a Point has two or three coordinates, not {coordinates!r}")
    return coordinates[0], coordinates[1]


def _property(features: list[dict[str, Any]], name: str) -> Column:
    """A column of properties: numbers where all are, text where all are, else objects."""
    values = [(feature.get("properties") or {}).get(name) for feature in features]
    if all(isinstance(value, int | float) or value is None for value in values) and not all(v is None for v in values):
        whole = all(isinstance(value, int) for value in values)
        return np.array([np.nan if value is None else value for value in values], dtype=None if whole else np.float64)
    if all(isinstance(value, str) for value in values):
        return np.array(values, dtype=np.str_)
    array = np.empty(len(values), dtype=object)
    array[:] = values
    return array


def _read_parquet(content: bytes, lon: str | None, lat: str | None) -> PointTable:
    table = optional("pyarrow.parquet", "geo").read_table(io.BytesIO(content))
    if b"geo" in (table.schema.metadata or {}):
        return from_geodataframe(optional("geopandas", "geo").read_parquet(io.BytesIO(content)))
    where = find_lonlat(table.column_names, lon, lat)
    columns = {name: table[name].to_numpy() for name in table.column_names}
    others = {name: _plain(values) for name, values in columns.items() if name not in where}
    return table_of(columns[where[0]], columns[where[1]], others, np.arange(1, table.num_rows + 1))


def _read_gpkg(content: bytes, lon: str | None, lat: str | None) -> PointTable:
    with TemporaryDirectory() as folder:  # a database is read in place, and named after its format
        path = Path(folder, "points.gpkg")
        path.write_bytes(content)
        return from_geodataframe(optional("geopandas", "geo").read_file(path))


def from_geodataframe(frame: Any) -> PointTable:
    """Points of a GeoDataFrame or GeoSeries.

    Parameters
    ----------
    frame : geopandas.GeoDataFrame or geopandas.GeoSeries
        Of points. In another coordinate system they are transformed to EPSG:4326; without any they are taken for
        longitude and latitude in degrees.

    Returns
    -------
    PointTable
        With the columns that are no geometries.

    Raises
    ------
    ValueError
        For a row whose geometry is missing, empty or no point, or lies outside [−90, 90] in latitude.

    Examples
    --------
    >>> import geopandas
    >>> frame = geopandas.GeoDataFrame({"name": ["Ulm"]}, geometry=geopandas.points_from_xy([10.0], [48.4]), crs=4326)
    >>> from_geodataframe(frame).lonlat.tolist()
    [[10.0, 48.4]]
    """
    shapely = optional("shapely", "geo")
    series = frame.geometry
    if series.crs is not None:
        series = series.to_crs("EPSG:4326")
    geometry, rows = np.asarray(series), np.arange(1, len(series) + 1)
    wrong = np.flatnonzero(
        shapely.is_missing(geometry) | shapely.is_empty(geometry) | (shapely.get_type_id(geometry) != POINT)
    )
    if len(wrong):
        kind = (
            "no geometry"
            if geometry[wrong[0]] is None
            else f"an empty or other geometry ({geometry[wrong[0]].geom_type})"
        )
        raise ValueError(f"row {rows[wrong[0]]}: a Point is needed, not {kind}; take e.g. centroids first")
    names = [name for name in getattr(frame, "columns", ()) if frame[name].dtype != "geometry"]
    columns = {str(name): _plain(frame[name].to_numpy()) for name in names}
    return table_of(shapely.get_x(geometry), shapely.get_y(geometry), columns, rows)


def _plain(values: Any) -> Column:
    """Text as an array of text rather than of objects."""
    array = np.asarray(values)
    if array.dtype.kind == "O" and len(array) and all(isinstance(value, str) for value in array.tolist()):
        return array.astype(np.str_)
    return array


READERS: dict[str, Callable[[bytes, str | None, str | None], PointTable]] = {
    "csv": _read_csv,
    "geojson": _read_geojson,
    "parquet": _read_parquet,
    "gpkg": _read_gpkg,
}
