"""Running: the passes of a triangulation over an executor, and what they leave."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Final, Literal

import numpy as np

import stereodel
from stereodel._arrays import as_choice, as_count
from stereodel._extras import of_extra, optional
from stereodel.constants import AREA_SUM_ERROR
from stereodel.partitioned import rows as rows_of
from stereodel.partitioned import spread
from stereodel.partitioned.executors import Crew
from stereodel.partitioned.flat import is_flat
from stereodel.partitioned.index import Index
from stereodel.partitioned.kinds import source_of
from stereodel.partitioned.lock import locked
from stereodel.partitioned.places import SURFACES, Surface
from stereodel.partitioned.plan import NAME, Plan
from stereodel.partitioned.shards import load_json, save, save_json
from stereodel.partitioned.solve import ROWS, solve, solve_flat, write_table
from stereodel.partitioned.sources import Given, Source
from stereodel.partitioned.store import Store
from stereodel.partitioned.tree import Splits, is_compact
from stereodel.sphere.latitudes import KINDS as LATITUDES
from stereodel.sphere.latitudes import Latitude

Row = Literal["area", "degree", "nearest", "distance", "kept"]
Progress = Callable[[str, int, int], None]

PASSES: Final = ("sample", "spread", "collect", "solve", "align")
"""Passes of a run, in order; if the files are compact, nothing is spread."""

PARTITION: Final = 500_000
"""Points of a partition by default: some 0.3 GB for each worker."""

LIMIT: Final = 8_000_000
"""Points that a worker may read at once by default: some 4 GB."""

REPORT: Final = "run.json"
"""Name of the file that describes a run; it is written last."""

FILES: Final = "files.parquet"
"""Name of the file that maps rows to files."""

RESULTS: Final = ("rows", "triangles", "cells", FILES, REPORT, NAME)
"""What a run leaves in its folder."""


@dataclass(frozen=True)
class Run:
    """What a triangulation in partitions left in a folder; nothing is loaded until it is asked for.

    Parameters
    ----------
    folder : path-like
        Which `triangulate` wrote.

    Attributes
    ----------
    statistics : dict
        ``surface``, ``points``, ``distinct`` ones, ``triangles`` and ``euler``, their number by Euler's formula,
        ``area`` of all cells that have one, ``compact`` (whether files served as partitions), ``partitions``,
        ``rounds`` (the most of one), ``read`` (points in all triangulations), ``largest`` (points of the largest),
        ``cpu`` (seconds of all workers in them).
    partitions : list of dict
        The same of each partition that has points, by its number, ``part``.

    Raises
    ------
    FileNotFoundError
        If no run ended there.
    """

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
        """Results for the points, in their order: a dataset of pyarrow, with a file for each file of the input."""
        files = [file.name for file in Plan.load(self.folder).files]
        return _dataset([self.folder / "rows" / name for name in files])

    def triangles(self) -> Any:
        """Triangles by the numbers of their points: a dataset of pyarrow with a, b, c, closing."""
        return self._of_partitions("triangles")

    def cells(self) -> Any:
        """Cells, if they were asked for: a dataset of pyarrow with point, area and geometry, well-known binary."""
        return self._of_partitions("cells")

    def _of_partitions(self, name: str) -> Any:
        return _dataset(sorted((self.folder / name).glob("*.parquet"), key=lambda path: int(path.stem)))


def _dataset(paths: Sequence[Path]) -> Any:
    return optional("pyarrow.dataset", "partitioned").dataset([str(path) for path in paths], format="parquet")


@of_extra("partitioned")
def triangulate(
    source: Given,
    out: str | os.PathLike[str],
    *,
    columns: Sequence[str] | None = None,
    surface: Surface = "sphere",
    latitude: Latitude = "spherical",
    kind: str = "auto",
    rows: Sequence[Row] = ("area", "degree", "nearest", "distance", "kept"),
    keep: Sequence[str] = (),
    triangles: bool = True,
    cells: bool = False,
    partition: int = PARTITION,
    limit: int = LIMIT,
    executor: Executor | None = None,
    scratch: str | os.PathLike[str] | None = None,
    resume: bool = True,
    progress: Progress | None = None,
) -> Run:
    """Triangulate points in files, more of them than memory holds: exactly as all at once, whatever the partitions.

    Parameters
    ----------
    source : path-like or sequence of path-like
        Parquet or GeoParquet: a file, a folder with files at any depth, a pattern such as ``points/*.parquet``, or a
        list. Points are numbered from 0 in the order of the names of files, or of the list. Or the folder of a HATS
        catalogue, or of a collection of them, whose points are numbered in the order of its pixels.
    out : path-like
        A folder for the results, which is made.
    columns : sequence of str, optional
        Names of the columns: (longitude, latitude) in degrees or (x, y, z), a direction; (x, y) in the plane; or one
        of geometries. By default the geometries of GeoParquet, else as `stereodel.io.read_points` finds them, or x,
        y, z.
    surface : {"sphere", "plane"}
    latitude : {"spherical", "geodetic", "authalic"}
        As in `stereodel.lonlat_to_xyz`.
    kind : {"auto", "parquet", "hats"}
        What the source is; by default that is found out.
    rows : sequence of {"area", "degree", "nearest", "distance", "kept"}
        Results for each point: the area of its Voronoi cell (steradians; in the plane infinite for unbounded ones), the
        number of its sides, the number of the nearest other point (the lowest one of several, -1 if there is none) and
        its distance (radians on the sphere), and the point that is kept in its place: itself, or for duplicates the
        lowest number of equal points. Areas and degrees of other duplicates are 0.
    keep : sequence of str
        Columns of the input that stand before those of the rows, such as one that identifies points. Rows of a HATS
        catalogue keep its spatial index and its coordinates in any case.
    triangles : bool
        Whether triangles are written.
    cells : bool
        Whether cells are written as polygons in GeoParquet, which takes the extra ``geo``; as those of
        `stereodel.io.to_geodataframe`.
    partition : int
        Points of a partition, about. Half a million to a million are right; more take more memory, fewer read more
        points beside their own.
    limit : int
        Points that a worker may triangulate at once; some 500 bytes each.
    executor : concurrent.futures.Executor, optional
        Who computes, such as ``client.get_executor(pure=False)`` of a client of Dask or an ``MPIPoolExecutor`` of
        mpi4py. Its workers see `out` and `scratch`. By default processes of this machine, one for each processor: then
        a script needs ``if __name__ == "__main__":`` around what it does.
    scratch : path-like, optional
        A folder for what passes hand on, at most 80 bytes a point, deleted when it is used; by default in `out`.
    resume : bool
        Whether a run that was interrupted goes on, or the results of one that ended are kept. Otherwise all that it
        left is deleted first.
    progress : callable, optional
        Called with the name of a pass, the number of its tasks that are done, and that of all of them.

    Returns
    -------
    Run
        Files of `out`: ``rows/`` has a file for each file of the source, with the same name, number and order of rows;
        ``triangles/`` one for each partition, whose columns a, b, c are numbers of points, the lowest first,
        counterclockwise, and ``closing`` as in `stereodel.SphericalDelaunay`; ``cells/`` one, too, with the ``point``
        and ``area`` of each polygon; ``files.parquet`` says which numbers the points of each file have, and what it
        was like. Of a HATS catalogue, ``rows/`` is a second one with the same pixels, which LSDB joins with it; if
        columns are kept, a file ``…_voronoi.properties`` beside it is for ``catalog.load_extension``, by the first.

    Raises
    ------
    ValueError
        If a row is not a point, naming file, row and value; for columns that are not there; where a run in `out` was
        begun with other files or arguments.
    MemoryError
        Where a star has more points than `limit`, naming partition and point.
    RuntimeError
        Where another run writes to `out`.
    OSError
        Where files cannot be read or written.
    ImportError
        Without pyarrow (``pip install stereodel[partitioned]``).

    Notes
    -----
    Triangles, areas, degrees and nearest points are those of `stereodel.SphericalDelaunay` or
    `stereodel.PlanarDelaunay` of all points, bitwise, ties and duplicates included, for any partitions,
    executor and number of workers. At the end the number of triangles is compared with Euler's formula, and the sum of
    areas with that of the sphere.

    Where files are compact, as pixels of HEALPix or files sorted along a space-filling curve, they are the partitions,
    cut where they are large and grouped where they are small: nothing is copied. That is measured, on a sample: see
    `stereodel.partitioned.tree.is_compact`. Otherwise points are spread over the leaves of a k-d tree.

    Examples
    --------
    >>> import tempfile, pyarrow, pyarrow.parquet
    >>> from stereodel.partitioned import triangulate
    >>> octahedron = {"lon": [0.0, 90, 180, -90, 0, 0], "lat": [0.0, 0, 0, 0, 90, -90]}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     pyarrow.parquet.write_table(pyarrow.table(octahedron), f"{folder}/points.parquet")
    ...     run = triangulate(f"{folder}/points.parquet", f"{folder}/out")
    ...     print(run.statistics["triangles"], run.rows().to_table()["degree"].to_pylist())
    8 [4, 4, 4, 4, 4, 4]
    """
    optional("pyarrow", "partitioned")
    if cells:
        for module in ("shapely", "pyproj"):
            optional(module, "geo")
    as_choice(surface, SURFACES, "surface")
    as_choice(latitude, LATITUDES, "latitude")
    for name in rows:
        as_choice(name, tuple(ROWS), "rows")
    found = source_of(source, kind, columns, surface, latitude, keep)
    plan = Plan.of(
        found,
        version=stereodel.__version__,
        partition=as_count(partition, "partition"),
        rows=tuple(name for name in ROWS if name in rows),
        triangles=bool(triangles),
        cells=bool(cells),
    )
    folder = Path(out).absolute()
    _refuse_within(folder, found)
    folder.mkdir(parents=True, exist_ok=True)
    store = Store(folder, Path(scratch).absolute() / plan.digest[:16] if scratch is not None else folder / "scratch")
    with locked(folder):
        _begin(store, plan, resume)
        if not (folder / REPORT).exists():
            with Crew(executor, max(len(plan.parts), len(plan.shares))) as crew:
                _Passes(store, crew, as_count(limit, "limit"), progress).run(found)
    return Run(folder)


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
class _Passes:
    """The passes of a run, one after another; those that were done before are not done again."""

    store: Store
    crew: Crew
    limit: int
    progress: Progress | None

    def run(self, source: Source) -> None:
        """All of them, and the report."""
        store, plan = self.store, self.store.plan
        compact, parts = self._collected() if plan.size else (True, [])
        told = self._solved(parts) if parts else []
        report = _report(plan, told) | {"compact": compact}
        _check(plan, report)
        if plan.rows:
            self._aligned()
        if plan.triangles and not told:
            none = {name: np.empty(0, dtype=np.int64) for name in "abc"} | {"closing": np.empty(0, dtype=np.bool_)}
            write_table(store, store.results / "triangles" / "0.parquet", none)
        _write_files(store)
        source.finish(store.results / "rows")
        save_json(store.results / REPORT, {"statistics": report, "partitions": [_shown(each) for each in told]})
        shutil.rmtree(store.scratch, ignore_errors=True)

    def _pass(self, name: str, function: Callable[[int], dict[str, Any]], tasks: Sequence[int]) -> list[dict[str, Any]]:
        """What the tasks of a pass say, in order; noted at the end, as what they wrote may be deleted then."""
        note = self.store.scratch / "done" / f"{name}.json"
        if note.exists():
            return list(load_json(note)["told"])
        told = {task: done for task in tasks if (done := self.store.done(name, task)) is not None}
        self._tell(name, len(told), len(tasks))
        for result in self.crew.results(function, [task for task in tasks if task not in told]):
            told[result["task"]] = result
            self._tell(name, len(told), len(tasks))
        found = [told[task] for task in tasks]
        save_json(note, {"told": found})
        return found

    def _tell(self, name: str, done: int, of: int) -> None:
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
            told = self._pass("collect", partial(spread.take, store), range(len(plan.parts)))
        else:
            if not (store.scratch / "done" / "collect.json").exists():
                self._pass("spread", partial(spread.spread, store), range(len(plan.shares)))
                spread.gather(store)
            told = self._pass("collect", partial(spread.collect, store), range(spread.splits_of(store).leaves))
            store.drop("spread")
        return compact, [each["task"] for each in told if each["points"]]

    def _laid_out(self) -> bool:
        """Whether files are compact; if not, the tree is written."""
        store, plan = self.store, self.store.plan
        count = len(plan.parts)
        if plan.compact or count == 1:
            return True
        self._pass("sample", partial(spread.sample, store), range(count))
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

    def _solved(self, parts: list[int]) -> list[dict[str, Any]]:
        """What there is to say of each partition."""
        store = self.store
        note = store.scratch / "done" / "solve.json"
        if note.exists():
            told = list(load_json(note)["told"])
        elif self._is_flat(parts):
            self._tell("solve", 0, 1)
            told = [solve_flat(store, self.limit, parts)]
            self._tell("solve", 1, 1)
            save_json(note, {"told": told})
        else:
            told = self._pass("solve", partial(solve, store, limit=self.limit), parts)
        if store.plan.rows and not (store.scratch / "done" / "align.json").exists():
            rows_of.gather(store, [each["task"] for each in told])
        store.drop("points", "index")
        return told

    def _is_flat(self, parts: list[int]) -> bool:
        """Whether all points lie on one line or great circle; the index is written."""
        store = self.store
        if not (store.scratch / "done" / "index.json").exists():
            Index.build(store, parts)
            save_json(store.scratch / "done" / "index.json", {"flat": is_flat(_lots(store, parts))})
        return bool(load_json(store.scratch / "done" / "index.json")["flat"])

    def _aligned(self) -> None:
        store, plan = self.store, self.store.plan
        self._pass("align", partial(rows_of.align, store), range(len(plan.outputs)))
        for number, file in enumerate(plan.files):
            if not file.rows:
                rows_of.write_file(store, number, [])
        store.drop("cells")


def _lots(store: Store, parts: Sequence[int]) -> Any:
    """Points: one of each block, then those of all partitions."""
    yield np.array(Index(store).points)
    for part in parts:
        yield np.asarray(store.load("points", part, "points"))


def _shown(told: dict[str, Any]) -> dict[str, Any]:
    return {"part": told["task"]} | {name: value for name, value in told.items() if name not in ("files", "task")}


def _report(plan: Plan, told: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Numbers of the whole run."""
    total = {
        name: sum(each[name] for each in told) for name in ("dropped", "triangles", "edges", "area", "read", "cpu")
    }
    distinct = plan.size - total.pop("dropped")
    edges = total.pop("edges")
    euler = 2 * distinct - (4 if plan.places.surface == "sphere" else 2 + edges)
    return {
        "surface": plan.places.surface,
        "points": plan.size,
        "distinct": distinct,
        **total,
        "euler": euler if total["triangles"] else 0,
        "partitions": len(told),
        "rounds": max((each["rounds"] for each in told), default=0),
        "largest": max((each["largest"] for each in told), default=0),
    }


def _check(plan: Plan, report: dict[str, Any]) -> None:
    """Triangles by Euler's formula, and the areas of all cells of a sphere.

    Raises
    ------
    RuntimeError
        Where they differ, which no input may cause.
    """
    if report["triangles"] != report["euler"]:
        raise RuntimeError(f"there are {report['triangles']} triangles, but {report['euler']} by Euler's formula")
    whole = 4 * np.pi
    if plan.places.surface == "sphere" and plan.size and abs(report["area"] - whole) > AREA_SUM_ERROR * whole:
        raise RuntimeError(f"the areas of all cells add up to {report['area']}, but the sphere's is {whole}")


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
