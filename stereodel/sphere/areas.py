"""Areas of spherical triangles."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, as_directions
from stereodel._double_double import cross, dot, unit


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
