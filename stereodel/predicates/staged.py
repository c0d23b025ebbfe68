"""From a filtered value to signs: what all vectorised predicates share.

How the bounds beside the formulas are counted: in an expanded sum of products every term passes through at most N
roundings, each a factor 1 + δ with |δ| ≤ u = 2⁻⁵³. So the computed sum is off by at most ((1+u)^N − 1) times the
permanent, the sum of the absolute values of the exact terms. Bounds are stated with N + 1 in place of N: the whole u
between them is far more than what (1+u)^N − 1 − Nu and the roundings in the permanent and in the bound itself add.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray

SignArray = npt.NDArray[np.int8]
Number = TypeVar("Number", int, float, FloatArray)
Real = TypeVar("Real", float, FloatArray)
Pair = tuple[Real, Real]


def det3(a: Sequence[Number], b: Sequence[Number], c: Sequence[Number]) -> Number:
    """Determinant with rows a, b, c: five roundings a term in floats, none in integers."""
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


def columns(array: FloatArray) -> tuple[FloatArray, ...]:
    """Components of (..., d) as d arrays, so that one formula serves scalars and arrays."""
    return tuple(array[..., k] for k in range(array.shape[-1]))


def decide(value: FloatArray, bound: FloatArray, exact: Callable[[int], int]) -> SignArray:
    """Signs of `value` where it exceeds its error bound (k,), elsewhere `exact` of the row; NaN decides nothing."""
    signs = (value > bound).astype(np.int8) - (value < -bound)
    for row in np.flatnonzero(~(np.abs(value) > bound)).tolist():
        signs[row] = exact(row)
    return signs


def over_rows(signs: Callable[..., SignArray], *points: FloatArray) -> SignArray | int:
    """Apply `signs` of (k, d) arrays to points of any leading shape, broadcast together; an int for single points."""
    leading = np.broadcast_shapes(*(p.shape[:-1] for p in points))
    rows = [np.broadcast_to(p, (*leading, p.shape[-1])).reshape(-1, p.shape[-1]) for p in points]
    result = signs(*rows)
    return result.reshape(leading) if leading else int(result[0])
