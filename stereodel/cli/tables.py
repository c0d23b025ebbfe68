"""Tables of results as files."""

from __future__ import annotations

import csv
import json
import os
import tempfile
from itertools import repeat
from pathlib import Path
from typing import Any

import numpy as np

from stereodel._files import replacing
from stereodel.cli.sources import LONLAT, Column, Columns
from stereodel.io.extras import optional

EXACT_INTEGERS = 2.0**53  # larger ones would be written with digits that doubles do not have

TABLES = ("csv", "geojson", "parquet", "gpkg")


def save_table(path: Path, axes: tuple[str, str], columns: Columns) -> None:
    """Write a table of points, as the extension says; `axes` are the columns that hold the places."""
    kind = path.suffix.lower()
    with replacing(path) as temporary:
        if kind == ".csv":
            _write_csv(temporary, columns)
        elif kind == ".geojson":
            _write_geojson(temporary, axes, columns)
        else:
            _write_frame(temporary, _frame(axes, columns), path)


def _write_csv(path: Path, columns: Columns) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*map(_cells, columns.values()), strict=True))


def _write_geojson(path: Path, axes: tuple[str, str], columns: Columns) -> None:
    """Points with the other columns as properties, one feature a line."""
    places = np.column_stack([columns[axis] for axis in axes]).tolist()
    names = [name for name in columns if name not in axes]
    rows = zip(*(_cells(columns[name]) for name in names), strict=True) if names else repeat(())
    with path.open("w", encoding="utf-8") as file:
        file.write('{"type": "FeatureCollection", "features": [')
        for number, (place, row) in enumerate(zip(places, rows, strict=False)):
            feature = {
                "type": "Feature",
                "properties": dict(zip(names, row, strict=True)),
                "geometry": {"type": "Point", "coordinates": place},
            }
            file.write((",\n" if number else "\n") + json.dumps(feature, ensure_ascii=False))
        file.write("\n]}\n")


def save_frame(path: Path, frame: Any) -> None:
    """Write a GeoDataFrame as the extension says."""
    with replacing(path) as temporary:
        _write_frame(temporary, frame, path)


def _write_frame(temporary: Path, frame: Any, path: Path) -> None:
    """A GeoDataFrame in the format of `path`: GDAL insists on the extension, so it gets a folder to write in."""
    if path.suffix.lower() == ".parquet":
        frame.to_parquet(temporary)
        return
    with tempfile.TemporaryDirectory(dir=temporary.parent) as folder:
        whole = Path(folder, path.name)
        on_earth_as_geojson = path.suffix.lower() == ".geojson" and frame.crs is not None
        frame.to_file(whole, **({"RFC7946": "YES"} if on_earth_as_geojson else {}))
        os.replace(whole, temporary)


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
