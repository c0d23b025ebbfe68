"""Where a run keeps what its tasks hand on: names of files in the folder of results and in that of scratch.

results:   plan.json, files.parquet, rows/…, triangles/<part>.parquet, run.json; if the index is kept, points and blocks
made:      all of these but plan.json, until all are there: then they are moved
scratch:   splits.*                         the k-d tree
           spread/<share>.*                 points of a share of the input in the order of partitions
           points/<part>.*                  points of a partition in blocks, their numbers, and the blocks
           blocks/*                         boxes of all blocks, one point of each
           stars/<part>.*                   results for the points of a partition, in the order of numbers
           values/<share>.values            columns of the points that are interpolated, in the order of numbers
           done/<pass>/<task>.json, <pass>.json    notes of tasks, and of passes when all of their tasks are done
"""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._tasks.kept import Kept
from stereodel.partitioned.plan import Plan
from stereodel.partitioned.shards import check, load, save, sums

SCRATCH: Final = "scratch"
"""Folder of results in which runs work, each in a folder of its own."""

DIGITS: Final = 16
"""How many of a digest are the name of such a folder."""

KEPT: Final = "index"
"""Folder of results that has the rooms of the index if it is kept."""

INDEX: Final = ("points", "blocks")
"""Rooms that answers at targets need."""

RESULTS: Final = ("rows", "triangles", "cells")
"""Rooms of Parquet, which are results."""


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
        return cls(folder, folder, folder, Plan.load(folder))

    @property
    def notes(self) -> Kept:
        """What the tasks said when they were done, and the files that they wrote."""
        return Kept(self.scratch / "done")

    def room(self, name: str) -> Path:
        """The folder of what one pass hands on."""
        if name in RESULTS:
            return self.made / name
        return (self.made / KEPT if self.plan.index and name in INDEX else self.scratch) / name

    def shard(self, room: str, number: int, name: str) -> Path:
        """The file of an array that a task hands on."""
        return self.room(room) / f"{number}.{name}"

    def save(self, room: str, number: int, arrays: Mapping[str, npt.NDArray[Any]]) -> list[Path]:
        """Write arrays to files."""
        return [save(self.shard(room, number, name), array) for name, array in arrays.items()]

    def load(self, room: str, number: int, name: str, *, checked: bool = True) -> npt.NDArray[Any]:
        """An array, mapped."""
        return load(self.shard(room, number, name), checked=checked)

    def load_rows(self, room: str, number: int, first: int, last: int, total: int, *names: str) -> list[Any]:
        """The same rows of arrays, in memory, whose CRC-32 was `total`."""
        path = self.shard(room, number, names[0])
        found = [np.array(self.load(room, number, name, checked=False)[first:last]) for name in names]
        check([total], sums(np.array([0, last - first]), *found), path)
        return found

    def drop(self, *rooms: str) -> None:
        """Delete what was handed on and is used."""
        for room in rooms:
            shutil.rmtree(self.room(room), ignore_errors=True)
