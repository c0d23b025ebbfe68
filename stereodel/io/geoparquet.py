"""GeoParquet, specification 1.0.0: Parquet with metadata that describe the geometry column."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from stereodel._extras import optional
from stereodel.io.cells import check_held
from stereodel.io.layers import Layer, Progress
from stereodel.io.vector_files import in_degrees, told

VERSION: Final = "1.0.0"


def read_parquet(content: bytes) -> Any:
    """A GeoDataFrame, or a table of Arrow if the file has no metadata of geometries."""
    parquet = optional("pyarrow.parquet", "geo")
    with told():
        table = parquet.read_table(io.BytesIO(content))
        if b"geo" not in (table.schema.metadata or {}):
            return table
        frame = optional("geopandas", "geo").read_parquet(io.BytesIO(content))
    return in_degrees(frame)


def write_parquet(
    layer: Layer, path: Path, progress: Progress | None = None, metadata: Mapping[str, str] | None = None
) -> None:
    """Rows of a map as GeoParquet, with metadata of the caller's."""
    check_held(layer.columns, "parquet")
    schema, batches = layer.batches(progress)
    crs = None if layer.crs is None else optional("pyproj", "geo").CRS(layer.crs).to_json_dict()
    column = {"encoding": "WKB", "geometry_types": layer.kinds, "crs": crs}
    geo = {"version": VERSION, "primary_column": layer.name, "columns": {layer.name: column}}
    schema = schema.with_metadata({"geo": json.dumps(geo), **(metadata or {})})
    with optional("pyarrow.parquet", "geo").ParquetWriter(path, schema) as file:
        for batch in batches:
            file.write_batch(batch)
