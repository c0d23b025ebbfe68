"""GeoParquet, specification 1.0.0: Parquet with metadata that describe the geometry column."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Final

from stereodel._extras import optional
from stereodel.io.layers import Layer, Progress

VERSION: Final = "1.0.0"


def write_parquet(layer: Layer, path: Path, progress: Progress | None = None) -> None:
    """Rows of a map as GeoParquet."""
    schema, batches = layer.batches(progress)
    crs = None if layer.crs is None else optional("pyproj", "geo").CRS(layer.crs).to_json_dict()
    column = {"encoding": "WKB", "geometry_types": layer.kinds, "crs": crs}
    geo = {"version": VERSION, "primary_column": layer.name, "columns": {layer.name: column}}
    with optional("pyarrow.parquet", "geo").ParquetWriter(path, schema.with_metadata({"geo": json.dumps(geo)})) as file:
        for batch in batches:
            file.write_batch(batch)
