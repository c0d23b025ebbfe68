"""From files to partitions: a sample for the k-d tree, shares of rows spread over its leaves, blocks of each leaf.

Where the files are compact, they are partitions already: nothing is spread.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray, LongArray
from stereodel._spaces import space_of
from stereodel.partitioned.plan import Piece, Plan
from stereodel.partitioned.shards import load, save
from stereodel.partitioned.sources import read, some
from stereodel.partitioned.store import Store
from stereodel.partitioned.tree import SAMPLE, SAMPLE_OF_A_PART, Splits
from stereodel.sphere.vectors import units

GROUPS: Final = 512
"""Row groups that a sample reads in all, but one of each piece of a file at least: it need not read the whole input."""

SMALL_PARTS: Final = 2**16
"""Partitions that numbers of 16 bits count, which are sorted in one pass."""


def block_type(width: int) -> np.dtype[np.void]:
    """What is noted of a block: its box, its first row and the row after, one of its points, the number of that."""
    corner = ("<f8", (width,))
    names = [("low", *corner), ("high", *corner), ("first", "<i8"), ("last", "<i8"), ("point", *corner)]
    return np.dtype([*names, ("number", "<i8")])


def sample(store: Store, part: int) -> dict[str, Any]:
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
    return store.keep("sample", part, {"points": len(points), "rows": rows}, files)


def points_of(plan: Plan, pieces: tuple[Piece, ...]) -> FloatArray:
    """Points of pieces, one after another."""
    points = np.empty((sum(piece.last - piece.first for piece in pieces), plan.places.width))
    filled = 0
    for piece in pieces:
        for rows in read(plan.files[piece.file], plan.places, piece.first, piece.last):
            points[filled : filled + len(rows)] = rows
            filled += len(rows)
    return points


def spread(store: Store, share: int) -> dict[str, Any]:
    """Points of a share of the input in the order of partitions, and where each of these begins."""
    plan = store.plan
    splits = splits_of(store)
    points = points_of(plan, plan.shares[share])
    parts = splits.parts(points)
    order = np.argsort(parts.astype(np.uint16) if splits.leaves <= SMALL_PARTS else parts, kind="stable")
    numbers = (order + plan.first_of(plan.shares[share])).astype(plan.number_type)
    starts = np.concatenate([[0], np.cumsum(np.bincount(parts, minlength=splits.leaves))])
    files = store.save("spread", share, {"points": points[order], "numbers": numbers, "starts": starts})
    return store.keep("spread", share, {"points": len(points)}, files)


def splits_of(store: Store) -> Splits:
    """The k-d tree of a run."""
    return Splits(*(np.array(load(store.scratch / f"splits.{name}.npy")) for name in ("axis", "value")))


def gather(store: Store) -> None:
    """Write where each partition begins in each share, (shares, parts + 1), so that few files are opened."""
    starts = [store.load("spread", share, "starts") for share in range(len(store.plan.shares))]
    save(store.scratch / "spread" / "starts.npy", np.stack(starts))


def collect(store: Store, part: int) -> dict[str, Any]:
    """Points of a partition in blocks, out of the shares that were spread."""
    plan = store.plan
    points, numbers = [], []
    starts = load(store.scratch / "spread" / "starts.npy")
    for share, (first, last) in enumerate(starts[:, part : part + 2].tolist()):
        if first < last:
            points.append(store.load_rows("spread", share, "points", first, last))
            numbers.append(store.load_rows("spread", share, "numbers", first, last))
    width, kind = plan.places.width, plan.number_type
    return _keep(
        store, part, np.concatenate([np.empty((0, width)), *points]), np.concatenate([np.empty(0, kind), *numbers])
    )


def take(store: Store, part: int) -> dict[str, Any]:
    """Points of a partition in blocks, out of the files that are one."""
    plan = store.plan
    points = points_of(plan, plan.parts[part])
    first = plan.first_of(plan.parts[part])
    return _keep(store, part, points, np.arange(first, first + len(points)))


def _keep(store: Store, part: int, points: FloatArray, numbers: LongArray) -> dict[str, Any]:
    """Write a partition."""
    plan = store.plan
    order, starts, lows, highs = space_of(points).blocks(points, plan.block)
    points, numbers = points[order], numbers[order]
    blocks = np.empty(len(lows), dtype=block_type(plan.places.width))
    blocks["low"], blocks["high"] = lows, highs
    blocks["first"], blocks["last"] = starts[:-1], starts[1:]
    blocks["point"], blocks["number"] = points[starts[:-1]], numbers[starts[:-1]]
    arrays = {"points": points, "numbers": numbers.astype(plan.number_type), "blocks": blocks}
    return store.keep("collect", part, {"points": len(points)}, store.save("points", part, arrays))
