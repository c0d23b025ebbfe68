"""Where a run keeps what its tasks hand on: arrays, written whole or not at all, in folders of results and of scratch.

results:   plan.json, files.parquet, rows/…, triangles/<part>.parquet, run.json; if the index is kept, points and blocks
made:      all of these but plan.json, until all are there: then they are moved
scratch:   splits                           the k-d tree
           spread/<share>.*                 points of a share of the input in the order of partitions
           points/<part>.*                  points of a partition in blocks, their numbers, and the blocks
           blocks/*                         boxes of all blocks, one point of each
           stars/<part>.*                   results for the points of a partition, in the order of numbers
           values/<share>.values            columns of the points that are interpolated, in the order of numbers
           done/<pass>/<task>.json, <pass>.json    notes of tasks, and of passes when all of their tasks are done

The file of an array is a line of JSON, which has type, shape and CRC-32, and the bytes, which can be mapped. The
headers of ``.npy`` are Python, whose parser is not safe in several threads of CPython 3.11.
"""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from typing import Any, Final
from zlib import crc32

import numpy as np
import numpy.typing as npt

from stereodel._arrays import LongArray
from stereodel._extras import optional
from stereodel._tasks.kept import Kept, Note
from stereodel._tasks.whole_files import replacing
from stereodel.io.formats.names import anew
from stereodel.partitioned.plan import NAME, Plan

SCRATCH: Final = "scratch"
"""Folder of results in which runs work, each in a folder of its own."""

DIGITS: Final = 16
"""How many of a digest are the name of such a folder."""

KEPT: Final = "index"
"""Folder of results that has the folders of the index if it is kept."""

INDEX: Final = ("points", "blocks")
"""Folders that answers at targets need."""

RESULTS: Final = ("rows", "triangles", "cells")
"""Folders of Parquet, which are results."""

ALIGNMENT: Final = 64
"""Bytes of which the header of an array is a multiple."""

MAPPED: Final[ContextVar[set[Path]]] = ContextVar("MAPPED")
"""Files whose bytes the task of this thread uses where they lie."""

Columns = dict[str, npt.NDArray[Any]]

Left = tuple[Note, list[Path]]
"""What a task has to say, and the files that it wrote."""


@dataclass(frozen=True)
class Store:
    """The folders of a run, seen by all of its workers.

    The plan's digest is in the paths of `scratch` and `made`: a task of another run that ended cannot write there.
    """

    results: Path
    scratch: Path
    made: Path
    plan: Plan

    @classmethod
    def of(cls, folder: Path, scratch: Path | None, plan: Plan) -> Store:
        """Folders of a run that writes to one folder, and works in it or in another one."""
        name = hashlib.sha256(f"{plan.digest} {folder}".encode()).hexdigest()[:DIGITS]
        own = folder / SCRATCH / name
        return cls(folder, own if scratch is None else scratch / name, own / "results", plan)

    @classmethod
    def ended(cls, folder: Path) -> Store:
        """Folders of a run that ended."""
        return cls(folder, folder, folder, load_plan(folder))

    @property
    def notes(self) -> Kept:
        """Notes of the tasks that are done, with the files that they wrote."""
        return Kept(self.scratch / "done")

    def folder(self, name: str) -> Path:
        """The folder of what one pass hands on."""
        if name in RESULTS:
            return self.made / name
        return (self.made / KEPT if self.plan.index and name in INDEX else self.scratch) / name

    def path(self, folder: str, number: int, name: str) -> Path:
        """The file of an array that a task hands on."""
        return self.folder(folder) / f"{number}.{name}"

    def save(self, folder: str, number: int, arrays: Mapping[str, npt.NDArray[Any]]) -> list[Path]:
        """Write arrays to files."""
        return [save(self.path(folder, number, name), array) for name, array in arrays.items()]

    def load(self, folder: str, number: int, name: str, *, checked: bool = True) -> npt.NDArray[Any]:
        """An array, mapped."""
        return load(self.path(folder, number, name), checked=checked)

    def gather(self, folder: str, numbers: Sequence[int]) -> None:
        """Write the ``starts`` of all tasks as one, (tasks, slices + 1, 2), so that few files are opened."""
        save(self.folder(folder) / "starts", np.stack([self.load(folder, number, "starts") for number in numbers]))
        save(self.folder(folder) / "tasks", np.array(numbers))

    def slices(self, folder: str, place: int, *names: str) -> Iterator[tuple[int, list[npt.NDArray[Any]]]]:
        """The slice of arrays that is meant for one task, of each task that has any: its number, and rows in memory."""
        starts, tasks = (load(self.folder(folder) / name) for name in ("starts", "tasks"))
        slices = starts[:, place : place + 2].tolist()
        for task, ((first, total), (last, _)) in zip(tasks.tolist(), slices, strict=True):
            if first < last:
                found = [np.array(self.load(folder, task, name, checked=False)[first:last]) for name in names]
                check([total], sums(np.array([0, last - first]), *found), self.path(folder, task, names[0]))
                yield task, found

    def write_table(self, path: Path, columns: Mapping[str, Any]) -> Path:
        """A file of Parquet with what it belongs to in its metadata."""
        table = optional("pyarrow", "partitioned").table(columns).replace_schema_metadata(self.plan.metadata)
        path.parent.mkdir(parents=True, exist_ok=True)
        parquet = optional("pyarrow.parquet", "partitioned")
        with replacing(path) as temporary:
            parquet.write_table(table, temporary, compression="none", use_dictionary=False)
        return path

    def drop(self, *folders: str) -> None:
        """Delete what was handed on and is used."""
        for folder in folders:
            shutil.rmtree(self.folder(folder), ignore_errors=True)


