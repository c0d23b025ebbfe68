"""Conformal maps as 4×4 Lorentz matrices, as 2×2 complex matrices, and as pipelines of the PROJ library.

The orientation-preserving conformal maps of the sphere are exactly the proper orthochronous Lorentz matrices (rows and
columns x, y, z, t): a point x is the null vector (x, 1), a circle n·x = d the vector (n, d). R. Penrose, W. Rindler,
"Spinors and Space-Time" 1 (1984), sections 1.2 and 1.3.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray
from stereodel._double_double import DoubleDouble
from stereodel.conformal.group import Complex, Parts, from_spinors
from stereodel.constants import MATRIX_ERROR, MATRIX_MAGNIFICATION, STORED_ERROR
from stereodel.sphere import Rotation, xyz_to_lonlat
from stereodel.sphere.coordinates import tangent_frame
from stereodel.sphere.vectors import determinant

_METRIC = np.diag([1.0, 1.0, 1.0, -1.0])
_Z = np.array([0.0, 0.0, 1.0])


def lorentz_matrix(left: Rotation, magnification: float, right: Rotation) -> FloatArray:
    """The 4×4 matrix of rotation · boost · rotation, rounded once."""
    size = DoubleDouble(magnification)
    cosh, sinh = (size + 1.0 / size) * 0.5, (size - 1.0 / size) * 0.5
    boost = np.eye(4, 4), np.zeros((4, 4))
    for index, value in (((2, 2), cosh), ((3, 3), cosh), ((2, 3), -sinh), ((3, 2), -sinh)):
        boost[0][index], boost[1][index] = float(value.hi), float(value.lo)
    product = _multiply(_multiply(_block(left), DoubleDouble(*boost)), _block(right))
    return product.round() + 0.0


def _block(rotation: Rotation) -> DoubleDouble:
    hi, lo = np.eye(4), np.zeros((4, 4))
    hi[:3, :3], lo[:3, :3] = rotation.exact_matrix.hi, rotation.exact_matrix.lo
    return DoubleDouble(hi, lo)


def _multiply(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    total = a[:, 0, None] * b[None, 0, :]
    for k in range(1, 4):
        total = total + a[:, k, None] * b[None, k, :]
    return total


def from_lorentz(matrix: FloatArray) -> Parts:
    """The parts of a 4×4 matrix, checked to be proper, orthochronous and of magnification at most 1e6.

    With γ = M₃₃, column b = M₀₋₂,₃ and row c = M₃,₀₋₂ the rest is A = U + b cᵀ/(1 + γ), U the rotation of the polar
    decomposition. The rounding of A, ulp(S), is then in U; beyond sinh η = 1 the axes come from b and c instead, which
    are accurate to their own ulps.
    """
    error = np.abs(matrix.T @ _METRIC @ matrix - _METRIC).max()
    gamma, column, row = matrix[3, 3], matrix[:3, 3], matrix[3, :3]
    if error > MATRIX_ERROR * np.abs(matrix).max() ** 2 or gamma <= 0:
        raise ValueError(
            "matrix is not an orthochronous Lorentz matrix: Mᵀ diag(1, 1, 1, -1) M must equal it, and M[3, 3] > 0"
        )
    sinh = float(np.hypot(np.linalg.norm(column), np.linalg.norm(row)) / np.sqrt(2))
    magnification = float(gamma) + sinh
    _check_magnification(magnification)
    polar = matrix[:3, :3] - np.outer(column, row) / (1 + gamma)
    if determinant(polar) < 0:
        raise ValueError("matrix is a reflection of the sphere: its determinant must be +1")
    turn = Rotation.nearest(polar)
    if sinh == 0:
        return Rotation.identity(), 1.0, turn
    left = Rotation.between(_Z, -column)
    right = left.inverse() @ turn
    if sinh > 1:
        right = Rotation.between(right(-row), _Z) @ right
    return left, max(magnification, 1.0), right


def from_moebius(matrix: npt.NDArray[np.complex128]) -> Parts:
    """The parts of ζ ↦ (aζ + b)/(cζ + d), ζ = (x + iy)/(1 − z)."""
    # The spinor (ξ₁, ξ₂) of a point has ζ* = ξ₁/ξ₂: the conjugate matrix acts on it.
    size = np.abs(matrix.view(np.float64)).max()
    (a, b), (c, d) = np.conj(matrix) * 2.0 ** -float(np.frexp(size)[1])
    element = from_spinors(((Complex.of(a), Complex.of(b)), (Complex.of(c), Complex.of(d))))
    determinant = abs(complex(element.determinant()))
    if determinant == 0:
        raise ValueError("matrix is singular: its determinant ad − bc is 0")
    _check_magnification(2 * float(element.norm().hi) / determinant)
    return element.normalized().decomposed()


def _check_magnification(magnification: float) -> None:
    # 2 cosh η = S + 1/S is compared in place of S; the margin accepts S = 1e6 itself in spite of rounding.
    if magnification > MATRIX_MAGNIFICATION * (1 + MATRIX_ERROR):
        raise ValueError(
            f"matrix has magnification {magnification:g}, above {MATRIX_MAGNIFICATION:g}: its doubles do not "
            "determine the map; build it from fisheye and rotation with @"
        )


def stereographic_pipeline(left: Rotation, magnification: float, right: Rotation) -> str:
    """`stere` with k_0 = S at the focus, a turn of the plane, inverse `stere` at the image of the focus."""
    start, end = xyz_to_lonlat(right.inverse()(_Z)), xyz_to_lonlat(left(_Z))
    turn = left.exact_matrix.hi @ right.exact_matrix.hi
    # Images of east and north at the focus, in terms of east and north at its image.
    plane = tangent_frame(end).hi[:2] @ turn @ tangent_frame(start).hi[:2].T
    entries = " ".join(f"+s{i + 1}{j + 1}={_number(plane[i, j])}" for i in (0, 1) for j in (0, 1))
    # Equal frames may differ by two rounded rotations and two rounded centres, each within 2⁻⁵².
    turned = [f"+step +proj=affine {entries}"] if np.abs(plane - np.eye(2)).max() > 4 * STORED_ERROR else []
    first, last = (f"+lat_0={_number(lat)} +lon_0={_number(lon)}" for lon, lat in (start, end))
    steps = [
        "+proj=pipeline",
        "+step +proj=unitconvert +xy_in=deg +xy_out=rad",
        f"+step +proj=stere {first} +k_0={_number(magnification)} +R=1",
        *turned,
        f"+step +inv +proj=stere {last} +k_0=1 +R=1",
        "+step +proj=unitconvert +xy_in=rad +xy_out=deg",
    ]
    return " ".join(steps)


def _number(value: float) -> str:
    """Shortest decimal that reads back as the same double."""
    return repr(float(value)).removesuffix(".0")
