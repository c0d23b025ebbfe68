"""Before triangulation: duplicates, the first three points, a good order of insertion."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from stereodel._arrays import FloatArray, Indices, LongArray
from stereodel.predicates.rays import units
from stereodel.triangulation.sites import InsertionSites


def spanning_points(sites: InsertionSites, distinct: Sequence[int]) -> list[int]:
    """The first points in the given order that span: none, one, two on one line (great circle), or three.

    One less than their number is the dimension of the set. Two antipodal directions count as two although they lie on
    many great circles.
    """
    if len(distinct) < 3:
        return list(distinct)
    first = distinct[0]
    second = next(p for p in distinct[1:] if sites.independent(first, p))
    third = (p for p in distinct[1:] if sites.turn(first, second, p))
    return [first, second, *([p] if (p := next(third, None)) is not None else [])]


def insertion_order(points: FloatArray) -> Indices:
    """An order in which neighbours in the list are mostly neighbours in place, so that walks are short.

    Rounds of doubling size, drawn at random with a fixed seed, each along a Morton curve: N. Amenta, S. Choi, G. Rote,
    "Incremental constructions con BRIO" (2003). Speed alone depends on it.
    """
    places = units(points)[:, :3] if points.shape[1] == 3 else points
    drawn = np.random.default_rng(0).permutation(len(points))
    rounds = np.frexp(drawn + 1.0)[1]
    return np.lexsort([_morton(places), rounds])


def _morton(points: FloatArray) -> LongArray:
    """Interleaved bits of each point's cell in a grid of 2²⁰ cells a side over the bounding box."""
    with np.errstate(over="ignore", invalid="ignore"):
        low, high = points.min(axis=0, initial=np.inf), points.max(axis=0, initial=-np.inf)
        fractions = (points / 2 - low / 2) / np.maximum((high / 2 - low / 2).max(), np.finfo(float).tiny)
    # Bit b of every axis in turn: places whose keys begin alike lie in one cell of a coarser grid.
    cells = (np.nan_to_num(fractions) * (2**20 - 1)).astype(np.int64)
    keys = np.zeros(len(points), dtype=np.int64)
    for bit in range(20):
        for axis in range(points.shape[1]):
            keys |= ((cells[:, axis] >> bit) & 1) << (points.shape[1] * bit + axis)
    return keys
