"""Passes: the tasks of a run one kind after another, over an executor, and what they leave in a folder."""

from __future__ import annotations

import os
import shutil
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import as_count
from stereodel._extras import optional
from stereodel._files import ENDING
from stereodel._tasks.crew import Crew
from stereodel._tasks.kept import Note, locked, save_json
from stereodel._tasks.progress import Progress
from stereodel.partitioned import rows as rows_of
from stereodel.partitioned import spread
from stereodel.partitioned.plan import NAME, Plan
from stereodel.partitioned.shards import anew, load_json, save
from stereodel.partitioned.solve import write_table
from stereodel.partitioned.sources import Source, opened
from stereodel.partitioned.store import DIGITS, KEPT, RESULTS, SCRATCH, Store
from stereodel.partitioned.tree import Splits, is_compact

PARTITION: Final = 650_000
"""Points of a partition by default: some 0.3 GB for each worker."""

LIMIT: Final = 8_000_000
"""Points that a worker may read at once by default: some 4 GB."""

REPORT: Final = "run.json"
"""Name of the file that describes a run; it is written last."""

FILES: Final = "files.parquet"
"""Name of the file that maps rows to files."""

ATTEMPTS: Final = 4
"""How often tasks of a pass are begun whose files are deleted by someone else while the run works."""

NONE: Final = {"part": 0, "triangles": 0}
"""The partition of a run without points."""


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

    def _dataset(self, room: str) -> Any:
        plan = Plan.load(self.folder)
        if not getattr(plan, room):
            raise ValueError(f"{self.folder} has no {room}: the run was not asked for {room}=")
        names = planned(plan, self.partitions)
        paths = [str(self.folder / name) for name in names if name.startswith(f"{room}/")]
        return optional("pyarrow.dataset", "partitioned").dataset(paths, format="parquet")


def planned(plan: Plan, partitions: Sequence[Mapping[str, Any]]) -> dict[str, int]:
    """Files of Parquet that a run leaves, relative to its folder, and how many rows they have."""
    files = {f"rows/{file.name}": file.rows for file in plan.files if plan.rows}
    for room in ("triangles", "cells"):
        if getattr(plan, room):
            parts = partitions or ([NONE] if room == "triangles" else [])
            files |= {f"{room}/{each['part']}.parquet": each[room] for each in parts}
    return files


def check_results(folder: Path, plan: Plan, partitions: Sequence[Mapping[str, Any]]) -> None:
    """Raise ValueError unless the files of results are those of the plan, by names, numbers of rows and digest."""
    wanted = {folder / name: rows for name, rows in planned(plan, partitions).items()}
    for path, rows in wanted.items():
        if not path.exists():
            raise ValueError(f"{path} was deleted after it was written; {anew()}")
        with opened(path) as content:
            told = (content.metadata.metadata or {}).get(b"stereodel.digest", b"").decode()
            if (content.metadata.num_rows, told) != (rows, plan.digest):
                raise ValueError(f"{path} was changed after it was written; {anew()}")
    for room in RESULTS:
        for path in (folder / room).rglob("*.parquet"):
            if path not in wanted and path.name[0] not in "._":
                raise ValueError(f"{path} is not of the run that wrote the files beside it; move it elsewhere")


@dataclass(frozen=True)
class Means:
    """Who computes, in which folders, and who hears of progress.

    out: folder of results.
    limit: points that a worker may read at once.
    executor, jobs, scratch, resume, progress: as in `triangulate`.
    """

    out: str | os.PathLike[str]
    limit: int
    executor: Executor | None
    jobs: int | None
    scratch: str | os.PathLike[str] | None
    resume: bool
    progress: Progress | None

    def run(self, kind: type[Passes], source: Source, plan: Plan) -> Path:
        """Do what a plan says, or what is left of it; the folder of results."""
        folder, limit = Path(self.out).absolute(), as_count(self.limit, "limit")
        jobs = None if self.jobs is None else as_count(self.jobs, "jobs")
        _refuse_within(folder, source)
        folder.mkdir(parents=True, exist_ok=True)
        store = Store.of(folder, None if self.scratch is None else Path(self.scratch).absolute(), plan)
        with locked(folder):
            _begin(store, self.resume)
            if not (folder / REPORT).exists():
                with Crew(jobs, executor=self.executor) as crew:
                    kind(store, crew, limit, self.progress).run()
                _publish(store)
            else:
                check_results(folder, plan, load_json(folder / REPORT)["partitions"])
            _clear(store)
        return folder


