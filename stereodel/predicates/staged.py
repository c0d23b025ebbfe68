"""Numbers of any kind in the formulas of the predicates.

How the bounds beside the formulas are counted: in an expanded sum of products every term passes through at most N
roundings, each a factor 1 + δ with |δ| ≤ u = 2⁻⁵³. So the computed sum is off by at most ((1+u)^N − 1) times the
permanent, the sum of the absolute values of the exact terms. Bounds are stated with N + 1 in place of N: the whole u
between them is far more than what (1+u)^N − 1 − Nu and the roundings in the permanent and in the bound itself add.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from stereodel._arrays import FloatArray

Number = TypeVar("Number", int, float, FloatArray)
Real = TypeVar("Real", float, FloatArray)
Pair = tuple[Real, Real]


def det3(a: Sequence[Number], b: Sequence[Number], c: Sequence[Number]) -> Number:
    """Determinant with rows a, b, c: five roundings a term in floats, none in integers."""
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


def columns(array: FloatArray) -> tuple[FloatArray, ...]:
    """Components of (..., d) as d arrays, so that one formula serves scalars and arrays."""
    return tuple(array[..., k] for k in range(array.shape[-1]))
