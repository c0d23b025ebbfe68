"""Vector formats of GDAL, through pyogrio: GeoPackage, Shapefile, FlatGeobuf, KML and others."""

from __future__ import annotations

import errno
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from glob import escape
from io import BytesIO
from pathlib import Path
from textwrap import shorten
from typing import Any, Final
from xml.parsers import expat

from stereodel._extras import OnUse, optional
from stereodel._tasks.progress import Progress
from stereodel.io.formats import Content, FileFormat, Wanted, delimited, wkb
from stereodel.io.formats.columns import as_text, check_held, plain
from stereodel.io.formats.foreign import BINARY, SourceFile, check_crs, check_stored, self_contained
from stereodel.io.formats.map_rows import Frame, MapRows, arrow, arrow_column
from stereodel.io.formats.names import RenamedColumnWarning, beside, has_lonlat, listed, note, spelled

pyogrio: Any = OnUse(lambda: optional("pyogrio", "geo"))

RESERVED: Final = {"gpkg": ("fid", "geom"), "fgb": (), "shp": (), "kml": (), "xlsx": ()}  # names of columns
DRIVERS: Final = {"gpkg": "GPKG", "fgb": "FlatGeobuf", "shp": "ESRI Shapefile", "kml": "LIBKML", "xlsx": "XLSX"}

IN_MEMORY: Final = ("kml", "xlsx")  # formats that are written in memory first, as GDAL does not report a full disk
SHEET: Final = {"rows": 1_048_575, "columns": 16_384, "characters of a text": 32_767}  # at most, below the header
SEVERAL: Final = {kind: f"Multi{kind}" for kind in ("Point", "LineString", "Polygon")}  # of several parts
INDEXED: Final = (".gpkg", ".fgb")  # formats with a spatial index, which GDAL writes last or first
LETTERS: Final = 200  # characters of GDAL's messages that an error message repeats
# Words in GDAL's warnings for data that are in the file and that it does not read unchanged.
LOST: Final = re.compile(
    r"truncated|skipp(?:ed|ing)|discard|corrupt|damaged|\blost\b|ignored|cannot be (?:read|parsed)|invalid coord",
    re.IGNORECASE,
)
# Bytes that every `.dbf` has; 4 to 11 are the number of its rows, where they begin, and the length of a row.
HEADER: Final = 32
SHEETS: Final = (".xlsx", ".ods")  # spreadsheets, whose headers GDAL takes for data where all cells are text
GPX_FIELDS: Final = 100  # from so many columns on, GDAL reads no rows of GPX, in silence
LAUNDERED: Final = re.compile(r"field name: '(.*)' to '(.*)'")  # GDAL's warning for a column name that it shortens


def read(file: SourceFile, wanted: Wanted) -> Content:
    """A layer of a file, with or without geometries; the header of a sheet as of text, where GDAL does not find it.

    ValueError if the file is damaged, its format is not read or refers to other files, or the layer does not exist.
    """
    optional("geopandas", "geo")
    with file.on_disk() as path, self_contained(path) as source:
        _check_whole(source)
        frame = in_degrees(_read_frame(source, wanted.layer))
        names = {wanted.lon, wanted.lat, *(wanted.plane or ())} & set(frame.columns)
        if source.suffix not in SHEETS or names or has_lonlat([str(name) for name in frame.columns]):
            return Frame(frame)
        cells = _read_frame(source, wanted.layer, HEADERS="DISABLE")
        text = cells.astype(object).where(cells.notna(), "").astype(str)
        return delimited.tabulated(text.to_numpy().tolist()[wanted.skip_rows :], wanted, above=wanted.skip_rows)


FORMAT = FileFormat(
    (".gpkg", ".shp", ".fgb", ".kml", ".kmz", ".gml", ".gpx", ".zip", ".xlsx", ".ods"),
    {mark: f".{kind}" for mark, kind in BINARY.items()} | {b"<": ".kml"},
    read,
)


def in_degrees(frame: Any) -> Any:
    """A frame of a file in longitude and latitude, where it states something else; ValueError if it is damaged."""
    crs = getattr(frame, "crs", None)
    check_crs(crs)
    with told():
        for name in frame.columns:
            frame[name].to_numpy()  # text is looked at here for the first time, by Arrow
        return frame if crs is None else frame.to_crs("EPSG:4326")