def do(function: Callable[..., Left], name: str, store: Store, task: int, **options: Any) -> None:
    """Do a task of a pass. If a file that it mapped has changed since, that is the error, whatever it found there."""
    MAPPED.set(mapped := set[Path]())
    try:
        content, files = function(store, task, **options)
    finally:
        for path in mapped:
            load(path)
    store.notes.keep(name, content, files, task=task)


def load_plan(folder: Path) -> Plan:
    """The plan of a folder; of equal files the one that was read before."""
    path = folder / NAME
    if not path.exists():
        raise FileNotFoundError(f"{folder} has no {NAME}: it was deleted, or no run was begun there")
    state = path.stat()
    return _plan(path, state.st_mtime_ns, state.st_ino)


@lru_cache(maxsize=4)
def _plan(path: Path, modified: int, node: int) -> Plan:
    return Plan.of_json(load_json(path))


def save(path: Path, array: npt.NDArray[Any]) -> Path:
    """An array as a file, which appears when it is complete."""
    path.parent.mkdir(parents=True, exist_ok=True)
    whole = np.ascontiguousarray(array)
    about = {"type": np.lib.format.dtype_to_descr(whole.dtype), "shape": whole.shape, "sum": crc32(whole.data)}
    head = json.dumps(about).encode()
    with replacing(path) as temporary, temporary.open("wb") as file:
        file.write(head.ljust(-(-(len(head) + 1) // ALIGNMENT) * ALIGNMENT - 1) + b"\n")
        file.write(whole.reshape(-1).view(np.uint8).data)  # not tofile(), which does not say why it could not write
    return path


def load(path: Path, *, checked: bool = True) -> npt.NDArray[Any]:
    """An array of a file: its pages come when they are touched, and are shared by all processes of a machine.

    checked: whether its bytes are compared with their CRC-32, once in a process; if not, slices can be, by `sums`.
    """
    array, total = _mapped(path)
    if checked:
        MAPPED.get(set()).add(path)
        state = path.stat()
        _check(path, total, state.st_mtime_ns, state.st_ino)
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


def starts_of(starts: LongArray, *arrays: Any) -> LongArray:
    """Where slices of arrays begin, and the CRC-32 of each, (slices + 1, 2)."""
    return np.column_stack([starts, [*sums(starts, *arrays), 0]])


def check(right: Any, found: Any, path: Path) -> None:
    """Raise ValueError unless the CRC-32 of what was read of a file are as they were when it was written."""
    if not np.array_equal(right, found):
        raise ValueError(damaged(path, "changed"))


@lru_cache(maxsize=4096)
def _check(path: Path, total: int, modified: int, node: int) -> None:
    check(total, crc32(np.ascontiguousarray(_mapped(path)[0]).data), path)


def _mapped(path: Path) -> tuple[npt.NDArray[Any], int]:
    """An array, and its CRC-32 when it was written."""
    try:
        with path.open("rb") as file:
            head = file.readline()
        about = json.loads(head)
        kind = np.lib.format.descr_to_dtype(about["type"])
        return np.memmap(path, kind, "r", len(head), tuple(about["shape"])), about["sum"]
    except FileNotFoundError as error:
        raise ValueError(damaged(path, "deleted")) from error
    except (ValueError, KeyError, TypeError) as error:  # of JSON, of what it should say, and of too few bytes
        raise ValueError(damaged(path, "cut short or changed")) from error


def load_json(path: Path) -> dict[str, Any]:
    """A document."""
    try:
        return dict(json.loads(path.read_text(encoding="utf-8")))
    except FileNotFoundError as error:
        raise ValueError(damaged(path, "deleted")) from error
    except ValueError as error:
        raise ValueError(damaged(path, "cut short or changed")) from error


def damaged(path: Path, how: str) -> str:
    """What to say of a file that is no longer as it was written."""
    return f"{path} was {how} after it was written; {anew()}"
