"""Tables of results as files."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np

from stereodel._extras import optional
from stereodel._files import replacing
from stereodel.cli.sources import LONLAT, Column, Columns
from stereodel.io import write

EXACT_INTEGERS = 2.0**53  # larger ones would be written with digits that doubles do not have

TABLES = ("csv", "geojson", "parquet", "gpkg")


def save_table(path: Path, axes: tuple[str, str], columns: Columns) -> None:
    """Write a table of points, as the extension says; `axes` are the columns that hold the places."""
    if path.suffix.lower() != ".csv":
        write(path, _frame(axes, columns))
        return
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*map(_cells, columns.values()), strict=True))


def _frame(axes: tuple[str, str], columns: Columns) -> Any:
    """Points as a GeoDataFrame, on the Earth in WGS84."""
    geopandas = optional("geopandas", "geo")
    others = {name: values for name, values in columns.items() if name not in axes}
    geometry = geopandas.points_from_xy(*(columns[axis] for axis in axes))
    return geopandas.GeoDataFrame(others, geometry=geometry, crs="EPSG:4326" if axes == LONLAT else None)


def _cells(values: Column) -> list[Any]:
    """What a text table says: nothing where there is no number, and no fraction where a column has none."""
    if values.dtype.kind != "f":
        return list(values.tolist())
    numbers = values.astype(np.float64)
    known = np.isfinite(numbers)
    whole = np.abs(numbers[known]) < EXACT_INTEGERS
    if whole.all() and (numbers[known] == np.round(numbers[known])).all():
        return [int(cell) if here else None for cell, here in zip(numbers.tolist(), known.tolist(), strict=True)]
    return [cell if here else None for cell, here in zip(numbers.tolist(), known.tolist(), strict=True)]
