"""Exact signs for `check_delaunay`, written apart from the predicates of the engines (they share no code).

Two stages: a float filter whose bound is derived beside it, then Python integers. Rows that the filter leaves open are
few in general position and all of them in sets full of ties; both stages are vectorised over rows of point numbers.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from stereodel._arrays import BigIntegers, FloatArray, LongArray, SignArray
from stereodel._double_double import scaled, two_prod
from stereodel.constants import FILTER_RANGE, UNDERFLOW_FLOOR, UNIT_ROUNDOFF

_BLOCK = 1 << 16  # rows at a time: the temporaries of one block stay in the cache


class _Signs:
    """Signs of points, given by their numbers."""

    def __init__(self, points: FloatArray) -> None:
        self.points = points
        self.exact_tests = 0

    def _decide(self, rows: LongArray, estimate: Any, exact: Any) -> SignArray:
        """Of rows (k, m) of numbers, by an estimate with its bound, and exactly where that leaves them open."""
        signs = np.zeros(len(rows), dtype=np.int8)
        for start in range(0, len(rows), _BLOCK):
            block = rows[start : start + _BLOCK]
            with np.errstate(over="ignore", invalid="ignore", under="ignore"):
                value, bound = estimate(block)
            # Written so that an overflow to NaN or infinity is undecided as well.
            undecided = np.flatnonzero(~(np.abs(value) > bound))
            block_signs = (value > 0).astype(np.int8) - (value < 0)
            block_signs[undecided] = exact(block[undecided])
            self.exact_tests += len(undecided)
            signs[start : start + _BLOCK] = block_signs
        return signs


class PlaneSigns(_Signs):
    """Orientation and incircle signs of points (n, 2) of the plane."""

    surface: Final = "plane"

    def turn(self, rows: LongArray) -> SignArray:
        """Sign of the area of the triangle a b c, (k,) from (k, 3): > 0 counterclockwise."""
        return self._of_places(rows, _turn_filter, _turn_integers)

    def circle(self, rows: LongArray) -> SignArray:
        """Sign of d against the circle of a counterclockwise triangle a b c, (k,) from (k, 4): > 0 inside."""
        return self._of_places(rows, _circle_filter, _circle_integers)

    def _of_places(self, rows: LongArray, estimate: Any, exact: Any) -> SignArray:
        points = self.points
        return self._decide(rows, lambda some: estimate(points[some]), lambda few: exact(_shifted(points[few], (1, 2))))


def _turn_filter(p: FloatArray) -> tuple[FloatArray, FloatArray]:
    # Each difference carries one factor (1 + u), each product two of those and its own, the last difference one more:
    # |error| ≤ ((1 + u)⁴ − 1)(|left| + |right|) at the very most, but the last factor multiplies the small result, so
    # that 3u and second-order terms remain: 4u covers them and the rounding of the bound.
    d = p[:, 1:] - p[:, :1]
    left, right = d[:, 0, 0] * d[:, 1, 1], d[:, 0, 1] * d[:, 1, 0]
    return left - right, _outside_range(d) + 4 * UNIT_ROUNDOFF * (np.abs(left) + np.abs(right))


def _circle_filter(p: FloatArray) -> tuple[FloatArray, FloatArray]:
    # Factors (1 + u) on a term: 4 in the 2×2 minor (two differences, product, difference), 4 in |d|² (twice the
    # difference, product, sum), 1 for their product, 2 for the sums: (1 + u)¹¹ − 1 < 11.01u times the permanent.
    d = p[:, :3] - p[:, 3:]
    x, y = d[..., 0], d[..., 1]
    value = bound = np.zeros(len(p))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        lift = x[:, i] ** 2 + y[:, i] ** 2
        left, right = x[:, j] * y[:, k], x[:, k] * y[:, j]
        value = value + lift * (left - right)
        bound = bound + lift * (np.abs(left) + np.abs(right))
    return value, _outside_range(d) + 12 * UNIT_ROUNDOFF * bound


def _outside_range(differences: FloatArray) -> FloatArray:
    """Infinity for rows with a difference whose fourth power could overflow or underflow, else 0."""
    size = np.abs(differences)
    outside = (size >= FILTER_RANGE) | ((size <= 1 / FILTER_RANGE) & (size != 0))
    return np.where(outside.any(axis=(1, 2)), np.inf, 0.0)


def _turn_integers(p: BigIntegers) -> SignArray:
    d = p[:, 1:] - p[:, :1]
    return _sign(d[:, 0, 0] * d[:, 1, 1] - d[:, 0, 1] * d[:, 1, 0])


def _circle_integers(p: BigIntegers) -> SignArray:
    d = p[:, :3] - p[:, 3:]
    lifted = np.concatenate([d, (d * d).sum(axis=2, keepdims=True)], axis=2)
    return _sign(_determinant(lifted[:, 0], lifted[:, 1], lifted[:, 2]))


class SphereSigns(_Signs):
    """Signs on the exact rays through points (n, 3) of space, of any length but zero."""

    surface: Final = "sphere"

    def __init__(self, points: FloatArray) -> None:
        super().__init__(points)
        self._high, self._low = _nearly_unit(points)

    def bubble(self, rows: LongArray) -> SignArray:
        """Sign of p against the bubble of a triangle a b c, (k,) from (k, 4).

        Positive where p lies in the open bubble on that side of the plane a b c from which they turn counterclockwise.
        """
        return self._decide(rows, self._bubble_filter, self._bubble_integers)

    def side(self, rows: LongArray) -> SignArray:
        """Sign of det[a, b, c], (k,) from (k, 3): > 0 where the triangle's outer bubble is under a hemisphere."""
        p = ray_integers(self.points[rows])
        return _sign(_determinant(p[:, 0], p[:, 1], p[:, 2]))

    def progress(self, rows: LongArray, pole: int, along: BigIntegers) -> SignArray:
        """Sign of x(b) − x(a) in the projection from the point `pole`, (k,) from (k, 2).

        `along` is an integer vector orthogonal to the pole: the lines x = const are images of the circles through the
        pole with this tangent, so x(a) and x(b) differ by a fixed sign times the determinant of the rows
        (a, |a|), (b, |b|), (pole, |pole|), (along, 0).
        """
        p = ray_integers(self.points[np.column_stack([rows, np.full(len(rows), pole)])])
        a, b, v = p[:, 0], p[:, 1], p[:, 2]
        m = np.broadcast_to(along, a.shape)
        none = np.zeros(len(p), dtype=object)  # the row of `along` has length 0
        cofactors = [-_determinant(b, v, m), _determinant(a, v, m), -_determinant(a, b, m), none]
        return _sign_of_roots(cofactors, [*_squares(p), none])

    def facing(self, rows: LongArray) -> SignArray:
        """Signs of the normal's components, (k, 3), for triangles (k, 3) of planes through the centre.

        Counterclockwise around the circle at most one of the three steps is a half-turn or more: of the products
        a×b, b×c, c×a two or three point along the normal, at most one is zero or points against it.
        """
        a = ray_integers(self.points[rows])
        b = np.roll(a, -1, axis=1)
        products = np.roll(a, -1, axis=2) * np.roll(b, -2, axis=2) - np.roll(a, -2, axis=2) * np.roll(b, -1, axis=2)
        return np.sign(_sign(products).sum(axis=1)).astype(np.int8)

    def _bubble_filter(self, rows: LongArray) -> tuple[FloatArray, FloatArray]:
        # With v = t·x (exactly high + low, | |v| − 1 | ≤ 8u) and W(x) = |x−a|² − (|x|−|a|)², multiples of a taken off
        # the other rows and det[u v w] = Σ ± (u·a) det[a v w] give, up to a positive factor,
        #   det[b̂−â, ĉ−â, p̂−â] = −W(b) det[a, c−a, p−a] + W(c) det[a, b−a, p−a] − W(p) det[a, b−a, c−a].
        # No term cancels from flatness. Errors, l = |x−a|, relative to the products l·l' or l² they bound:
        # * x−a: exact in `high` when nearby (Sterbenz) and else good to u, with `low` and the sum 2.2u in all, besides
        #   an absolute 2u² from `low` in each component.
        # * det[a, d, e]: a vector product's component is at most |d||e| in absolute terms (Cauchy), so its error is at
        #   most (2·2.3 + 2)u√3·l·l'; with a (u), product (u) and two sums it is below 10.7u√3·l·l' < 19u·l·l'.
        # * |x−a|²: below 8u·l²; products and sums of the three terms: 3u. In all 30u, and 32u with second order,
        #   times l(b)l(c)l(p)(l(b) + l(c) + l(p)).
        # * leaving out (|x|−|a|)² ≤ (2·8u)²: 256u² times l·l' of the other two. The absolute 2√3u² in each x−a moves
        #   the three terms by less than 12 times that, times the products l·l' (l ≤ 2): 300u² in all.
        a = self._high[rows[:, 0]]
        d = self._high[rows[:, 1:]] - a[:, None]
        if self._low is not None:
            d += self._low[rows[:, 1:]] - self._low[rows[:, 0]][:, None]
        b, c, p = d[:, 0], d[:, 1], d[:, 2]
        w = np.einsum("kij,kij->ki", d, d)
        wb, wc, wp = w.T
        value = wc * _triple(a, b, p) - wb * _triple(a, c, p) - wp * _triple(a, b, c)
        lb, lc, lp = np.sqrt(w).T
        bound = 32 * UNIT_ROUNDOFF * (lb * lc * lp) * (lb + lc + lp)
        radial = 300 * UNIT_ROUNDOFF**2 * (lb * lc + lc * lp + lp * lb)
        return value, bound + radial + UNDERFLOW_FLOOR

    def _bubble_integers(self, rows: LongArray) -> SignArray:
        """The 4×4 determinant expanded along its column of lengths, a sum of four square roots."""
        p = ray_integers(self.points[rows])
        a, b, c, d = (p[:, k] for k in range(4))
        cofactors = [_determinant(b, c, d), -_determinant(a, c, d), _determinant(a, b, d), -_determinant(a, b, c)]
        return _sign_of_roots(cofactors, _squares(p))


