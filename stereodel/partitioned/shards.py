"""Shards: arrays of a run on disk, written whole or not at all, and mapped or read in slices.

A line of JSON says type, shape and CRC-32; the bytes behind it can be mapped. The headers of ``.npy`` are Python, whose
parser is not safe in several threads of CPython 3.11.
"""

from __future__ import annotations

import json
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from typing import Any, Final
from zlib import crc32

import numpy as np
import numpy.typing as npt

from stereodel._files import replacing
from stereodel.io.formats.names import spelled

ALIGNMENT: Final = 64
"""Bytes of which the header is a multiple."""


def save(path: Path, array: npt.NDArray[Any]) -> Path:
    """An array as a file, which appears when it is complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    whole = np.ascontiguousarray(array)
    told = {"type": np.lib.format.dtype_to_descr(whole.dtype), "shape": whole.shape, "sum": crc32(whole.data)}
    head = json.dumps(told).encode()
    with replacing(path) as temporary, temporary.open("wb") as file:
        file.write(head.ljust(-(-(len(head) + 1) // ALIGNMENT) * ALIGNMENT - 1) + b"\n")
        file.write(whole.reshape(-1).view(np.uint8).data)  # not tofile(), which does not say why it could not write
    return path


def load(path: Path, *, checked: bool = True) -> npt.NDArray[Any]:
    """An array of a file: its pages come when they are touched, and are shared by all processes of a machine.

    checked: whether its bytes are compared with their CRC-32, once in a process; if not, slices can be, by `sums`.
    Raises ValueError where the file was deleted, cut short or changed after it was written.
    """
    array, told = _mapped(path)
    if checked:
        state = path.stat()
        _check(path, told, state.st_mtime_ns, state.st_ino)
    return array


def sums(starts: npt.NDArray[Any], *arrays: npt.NDArray[Any]) -> npt.NDArray[np.uint32]:
    """CRC-32 of the rows from each start to the next one, of all arrays together."""
    views = [(array.reshape(-1).view(np.uint8).data, array.nbytes // max(1, len(array))) for array in arrays]
    found = []
    for first, last in pairwise(starts.tolist()):
        total = 0
        for view, width in views:
            total = crc32(view[first * width : last * width], total)
        found.append(total)
    return np.array(found, dtype=np.uint32)


def check(right: Any, found: Any, path: Path) -> None:
    """Raise ValueError unless the CRC-32 of what was read of a file are as they were when it was written."""
    if not np.array_equal(right, found):
        raise ValueError(_damaged(path, "changed"))


@lru_cache(maxsize=4096)
def _check(path: Path, told: int, modified: int, node: int) -> None:
    check(told, crc32(np.ascontiguousarray(_mapped(path)[0]).data), path)


def _mapped(path: Path) -> tuple[npt.NDArray[Any], int]:
    """An array, and its CRC-32 when it was written."""
    try:
        with path.open("rb") as file:
            head = file.readline()
        told = json.loads(head)
        kind = np.lib.format.descr_to_dtype(told["type"])
        return np.memmap(path, kind, "r", len(head), tuple(told["shape"])), told["sum"]
    except FileNotFoundError as error:
        raise ValueError(_damaged(path, "deleted")) from error
    except (ValueError, KeyError, TypeError) as error:  # of JSON, of what it should say, and of too few bytes
        raise ValueError(_damaged(path, "cut short or changed")) from error


def _damaged(path: Path, what: str) -> str:
    return f"{path} was {what} after it was written; {anew()}"


def load_json(path: Path) -> dict[str, Any]:
    """A document."""
    try:
        return dict(json.loads(path.read_text(encoding="utf-8")))
    except FileNotFoundError as error:
        raise ValueError(_damaged(path, "deleted")) from error
    except ValueError as error:
        raise ValueError(_damaged(path, "cut short or changed")) from error


def anew() -> str:
    """What to do about results that are not what they were."""
    return f"begin anew with {spelled('resume', '=False')}"
