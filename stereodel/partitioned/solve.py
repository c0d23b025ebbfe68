"""Solving a partition: triangles whose lowest point is its own, and the results for its points."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import BoolArray, LongArray
from stereodel._extras import optional
from stereodel._files import replacing
from stereodel._spaces import space_of
from stereodel.io.formats.map_rows import MapRows
from stereodel.partitioned.cells import cells_of, write_cells
from stereodel.partitioned.index import Index
from stereodel.partitioned.plan import Plan
from stereodel.partitioned.rounds import Round, Rounds, triangulation
from stereodel.partitioned.spread import starts_of
from stereodel.partitioned.store import Store
from stereodel.sphere import angular_distance
from stereodel.triangulation import PlanarDelaunay, PlanarVoronoi, SphericalDelaunay, SphericalVoronoi

ROWS: Final[dict[str, npt.DTypeLike]] = {
    "area": np.float64,
    "degree": np.int32,
    "nearest": np.int64,
    "distance": np.float64,
    "kept": np.int64,
}
"""What can be told of points, and as what."""

CELLS: Final = ("kept", "degree", "area", "nearest", "distance")
"""The order in which the kernel tells it."""


def solve(store: Store, part: int, limit: int) -> None:
    """The stars of a partition's points."""
    began, cpu = time.perf_counter(), time.process_time()
    index = Index(store)
    rounds = Rounds(index, limit, f"partition {part}")
    found, shapes = [], []
    for stars in rounds.of_part(part):
        found.append(_told(store, stars))
        if store.plan.cells and stars.final.any():
            shapes.append(cells_of(stars, index, store.plan.places))
    told, files = write(store, part, found, shapes)
    seconds = {"seconds": time.perf_counter() - began, "cpu": time.process_time() - cpu}
    store.notes.keep("solve", told | asdict(rounds.reading) | seconds, files, task=part)


Columns = dict[str, npt.NDArray[Any]]

Told = tuple[Columns, LongArray, BoolArray, int]
"""Result of a round: results for the final points, their triangles, which of them are closing, edges of the hull."""


def _told(store: Store, stars: Round) -> Told:
    mesh, numbers, final = stars.mesh, stars.numbers, stars.final
    rows = np.flatnonzero(final).astype(np.int32)
    kernel = space_of(mesh.points)
    cells = kernel.final_cells(
        mesh.points, mesh.simplices, mesh.neighbors, mesh.duplicates, numbers, rows, checked=True
    )
    values: Columns = {"number": numbers[rows], **dict(zip(CELLS, cells, strict=True))}
    triangles, where = kernel.final_triangles(mesh.points, mesh.simplices, mesh.duplicates, numbers, final)
    if isinstance(mesh, PlanarDelaunay):
        edges = int(np.count_nonzero(final[mesh.convex_hull[:, 0]]))
        return values, triangles, np.zeros(len(triangles), dtype=np.bool_), edges
    closing = _kernel.sphere.closing(mesh.points, mesh.simplices[where])
    return values, triangles, closing, 0


def _flat(mesh: SphericalDelaunay | PlanarDelaunay, numbers: LongArray) -> Told:
    """The same where all points lie on one line or great circle, in the order of numbers: no triangles, but cells."""
    diagram = PlanarVoronoi(mesh) if isinstance(mesh, PlanarDelaunay) else SphericalVoronoi(mesh)
    own, kept = np.arange(len(numbers)), np.arange(len(numbers))
    kept[mesh.duplicates[:, 0]] = mesh.duplicates[:, 1]
    nearest, distance = np.full(len(numbers), -1), np.full(len(numbers), np.inf)
    if len(numbers) > 1:
        found = np.asarray(mesh.nearest(mesh.points, k=2, workers=1))
        other = np.where(found[:, 0] == own, found[:, 1], found[:, 0])
        nearest = numbers[other]
        distance = np.where(kept == kept[other], 0.0, distances(mesh.points, mesh.points[other]))
    values: Columns = {
        "number": numbers,
        "kept": numbers[kept],
        "degree": np.diff(diagram.region_offsets).astype(np.int32),
        "area": diagram.areas(),
        "nearest": nearest,
        "distance": distance,
    }
    none = np.empty((0, 3), dtype=np.int64)
    return values, none, np.empty(0, dtype=np.bool_), 0


