"""The group of conformal maps as quaternions with complex coefficients, SL(2, C), in double-double.

q = a + i b with real quaternions a, b stands for the 2×2 matrix in which the quaternion units are −i times the Pauli
matrices. A rotation is a real unit quaternion; the fisheye of magnification S along the unit vector f is cosh(η/2) − i
sinh(η/2) f with η = ln S. Products are compositions; those of stored maps are exact, and the kernel's.

An element c + v, v·v = s² and c² + s² = 1, is cos θ + (v/s) sin θ with a complex angle θ, and its power is cos tθ +
(v/s) sin tθ. The angle is rounded; the result is the exact power for an exponent with a relative error of about 2⁻⁵².
The vector is only scaled, so fixed points do not move. With s ≠ 0 it is conjugate to the turn and stretch ζ ↦ kζ, k =
(c + i s)². Its fixed points belong to n = v/s = a + i b, where |a|² − |b|² = 1 and a·b = 0: they are (±a + a × b)/|a|².
H. S. M. Coxeter, "The inversive plane and hyperbolic space", Abh. Math. Sem. Hamburg 29 (1966), and R. Penrose, W.
Rindler, "Spinors and Space-Time" 1 (1984), section 1.3, describe the kinds.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from stereodel import _kernel
from stereodel._arrays import FloatArray
from stereodel._double_double import DoubleDouble, cross, dot, stack, where
from stereodel.constants import KIND_TOLERANCE, LARGEST_MAGNIFICATION, SMALL_ANGLE
from stereodel.sphere import Rotation
from stereodel.sphere.rotations import conjugate, multiply, normalized


@dataclass(frozen=True)
class Complex:
    """re + i im, in double-doubles: scalars, or vectors of space along the last axis."""

    re: DoubleDouble
    im: DoubleDouble

    @classmethod
    def of(cls, value: complex) -> Complex:
        """A complex number of two doubles, exactly."""
        return cls(DoubleDouble(value.real), DoubleDouble(value.imag))

    def __complex__(self) -> complex:
        return complex(float(self.re.round()), float(self.im.round()))

    def __neg__(self) -> Complex:
        return Complex(-self.re, -self.im)

    def __add__(self, other: Complex) -> Complex:
        return Complex(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Complex) -> Complex:
        return self + -other

    def __mul__(self, other: Complex | float) -> Complex:
        if not isinstance(other, Complex):
            return Complex(self.re * other, self.im * other)
        return Complex(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)

    def __truediv__(self, other: Complex) -> Complex:
        size = other.square_size()
        product = self * other.conjugate()
        return Complex(product.re / size, product.im / size)

    def conjugate(self) -> Complex:
        """The complex conjugate."""
        return Complex(self.re, -self.im)

    def times_i(self) -> Complex:
        """The number times i."""
        return Complex(-self.im, self.re)

    def square_size(self) -> DoubleDouble:
        """|z|²."""
        return self.re * self.re + self.im * self.im

    def sqrt(self) -> Complex:
        """A square root of a number other than 0: that of positive real part, or of imaginary part with its sign."""
        half = self.square_size().sqrt()
        # (p + i q)² = re + i im; of |p| and |q| the larger comes from the root, without cancellation.
        large = ((half + where(self.re.hi >= 0, self.re, -self.re)) * 0.5).sqrt()
        small = self.im / (large * 2.0)
        if float(self.re.hi) >= 0:
            return Complex(large, small)
        sign = float(np.copysign(1.0, self.im.hi))
        return Complex(small * sign, large * sign)


def inner(a: Complex, b: Complex) -> Complex:
    """The sum of products of the components of two vectors, without conjugation."""
    return Complex(dot(a.re, b.re) - dot(a.im, b.im), dot(a.re, b.im) + dot(a.im, b.re))


Z_AXIS = DoubleDouble(np.array([0.0, 0.0, 1.0]))

Parts = tuple[Rotation, float, Rotation]
"""Left rotation, magnification along z, right rotation."""


def parts(numbers: FloatArray) -> Parts:
    """The parts of a map from the nine numbers that the kernel gives: quaternion, magnification, quaternion."""
    return Rotation(numbers[:4]), float(numbers[4]), Rotation(numbers[5:])


class Biquaternion(NamedTuple):
    """The element real + i·imag of SL(2, C); q and −q are the same map."""

    real: DoubleDouble
    imag: DoubleDouble
    known_square: Complex | None = None
    """v·v of the vector part, if known more accurately than from the components, among which it may cancel."""

    def __matmul__(self, other: Biquaternion) -> Biquaternion:
        return Biquaternion(
            multiply(self.real, other.real) - multiply(self.imag, other.imag),
            multiply(self.real, other.imag) + multiply(self.imag, other.real),
        )

    def inverse(self) -> Biquaternion:
        """The inverse of an element of determinant 1."""
        return Biquaternion(conjugate(self.real), conjugate(self.imag))

    @property
    def scalar(self) -> Complex:
        """The scalar component, half the trace of the matrix."""
        return Complex(self.real[0], self.imag[0])

    @property
    def vector(self) -> Complex:
        """The other three components, (3,)."""
        return Complex(self.real[1:], self.imag[1:])

    @property
    def vector_square(self) -> Complex:
        """v·v of the vector part, 1 − c² for determinant 1 and the scalar part c."""
        return inner(self.vector, self.vector) if self.known_square is None else self.known_square

    def determinant(self) -> Complex:
        """1 in SL(2, C)."""
        return Complex(dot(self.real, self.real) - dot(self.imag, self.imag), dot(self.real, self.imag) * 2.0)

    def norm(self) -> DoubleDouble:
        """|a|² + |b|², which is cosh η = (S + 1/S)/2 for determinant 1."""
        return dot(self.real, self.real) + dot(self.imag, self.imag)

    def normalized(self) -> Biquaternion:
        """The element divided by a square root of its determinant, which must not be zero."""
        element = Complex(self.real, self.imag) / self.determinant().sqrt()
        return Biquaternion(element.re, element.im)

    @classmethod
    def of(cls, numbers: FloatArray) -> Biquaternion:
        """The element of a map's nine numbers (`parts`): each component within 2⁻¹⁰⁵ of itself, and v·v as accurate."""
        rows = _kernel.moebius_element(numbers)
        square = DoubleDouble(rows[4, ::2], rows[4, 1::2])
        return cls(DoubleDouble(*rows[:2]), DoubleDouble(*rows[2:4]), Complex(square[0], square[1]))

    def decomposed(self) -> Parts:
        """The parts of the map, of magnification S ≥ 1, each rounded once."""
        return parts(_kernel.moebius_decomposed(np.stack([self.real.hi, self.real.lo, self.imag.hi, self.imag.lo])))


