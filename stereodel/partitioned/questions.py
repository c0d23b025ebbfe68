"""Questions at targets: nearest points and values between points, from those nearby that were read.

An answer is final if it rests on bubbles, or on the disc around the target through its farthest nearest point, that
touch the box of no block that was not read. Targets that would need more points than memory is to hold are halved, near
ones together.

Points are triangulated in the order of their numbers: the lowest of several near points is the first one, and sums go
in the order that they have in memory.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices, LongArray
from stereodel._tasks.kept import Note
from stereodel.interpolation import LinearInterpolator, NaturalNeighborInterpolator
from stereodel.partitioned.files import FilesGiven, doubles_of, slices, unchanged
from stereodel.partitioned.passes import Execution, Passes, Results, execute, totals
from stereodel.partitioned.plan import Plan, Question, source_of
from stereodel.partitioned.rounds import Index, Mesh, Rounds, Sample, Verdict, clock, measured, triangulation
from stereodel.partitioned.stars import distances, write_rows
from stereodel.partitioned.store import KEPT, Columns, Left, Store, load_plan
from stereodel.triangulation import SphericalDelaunay

ROOM: Final = 1_000_000
"""Points that are read at once for several targets at most, some 0.5 GB; a single target may need more."""

INTERPOLATORS: Final = {"linear": LinearInterpolator, "natural": NaturalNeighborInterpolator}
"""By the name of the method."""

FAMILY: Final = {
    "targets": """
        targets : path-like or sequence of path-like
            Files of targets, as those of points in `triangulate`.
        out : path-like
            A folder for the results, which is made.
        """,
    "options": """
        columns : sequence of str, optional
            Names of the columns that say where targets are, as in `triangulate`. Surface and kind of latitude are those
            of the points.
        kind, keep, execution
            As in `triangulate`, of the targets.
        """,
    "returns": """
        Answers
            ``rows/`` has a file for each file of targets, with the same name, number and order of rows.
        """,
    "raises": """
        FileNotFoundError
            If the run was made without ``index=True``.
        ValueError
            If a row is not a target, naming file, row and value; for columns that are not there; where answers in `out`
            were begun with other files or arguments, or files changed, as in `triangulate`.
        TypeError
            For targets or values of another type than numbers.
        MemoryError
            Where a target needs more than `Execution.limit` points, with its number.
        RuntimeError, OSError, ImportError
            As in `triangulate`.
        """,
}
"""Parts shared by the docstrings of questions."""


class Answers(Results):
    """What a run answered at targets, in a folder; nothing is loaded until it is asked for.

    Parameters
    ----------
    folder : path-like
        Which `Run.nearest` or `Run.interpolate` wrote.

    Attributes
    ----------
    statistics : dict
        ``targets``, and ``surface``, ``compact``, ``partitions``, ``rounds``, ``read``, ``largest`` and ``cpu`` as of
        `Run`.
    partitions : list of dict
        The same of each partition that has targets, by its number, ``part``.

    Raises
    ------
    FileNotFoundError
        If no run ended there.
    """


Certified = tuple[Columns, BoolArray, FloatArray]
"""Answers at targets, which of them are open, and how deep those reach into each block that was not read."""


@dataclass
class TargetRounds(Rounds[tuple[Indices, Columns]]):
    """The targets of a partition, and what a question computes at them."""

    store: Store
    points: FloatArray  # near ones next to one another
    numbers: LongArray

    @cached_property
    def question(self) -> Question:
        """What is computed."""
        return question_of(self.store.plan)

    def all(self) -> Iterator[tuple[Indices, Columns]]:
        """Rows of targets, and their answers, until all have theirs."""
        waiting = [np.arange(len(self.points))]
        while waiting:
            rows = waiting.pop()
            room = self.limit if len(rows) == 1 else min(ROOM, self.limit)
            left, count = yield from self.answers(rows, np.zeros(len(self.index), dtype=np.bool_), room)
            if len(left) == 1 and count > self.limit:
                raise MemoryError(
                    f"target {self.numbers[left[0]]} may need {count} points at once, more than limit={self.limit}; "
                    "give a higher limit"
                )
            if len(left):
                waiting += [left[len(left) // 2 :], left[: len(left) // 2]]

    def decide(self, sample: Sample, pending: Indices, unread: BoolArray) -> Verdict[tuple[Indices, Columns]]:
        """Answers at some targets that are final."""
        sample = sample.sorted()
        mesh = triangulation(sample.points)
        certified = self._interpolated if self.question.values else self._nearest
        columns, is_open, depth = certified(mesh, sample.numbers, self.points[pending], unread)
        left, core = pending[is_open], np.zeros_like(unread)
        if len(left) and not unread.all():
            core[sample.blocks[np.asarray(mesh.nearest(self.points[left], workers=1))]] = True
        final = pending[~is_open], {name: column[~is_open] for name, column in columns.items()}
        return final, left, depth, core & ~unread, len(left) * int(self.index.sizes.max(initial=0))

    def _nearest(self, mesh: Mesh, numbers: LongArray, targets: FloatArray, unread: BoolArray) -> Certified:
        """A target is open if the disc around it through the last of its nearest points touches an unread block."""
        wanted = self.question.k or 1
        k = min(wanted, len(numbers))
        found = np.asarray(mesh.nearest(targets, k=k, workers=1))
        farthest = np.ascontiguousarray(mesh.points[found[:, -1]])
        is_open, depth = self.index.space.open_discs(targets, farthest, *self.index.tree(unread))
        if k < wanted:
            return {}, np.ones(len(targets), dtype=np.bool_), depth if depth.any() else unread.astype(np.float64)
        away = distances(np.repeat(targets, k, axis=0), mesh.points[found.ravel()]).reshape(found.shape)
        columns: Columns = {"nearest": numbers[found], "distance": away}
        if self.question.k is None:
            columns = {name: column[:, 0] for name, column in columns.items()}
        return columns, is_open, depth

    def _interpolated(self, mesh: Mesh, numbers: LongArray, targets: FloatArray, unread: BoolArray) -> Certified:
        """A target is open if its value rests on triangles, or edges of the hull, whose bubbles touch unread blocks."""
        names, natural = self.question.values, self.question.method == "natural"
        values = np.full((len(targets), len(names)), np.nan)
        closing = mesh.closing if isinstance(mesh, SphericalDelaunay) else None
        if self.question.flat:  # there are values at the points themselves
            nearest = np.ascontiguousarray(mesh.points[np.asarray(mesh.nearest(targets, workers=1))])
            is_open, depth = self.index.space.open_discs(targets, nearest, *self.index.tree(unread))
        elif mesh.dimension < 2 or (closing is not None and closing.all()):  # any other point will do
            is_open, depth = np.full(len(targets), unread.any()), unread.astype(np.float64)
        else:
            is_open, depth = self.index.space.open_targets(
                mesh.points,
                mesh.simplices,
                mesh.neighbors,
                targets,
                *self.index.tree(unread),
                closing=closing,
                natural=natural,
                checked=True,
            )
        if not is_open.all():
            function = INTERPOLATORS[self.question.method](mesh, self._values(numbers))
            values[~is_open] = function(targets[~is_open], workers=1)
        return dict(zip(names, values.T, strict=True)), is_open, depth

    def _values(self, numbers: LongArray) -> FloatArray:
        """Values (n, k) of points whose numbers ascend."""
        firsts = points_of(self.question).plan.share_firsts
        bounds = np.searchsorted(numbers, firsts)
        values = np.empty((len(numbers), len(self.question.values)))
        for share in np.flatnonzero(np.diff(bounds)).tolist():
            rows = slice(*bounds[share : share + 2])
            values[rows] = self.store.load("values", share, "values")[numbers[rows] - firsts[share]]
        return values


def question_of(plan: Plan) -> Question:
    """What a plan computes at targets."""
    assert plan.question is not None
    return plan.question


def points_of(question: Question) -> Store:
    """The points that answer, as their run left them."""
    return Store.ended(Path(question.run))


def take_values(store: Store, share: int) -> Left:
    """Values of a share of the points, in their order, as an array that later tasks map."""
    question = question_of(store.plan)
    plan, names = points_of(question).plan, question.values
    values: list[FloatArray] = []
    for file, first, last in plan.shares[share]:
        with unchanged(plan.files[file]) as content:
            for low, table in slices(content, names, first, last):
                rows = range(low + 1, low + 1 + table.num_rows)
                values.append(np.column_stack([doubles_of(table[name], name, rows, gaps=True) for name in names]))
    return {}, store.save("values", share, {"values": np.concatenate(values)})


def answer(store: Store, part: int, limit: int) -> Left:
    """The answers at a partition's targets."""
    began, plan, question = clock(), store.plan, question_of(store.plan)
    points, numbers = (np.array(store.load("points", part, name)) for name in ("points", "numbers"))
    columns: Columns = {"number": numbers}
    for name, kind in plan.row_kinds.items():
        columns[name] = np.full((len(numbers), *kind.shape), np.nan if question.values else 0, dtype=kind.base)
    sizes: list[int] = []
    if (known := points_of(question)).plan.size:
        for rows, found in TargetRounds(Index(known), limit, store, points, numbers, sizes=sizes).all():
            for name, column in found.items():
                columns[name][rows] = column
    order = np.argsort(numbers)
    files = write_rows(store, part, {name: column[order] for name, column in columns.items()})
    return {"points": len(numbers)} | measured(sizes, began), files


