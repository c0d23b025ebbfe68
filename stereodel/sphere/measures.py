"""Distances and points along great circles, areas of spherical triangles."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, as_count, as_directions
from stereodel._double_double import DoubleDouble, cross, dot, unit
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


def solid_angle(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike) -> FloatArray:
    """Signed area of spherical triangles on the unit sphere.

    Parameters
    ----------
    a, b, c : array_like, shape (..., 3)
        Directions of the vertices, broadcast against each other.

    Returns
    -------
    ndarray, shape (...)
        Steradians in (−2π, 2π]: positive when a, b, c are counterclockwise seen from outside; 2π when the vertices go
        once around a great circle. With antipodal vertices the triangle is not unique; 0 where they leave it open.

    Notes
    -----
    tan(Ω/2) = a·(b × c) / (1 + a·b + b·c + c·a), with a·(b × c) = a·((b − a) × (c − a)), all in double-double: tiny
    triangles keep their digits. A. Van Oosterom, J. Strackee, "The solid angle of a plane triangle", IEEE Trans.
    Biomed. Eng. 30 (1983).

    Examples
    --------
    >>> round(float(solid_angle([1, 0, 0], [0, 1, 0], [0, 0, 1]) / np.pi), 15)
    0.5
    """
    p, q, r = unit(as_directions(a, "a")), unit(as_directions(b, "b")), unit(as_directions(c, "c"))
    volume = dot(p, cross(q - p, r - p))
    base = 1.0 + dot(p, q) + dot(q, r) + dot(r, p)
    angles = _kernel.vector_angles(*(np.ascontiguousarray(part).ravel() for part in (volume.hi + 0.0, base.hi)))
    return np.asarray(2 * angles.reshape(volume.hi.shape))
