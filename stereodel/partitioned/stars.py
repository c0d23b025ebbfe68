"""Stars: the triangles of a partition whose lowest point is its own, and the results for its points."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from stereodel import _kernel
from stereodel._arrays import BoolArray, FloatArray, Indices, LongArray
from stereodel._tasks.whole_files import replacing
from stereodel.curves.borders import frame_of
from stereodel.io.formats.map_rows import MapRows
from stereodel.io.formats.parquet import write_parquet
from stereodel.io.rows_of import rows_of
from stereodel.partitioned.rounds import Index, Mesh, Rounds, Sample, Verdict, clock, measured, triangulation
from stereodel.partitioned.store import Columns, Left, Store, starts_of
from stereodel.sphere import angular_distance
from stereodel.triangulation import PlanarDelaunay, PlanarVoronoi, SphericalVoronoi

REACH: Final = 0.15
"""What is read beside own blocks at first: what is nearer than so much of the smaller block's diagonal."""

CELLS: Final = ("kept", "degree", "area", "nearest", "distance")
"""Results for points in the order of the kernel."""


class Solved(NamedTuple):
    """Results for points whose stars are final."""

    columns: Columns
    triangles: LongArray  # whose lowest point is among them
    closing: BoolArray  # which triangles are
    edges: int  # of the hull that begin at them
    cells: MapRows | None  # as polygons, if they are wanted


@dataclass
class StarRounds(Rounds[Solved]):
    """The stars of a partition's points."""

    store: Store
    part: int
    size: int = 0

    def all(self) -> Iterator[Solved]:
        """Those of all its points, round by round."""
        numbers = self.store.load("points", self.part, "numbers").astype(np.int64)
        self.size = len(numbers)
        own = self._core(np.flatnonzero(self.index.part == self.part))
        left, count = yield from self.answers(numbers, own, self.limit)
        if count:
            star = "some stars" if len(left) == self.size else f"the star of point {left[0]}"
            raise MemoryError(
                f"partition {self.part}: {star} may need {count} points at once, more than limit={self.limit}; give a "
                "higher limit, or smaller partitions, which do not help if all points lie on one line or great circle"
            )

    def decide(self, sample: Sample, pending: Indices, unread: BoolArray) -> Verdict[Solved]:
        """The stars that are final, of duplicates all together; the second round may read a fifth more points."""
        mesh, numbers = triangulation(sample.points), sample.numbers
        here = np.flatnonzero(self.index.part[sample.blocks] == self.part)
        if len(here) > len(pending):
            here = here[np.isin(numbers[here], pending)]
        kept = kept_of(mesh)
        wanted, final = np.zeros((2, len(numbers)), dtype=np.bool_)
        wanted[kept[here]] = True
        is_open, depth = self._open(mesh, wanted, unread)
        final[here] = ~is_open[kept[here]]
        left = here[~final[here]]
        core = np.zeros_like(unread)
        if len(left):
            around = sample.blocks[mesh.simplices[is_open[mesh.simplices].any(axis=1)].ravel()]
            near = np.unique(np.concatenate([around, sample.blocks[left]]))
            core = self._core(near[~unread[near]])
        solved = self._solved(mesh, numbers, final) if mesh.dimension == 2 else self._flat(sample, final)
        return solved, numbers[left], depth, core, int(0.2 * self.size)

    def _core(self, blocks: Indices) -> BoolArray:
        """Some blocks and those near them."""
        core = np.zeros(len(self.index), dtype=np.bool_)
        core[blocks] = True
        return core | self.index.near(blocks, REACH, ~core)

    def _open(self, mesh: Mesh, wanted: BoolArray, unread: BoolArray) -> tuple[BoolArray, FloatArray]:
        """Wanted points whose stars are not final, and how deep their bubbles reach into blocks that were not read."""
        if mesh.dimension < 2:  # all on one line so far: any other point will do
            return wanted & unread.any(), unread.astype(np.float64)
        faces = mesh.simplices
        if isinstance(mesh, PlanarDelaunay):
            hull = mesh.convex_hull
            faces = np.concatenate([faces, np.column_stack([hull, np.full(len(hull), -1, dtype=np.int32)])])
        touching, depth = self.index.space.open_bubbles(mesh.points, faces, *self.index.tree(unread), wanted)
        is_open = np.zeros(len(wanted) + 1, dtype=np.bool_)  # the last one for edges of the hull
        is_open[faces[touching]] = True
        return is_open[:-1] & wanted, depth

    def _solved(self, mesh: Mesh, numbers: LongArray, final: BoolArray) -> Solved:
        rows, space = np.flatnonzero(final).astype(np.int32), self.index.space
        results = space.final_cells(
            mesh.points, mesh.simplices, mesh.neighbors, mesh.duplicates, numbers, rows, checked=True
        )
        triangles, where = space.final_triangles(mesh.points, mesh.simplices, mesh.duplicates, numbers, final)
        if isinstance(mesh, PlanarDelaunay):
            closing = np.zeros(len(triangles), dtype=np.bool_)
            edges = int(np.count_nonzero(final[mesh.convex_hull[:, 0]]))
        else:
            closing, edges = _kernel.sphere.closing(mesh.points, mesh.simplices[where]), 0
        columns = {"number": numbers[rows], **dict(zip(CELLS, results, strict=True))}
        return Solved(columns, triangles, closing, edges, self._cells(mesh.points, numbers, final))

    def _flat(self, sample: Sample, final: BoolArray) -> Solved:
        """The same where all points lie on one line or great circle: no triangles, but cells, those in memory."""
        own = final[np.argsort(sample.numbers)]
        points, numbers, _ = sample.sorted()
        mesh = triangulation(points)
        diagram = PlanarVoronoi(mesh) if isinstance(mesh, PlanarDelaunay) else SphericalVoronoi(mesh)
        kept, nearest, distance = kept_of(mesh), np.full(len(own), -1), np.full(len(own), np.inf)
        if len(numbers) > 1:
            found = np.asarray(mesh.nearest(mesh.points, k=2, workers=1))
            other = np.where(found[:, 0] == np.arange(len(own)), found[:, 1], found[:, 0])
            nearest = numbers[other]
            distance = np.where(kept == kept[other], 0.0, distances(mesh.points, mesh.points[other]))
        columns: Columns = {
            "number": numbers,
            "kept": numbers[kept],
            "degree": np.diff(diagram.region_offsets).astype(np.int32),
            "area": diagram.areas(),
            "nearest": nearest,
            "distance": distance,
        }
        columns = {name: column[own] for name, column in columns.items()}
        none = np.empty((0, 3), dtype=np.int64)
        return Solved(columns, none, np.empty(0, dtype=np.bool_), 0, self._cells(mesh.points, numbers, own))

    def _cells(self, points: FloatArray, numbers: LongArray, final: BoolArray) -> MapRows | None:
        """Cells as polygons, with the ``point`` that each is of and its ``area``, if they are wanted.

        On the sphere they are cut at ±180° and led around the poles, as by `stereodel.io.to_geodataframe`; in the plane
        they are cut to the rectangle of all points with a tenth of its longer side around it.
        """
        if not self.store.plan.cells or not final.any():
            return None
        # In the order of numbers the cells of several partitions have bitwise the same corners.
        order, index = np.argsort(numbers), self.index
        mesh, numbers = triangulation(points[order]), numbers[order]
        if isinstance(mesh, PlanarDelaunay):
            top = slice(index.levels[-2], index.levels[-1])
            frame = frame_of(np.stack([index.lows[top].min(axis=0), index.highs[top].max(axis=0)]))
            whole = rows_of(PlanarVoronoi(mesh), bounds=(frame.left, frame.bottom, frame.right, frame.top))
        else:
            whole = rows_of(SphericalVoronoi(mesh), latitude=self.store.plan.columns.latitude)
        own = whole.take(final[order][whole.columns["point"]])
        return replace(own, columns={**own.columns, "point": numbers[own.columns["point"]]})


