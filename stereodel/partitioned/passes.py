"""Passes: the tasks of a run one kind after another, over an executor, and what they leave in a folder.

The last pass aligns: it writes results for points into files with the rows of the input's files, in their order.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import as_count
from stereodel._extras import optional
from stereodel._tasks.crew import Crew
from stereodel._tasks.kept import Note, locked, save_json
from stereodel._tasks.progress import Progress
from stereodel._tasks.whole_files import ENDING, replacing
from stereodel.io.formats.names import anew
from stereodel.partitioned import spread
from stereodel.partitioned.files import Source, opened, slices, unchanged
from stereodel.partitioned.plan import NAME, Plan, RowRange
from stereodel.partitioned.store import (
    DIGITS,
    KEPT,
    RESULTS,
    SCRATCH,
    Columns,
    Left,
    Store,
    damaged,
    do,
    load,
    load_json,
    load_plan,
)

REPORT: Final = "run.json"
"""Name of the file that describes a run; it is written last."""

FILES: Final = "files.parquet"
"""Name of the file that maps rows to files."""

ATTEMPTS: Final = 4
"""How often tasks of a pass are begun whose files are deleted by someone else while the run works."""

NONE: Final = {"part": 0, "triangles": 0}
"""The partition of a run without points."""


@dataclass(frozen=True)
class Execution:
    """How a run in partitions is computed: by whom, where, in portions of how many points.

    Parameters
    ----------
    partition : int
        Points of a partition, about. Half a million to a million are right; more take more memory, fewer read more
        points beside their own. By default some 0.3 GB for each worker.
    limit : int
        Points that a worker may triangulate at once; some 500 bytes each.
    executor : concurrent.futures.Executor, optional
        The workers, such as those of ``client.get_executor(pure=False)`` of a client of Dask or an ``MPIPoolExecutor``
        of mpi4py. They must see the folders of results and scratch. By default processes of this machine.
    jobs : int, optional
        Number of these processes, by default one for each processor; with 1 all is done in the process that calls.
    scratch : path-like, optional
        A folder for what passes hand on, at most 80 bytes a point, deleted when it is used; by default in the folder of
        results.
    resume : bool
        Whether a run that was interrupted goes on, or the results of one that ended are kept. Otherwise all that it
        left is deleted first.
    progress : callable, optional
        Called with the name of a pass, the number of its tasks that are done, and that of all of them.

    Raises
    ------
    ValueError, TypeError
        If `partition`, `limit` or `jobs` is not a whole number from 1.

    Examples
    --------
    >>> from stereodel.partitioned import Execution
    >>> Execution(partition=100_000, jobs=2).limit
    8000000
    """

    partition: int = 650_000
    limit: int = 8_000_000
    executor: Executor | None = None
    jobs: int | None = None
    scratch: str | os.PathLike[str] | None = None
    resume: bool = True
    progress: Progress | None = None

    def __post_init__(self) -> None:
        for name in ("partition", "limit", "jobs"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, as_count(getattr(self, name), name))


@dataclass(frozen=True)
class Results:
    """Files of rows in a folder, aligned with those that were read."""

    folder: Path

    def __post_init__(self) -> None:
        object.__setattr__(self, "folder", Path(self.folder))
        if not (self.folder / REPORT).is_file():
            raise FileNotFoundError(f"{self.folder} has no {REPORT}: no run ended there")

    @property
    def statistics(self) -> dict[str, Any]:
        """Numbers of the whole run."""
        return dict(load_json(self.folder / REPORT)["statistics"])

    @property
    def partitions(self) -> list[dict[str, Any]]:
        """Numbers of each partition."""
        return list(load_json(self.folder / REPORT)["partitions"])

    def rows(self) -> Any:
        """Results in the order of the rows that were read: a dataset of pyarrow, with a file for each file of them."""
        return self._dataset("rows")

    def _dataset(self, folder: str) -> Any:
        plan = load_plan(self.folder)
        if not getattr(plan, folder):
            raise ValueError(f"{self.folder} has no {folder}: the run was not asked for {folder}=")
        names = planned(plan, self.partitions)
        paths = [str(self.folder / name) for name in names if name.startswith(f"{folder}/")]
        return optional("pyarrow.dataset", "partitioned").dataset(paths, format="parquet")


def planned(plan: Plan, partitions: Sequence[Mapping[str, Any]]) -> dict[str, int]:
    """Files of Parquet that a run leaves, relative to its folder, and how many rows they have."""
    files = {f"rows/{file.name}": file.rows for file in plan.files if plan.rows}
    for kind in ("triangles", "cells"):
        if getattr(plan, kind):
            parts = partitions or ([NONE] if kind == "triangles" else [])
            files |= {f"{kind}/{each['part']}.parquet": each[kind] for each in parts}
    return files


def check_results(folder: Path, plan: Plan, partitions: Sequence[Mapping[str, Any]]) -> None:
    """Raise ValueError unless the files of results are those of the plan, by names, numbers of rows and digest."""
    wanted = {folder / name: rows for name, rows in planned(plan, partitions).items()}
    for path, rows in wanted.items():
        if not path.exists():
            raise ValueError(damaged(path, "deleted"))
        with opened(path) as content:
            digest = (content.metadata.metadata or {}).get(b"stereodel.digest", b"").decode()
            if (content.metadata.num_rows, digest) != (rows, plan.digest):
                raise ValueError(damaged(path, "changed"))
    for kind in RESULTS:
        for path in (folder / kind).rglob("*.parquet"):
            if path not in wanted and path.name[0] not in "._":
                raise ValueError(f"{path} is not of the run that wrote the files beside it; move it elsewhere")


def execute(
    results: Callable[[Passes, list[int]], Answer],
    source: Source,
    plan: Plan,
    out: str | os.PathLike[str],
    execution: Execution,
) -> Path:
    """Do what a plan says, or what is left of it; the folder of results."""
    folder, scratch = Path(out).absolute(), execution.scratch
    real = Path(os.path.realpath(folder))
    for file in source.files:
        if Path(file.path).is_relative_to(folder) or Path(os.path.realpath(file.path)).is_relative_to(real):
            raise ValueError(f"{file.path} lies in out, the folder of results; take another folder")
    folder.mkdir(parents=True, exist_ok=True)
    store = Store.of(folder, None if scratch is None else Path(scratch).absolute(), plan)
    with locked(folder):
        _begin(store, execution.resume)
        if not (folder / REPORT).exists():
            with Crew(execution.jobs, executor=execution.executor) as crew:
                Passes(results, store, crew, execution.limit, execution.progress or (lambda *_: None)).run()
            if not (folder / NAME).exists():  # deleted meanwhile
                plan.save(folder)
            for path in store.made.rglob(f".*{ENDING}"):  # of processes that were killed
                path.unlink(missing_ok=True)
            for name in sorted(os.listdir(store.made), key=REPORT.__eq__):  # the report last: all are there
                os.replace(store.made / name, folder / name)
        else:
            check_results(folder, plan, load_json(folder / REPORT)["partitions"])
        _clear(store)
    return folder


def _begin(store: Store, resume: bool) -> None:
    """Note what is to be done, or find that it was noted before."""
    folder = store.results
    plan, report = folder / NAME, folder / REPORT
    results = [report, *(folder / name for name in (FILES, *RESULTS, KEPT))]
    is_ours = report.is_file() and b'"stereodel.digest"' in report.read_bytes()
    if not resume and (plan.exists() or is_ours):
        with suppress(OSError, ValueError, TypeError, KeyError):  # its plan is lost or damaged
            shutil.rmtree(Store.of(folder, store.scratch.parent, load_plan(folder)).scratch)
        _clear(store)
        _delete(*results, plan)  # the plan last: what has one is a run's
    there = [path for path in results if path.exists()]
    if plan.exists():
        other = load_plan(folder).differs(store.plan)
        if other:
            what = f"{folder} has a run of other files or arguments: {other}"
            raise ValueError(f"{what}; take another folder, or {anew()}")
        if not report.exists() and not (store.made / REPORT).exists():
            _delete(*results)  # what an earlier deletion left, when it was interrupted
    elif there and is_ours:
        raise ValueError(damaged(plan, "deleted"))
    elif there:
        raise ValueError(f"{folder} has {there[-1].name!r}, which is not of a run; take another folder")
    else:
        store.plan.save(folder)


def _delete(*paths: Path) -> None:
    for path in paths:
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)


def _clear(store: Store) -> None:
    """Delete what this run and those before it, which are dead, left beside the results."""
    shutil.rmtree(store.scratch, ignore_errors=True)
    own = store.results / SCRATCH
    for path in own.glob("[0-9a-f]" * DIGITS):
        shutil.rmtree(path, ignore_errors=True)
    for name in (NAME, REPORT):
        for path in store.results.glob(f".{name}.*{ENDING}"):
            path.unlink(missing_ok=True)
    with suppress(OSError):  # it is not empty
        own.rmdir()


def align(store: Store, output: int) -> Left:
    """The files of some shares of the input."""
    pieces = groupby(_pieces(store, output), lambda piece: piece[0].file)
    return {}, [write_file(store, file, found) for file, found in pieces]


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
            arrays: dict[str, Any] = {}
            for name, column in columns.items():  # rows with several numbers are lists of a fixed size
                flat, lists = pyarrow.array(column.ravel()), pyarrow.FixedSizeListArray
                arrays[name] = flat if column.ndim == 1 else lists.from_arrays(flat, column.shape[1])
            if plan.carried:
                with unchanged(source) as content:
                    found = [table for _, table in slices(content, plan.carried, rows.first, rows.last)]
                table = pyarrow.concat_tables(found).combine_chunks()
                arrays |= {name: table[name] for name in plan.carried}
            out.write_table(pyarrow.table([arrays[name] for name in schema.names], schema=schema))
    return path


Answer = tuple[dict[str, Any], list[Note]]
"""Statistics of all partitions, and the note of each."""


@dataclass(frozen=True)
class Passes:
    """The passes of a run, one after another; those that were done before are not done again."""

    results: Callable[[Passes, list[int]], Answer]  # of the partitions that have points
    store: Store
    crew: Crew
    limit: int
    progress: Progress

    def run(self) -> None:
        """All of them, and the report, when all files are as they should be."""
        store, plan = self.store, self.store.plan
        if (store.made / REPORT).exists():
            return
        compact, parts = self._collected() if plan.size else (True, [])
        statistics, notes = self.results(self, parts)
        if plan.rows:
            self.do("align", align, range(len(plan.outputs)))
            for number, file in enumerate(plan.files):
                if not file.rows:
                    write_file(store, number, [])
            store.drop("stars")
        _write_files(store)
        partitions = [{"part": note["task"], **note} for note in notes]
        for each in partitions:
            del each["files"], each["task"]
        for file in plan.files:
            file.check()
        check_results(store.made, plan, partitions)
        numbers = {"statistics": statistics | {"compact": compact}, "partitions": partitions}
        save_json(store.made / REPORT, plan.metadata | numbers)

    def do(self, name: str, function: Callable[..., Left], tasks: Sequence[int], **options: Any) -> list[Note]:
        """The notes of the tasks of a pass, in order; noted at the end, as what they wrote may be deleted then.

        What counts is what they left on the disk: a task whose files are gone is done again.
        """
        work = partial(do, function, name, self.store, **options)
        return list(self.store.notes.once(name, lambda: {"notes": self._done(name, work, tasks)})["notes"])

    def _done(self, name: str, work: Callable[[int], None], tasks: Sequence[int]) -> list[Note]:
        notes = self.store.notes
        for attempt in range(ATTEMPTS):
            found = {task: note for task in tasks if (note := notes.note(name, task)) is not None}
            left = [task for task in tasks if task not in found]
            if left or not attempt:
                self.progress(name, len(found), len(tasks))
            if not left:
                return list(found.values())
            for done, (_, outcome) in enumerate(self.crew.each(work, left), len(found) + 1):
                outcome.value()
                self.progress(name, done, len(tasks))
        raise ValueError(f"{notes.path(name, left[0])} or files in it are deleted while the run works there")

    def _collected(self) -> tuple[bool, list[int]]:
        """Points in partitions: whether those are files, and which of them have points."""
        store, plan = self.store, self.store.plan
        compact = bool(store.notes.once("layout", lambda: {"compact": self._is_laid_out()})["compact"])
        store.drop("sample")
        if compact:
            notes = self.do("collect", spread.take, range(len(plan.parts)))
        else:
            if store.notes.note("collect") is None:
                self.do("spread", spread.spread, range(len(plan.shares)))
                store.gather("spread", range(len(plan.shares)))
            notes = self.do("collect", spread.collect, range(len(load(store.scratch / "splits")) + 1))
            store.drop("spread")
        return compact, [note["task"] for note in notes if note["points"]]

    def _is_laid_out(self) -> bool:
        """Whether files are partitions."""
        count = len(self.store.plan.parts)
        if self.store.plan.compact or count == 1:
            return True
        self.do("sample", spread.sample, range(count))
        return spread.is_laid_out(self.store)


def totals(notes: Sequence[Note]) -> dict[str, Any]:
    """Numbers of all partitions: what their rounds read."""
    return {
        "partitions": len(notes),
        "rounds": max((note["rounds"] for note in notes), default=0),
        "read": sum(note["read"] for note in notes),
        "largest": max((note["largest"] for note in notes), default=0),
        "cpu": sum(note["cpu"] for note in notes),
    }


def _write_files(store: Store) -> None:
    """Which numbers the points of each file have."""
    files, pyarrow = store.plan.files, optional("pyarrow", "partitioned")
    columns: dict[str, Any] = {
        "path": pyarrow.array([file.path for file in files], pyarrow.string()),
        "rows_file": pyarrow.array([file.name for file in files], pyarrow.string()),
        "first": store.plan.firsts[:-1],
    }
    for name in ("rows", "size", "modified"):
        columns[name] = np.array([getattr(file, name) for file in files], dtype=np.int64)
    store.write_table(store.made / FILES, columns)
