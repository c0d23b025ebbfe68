"""Input points: tables in files or on stdin, with longitudes and latitudes or plane coordinates."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import Final

from stereodel.cli.application import reporting
from stereodel.cli.failures import NothingToDoError, naming_options
from stereodel.io import PointTable, read_points
from stereodel.io.reading import naming

SECOND: Final = {"lon": "lon", "lat": "lat", "layer": "layer-name", "crs": "crs"}
"""Ends of the names of options that a second table has of its own, by the arguments of `read`."""


def read(
    name: str,
    *,
    lon: str | None = None,
    lat: str | None = None,
    plane: tuple[str, str] | None = None,
    layer: str | None = None,
    crs: str | None = None,
    skip_missing: bool = False,
) -> PointTable:
    """The table in a file, or on stdin if `name` is "-"; raises NothingToDoError for a table without points."""
    shown = "stdin" if name == "-" else name
    source = sys.stdin.buffer if name == "-" else name
    with reporting(f"reading {shown}") as told, naming(shown if name == "-" else None):
        table = read_points(
            source, lon=lon, lat=lat, plane=plane, layer=layer, crs=crs, skip_missing=skip_missing, progress=told
        )
    if len(table) == 0:
        raise NothingToDoError(f"{shown}: there are no points")
    return table if table.name else replace(table, name=shown)


def read_second(
    name: str,
    option: str,
    *,
    lon: str | None,
    lat: str | None,
    layer: str | None,
    crs: str | None,
    first_crs: str | None,
    plane: tuple[str, str] | None,
    skip_missing: bool,
) -> PointTable:
    """The table that an option such as ``--at`` names, with options of its own: ``--at-lon`` and so on.

    In a plane both tables have the columns that ``--plane`` names, and the coordinate system of the first one where the
    second has none of its own.
    """
    own = {key: f"{option}-{ending}" for key, ending in SECOND.items()}
    crs = crs or (first_crs if plane else None)
    with naming_options(**own):
        return read(name, lon=lon, lat=lat, plane=plane, layer=layer, crs=crs, skip_missing=skip_missing)
