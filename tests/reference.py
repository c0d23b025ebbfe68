"""Exact signs one test at a time, in Python integers and roots, written apart from the kernel: its oracle.

A direction is a ray: the shortest integer vector on it and its squared length. Exact ties are decided by displacements
as `stereodel.triangulation.sites` describes them, here by the cofactors themselves.
"""

from functools import cmp_to_key
from math import gcd, isqrt


def sign(number):
    return (number > 0) - (number < 0)


def to_integers(values):
    """All values times one power of two, large enough to make every one an integer."""
    ratios = [value.as_integer_ratio() for value in values]
    common = max(denominator for _, denominator in ratios)
    return [numerator * (common // denominator) for numerator, denominator in ratios]


def sign_of_roots(terms):
    """Sign of a sum of up to four c·√n, pairs (c, n).

    Two halves of opposite sign are compared by their squares, which leaves one root fewer: four terms become three,
    three become two, and two become one comparison of integers.
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


def _merge(terms):
    """Collect equal radicands and take the roots of perfect squares."""
    collected = {}
    for coefficient, radicand in terms:
        root = isqrt(radicand)
        c, n = (coefficient * root, 1) if root * root == radicand else (coefficient, radicand)
        collected[n] = collected.get(n, 0) + c
    return [(c, n) for n, c in collected.items() if c]


def _square(terms):
    """Square of one or two terms."""
    squares = sum(c * c * n for c, n in terms)
    if len(terms) == 1:
        return [(squares, 1)]
    (c, n), (d, m) = terms
    return [(squares, 1), (2 * c * d, n * m)]


def orient2d_integer(a, b, c):
    return sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def incircle_integer(a, b, c, d):
    (ax, ay), (bx, by), (cx, cy) = ((p[0] - d[0], p[1] - d[1]) for p in (a, b, c))
    return sign(det3(*((x, y, x * x + y * y) for x, y in ((ax, ay), (bx, by), (cx, cy)))))


def incircle_tie(*points):
    """Of four different cocircular points: the height of row i has the cofactor (−1)^i times the turn of the others."""
    first = points.index(min(points))
    return (-1) ** first * orient2d_integer(*points[:first], *points[first + 1 :])


def ray(vector):
    """The shortest integer vector with the direction of three doubles, and its squared length."""
    x, y, z = to_integers(vector)
    common = gcd(x, y, z)
    x, y, z = x // common, y // common, z // common
    return x, y, z, x * x + y * y + z * z


def det3(a, b, c):
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


def turn_ray(a, b, c):
    return sign(det3(a, b, c))


def bubble_ray(a, b, c, p):
    """Sign of det(b̂−â, ĉ−â, p̂−â), which is |a|·det[b c p] − |b|·det[a c p] + |c|·det[a b p] − |p|·det[a b c]."""
    return sign_of_roots(((det3(b, c, p), a[3]), (-det3(a, c, p), b[3]), (det3(a, b, p), c[3]), (-det3(a, b, c), p[3])))


def compare_component(a, b, axis):
    return sign_of_roots(((a[axis], b[3]), (-b[axis], a[3])))


def compare_directions(a, b):
    """By x̂, then ŷ, then ẑ: −1 if a comes first, 0 if they are the same."""
    return compare_component(a, b, 0) or compare_component(a, b, 1) or compare_component(a, b, 2)


def bubble_tie(*rays):
    """Of four different directions of one circle: outward steps, on a great circle shifts along x, then y, then z."""
    first = rays.index(min(rays, key=cmp_to_key(compare_directions)))
    others = rays[:first] + rays[first + 1 :]
    parity = (-1) ** first
    if turn := turn_ray(*others):
        return -parity * turn
    for axis in range(3):
        if cofactor := _shadow(*others, axis):
            return -parity * (-1) ** axis * cofactor
    raise ArithmeticError("three of the four directions are the same")


def _shadow(a, b, c, axis):
    """Sign of the determinant of unit vectors with rows (two components without `axis`, 1)."""
    i, j = (k for k in range(3) if k != axis)
    pairs = ((b, c, a), (c, a, b), (a, b, c))
    return sign_of_roots((u[i] * v[j] - u[j] * v[i], w[3]) for u, v, w in pairs)
