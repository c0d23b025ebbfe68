"""Vectors of mpmath's numbers, with as many digits as `mp` has: what constructions are measured by."""

from mpmath import mp, mpf


def vector(doubles):
    return [mpf(float(x)) for x in doubles]


def minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def times(factor, a):
    return [factor * x for x in a]


def dot(a, b):
    return mp.fsum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2] for k in range(3)]


def norm(a):
    return mp.sqrt(dot(a, a))


def unit(a):
    """Of length one; doubles, fractions and integers are taken as they stand."""
    a = [mpf(x.numerator) / x.denominator if hasattr(x, "numerator") else mpf(x) for x in a]
    return times(1 / norm(a), a)


def normal_of(a, b, c):
    """Of the plane through three directions, outward where they are counterclockwise."""
    a, b, c = unit(a), unit(b), unit(c)
    return unit(cross(minus(b, a), minus(c, a)))


def doubles(a):
    return [float(x) for x in a]