def kept_of(mesh: Mesh) -> Indices:
    """The point that is kept in place of each: itself, or for duplicates the lowest of equal points."""
    kept = np.arange(len(mesh.points))
    kept[mesh.duplicates[:, 0]] = mesh.duplicates[:, 1]
    return kept


def distances(a: FloatArray, b: FloatArray) -> FloatArray:
    """Between points row by row: lengths in the plane, angles in radians on the sphere."""
    return np.hypot(*(a - b).T) if a.shape[1] == 2 else np.radians(angular_distance(a, b))


def solve(store: Store, part: int, limit: int) -> Left:
    """The stars of a partition's points, in files."""
    began, plan = clock(), store.plan
    stars = StarRounds(Index(store), limit, store, part)
    found = list(stars.all())
    order = np.argsort(np.concatenate([each.columns["number"] for each in found]))
    columns = {name: np.concatenate([each.columns[name] for each in found])[order] for name in ("number", *CELLS)}
    number, kept = columns["number"], columns["kept"]
    dropped = np.flatnonzero(kept != number)
    summary = {
        "points": len(number),
        "dropped": len(dropped),
        "triangles": sum(len(each.triangles) for each in found),
        "edges": sum(each.edges for each in found),
        "area": float(np.sum(columns["area"], where=np.isfinite(columns["area"]))),
    }
    files: list[Path] = []
    if plan.rows:
        pairs = np.column_stack([number[dropped], kept[dropped]])
        files += write_rows(store, part, columns, pairs=pairs)
    if plan.triangles:
        corners = np.concatenate([each.triangles for each in found])
        table: Columns = {name: np.ascontiguousarray(corners[:, axis]) for axis, name in enumerate("abc")}
        table["closing"] = np.concatenate([each.closing for each in found])
        files.append(store.write_table(store.folder("triangles") / f"{part}.parquet", table))
    layers = [each.cells for each in found if each.cells is not None]
    if layers:
        summary["cells"] = sum(map(len, layers))
        cells = {name: np.concatenate([layer.columns[name] for layer in layers]) for name in ("point", "area")}
        binary = np.concatenate([layer.binary for layer in layers])
        whole = MapRows(cells, binary, layers[0].crs).take(np.argsort(cells["point"]))
        path = store.folder("cells") / f"{part}.parquet"
        path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(path) as temporary:
            write_parquet(whole, temporary, metadata=plan.metadata)
        files.append(path)
    return summary | measured(stars.sizes, began), files


def write_rows(store: Store, part: int, columns: Columns, **more: Any) -> list[Path]:
    """Write results for points, in the order of their numbers, for `align`: slices for each share of the input."""
    rows = np.empty(len(columns["number"]), dtype=store.plan.row_type)
    for name in ("number", *store.plan.row_names):
        rows[name] = columns[name]
    starts = starts_of(np.searchsorted(columns["number"], store.plan.share_firsts), rows)
    return store.save("stars", part, {"rows": rows, "starts": starts, **more})
