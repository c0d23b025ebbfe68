"""From files to partitions: a sample for the k-d tree, shares of rows spread over its leaves, blocks of each leaf.

Where the files are compact, they are partitions already: nothing is spread.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray, LongArray
from stereodel._spaces import space_of
from stereodel.partitioned.plan import Piece, Plan
from stereodel.partitioned.shards import load, save, sums
from stereodel.partitioned.sources import read, some
from stereodel.partitioned.store import Store
from stereodel.partitioned.tree import SAMPLE, SAMPLE_OF_A_PART, Splits
from stereodel.sphere.vectors import units

GROUPS: Final = 512
"""Row groups that a sample reads in all, but one of each piece of a file at least: it need not read the whole input."""

SMALL_PARTS: Final = 2**16
"""Partitions that numbers of 16 bits count, which are sorted in one pass."""


def block_type(width: int) -> np.dtype[np.void]:
    """What is noted of a block: its box, its rows, one of its points, the number of that, CRC-32 of all."""
    corner = ("<f8", (width,))
    names = [("low", *corner), ("high", *corner), ("first", "<i8"), ("last", "<i8"), ("point", *corner)]
    return np.dtype([*names, ("number", "<i8"), ("sum", "<u4")])


def sample(store: Store, part: int) -> None:
    """Points of some rows, evenly spread over those that would be a partition."""
    plan = store.plan
    pieces = plan.parts[part]
    rows = sum(piece.last - piece.first for piece in pieces)
    total = max(SAMPLE, SAMPLE_OF_A_PART * len(plan.parts))
    groups = -(-GROUPS // len(plan.parts))
    points = np.concatenate(
        [
            points
            for file, first, last in pieces
            for points in some(
                plan.files[file], plan.places, first, last, -(-total * (last - first) // plan.size), groups
            )
        ]
    )
    files = store.save("sample", part, {"points": points if plan.places.width == 2 else units(points)})
    store.notes.keep("sample", {"points": len(points), "rows": rows}, files, task=part)


def points_of(plan: Plan, pieces: tuple[Piece, ...]) -> FloatArray:
    """Points of pieces, one after another.

    Raises ValueError where a file has fewer of the rows than it had.
    """
    points = np.empty((sum(piece.last - piece.first for piece in pieces), plan.places.width))
    filled = 0
    for piece in pieces:
        for rows in read(plan.files[piece.file], plan.places, piece.first, piece.last):
            points[filled : filled + len(rows)] = rows
            filled += len(rows)
    if filled < len(points):
        raise ValueError(f"{plan.files[pieces[0].file].path} and those after it have {filled} of {len(points)} rows")
    return points


def spread(store: Store, share: int) -> None:
    """Points of a share of the input in the order of partitions; where each of these begins, and its CRC-32."""
    plan = store.plan
    splits = splits_of(store)
    points = points_of(plan, plan.shares[share])
    parts = splits.parts(points)
    order = np.argsort(parts.astype(np.uint16) if splits.leaves <= SMALL_PARTS else parts, kind="stable")
    numbers = (order + plan.first_of(plan.shares[share])).astype(plan.number_type)
    starts = np.concatenate([[0], np.cumsum(np.bincount(parts, minlength=splits.leaves))])
    points = points[order]
    files = store.save(
        "spread", share, {"points": points, "numbers": numbers, "starts": starts_of(starts, points, numbers)}
    )
    store.notes.keep("spread", {"points": len(points)}, files, task=share)


def starts_of(starts: LongArray, *arrays: Any) -> LongArray:
    """Where slices of arrays begin, and the CRC-32 of each, (slices + 1, 2)."""
    return np.column_stack([starts, [*sums(starts, *arrays), 0]])


def splits_of(store: Store) -> Splits:
    """The k-d tree of a run."""
    return Splits(*(np.array(load(store.scratch / f"splits.{name}")) for name in ("axis", "value")))


def gather(store: Store) -> None:
    """Write where each partition begins in each share, (shares, parts + 1, 2), so that few files are opened."""
    starts = [store.load("spread", share, "starts") for share in range(len(store.plan.shares))]
    save(store.scratch / "spread" / "starts", np.stack(starts))


def collect(store: Store, part: int) -> None:
    """Points of a partition in blocks, out of the shares that were spread."""
    plan = store.plan
    points, numbers = [np.empty((0, plan.places.width))], [np.empty(0, plan.number_type)]
    starts = load(store.scratch / "spread" / "starts")
    for share, ((first, total), (last, _)) in enumerate(starts[:, part : part + 2].tolist()):
        if first < last:
            found = store.load_rows("spread", share, first, last, total, "points", "numbers")
            points.append(found[0])
            numbers.append(found[1])
    _keep(store, part, np.concatenate(points), np.concatenate(numbers))


def take(store: Store, part: int) -> None:
    """Points of a partition in blocks, out of the files that are one."""
    plan = store.plan
    points = points_of(plan, plan.parts[part])
    first = plan.first_of(plan.parts[part])
    _keep(store, part, points, np.arange(first, first + len(points)))


def _keep(store: Store, part: int, points: FloatArray, numbers: LongArray) -> None:
    """Write a partition."""
    plan = store.plan
    order, starts, lows, highs = space_of(points).blocks(points, plan.block)
    points, numbers = points[order], numbers[order].astype(plan.number_type)
    blocks = np.empty(len(lows), dtype=block_type(plan.places.width))
    blocks["low"], blocks["high"] = lows, highs
    blocks["first"], blocks["last"] = starts[:-1], starts[1:]
    blocks["point"], blocks["number"] = points[starts[:-1]], numbers[starts[:-1]]
    blocks["sum"] = sums(starts, points, numbers)
    arrays = {"points": points, "numbers": numbers, "blocks": blocks}
    store.notes.keep("collect", {"points": len(points)}, store.save("points", part, arrays), task=part)
