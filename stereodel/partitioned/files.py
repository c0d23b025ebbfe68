"""Files of points: which are meant, in the order that numbers their rows; which columns are places; reading them."""

from __future__ import annotations

import glob
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Literal

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import optional
from stereodel.io.formats import wkb
from stereodel.io.formats.names import anew, find_lonlat, has_lonlat, listed, naming, spelled
from stereodel.io.table import degrees, numbers
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude

Surface = Literal["sphere", "plane"]
SURFACES: Final[tuple[Surface, ...]] = ("sphere", "plane")

Form = Literal["lonlat", "xyz", "xy", "wkb", "point"]
"""Columns of degrees, of a direction, of the plane; one of geometries, in binary or as pairs of numbers."""

FilesGiven = str | os.PathLike[str] | Sequence[str | os.PathLike[str]]
"""What names files of points: a file, a folder, a pattern with *, ? or [, or a list of files."""

ENDINGS: Final = (".parquet", ".geoparquet", ".pq")
"""Of files in a folder that are read; others, and those that begin with _ or ., are not."""


@dataclass(frozen=True)
class PointColumns:
    """Which columns say where a row's point is."""

    form: Form
    names: tuple[str, ...]  # two, three, or one of geometries
    surface: Surface
    latitude: Latitude  # as in `lonlat_to_xyz`
    crs: str | None = None  # of geometries that are not in degrees, in any form that PROJ accepts; sphere only

    @property
    def width(self) -> int:
        """Coordinates of a point: three on the sphere, two in the plane."""
        return 3 if self.surface == "sphere" else 2

    @property
    def axes(self) -> Sequence[str]:
        """Names of the coordinates in messages."""
        if self.surface == "sphere" and self.form != "xyz":
            return ("longitude", "latitude") if self.crs is None else ("easting", "northing")
        return self.names if len(self.names) > 1 else ("x", "y")

    def points(self, table: Any, rows: Sequence[int]) -> FloatArray:
        """Points of a table of Arrow, as unit vectors, directions or of the plane; messages have numbers of `rows`."""
        columns = {name: table[name] for name in self.names}
        if self.form in ("wkb", "point"):
            columns = coordinates_of(self.form, self.names[0], table[self.names[0]], rows)
        named = zip(columns.items(), self.axes, strict=True)
        places = np.column_stack([doubles_of(column, name, rows, axis=axis) for (name, column), axis in named])
        if self.surface == "sphere" and self.form != "xyz":
            return lonlat_to_xyz(degrees(places, self.crs, rows), latitude=self.latitude, workers=1)
        zero = np.flatnonzero(~places.any(axis=1))
        if len(zero) and self.surface == "sphere":
            raise ValueError(f"row {rows[zero[0]]}: is the zero vector, which has no direction")
        return places


def find_columns(schema: Any, names: tuple[str, ...] | None, surface: Surface, latitude: Latitude) -> PointColumns:
    """Which columns of a file are places: those that the caller names, else what the file says, else by their names."""
    there = list(schema.names)
    text = (schema.metadata or {}).get(b"geo")
    geo = json.loads(text) if text else {"columns": {}}
    chosen = names or ((geo["primary_column"],) if text else _guessed(there, surface))
    missing = [name for name in chosen if name not in there]
    if missing:
        raise ValueError(f"{spelled('columns')} has {missing[0]!r}, which is not one of the columns {listed(there)}")
    if len(chosen) == 1 and chosen[0] in geo["columns"]:
        return _of_geometries(geo["columns"][chosen[0]], chosen[0], surface, latitude)
    forms: dict[tuple[Surface, int], Form] = {("sphere", 2): "lonlat", ("sphere", 3): "xyz", ("plane", 2): "xy"}
    if (surface, len(chosen)) not in forms:
        wanted = "(longitude, latitude) or (x, y, z)" if surface == "sphere" else "(x, y)"
        raise ValueError(f"columns has {len(chosen)} names, but on the {surface} a place has {wanted}")
    return PointColumns(forms[surface, len(chosen)], chosen, surface, latitude)


def _guessed(names: Sequence[str], surface: Surface) -> tuple[str, ...]:
    lower = {name.strip().lower(): name for name in names}
    xyz = [lower[axis] for axis in "xyz" if axis in lower]
    if surface == "plane":
        if not {"x", "y"} <= lower.keys():
            raise ValueError(f"no columns are named x and y; name two with columns=, the columns are {listed(names)}")
        return lower["x"], lower["y"]
    others = [name for name in names if name not in xyz]
    if len(xyz) == 3 and not has_lonlat(others):
        return tuple(xyz)
    return find_lonlat(others if len(xyz) == 3 else names)


