"""Circles on the sphere and the two bubbles that each of them bounds (Figure 3 of the paper)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, Keyed, as_count, as_directions, as_scalar, read_only
from stereodel._double_double import DoubleDouble, by_blocks, cross, dot, unit, where
from stereodel.constants import STORED_ERROR, UNDECIDED
from stereodel.sphere.coordinates import as_direction, tangent_frame
from stereodel.sphere.degrees import sin_cos_degrees


@dataclass(frozen=True, eq=False)
class SphereCircle(Keyed):
    """The circle n·x = offset on the unit sphere, with the side n·x > offset as its interior.

    Parameters
    ----------
    normal : array_like, shape (2,) or (3,)
        Centre of the interior: (lon, lat) in degrees or a direction; stored as a unit vector.
    offset : float
        cos α in (−1, 1), α the angular radius of the interior.
    radius : float, optional
        sin α in (0, 1], the radius of the circle in space. Given together with `offset` it keeps tiny circles accurate:
        the *direction* of (offset, radius) is α. By default √(1 − offset²).

    Raises
    ------
    ValueError
        For an offset outside (−1, 1) without a radius, a radius that is not positive or does not fit the offset.

    Examples
    --------
    >>> tropic = SphereCircle.around((0.0, 90.0), 66.5)
    >>> round(tropic.angular_radius, 9), bool(tropic.contains([0.0, 0.0, 1.0]))
    (66.5, True)
    >>> tropic.large_bubble == tropic.complement
    True
    """

    normal: FloatArray
    offset: float
    radius: float = 0.0

    def __post_init__(self) -> None:
        offset = as_scalar(self.offset, "offset", low=-1.0, high=1.0)
        radius = as_scalar(self.radius, "radius", low=0.0, high=1.0) or _complete(offset)
        if radius == 0:
            raise ValueError(f"offset is {offset}: the circle is a point; give its radius beside the offset")
        if abs(offset * offset + radius * radius - 1) > STORED_ERROR:
            raise ValueError(f"radius is {radius}, but offset {offset} belongs to radius {_complete(offset)}")
        object.__setattr__(self, "normal", read_only(stored_unit(as_direction(self.normal, "normal"))))
        object.__setattr__(self, "offset", offset)
        object.__setattr__(self, "radius", radius)

    @classmethod
    def around(cls, center: npt.ArrayLike, angular_radius: float) -> SphereCircle:
        """The circle at a distance in degrees, in (0, 180), from a point: (lon, lat) in degrees or a direction."""
        angle = as_scalar(angular_radius, "angular_radius", low=0.0, high=180.0, open_low=True, open_high=True)
        sine, cosine = sin_cos_degrees(np.asarray(angle))
        return cls(as_direction(center, "center"), float(cosine.round()), float(sine.round()))

    @classmethod
    def through(cls, a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike) -> SphereCircle:
        """The circle through three points, its interior on the side from which a, b, c appear counterclockwise.

        Parameters
        ----------
        a, b, c : array_like, shape (2,) or (3,)
            Distinct points, each (lon, lat) in degrees or a direction.
        """
        p, q, r = (unit(as_direction(point, name)) for point, name in ((a, "a"), (b, "b"), (c, "c")))
        sides = [q - p, r - q, p - r]
        lengths = [dot(side, side).sqrt() for side in sides]
        if min(float(length.hi) for length in lengths) <= UNDECIDED:
            raise ValueError("a, b, c do not define a circle: two of them are the same point up to 2**-100")
        axis = cross(sides[0], -sides[2])
        norm = dot(axis, axis).sqrt()
        # Circumradius of the chordal triangle: product of the sides over four times its area.
        radius = lengths[0] * lengths[1] * lengths[2] / (norm * 2.0)
        return cls.rounded(axis / norm, dot(axis / norm, p), radius)

    @classmethod
    def rounded(cls, normal: DoubleDouble, offset: DoubleDouble, radius: DoubleDouble) -> SphereCircle:
        """A circle from double-double parts with |normal|² = offset² + radius² (any common factor), rounded once."""
        size = (offset * offset + radius * radius).sqrt()
        length = dot(normal, normal).sqrt()
        return cls((normal / length).round(), float((offset / size).round()), float((radius / size).round()))

    @property
    def center(self) -> FloatArray:
        """Centre of the interior on the sphere: the unit vector `normal`."""
        return self.normal

    @property
    def angular_radius(self) -> float:
        """Degrees from the centre to the circle, in (0, 180)."""
        return float(np.degrees(np.arctan2(self.radius, self.offset)))

    def exact_parts(self) -> tuple[DoubleDouble, DoubleDouble, DoubleDouble]:
        """The circle that the stored numbers define: unit normal (3,), cos α and sin α in double-double."""
        pair = DoubleDouble(np.array([self.offset, self.radius]))
        pair = pair / dot(pair, pair).sqrt()
        return unit(self.normal), pair[0], pair[1]

    @property
    def complement(self) -> SphereCircle:
        """The same circle with its two sides exchanged."""
        return SphereCircle(-self.normal + 0.0, -self.offset + 0.0, self.radius)

    @property
    def small_bubble(self) -> SphereCircle:
        """The circle with the smaller side as its interior; itself when it is a great circle."""
        return self if self.offset >= 0 else self.complement

    @property
    def large_bubble(self) -> SphereCircle:
        """The circle with the larger side as its interior; the complement when it is a great circle."""
        return self.small_bubble.complement

    def contains(self, xyz: npt.ArrayLike) -> BoolArray:
        """Whether directions (..., 3) lie inside or on the circle, n·x ≥ offset.

        Evaluated in double-double for the stored circle: points within 2⁻¹⁰⁰ of it may count either way. The exact
        test for a circle given by three points is `in_bubble`.
        """
        return by_blocks(self._depth, as_directions(xyz, "xyz")) >= 0

    def _depth(self, rows: FloatArray) -> FloatArray:
        """A number with the sign of n·x − offset; beyond |cos| = 0.9 by 1 − n·x = |x − n|²/2, which keeps digits."""
        x = unit(rows)
        normal, cosine, sine = self.exact_parts()
        if abs(self.offset) < 0.9:
            return (dot(x, normal) - cosine).hi
        side = float(np.sign(self.offset))
        chord = x - normal * side
        margin = sine * sine / (1.0 + cosine * side) - dot(chord, chord) * 0.5
        return margin.hi * side

    def sample(self, n: int) -> FloatArray:
        """Points on the circle, (n, 3), evenly spaced and counterclockwise about `normal`.

        The first lies due south of the centre; for a centre at the north pole at longitude 0, at the south pole at 180.
        """
        angles: FloatArray = np.arange(as_count(n, "n")) * 360.0 / n
        sine, cosine = (part[:, None] for part in sin_cos_degrees(angles))
        normal, offset, radius = self.exact_parts()
        east, north = tangent_frame(self.normal)[0], tangent_frame(self.normal)[1]
        return (normal * offset + (east * sine - north * cosine) * radius).round() + 0.0

    @property
    def _key(self) -> tuple[float, ...]:
        return (*self.normal.tolist(), self.offset, self.radius)


def _complete(offset: float) -> float:
    """√(1 − offset²), 1 − offset and 1 + offset being exact in double-double."""
    cosine = DoubleDouble(offset)
    return float(((1.0 - cosine) * (1.0 + cosine)).sqrt().round())


def stored_unit(direction: FloatArray) -> FloatArray:
    """A vector (3,) of unit length unchanged, any other normalised and rounded: storing twice changes nothing."""
    nearest = unit(direction).round()
    return direction if np.abs(direction - nearest).max() <= STORED_ERROR else nearest


def on_circle(circle: SphereCircle, point: DoubleDouble) -> DoubleDouble:
    """The point of a circle nearest to a unit vector (3,), with |x| = 1 to double-double."""
    normal, offset, radius = circle.exact_parts()
    across = point - normal * dot(point, normal)
    return normal * offset + across / dot(across, across).sqrt() * radius


def one_plus_minus(height: DoubleDouble, across: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble]:
    """1 + c and 1 − c of unit vectors with height c along an axis and |t|² = `across`, with small relative errors."""
    # Near the axis one of the two is |t|² over the other, t the part across the axis, and never a difference.
    upper = height.hi >= 0
    large = 1.0 + where(upper, height, -height)
    small = across / large
    return where(upper, large, small), where(upper, small, large)


def light_cone(normal: DoubleDouble, cosine: DoubleDouble, sine: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble]:
    """n_z + cos α and n_z − cos α of n·x = cos α, n (3,): light-cone coordinates of (n, cos α) in Minkowski space."""
    # Each is a difference of whichever of 1 ± n_z and 1 ± cos α are small, so a tiny circle near the axis keeps its
    # relative size.
    n_plus, n_minus = one_plus_minus(normal[2], normal[0] * normal[0] + normal[1] * normal[1])
    d_plus, d_minus = one_plus_minus(cosine, sine * sine)
    plus = n_plus - d_minus if float(n_plus.hi + d_minus.hi) < 2 else d_plus - n_minus
    minus = d_minus - n_minus if float(d_minus.hi + n_minus.hi) < 2 else n_plus - d_plus
    return plus, minus
