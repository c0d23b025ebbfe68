"""Stereographic projection, normal and oblique (section on projections; Figures 5, 6 and 9 of the paper)."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, IntArray, as_choice, as_directions, as_lengths, as_vectors
from stereodel._double_double import DoubleDouble, by_blocks, dot, stack, where
from stereodel.constants import STORED_ERROR
from stereodel.projections.azimuthal import TangentPlane
from stereodel.projections.plane_curves import PlaneCircle, PlaneLine
from stereodel.sphere import SphereCircle
from stereodel.sphere.circles import light_cone, shift_exponent
from stereodel.sphere.coordinates import scaled
from stereodel.sphere.rotations import transform


@dataclass(frozen=True)
class Stereographic(TangentPlane):
    """Projection from the antipode of `center` to a plane: conformal, circles to circles or lines.

    The antipode itself has no image: NaN.

    Parameters
    ----------
    center : (float, float)
        (lon, lat) in degrees of the point of tangency. The plane's axes are (east, north) there; at a pole the limit
        along `lon`. The orientation is that seen from outside the sphere. A direction (x, y, z) is accepted too.
    radius : float
        Radius R of the sphere in the unit of the plane.
    plane : {"tangent", "equatorial"}
        The plane that touches the sphere at the centre, d = 2R tan(χ/2) at angular distance χ from it, or the one
        through the middle of the sphere, d = R tan(χ/2).

    Notes
    -----
    Evaluated in double-double and rounded once: forward results are exact up to 4·2⁻⁵² of their length for a point
    within 4·2⁻⁵² rad of the given one, near the centre and near its antipode alike; unit vectors from `inverse`
    are exact up to rounding. J. P. Snyder, "Map Projections: A Working Manual", USGS PP 1395 (1987), section 21.

    Examples
    --------
    >>> south = Stereographic((0.0, -90.0))
    >>> print(south.forward([[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]]))
    [[ 2.  0.]
     [ 0.  0.]
     [nan nan]]
    >>> print(south.inverse([2.0, 0.0]), south.scale_factor([0.0, 1.0, 0.0]))
    [0. 1. 0.] 2.0
    """

    _: KW_ONLY
    plane: Literal["tangent", "equatorial"] = "tangent"

    def __post_init__(self) -> None:
        super().__post_init__()
        as_choice(self.plane, ("tangent", "equatorial"), "plane")

    @property
    def unit_distance(self) -> float:
        """Distance in the plane of the great circle at 90° from the centre: 2R, or R for the equatorial plane."""
        return 2 * self.radius if self.plane == "tangent" else self.radius

    def _forward(self, rows: FloatArray) -> FloatArray:
        across, above, exponent = _heights(self.local(rows))
        size, shift = np.frexp(self.unit_distance)
        # A point whose image is longer than any double has an infinite image, not a wrong one.
        with np.errstate(over="ignore"):
            plane: FloatArray = np.ldexp((across / above[..., None] * size).round(), (shift - exponent)[..., None])
        return plane + 0.0

    def _inverse(self, rows: FloatArray) -> FloatArray:
        return self.lift(DoubleDouble(rows))

    def in_space(self, xy: npt.ArrayLike) -> FloatArray:
        """Positions in space, (..., 3), of plane points (..., 2), with the sphere of `radius` about the origin.

        A point of the sphere, its image and the antipode of the centre are collinear: that defines the projection.

        Examples
        --------
        >>> print(Stereographic((0.0, -90.0)).in_space([2.0, 0.0]))
        [ 0.  2. -1.]
        """
        east, north, up = self.frame.round()
        points = as_vectors(xy, 2, "xy")
        height = self.radius if self.plane == "tangent" else 0.0
        return points[..., :1] * east + points[..., 1:] * north + height * up

    def lift(self, plane: DoubleDouble) -> FloatArray:
        """Unit vectors of plane points (m, 2) in double-double."""
        d = self.unit_distance
        # Homogeneous coordinates over a power of two: no plane point is too far away or too near.
        with_distance = np.concatenate([plane.hi, np.full((*plane.shape[:-1], 1), d)], axis=-1)
        exponent = -scaled(with_distance)[1]
        half = exponent // 2
        x, y = (shift_exponent(shift_exponent(plane[..., k], half), exponent - half) for k in range(2))
        w = DoubleDouble(np.ldexp(np.ldexp(d, half), exponent - half))
        square, ww = x * x + y * y, w * w
        return self.world(stack([x * w * 2.0, y * w * 2.0, ww - square]) / (ww + square)[..., None])

    def scale_factor(self, xyz: npt.ArrayLike) -> FloatArray:
        """Local scale of `forward` at directions (..., 3): plane length over angle, the same in all directions.

        2R / (1 + cos χ) in the tangent plane, half of it in the equatorial plane; NaN at the antipode.
        """
        return by_blocks(self._scale, as_directions(xyz, "xyz"))

    def _scale(self, rows: FloatArray) -> FloatArray:
        _, above, exponent = _heights(self.local(rows))
        size, shift = np.frexp(self.unit_distance)
        with np.errstate(over="ignore"):
            return np.asarray(np.ldexp((size / above).round(), shift - 2 * exponent))

    def angular_radius(self, distance: npt.ArrayLike) -> FloatArray:
        """Angular radius in degrees of a disc of the plane around the centre, of radius `distance`.

        Claim P9, Figure 6: the smaller the sphere, the larger the angular radius.
        """
        return np.asarray(np.degrees(2 * np.arctan2(as_lengths(distance, "distance"), self.unit_distance)))

    def image_of(self, circle: SphereCircle) -> PlaneCircle | PlaneLine:
        """The image of a circle: a circle, or a line when it passes through the antipode of the centre.

        A circle that passes within `STORED_ERROR` of the antipode cannot be told from one through it: a line.
        """
        normal, cosine, sine = circle.exact_parts()
        local = transform(self.frame, normal)
        plus, minus = light_cone(local, cosine, sine)
        if abs(float(plus.hi)) <= STORED_ERROR * circle.radius:
            across = local[:2]
            length = dot(across, across).sqrt()
            offset = float((-minus / (length * 2.0)).round()) * self.unit_distance
            return PlaneLine((across / length).round() + 0.0, offset + 0.0)
        center = (local[:2] / plus * self.unit_distance).round() + 0.0
        radius = abs(float((sine / plus * self.unit_distance).round()))
        return PlaneCircle(center, radius, outside=bool(plus.hi < 0))


def _heights(local: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble, IntArray]:
    """The part t of unit vectors across the axis and 1 + c, as t·2⁻ᵉ, (1 + c)·4⁻ᵉ and e.

    e is not 0 on the far hemisphere only, where 1 + c = |t|²/(1 − c) may be too small for a double. At the antipode the
    second is NaN, and so is all that is made from it.
    """
    c = local[..., 2]
    exponent = np.where(c.hi < 0, scaled(local.hi[..., :2])[1], 0)
    across = shift_exponent(local[..., :2], -exponent[..., None])
    square = dot(across, across)
    square = where((c.hi < 0) & (square.hi == 0), DoubleDouble(np.nan), square)
    far = square / (1.0 + where(c.hi < 0, -c, c))
    return across, where(c.hi < 0, far, 1.0 + c), exponent
