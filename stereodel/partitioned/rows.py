"""Rows: results for points, in files with the rows of the input's files, in their order."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._extras import optional
from stereodel._files import replacing
from stereodel.partitioned.plan import Piece, Plan
from stereodel.partitioned.shards import load, save
from stereodel.partitioned.solve import row_kinds
from stereodel.partitioned.sources import named, opened, slices
from stereodel.partitioned.store import Store


def gather(store: Store, parts: Sequence[int]) -> None:
    """Write where each share of the input begins in the stars of each partition, (parts, shares + 1, 2)."""
    starts = [store.load("stars", part, "starts") for part in parts]
    save(store.scratch / "stars" / "starts", np.stack(starts))
    save(store.scratch / "stars" / "parts", np.array(parts))


def align(store: Store, output: int) -> None:
    """The files of some shares of the input."""
    plan = store.plan
    shares, paths = plan.outputs[output], []
    if len(shares) > 1:
        lots = ((plan.shares[share][0], _columns(store, share)) for share in shares)
        paths.append(write_file(store, plan.shares[shares[0]][0].file, lots))
    else:
        columns, first = _columns(store, shares[0]), 0
        for piece in plan.shares[shares[0]]:
            rows = slice(first, first + piece.last - piece.first)
            first = rows.stop
            lot = piece, {name: column[rows] for name, column in columns.items()}
            paths.append(write_file(store, piece.file, [lot]))
    store.notes.keep("align", {}, paths, task=output)


def _columns(store: Store, share: int) -> dict[str, npt.NDArray[Any]]:
    """Results for the points of a share, in their order."""
    plan = store.plan
    first, last = plan.share_firsts[share : share + 2].tolist()
    columns = {name: np.empty(last - first, dtype=kind) for name, kind in row_kinds(plan).items()}
    if "kept" in columns:
        columns["kept"][:] = np.arange(first, last)
    filled = 0
    starts, parts = (load(store.scratch / "stars" / name) for name in ("starts", "parts"))
    for part, ((low, total), (high, _)) in zip(parts.tolist(), starts[:, share : share + 2].tolist(), strict=True):
        if low == high:
            continue
        (cells,) = store.load_rows("stars", part, low, high, total, "rows")
        at, filled = cells["number"].astype(np.intp) - first, filled + len(cells)
        for name in plan.told:
            columns[name][at] = cells[name]
        if "kept" in columns:
            pairs = store.load("stars", part, "pairs")
            low, high = np.searchsorted(pairs[:, 0], [first, last])
            columns["kept"][pairs[low:high, 0] - first] = pairs[low:high, 1]
    if filled != last - first:
        raise RuntimeError(f"there are results for {filled} of the {last - first} rows from {first}")
    return columns


def write_file(store: Store, file: int, lots: Any) -> Path:
    """A file of rows, from pieces of the input's file and columns for each, in order; without a piece it has no rows.

    file: number of the input's file.
    """
    plan = store.plan
    path = store.room("rows") / plan.files[file].name
    path.parent.mkdir(parents=True, exist_ok=True)
    schema = _schema(store, file)
    with (
        replacing(path) as temporary,
        optional("pyarrow.parquet", "partitioned").ParquetWriter(
            temporary, schema, compression="none", use_dictionary=list(plan.carried)
        ) as out,
    ):
        for piece, columns in lots:
            out.write_table(_table(plan, piece, columns, schema))
    return path


def _schema(store: Store, file: int) -> Any:
    """Columns that are carried along from the input, as they are there, then those of the rows."""
    pyarrow = optional("pyarrow", "partitioned")
    plan = store.plan
    carried: list[Any] = []
    if plan.carried:
        with opened(plan.files[file].path) as content:
            carried = [content.schema_arrow.field(name) for name in plan.carried]
    own = [pyarrow.field(name, _type(kind)) for name, kind in row_kinds(plan).items()]
    return pyarrow.schema([*carried, *own], metadata=plan.metadata)


def _type(kind: np.dtype[Any]) -> Any:
    """A type of Arrow."""
    pyarrow = optional("pyarrow", "partitioned")
    one = pyarrow.from_numpy_dtype(kind.base)
    return pyarrow.list_(one, *kind.shape) if kind.shape else one


def _array(column: npt.NDArray[Any]) -> Any:
    """A column of Arrow; rows with several numbers are lists of a fixed size."""
    pyarrow = optional("pyarrow", "partitioned")
    flat = pyarrow.array(column.ravel())
    return flat if column.ndim == 1 else pyarrow.FixedSizeListArray.from_arrays(flat, column.shape[1])


def _table(plan: Plan, piece: Piece, columns: dict[str, npt.NDArray[Any]], schema: Any) -> Any:
    pyarrow = optional("pyarrow", "partitioned")
    arrays = {name: _array(column) for name, column in columns.items()}
    if plan.carried:
        file = plan.files[piece.file]
        with named(file):
            found = [table for _, table in slices(file, plan.carried, piece.first, piece.last)]
        table = pyarrow.concat_tables(found).combine_chunks()
        arrays |= {name: table[name] for name in plan.carried}
    return pyarrow.table([arrays[name] for name in schema.names], schema=schema)
