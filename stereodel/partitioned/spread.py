"""From files to partitions: a sample for the k-d tree, shares of rows spread over its leaves, blocks of each leaf.

Where the files are compact, they are partitions already: nothing is spread.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, IntArray, LongArray
from stereodel._spaces import space_of, surface_of
from stereodel.partitioned.files import read, sampled
from stereodel.partitioned.plan import Plan, RowRange
from stereodel.partitioned.store import Left, Store, load, save, starts_of, sums
from stereodel.sphere.vectors import units

GROUPS: Final = 512
"""Row groups that a sample reads in all, but one of each piece of a file at least: it need not read the whole input."""

SAMPLE: Final = 100_000
"""Rows of a sample, enough for leaves that differ in size by some per cent; 64 of each partition at least."""

COMPACT: Final = 2.0
"""How many times as many edges may join two partitions of files as join two leaves of a tree; see `is_compact`."""

NODE: Final = np.dtype([("axis", "<i4"), ("value", "<f8")])
"""An inner node of a k-d tree: points whose coordinate is up to the value go to the first child."""


def tree_of(sample: FloatArray, leaves: int) -> npt.NDArray[np.void]:
    """The k-d tree whose leaves have about equally many points of a sample, cut across the longest axis: inner nodes.

    They stand in the order of a heap: the children of inner node k are 2k + 1 and 2k + 2, then come the leaves.
    """
    inner = leaves - 1
    below = np.ones(2 * leaves - 1, dtype=np.int64)
    for node in reversed(range(inner)):
        below[node] = below[2 * node + 1] + below[2 * node + 2]
    tree = np.zeros(inner, dtype=NODE)
    rows = {0: sample}
    for node in range(inner):
        points, axis, value = rows.pop(node), 0, 0.0
        if len(points):
            axis = int(np.argmax(0.5 * points.max(axis=0) - 0.5 * points.min(axis=0)))  # halves do not overflow
            last = max(0, len(points) * int(below[2 * node + 1]) // int(below[node]) - 1)
            value = np.partition(points[:, axis], last)[last]
        tree[node] = axis, value
        first = points[:, axis] <= value
        rows[2 * node + 1], rows[2 * node + 2] = points[first], points[~first]
    return tree


def leaves_of(points: FloatArray, tree: npt.NDArray[np.void]) -> IntArray:
    """Leaf of each point; directions of any length are taken as unit vectors."""
    return space_of(points).part_of(points, *(np.ascontiguousarray(tree[name]) for name in ("axis", "value")))


def is_compact(sample: FloatArray, parts: IntArray) -> bool:
    """Whether partitions are about as compact as the leaves of a tree, so that few points beside each are read.

    What a partition reads beyond its own points lies along its border. That is as long as the number of edges across
    it in a Delaunay triangulation of a sample of all points: at most `COMPACT` times as many as for a k-d tree with the
    same number of leaves. Pixels of HEALPix and files sorted along a space-filling curve have 1 to 1.5 times as many;
    files in the order of time, of names, or bands of latitude far more.
    """
    count = len(np.unique(parts))
    if count < 2:
        return True
    ends = surface_of(sample).delaunay(sample).edges
    leaves = leaves_of(sample, tree_of(sample, count))
    across, usual = (np.count_nonzero(labels[ends[:, 0]] != labels[ends[:, 1]]) for labels in (parts, leaves))
    return bool(across <= COMPACT * usual)


def sample(store: Store, part: int) -> Left:
    """Points of some rows, evenly spread over those that would be a partition."""
    plan = store.plan
    total = max(SAMPLE, 64 * len(plan.parts))
    groups = -(-GROUPS // len(plan.parts))
    found: list[FloatArray] = []
    for file, first, last in plan.parts[part]:
        count = -(-total * (last - first) // plan.size)
        found += sampled(plan.files[file], plan.columns, first, last, count, groups)
    points = np.concatenate(found)
    return {}, store.save("sample", part, {"points": points if plan.columns.width == 2 else units(points)})


def is_laid_out(store: Store) -> bool:
    """Whether the files are partitions, by the samples of all; if they are not, the tree is written."""
    plan = store.plan
    samples = [np.asarray(store.load("sample", part, "points")) for part in range(len(plan.parts))]
    points = np.concatenate(samples)
    labels = np.repeat(np.arange(len(samples), dtype=np.int32), [len(each) for each in samples])
    compact = plan.compact is None and is_compact(points, labels)
    if not compact:
        save(store.scratch / "splits", tree_of(points, -(-plan.size // plan.partition)))
    return compact


def points_of(plan: Plan, ranges: Sequence[RowRange]) -> FloatArray:
    """Points of ranges of rows, one after another."""
    points = np.empty((sum(last - first for _, first, last in ranges), plan.columns.width))
    filled = 0
    for file, first, last in ranges:
        for rows in read(plan.files[file], plan.columns, first, last):
            points[filled : filled + len(rows)] = rows
            filled += len(rows)
    if filled < len(points):
        raise ValueError(f"{plan.files[ranges[0].file].path} and those after it have {filled} of {len(points)} rows")
    return points


def spread(store: Store, share: int) -> Left:
    """Points of a share of the input in the order of partitions; where each of these begins, and its CRC-32."""
    plan, tree = store.plan, load(store.scratch / "splits")
    points, first = points_of(plan, plan.shares[share]), plan.share_firsts[share]
    parts, leaves = leaves_of(points, tree), len(tree) + 1
    order = np.argsort(parts.astype(np.uint16) if leaves <= 2**16 else parts, kind="stable")  # 16 bits take one pass
    numbers = (order + first).astype(plan.number_type)
    points, bounds = points[order], np.cumsum(np.bincount(parts, minlength=leaves))
    starts = starts_of(np.append(0, bounds), points, numbers)
    return {}, store.save("spread", share, {"points": points, "numbers": numbers, "starts": starts})


def collect(store: Store, part: int) -> Left:
    """Points of a partition in blocks, out of the shares that were spread."""
    found = [slices for _, slices in store.slices("spread", part, "points", "numbers")]
    points = np.concatenate([np.empty((0, store.plan.columns.width)), *(each[0] for each in found)])
    numbers = np.concatenate([np.empty(0, store.plan.number_type), *(each[1] for each in found)])
    return _keep(store, part, points, numbers)


def take(store: Store, part: int) -> Left:
    """Points of a partition in blocks, out of the files that are one."""
    points = points_of(store.plan, store.plan.parts[part])
    first = store.plan.first_of(store.plan.parts[part])
    return _keep(store, part, points, np.arange(first, first + len(points)))


def _keep(store: Store, part: int, points: FloatArray, numbers: LongArray) -> Left:
    """Write a partition: its points in blocks, and of each block its box, its rows, one of its points, and CRC-32."""
    plan, width = store.plan, store.plan.columns.width
    order, starts, lows, highs = space_of(points).blocks(points, plan.block)
    points, numbers = points[order], numbers[order].astype(plan.number_type)
    corner = ("<f8", (width,))
    names = [("low", *corner), ("high", *corner), ("first", "<i8"), ("last", "<i8"), ("point", *corner)]
    blocks = np.empty(len(lows), dtype=[*names, ("number", "<i8"), ("sum", "<u4")])
    blocks["low"], blocks["high"] = lows, highs
    blocks["first"], blocks["last"] = starts[:-1], starts[1:]
    blocks["point"], blocks["number"] = points[starts[:-1]], numbers[starts[:-1]]
    blocks["sum"] = sums(starts, points, numbers)
    arrays = {"points": points, "numbers": numbers, "blocks": blocks}
    return {"points": len(points)}, store.save("points", part, arrays)
