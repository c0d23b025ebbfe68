"""Plans: what a run reads, is asked for and cuts into tasks, as all of its workers know it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from functools import cached_property, lru_cache
from itertools import pairwise
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from stereodel._tasks.kept import save_json
from stereodel.partitioned.places import Places
from stereodel.partitioned.shards import load_json
from stereodel.partitioned.sources import PointFile, Source

NAME: Final = "plan.json"
"""Name of the file in the folder of results."""

BLOCK: Final = 256
"""Points of a block at most."""

LARGE_BLOCK: Final = 1024
"""The same where there are more than `LARGE` points: each worker knows the box of every block."""

LARGE: Final = 1_000_000_000
"""Points."""

SHARE: Final = 256
"""Tasks that read a whole set: more are more slices for each partition to collect, fewer are larger than memory."""

LEAST_SHARE: Final = 100_000
"""Rows of a task that reads at least, where partitions are smaller."""

LARGEST_SHARE: Final = 2_500_000
"""Rows of a task that reads at most, about; more would take more memory than the partitions do."""


class Piece(NamedTuple):
    """Rows `first` to `last` of file number `file`."""

    file: int
    first: int
    last: int


@dataclass(frozen=True)
class Question:
    """What is asked at targets, of the points of a run that ended.

    run: its folder, absolute.
    digest: digest of its plan.
    method: nearest points, or how values are interpolated.
    k: number of nearest points; None: the nearest one, without an axis of its own.
    values: columns of the points' files that are interpolated.
    flat: whether the points have no triangles, so that there are no values between them.
    """

    run: str
    digest: str
    method: str
    k: int | None = None
    values: tuple[str, ...] = ()
    flat: bool = False


@dataclass(frozen=True)
class Plan:
    """What a run does; the same of equal files and arguments, so that one that was interrupted goes on.

    version: version of the library.
    carried: columns of the files that are repeated.
    partition: points of a partition, about.
    block: points of a block at most.
    share: rows of a task that reads files, about.
    rows: columns for the points.
    triangles, cells: whether they are written.
    compact: whether files are partitions; None: that is measured.
    index: whether points stay in their partitions, for targets.
    question: what is asked at the points, if they are targets.
    """

    version: str
    files: tuple[PointFile, ...]
    places: Places
    carried: tuple[str, ...]
    partition: int
    block: int
    share: int
    rows: tuple[str, ...]
    triangles: bool
    cells: bool
    compact: bool | None
    index: bool = False
    question: Question | None = None

    @classmethod
    def of(cls, source: Source, *, partition: int, **asked: Any) -> Plan:
        """The plan for a source."""
        size = sum(file.rows for file in source.files)
        return cls(
            files=source.files,
            places=source.places,
            carried=source.carried,
            compact=source.compact,
            partition=partition,
            block=LARGE_BLOCK if size > LARGE else BLOCK,
            share=min(max(partition, size // SHARE, LEAST_SHARE), LARGEST_SHARE),
            **asked,
        )

    def save(self, folder: Path) -> None:
        """Write it into a folder."""
        save_json(folder / NAME, asdict(self))

    @staticmethod
    def load(folder: Path) -> Plan:
        """The plan of a folder; of equal files the one that was read before."""
        path = folder / NAME
        if not path.exists():
            raise FileNotFoundError(f"{folder} has no {NAME}: it was deleted, or no run was begun there")
        state = path.stat()
        return _loaded(path, state.st_mtime_ns, state.st_ino)

    @cached_property
    def digest(self) -> str:
        """Of everything in it: SHA-256, as text."""
        return hashlib.sha256(json.dumps(asdict(self), sort_keys=True).encode()).hexdigest()

    @property
    def metadata(self) -> dict[str, str]:
        """What files of a run say of it."""
        told = {"version": self.version, "digest": self.digest, "points": self.size, "surface": self.places.surface}
        return {f"stereodel.{name}": str(value) for name, value in told.items()}

    @cached_property
    def firsts(self) -> npt.NDArray[np.int64]:
        """Number of the first row of each file, and of all rows at the end, (files + 1,)."""
        return np.concatenate([[0], np.cumsum([file.rows for file in self.files], dtype=np.int64)])

    @property
    def size(self) -> int:
        """Number of points."""
        return int(self.firsts[-1])

    @property
    def number_type(self) -> npt.DTypeLike:
        """What numbers of points are stored as between the passes."""
        return np.uint32 if self.size < np.iinfo(np.uint32).max else np.int64

    @cached_property
    def parts(self) -> tuple[tuple[Piece, ...], ...]:
        """Rows that follow one another, as partitions if the files are compact."""
        return _cut(self.files, self.partition)

    @cached_property
    def shares(self) -> tuple[tuple[Piece, ...], ...]:
        """Rows that follow one another, as tasks that read or write files."""
        return _cut(self.files, self.share)

    @property
    def told(self) -> tuple[str, ...]:
        """Columns for every point; which ones are kept in place of others is given for duplicates only."""
        return tuple(name for name in self.rows if name != "kept")

    @cached_property
    def share_firsts(self) -> npt.NDArray[np.int64]:
        """Number of the first row of each share, and of all rows at the end, (shares + 1,)."""
        return np.array([*(self.first_of(pieces) for pieces in self.shares), self.size], dtype=np.int64)

    @cached_property
    def outputs(self) -> tuple[tuple[int, ...], ...]:
        """Shares whose rows are written together: those of one large file, or one of whole files."""
        lots: list[list[int]] = []
        for share, pieces in enumerate(self.shares):
            if pieces[0].first:
                lots[-1].append(share)
            else:
                lots.append([share])
        return tuple(map(tuple, lots))

    def first_of(self, pieces: Sequence[Piece]) -> int:
        """Number of the first point of pieces."""
        return int(self.firsts[pieces[0].file]) + pieces[0].first

    def differs(self, other: Plan) -> str:
        """What another plan has otherwise, in words; empty if nothing."""
        mine, its = {file.name: file for file in self.files}, {file.name: file for file in other.files}
        for name in [*mine, *(name for name in its if name not in mine)]:
            if name not in its:
                return f"{name} is missing"
            if name not in mine:
                return f"{name} was not there"
            if mine[name] != its[name]:
                return f"{mine[name].path} has changed since"
        for name in (field.name for field in fields(self) if field.name != "files"):
            if getattr(self, name) != getattr(other, name):
                return f"{name} was {getattr(self, name)}, and is {getattr(other, name)}"
        return "" if self == other else "files are in another order"


@lru_cache(maxsize=4)
def _loaded(path: Path, modified: int, node: int) -> Plan:
    told = load_json(path)
    files = tuple(PointFile(**file) for file in told.pop("files"))
    places = told.pop("places")
    places = Places(**places | {"names": tuple(places["names"])})
    question = told.pop("question")
    return Plan(
        files=files,
        places=places,
        question=question and Question(**question | {"values": tuple(question["values"])}),
        **told | {name: tuple(told[name]) for name in ("carried", "rows")},
    )


def _cut(files: Sequence[PointFile], size: int) -> tuple[tuple[Piece, ...], ...]:
    """Rows of files in order, in lots of about `size`: small files grouped, large ones cut evenly.

    A file that is not half as large again is not cut: its rows may lie anywhere in it.

    >>> files = [PointFile("", str(k), rows, 0, 0) for k, rows in enumerate([9, 2, 2, 0, 5])]
    >>> for lot in _cut(files, 4):
    ...     print(*map(tuple, lot))
    (0, 0, 4)
    (0, 4, 9)
    (1, 0, 2) (2, 0, 2)
    (4, 0, 5)
    """
    lots: list[list[Piece]] = []
    room = 0
    for number, file in enumerate(files):
        count = (2 * file.rows + size) // (2 * size)
        if count > 1:
            bounds = [file.rows * k // count for k in range(count + 1)]
            lots += [[Piece(number, a, b)] for a, b in pairwise(bounds)]
            room = 0
        elif file.rows:
            if file.rows > room:
                lots.append([])
                room = size
            lots[-1].append(Piece(number, 0, file.rows))
            room -= file.rows
    return tuple(map(tuple, lots))