def distances(a: npt.NDArray[np.float64], b: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Between points row by row: lengths in the plane, angles in radians on the sphere."""
    return np.hypot(*(a - b).T) if a.shape[1] == 2 else np.radians(angular_distance(a, b))


def write(
    store: Store, part: int, found: Sequence[Told], shapes: Sequence[MapRows]
) -> tuple[dict[str, Any], list[Path]]:
    """Write what was found of a partition; what there is to say of it, and the files."""
    plan = store.plan
    number = np.concatenate([told[0]["number"] for told in found])
    order = np.argsort(number)
    number = number[order]
    cells = {name: np.concatenate([told[0][name] for told in found])[order] for name in CELLS}
    dropped = np.flatnonzero(cells["kept"] != number)
    told = {
        "points": len(number),
        "dropped": len(dropped),
        "triangles": sum(len(told[1]) for told in found),
        "edges": sum(told[3] for told in found),
        "area": float(np.sum(cells["area"], where=np.isfinite(cells["area"]))),
    }
    files: list[Path] = []
    if plan.rows:
        rows = np.empty(len(number), dtype=row_type(plan))
        rows["number"] = number
        for name in plan.told:
            rows[name] = cells[name]
        pairs = np.column_stack([number[dropped], cells["kept"][dropped]])
        starts = starts_of(np.searchsorted(number, plan.share_firsts), rows)
        files += store.save("stars", part, {"rows": rows, "pairs": pairs, "starts": starts})
    if plan.triangles:
        corners, closing = (np.concatenate([each[k] for each in found]) for k in (1, 2))
        columns = {name: np.ascontiguousarray(corners[:, axis]) for axis, name in enumerate("abc")}
        files.append(write_table(plan, store.room("triangles") / f"{part}.parquet", columns | {"closing": closing}))
    if shapes:
        told["cells"], path = write_cells(store, part, shapes)
        files.append(path)
    return told, files


def row_type(plan: Plan) -> np.dtype[np.void]:
    """What is handed on of a point: its number, and what is asked; the kept ones of duplicates are a list apart."""
    kinds = row_kinds(plan)
    if plan.question is None and "nearest" in kinds and plan.size <= np.iinfo(np.int32).max:
        kinds["nearest"] = np.dtype(np.int32)  # a number of a point or -1
    return np.dtype([("number", plan.number_type), *((name, kinds[name]) for name in plan.told)])


def row_kinds(plan: Plan) -> dict[str, np.dtype[Any]]:
    """What stands in the columns of rows: numbers, or a fixed number of them."""
    question = plan.question
    if question is not None and question.method != "nearest":
        return {name: np.dtype(np.float64) for name in plan.rows}
    shape = () if question is None or question.k is None else (question.k,)
    return {name: np.dtype((ROWS[name], shape)) for name in plan.rows}


def write_table(plan: Plan, path: Path, columns: dict[str, Any]) -> Path:
    """A file of Parquet with what it belongs to in its metadata."""
    pyarrow = optional("pyarrow", "partitioned")
    table = pyarrow.table(columns)
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as temporary:
        optional("pyarrow.parquet", "partitioned").write_table(
            table.replace_schema_metadata(plan.metadata), temporary, compression="none", use_dictionary=False
        )
    return path


def solve_flat(store: Store, limit: int, parts: Sequence[int]) -> dict[str, Any]:
    """All points at once, where they lie on one line or great circle, in the name of the first partition.

    Raises MemoryError where they are more than `limit`.
    """
    plan = store.plan
    if plan.size > limit:
        curve = "line" if plan.places.surface == "plane" else "great circle"
        raise MemoryError(
            f"all {plan.size} points lie on one {curve}: there are no triangles, and cells are computed of all at "
            f"once, which are more than limit={limit}; give a higher limit"
        )
    numbers = np.concatenate([store.load("points", part, "numbers") for part in parts]).astype(np.int64)
    order = np.argsort(numbers)
    points = np.concatenate([store.load("points", part, "points") for part in parts])[order]
    mesh = triangulation(points)
    shapes = []
    if plan.cells:
        stars = Round(mesh, numbers[order], np.ones(len(order), dtype=np.bool_))
        shapes.append(cells_of(stars, Index(store), plan.places))
    told, _ = write(store, parts[0], [_flat(mesh, numbers[order])], shapes)
    reading = {"rounds": 1, "read": len(points), "largest": len(points), "seconds": 0.0, "cpu": 0.0}
    return told | {"task": parts[0]} | reading
