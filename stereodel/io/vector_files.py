"""Vector formats of GDAL, through pyogrio: GeoPackage, Shapefile, FlatGeobuf, KML and others."""

from __future__ import annotations

import errno
import os
import re
import sqlite3
import warnings
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from textwrap import shorten
from typing import Any, Final

from stereodel._extras import optional
from stereodel.io.columns import RenamedColumnWarning, beside, listed
from stereodel.io.layers import Layer, Progress, arrow_column

RESERVED: Final = {"gpkg": ("fid", "geom"), "fgb": (), "shp": (), "kml": ()}
"""Column names that a format reserves."""

DRIVERS: Final = {"gpkg": "GPKG", "fgb": "FlatGeobuf", "shp": "ESRI Shapefile", "kml": "LIBKML"}

SEVERAL: Final = {kind: f"Multi{kind}" for kind in ("Point", "LineString", "Polygon")}
"""The multi-part kind of each single-part kind of geometry."""

FGB_MAGIC: Final = b"fgb\x03fgb\x01"
FGB_NODE: Final = 40
"""Bytes of a node of the index: a box of four doubles and a place among the features."""
FGB_CHILDREN: Final = 16
"""Children of a node of the index, as GDAL writes it."""

OPTIONS: Final = {"fgb": {"TEMPORARY_DIR": "/vsimem/"}}
"""Options of GDAL by format. FlatGeobuf sorts features for its index: in memory that takes two thirds of the time."""

LETTERS: Final = 200
"""Characters of GDAL's messages that an error message repeats."""

LAUNDERED: Final = re.compile(r"field name: '(.*)' to '(.*)'")
"""GDAL's warning for a column name that it shortens."""


def read_frame(source: str | os.PathLike[str] | bytes, *, layer: str | None = None) -> Any:
    """A layer of a file, or of its bytes, as a GeoDataFrame; `layer` selects one of several.

    Raises
    ------
    ValueError
        If the file is damaged or its format unknown to GDAL, `layer` does not exist, or it is not given and there are
        several.
    """
    pyogrio = optional("pyogrio", "geo")
    optional("geopandas", "geo")
    with told(), warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # GDAL's guesses, in its own words
        layers = pyogrio.list_layers(source)
        if not len(layers):
            raise ValueError("the file is damaged: there is no layer in it")
        names = [name for name, kind in layers if kind is not None]
        if layer is not None and layer not in names:
            raise ValueError(f"layer is {layer!r}, which is not one of {listed(names)}")
        if layer is None and len(names) > 1:
            raise ValueError(f"there are several layers, {listed(names)}; say which with layer=")
        # Integers with missing values stay integers, which doubles may not represent.
        objects = {"integer_object_nulls": True}
        return pyogrio.read_dataframe(source, layer=layer, use_arrow=True, arrow_to_pandas_kwargs=objects)


def write_layer(layer: Layer, path: Path, *, name: str, progress: Progress | None = None) -> None:
    """Write the rows of a map as a file with one named layer, in the format given by the extension of `path`."""
    pyogrio, arrow = optional("pyogrio", "geo"), optional("pyarrow", "geo")
    kind = path.suffix[1:].lower()
    named = beside([layer.name, *RESERVED[kind]], layer.columns, any_case=True)
    whole = replace(layer, columns={name: plain_column(values) for name, values in named.items()})
    kinds = sorted({SEVERAL.get(found, found) for found in layer.kinds}) if layer.has_several else layer.kinds
    schema, batches = whole.batches(progress, several=layer.has_several)
    memory = BytesIO()
    with told(writing=True), warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        pyogrio.write_arrow(
            arrow.RecordBatchReader.from_batches(schema, batches),
            memory if kind == "kml" else path,
            layer=name,
            driver=DRIVERS[kind],
            geometry_name=layer.name,
            geometry_type=kinds[0] if len(kinds) == 1 else "Unknown",
            crs=None if layer.crs is None else optional("pyproj", "geo").CRS(layer.crs).to_wkt("WKT1_GDAL"),
            **OPTIONS.get(kind, {}),
        )
        if kind == "kml":  # in memory first: GDAL does not report a full disk
            path.write_bytes(memory.getbuffer())
        if len(layer) and kind in WHOLE and not WHOLE[kind](path):
            raise OSError(errno.EIO, "the file could not be written to its end")
    for warning in said:  # shapefiles shorten names to ten characters; a plane needs no coordinate system
        found = LAUNDERED.search(str(warning.message))
        if found:
            text = f"column {found[1]!r} is written as {found[2]!r}, which is as long as the format allows"
            warnings.warn(text, RenamedColumnWarning, stacklevel=2)