def _nearly_unit(points: FloatArray) -> tuple[FloatArray, FloatArray | None]:
    """Positive multiples of the points as exact sums high + low, of length 1 up to 8u; low is None where all zero.

    A row times a positive number keeps every sign, so t need not be the exact 1/|x|: with t = fl(1/fl|x|) the length
    of t·x is off by at most 1.5u + u + u (three squares under a root, root, quotient) and the product is error-free
    down to components of 2⁻⁹⁶⁰, below which its error is far under the u² that the filter has to spare.
    A vector whose computed |x|² is within 12u of 1 has a length within 8u of 1 and is used unchanged.
    """
    squared = np.einsum("ij,ij->i", points, points, optimize=False)
    with np.errstate(over="ignore", invalid="ignore"):
        as_is = np.abs(squared - 1) <= 12 * UNIT_ROUNDOFF
    if as_is.all():
        return points, None
    over, _ = scaled(points)
    factor = 1 / np.sqrt(np.einsum("ij,ij->i", over, over))
    high, low = two_prod(over, factor[:, None])
    keep = as_is[:, None]
    return np.where(keep, points, high), np.where(keep, 0.0, low)


def _triple(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """det[a, b, c] in doubles."""
    x = b[:, 1] * c[:, 2] - b[:, 2] * c[:, 1]
    y = b[:, 2] * c[:, 0] - b[:, 0] * c[:, 2]
    z = b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]
    return a[:, 0] * x + a[:, 1] * y + a[:, 2] * z


