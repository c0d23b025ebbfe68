"""Rotations of the sphere, each defined exactly by the direction of a quaternion of four doubles.

Quaternions (w, x, y, z) are computed in double-double. One of any length represents the rotation v ↦ q v q* / |q|²,
counterclockwise about (x, y, z).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, Keyed, as_scalar, as_shaped, as_vectors, locked
from stereodel._double_double import DoubleDouble, dot, scaled, stack, unit
from stereodel.constants import MATRIX_ERROR
from stereodel.sphere.coordinates import as_direction
from stereodel.sphere.degrees import sin_cos_degrees
from stereodel.sphere.vectors import determinant


def multiply(p: DoubleDouble, q: DoubleDouble) -> DoubleDouble:
    """The product p q of quaternions (4,): as rotations, first q, then p."""
    return DoubleDouble(*_kernel.rotation_product(_rows(p), _rows(q)))


def _rows(vector: DoubleDouble) -> FloatArray:
    """As the kernel takes a vector: doubles and what they leave."""
    return np.stack([vector.hi, vector.lo])


def conjugate(q: DoubleDouble) -> DoubleDouble:
    """The inverse rotation, exactly."""
    signs = np.array([1.0, -1.0, -1.0, -1.0])
    return DoubleDouble(q.hi * signs, q.lo * signs)  # a product would have no −0.0, which the kernel's has


def normalized(q: DoubleDouble) -> DoubleDouble:
    """The quaternion of length 1."""
    return q / dot(q, q).sqrt()[..., None]


def rotation_matrix(q: DoubleDouble) -> DoubleDouble:
    """The (3, 3) rotation matrix of one quaternion (4,) of any length, entries with errors below 2⁻¹⁰⁰."""
    rows = _kernel.rotation_matrix(_rows(q))
    return DoubleDouble(rows[:3], rows[3:])


def transform(matrix: DoubleDouble, vectors: DoubleDouble) -> DoubleDouble:
    """Matrix (3, 3) times vectors (..., 3)."""
    return stack([dot(matrix[i], vectors) for i in range(3)])


def between(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """The shortest rotation from unit vector a to b, as a quaternion (4,) of any length.

    Antipodal vectors: half a turn about a × eₖ, k the smallest component of a.
    """
    return DoubleDouble(*_kernel.rotation_between(_rows(a), _rows(b)))


@dataclass(frozen=True, eq=False)
class Rotation(Keyed):
    """A rotation about the centre of the sphere.

    Parameters
    ----------
    quaternion : array_like, shape (4,)
        (w, x, y, z) = (cos θ/2, axis · sin θ/2) up to length and sign: counterclockwise by θ about the axis as seen
        from its tip. Only its direction counts, and that defines the rotation exactly. Stored over a power of two.

    Raises
    ------
    ValueError
        For another shape, four zeros, NaN or infinities.

    Examples
    --------
    >>> quarter = Rotation.about((0.0, 90.0), 90.0)
    >>> print(quarter([1.0, 0.0, 0.0]))
    [0. 1. 0.]
    >>> quarter @ quarter.inverse() == Rotation.identity()
    True
    """

    quaternion: FloatArray

    def __post_init__(self) -> None:
        values = as_shaped(self.quaternion, (4,), "quaternion")
        if not values.any():
            raise ValueError("quaternion is the zero quaternion, which is not a rotation")
        object.__setattr__(self, "quaternion", locked(scaled(values)[0]))

    @classmethod
    def identity(cls) -> Rotation:
        """The identity rotation."""
        return cls(np.array([1.0, 0.0, 0.0, 0.0]))

    @classmethod
    def about(cls, axis: npt.ArrayLike, angle: float) -> Rotation:
        """Counterclockwise about an axis, seen from its tip.

        Parameters
        ----------
        axis : array_like, shape (2,) or (3,)
            (lon, lat) in degrees or a direction.
        angle : float
            Degrees, any finite number.
        """
        sine, cosine = sin_cos_degrees(np.asarray(as_scalar(angle, "angle") / 2))
        direction = unit(as_direction(axis, "axis")) * sine
        return cls(stack([cosine, direction[0], direction[1], direction[2]]).round())

    @classmethod
    def between(cls, start: npt.ArrayLike, end: npt.ArrayLike) -> Rotation:
        """The shortest rotation that takes one point to another, both (lon, lat) in degrees or directions.

        For antipodal points: half a turn about the normal to `start` and the coordinate axis farthest from it.
        """
        a, b = unit(as_direction(start, "start")), unit(as_direction(end, "end"))
        return cls(between(a, b).round())

    @classmethod
    def from_matrix(cls, matrix: npt.ArrayLike) -> Rotation:
        """The rotation of a (3, 3) matrix, which must be orthogonal up to `MATRIX_ERROR` and of determinant +1."""
        m = as_shaped(matrix, (3, 3), "matrix")
        if np.abs(m @ m.T - np.eye(3)).max() > MATRIX_ERROR or determinant(m) < 0:
            raise ValueError("matrix is not a rotation: its columns must be orthonormal with determinant +1")
        return cls.nearest(m)

    @classmethod
    def nearest(cls, m: FloatArray) -> Rotation:
        """The rotation nearest to a (3, 3) matrix that is a rotation up to rounding.

        Method of S. W. Shepperd, "Quaternion from rotation matrix", J. Guidance and Control 1 (1978): divide by the
        largest of the four components.
        """
        symmetric = np.empty((4, 4))
        symmetric[1:, 1:] = m + m.T + (1.0 - np.trace(m)) * np.eye(3)
        symmetric[0, 1:] = symmetric[1:, 0] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]
        symmetric[0, 0] = 1.0 + np.trace(m)
        # Row k is 4·qₖ times the quaternion.
        return cls(symmetric[int(np.argmax(np.diag(symmetric)))])

    def __call__(self, xyz: npt.ArrayLike) -> FloatArray:
        """Rotated vectors, (..., 3) to (..., 3): the exact result for the exact quaternion, rounded once."""
        vectors = as_vectors(xyz, 3, "xyz")
        matrix = np.concatenate([self.exact_matrix.hi, self.exact_matrix.lo])
        return _kernel.rotated(matrix, vectors.reshape(-1, 3)).reshape(vectors.shape)

    def apply(self, vectors: DoubleDouble) -> DoubleDouble:
        """Double-double vectors (..., 3) of length about 1, rotated with an error below 2⁻⁹⁸."""
        return transform(self.exact_matrix, vectors)

    @cached_property
    def exact_matrix(self) -> DoubleDouble:
        """The (3, 3) matrix in double-double."""
        return rotation_matrix(DoubleDouble(self.quaternion))

    @property
    def matrix(self) -> FloatArray:
        """The (3, 3) matrix, rounded once: `matrix @ v` is the rotated v."""
        return self.exact_matrix.round() + 0.0

    def __matmul__(self, other: Rotation) -> Rotation:
        """The rotation by `other`, then by this one; the exact product rounded once."""
        if not isinstance(other, Rotation):
            return NotImplemented
        return Rotation(multiply(DoubleDouble(self.quaternion), DoubleDouble(other.quaternion)).round())

    def inverse(self) -> Rotation:
        """The exact inverse."""
        return Rotation(conjugate(DoubleDouble(self.quaternion)).hi)

    @property
    def _key(self) -> tuple[Fraction, ...]:
        """The quaternion over its largest component, exactly: rotations are the same up to its sign and length."""
        largest = Fraction(float(self.quaternion[int(np.argmax(np.abs(self.quaternion)))]))
        return tuple(Fraction(float(q)) / largest for q in self.quaternion)

    def __repr__(self) -> str:
        return f"Rotation({self.quaternion.tolist()})"