def _whole_shapefile(path: Path) -> bool:
    """Whether the files of a shapefile have the lengths in their headers, two of which count 16-bit words."""
    heads = {}
    for part in (path, path.with_suffix(".shx"), path.with_suffix(".dbf")):
        with part.open("rb") as file:
            heads[part] = file.read(28)
    *shapes, table = heads
    rows, begin, width = (int.from_bytes(heads[table][a:b], "little") for a, b in ((4, 8), (8, 10), (10, 12)))
    return len(heads[table]) == 28 <= begin + rows * width <= table.stat().st_size and all(
        part.stat().st_size == 2 * int.from_bytes(heads[part][24:28], "big") for part in shapes
    )


def _whole_geopackage(path: Path) -> bool:
    """Whether a GeoPackage has its spatial index, which is written last."""
    with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as base:
        found = base.execute("SELECT COUNT(*) FROM gpkg_extensions WHERE extension_name = 'gpkg_rtree_index'")
        return bool(found.fetchone()[0])


def _whole_flatgeobuf(path: Path) -> bool:
    """Whether a FlatGeobuf file ends with its last feature, whose place is in the last leaf of its index."""
    pyogrio = optional("pyogrio", "geo")
    try:
        level = nodes = pyogrio.read_info(path, force_feature_count=True)["features"]
    except (IndexError, RuntimeError):  # not even a header
        return False
    if level == 0:
        return True
    while True:  # at least one level above the leaves
        level = -(-level // FGB_CHILDREN)
        nodes += level
        if level == 1:
            break
    with path.open("rb") as file:
        file.seek(len(FGB_MAGIC))
        index = file.tell() + 4 + int.from_bytes(file.read(4), "little")
        file.seek(index + FGB_NODE * nodes - 8)
        last = index + FGB_NODE * nodes + int.from_bytes(file.read(8), "little")
        file.seek(last)
        size = int.from_bytes(file.read(4), "little")
    return size > 0 and path.stat().st_size == last + 4 + size


WHOLE: Final = {"shp": _whole_shapefile, "gpkg": _whole_geopackage, "fgb": _whole_flatgeobuf}
"""Formats that GDAL may leave unfinished on a full disk without reporting it, and whether a file is finished."""


def plain_column(values: Any) -> Any:
    """An Arrow column of a type that GDAL supports."""
    arrow = optional("pyarrow", "geo")
    column = arrow_column(values)
    if arrow.types.is_dictionary(column.type):
        column = column.dictionary_decode()
    if arrow.types.is_uint64(column.type):
        largest = arrow.compute.max(column).as_py()
        return column.cast(arrow.int64() if largest is None or largest < 2**63 else arrow.string())
    if arrow.types.is_duration(column.type):
        return arrow.array([None if cell is None else str(cell) for cell in column.to_pylist()], arrow.string())
    return column.cast(arrow.float32()) if arrow.types.is_float16(column.type) else column


@contextmanager
def told(*, writing: bool = False) -> Iterator[None]:
    """Raise GDAL's errors as ValueError or OSError, without the internal file names."""
    try:
        yield
    except RuntimeError as error:  # the only common base class of pyogrio's errors
        said = re.sub(r"; It might help to specify.*", "", str(error), flags=re.DOTALL)
        said = shorten(said, LETTERS, placeholder=" …")
        if writing:
            raise OSError(errno.EIO, f"the file cannot be written: {said}") from error
        raise ValueError(f"the file cannot be read: {said}") from error
