"""Trees: a k-d tree over a sample of the points, whose leaves are partitions; and whether files are as compact."""

from __future__ import annotations

from typing import Final

import numpy as np

from stereodel._arrays import FloatArray, IntArray
from stereodel._spaces import space_of
from stereodel.triangulation import PlanarDelaunay, SphericalDelaunay

SAMPLE: Final = 100_000
"""Rows of a sample, enough for leaves that differ in size by some per cent."""

SAMPLE_OF_A_PART: Final = 64
"""The least of them for each partition."""

COMPACT: Final = 2.0
"""How many times as many edges may join two partitions of files as join two leaves of a tree; see `is_compact`."""


class Splits:
    """A k-d tree in the order of a heap: the children of inner node k are 2k + 1 and 2k + 2, then come the leaves.

    axis, (leaves - 1,) array of int32: axis of each inner node.
    value, (leaves - 1,) array: points up to it go to the first child.
    """

    def __init__(self, axis: IntArray, value: FloatArray) -> None:
        self.axis, self.value = axis, value

    @classmethod
    def of(cls, sample: FloatArray, leaves: int) -> Splits:
        """The tree whose leaves have about equally many points of a sample: cut across the longest axis.

        sample, (n, 2) or (n, 3) array: points of the plane, or unit vectors.
        leaves: any number from 1.

        >>> splits = Splits.of(np.array([[0.0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [5, 0]]), 3)
        >>> splits.axis.tolist(), splits.value.tolist()
        ([0, 0], [3.0, 1.0])
        """
        inner = leaves - 1
        below = np.ones(2 * leaves - 1, dtype=np.int64)
        for node in reversed(range(inner)):
            below[node] = below[2 * node + 1] + below[2 * node + 2]
        axis, value = np.zeros(inner, dtype=np.int32), np.zeros(inner)
        rows = {0: sample}
        for node in range(inner):
            points = rows.pop(node)
            if len(points):
                axis[node] = np.argmax(0.5 * points.max(axis=0) - 0.5 * points.min(axis=0))  # halves do not overflow
                column = points[:, axis[node]]
                last = max(0, len(points) * int(below[2 * node + 1]) // int(below[node]) - 1)
                value[node] = np.partition(column, last)[last]
            first = points[:, axis[node]] <= value[node]
            rows[2 * node + 1], rows[2 * node + 2] = points[first], points[~first]
        return cls(axis, value)

    @property
    def leaves(self) -> int:
        """How many."""
        return len(self.axis) + 1

    def parts(self, points: FloatArray) -> IntArray:
        """Leaf of each point; directions of any length are taken as unit vectors."""
        return space_of(points).part_of(points, self.axis, self.value)


def is_compact(sample: FloatArray, parts: IntArray) -> bool:
    """Whether partitions are about as compact as the leaves of a tree, so that few points beside each are read.

    What a partition reads beyond its own points lies along its border. That is as long as the number of edges across
    it in a Delaunay triangulation of a sample of all points: at most `COMPACT` times as many as for a k-d tree with the
    same number of leaves. Pixels of HEALPix and files sorted along a space-filling curve have 1 to 1.5 times as many;
    files in the order of time, of names, or bands of latitude far more.

    sample, (n, 2) or (n, 3) array: points of the plane, or unit vectors.
    parts, (n,) array of int: the partition of each point.

    >>> points = np.random.default_rng(1).uniform(size=(4000, 2))
    >>> squares = (points[:, 0] * 4).astype(np.int32) * 4 + (points[:, 1] * 4).astype(np.int32)
    >>> is_compact(points, squares), is_compact(points, np.arange(4000, dtype=np.int32) % 16)
    (True, False)
    """
    count = len(np.unique(parts))
    if count < 2:
        return True
    mesh = PlanarDelaunay(sample) if sample.shape[1] == 2 else SphericalDelaunay(sample)
    ends = mesh.edges
    leaves = Splits.of(sample, count).parts(sample)
    across, usual = (np.count_nonzero(labels[ends[:, 0]] != labels[ends[:, 1]]) for labels in (parts, leaves))
    return bool(across <= COMPACT * usual)