def rotation(quaternion: DoubleDouble) -> Biquaternion:
    """The rotation of a quaternion (4,) of any length."""
    return Biquaternion(normalized(quaternion), DoubleDouble(np.zeros(4)))


def boost(axis: DoubleDouble, magnification: DoubleDouble) -> Biquaternion:
    """The fisheye of magnification S along a unit vector (3,)."""
    root, zero = magnification.sqrt(), DoubleDouble(np.zeros(3))
    cosh, sinh = (root + 1.0 / root) * 0.5, (root - 1.0 / root) * 0.5
    return from_parts(Complex(cosh, zero[0]), Complex(zero, axis * -sinh))


def from_parts(scalar: Complex, vector: Complex) -> Biquaternion:
    """The element with a scalar and a vector (3,)."""
    pairs = (scalar.re, vector.re), (scalar.im, vector.im)
    real, imag = (stack([first, *(rest[k] for k in range(3))]) for first, rest in pairs)
    return Biquaternion(real, imag)


Spinors = tuple[tuple[Complex, Complex], tuple[Complex, Complex]]
"""A 2×2 matrix on spinors (ξ₁, ξ₂), where 1 + z : x + iy : 1 − z = |ξ₁|² : ξ₁* ξ₂ : |ξ₂|²."""


def from_spinors(matrix: Spinors) -> Biquaternion:
    """The element of a matrix on spinors, of the same determinant: over the Pauli matrices α₀ + α·σ, as it α₀ + i α."""
    (a, b), (c, d) = matrix
    scalar, along_z = (a + d) * 0.5, (a - d) * 0.5
    along_x, along_y = (b + c) * 0.5, ((b - c) * 0.5).times_i()
    parts = [part.times_i() for part in (along_x, along_y, along_z)]
    return from_parts(scalar, Complex(stack([part.re for part in parts]), stack([part.im for part in parts])))