def _read_frame(path: Path, layer: str | None, **options: str) -> Any:
    # Integers with missing values stay integers, which doubles may not represent.
    given = {"use_arrow": True, "arrow_to_pandas_kwargs": {"integer_object_nulls": True}, **options}
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", RuntimeWarning)
        chosen = _chosen(path, layer)
        with told():
            info = pyogrio.read_info(path, layer=chosen)
            if info["driver"] == DRIVERS["fgb"]:  # of damaged ones GDAL makes tables on which Arrow crashes
                pyogrio.read_arrow(path, layer=chosen)[1].validate(full=True)
            frame = pyogrio.read_dataframe(path, layer=chosen, **given)
    if info["driver"] == "GPX" and len(info["fields"]) >= GPX_FIELDS:
        raise ValueError(f"GDAL reads no rows of GPX with {GPX_FIELDS} columns; leave out some extensions")
    if not options and len(frame) < info["features"]:  # -1 where GDAL has to read all to know
        raise ValueError(f"the file is damaged: {len(frame)} of its {info['features']} rows can be read")
    own = [str(each.message) for each in said if issubclass(each.category, RuntimeWarning)]
    for words in dict.fromkeys(shorten(each.replace(str(path), path.name), LETTERS, placeholder=" …") for each in own):
        if LOST.search(words):
            raise ValueError(f"the file cannot be read without loss; GDAL says: {words}")
        note(f"GDAL says of the file: {words}")
    return frame


def _chosen(path: Path, layer: str | None) -> str:
    """The name of the layer to read: of those with geometries, if there are any, the only one that has rows."""
    with told():
        layers = pyogrio.list_layers(path)
    if not len(layers):
        raise ValueError("the file is damaged: there is no layer in it")
    every = [str(name) for name, _ in layers]
    if layer is not None and layer not in every:
        raise ValueError(f"{spelled('layer')} is {layer!r}, which is not one of {listed(every)}")
    names = [layer] if layer else [str(name) for name, kind in layers if kind is not None] or every
    check_stored(path, names)
    if len(names) > 1:  # GPX always has five
        with told():
            counts = [pyogrio.read_info(path, layer=name, force_feature_count=True)["features"] for name in names]
        names = [name for name, count in zip(names, counts, strict=True) if count] or names[:1]
    if len(names) > 1:
        advice = f"give a file with one, or say which with {spelled('layer', '=')}"
        raise ValueError(f"there are several layers, {listed(names)}; {advice}")
    return names[0]


def _check_whole(path: Path) -> None:
    """ValueError for files that GDAL reads in silence as far as they go: XML, and shapefiles that are cut."""
    beside = path.parent.glob(f"{escape(path.stem)}.*") if path.suffix.lower() == ".shp" else [path]
    parts = sorted(path.iterdir() if path.is_dir() else beside)
    for part in [each for each in parts if each == path or each.suffix.lower() in (".shp", ".dbf")]:
        with part.open("rb") as file:
            head = file.read(HEADER)
            file.seek(0)
            if part.stat().st_size < _stated_size(head, part):
                raise ValueError(f"the file is damaged: {part.name} is shorter than its header says")
            if head.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
                try:
                    expat.ParserCreate().ParseFile(file)
                except (expat.ExpatError, LookupError, ValueError) as error:  # the latter two of unknown encodings
                    raise ValueError(f"the file is damaged: {error}") from error


def _stated_size(head: bytes, path: Path) -> int:
    """The least length in bytes of a part of a shapefile by its header; 0 for other files."""
    if BINARY.get(head[:4]) == "shp":
        return 2 * int.from_bytes(head[24:28], "big")  # in words of 16 bits
    if path.suffix.lower() != ".dbf":
        return 0
    rows, start, row = (int.from_bytes(head[a:b], "little") for a, b in ((4, 8), (8, 10), (10, 12)))
    return max(HEADER, start + rows * row)


def write_layer(layer: MapRows, path: Path, *, progress: Progress | None = None) -> None:
    """Write the rows of a map as a file with one layer of its name, in the format given by its extension."""
    kind = path.suffix[1:].lower()
    named = beside([layer.name, *RESERVED[kind]], layer.columns, any_case=True)
    check_held(named, kind)
    whole = replace(layer, columns={name: plain_column(values, kind) for name, values in named.items()})
    kinds = wkb.kinds(layer.binary)
    several = any(found.startswith("Multi") for found in kinds)  # then all need to be, in formats of one kind
    kinds = sorted({SEVERAL.get(found, found) for found in kinds}) if several else kinds
    schema, batches = whole.batches(progress, several=several)
    flat = kind == "xlsx"
    if flat:
        _check_sheet(whole)
        schema, batches = schema.remove(len(named)), (batch.select(list(named)) for batch in batches)
    memory = BytesIO()
    with told(writing=True), warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        pyogrio.write_arrow(
            arrow.RecordBatchReader.from_batches(schema, batches),
            memory if kind in IN_MEMORY else path,
            layer=re.sub(r"[\[\]:*?/\\]", "_", path.stem)[:31] if flat else path.stem,
            driver=DRIVERS[kind],
            geometry_name=None if flat else layer.name,
            geometry_type=None if flat else kinds[0] if len(kinds) == 1 else "Unknown",
            crs=None if layer.crs is None else optional("pyproj", "geo").CRS(layer.crs).to_wkt("WKT1_GDAL"),
            # FlatGeobuf sorts features for its index: in memory that takes two thirds of the time.
            **({"TEMPORARY_DIR": "/vsimem/"} if kind == "fgb" else {}),
        )
        if kind in IN_MEMORY:
            path.write_bytes(memory.getbuffer())
        elif len(layer) and not _is_whole(path, layer):
            raise OSError(errno.EIO, "the file could not be written to its end")
    for warning in said:  # shapefiles shorten names to ten characters; a plane needs no coordinate system
        found = LAUNDERED.search(str(warning.message))
        if found:
            text = f"column {found[1]!r} is written as {found[2]!r}, which is as long as the format allows"
            warnings.warn(text, RenamedColumnWarning, stacklevel=2)


