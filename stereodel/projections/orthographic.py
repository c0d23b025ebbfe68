"""Orthographic projection: the globe seen from infinitely far away (the views of Figures 10 to 12)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_directions, as_vectors
from stereodel._double_double import DoubleDouble, dot, stack
from stereodel.constants import SEEN_FACE_ON
from stereodel.projections.plane_curves import Conic, ConicKind
from stereodel.projections.tangent_plane import TangentPlane, nan_where
from stereodel.sphere import SphereCircle
from stereodel.sphere.chunks import by_blocks
from stereodel.sphere.quaternions import transform


@dataclass(frozen=True)
class Orthographic(TangentPlane):
    """Parallel projection along the axis through `center`: d = R sin χ for χ ≤ 90°.

    Parameters
    ----------
    center : (float, float)
        (lon, lat) in degrees of the point that faces the viewer; axes (east, north) as in `Stereographic`.
    radius : float
        Radius R of the sphere in the unit of the plane.

    Examples
    --------
    >>> view = Orthographic((0.0, 90.0))
    >>> print(view.forward([[0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]))
    [[ 1.  0.]
     [nan nan]]
    >>> print(view.inverse([[0.0, 0.0], [2.0, 0.0]]))
    [[ 0.  0.  1.]
     [nan nan nan]]
    """

    def forward(self, xyz: npt.ArrayLike) -> FloatArray:
        """Plane points (..., 2) of directions (..., 3); NaN beyond 90° from the centre."""
        return by_blocks(self._forward, as_directions(xyz, "xyz"))

    def _forward(self, rows: FloatArray) -> FloatArray:
        local = self.local(rows)
        return nan_where(local.hi[..., 2] < 0, local[..., :2].round() * self.radius + 0.0)

    def inverse(self, xy: npt.ArrayLike) -> FloatArray:
        """Unit vectors (..., 3) of plane points (..., 2) on the near side; NaN farther than R from the origin."""
        return by_blocks(self._inverse, as_vectors(xy, 2, "xy"))

    def _inverse(self, rows: FloatArray) -> FloatArray:
        outside = np.hypot(rows[:, 0], rows[:, 1]) > 2 * self.radius
        plane = DoubleDouble(np.where(outside[:, None], 2 * self.radius, rows)) / self.radius
        rest = 1.0 - dot(plane, plane)
        outside = rest.hi < 0
        height = DoubleDouble(np.where(outside, 0.0, rest.hi), np.where(outside, 0.0, rest.lo)).sqrt()
        return nan_where(outside, self.world(stack([plane[..., 0], plane[..., 1], height])))

    def scale_factors(self, xyz: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """(radial, tangential) scale of `forward`, each (...): R cos χ and R; NaN beyond 90° from the centre."""
        heights = by_blocks(lambda rows: self.local(rows)[..., 2].round(), as_directions(xyz, "xyz"))
        radial = nan_where(heights < 0, heights * self.radius)
        return radial, nan_where(heights < 0, np.full_like(heights, self.radius))

    def image_of(self, circle: SphereCircle) -> Conic:
        """The image of a whole circle, its part on the far side included: an ellipse, or a segment when seen edge-on.

        `sample(t)` runs as the circle does, counterclockwise about its normal: clockwise on the plane where that points
        away.
        """
        normal, cosine, _ = circle.exact_parts()
        local = transform(self.frame, normal)
        across = dot(local[:2], local[:2]).sqrt()
        a, c, r = float(across.round()), float(local[2].round()), circle.radius
        along = (local[:2] / across).round() if a > SEEN_FACE_ON else np.array([1.0, 0.0])
        basis = np.array([along, [-along[1], along[0]]])
        center = (across * cosine * self.radius).round()
        # (s − s₀)² + c² p² = c² r², s along the normal's image and p across it.
        form = np.array([[1.0, 0.0, -center], [0.0, c * c, 0.0], [-center, 0.0, 0.0]])
        form[2, 2] = center**2 - (c * r * self.radius) ** 2
        to_basis = np.eye(3)
        to_basis[:2, :2] = basis
        axes = np.array([[c * r], [r]]) * basis * self.radius
        kind: ConicKind = "segment" if c == 0 else "ellipse"
        return Conic(kind, center * along + 0.0, axes + 0.0, to_basis.T @ form @ to_basis)
