"""Passes: the tasks of a run one kind after another, over an executor, and what they leave in a folder."""

from __future__ import annotations

import os
import shutil
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import as_count
from stereodel._extras import optional
from stereodel.partitioned import rows as rows_of
from stereodel.partitioned import spread
from stereodel.partitioned.executors import Crew
from stereodel.partitioned.lock import locked
from stereodel.partitioned.plan import NAME, Plan
from stereodel.partitioned.shards import load_json, save, save_json
from stereodel.partitioned.solve import write_table
from stereodel.partitioned.sources import Source
from stereodel.partitioned.store import KEPT, Store
from stereodel.partitioned.tree import Splits, is_compact

Progress = Callable[[str, int, int], None]

PARTITION: Final = 650_000
"""Points of a partition by default: some 0.3 GB for each worker."""

LIMIT: Final = 8_000_000
"""Points that a worker may read at once by default: some 4 GB."""

REPORT: Final = "run.json"
"""Name of the file that describes a run; it is written last."""

FILES: Final = "files.parquet"
"""Name of the file that maps rows to files."""

RESULTS: Final = ("rows", "triangles", "cells", KEPT, FILES, REPORT, NAME)
"""What a run leaves in its folder."""


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
        files = [file.name for file in Plan.load(self.folder).files]
        return dataset([self.folder / "rows" / name for name in files])


def dataset(paths: Sequence[Path]) -> Any:
    """Files of Parquet as one dataset of pyarrow."""
    return optional("pyarrow.dataset", "partitioned").dataset([str(path) for path in paths], format="parquet")


@dataclass(frozen=True)
class Means:
    """Who computes, in which folders, and who hears of progress.

    Parameters
    ----------
    out : path-like
        Folder of results.
    limit : int
        Points that a worker may read at once.
    executor, scratch, resume, progress
        As in `triangulate`.
    """

    out: str | os.PathLike[str]
    limit: int
    executor: Executor | None
    scratch: str | os.PathLike[str] | None
    resume: bool
    progress: Progress | None

    def run(self, kind: type[Passes], source: Source, plan: Plan) -> Path:
        """Do what a plan says, or what is left of it; the folder of results."""
        folder, limit = Path(self.out).absolute(), as_count(self.limit, "limit")
        _refuse_within(folder, source)
        folder.mkdir(parents=True, exist_ok=True)
        scratch = folder / "scratch" if self.scratch is None else Path(self.scratch).absolute() / plan.digest[:16]
        store = Store(folder, scratch)
        with locked(folder):
            _begin(store, plan, self.resume)
            if not (folder / REPORT).exists():
                with Crew(self.executor, max(len(plan.parts), len(plan.shares))) as crew:
                    kind(store, crew, limit, self.progress).run(source)
        return folder


def _refuse_within(folder: Path, source: Source) -> None:
    for file in source.files:
        if Path(file.path).is_relative_to(folder):
            raise ValueError(f"{file.path} lies in out, the folder of results; take another folder")


def _begin(store: Store, plan: Plan, resume: bool) -> None:
    """Note what is to be done, or find that it was noted before."""
    if not resume and (store.results / NAME).exists():
        shutil.rmtree(store.scratch, ignore_errors=True)
        for name in RESULTS:
            path = store.results / name
            shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
    if (store.results / NAME).exists():
        other = Plan.load(store.results).differs(plan)
        if other:
            raise ValueError(
                f"{store.results} has a run of other files or arguments: {other}; take another folder, or begin anew "
                "with resume=False"
            )
        return
    there = [name for name in RESULTS if (store.results / name).exists()]
    if there:
        raise ValueError(f"{store.results} has {there[0]!r}, which is not of a run; take another folder")
    plan.save(store.results)


@dataclass(frozen=True)
class Passes(ABC):
    """The passes of a run, one after another; those that were done before are not done again.

    A kind of run is a subclass that says in `results` what is done with partitions.
    """

    store: Store
    crew: Crew
    limit: int
    progress: Progress | None

    def run(self, source: Source) -> None:
        """All of them, and the report."""
        store, plan = self.store, self.store.plan
        compact, parts = self._collected() if plan.size else (True, [])
        report, told = self.results(parts)
        if plan.rows:
            self._aligned()
        _write_files(store)
        source.finish(store.results / "rows")
        partitions = [_shown(each) for each in told]
        save_json(store.results / REPORT, {"statistics": report | {"compact": compact}, "partitions": partitions})
        shutil.rmtree(store.scratch, ignore_errors=True)

    @abstractmethod
    def results(self, parts: list[int]) -> tuple[dict[str, Any], list[dict[str, Any]]]:
        """Results of the partitions that have points: numbers of all of them, and what there is to say of each."""

    def do(self, name: str, function: Callable[[int], dict[str, Any]], tasks: Sequence[int]) -> list[dict[str, Any]]:
        """What the tasks of a pass say, in order; noted at the end, as what they wrote may be deleted then."""
        note = self.store.scratch / "done" / f"{name}.json"
        if note.exists():
            return list(load_json(note)["told"])
        told = {task: done for task in tasks if (done := self.store.done(name, task)) is not None}
        self.tell(name, len(told), len(tasks))
        for result in self.crew.results(function, [task for task in tasks if task not in told]):
            told[result["task"]] = result
            self.tell(name, len(told), len(tasks))
        found = [told[task] for task in tasks]
        save_json(note, {"told": found})
        return found

    def tell(self, name: str, done: int, of: int) -> None:
        """Say how many tasks of a pass are done."""
        if self.progress is not None:
            self.progress(name, done, of)

    def _collected(self) -> tuple[bool, list[int]]:
        """Points in partitions: whether those are files, and which of them have points."""
        store, plan = self.store, self.store.plan
        layout = store.scratch / "layout.json"
        if not layout.exists():
            save_json(layout, {"compact": self._laid_out()})
        compact = bool(load_json(layout)["compact"])
        if compact:
            told = self.do("collect", partial(spread.take, store), range(len(plan.parts)))
        else:
            if not (store.scratch / "done" / "collect.json").exists():
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
                save(store.scratch / f"splits.{name}.npy", getattr(splits, name))
        store.drop("sample")
        return compact

    def _aligned(self) -> None:
        store, plan = self.store, self.store.plan
        self.do("align", partial(rows_of.align, store), range(len(plan.outputs)))
        for number, file in enumerate(plan.files):
            if not file.rows:
                rows_of.write_file(store, number, [])
        store.drop("cells")


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
    write_table(store, store.results / FILES, columns | texts)
