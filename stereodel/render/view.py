"""Orthographic views: which way the picture looks at the sphere."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_lonlat, as_scalar, as_vectors
from stereodel.sphere import lonlat_to_xyz


@dataclass(frozen=True)
class View:
    """An orthographic view from above a point of the sphere, north up.

    Parameters
    ----------
    lon, lat : float
        The point in the middle of the picture, degrees. At a pole `up` is the limit along `lon`, so that the meridian
        `lon` is a vertical line in every view of the same longitude.
    roll : float, optional
        Degrees by which the picture is then turned counterclockwise on the page.

    Raises
    ------
    ValueError
        For a latitude outside [-90, 90] or a number that is not finite.

    Examples
    --------
    >>> View(0, 90).matrix.tolist()
    [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """

    lon: float
    lat: float
    roll: float = 0.0

    def __post_init__(self) -> None:
        as_lonlat((self.lon, self.lat), "(lon, lat)")
        as_scalar(self.roll, "roll")

    @property
    def matrix(self) -> FloatArray:
        """Rows right, up, toward the viewer: unit vectors, a rotation matrix (3, 3)."""
        toward = lonlat_to_xyz((self.lon, self.lat))
        right = lonlat_to_xyz((self.lon + 90.0, 0.0))
        north = (self.lon + 180.0, 90.0 - self.lat) if self.lat >= 0 else (self.lon, 90.0 + self.lat)
        up = lonlat_to_xyz(north)
        cos, sin, _ = lonlat_to_xyz((self.roll, 0.0))
        # + 0.0 turns −0 into 0, so that symmetric views give identical files.
        return np.array([cos * right - sin * up, sin * right + cos * up, toward]) + 0.0

    def axes(self, xyz: npt.ArrayLike) -> FloatArray:
        """Vectors (..., 3) in view axes (right, up, toward the viewer)."""
        return turned(as_vectors(xyz, 3, "xyz"), self.matrix)

    def project(self, xyz: npt.ArrayLike) -> FloatArray:
        """Page coordinates (right, up) of points (..., 3), in their unit, (..., 2)."""
        return self.axes(xyz)[..., :2]

    def depth(self, xyz: npt.ArrayLike) -> FloatArray:
        """Height of points (..., 3) toward the viewer, (...); on a sphere about the origin ≥ 0 is the near side."""
        return self.axes(xyz)[..., 2]


def turned(vectors: FloatArray, matrix: FloatArray) -> FloatArray:
    """Apply the rows of a matrix (3, 3) to vectors (..., 3).

    Written out, because a matrix product may fuse or reorder its sums from one machine to the next.
    """
    x, y, z = vectors[..., :1], vectors[..., 1:2], vectors[..., 2:]
    return x * matrix[:, 0] + y * matrix[:, 1] + z * matrix[:, 2]