def _check_sheet(layer: MapRows) -> None:
    """A ValueError for a table that is larger than the sheets of workbooks."""
    texts = [values for values in layer.columns.values() if arrow.types.is_string(values.type)]
    longest = max((arrow.compute.max(arrow.compute.utf8_length(values)).as_py() or 0 for values in texts), default=0)
    for (what, most), size in zip(SHEET.items(), (len(layer), len(layer.columns), longest), strict=True):
        if size > most:
            raise ValueError(f"there are {size} {what}, but .xlsx holds {most}; choose another format")


def _is_whole(path: Path, layer: MapRows) -> bool:
    """Whether all of a layer, and its index, can be read back: on a full disk GDAL may end in silence."""
    rows = geometries = 0
    try:
        if path.suffix in INDEXED and not pyogrio.read_info(path)["capabilities"]["fast_spatial_filter"]:
            return False
        with pyogrio.open_arrow(path, use_pyarrow=True) as (found, batches):
            fields = len(found["fields"])
            for batch in batches:
                rows += batch.num_rows
                geometries += batch.num_rows - batch.column(batch.num_columns - 1).null_count
    except (IndexError, OSError, RuntimeError):  # not even a header, a cut row, no layer
        return False
    there = int(wkb.is_there(layer.binary).sum())
    return rows == len(layer) and geometries == there and fields >= len(layer.columns)


def plain_column(values: Any, kind: str) -> Any:
    """An Arrow column of a type that GDAL supports in a format; lists and mappings become text, as JSON."""
    column = arrow_column(values)
    if arrow.types.is_dictionary(column.type):
        column = column.dictionary_decode()
    types, xlsx = arrow.types, kind == "xlsx"
    odd = types.is_nested(column.type) or types.is_duration(column.type) or hasattr(column.type, "extension_name")
    if odd or (xlsx and types.is_timestamp(column.type) and column.type.tz):
        return arrow.array([as_text(plain(cell)) for cell in column.to_pylist()], arrow.string())
    doubles = xlsx or kind == "shp"  # a shapefile's numbers of 19 digits are doubles, and all of a workbook
    if types.is_uint64(column.type) or (doubles and types.is_int64(column.type)):
        ends = arrow.compute.min_max(column).as_py().values()
        bound = 2**53 if doubles else 2**63
        fits = all(end is None or -bound <= end < bound for end in ends)
        return column.cast(arrow.int64() if fits else arrow.string())
    if xlsx and types.is_floating(column.type):  # which knows no infinity
        column = column.cast(arrow.float64())
        return arrow.compute.if_else(arrow.compute.is_finite(column), column, None)
    if kind == "kml" and types.is_float32(column.type):
        return column.cast(arrow.float64())  # GDAL writes too few digits of a float
    return column.cast(arrow.float32()) if types.is_float16(column.type) else column


@contextmanager
def told(*, writing: bool = False) -> Iterator[None]:
    """Raise what a library says of a file as ValueError, or OSError when writing, in one line and without inner names.

    Damaged files bring out exceptions of any type, those of Arrow, PROJ and GEOS among them.
    """
    try:
        yield
    except (ImportError, MemoryError):
        raise
    except Exception as error:
        if (writing and not isinstance(error, RuntimeError)) or getattr(error, "errno", None) is not None:
            raise
        said = re.sub(r"; It might help to specify.*", "", str(error), flags=re.DOTALL)
        said = shorten(said, LETTERS, placeholder=" …") or type(error).__name__
        if writing:
            raise OSError(errno.EIO, f"the file cannot be written: {said}") from error
        raise ValueError(f"the file cannot be read: {said}") from error
