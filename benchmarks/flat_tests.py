"""Four ways to decide on which side of a circle of the sphere a point lies, each with the bound of its error.

The input are rounded unit vectors; the right answer is the exact sign on the rays through them. Each method returns
(value, bound): the sign is proved where |value| > bound. u = 2⁻⁵³ throughout; how the bounds count roundings is said in
`stereodel.predicates.staged`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stereodel import RectangleLift, Stereographic, in_bubble, orient3d
from stereodel._arrays import FloatArray
from stereodel._double_double import unit
from stereodel.constants import UNIT_ROUNDOFF
from stereodel.predicates.rays import bubble_filter, units
from stereodel.predicates.signs import SignArray
from stereodel.predicates.staged import Pair, columns, det3

Quadruples = tuple[FloatArray, FloatArray, FloatArray, FloatArray]
"""Points a, b, c, p of k tests, (k, 3) each."""

# The determinant of computed differences: three differences and the five roundings of det3 in each term: N = 8.
_EVALUATION = 9 * UNIT_ROUNDOFF

# A component below 1 rounds by at most u/2, so a rounded unit vector lies within √3/2·u of the direction it stands for.
ROUNDED = 0.5 * 3.0**0.5 * UNIT_ROUNDOFF

# `Stereographic.forward` works on unit vectors with errors of 2⁻¹⁰² and a frame with errors of 2⁻¹⁰⁰ a component;
# products and sums add less than that again: the projected point, before it is rounded, is within 2⁻⁹⁷.
_PROJECTION = 2.0**-97


@dataclass(frozen=True)
class Region:
    """A region of the sphere for the paper's lift: its centre and its extent."""

    center: FloatArray
    lift: RectangleLift

    @classmethod
    def around(cls, center: FloatArray, angular_radius: float) -> Region:
        """The cap of an angular radius (radians) about a centre, in the rectangle around its plane image."""
        side = 4.0 * float(np.tan(angular_radius / 2))
        return cls(center, RectangleLift(side, side))

    def lifted(self, xyz: FloatArray) -> tuple[FloatArray, float]:
        """Rounded unit vectors on the region's own sphere, and how far they may be from exact images.

        First to the plane that touches the sphere at the centre, then to the sphere of diameter D/2 (claim P10). A
        plane point at distance d from the centre is rounded by at most u·d; on the sphere of radius R that is at most
        u·d/R in the angle, the scale being at most 1 (claim P11); the result is rounded as every unit vector.
        """
        plane = Stereographic(tuple(self.center)).forward(xyz)
        distance = float(np.sqrt((plane * plane).sum(axis=-1)).max())
        error = (UNIT_ROUNDOFF * distance + _PROJECTION) / self.lift.sphere.radius
        return self.lift.forward(plane), error + ROUNDED


def sidedness(quadruples: Quadruples, error: float) -> Pair[FloatArray]:
    """The plain test, det(b−a, c−a, p−a), for points known within `error`.

    The determinant is linear in each row; with l the computed lengths of the rows and every row off by at most
    2·error, it moves by at most 2·error·Σ (l+2·error)(l′+2·error) over the pairs of rows (Hadamard's inequality),
    taken with 3 in place of 2 for the rounding of the lengths.
    """
    a, b, c, p = quadruples
    rows = [columns(v - a) for v in (b, c, p)]
    u, v, w = (tuple(map(np.abs, row)) for row in rows)
    permanent = sum(u[i] * (v[j] * w[k] + v[k] * w[j]) for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)))
    lb, lc, lp = (np.sqrt(x * x + y * y + z * z) + 3 * error for x, y, z in rows)
    return det3(*rows), _EVALUATION * permanent + 3 * error * (lb * lc + lc * lp + lp * lb)


def plain(quadruples: Quadruples) -> Pair[FloatArray]:
    """On the rounded unit vectors as they stand."""
    return sidedness(quadruples, ROUNDED)


def lifted(quadruples: Quadruples, region: Region) -> Pair[FloatArray]:
    """The plain test after the paper's lift of the whole region."""
    images, error = region.lifted(np.stack(quadruples))
    return sidedness(tuple(images), error)


def curvature(quadruples: Quadruples) -> Pair[FloatArray]:
    """The curvature form of the determinant, the library's filter."""
    return bubble_filter(*(columns(units(v)) for v in quadruples))


def rounded_exactly(quadruples: Quadruples) -> SignArray:
    """The exact sign of the plain determinant of the rounded vectors: what a convex hull of them decides."""
    return np.asarray(orient3d(*quadruples))


def truth(quadruples: Quadruples) -> SignArray:
    """The exact sign on the rays."""
    return np.asarray(in_bubble(*quadruples))


def rounded_units(vectors: FloatArray) -> FloatArray:
    """Unit vectors rounded once."""
    return unit(vectors).round()