def ray_integers(p: FloatArray) -> BigIntegers:
    """Vectors (..., 3) as integer vectors of the same directions, without a common factor of two."""
    return _shifted(p, (-1,))


def _shifted(p: FloatArray, axes: tuple[int, ...]) -> BigIntegers:
    """BigIntegers p·2^s, the exponent s shared along `axes`."""
    fraction, exponent = np.frexp(p)
    mantissa = np.ldexp(fraction, 53).astype(np.int64)
    # The lowest set bit: dropping the zeros below it keeps the integers short.
    zeros = np.frexp((mantissa & -mantissa).astype(np.float64))[1] - 1
    zero = mantissa == 0
    zeros[zero] = 0
    exponent = np.where(zero, np.iinfo(np.int32).max, exponent + zeros)
    lowest = exponent.min(axis=axes, keepdims=True)
    shift = np.where(zero, 0, exponent - np.where(zero, 0, lowest))
    return (mantissa >> zeros).astype(object) << shift.astype(object)


def _determinant(a: BigIntegers, b: BigIntegers, c: BigIntegers) -> BigIntegers:
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = a.T, b.T, c.T
    return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)


def _squares(p: BigIntegers) -> list[BigIntegers]:
    return list((p * p).sum(axis=-1).T)


def _sign(values: BigIntegers) -> SignArray:
    return (values > 0).astype(np.int8) - (values < 0).astype(np.int8)


def _sign_of_roots(c: list[BigIntegers], n: list[BigIntegers]) -> SignArray:
    """Sign of c₀√n₀ + c₁√n₁ + c₂√n₂ + c₃√n₃ for integers c and n ≥ 0.

    Two halves of opposite sign compare by their squares, which hold two roots instead of four.
    """
    first, second = _sign_of_two(c[0], n[0], c[1], n[1]), _sign_of_two(c[2], n[2], c[3], n[3])
    terms = [k * k * r for k, r in zip(c, n, strict=True)]
    squares = _sign_of_three(
        terms[0] + terms[1] - terms[2] - terms[3], 2 * c[0] * c[1], n[0] * n[1], -2 * c[2] * c[3], n[2] * n[3]
    )
    return _combined(first, second, squares)


def _sign_of_three(k: BigIntegers, c: BigIntegers, m: BigIntegers, d: BigIntegers, n: BigIntegers) -> SignArray:
    """Sign of k + c√m + d√n."""
    first, second = _sign(k), _sign_of_two(c, m, d, n)
    squares = _sign_of_two(k * k - c * c * m - d * d * n, 1, -2 * c * d, m * n)
    return _combined(first, second, squares)


def _sign_of_two(c: BigIntegers, m: BigIntegers | int, d: BigIntegers, n: BigIntegers) -> SignArray:
    """Sign of c√m + d√n: x → x·|x| keeps the order."""
    return _sign(c * abs(c) * m + d * abs(d) * n)


def _combined(first: SignArray, second: SignArray, squares: SignArray) -> SignArray:
    """Sign of A + B from the signs of A, B and A² − B²."""
    return np.where(first * second >= 0, np.sign(first + second), first * squares).astype(np.int8)