def power(element: Biquaternion, exponent: float) -> Biquaternion:
    """The real power of an element of determinant 1, with the sign that gives the smaller rotation."""
    element = principal(element)
    square = complex(element.vector_square)
    if abs(square) <= SMALL_ANGLE**2:
        ratio = exponent * (1 + square / 6)  # tθ/s
        z = square * ratio**2
        cosine, factor = 1 - z / 2 + z**2 / 24, ratio * (1 - z / 6 + z**2 / 120)
    else:
        sine = sine_of(element)
        # θ with c = cos θ and s = sin θ, from the logarithm of exp(iθ) = c + i s.
        turned = element.scalar + sine.times_i()
        value, excess = complex(turned), float((turned.square_size() - 1.0).round())
        angle = exponent * complex(np.arctan2(value.imag, value.real), -0.5 * np.log1p(excess))
        if 2 * abs(angle.imag) > np.log(LARGEST_MAGNIFICATION):
            raise ValueError(f"exponent is {exponent:g}: the power has a magnification above {LARGEST_MAGNIFICATION:g}")
        cosine, factor = complex(np.cos(angle)), complex(np.sin(angle)) / complex(sine)
    return from_parts(Complex.of(cosine), element.vector * Complex.of(factor))


def principal(element: Biquaternion) -> Biquaternion:
    """The element or its negative, the same map: that with 0 ≤ Re c, so that the rotation is by at most 180°."""
    scalar = float(element.real.hi[0])
    if scalar == 0:  # both are by 180°: the last component of the vector that is not zero is made positive
        components = [*element.imag.hi[1:], *element.real.hi[1:]]
        scalar = next((float(part) for part in reversed(components) if part != 0), 1.0)
    return element if scalar > 0 else element._replace(real=-element.real, imag=-element.imag)


def sine_of(element: Biquaternion) -> Complex:
    """The number s with |c + i s| ≥ |c − i s|, of which the product is 1, up to rounding; not for s = 0."""
    root = element.vector_square.sqrt()
    # A quarter of the difference of the two squares: the smaller number itself would cancel.
    lead = element.scalar * root.times_i().conjugate()
    return root if float(lead.re.hi) >= 0 else -root


Kind = Literal["identity", "rotation", "boost", "parabolic", "loxodromic"]


def kind_of(element: Biquaternion) -> Kind:
    """The kind of a map, or of one within `KIND_TOLERANCE` of it."""
    # Rounded parameters change c by about 2⁻⁵²|v|, and s² = 1 − c² by twice that where c is 1.
    vector = element.vector
    slack = KIND_TOLERANCE * float(vector.square_size().hi.sum()) ** 0.5
    if slack <= KIND_TOLERANCE**2:
        return "identity"
    square = complex(element.vector_square)
    if abs(square) <= slack:
        return "parabolic"
    if abs(float(element.imag.hi[0])) > slack:
        return "loxodromic"
    return "rotation" if square.real > 0 else "boost"


def fixed_points_of(element: Biquaternion) -> FloatArray:
    """Unit vectors (2, 3), (1, 3) when parabolic: first where the map magnifies or turns counterclockwise."""
    kind = kind_of(element)
    if kind == "identity":
        raise ValueError("every point is a fixed point of the identity")
    element = principal(element)
    if kind == "parabolic":
        real, imag = element.vector.re, element.vector.im
        return _rounded(cross(real, imag))[None]
    axis = element.vector / _sine(element, kind)
    across = cross(axis.re, axis.im)
    return np.stack([_rounded(axis.re + across), _rounded(across - axis.re)])


def multiplier_of(element: Biquaternion) -> complex:
    """The number k with |k| ≥ 1, the complex derivative at the first fixed point; 1 for identity and parabolic maps."""
    kind = kind_of(element)
    if kind in {"identity", "parabolic"}:
        return 1 + 0j
    element = principal(element)
    factor = element.scalar + _sine(element, kind).times_i()
    value = complex(factor * factor)
    if kind == "boost":
        return complex(abs(value))
    return value / abs(value) if kind == "rotation" else value


def _sine(element: Biquaternion, kind: Kind) -> Complex:
    """The root of v·v that makes |c + i s| ≥ 1, or of a rotation that with its real part positive."""
    sine = sine_of(element)
    return -sine if kind == "rotation" and float(sine.re.hi) < 0 else sine


def _rounded(vector: DoubleDouble) -> FloatArray:
    return (vector / dot(vector, vector).sqrt()).round() + 0.0
