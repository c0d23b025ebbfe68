"""Shards: arrays of a run on disk as plain ``.npy``, written whole or not at all, and mapped or read in slices."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._files import replacing


def save(path: Path, array: npt.NDArray[Any]) -> None:
    """An array as a file, which appears when it is complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    header = np.lib.format.header_data_from_array_1_0(array)
    with replacing(path) as temporary, temporary.open("wb") as file:
        np.lib.format.write_array_header_1_0(file, header)
        if array.size:  # not tofile(), which does not say why it could not write
            file.write(np.ascontiguousarray(array).data.cast("B"))


def load(path: Path) -> npt.NDArray[Any]:
    """An array of a file: its pages come when they are touched, and are shared by all processes of a machine.

    Raises
    ------
    ValueError
        Where the file was cut short after it was written.
    """
    try:
        array: npt.NDArray[Any] = np.load(path, mmap_mode="r")
    except (ValueError, EOFError) as error:
        raise ValueError(_damaged(path)) from error
    return array


def load_rows(path: Path, first: int, last: int) -> npt.NDArray[Any]:
    """Rows `first` to `last` of an array of a file, in memory."""
    with path.open("rb") as file:
        try:
            np.lib.format.read_magic(file)
            shape, _, kind = np.lib.format.read_array_header_1_0(file)
        except (ValueError, EOFError) as error:
            raise ValueError(_damaged(path)) from error
        width = int(np.prod(shape[1:], dtype=np.int64))
        file.seek(first * width * kind.itemsize, 1)
        rows = np.fromfile(file, kind, (last - first) * width)
    if len(rows) < (last - first) * width:
        raise ValueError(_damaged(path))
    return rows.reshape(last - first, *shape[1:])


def _damaged(path: Path) -> str:
    return f"{path} was cut short after it was written; begin anew with resume=False"


def save_json(path: Path, value: Mapping[str, Any]) -> None:
    """A document, which appears when it is complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(value), encoding="utf-8")


def load_json(path: Path) -> dict[str, Any]:
    """A document."""
    return dict(json.loads(path.read_text(encoding="utf-8")))
