"""Views: the direction from which the sphere is seen, and the projection of the visible part.

Every view shows a cap of the sphere, {x : toward·x ≥ edge}, and maps it onto the unit disc of the page.
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_lonlat, as_scalar, as_vectors
from stereodel.constants import LARGEST_CAP
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.vectors import turned


@dataclass(frozen=True)
class _Above:
    """A view from above a point, north up, rotated counterclockwise by `roll` degrees."""

    lon: float
    lat: float
    roll: float = 0.0

    def __post_init__(self) -> None:
        as_lonlat((self.lon, self.lat), "(lon, lat)")
        as_scalar(self.roll, "roll")

    @property
    def matrix(self) -> FloatArray:
        """Rows right, up, toward the viewer: unit vectors, a rotation matrix (3, 3)."""
        lon, lat = self.lon, self.lat
        above = (lon + 180.0, 90.0 - lat) if lat >= 0 else (lon, 90.0 + lat)
        toward, right, up, (cos, sin, _) = lonlat_to_xyz([(lon, lat), (lon + 90.0, 0.0), above, (self.roll, 0.0)])
        # + 0.0 turns −0 into 0, so that symmetric views give identical files.
        return np.array([cos * right - sin * up, sin * right + cos * up, toward]) + 0.0


@dataclass(frozen=True)
class View(_Above):
    """An orthographic view from above a point of the sphere, north up: the near hemisphere as a ball.

    Parameters
    ----------
    lon, lat : float
        Centre of the picture in degrees. At a pole, up is the limit along `lon`, so that the meridian `lon` is a
        vertical line in every view of the same longitude.
    roll : float, optional
        Counterclockwise rotation of the picture on the page, in degrees.

    Raises
    ------
    ValueError
        If the latitude is outside [-90, 90], or a number is not finite.

    Examples
    --------
    >>> View(0, 90).matrix.tolist()
    [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """

    angular_radius: ClassVar[float] = 90.0
    """Angular radius of the visible cap in degrees."""
    edge: ClassVar[float] = 0.0
    """Cosine of the angular radius of the visible cap."""
    stretch: ClassVar[float] = 1.0
    """Straight lines in space are straight on the page, and no length grows."""
    round: ClassVar[bool] = True
    """Whether the page shows a ball."""

    def flattened(self, axes: FloatArray) -> FloatArray:
        """Page coordinates (..., 2) of unit vectors (..., 3) in view axes."""
        return axes[..., :2]

    def raised(self, xy: FloatArray) -> FloatArray:
        """Unit vectors in view axes (..., 3) of the near side over points (..., 2); NaN outside the unit disc.

        Examples
        --------
        >>> View(0, 0).raised(np.array([0.6, 0.0])).tolist()
        [0.6, 0.0, 0.8]
        """
        with np.errstate(invalid="ignore"):
            height = np.sqrt(1 - np.sum(xy**2, axis=-1, keepdims=True))
        return np.concatenate([np.where(np.isnan(height), np.nan, xy), height], axis=-1)

    def breadth(self, axes: FloatArray, across: FloatArray) -> FloatArray:
        """Ratio of the distance between two close lines on the page to that on the sphere; far and near side alike.

        Arguments in view axes: unit vectors (..., 3), and unit tangent vectors there that point across the lines.
        Areas shrink by |z|, where z is the depth, and lengths along lines by √(z² + c²), where c is the depth of
        `across`: the squared depths of three perpendicular unit vectors sum to 1.

        Examples
        --------
        >>> at, east, north = np.array([[0.6, 0.0, 0.8], [0.8, 0.0, -0.6], [0.0, 1.0, 0.0]])
        >>> View(0, 0).breadth(at, np.stack([east, north])).tolist()
        [0.8, 1.0]
        """
        depth = np.abs(axes[..., 2])
        along = np.hypot(depth, across[..., 2])
        return np.divide(depth, along, out=np.ones_like(along), where=along > 0)

    def axes(self, xyz: npt.ArrayLike) -> FloatArray:
        """Vectors (..., 3) in view axes (right, up, toward the viewer)."""
        return turned(as_vectors(xyz, 3, "xyz"), self.matrix)

    def project(self, xyz: npt.ArrayLike) -> FloatArray:
        """Page coordinates (right, up) of points (..., 3), in their unit, (..., 2)."""
        return self.axes(xyz)[..., :2]

    def depth(self, xyz: npt.ArrayLike) -> FloatArray:
        """Height of points (..., 3) toward the viewer, (...); on a sphere about the origin ≥ 0 is the near side."""
        return self.axes(xyz)[..., 2]


@dataclass(frozen=True)
class StereographicView(_Above):
    """A stereographic view centred on a point of the sphere, north up: a conformal map, projected from the antipode.

    Parameters
    ----------
    lon, lat : float
        Centre of the picture in degrees; at a pole, up is the limit along `lon`.
    roll : float, optional
        Counterclockwise rotation of the picture on the page, in degrees.
    angular_radius : float
        Angular radius of the visible cap in degrees, above 0 and at most `LARGEST_CAP`; 90 is a hemisphere.

    Notes
    -----
    A point at angular distance χ from the centre is mapped to distance tan(χ/2)/tan(angular_radius/2) from the centre
    of the unit disc.

    Examples
    --------
    >>> view = StereographicView(0, 0, angular_radius=120)
    >>> axes = view.raised(np.array([0.5, 0.0]))
    >>> view.flattened(axes).round(15).tolist()
    [0.5, 0.0]
    """

    _: KW_ONLY
    angular_radius: float = 90.0
    round: ClassVar[bool] = False
    """Whether the page shows a ball."""

    def __post_init__(self) -> None:
        super().__post_init__()
        as_scalar(self.angular_radius, "angular_radius", low=0.0, high=LARGEST_CAP, open_low=True)

    @property
    def edge(self) -> float:
        """Cosine of the angular radius of the cap."""
        return float(np.cos(np.radians(self.angular_radius)))

    @property
    def stretch(self) -> float:
        """Bound on the ratio, from the largest scale and the curvature that the change of scale adds.

        The scale 1/(2 τ cos²(χ/2)), τ = tan(angular_radius/2), is largest at the edge; a curve of geodesic curvature k
        has an image whose curvature, times the scale, is at most k + tan(χ/2), while in space its curvature is
        √(1 + k²).
        """
        reach = self._reach
        return (1 + reach**2) / (2 * reach) * (1 + reach)

    @property
    def _reach(self) -> float:
        return float(np.tan(np.radians(self.angular_radius) / 2))

    def flattened(self, axes: FloatArray) -> FloatArray:
        """Page coordinates (..., 2) of unit vectors (..., 3) in view axes."""
        with np.errstate(divide="ignore", invalid="ignore"):
            page: FloatArray = axes[..., :2] / ((1 + axes[..., 2:]) * self._reach)
        return page

    def raised(self, xy: FloatArray) -> FloatArray:
        """Unit vectors in view axes (..., 3) of points (..., 2) of the unit disc; NaN outside it."""
        inside = np.sum(xy**2, axis=-1, keepdims=True) <= 1
        wide = np.where(inside, xy, np.nan) * self._reach
        square = np.sum(wide**2, axis=-1, keepdims=True)
        return np.concatenate([2 * wide, 1 - square], axis=-1) / (1 + square)

    def breadth(self, axes: FloatArray, across: FloatArray) -> FloatArray:
        """Ratio of the distance between two close lines on the page to that on the sphere: the scale of the map."""
        del across  # The map is conformal.
        with np.errstate(divide="ignore"):
            scale: FloatArray = 1 / ((1 + axes[..., 2]) * self._reach)
        return scale


MapView = View | StereographicView
"""A map of a cap of the sphere onto the unit disc of the page."""
