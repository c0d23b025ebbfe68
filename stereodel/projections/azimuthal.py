"""Azimuthal projections: stereographic, gnomonic and orthographic, each normal and oblique.

Figures 5, 6 and 9 of the paper; the orthographic one is the globe seen from infinitely far away (Figures 10 to 12).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import KW_ONLY, dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import (
    BoolArray,
    FloatArray,
    IntArray,
    as_amounts,
    as_choice,
    as_direction_or_lonlat,
    as_directions,
    as_scalar,
    as_vectors,
)
from stereodel._double_double import DoubleDouble, by_blocks, dot, scaled, shift_exponent, stack, unit, where
from stereodel.constants import SEEN_FACE_ON, STORED_ERROR
from stereodel.projections.plane_curves import Conic, ConicKind, PlaneCircle, PlaneLine
from stereodel.sphere import SphereCircle
from stereodel.sphere.circles import light_cone
from stereodel.sphere.coordinates import tangent_frame
from stereodel.sphere.rotations import transform


@dataclass(frozen=True)
class TangentPlane(ABC):
    """A projection to a plane that touches a sphere, with axes (east, north) at the point of tangency.

    center: (lon, lat) in degrees of the point of tangency or a direction; at a pole the axes are as in `tangent_frame`.
    radius: radius R of the sphere, in the unit of the plane. Points of the sphere are directions whatever R is.
    """

    center: tuple[float, ...]
    _: KW_ONLY
    radius: float = 1.0

    def __post_init__(self) -> None:
        center = as_direction_or_lonlat(self.center, "center")
        object.__setattr__(self, "center", tuple(center.tolist()))
        object.__setattr__(self, "radius", as_scalar(self.radius, "radius", low=0.0, open_low=True))

    def forward(self, xyz: npt.ArrayLike) -> FloatArray:
        """Plane points (..., 2) of directions (..., 3); NaN outside the domain."""
        return by_blocks(self._forward, as_directions(xyz, "xyz"))

    def inverse(self, xy: npt.ArrayLike) -> FloatArray:
        """Unit vectors (..., 3) of plane points (..., 2); NaN outside the image of the domain."""
        return by_blocks(self._inverse, as_vectors(xy, 2, "xy"))

    @abstractmethod
    def _forward(self, rows: FloatArray) -> FloatArray:
        """Plane points of directions (n, 3)."""

    @abstractmethod
    def _inverse(self, rows: FloatArray) -> FloatArray:
        """Unit vectors of plane points (n, 2)."""

    @cached_property
    def frame(self) -> DoubleDouble:
        """Rows east, north, up at the centre, (3, 3), in double-double."""
        return tangent_frame(self.center, "center")

    def local(self, rows: FloatArray) -> DoubleDouble:
        """Unit vectors of directions (m, 3) in the axes east, north, up."""
        return transform(self.frame, unit(rows))

    def world(self, local: DoubleDouble) -> FloatArray:
        """Vectors (m, 3) from the axes east, north, up to those of the sphere, rounded once."""
        transposed = DoubleDouble(self.frame.hi.T, self.frame.lo.T)
        return transform(transposed, local).round() + 0.0


def nan_where(outside: BoolArray, values: FloatArray) -> FloatArray:
    """NaN in the rows outside the domain of a map."""
    return np.where(outside if values.ndim == outside.ndim else outside[..., None], np.nan, values)


@dataclass(frozen=True)
class Gnomonic(TangentPlane):
    """Projection from the centre of the sphere to the plane that touches it at `center`: d = R tan χ for χ < 90°.

    At 90° from the centre and beyond, and where it overflows, the image is NaN.

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

    def _forward(self, rows: FloatArray) -> FloatArray:
        local = self.local(rows)
        far, height = _guarded(local[..., 2])
        with np.errstate(over="ignore", invalid="ignore"):
            image = (local[..., :2] / height[..., None]).round() * self.radius + 0.0
        return nan_where(far | ~np.isfinite(image).all(axis=-1), image)

    def _inverse(self, rows: FloatArray) -> FloatArray:
        heights = np.full((len(rows), 1), self.radius)
        return self.world(unit(np.concatenate([rows, heights], axis=-1)))

    def scale_factors(self, xyz: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """(radial, tangential) scale of `forward`, each (...): R / cos² χ and R / cos χ; NaN at 90° and beyond."""

        def scales(rows: FloatArray) -> FloatArray:
            far, height = _guarded(self.local(rows)[..., 2])
            secant = 1.0 / height
            return nan_where(far, stack([secant * secant, secant]).round() * self.radius)

        found = by_blocks(scales, as_directions(xyz, "xyz"))
        return found[..., 0], found[..., 1]

    def image_of(self, circle: SphereCircle) -> Conic:
        """The image of the part of a circle that lies less than 90° from the centre.

        A line for a great circle; otherwise an ellipse, parabola or hyperbola as the circle stays away from, touches
        (within `STORED_ERROR`) or crosses the great circle at 90°; empty when no part of it lies within.
        """
        across, cosine, c, basis = _seen(self, circle)
        a, spread = float(across.round()), float((across * across - cosine * cosine).round())
        kind, shift, sizes = _shape(a, c, circle, spread)
        form = np.diag([spread, -(circle.offset**2), c * c - circle.offset**2])
        form[0, 2] = form[2, 0] = a * c
        return _conic(kind, shift, sizes, basis, self.radius, form)


def _guarded(height: DoubleDouble) -> tuple[BoolArray, DoubleDouble]:
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


@dataclass(frozen=True)
class Orthographic(TangentPlane):
    """Parallel projection along the axis through `center`: d = R sin χ for χ ≤ 90°, and to the near side back.

    The image is NaN beyond 90° from the centre, and so is the inverse farther than R from the origin.

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

    def _forward(self, rows: FloatArray) -> FloatArray:
        local = self.local(rows)
        return nan_where(local.hi[..., 2] < 0, local[..., :2].round() * self.radius + 0.0)

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
        across, cosine, c, basis = _seen(self, circle)
        center, r = float((across * cosine).round()), circle.radius
        # (s − s₀)² + c² p² = c² r², s along the normal's image and p across it.
        form = np.array([[1.0, 0.0, -center], [0.0, c * c, 0.0], [-center, 0.0, center**2 - (c * r) ** 2]])
        return _conic("segment" if c == 0 else "ellipse", center, (c * r, r), basis, self.radius, form)


def _seen(view: TangentPlane, circle: SphereCircle) -> tuple[DoubleDouble, DoubleDouble, float, FloatArray]:
    """Of a circle the length of its normal's image, cos α and the normal's height, and rows along and across that."""
    normal, cosine, _ = circle.exact_parts()
    local = transform(view.frame, normal)
    across = dot(local[:2], local[:2]).sqrt()
    x, y = (local[:2] / across).round() if float(across.hi) > SEEN_FACE_ON else (1.0, 0.0)
    return across, cosine, float(local[2].round()), np.array([[x, y], [-y, x]])


def _conic(
    kind: ConicKind, shift: float, sizes: tuple[float, float], basis: FloatArray, radius: float, form: FloatArray
) -> Conic:
    """A conic by its centre and signed half axes along the rows of a basis, and its matrix there, all over a radius."""
    to_basis = np.eye(3)
    to_basis[:2, :2] = basis / radius
    axes = np.array(sizes)[:, None] * basis * radius
    return Conic(kind, shift * basis[0] * radius + 0.0, axes + 0.0, to_basis.T @ form @ to_basis)


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
        with_distance = np.concatenate([plane.hi, np.full((*plane.hi.shape[:-1], 1), d)], axis=-1)
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
        return np.asarray(np.degrees(2 * np.arctan2(as_amounts(distance, "distance", "length"), self.unit_distance)))

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
