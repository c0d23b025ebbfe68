"""Answers at targets: nearest points and values between points, from those nearby that were read.

A round triangulates points and asks which answers are final: those that rest on bubbles, or on the disc around the
target through its farthest nearest point, that touch the box of no block that was not read. Of blocks that are touched,
one point is read at first, then all, deepest first; so rounds end. Targets that would need more points than memory is
to hold are halved, near ones together.

Points are triangulated in the order of their numbers: the lowest of several near points is the first one, and sums go
in the order that they have in memory.
"""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Generator, Iterator
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, Indices, IntArray, LongArray
from stereodel.interpolation import LinearInterpolator, NaturalNeighborInterpolator
from stereodel.io.located import numbers as numbers_of
from stereodel.partitioned.index import Index
from stereodel.partitioned.places import doubles_of
from stereodel.partitioned.plan import Plan, Question
from stereodel.partitioned.rounds import SKELETON, Reading, triangulation
from stereodel.partitioned.solve import distances, row_type
from stereodel.partitioned.sources import named, slices
from stereodel.partitioned.spread import starts_of
from stereodel.partitioned.store import Store
from stereodel.triangulation import PlanarDelaunay, SphericalDelaunay

ROOM: Final = 1_000_000
"""Points that are read at once for several targets at most, some 0.5 GB; a single target may need more."""

LEAST_BUDGET: Final = 4096
"""How many points the first round that reads whole blocks may read at least; each later one twice as many."""

INTERPOLATORS: Final = {"linear": LinearInterpolator, "natural": NaturalNeighborInterpolator}
"""By the name of the method."""

Columns = dict[str, npt.NDArray[Any]]
Mesh = SphericalDelaunay | PlanarDelaunay
Certified = tuple[Columns, BoolArray, FloatArray]
"""Answers at targets, which of them are open, and how deep those reach into each block that was not read."""


def points_of(question: Question) -> Store:
    """The points that are asked, as their run left them."""
    return Store.ended(Path(question.run))


def take_values(store: Store, share: int) -> None:
    """Values of a share of the points, in their order, as an array that later tasks map.

    Raises ValueError for a value that is not a finite number, naming file and row.
    """
    question = _question(store)
    plan = points_of(question).plan
    found = [_values(plan, piece.file, piece.first, piece.last, question.values) for piece in plan.shares[share]]
    store.notes.keep("values", {}, store.save("values", share, {"values": np.concatenate(found)}), task=share)


def _values(plan: Plan, number: int, first: int, last: int, names: tuple[str, ...]) -> FloatArray:
    file, filled = plan.files[number], 0
    values = np.empty((last - first, len(names)))
    with named(file):
        for low, table in slices(file, names, first, last):
            rows = range(low + 1, low + 1 + table.num_rows)
            for place, name in enumerate(names):
                column = doubles_of(table[name], name, rows, gaps=True)
                values[filled : filled + len(rows), place] = numbers_of(column, name, rows, gaps=True)
            filled += len(rows)
    if filled < len(values):
        raise ValueError(f"{file.path} has fewer rows than it had")
    return values


def answer(store: Store, part: int, limit: int) -> None:
    """The answers at a partition's targets.

    Raises MemoryError where a single target needs more than `limit` points at once, naming it.
    """
    began, cpu = time.perf_counter(), time.process_time()
    plan = store.plan
    targets, number = (np.array(store.load("points", part, name)) for name in ("points", "numbers"))
    order = np.argsort(number)
    cells = np.empty(len(number), dtype=row_type(plan))
    cells["number"] = number
    reading = Reading()
    if _question(store).flat:
        for name in plan.rows:
            cells[name] = np.nan
    else:
        for rows, columns in _asked(store, targets, number, limit, reading).answers():
            for name, column in columns.items():
                cells[name][rows] = column
    cells = cells[order]
    starts = starts_of(np.searchsorted(number[order], plan.share_firsts), cells)
    files = store.save("stars", part, {"rows": cells, "starts": starts})
    seconds = {"seconds": time.perf_counter() - began, "cpu": time.process_time() - cpu}
    store.notes.keep("answer", {"points": len(number)} | asdict(reading) | seconds, files, task=part)


def _question(store: Store) -> Question:
    question = store.plan.question
    assert question is not None
    return question


def _asked(store: Store, targets: FloatArray, number: LongArray, limit: int, reading: Reading) -> Asked:
    question = _question(store)
    kind = Nearest if question.method == "nearest" else Interpolation
    return kind(store, question, Index(points_of(question)), targets, number, limit, reading)