def indexed(folder: Path) -> Plan:
    """The plan of a run whose points are kept for targets."""
    plan = load_plan(folder)
    if not plan.index or (plan.size and not (folder / KEPT).is_dir()):
        raise FileNotFoundError(
            f"{folder} has no index of its points, which targets need; triangulate them with index=True, "
            "in this folder with resume=False"
        )
    return plan


def ask(
    question: Question,
    names: Sequence[str],
    targets: FilesGiven,
    out: str | os.PathLike[str],
    columns: Sequence[str] | None,
    kind: str,
    keep: Sequence[str],
    execution: Execution,
) -> Answers:
    """Answers in a folder, in columns of these names, at targets in files."""
    places = points_of(question).plan.columns
    source = source_of(targets, kind, columns, places.surface, places.latitude, keep, names)
    plan = Plan.of(source, partition=int(execution.partition), rows=tuple(names), question=question)
    return Answers(execute(_answers, source, plan, out, execution))


def _answers(passes: Passes, parts: list[int]) -> tuple[dict[str, Any], list[Note]]:
    """Answers at all targets."""
    store, plan, notes = passes.store, passes.store.plan, []
    if parts:
        question = question_of(plan)
        if question.values and store.notes.note("answer") is None:
            passes.do("values", take_values, range(len(points_of(question).plan.shares)))
        notes = passes.do("answer", answer, parts, limit=passes.limit)
        if store.notes.note("align") is None:
            store.gather("stars", parts)
        store.drop("points", "values")
    return {"surface": plan.columns.surface, "targets": plan.size} | totals(notes), notes
