"""Distances and points along great circles."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_count, as_directions
from stereodel._double_double import DoubleDouble, dot, unit
from stereodel.constants import UNDECIDED


def angular_distance(a: npt.ArrayLike, b: npt.ArrayLike) -> FloatArray:
    """Angle between directions, accurate near 0° and 180° alike.

    Parameters
    ----------
    a, b : array_like, shape (..., 3)
        Directions, broadcast against each other.

    Returns
    -------
    ndarray, shape (...)
        Degrees in [0, 180].

    Notes
    -----
    Twice atan2(length of a − b, length of a + b), on unit vectors in double-double; W. Kahan, "How futile are mindless
    assessments of roundoff in floating-point computation?", 2006, section 12.

    Examples
    --------
    >>> print(angular_distance([1, 0, 0], [[1, 1, 0], [1, 1e-20, 0]]))
    [4.50000000e+01 5.72957795e-19]
    """
    difference, total = _difference_and_sum(unit(as_directions(a, "a")), unit(as_directions(b, "b")))
    return np.asarray(np.degrees(2 * np.arctan2(difference.hi, total.hi)))


def _difference_and_sum(a: DoubleDouble, b: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble]:
    minus, plus = a - b, a + b
    return dot(minus, minus).sqrt(), dot(plus, plus).sqrt()


def great_circle_points(a: npt.ArrayLike, b: npt.ArrayLike, n: int) -> FloatArray:
    """Points at n equal steps along the shorter great-circle arc, both ends included.

    Parameters
    ----------
    a, b : array_like, shape (..., 3)
        Directions, broadcast against each other; not antipodal.
    n : int
        At least 2.

    Returns
    -------
    ndarray, shape (..., n, 3)
        Unit vectors.

    Raises
    ------
    ValueError
        For antipodal directions, which have no unique shortest arc.

    Examples
    --------
    >>> print(great_circle_points([2, 0, 0], [0, 1, 0], 3)[1])
    [0.70710678 0.70710678 0.        ]
    """
    p, q = unit(as_directions(a, "a")), unit(as_directions(b, "b"))
    difference, total = _difference_and_sum(p, q)
    if (total.hi <= UNDECIDED).any():
        raise ValueError("a and b hold antipodal directions: no single great circle joins them")
    angle = 2 * np.arctan2(difference.hi, total.hi)[..., None, None]
    across = (q - p) - p * dot(p, q - p)[..., None]
    size = dot(across, across).sqrt().hi
    towards = across.hi / np.where(size == 0, 1.0, size)[..., None]
    t = np.linspace(0.0, 1.0, as_count(n, "n", low=2))[:, None] * angle
    return np.cos(t) * p.round()[..., None, :] + np.sin(t) * towards[..., None, :]
