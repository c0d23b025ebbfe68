"""Vectors in eighty digits or as many as `mp` has, cells in fractions: what rounded results are measured against."""

from fractions import Fraction

import mpmath

mpmath.mp.dps = 80
ACCURACY = 4 * mpmath.mpf(2) ** -52  # rad and relative: the contract of maps and projections


def mp(values):
    return [mpmath.mpf(float(v)) for v in values]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3] for k in range(3)]


def minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def times(factor, a):
    return [factor * x for x in a]


def norm(a):
    return mpmath.sqrt(dot(a, a))


def unit(a):
    """Of length one; doubles, fractions, integers and many digits are taken as they stand."""
    a = [mpmath.mpf(x.numerator) / x.denominator if hasattr(x, "numerator") else mpmath.mpf(x) for x in a]
    length = norm(a)
    return [x / length for x in a]


def normal_of(a, b, c):
    """Of the plane through three directions, outward where they are counterclockwise."""
    a, b, c = unit(a), unit(b), unit(c)
    return unit(cross(minus(b, a), minus(c, a)))


def doubles(a):
    return [float(x) for x in a]


def distance(a, b):
    """Of vectors in doubles or in many digits."""
    return mpmath.sqrt(sum((mpmath.mpf(x) - mpmath.mpf(y)) ** 2 for x, y in zip(a, b, strict=True)))


def angle(a, b):
    """Between vectors in many digits, in radians."""
    across = cross(a, b)
    return mpmath.atan2(mpmath.sqrt(dot(across, across)), dot(a, b))


def turn(a, b, about):
    """From one direction to another, counterclockwise about an axis, in [0, 2π)."""
    a, b = unit(a), unit(b)
    found = mpmath.atan2(dot(about, cross(a, b)), dot(a, b))
    return found if found >= 0 else found + 2 * mpmath.pi


def volume(a, b, c, d):
    """The determinant of the differences from the first, in whatever numbers they are."""
    return dot(minus(b, a), cross(minus(c, a), minus(d, a)))


def direction(lon, lat):
    lon, lat = (mpmath.radians(mpmath.mpf(float(v))) for v in (lon, lat))
    return [mpmath.cos(lat) * mpmath.cos(lon), mpmath.cos(lat) * mpmath.sin(lon), mpmath.sin(lat)]


def rotate(quaternion, v):
    """Q v q* / |q|²."""
    w, *axis = mp(quaternion)
    inner = [a + w * b for a, b in zip(cross(axis, v), v, strict=True)]
    size = w * w + dot(axis, axis)
    return [a + 2 * b / size for a, b in zip(v, cross(axis, inner), strict=True)]


def fractions(points):
    return [tuple(map(Fraction, p)) for p in points]


def nearer(polygon, a, b):
    """The part of a convex polygon that is nearer to a than to b, all in fractions."""
    along = [y - x for x, y in zip(a, b, strict=True)]
    excess = [2 * dot(p, along) - dot(b, b) + dot(a, a) for p in polygon]
    result = []
    for k, (p, f) in enumerate(zip(polygon, excess, strict=True)):
        q, g = polygon[k - 1], excess[k - 1]
        if f * g < 0:
            t = g / (g - f)
            result.append(tuple(x + t * (y - x) for x, y in zip(q, p, strict=True)))
        if f <= 0:
            result.append(p)
    return result


def area(polygon):
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(polygon, polygon[1:] + polygon[:1], strict=True)) / 2
