"""The last stage of every predicate: Python integers, sums of square roots, nothing rounded."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import gcd, isqrt

RootTerm = tuple[int, int]
"""(c, n) stands for c·√n, n ≥ 0."""


def sign(number: float) -> int:
    """−1, 0 or 1."""
    return (number > 0) - (number < 0)


def to_integers(values: Sequence[float]) -> list[int]:
    """All `values` times one common power of two, large enough to make every one an integer.

    Homogeneous polynomials keep their sign; doubles of any exponent, subnormals included, are taken exactly.
    """
    ratios = [value.as_integer_ratio() for value in values]
    common = max(denominator for _, denominator in ratios)
    return [numerator * (common // denominator) for numerator, denominator in ratios]


def primitive(vector: Sequence[float]) -> tuple[int, int, int]:
    """The shortest integer vector with the direction of three doubles: equal exactly when the directions are."""
    x, y, z = to_integers(vector)
    common = gcd(x, y, z)
    return x // common, y // common, z // common


def sign_of_roots(terms: Iterable[RootTerm]) -> int:
    """Sign of a sum of up to four c·√n, exactly.

    Two halves of opposite sign are compared by their squares, which leaves one root fewer: four terms become three,
    three become two, and two become one comparison of integers. No nested root ever appears.
    """
    merged = _merge(terms)
    if len(merged) <= 1:
        return sign(merged[0][0]) if merged else 0
    first, second = merged[:2], merged[2:]
    if not second:
        first, second = merged[:1], merged[1:]
    first_sign, second_sign = sign_of_roots(first), sign_of_roots(second)
    if first_sign * second_sign >= 0:
        return first_sign or second_sign
    return first_sign * sign_of_roots([*_square(first), *((-c, n) for c, n in _square(second))])


def _merge(terms: Iterable[RootTerm]) -> list[RootTerm]:
    """Collect equal radicands and take the roots of perfect squares: most exact input ends here."""
    collected: dict[int, int] = {}
    for coefficient, radicand in terms:
        root = isqrt(radicand)
        c, n = (coefficient * root, 1) if root * root == radicand else (coefficient, radicand)
        collected[n] = collected.get(n, 0) + c
    return [(c, n) for n, c in collected.items() if c]


def _square(terms: Sequence[RootTerm]) -> list[RootTerm]:
    """Square of one or two terms."""
    squares = sum(c * c * n for c, n in terms)
    if len(terms) == 1:
        return [(squares, 1)]
    (c, n), (d, m) = terms
    return [(squares, 1), (2 * c * d, n * m)]
