"""Predicates on directions: the answer of exact arithmetic on the rays through the given doubles.

A direction is known to the filters as its unit vector in double-double (hi + lo), to the last stage as the shortest
integer vector on the ray and its squared length. Differences of unit vectors are formed before anything is
multiplied, so that what remains is the cancellation of an incircle test and not that of flatness (row P6 of the
ledger).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._double_double import unit
from stereodel.constants import UNIT_ROUNDOFF
from stereodel.predicates.integers import primitive, sign, sign_of_roots
from stereodel.predicates.staged import Pair, Real, det3

Ray = tuple[int, int, int, int]
"""Primitive integer vector (x, y, z) of a direction and its squared length."""

# A component of a difference of two unit vectors is computed as (b.hi − a.hi) + (b.lo − a.lo). Where the first
# difference rounds at all (it does not between a/2 and 2a) it exceeds the lo parts by 2⁵¹ or more and counts as one
# relative rounding; the last sum is a second one. What else happens is absolute: the two directions are off by 2⁻¹⁰²
# each (`unit`), the difference of the lo parts rounds by at most 2⁻¹⁰⁶. So the computed difference is Δ(1+δ)² + e
# with |e| < η = 2⁻¹⁰⁰ in each component, ε = √3·η in length.
_ETA = 2.0**-100

# 2G has terms |Δb|²·det[a Δc Δp]: the four Δ hold two roundings each and a.hi one; a square, its two sums, five of
# det3, a product and two outer sums: N = 20. A determinant's permanent is at most √2 times the product of the lengths
# of its rows (Cauchy), so that of 2G is at most √2·lb·lc·lp·(lb+lc+lp), l the lengths of the Δ; 21·√2 < 30.
# An error ε in each Δ and η/2 in a.hi moves 2G by at most ε·(L·M + 3·lb·lc·lp) + η/2·L·lb·lc·lp < 3·η·L·M with L the
# sum of the lengths and M that of their products in pairs (9·lb·lc·lp ≤ L·M, L ≤ 6); taking l + 2η for l makes that
# hold for errors that are not small beside l, and keeps the bound above 2⁻⁴⁰⁰, where underflow is nothing.
_BUBBLE = 30 * UNIT_ROUNDOFF
_BUBBLE_DIRECTION = 4 * _ETA


def units(directions: FloatArray) -> FloatArray:
    """Unit vectors (k, 6) of non-zero vectors (k, 3): components of hi, then of lo."""
    normalised = unit(directions)
    return np.concatenate([normalised.hi, normalised.lo], axis=-1)


def ray(vector: Sequence[float]) -> Ray:
    """The exact form of a direction."""
    x, y, z = primitive(vector)
    return x, y, z, x * x + y * y + z * z


def difference(b: Sequence[Real], a: Sequence[Real]) -> tuple[Real, Real, Real]:
    """b̂ − â of two unit vectors (hi, then lo), the large parts first."""
    return (b[0] - a[0]) + (b[3] - a[3]), (b[1] - a[1]) + (b[4] - a[4]), (b[2] - a[2]) + (b[5] - a[5])


def _squared(v: Sequence[Real]) -> Real:
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]


def bubble_filter(a: Sequence[Real], b: Sequence[Real], c: Sequence[Real], p: Sequence[Real]) -> Pair[Real]:
    """Twice det(b̂−â, ĉ−â, p̂−â) in the curvature form, and the bound of its error.

    For vectors of length one a·Δ = −|Δ|²/2, hence
    det[Δb Δc Δp] = −½(|Δb|²·det[a Δc Δp] − |Δc|²·det[a Δb Δp] + |Δp|²·det[a Δb Δc]).
    """
    origin = a[0], a[1], a[2]
    db, dc, dp = difference(b, a), difference(c, a), difference(p, a)
    bb, cc, pp = _squared(db), _squared(dc), _squared(dp)
    value = cc * det3(origin, db, dp) - bb * det3(origin, dc, dp) - pp * det3(origin, db, dc)
    lb, lc, lp = bb**0.5 + 2 * _ETA, cc**0.5 + 2 * _ETA, pp**0.5 + 2 * _ETA
    pairs = lb * lc + lc * lp + lp * lb
    return value, (lb + lc + lp) * (_BUBBLE * (lb * lc * lp) + _BUBBLE_DIRECTION * pairs)


def bubble_ray(a: Ray, b: Ray, c: Ray, p: Ray) -> int:
    """Sign of |a|·det[b c p] − |b|·det[a c p] + |c|·det[a b p] − |p|·det[a b c]."""
    return sign_of_roots(((det3(b, c, p), a[3]), (-det3(a, c, p), b[3]), (det3(a, b, p), c[3]), (-det3(a, b, c), p[3])))


def turn_ray(a: Ray, b: Ray, c: Ray) -> int:
    """Sign of det[a b c]."""
    return sign(det3(a, b, c))


def compare_component(a: Ray, b: Ray, axis: int) -> int:
    """Sign of the difference of one component of the unit vectors, â − b̂."""
    return sign_of_roots(((a[axis], b[3]), (-b[axis], a[3])))


def compare_directions(a: Ray, b: Ray) -> int:
    """Lexicographic order of directions, by x̂, then ŷ, then ẑ: −1 if a comes first, 0 if they are the same."""
    return compare_component(a, b, 0) or compare_component(a, b, 1) or compare_component(a, b, 2)