def _refuse_within(folder: Path, source: Source) -> None:
    real = Path(os.path.realpath(folder))
    for file in source.files:
        if Path(file.path).is_relative_to(folder) or Path(os.path.realpath(file.path)).is_relative_to(real):
            raise ValueError(f"{file.path} lies in out, the folder of results; take another folder")


def _begin(store: Store, resume: bool) -> None:
    """Note what is to be done, or find that it was noted before."""
    folder = store.results
    noted, left = (folder / NAME).exists(), [folder / name for name in (REPORT, FILES, *RESULTS, KEPT)]
    if not resume and (noted or _is_report(folder / REPORT)):
        with suppress(OSError, ValueError, TypeError, KeyError):  # its plan is lost or damaged
            shutil.rmtree(Store.of(folder, store.scratch.parent, Plan.load(folder)).scratch)
        _clear(store)
        _delete(*left, folder / NAME)  # the plan last: what has one is a run's
        noted = False
    if noted:
        other = Plan.load(folder).differs(store.plan)
        if other:
            raise ValueError(
                f"{folder} has a run of other files or arguments: {other}; take another folder, or {anew()}"
            )
        if not (folder / REPORT).exists() and not (store.made / REPORT).exists():
            _delete(*left)  # what an earlier deletion left, when it was interrupted
        return
    there = [path for path in left if path.exists()]
    if there and _is_report(folder / REPORT):
        raise ValueError(f"{folder / NAME} was deleted after it was written; {anew()}")
    if there:
        raise ValueError(f"{folder} has {there[-1].name!r}, which is not of a run; take another folder")
    store.plan.save(folder)


def _is_report(path: Path) -> bool:
    return path.is_file() and b'"stereodel.digest"' in path.read_bytes()


def _delete(*paths: Path) -> None:
    for path in paths:
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)


def _publish(store: Store) -> None:
    """Move what was made into the folder of results, the report last: one that is there says that all are."""
    if not (store.results / NAME).exists():  # deleted meanwhile
        store.plan.save(store.results)
    for path in store.made.rglob(f".*{ENDING}"):  # of processes that were killed
        path.unlink(missing_ok=True)
    for name in sorted(os.listdir(store.made), key=REPORT.__eq__):
        os.replace(store.made / name, store.results / name)


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