@dataclass
class Asked(ABC):
    """Targets, and the points that are read for them; a kind of question is a subclass with `certified`.

    store: the targets and their answers.
    index: the points.
    targets, (n, width) array: near ones next to one another.
    number, (n,) array: their numbers.
    limit: points that may be read at once.
    reading: what was read so far.
    """

    store: Store
    question: Question
    index: Index
    targets: FloatArray
    number: LongArray
    limit: int
    reading: Reading

    @abstractmethod
    def certified(self, mesh: Mesh, numbers: LongArray, targets: FloatArray, unread: BoolArray) -> Certified:
        """Answers of a triangulation of some points, whose numbers ascend."""

    def answers(self) -> Iterator[tuple[Indices, Columns]]:
        """Rows of targets, and their answers, until all have theirs."""
        lots = [np.arange(len(self.targets))]
        while lots:
            lot = lots.pop()
            left = yield from self._of_lot(lot)
            if len(left):
                half = len(left) // 2
                lots += [left[half:], left[:half]]

    def _of_lot(self, lot: Indices) -> Generator[tuple[Indices, Columns], None, Indices]:
        """Answers at targets; those that would need too many points at once are returned."""
        index, count = self.index, len(self.index)
        known = np.arange(count) % max(1, -(-count // SKELETON)) == 0  # blocks of which one point is known
        touched, read = np.zeros(count, dtype=np.bool_), np.zeros(count, dtype=np.bool_)
        pending, budget = lot, 0
        while len(pending):
            size = int(index.sizes[read].sum()) + int(np.count_nonzero(known & ~read))
            if size > min(ROOM, self.limit) and len(pending) > 1:
                return pending
            self._check(size, pending[0])
            mesh, numbers, block = self._mesh(read, known & ~read)
            self.reading.add(size)
            targets = self.targets[pending]
            columns, is_open, depth = self.certified(mesh, numbers, targets, ~read)
            yield pending[~is_open], {name: column[~is_open] for name, column in columns.items()}
            pending, targets = pending[is_open], targets[is_open]
            if not len(pending):
                break
            if (depth > 0)[~known].any():
                known |= depth > 0
                continue
            budget = 2 * budget if budget else max(LEAST_BUDGET, len(pending) * self.index.largest)
            deepest = np.argsort(-depth, kind="stable")[: np.count_nonzero(depth)]
            before = np.cumsum(index.sizes[deepest]) - index.sizes[deepest]
            touched[deepest[before <= budget]] = True
            around = block[np.asarray(mesh.nearest(targets, workers=1))]
            around = around[read[around]]
            read = touched.copy()
            read[around] = True
        return pending

    def _check(self, size: int, row: int) -> None:
        if size > self.limit:
            plan, number = self.store.plan, int(self.number[row])
            file = int(np.searchsorted(plan.firsts, number, side="right")) - 1
            raise MemoryError(
                f"{plan.files[file].path}: row {number - int(plan.firsts[file]) + 1}: this target may need {size} "
                f"points at once, more than limit={self.limit}; give a higher limit"
            )

    def _mesh(self, read: BoolArray, alone: BoolArray) -> tuple[Mesh, LongArray, Indices]:
        """The triangulation of what is read, numbers of its points, which ascend, and their blocks."""
        points, numbers, block = self.index.read(np.flatnonzero(read), np.flatnonzero(alone))
        order = np.argsort(numbers)
        return triangulation(points[order]), numbers[order], block[order]

    def _tree(self, unread: BoolArray) -> tuple[FloatArray, FloatArray, LongArray, IntArray]:
        index = self.index
        return index.lows, index.highs, index.levels, index.counts(unread)


class Nearest(Asked):
    """The nearest points, in the order of distances, equally near ones in that of numbers."""

    def certified(self, mesh: Mesh, numbers: LongArray, targets: FloatArray, unread: BoolArray) -> Certified:
        """As in `Asked`; open are those whose disc through the last of the nearest points touches a block."""
        wanted = self.question.k or 1
        k = min(wanted, len(numbers))
        found = np.asarray(mesh.nearest(targets, k=k, workers=1))
        is_open, depth = self.index.space.open_discs(
            targets, np.ascontiguousarray(mesh.points[found[:, -1]]), *self._tree(unread)
        )
        if k < wanted:
            return {}, np.ones(len(targets), dtype=np.bool_), depth if depth.any() else unread.astype(np.float64)
        away = distances(np.repeat(targets, k, axis=0), mesh.points[found.ravel()]).reshape(found.shape)
        columns: Columns = {"nearest": numbers[found], "distance": away}
        if self.question.k is None:
            columns = {name: column[:, 0] for name, column in columns.items()}
        return columns, is_open, depth


class Interpolation(Asked):
    """Values at targets, NaN outside all triangles."""

    def certified(self, mesh: Mesh, numbers: LongArray, targets: FloatArray, unread: BoolArray) -> Certified:
        """As in `Asked`; open are those that rest on triangles, or edges of the hull, that are open."""
        values = np.full((len(targets), len(self.question.values)), np.nan)
        closing = mesh.closing if isinstance(mesh, SphericalDelaunay) else None
        if mesh.dimension < 2 or (closing is not None and closing.all()):  # any other point will do
            is_open = np.full(len(targets), unread.any())
            return (
                self._columns(np.full((len(targets), len(self.question.values)), np.nan)),
                is_open,
                unread.astype(np.float64),
            )
        is_open, depth = self.index.space.open_targets(
            mesh.points,
            mesh.simplices,
            mesh.neighbors,
            targets,
            *self._tree(unread),
            closing=closing,
            natural=self.question.method == "natural",
            checked=True,
        )
        if not is_open.all():
            function = INTERPOLATORS[self.question.method](mesh, self._values(numbers))
            values[~is_open] = function(targets[~is_open], workers=1)
        return self._columns(values), is_open, depth

    def _columns(self, values: FloatArray) -> Columns:
        return {name: values[:, place] for place, name in enumerate(self.question.values)}

    @cached_property
    def _firsts(self) -> LongArray:
        return points_of(self.question).plan.share_firsts

    def _values(self, numbers: LongArray) -> FloatArray:
        """Values (n, k) of points whose numbers ascend."""
        bounds = np.searchsorted(numbers, self._firsts)
        values = np.empty((len(numbers), len(self.question.values)))
        for share in np.flatnonzero(np.diff(bounds)).tolist():
            rows = slice(*bounds[share : share + 2])
            values[rows] = self.store.load("values", share, "values")[numbers[rows] - self._firsts[share]]
        return values
