"""Parts, blocks and their boxes, and the tree over these, against plain NumPy and exact numbers."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from stereodel import _kernel
from stereodel._spaces import space_of
from tests import sets, spaces

KINDS = [
    *sets.named("sphere", "random", "unit", "lengths", "mirrored", "1e-200 apart", "copied", "none"),
    *sets.named("plane", "random", "lattice", "line", "all sizes"),
]


def is_in_box(point, low, high):
    """Whether a box holds a point, or the unit vector of a direction: squares of exact numbers."""
    v = [Fraction(float(x)) for x in point]
    square = sum(x * x for x in v) if len(v) == 3 else Fraction(1)

    def at_least(x, bound):
        """x over the root of `square` is at least `bound`."""
        b = Fraction(float(bound))
        return (abs(x) * x >= abs(b) * b * square) if len(v) == 3 else x >= b

    return all(at_least(x, a) and at_least(-x, -b) for x, a, b in zip(v, low, high, strict=True))


@pytest.mark.parametrize("size", [1, 20, 10_000])
@pytest.mark.parametrize("kind", KINDS)
def test_blocks_hold_their_points(kind, size):
    points = kind.drawn(min(kind.size, 300) if size == 1 else 2000) if kind.name != "none" else kind.points
    order, starts, lows, highs = space_of(points).blocks(points, size)
    assert np.array_equal(np.sort(order), np.arange(len(points)))
    assert len(lows) == len(highs) == len(starts) - 1
    assert (starts[0], starts[-1]) == (0, len(points))
    assert (np.diff(starts) > 0).all()
    seen, names = set(), spaces.space_of(points).names(points)
    for (a, b), low, high in zip(pairwise(starts), lows, highs, strict=True):
        rows = points[order[a:b]]
        different = set(names[order[a:b]].tolist())
        assert b - a <= size or len(different) == 1
        assert not seen & different  # equal points stay together
        seen |= different
        for row in rows[:: max(1, len(rows) // 5)]:
            assert is_in_box(row, low, high)
        if points.shape[1] == 2:
            assert np.array_equal(low, rows.min(axis=0))
            assert np.array_equal(high, rows.max(axis=0))
        else:
            units = rows / np.abs(rows).max(axis=1)[:, None]
            units /= np.linalg.norm(units, axis=1)[:, None]
            assert np.allclose([low, high], [units.min(axis=0), units.max(axis=0)], rtol=1e-14, atol=1e-28)


def test_blocks_are_halves():
    order, starts, lows, highs = _kernel.plane.blocks(np.random.default_rng(5).normal(size=(3000, 2)), 100)
    assert np.diff(starts).min() >= 47
    assert np.diff(starts).max() <= 100
    assert len(order) == 3000
    assert np.ptp(lows, axis=0).min() > 0
    assert (highs - lows).max() < 5


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("leaves", [1, 2, 5, 8, 13])
def test_parts_of_a_tree(rng, kind, leaves):
    points = kind.points
    width = points.shape[1]
    axis, value = rng.integers(0, width, leaves - 1).astype(np.int32), rng.uniform(-0.5, 0.5, leaves - 1)
    if kind.name == "lattice":
        value = np.round(8 * value) + 8
    x = points
    if width == 3:
        x = points / np.abs(points).max(axis=1, initial=0)[:, None]
        x = x / np.linalg.norm(x, axis=1)[:, None]
    wanted = []
    for row in x:
        node = 0
        while node < leaves - 1:
            node = 2 * node + (1 if row[axis[node]] <= value[node] else 2)
        wanted.append(node - leaves + 1)
    assert space_of(points).part_of(points, axis, value).tolist() == wanted


def boxes(rng, n, width):
    low = rng.normal(size=(n, width))
    return low, low + 0.1 * rng.exponential(size=(n, width))


@pytest.mark.parametrize("n", [0, 1, 8, 9, 64, 65, 1000])
@pytest.mark.parametrize("width", [2, 3])
def test_tree_of_boxes(n, width):
    rng = np.random.default_rng(n)
    low, high = boxes(rng, n, width)
    space = _kernel.plane if width == 2 else _kernel.sphere
    lows, highs, first = space.box_tree(low, high)
    unread = rng.random(n) < 0.3
    counts = _kernel.unread_counts(unread, first)
    levels = [(low, high, unread.astype(int))]
    while len(levels[-1][0]) > 8:
        at = np.arange(0, len(levels[-1][0]), 8)
        a, b, c = levels[-1]
        levels.append((np.minimum.reduceat(a, at), np.maximum.reduceat(b, at), np.add.reduceat(c, at)))
    assert first.tolist() == np.cumsum([0, *(len(a) for a, _, _ in levels)]).tolist()
    for found, wanted in zip((lows, highs, counts), zip(*levels, strict=True), strict=True):
        assert np.array_equal(found, np.concatenate(wanted))
    chosen = ~unread & (rng.random(n) < 0.5)
    near = space.near_blocks(chosen, 0.8, lows, highs, first, counts)
    diagonal = np.linalg.norm(high - low, axis=1)
    gap = np.maximum(low[:, None] - high, low - high[:, None]).max(axis=2, initial=-9.0)
    close = gap <= 0.8 * np.minimum(diagonal[:, None], diagonal)
    assert np.array_equal(near, unread & (close & chosen[:, None]).any(axis=0))
    assert n < 100 or 0.02 < near.mean() < 0.9
