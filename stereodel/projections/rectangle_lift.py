"""A rectangle lifted to a hemisphere of its own sphere (section on inverse projections; Figures 7 to 9)."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_amounts, as_points, as_scalar, as_vectors
from stereodel._double_double import DoubleDouble, by_blocks, dot
from stereodel.projections.azimuthal import Stereographic


@dataclass(frozen=True)
class RectangleLift:
    """Inverse stereographic projection of a rectangle to the sphere of diameter D/2 that touches it at its centroid.

    The plane is the tangent plane at the south pole. The corners, at D/2 from the centroid, land on the equator, and
    the rectangle inside the southern hemisphere.

    Parameters
    ----------
    width, height : float
        Sides along x and y, in map units; not both zero.
    center : (float, float)
        The centroid (x, y).

    Notes
    -----
    The axes are those of `Stereographic((0, -90))`: x is east and y north at the south pole in the limit along
    longitude 0, so +x points to longitude 90 and +y to longitude 0. Seen from outside the sphere, which is from below
    through the plane, the rectangle appears unmirrored.

    Examples
    --------
    >>> lift = RectangleLift(4.0, 3.0)
    >>> lift.sphere.radius, round(lift.angular_radius, 12)
    (1.25, 90.0)
    >>> print(lift.forward([[0.0, 0.0], [2.0, 1.5]]))
    [[ 0.   0.  -1. ]
     [ 0.6  0.8  0. ]]
    >>> print(lift.scale_factor([[0.0, 0.0], [2.0, 1.5]]))
    [1.  0.5]
    """

    width: float
    height: float
    _: KW_ONLY
    center: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        for name in ("width", "height"):
            object.__setattr__(self, name, as_scalar(getattr(self, name), name, low=0.0))
        if self.width == self.height == 0:
            raise ValueError("width and height are both 0: a rectangle that is a point has no lift")
        center = as_points([self.center], 2, "center")[0]
        object.__setattr__(self, "center", tuple(center.tolist()))

    @classmethod
    def fit(cls, points: npt.ArrayLike) -> RectangleLift:
        """The lift of the bounding rectangle, along the axes, of plane points (n, 2) that are not all equal."""
        xy = as_points(points, 2)
        if len(xy) == 0:
            raise ValueError("points is empty: there is no rectangle to lift")
        low, high = xy.min(axis=0), xy.max(axis=0)
        width, height = (high - low).tolist()
        x, y = (low + (high - low) / 2).tolist()
        return cls(width, height, center=(x, y))

    @property
    def diagonal(self) -> float:
        """D, twice the diameter of the sphere."""
        return float(np.hypot(self.width, self.height))

    @cached_property
    def sphere(self) -> Stereographic:
        """The projection between the sphere of radius R = D/4 and its tangent plane at the south pole."""
        return Stereographic((0.0, -90.0), radius=self.diagonal / 4)

    @property
    def angular_radius(self) -> float:
        """Angular radius of the lifted rectangle about the south pole, degrees: its corners are on the equator."""
        return float(self.sphere.angular_radius(self.diagonal / 2))

    def forward(self, xy: npt.ArrayLike) -> FloatArray:
        """Unit vectors (..., 3) of plane points (..., 2); points outside the rectangle go north of its image."""
        return by_blocks(lambda rows: self.sphere.lift(self._centered(rows)), as_vectors(xy, 2, "xy"))

    def _centered(self, rows: FloatArray) -> DoubleDouble:
        return DoubleDouble(rows) - np.array(self.center)

    def inverse(self, xyz: npt.ArrayLike) -> FloatArray:
        """Plane points (..., 2) of directions (..., 3); NaN at the north pole."""
        return self.sphere.forward(xyz) + np.array(self.center)

    def scale_factor(self, xy: npt.ArrayLike) -> FloatArray:
        """Length on the sphere of radius R over length in the plane at plane points (..., 2): 4R² / (4R² + d²).

        1 at the centroid, ½ at the corners, and (1 + sin φ)/2 at latitude φ south (claims P10 and P11). The derivative
        of the unit vectors of `forward` is this over R.
        """
        return by_blocks(self._scale, as_vectors(xy, 2, "xy"))

    def _scale(self, rows: FloatArray) -> FloatArray:
        ratio = self._centered(rows) / self.sphere.unit_distance
        return (1.0 / (1.0 + dot(ratio, ratio))).round()

    def scale_rate(self, xy: npt.ArrayLike) -> FloatArray:
        """Rate of change of `scale_factor` along meridians at plane points (..., 2), per radian of latitude φ south.

        ∂s/∂φ = cos φ / 2 (claim P11), which at distance d is t/(1 + t²), t = d/2R: 0 at the centroid and ½ at the
        corners. Along parallels the scale is constant.

        Examples
        --------
        >>> print(RectangleLift(4.0, 3.0).scale_rate([[0.0, 0.0], [2.0, 1.5]]))
        [0.  0.5]
        """
        return by_blocks(self._rate, as_vectors(xy, 2, "xy"))

    def _rate(self, rows: FloatArray) -> FloatArray:
        ratio = (self._centered(rows) / self.sphere.unit_distance).round()
        with np.errstate(divide="ignore", over="ignore"):
            t = np.hypot(ratio[..., 0], ratio[..., 1])
            t = np.minimum(t, 1.0 / t)  # t and 1/t have one rate; the square of the smaller one is finite
        return np.asarray(t / (1.0 + t * t))

    def separation_bounds(self, d: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Least and largest angle, in degrees, between the lifted images of points of the rectangle at distance d.

        Parameters
        ----------
        d : array_like, shape (...)
            Distances in the plane, from 0 to the diagonal D.

        Returns
        -------
        lower, upper : ndarray, shape (...)
            (2/π)·(d/D)·180° and (4/π)·(d/D)·180°.

        Notes
        -----
        Since the scale on the sphere of radius D/4 lies between ½ and 1, an image chord is at least d/2 and an image
        path at most d long (claim P13). The paper gives ½ as the lower constant; 2/π is larger and tight, approached by
        close pairs at a corner, as 4/π is by close pairs at the centroid. Of all rectangles of diagonal D, points at
        distance d are separated by 2 arcsin(d/D), of two corners, to 4 arctan(d/D), of pairs symmetric about the
        centroid; both bounds follow from these, as arcsin t ≥ t and arctan t ≤ t.
        """
        distance = as_amounts(d, "d", "length")
        if (distance > self.diagonal).any():
            raise ValueError(f"d is {distance.max()}, but no two points are farther apart than {self.diagonal}")
        fraction = distance / self.diagonal
        return np.asarray(np.degrees(2 * fraction)), np.asarray(np.degrees(4 * fraction))
