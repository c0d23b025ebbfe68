"""Quaternions (w, x, y, z) in double-double: products, the rotation that one represents, the shortest between two.

A quaternion of any length represents the rotation v ↦ q v q* / |q|², counterclockwise about (x, y, z).
"""

from __future__ import annotations

import numpy as np

from stereodel._double_double import DoubleDouble, cross, dot, stack
from stereodel.constants import UNDECIDED

_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])


def multiply(p: DoubleDouble, q: DoubleDouble) -> DoubleDouble:
    """The product p q of quaternions (..., 4): as rotations, first q, then p."""
    pw, px, py, pz = (p[..., k] for k in range(4))
    qw, qx, qy, qz = (q[..., k] for k in range(4))
    return stack(
        [
            pw * qw - px * qx - py * qy - pz * qz,
            pw * qx + px * qw + py * qz - pz * qy,
            pw * qy - px * qz + py * qw + pz * qx,
            pw * qz + px * qy - py * qx + pz * qw,
        ]
    )


def conjugate(q: DoubleDouble) -> DoubleDouble:
    """The inverse rotation, exactly."""
    return DoubleDouble(q.hi * _CONJUGATE, q.lo * _CONJUGATE)


def normalized(q: DoubleDouble) -> DoubleDouble:
    """The quaternion of length 1."""
    return q / dot(q, q).sqrt()[..., None]


def rotation_matrix(q: DoubleDouble) -> DoubleDouble:
    """The (3, 3) rotation matrix of one quaternion (4,) of any length, entries with errors below 2⁻¹⁰⁰."""
    w, x, y, z = (q[k] for k in range(4))
    ww, xx, yy, zz = w * w, x * x, y * y, z * z
    rows = [
        stack([ww + xx - yy - zz, (x * y - w * z) * 2.0, (x * z + w * y) * 2.0]),
        stack([(x * y + w * z) * 2.0, ww - xx + yy - zz, (y * z - w * x) * 2.0]),
        stack([(x * z - w * y) * 2.0, (y * z + w * x) * 2.0, ww - xx - yy + zz]),
    ]
    matrix = DoubleDouble(np.stack([r.hi for r in rows]), np.stack([r.lo for r in rows]))
    return matrix / dot(q, q)


def transform(matrix: DoubleDouble, vectors: DoubleDouble) -> DoubleDouble:
    """Matrix (3, 3) times vectors (..., 3)."""
    columns = [vectors[..., k] for k in range(3)]
    return stack([sum((matrix[i, k] * columns[k] for k in (1, 2)), matrix[i, 0] * columns[0]) for i in range(3)])


def between(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """The shortest rotation from unit vector a to b, as a quaternion (4,) of any length.

    (1 + a·b, a × b), with 1 + a·b = |a + b|²/2 and a × b = a × (b ∓ a), so that nothing cancels when the two are
    nearly equal or nearly antipodal. Antipodal vectors: half a turn about a × eₖ, k the smallest component of a.
    """
    total = a + b
    square = dot(total, total)
    if float(square.hi) <= UNDECIDED**2:
        basis = np.eye(3)[int(np.argmin(np.abs(a.hi)))]
        return stack([DoubleDouble(0.0), *_components(cross(a, DoubleDouble(basis)))])
    axis = cross(a, total if float(dot(a, b).hi) < 0 else b - a)
    return stack([square * 0.5, *_components(axis)])


def _components(vector: DoubleDouble) -> list[DoubleDouble]:
    return [vector[k] for k in range(3)]
