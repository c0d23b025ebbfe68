"""Targets: rows of files at which a run that ended answers for its points, as it answers for the points themselves."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any, Final, NamedTuple

import stereodel
from stereodel._arrays import as_choice, as_count
from stereodel._extras import of_extra
from stereodel.io.formats.names import listed
from stereodel.partitioned import rows as rows_of
from stereodel.partitioned.answers import INTERPOLATORS, answer, points_of, take_values
from stereodel.partitioned.kinds import source_of
from stereodel.partitioned.passes import REPORT, Means, Passes, Results
from stereodel.partitioned.plan import Plan, Question
from stereodel.partitioned.shards import load_json
from stereodel.partitioned.sources import Given, opened
from stereodel.partitioned.store import KEPT

NEAREST: Final = ("nearest", "distance")
"""Columns of the rows about nearest points."""

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
        kind, keep, partition, executor, jobs, scratch, resume, progress
            As in `triangulate`, of the targets.
        limit : int
            Points that a worker may triangulate at once.
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
            Where a target needs more than `limit` points, naming it.
        RuntimeError, OSError, ImportError
            As in `triangulate`.
        """,
}
"""Parts shared by the docstrings of questions."""


class Targets(NamedTuple):
    """Files of targets, and how they are read; as `source` and its options in `triangulate`."""

    files: Given
    columns: Sequence[str] | None
    kind: str
    keep: Sequence[str]
    partition: int


class Answers(Results):
    """What a run answered at targets, in a folder; nothing is loaded until it is asked for.

    Parameters
    ----------
    folder : path-like
        Which `Run.nearest` or `Run.interpolate` wrote.

    Attributes
    ----------
    statistics : dict
        ``surface``, ``targets``, ``compact`` (whether their files served as partitions), ``partitions``, ``rounds``
        (the most of one), ``read`` (points in all triangulations), ``largest`` (points of the largest), ``cpu``
        (seconds of all workers in them).
    partitions : list of dict
        The same of each partition that has targets, by its number, ``part``.

    Raises
    ------
    FileNotFoundError
        If no run ended there.
    """


@of_extra("partitioned")
def nearest(
    folder: Path,
    targets: Targets,
    k: int | None,
    means: Means,
) -> Answers:
    """Nearest points at targets, of the run in a folder."""
    plan = _points(folder)
    if not plan.size:
        raise ValueError("nearest needs at least one point; this run has none")
    count = None if k is None else as_count(k, "k", high=plan.size)
    question = Question(str(folder.absolute()), plan.digest, "nearest", k=count)
    return _answered(plan, question, NEAREST, targets, means)


@of_extra("partitioned")
def interpolate(
    folder: Path,
    targets: Targets,
    values: str | Sequence[str],
    method: str,
    means: Means,
) -> Answers:
    """Values at targets, between the points of the run in a folder."""
    plan = _points(folder)
    chosen = as_choice(method, tuple(INTERPOLATORS), "method")
    names = (values,) if isinstance(values, str) else tuple(dict.fromkeys(values))
    if not names:
        raise ValueError("values is empty; name one or more columns of the files of points")
    for file in plan.files:
        file.check()
        there = opened(file.path).schema_arrow.names
        missing = [name for name in names if name not in there]
        if missing:
            raise ValueError(
                f"values has {missing[0]!r}, which is not one of the columns {listed(there)} of {file.path}"
            )
    flat = not load_json(folder / REPORT)["statistics"]["triangles"]
    question = Question(str(folder.absolute()), plan.digest, chosen, values=names, flat=flat)
    return _answered(plan, question, names, targets, means)


def _points(folder: Path) -> Plan:
    """The plan of a run that can be asked."""
    plan = Plan.load(folder)
    if not plan.index or (plan.size and not (folder / KEPT).is_dir()):
        raise FileNotFoundError(
            f"{folder} has no index of its points, which targets need; triangulate them with index=True, "
            "in this folder with resume=False"
        )
    return plan


def _answered(
    points: Plan,
    question: Question,
    names: Sequence[str],
    targets: Targets,
    means: Means,
) -> Answers:
    places = points.places
    source = source_of(
        targets.files, targets.kind, targets.columns, places.surface, places.latitude, targets.keep, names
    )
    plan = Plan.of(
        source,
        version=stereodel.__version__,
        partition=as_count(targets.partition, "partition"),
        rows=tuple(names),
        triangles=False,
        cells=False,
        question=question,
    )
    return Answers(means.run(_Answering, source, plan))


class _Answering(Passes):
    """Answers at all targets."""

    def results(self, parts: list[int]) -> tuple[dict[str, Any], list[dict[str, Any]]]:
        """What is asked at all targets."""
        plan = self.store.plan
        told = self._answers(parts) if parts else []
        report = {
            "surface": plan.places.surface,
            "targets": plan.size,
            "partitions": len(told),
            "rounds": max((each["rounds"] for each in told), default=0),
            "read": sum(each["read"] for each in told),
            "largest": max((each["largest"] for each in told), default=0),
            "cpu": sum(each["cpu"] for each in told),
        }
        return report, told

    def _answers(self, parts: list[int]) -> list[dict[str, Any]]:
        """What there is to say of each partition."""
        store, question = self.store, self.store.plan.question
        assert question is not None
        if question.values and not question.flat and store.notes.note("answer") is None:
            self.do("values", partial(take_values, store), range(len(points_of(question).plan.shares)))
        told = self.do("answer", partial(answer, store, limit=self.limit), parts)
        if store.notes.note("align") is None:
            rows_of.gather(store, parts)
        store.drop("points", "values")
        return told
