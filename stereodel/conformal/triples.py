"""The unique conformal map that takes three points to three points."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._double_double import DoubleDouble, unit
from stereodel.conformal.biquaternions import Complex, Spinors, from_spinors
from stereodel.conformal.moebius import MoebiusMap
from stereodel.constants import UNDECIDED
from stereodel.sphere.coordinates import as_sphere_points

Spinor = tuple[Complex, Complex]


def three_points(sources: npt.ArrayLike, targets: npt.ArrayLike) -> MoebiusMap:
    """The conformal map that takes three points to three points, in their order.

    Parameters
    ----------
    sources, targets : array_like, shape (3, 2) or (3, 3)
        Rows (lon, lat) in degrees, or directions; the three of each must be distinct.

    Returns
    -------
    MoebiusMap
        The unique map; it also takes the circle through the sources to the circle through the targets.

    Raises
    ------
    ValueError
        If an argument has another shape, or two of its points coincide.

    Notes
    -----
    With spinors p of the points and ⟨p, q⟩ = p₁q₂ − p₂q₁ the map ξ ↦ (⟨p, ξ⟩⟨r, q⟩, ⟨q, ξ⟩⟨r, p⟩) takes p, q, r to
    0, ∞, 1. The result is that of the sources, followed by the inverse of that of the targets.

    Examples
    --------
    >>> turn = three_points([(0, 0), (90, 0), (0, 90)], [(90, 0), (180, 0), (0, 90)])
    >>> turn.kind, turn.is_close(MoebiusMap.rotation((0.0, 90.0), 90.0))
    ('rotation', True)
    """
    (a, b), (c, d) = _to_standard(_three(sources, "sources"))
    (p, q), (r, s) = _to_standard(_three(targets, "targets"))
    matrix = ((s * a - q * c, s * b - q * d), (p * c - r * a, p * d - r * b))
    return MoebiusMap(*from_spinors(matrix).normalized().decomposed())


def _three(points: npt.ArrayLike, name: str) -> list[Spinor]:
    rows = as_sphere_points(points, name)
    if len(rows) != 3:
        raise ValueError(f"{name} must be three points, got {len(rows)}")
    vectors = unit(rows)
    spinors = [_spinor(vectors[k]) for k in range(3)]
    for i, j in ((0, 1), (0, 2), (1, 2)):
        # |⟨p, q⟩|² is the squared chord up to a factor between 1 and 4.
        if float(_bracket(spinors[i], spinors[j]).square_size().hi) <= UNDECIDED**2:
            raise ValueError(f"{name}[{i}] and {name}[{j}] are the same point; give three distinct ones")
    return spinors


def _spinor(point: DoubleDouble) -> Spinor:
    """The spinor of a unit vector (3,): (1 + z, x + iy) or (x − iy, 1 − z), whichever is longer."""
    x, y, z = (point[k] for k in range(3))
    zero = DoubleDouble(np.zeros(()))
    if float(z.hi) >= 0:
        return Complex(1.0 + z, zero), Complex(x, y)
    return Complex(x, -y), Complex(1.0 - z, zero)


def _bracket(p: Spinor, q: Spinor) -> Complex:
    return p[0] * q[1] - p[1] * q[0]


def _to_standard(points: list[Spinor]) -> Spinors:
    """The matrix that takes three points to 0, ∞ and 1."""
    p, q, r = points
    first, second = _bracket(r, q), _bracket(r, p)
    return (-p[1] * first, p[0] * first), (-q[1] * second, q[0] * second)
