"""What knows a file format: each module has one for the table of `reading`, and loads libraries only on use."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, BinaryIO, Literal, NamedTuple, TextIO

from stereodel._arrays import Column, Indices, as_choice, as_count
from stereodel._tasks.progress import Progress
from stereodel.io.formats.names import find_lonlat, listed, spelled

Source = str | os.PathLike[str] | BinaryIO | TextIO
FormatName = Literal["csv", "geojson", "parquet", "vector"]


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
    missing: str | float | Sequence[str | float] = ()
    encoding: str | None = None
    decimal: str | None = None
    skip_rows: int = 0
    wrap: bool = False
    progress: Progress | None = None

    @property
    def sentinels(self) -> list[str]:
        """What stands for missing values, as text."""
        return list(map(str, [self.missing] if isinstance(self.missing, str | float | int) else self.missing))

    def __post_init__(self) -> None:
        if self.plane is not None and (self.lon is not None or self.lat is not None):
            raise ValueError("plane names the columns of both coordinates; leave out lon and lat")
        if self.decimal is not None:
            as_choice(self.decimal, (".", ","), spelled("decimal"))
        as_count(self.skip_rows, spelled("skip_rows"), low=0)

    def axes(self, names: Sequence[str]) -> tuple[str, str]:
        """The columns of the coordinates; ValueError lists the columns if they are not among them."""
        if self.plane is None:
            return find_lonlat(names, self.lon, self.lat)
        for name in self.plane:
            if name not in names:
                raise ValueError(f"there is no column {name!r}; the columns are {listed(names)}")
        return self.plane


class Content:
    """What a file holds: here, columns alone."""

    crs: str | None = None
    """Coordinate system of the places, None for degrees."""

    def __init__(self, columns: dict[str, Column], rows: Indices | None = None) -> None:
        self._columns, self.rows = columns, rows
        self.understood: dict[str, Any] = {}  # how the file was read, for `inspect`
        self.invalid: dict[int, str] = {}  # rows that are left out, and what is wrong with them

    def columns(self) -> dict[str, Column]:
        """All columns that are not geometries."""
        return self._columns

    def places(self, *, skip_missing: bool) -> tuple[Column, Column] | None:
        """Both coordinates of features that are points, missing where they are empty; None without geometries."""


class FileFormat(NamedTuple):
    """Extensions of a format; first bytes of its files, and an extension for each; and what reads one."""

    endings: tuple[str, ...]
    marks: Mapping[bytes, str]
    read: Callable[[Any, Wanted], Content]
    """Takes a `foreign.SourceFile`."""
