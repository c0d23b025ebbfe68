"""Plans: what a run reads, computes and cuts into tasks, as all of its workers know it."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Collection, Sequence
from dataclasses import asdict, dataclass, fields, replace
from functools import cached_property
from itertools import pairwise, zip_longest
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
import numpy.typing as npt

import stereodel
from stereodel._arrays import as_choice
from stereodel._tasks.kept import save_json
from stereodel.io.formats.names import listed, spelled
from stereodel.partitioned.files import (
    FilesGiven,
    PointColumns,
    PointFile,
    Source,
    Surface,
    names_of,
    opened,
    parquet_source,
)
from stereodel.partitioned.hats import hats_source, is_catalogue
from stereodel.sphere.latitudes import Latitude

ROWS: Final[dict[str, npt.DTypeLike]] = {
    "area": np.float64,
    "degree": np.int32,
    "nearest": np.int64,
    "distance": np.float64,
    "kept": np.int64,
}
"""Results for points, and their types."""

KINDS: Final = {"parquet": parquet_source, "hats": hats_source}
"""What makes a source of what is given, of columns, surface and latitude, by the kind of files."""

NAME: Final = "plan.json"
"""Name of the file in the folder of results."""

BLOCK: Final = 256
"""Points of a block at most."""

LEAST_SHARE: Final = 100_000
"""Rows of a task that reads at least, where partitions are smaller."""

LARGEST_SHARE: Final = 2_500_000
"""Rows of a task that reads at most, about; more would take more memory than the partitions do."""


class RowRange(NamedTuple):
    """Rows `first` to `last` of file number `file`."""

    file: int
    first: int
    last: int


@dataclass(frozen=True)
class Question:
    """What to compute at targets, from the points of a run that ended."""

    run: str  # its folder, absolute
    digest: str  # of its plan
    method: str  # nearest points, or how values are interpolated
    k: int | None = None  # number of nearest points; None: the nearest one, without an axis of its own
    values: tuple[str, ...] = ()  # columns of the points' files that are interpolated
    flat: bool = False  # the points have no triangles, so that there are values at them alone


@dataclass(frozen=True)
class Plan:
    """What a run does; the same of equal files and arguments, so that one that was interrupted goes on."""

    version: str  # of the library
    files: tuple[PointFile, ...]
    columns: PointColumns  # that say where points are
    carried: tuple[str, ...]  # columns of the files that are repeated
    compact: bool | None  # whether files are partitions; None: that is measured
    partition: int  # points of a partition, about
    rows: tuple[str, ...]  # columns of results for the points
    triangles: bool = False  # whether they are written, as cells are
    cells: bool = False
    index: bool = False  # whether points stay in their partitions, for targets
    question: Question | None = None  # what is computed at the points, if they are targets
    block: int = 0  # points of a block at most
    share: int = 0  # rows of a task that reads files, about

    @classmethod
    def of(cls, source: Source, **options: Any) -> Plan:
        """The plan for a source."""
        plan = cls(stereodel.__version__, source.files, source.columns, source.carried, source.compact, **options)
        # More than 256 tasks are more slices for each partition to collect, fewer are larger than memory.
        share = min(max(plan.partition, plan.size // 256, LEAST_SHARE), LARGEST_SHARE)
        # Each worker knows the box of every block: of many points they are larger.
        return replace(plan, block=1024 if plan.size > 1_000_000_000 else BLOCK, share=share)

    def save(self, folder: Path) -> None:
        """Write it into a folder."""
        save_json(folder / NAME, asdict(self))

    @classmethod
    def of_json(cls, given: dict[str, Any]) -> Plan:
        """The plan that a document holds."""
        files = tuple(PointFile(**file) for file in given["files"])
        question = given["question"] and Question(**_with_tuples(given["question"]))
        parts = {"files": files, "columns": PointColumns(**_with_tuples(given["columns"])), "question": question}
        return cls(**_with_tuples(given | parts))

    @cached_property
    def digest(self) -> str:
        """Of everything in it: SHA-256, as text."""
        return hashlib.sha256(json.dumps(asdict(self), sort_keys=True).encode()).hexdigest()

    @property
    def metadata(self) -> dict[str, str]:
        """What files of a run say of it."""
        about = {"version": self.version, "digest": self.digest, "points": self.size, "surface": self.columns.surface}
        return {f"stereodel.{name}": str(value) for name, value in about.items()}

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
    def row_kinds(self) -> dict[str, np.dtype[Any]]:
        """Types of the columns of rows: of numbers, or of a fixed number of them."""
        if self.question is not None and self.question.values:
            return {name: np.dtype(np.float64) for name in self.rows}
        shape = () if self.question is None or self.question.k is None else (self.question.k,)
        return {name: np.dtype((ROWS[name], shape)) for name in self.rows}

    @property
    def row_names(self) -> tuple[str, ...]:
        """Columns that tasks hand on for each point; `kept` is handed on for duplicates only."""
        return tuple(name for name in self.rows if name != "kept")

    @cached_property
    def row_type(self) -> np.dtype[np.void]:
        """What a task hands on of a point: its number and these."""
        kinds = self.row_kinds
        if self.question is None and "nearest" in kinds and self.size <= np.iinfo(np.int32).max:
            kinds = kinds | {"nearest": np.dtype(np.int32)}  # a number of a point or -1
        return np.dtype([("number", self.number_type), *((name, kinds[name]) for name in self.row_names)])

    @cached_property
    def parts(self) -> tuple[tuple[RowRange, ...], ...]:
        """Rows that follow one another, as partitions if the files are compact."""
        return _cut(self.files, self.partition)

    @cached_property
    def shares(self) -> tuple[tuple[RowRange, ...], ...]:
        """Rows that follow one another, as tasks that read or write files."""
        return _cut(self.files, self.share)

    @cached_property
    def share_firsts(self) -> npt.NDArray[np.int64]:
        """Number of the first row of each share, and of all rows at the end, (shares + 1,)."""
        return np.array([*map(self.first_of, self.shares), self.size], dtype=np.int64)

    @cached_property
    def outputs(self) -> tuple[tuple[int, ...], ...]:
        """Shares whose rows are written together: those of one large file, or one of whole files."""
        groups: list[list[int]] = []
        for share, ranges in enumerate(self.shares):
            if not ranges[0].first:
                groups.append([])
            groups[-1].append(share)
        return tuple(map(tuple, groups))

    def first_of(self, ranges: Sequence[RowRange]) -> int:
        """Number of the first point of some ranges of rows."""
        return int(self.firsts[ranges[0].file]) + ranges[0].first

    def differs(self, other: Plan) -> str:
        """What another plan has otherwise, in words; empty if nothing."""
        for mine, its in zip_longest(self.files, other.files):
            if mine != its:
                return f"{(mine or its).path} is new, missing or has changed since"
        names = (field.name for field in fields(self) if getattr(self, field.name) != getattr(other, field.name))
        return next((f"{name} was {getattr(self, name)}, and is {getattr(other, name)}" for name in names), "")


def _with_tuples(given: dict[str, Any]) -> dict[str, Any]:
    return {name: tuple(value) if isinstance(value, list) else value for name, value in given.items()}


def _cut(files: Sequence[PointFile], size: int) -> tuple[tuple[RowRange, ...], ...]:
    """Rows of files in order, in tasks of about `size`: small files grouped, those half as large again cut evenly."""
    tasks: list[list[RowRange]] = []
    room = 0
    for number, file in enumerate(files):
        count = (2 * file.rows + size) // (2 * size)
        if count > 1:
            bounds = [file.rows * k // count for k in range(count + 1)]
            tasks += [[RowRange(number, a, b)] for a, b in pairwise(bounds)]
            room = 0
        elif file.rows:
            if file.rows > room:
                tasks.append([])
                room = size
            tasks[-1].append(RowRange(number, 0, file.rows))
            room -= file.rows
    return tuple(map(tuple, tasks))


def source_of(
    given: FilesGiven,
    kind: str,
    columns: Sequence[str] | None,
    surface: Surface,
    latitude: Latitude,
    keep: Sequence[str],
    results: Collection[str],
) -> Source:
    """The source that is given, of a kind or of the one that it looks like, with the columns that are carried along."""
    chosen = as_choice(kind, ("auto", *KINDS), "kind")
    if chosen == "auto":
        chosen = "hats" if is_catalogue(given) else "parquet"
    source = KINDS[chosen](given, names_of(columns), surface, latitude)
    nodes: dict[tuple[int, int], PointFile] = {}
    for file in source.files:
        state = os.stat(file.path)
        other = nodes.setdefault((state.st_dev, state.st_ino), file)
        if other is not file:
            twice = f"a file twice, as {other.path} and {file.path}"
            raise ValueError(f"source names {twice}; its points would be duplicates of themselves")
    carried = names_of(keep) or ()
    schemas = [(file.path, opened(file.path).schema_arrow) for file in source.files if carried]
    for name in carried:
        if name in results:
            raise ValueError(f"column {name!r} cannot be kept: results have that name; rename it in the files")
        for path, schema in schemas:
            if name not in schema.names:
                raise ValueError(
                    f"{spelled('keep')} has {name!r}, which is not one of the columns {listed(schema.names)} of {path}"
                )
            types = [each.field(name).type for each in (schemas[0][1], schema)]
            if types[0] != types[1]:
                both = f"{types[0]} in {schemas[0][0]}, but {types[1]} in {path}"
                raise ValueError(f"{spelled('keep')} has {name!r}, which is {both}; give it one type")
    return replace(source, carried=carried)