@dataclass(frozen=True)
class Passes(ABC):
    """The passes of a run, one after another; those that were done before are not done again.

    A kind of run is a subclass that says in `results` what is done with partitions.
    """

    store: Store
    crew: Crew
    limit: int
    progress: Progress | None

    def run(self) -> None:
        """All of them, and the report, when all files are as they should be."""
        store, plan = self.store, self.store.plan
        if (store.made / REPORT).exists():
            return
        compact, parts = self._collected() if plan.size else (True, [])
        report, told = self.results(parts)
        if plan.rows:
            self._aligned()
        _write_files(store)
        partitions = [_shown(each) for each in told]
        for file in plan.files:
            file.check()
        check_results(store.made, plan, partitions)
        numbers = {"statistics": report | {"compact": compact}, "partitions": partitions}
        save_json(store.made / REPORT, plan.metadata | numbers)

    @abstractmethod
    def results(self, parts: list[int]) -> tuple[dict[str, Any], list[dict[str, Any]]]:
        """Results of the partitions that have points: numbers of all of them, and what there is to say of each."""

    def do(self, name: str, function: Callable[[int], None], tasks: Sequence[int]) -> list[dict[str, Any]]:
        """What the tasks of a pass say, in order; noted at the end, as what they wrote may be deleted then.

        What counts is what they left on the disk: a task whose files are gone is done again.
        """
        return list(self.store.notes.once(name, lambda: {"told": self._done(name, function, tasks)})["told"])

    def _done(self, name: str, function: Callable[[int], None], tasks: Sequence[int]) -> list[Note]:
        notes = self.store.notes
        for attempt in range(ATTEMPTS):
            told = {task: note for task in tasks if (note := notes.note(name, task)) is not None}
            left = [task for task in tasks if task not in told]
            if left or not attempt:
                self.tell(name, len(told), len(tasks))
            if not left:
                return list(told.values())
            for done, (_, outcome) in enumerate(self.crew.each(function, left), len(told) + 1):
                outcome.value()
                self.tell(name, done, len(tasks))
        raise ValueError(f"{notes.path(name, left[0])} or files in it are deleted while the run works there")

    def tell(self, name: str, done: int, of: int) -> None:
        """Say how many tasks of a pass are done."""
        if self.progress is not None:
            self.progress(name, done, of)

    def _collected(self) -> tuple[bool, list[int]]:
        """Points in partitions: whether those are files, and which of them have points."""
        store, plan = self.store, self.store.plan
        compact = bool(store.notes.once("layout", lambda: {"compact": self._laid_out()})["compact"])
        store.drop("sample")
        if compact:
            told = self.do("collect", partial(spread.take, store), range(len(plan.parts)))
        else:
            if store.notes.note("collect") is None:
                self.do("spread", partial(spread.spread, store), range(len(plan.shares)))
                spread.gather(store)
            told = self.do("collect", partial(spread.collect, store), range(spread.splits_of(store).leaves))
            store.drop("spread")
        return compact, [each["task"] for each in told if each["points"]]

    def _laid_out(self) -> bool:
        """Whether files are compact; if not, the tree is written."""
        store, plan = self.store, self.store.plan
        count = len(plan.parts)
        if plan.compact or count == 1:
            return True
        self.do("sample", partial(spread.sample, store), range(count))
        samples = [np.asarray(store.load("sample", part, "points")) for part in range(count)]
        points = np.concatenate(samples)
        labels = np.repeat(np.arange(count, dtype=np.int32), [len(each) for each in samples])
        compact = plan.compact is None and is_compact(points, labels)
        if not compact:
            splits = Splits.of(points, -(-plan.size // plan.partition))
            for name in ("axis", "value"):
                save(store.scratch / f"splits.{name}", getattr(splits, name))
        return compact

    def _aligned(self) -> None:
        store, plan = self.store, self.store.plan
        self.do("align", partial(rows_of.align, store), range(len(plan.outputs)))
        for number, file in enumerate(plan.files):
            if not file.rows:
                rows_of.write_file(store, number, [])
        store.drop("stars")


def _shown(told: dict[str, Any]) -> dict[str, Any]:
    return {"part": told["task"]} | {name: value for name, value in told.items() if name not in ("files", "task")}


def _write_files(store: Store) -> None:
    """Which numbers the points of each file have."""
    plan = store.plan
    columns = {
        "path": [file.path for file in plan.files],
        "rows_file": [file.name for file in plan.files],
        "first": plan.firsts[:-1],
        "rows": np.array([file.rows for file in plan.files], dtype=np.int64),
        "size": np.array([file.size for file in plan.files], dtype=np.int64),
        "modified": np.array([file.modified for file in plan.files], dtype=np.int64),
    }
    pyarrow = optional("pyarrow", "partitioned")
    texts = {name: pyarrow.array(columns[name], pyarrow.string()) for name in ("path", "rows_file")}
    write_table(plan, store.made / FILES, columns | texts)
