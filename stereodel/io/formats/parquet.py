"""GeoParquet, specification 1.0.0: Parquet with metadata that describe the geometry column."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from stereodel._extras import optional
from stereodel._tasks.progress import Progress
from stereodel.io.formats import Content, FileFormat, Wanted, wkb
from stereodel.io.formats.columns import check_held
from stereodel.io.formats.foreign import SourceFile, check_size
from stereodel.io.formats.gdal import in_degrees, told
from stereodel.io.formats.map_rows import Frame, MapRows, of_arrow


def read(file: SourceFile, _: Wanted) -> Content:
    """A frame with geometries, or columns alone if the file has no metadata of geometries."""
    content = file.content
    parquet = optional("pyarrow.parquet", "geo")
    with told():
        found = parquet.read_metadata(io.BytesIO(content))
    check_size(8 * found.num_rows * found.num_columns, len(content))
    with told():
        # Text that repeats is read as it is packed, each once.
        names = [field.name for field in parquet.read_schema(io.BytesIO(content)) if field.type in ("string", "binary")]
        table = parquet.read_table(io.BytesIO(content), read_dictionary=names)
        letters = sum(_letters(table[name]) for name in names)
    check_size(letters, len(content))
    with told():
        if b"geo" not in (table.schema.metadata or {}):
            return Content({name: of_arrow(table[name]) for name in table.column_names})
        frame = optional("geopandas", "geo").read_parquet(io.BytesIO(content))
    return Frame(in_degrees(frame))


FORMAT = FileFormat((".parquet", ".geoparquet"), {b"PAR1": ".parquet"}, read)


def _letters(column: Any) -> int:
    """Bytes of all text of a column that has each once."""
    compute = optional("pyarrow.compute", "geo")
    lengths = ((compute.binary_length(chunk.dictionary), chunk.indices) for chunk in column.chunks)
    return sum(compute.sum(compute.take(each, where)).as_py() or 0 for each, where in lengths)


def write_parquet(
    layer: MapRows, path: Path, progress: Progress | None = None, metadata: Mapping[str, str] | None = None
) -> None:
    """Rows of a map as GeoParquet, with metadata of the caller's."""
    check_held(layer.columns, "parquet")
    schema, batches = layer.batches(progress)
    crs = None if layer.crs is None else optional("pyproj", "geo").CRS(layer.crs).to_json_dict()
    column = {"encoding": "WKB", "geometry_types": wkb.kinds(layer.binary), "crs": crs}
    geo = {"version": "1.0.0", "primary_column": layer.name, "columns": {layer.name: column}}
    schema = schema.with_metadata({"geo": json.dumps(geo), **(metadata or {})})
    with optional("pyarrow.parquet", "geo").ParquetWriter(path, schema) as file:
        for batch in batches:
            file.write_batch(batch)
