"""Layers of maps: rows with columns and one geometry each, kept as well-known binary until more is needed.

Well-known binary takes a third of the memory of geometry objects. GDAL's formats and GeoParquet store it, and Arrow
passes it on as it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from stereodel._arrays import BoolArray, Column, Geometries, Indices, Packed
from stereodel._extras import OnUse, optional
from stereodel._tasks.progress import Progress
from stereodel.io.formats import Content, wkb
from stereodel.io.formats.columns import as_text, column, of_objects, plain_cells
from stereodel.io.formats.names import NoPointError, beside, check_different, index_columns, left_out

shapely: Any = OnUse(lambda: optional("shapely", "geo"))
arrow: Any = OnUse(lambda: optional("pyarrow", "geo"))

ROWS: Final = 65_536  # rows in a block


def packed(geometries: Geometries) -> Packed:
    """Shapely's geometries as well-known binary; None for empty ones."""
    binary: Packed = np.asarray(shapely.to_wkb(geometries, byte_order=1, flavor="iso"), dtype=object)
    binary[shapely.is_empty(geometries)] = None
    return binary


def unpacked(binary: Packed, empty: Any = None) -> Geometries:
    """Well-known binary as Shapely's geometries; `empty` where there is none."""
    geometries: Geometries = np.asarray(shapely.from_wkb(binary), dtype=object)
    geometries[~wkb.is_there(binary)] = empty
    return geometries


@dataclass(frozen=True, eq=False)
class MapRows:
    """Rows of a map.

    columns: arrays of NumPy, pandas or Arrow, by name.
    binary: geometries as well-known binary, (n,); None where a row has none.
    crs: coordinate reference system in any form that pyproj accepts; None if unknown.
    name: name of the geometry column.
    """

    columns: Mapping[str, Any]
    binary: Packed
    crs: Any = None
    name: str = "geometry"

    @classmethod
    def of_frame(cls, frame: Any) -> MapRows:
        """The rows of a GeoDataFrame or GeoSeries; geometry columns that are not active become well-known text."""
        active = frame.geometry.name or "geometry"
        own = {name: frame[name].reset_index(drop=True) for name in getattr(frame, "columns", ()) if name != active}
        columns = {
            str(name): shapely.to_wkt(np.asarray(values)) if values.dtype == "geometry" else values
            for name, values in own.items()
        }
        columns = beside([*columns, str(active)], index_columns(frame)) | columns
        return cls(columns, packed(np.asarray(frame.geometry, dtype=object)), frame.crs, str(active))

    def __len__(self) -> int:
        return len(self.binary)

    def take(self, rows: Indices | BoolArray | slice) -> MapRows:
        """Some of the rows."""
        columns = {name: getattr(values, "iloc", values)[rows] for name, values in self.columns.items()}
        return MapRows(columns, self.binary[rows], self.crs, self.name)

    def blocks(self, progress: Progress | None = None) -> Iterator[MapRows]:
        """The rows in blocks of `ROWS`."""
        for begin in range(0, len(self), ROWS):
            yield self.take(slice(begin, begin + ROWS))
            if progress is not None:
                progress("writing", min(begin + ROWS, len(self)), len(self))

    def frame(self) -> Any:
        """The rows as a GeoDataFrame."""
        cells = {**self.columns, self.name: unpacked(self.binary)}
        return optional("geopandas", "geo").GeoDataFrame(cells, geometry=self.name, crs=self.crs)

    def batches(self, progress: Progress | None = None, *, several: bool = False) -> tuple[Any, Iterator[Any]]:
        """Schema and Arrow record batches of the rows, with the geometries as binary in the last column.

        With `several`, single-part geometries are written as multi-part ones, block by block.
        """
        whole = replace(self, columns={name: arrow_column(values) for name, values in self.columns.items()})
        fields = [arrow.field(name, values.type) for name, values in whole.columns.items()]
        known = {"ARROW:extension:name": "geoarrow.wkb", "ARROW:extension:metadata": "{}"}
        schema = arrow.schema([*fields, arrow.field(self.name, arrow.binary(), metadata=known)])

        def batch(block: MapRows) -> Any:
            cells = arrow.array(wkb.several(block.binary) if several else block.binary, arrow.binary())
            return arrow.record_batch([*block.columns.values(), cells], schema=schema)

        return schema, map(batch, whole.blocks(progress))


def arrow_column(values: Any) -> Any:
    """The column as an Arrow array; values without an Arrow type, such as integers of any size, become text."""
    if isinstance(values, np.ndarray) and values.dtype.char in "Ug":  # fixed-width text would end at its first zero
        values = values.astype(object if values.dtype.kind == "U" else np.float64)
    try:
        column = arrow.array(values, from_pandas=True)
    except (arrow.ArrowInvalid, arrow.ArrowTypeError, arrow.ArrowNotImplementedError, OverflowError):
        column = arrow.array([as_text(cell) for cell in plain_cells(values)], arrow.string())
    if isinstance(column, arrow.ChunkedArray):
        column = column.combine_chunks()
    return column.cast(arrow.string()) if arrow.types.is_null(column.type) else column


