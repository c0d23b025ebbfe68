"""Gnomonic projection: from the centre of the sphere, great circles to lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_directions, as_vectors
from stereodel._double_double import DoubleDouble, dot, stack, unit
from stereodel.constants import STORED_ERROR
from stereodel.projections.plane_curves import Conic, ConicKind
from stereodel.projections.tangent_plane import TangentPlane, nan_where
from stereodel.sphere import SphereCircle
from stereodel.sphere.chunks import by_blocks
from stereodel.sphere.quaternions import transform


@dataclass(frozen=True)
class Gnomonic(TangentPlane):
    """Projection from the centre of the sphere to the plane that touches it at `center`: d = R tan χ for χ < 90°.

    Parameters
    ----------
    center : (float, float)
        (lon, lat) in degrees of the point of tangency; axes (east, north) as in `Stereographic`.
    radius : float
        Radius R of the sphere in the unit of the plane.

    Examples
    --------
    >>> view = Gnomonic((0.0, 0.0))
    >>> print(view.forward([[1.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]))
    [[ 1.  0.]
     [nan nan]]
    >>> radial, tangential = view.scale_factors([1.0, 1.0, 0.0])
    >>> print(round(float(radial), 12), round(float(tangential), 12))
    2.0 1.414213562373
    """

    def forward(self, xyz: npt.ArrayLike) -> FloatArray:
        """Plane points (..., 2) of directions (..., 3); NaN at 90° from the centre and beyond, and on overflow."""
        return by_blocks(self._forward, as_directions(xyz, "xyz"))

    def _forward(self, rows: FloatArray) -> FloatArray:
        local = self.local(rows)
        far, height = _guarded(local[..., 2])
        with np.errstate(over="ignore", invalid="ignore"):
            image = (local[..., :2] / height[..., None]).round() * self.radius + 0.0
        return nan_where(far | ~np.isfinite(image).all(axis=-1), image)

    def inverse(self, xy: npt.ArrayLike) -> FloatArray:
        """Unit vectors (..., 3) of plane points (..., 2)."""
        return by_blocks(self._inverse, as_vectors(xy, 2, "xy"))

    def _inverse(self, rows: FloatArray) -> FloatArray:
        heights = np.full((len(rows), 1), self.radius)
        return self.world(unit(np.concatenate([rows, heights], axis=-1)))

    def scale_factors(self, xyz: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """(radial, tangential) scale of `forward`, each (...): R / cos² χ and R / cos χ; NaN at 90° and beyond."""
        scales = by_blocks(self._scales, as_directions(xyz, "xyz"))
        return scales[..., 0], scales[..., 1]

    def _scales(self, rows: FloatArray) -> FloatArray:
        far, height = _guarded(self.local(rows)[..., 2])
        secant = 1.0 / height
        return nan_where(far, stack([secant * secant, secant]).round() * self.radius)

    def image_of(self, circle: SphereCircle) -> Conic:
        """The image of the part of a circle that lies less than 90° from the centre.

        A line for a great circle; otherwise an ellipse, parabola or hyperbola as the circle stays away from, touches
        (within `STORED_ERROR`) or crosses the great circle at 90°; empty when no part of it lies within.
        """
        normal, cosine, _ = circle.exact_parts()
        local = transform(self.frame, normal)
        across = dot(local[:2], local[:2]).sqrt()
        spread = float((across * across - cosine * cosine).round())
        a, c = float(across.round()), float(local[2].round())
        along = (local[:2] / across).round() if a > 0 else np.array([1.0, 0.0])
        basis = np.array([along, [-along[1], along[0]]])
        kind, shift, sizes = _shape(a, c, circle, spread)
        form = np.diag([spread, -(circle.offset**2), c * c - circle.offset**2])
        form[0, 2] = form[2, 0] = a * c
        to_basis = np.eye(3)
        to_basis[:2, :2] = basis / self.radius
        axes = np.array(sizes)[:, None] * basis * self.radius
        return Conic(kind, shift * along * self.radius + 0.0, axes + 0.0, to_basis.T @ form @ to_basis)


def _guarded(height: DoubleDouble) -> tuple[np.ndarray[tuple[int, ...], np.dtype[np.bool_]], DoubleDouble]:
    """Where cos χ ≤ 0, and cos χ with 1 in those places."""
    far = height.hi <= 0
    return far, DoubleDouble(np.where(far, 1.0, height.hi), np.where(far, 0.0, height.lo))


def _shape(a: float, c: float, circle: SphereCircle, spread: float) -> tuple[ConicKind, float, tuple[float, float]]:
    """Kind, centre and signed half axes of (a s + c)² = d²(1 + s² + p²), s along the normal's image, p across it.

    (a, c) are the parts of the circle's normal across and along the axis, d its offset, spread = a² − d². Of the two
    branches of the squared equation the image is the one where a s + c has the sign of d.
    """
    d, r = circle.offset, circle.radius
    if d == 0:
        return ("line", -c / a, (0.0, 1.0)) if a > 0 else ("empty", np.nan, (np.nan, np.nan))
    if abs(spread) <= STORED_ERROR * 2 * a * abs(c):
        kind: ConicKind = "parabola" if c * d > 0 else "empty"
        shift, sizes = (d * d - r * r) / (2 * abs(d) * c), (abs(d) / (2 * c), 1.0)
    elif spread > 0:
        kind, shift, sizes = "hyperbola", -a * c / spread, (d * r / spread, r / np.sqrt(spread))
    else:
        kind = "ellipse" if c * d > 0 else "empty"
        shift, sizes = -a * c / spread, (abs(d) * r / -spread, r / np.sqrt(-spread))
    return (kind, shift, sizes) if kind != "empty" else (kind, np.nan, (np.nan, np.nan))
