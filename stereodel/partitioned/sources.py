"""Sources: the files that points come from, in the order that numbers them, and reading them piece by piece."""

from __future__ import annotations

import glob
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import optional
from stereodel.partitioned.places import Places, Surface, find_places
from stereodel.partitioned.shards import anew
from stereodel.sphere.latitudes import Latitude

Given = str | os.PathLike[str] | Sequence[str | os.PathLike[str]]
"""What names files of points: a file, a folder, a pattern with *, ? or [, or a list of files."""

ENDINGS: Final = (".parquet", ".geoparquet", ".pq")
"""Of files in a folder that are read; others, and those that begin with _ or ., are not."""


@dataclass(frozen=True)
class PointFile:
    """A file of points.

    path: where it is, absolute.
    name: what its file of results is called, relative to the folder of rows, with slashes.
    rows: number of its rows.
    size: in bytes.
    modified: its time stamp in nanoseconds.
    """

    path: str
    name: str
    rows: int
    size: int
    modified: int

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
    """Files of points in the order that numbers their rows: what `triangulate` reads, whatever their kind.

    A kind of its own, such as a catalogue of HATS, is a function that makes one of these of a path, in `KINDS`.

    files: in order: the number of a point is that of its row in all of them, from 0.
    places: which columns say where points are, the same ones in all files.
    compact: whether files, cut or grouped in their order, are partitions as they are; by default that is measured.
    carried: columns that the files of rows repeat from the files of points, before their own.
    """

    files: tuple[PointFile, ...]
    places: Places
    compact: bool | None = None
    carried: tuple[str, ...] = ()


def opened(path: str | os.PathLike[str]) -> Any:
    """A file of Parquet; errors give its name. It is not mapped: one that is cut short would end the process."""
    try:
        return optional("pyarrow.parquet", "partitioned").ParquetFile(path, page_checksum_verification=True)
    except (OSError, ValueError, optional("pyarrow", "partitioned").ArrowException) as error:
        if isinstance(error, OSError) and error.errno is not None:  # of the system, which names it
            raise
        raise ValueError(f"{path} is not a Parquet file: {error}") from error


def read(file: PointFile, places: Places, first: int, last: int) -> Iterator[FloatArray]:
    """Points of rows `first` to `last` of a file, a row group at a time.

    Raises ValueError if a row is not a point, naming the file, the row (counted from 1) and the value; if columns are
    missing.
    """
    with named(file):
        for low, table in slices(file, places.names, first, last):
            yield places.points(table, low)


def some(file: PointFile, places: Places, first: int, last: int, count: int, groups: int) -> Iterator[FloatArray]:
    """About `count` points of rows `first` to `last` of a file, evenly spread over at most so many row groups."""
    with named(file), _unchanged(file) as content:
        found = list(_groups(content, first, last))
        most = min(groups, len(found))
        for group, begin, end in (found[(2 * k + 1) * len(found) // (2 * most)] for k in range(most)):
            low, high = max(first - begin, 0), min(end, last) - begin
            step = max(1, (high - low) * most // count)
            rows = np.arange(low + (high - low - 1) % step // 2, high, step)
            table = _columns(content, group, places.names)
            try:
                yield places.points(table.take(rows))
            except ValueError:
                places.points(table, begin)  # whose message has the number of the row
                raise


def slices(file: PointFile, names: Sequence[str], first: int, last: int) -> Iterator[tuple[int, Any]]:
    """Columns of rows `first` to `last` of a file, a row group at a time: the first row, and a table of Arrow."""
    with _unchanged(file) as content:
        for group, begin, end in _groups(content, first, last):
            low = max(begin, first)
            yield low, _columns(content, group, names).slice(low - begin, min(end, last) - low)


@contextmanager
def _unchanged(file: PointFile) -> Iterator[Any]:
    """A file that is as it was before and after it is read."""
    file.check()
    with opened(file.path) as content:
        yield content
    file.check()


def _groups(content: Any, first: int, last: int) -> Iterator[tuple[int, int, int]]:
    """Row groups with some of the rows `first` to `last`: number, first row, row after the last."""
    end = 0
    for group in range(content.num_row_groups):
        begin, end = end, end + content.metadata.row_group(group).num_rows
        if max(begin, first) < min(end, last):
            yield group, begin, end


def _columns(content: Any, group: int, names: Sequence[str]) -> Any:
    missing = [name for name in names if name not in content.schema_arrow.names]
    if missing:
        raise ValueError(f"there is no column {missing[0]!r}, which the first file has")
    try:
        return content.read_row_group(group, columns=list(names), use_threads=False)
    except (OSError, optional("pyarrow", "partitioned").ArrowException) as error:
        raise ValueError(f"row group {group} cannot be read: {error}") from error


@contextmanager
def named(file: PointFile) -> Iterator[None]:
    """Say of which file a message is."""
    try:
        yield
    except (ValueError, TypeError) as error:
        if str(error).startswith(file.path):
            raise
        kind = ValueError if isinstance(error, ValueError) else TypeError
        raise kind(f"{file.path}: {error}") from error


def paths_of(given: Given) -> list[tuple[Path, str]]:
    """Files and the names of their results: relative to the folder, to what a pattern fixes, or to what all share.

    Raises FileNotFoundError where nothing is there.
    """
    if not isinstance(given, str | os.PathLike):
        paths = [Path(os.path.abspath(path)) for path in given]
        root = Path(os.path.commonpath([path.parent for path in paths])) if paths else Path()
    elif (whole := Path(given)).is_dir():
        found = [path for ending in ENDINGS for path in whole.rglob(f"*{ending}")]
        root, paths = whole, sorted(path for path in found if not _is_hidden(path.relative_to(whole)))
    elif whole.is_file():
        root, paths = whole.parent, [whole]
    else:
        paths = sorted(Path(path) for path in glob.glob(os.fspath(given), recursive=True) if Path(path).is_file())
        root = Path(os.path.commonpath([path.parent for path in paths])) if paths else Path()
    missing = [path for path in paths if not path.is_file()]
    if missing or (not paths and isinstance(given, str | os.PathLike)):
        raise FileNotFoundError(f"{missing[0] if missing else given} is no file, folder or pattern of Parquet files")
    return [(path, path.relative_to(root).as_posix()) for path in paths]


def _is_hidden(path: Path) -> bool:
    return any(part.startswith(("_", ".")) for part in path.parts)


def parquet_source(given: Given, columns: Sequence[str] | None, surface: Surface, latitude: Latitude) -> Source:
    """Plain Parquet and GeoParquet: a file, a folder, a pattern or a list, in the order of names, or of the list."""
    paths = paths_of(given)
    if not paths:
        return Source((), Places("xyz" if surface == "sphere" else "xy", ("x", "y", "z"), surface, latitude))
    places = find_places(opened(paths[0][0]).schema_arrow, columns, surface, latitude)
    return Source(tuple(PointFile.of(path, name) for path, name in paths), places)