def _of_geometries(column: Mapping[str, Any], name: str, surface: Surface, latitude: Latitude) -> PointColumns:
    """A column of geometries that GeoParquet describes; its default coordinate system is OGC:CRS84."""
    encoding = str(column.get("encoding", "WKB")).lower()
    form: Form = "point" if encoding == "point" else "wkb"
    if encoding != form:
        raise ValueError(f"the geometries {name!r} are {encoding}, but points are needed; take e.g. centroids")
    crs = column.get("crs") if surface == "sphere" else None
    known = crs.get("id", {}) if crs else {}
    in_degrees = crs is None or f"{known.get('authority')}:{known.get('code')}" in ("EPSG:4326", "OGC:CRS84")
    return PointColumns(form, (name,), surface, latitude, None if in_degrees else json.dumps(crs))


def coordinates_of(form: Form, name: str, column: Any, rows: Sequence[int]) -> dict[str, Any]:
    """Two columns, by names for messages, of a column of points: well-known binary, or structures of x and y."""
    pyarrow = optional("pyarrow", "partitioned")
    types, kind = pyarrow.types, column.type
    if not (types.is_struct(kind) if form == "point" else types.is_binary(kind) or types.is_large_binary(kind)):
        raise TypeError(f"the geometries {name!r} are {kind}, not {'points' if form == 'point' else 'WKB'}")
    if form == "point":
        return {
            f"{name}.{axis}": optional("pyarrow.compute", "partitioned").struct_field(column, axis) for axis in "xy"
        }
    plain = _whole(column.cast(pyarrow.large_binary()))
    _, offsets, values = plain.buffers()
    starts = np.frombuffer(offsets, np.int64)[plain.offset : plain.offset + len(plain) + 1]
    places = wkb.xy(np.frombuffer(values or b"", np.uint8), starts, rows)
    return {f"{name}.{axis}": pyarrow.array(column) for axis, column in zip("xy", places.T, strict=True)}


def _whole(column: Any) -> Any:
    """A column without chunks."""
    return column.combine_chunks() if hasattr(column, "chunks") else column


def doubles_of(column: Any, name: str, rows: Sequence[int], *, axis: str = "", gaps: bool = False) -> FloatArray:
    """A column of finite numbers as doubles, NaN where there is none if `gaps`; errors call its numbers `axis`.

    NumPy would make numbers of booleans, times, text and bytes, too, and round whole numbers.
    """
    types, column = optional("pyarrow", "partitioned").types, _whole(column)
    kind = column.type
    known = (types.is_floating, types.is_integer, types.is_decimal, *([types.is_null] if gaps else []))
    if not any(fits(kind) for fits in known):
        raise TypeError(f"the column {name!r} holds {kind}, not numbers")
    if types.is_integer(kind) and column.null_count:
        whole = numbers(column.fill_null(0).to_numpy(), axis or name, rows)
        values = np.where(column.is_valid().to_numpy(zero_copy_only=False), whole, np.nan)
    else:
        values = column.to_numpy(zero_copy_only=False)
    return numbers(values, axis or name, rows, gaps=gaps, decimal=True, advice="leave such rows out")


@dataclass(frozen=True)
class PointFile:
    """A file of points."""

    path: str  # absolute
    name: str  # of its file of results, relative to the folder of rows, with slashes
    rows: int
    size: int  # in bytes
    modified: int  # in nanoseconds

    def check(self) -> None:
        """Raise ValueError unless the file is there as it was, by its size and time stamp."""
        state = os.stat(self.path)
        if (state.st_size, state.st_mtime_ns) != (self.size, self.modified):
            raise ValueError(f"{self.path} has changed since the run began; {anew()}")

    @classmethod
    def of(cls, path: Path, name: str) -> PointFile:
        """A file as it is now; its last pages alone are read."""
        state = path.stat()
        rows = opened(path).metadata.num_rows
        return cls(str(path.absolute()), name, rows, state.st_size, state.st_mtime_ns)


@dataclass(frozen=True)
class Source:
    """Files of points in the order that numbers their rows: what `triangulate` reads, whatever their kind."""

    files: tuple[PointFile, ...]
    columns: PointColumns  # the same ones in all files
    compact: bool | None = None  # whether files, cut or grouped in their order, are partitions; None: that is measured
    carried: tuple[str, ...] = ()  # columns that the files of rows repeat from the files of points, before their own


def opened(path: str | os.PathLike[str]) -> Any:
    """A file of Parquet; errors give its name. It is not mapped: one that is cut short would end the process."""
    try:
        return optional("pyarrow.parquet", "partitioned").ParquetFile(path, page_checksum_verification=True)
    except (OSError, ValueError, optional("pyarrow", "partitioned").ArrowException) as error:
        if isinstance(error, OSError) and error.errno is not None:  # of the system, which names it
            raise
        raise ValueError(f"{path} is not a Parquet file; write other tables as Parquet first ({error})") from error


