"""Integer vectors: products and unit vectors."""

from __future__ import annotations

from math import isqrt


def integer_cross(a: tuple[int, int, int], b: tuple[int, int, int]) -> tuple[int, int, int]:
    """Vector product of integer vectors."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def integer_unit(vector: list[int] | tuple[int, int, int]) -> list[float]:
    """Unit vector of an integer vector, each component rounded from at least 64 further bits."""
    squared = sum(x * x for x in vector)
    root = isqrt(squared << 128)
    return [(x << 64) / root for x in vector]
