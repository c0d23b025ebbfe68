"""Where a run keeps what its tasks hand on: names of files in the folder of results and in that of scratch.

results:   plan.json, files.parquet, rows/…, triangles/<part>.parquet, run.json; if the index is kept, points and blocks
scratch:   splits.*.npy                     the k-d tree
           spread/<share>.*.npy             points of a share of the input in the order of partitions
           points/<part>.*.npy              points of a partition in blocks, their numbers, and the blocks
           blocks/*.npy                     boxes of all blocks, one point of each
           cells/<part>.*.npy               results for the points of a partition, in the order of numbers
           values/<share>.values.npy        columns of the points that are interpolated, in the order of numbers
           done/<pass>/<task>.json          what a task said when it was done, and the files that it wrote
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy.typing as npt

from stereodel.partitioned.plan import Plan
from stereodel.partitioned.shards import load, load_json, load_rows, save, save_json

KEPT: Final = "index"
"""Folder of results that has the rooms of the index if it is kept."""

INDEX: Final = ("points", "blocks")
"""Rooms that answers at targets need."""


@dataclass(frozen=True)
class Store:
    """The two folders of a run.

    Parameters
    ----------
    results, scratch : Path
        All workers see both.
    """

    results: Path
    scratch: Path

    @cached_property
    def plan(self) -> Plan:
        """What the run does."""
        return Plan.load(self.results)

    def room(self, name: str) -> Path:
        """The folder of what one pass hands on."""
        return (self.results / KEPT if self.plan.index and name in INDEX else self.scratch) / name

    def shard(self, room: str, number: int, name: str) -> Path:
        """The file of an array that a task hands on."""
        return self.room(room) / f"{number}.{name}.npy"

    def save(self, room: str, number: int, arrays: Mapping[str, npt.NDArray[Any]]) -> dict[str, int]:
        """Write arrays; how large their files are by name."""
        for name, array in arrays.items():
            save(self.shard(room, number, name), array)
        paths = [self.shard(room, number, name) for name in arrays]
        return {f"{room}/{path.name}": path.stat().st_size for path in paths}

    def load(self, room: str, number: int, name: str) -> npt.NDArray[Any]:
        """An array, mapped."""
        return load(self.shard(room, number, name))

    def load_rows(self, room: str, number: int, name: str, first: int, last: int) -> npt.NDArray[Any]:
        """Rows of an array, in memory."""
        return load_rows(self.shard(room, number, name), first, last)

    def drop(self, *rooms: str) -> None:
        """Delete what was handed on and is used."""
        for room in rooms:
            shutil.rmtree(self.room(room), ignore_errors=True)

    def done(self, name: str, task: int) -> dict[str, Any] | None:
        """What a task of a pass said; None if it was not done, or what it wrote is not there as it was."""
        path = self._marker(name, task)
        if not path.exists():
            return None
        told = load_json(path)
        return told if all(self._is_whole(file, size) for file, size in told["files"].items()) else None

    def _is_whole(self, file: str, size: int) -> bool:
        room, name = file.split("/")
        path = self.room(room) / name
        return path.exists() and path.stat().st_size == size

    def keep(self, name: str, task: int, told: dict[str, Any], files: Mapping[str, int]) -> dict[str, Any]:
        """Note that a task is done: what it said and the files, with their sizes, that it wrote for others."""
        whole = told | {"task": task, "files": dict(files)}
        save_json(self._marker(name, task), whole)
        return whole

    def _marker(self, name: str, task: int) -> Path:
        return self.scratch / "done" / name / f"{task}.json"