def read(file: PointFile, columns: PointColumns, first: int, last: int) -> Iterator[FloatArray]:
    """Points of rows `first` to `last` of a file, a row group at a time."""
    with unchanged(file) as content:
        for low, table in slices(content, columns.names, first, last):
            yield columns.points(table, range(low + 1, low + 1 + table.num_rows))


def sampled(
    file: PointFile, columns: PointColumns, first: int, last: int, count: int, groups: int
) -> Iterator[FloatArray]:
    """About `count` points of rows `first` to `last` of a file, evenly spread over at most so many row groups."""
    with unchanged(file) as content:
        found = list(_groups(content, first, last))
        most = min(groups, len(found))
        for group, begin, end in (found[(2 * k + 1) * len(found) // (2 * most)] for k in range(most)):
            low, high = max(first - begin, 0), min(end, last) - begin
            step = max(1, (high - low) * most // count)
            rows = np.arange(low + (high - low - 1) % step // 2, high, step)
            yield columns.points(_group(content, group, columns.names).take(rows), (begin + 1 + rows).tolist())


def slices(content: Any, names: Sequence[str], first: int, last: int) -> Iterator[tuple[int, Any]]:
    """Columns of rows `first` to `last` of an open file, a row group at a time: the first row, and a table of Arrow."""
    for group, begin, end in _groups(content, first, last):
        low = max(begin, first)
        yield low, _group(content, group, names).slice(low - begin, min(end, last) - low)


@contextmanager
def unchanged(file: PointFile) -> Iterator[Any]:
    """A file, open, that is as it was before and after it is read, also where that errs; messages say which it is."""
    with naming(file.path), ExitStack() as after:
        file.check()
        after.callback(file.check)
        yield after.enter_context(opened(file.path))


def _groups(content: Any, first: int, last: int) -> Iterator[tuple[int, int, int]]:
    """Row groups with some of the rows `first` to `last`: number, first row, row after the last."""
    end = 0
    for group in range(content.num_row_groups):
        begin, end = end, end + content.metadata.row_group(group).num_rows
        if max(begin, first) < min(end, last):
            yield group, begin, end


def _group(content: Any, group: int, names: Sequence[str]) -> Any:
    missing = [name for name in names if name not in content.schema_arrow.names]
    if missing:
        raise ValueError(f"there is no column {missing[0]!r}, which the first file has")
    try:
        return content.read_row_group(group, columns=list(names), use_threads=False)
    except (OSError, optional("pyarrow", "partitioned").ArrowException) as error:
        raise ValueError(f"row group {group} cannot be read: {error}") from error


def paths_of(given: FilesGiven) -> list[tuple[Path, str]]:
    """Files and the names of their results: relative to the folder, to what a pattern fixes, or to what all share."""
    root = None
    if not isinstance(given, str | os.PathLike):
        paths = [Path(os.path.abspath(path)) for path in given]
    elif (whole := Path(given)).is_dir():
        root, within = whole, (path for ending in ENDINGS for path in whole.rglob(f"*{ending}"))
        paths = sorted(path for path in within if not any(part[0] in "_." for part in path.relative_to(whole).parts))
    else:
        found = [whole] if whole.is_file() else map(Path, glob.glob(os.fspath(given), recursive=True))
        paths = sorted(path for path in found if path.is_file())
    missing = [path for path in paths if not path.is_file()]
    if missing or (isinstance(given, str | os.PathLike) and not paths):
        raise FileNotFoundError(f"{missing[0] if missing else given} is no file, folder or pattern of Parquet files")
    root = root or (Path(os.path.commonpath([path.parent for path in paths])) if paths else Path())
    return [(path, path.relative_to(root).as_posix()) for path in paths]


def parquet_source(given: FilesGiven, names: tuple[str, ...] | None, surface: Surface, latitude: Latitude) -> Source:
    """Plain Parquet and GeoParquet: a file, a folder, a pattern or a list, in the order of names, or of the list."""
    paths = paths_of(given)
    if not paths:
        form: Form = "xyz" if surface == "sphere" else "xy"
        return Source((), PointColumns(form, tuple(form), surface, latitude))
    columns = find_columns(opened(paths[0][0]).schema_arrow, names, surface, latitude)
    return Source(tuple(PointFile.of(path, name) for path, name in paths), columns)


def names_of(given: str | Sequence[str] | None) -> tuple[str, ...] | None:
    """Names of columns, each once; one may be given by itself."""
    return (given,) if isinstance(given, str) else given if given is None else tuple(dict.fromkeys(given))
