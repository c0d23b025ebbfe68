"""Aligning: results for points, in files with the rows of the input's files, in their order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._extras import optional
from stereodel._files import replacing
from stereodel.partitioned.files import opened, slices, unchanged
from stereodel.partitioned.plan import RowRange
from stereodel.partitioned.store import Columns, Store


def align(store: Store, output: int) -> None:
    """The files of some shares of the input."""
    pieces = groupby(_pieces(store, output), lambda piece: piece[0].file)
    paths = [write_file(store, file, found) for file, found in pieces]
    store.notes.keep("align", {}, paths, task=output)


def _pieces(store: Store, output: int) -> Iterator[tuple[RowRange, Columns]]:
    """Rows of the input's files in order, and the results for them: of one share after another, which may be large."""
    for share in store.plan.outputs[output]:
        columns, used = _columns(store, share), 0
        for rows in store.plan.shares[share]:
            own = slice(used, used := used + rows.last - rows.first)
            yield rows, {name: column[own] for name, column in columns.items()}


def _columns(store: Store, share: int) -> Columns:
    """Results for the points of a share, in their order."""
    plan = store.plan
    first, last = plan.share_firsts[share : share + 2].tolist()
    columns = {name: np.empty(last - first, dtype=kind) for name, kind in plan.row_kinds.items()}
    if "kept" in columns:
        columns["kept"][:] = np.arange(first, last)
    filled = 0
    for part, (results,) in store.slices("stars", share, "rows"):
        at, filled = results["number"].astype(np.intp) - first, filled + len(results)
        for name in plan.row_names:
            columns[name][at] = results[name]
        if "kept" in columns:
            pairs = store.load("stars", part, "pairs")
            low, high = np.searchsorted(pairs[:, 0], [first, last])
            columns["kept"][pairs[low:high, 0] - first] = pairs[low:high, 1]
    if filled != last - first:
        raise RuntimeError(f"there are results for {filled} of the {last - first} rows from {first}")
    return columns


def write_file(store: Store, file: int, pieces: Iterable[tuple[RowRange, Columns]]) -> Path:
    """The results for a file of the input, behind the columns that are carried along, as they are there."""
    plan, source = store.plan, store.plan.files[file]
    pyarrow, parquet = (optional(name, "partitioned") for name in ("pyarrow", "pyarrow.parquet"))
    path = store.folder("rows") / source.name
    path.parent.mkdir(parents=True, exist_ok=True)
    fields: list[Any] = []
    if plan.carried:
        with opened(source.path) as content:
            fields += [content.schema_arrow.field(name) for name in plan.carried]
    for name, kind in plan.row_kinds.items():
        one = pyarrow.from_numpy_dtype(kind.base)
        fields.append(pyarrow.field(name, pyarrow.list_(one, *kind.shape) if kind.shape else one))
    schema = pyarrow.schema(fields, metadata=plan.metadata)
    options = {"compression": "none", "use_dictionary": list(plan.carried)}
    with replacing(path) as temporary, parquet.ParquetWriter(temporary, schema, **options) as out:
        for rows, columns in pieces:
            arrays = {name: _array(column) for name, column in columns.items()}
            if plan.carried:
                with unchanged(source) as content:
                    found = [table for _, table in slices(content, plan.carried, rows.first, rows.last)]
                table = pyarrow.concat_tables(found).combine_chunks()
                arrays |= {name: table[name] for name in plan.carried}
            out.write_table(pyarrow.table([arrays[name] for name in schema.names], schema=schema))
    return path


def _array(column: npt.NDArray[Any]) -> Any:
    """A column of Arrow; rows with several numbers are lists of a fixed size."""
    pyarrow = optional("pyarrow", "partitioned")
    flat = pyarrow.array(column.ravel())
    return flat if column.ndim == 1 else pyarrow.FixedSizeListArray.from_arrays(flat, column.shape[1])