def of_arrow(values: Any) -> Column:
    """An Arrow column as an array; integers with missing values do not become doubles if that would round them."""
    kind, types = values.type, arrow.types
    whole, zoned = types.is_integer(kind) and values.null_count, types.is_timestamp(kind) and kind.tz
    if whole or zoned or types.is_dictionary(kind):  # whose missing values would be the first of the others
        return column(values.to_pylist())
    return of_objects(values.to_pandas() if hasattr(kind, "extension_name") else values.to_numpy())


def is_frame(source: Any) -> bool:
    """Whether something is a frame, of pandas, polars, Arrow, DuckDB or any other library that speaks Arrow."""
    speaks = hasattr(source, "__arrow_c_stream__") or hasattr(source, "collect")
    return hasattr(source, "to_crs") or (speaks and not hasattr(source, "to_frame"))  # which a single column has


def columns_of(given: Any) -> Mapping[str, Any]:
    """The columns of a mapping or a frame."""
    if not is_frame(given) and not isinstance(given, Mapping):
        raise TypeError(f"columns must be a mapping or a frame, not {type(given).__name__}")
    return content_of(given).columns() if is_frame(given) else given


def content_of(frame: Any) -> Content:
    """The rows of a frame, a lazy one collected, with places if it has geometries; ImportError without PyArrow."""
    if hasattr(frame, "to_crs"):
        return Frame(frame)
    index = index_columns(frame) if hasattr(getattr(frame, "index", None), "nlevels") else {}
    try:
        table = arrow.table(frame.collect() if hasattr(frame, "collect") else frame)
        kinds = [(field.metadata or {}).get(b"ARROW:extension:name", b"") for field in table.schema]
        if any(kind.startswith(b"geoarrow") for kind in kinds):
            return Frame(optional("geopandas", "geo").GeoDataFrame.from_arrow(table))
        found = {name: of_arrow(table[name]) for name in table.column_names if not name.startswith("__index_level_")}
    except (arrow.ArrowException, KeyError, TypeError) as error:  # of values of several types, say, as pandas may have
        if hasattr(frame, "index") and hasattr(frame, "columns"):
            return Frame(frame)
        raise ValueError(f"the frame cannot be read, {error}; give its columns other types or names") from error
    more = {name: of_objects(np.asarray(each)) for name, each in index.items() if name not in table.column_names}
    return Content(more | found)


class Frame(Content):
    """Rows of a frame of pandas or GeoPandas, with or without geometries."""

    def __init__(self, frame: Any) -> None:
        super().__init__({})
        self.frame = frame

    def columns(self) -> dict[str, Column]:
        """The columns that are not geometries, and the index if that is more than row numbers."""
        names = getattr(self.frame, "columns", ())
        check_different(map(str, names))
        columns = {str(name): self.frame[name] for name in names if self.frame[name].dtype != "geometry"}
        every = beside(columns, index_columns(self.frame)) | columns
        return {name: of_objects(values.to_numpy()) for name, values in every.items()}

    def places(self, *, skip_missing: bool) -> tuple[Column, Column] | None:
        """Both coordinates in degrees of rows that are points, NaN where one is missing."""
        if not hasattr(self.frame, "geometry"):
            return None
        series = self.frame.geometry
        geometry = np.asarray(series if series.crs is None else series.to_crs("EPSG:4326"), dtype=object)
        of = shapely.GeometryType
        alone = (shapely.get_type_id(geometry) == of.MULTIPOINT) & (shapely.get_num_geometries(geometry) == 1)
        geometry = np.where(alone, shapely.get_geometry(geometry, 0), geometry)
        nothing = shapely.is_missing(geometry) | shapely.is_empty(geometry)
        other = shapely.get_type_id(geometry) != of.POINT
        wrong = np.flatnonzero((nothing & (not skip_missing)) | (~nothing & other))
        if len(wrong):
            first = geometry[wrong[0]]
            raise no_point(wrong[0] + 1, "no geometry" if first is None or first.is_empty else first.geom_type)
        return shapely.get_x(geometry), shapely.get_y(geometry)


def no_point(row: Any, kind: Any) -> ValueError:
    """The error for a row with another geometry than a point, or with "no geometry"."""
    if kind == "no geometry":
        return ValueError(f"row {row}: a Point is needed, not {kind}; {left_out()}")
    return NoPointError(f"row {row}: a Point is needed, not {kind}; take e.g. centroids first")
