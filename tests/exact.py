"""Vectors in eighty digits: what rounded results are measured against."""

import mpmath

mpmath.mp.dps = 80
ACCURACY = 4 * mpmath.mpf(2) ** -52  # rad and relative: the contract of maps and projections


def mp(values):
    return [mpmath.mpf(float(v)) for v in values]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3] for k in range(3)]


def normalized(v):
    length = mpmath.sqrt(dot(v, v))
    return [x / length for x in v]


def distance(a, b):
    """Of vectors in doubles or in many digits."""
    return mpmath.sqrt(sum((mpmath.mpf(x) - mpmath.mpf(y)) ** 2 for x, y in zip(a, b, strict=True)))


def angle(a, b):
    """Between vectors in many digits, in radians."""
    across = cross(a, b)
    return mpmath.atan2(mpmath.sqrt(dot(across, across)), dot(a, b))


def direction(lon, lat):
    lon, lat = (mpmath.radians(mpmath.mpf(float(v))) for v in (lon, lat))
    return [mpmath.cos(lat) * mpmath.cos(lon), mpmath.cos(lat) * mpmath.sin(lon), mpmath.sin(lat)]


def rotate(quaternion, v):
    """Q v q* / |q|²."""
    w, *axis = mp(quaternion)
    inner = [a + w * b for a, b in zip(cross(axis, v), v, strict=True)]
    size = w * w + dot(axis, axis)
    return [a + 2 * b / size for a, b in zip(v, cross(axis, inner), strict=True)]
