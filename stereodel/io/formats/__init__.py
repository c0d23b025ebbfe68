"""What knows a file format: each module enters itself in `FORMATS`, and loads libraries only to read and write."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType
from typing import Any, BinaryIO, Final, Literal, NamedTuple, TextIO

from stereodel._arrays import Column, Indices, as_choice
from stereodel._tasks.progress import Progress
from stereodel.io.formats.foreign import unpacked
from stereodel.io.formats.names import find_lonlat, listed

Source = str | os.PathLike[str] | BinaryIO | TextIO
FormatName = Literal["csv", "geojson", "parquet", "vector"]

PACKED: Final = (".gz", ".bz2")
"""Extensions of compressed files."""


@dataclass(frozen=True)
class Wanted:
    """Options of `read_points` that describe the table."""

    lon: str | None = None
    lat: str | None = None
    plane: tuple[str, str] | None = None
    layer: str | None = None
    crs: str | None = None
    skip_missing: bool = False
    skip_invalid: bool = False
    missing: tuple[str, ...] = ()
    encoding: str | None = None
    decimal: str | None = None
    skip_rows: int = 0
    wrap: bool = False
    progress: Progress | None = None
    choice: str = ""
    """What to do where a file has several layers, if not to name one."""

    def axes(self, names: Sequence[str]) -> tuple[str, str]:
        """The columns of the coordinates; ValueError lists the columns if they are not among them."""
        if self.plane is None:
            return find_lonlat(names, self.lon, self.lat)
        missing = [name for name in self.plane if name not in names]
        if missing:
            raise ValueError(f"there is no column {missing[0]!r}; the columns are {listed(names)}")
        return self.plane


class Content:
    """What a file holds: here, columns alone."""

    crs: str | None = None
    """Coordinate system of the places, None for degrees."""

    understood: Mapping[str, Any] = MappingProxyType({})
    """How the file was read, for `inspect`: by name, such as ``encoding``."""

    invalid: Mapping[int, str] = MappingProxyType({})
    """Rows that are left out already, and what is wrong with them."""

    def __init__(self, columns: dict[str, Column], rows: Indices | None = None) -> None:
        self._columns, self.rows = columns, rows

    def columns(self) -> dict[str, Column]:
        """All columns that are not geometries."""
        return self._columns

    def places(self, *, skip_missing: bool) -> tuple[Column, Column] | None:
        """Both coordinates of features that are points, missing where they are empty; None without geometries."""


class FileFormat(NamedTuple):
    """Extensions of a format; first bytes of its files, and an extension for each; and what reads one."""

    endings: tuple[str, ...]
    marks: Mapping[bytes, str]
    read: Callable[[Input, Wanted], Content]


FORMATS: dict[FormatName, FileFormat] = {}


class Input:
    """A source of rows: its format, and its bytes, read on demand."""

    def __init__(self, source: Source, kind: FormatName | None = None) -> None:
        self._source = source
        self.path = Path(source) if isinstance(source, str | os.PathLike) else None
        self.kind: FormatName = as_choice(kind or self._found(), tuple(FORMATS), "format")

    def _found(self) -> FormatName:
        """The format from the extension of the path, ignoring that of compression, else from the first bytes."""
        kinds = {ending: kind for kind, known in FORMATS.items() for ending in known.endings}
        endings = [ending.lower() for ending in self.path.suffixes[-2:]] if self.path is not None else []
        if endings[-1:] and endings[-1] in PACKED:
            endings.pop()
        return kinds.get(endings[-1] if endings else "") or kinds[self._ending]

    @cached_property
    def content(self) -> bytes:
        """The decompressed bytes."""
        content = self._source.read() if self.path is None else self.path.read_bytes()  # type: ignore[union-attr]
        return content.encode() if isinstance(content, str) else unpacked(content)

    @contextmanager
    def on_disk(self) -> Iterator[Path]:
        """Where GDAL finds the file, as it needs the extension and any companion files."""
        if self.path is not None and self.path.suffix.lower() not in PACKED:
            if not self.path.is_dir():  # as some formats are
                self.path.open("rb").close()  # the system's own message says best why it cannot be read
            yield self.path
            return
        with TemporaryDirectory() as folder:
            within = Path(self.path.stem).suffix if self.path is not None else ""
            named = Path(folder, f"points{within or self._ending}")
            named.write_bytes(self.content)
            yield named

    @property
    def _ending(self) -> str:
        """The extension that matches the first bytes; XML may be KML or GPX, a zip archive a spreadsheet."""
        start = self.content[:64].lstrip(b"\xef\xbb\xbf \t\r\n")
        marks = {mark: ending for known in FORMATS.values() for mark, ending in known.marks.items()}
        found = next((ending for mark, ending in marks.items() if start.startswith(mark)), ".csv")
        if found == ".zip" and b"xl/workbook.xml" in self.content:
            return ".xlsx"
        if found == ".zip" and b"opendocument.spreadsheet" in self.content[:100]:
            return ".ods"
        return ".gpx" if found == ".kml" and b"<gpx" in self.content[:1000] else found
