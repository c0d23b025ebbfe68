"""What the azimuthal projections share: a centre, its axes, the radius of the sphere."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from functools import cached_property

import numpy as np

from stereodel._arrays import FloatArray, as_direction_or_lonlat, as_scalar
from stereodel._double_double import DoubleDouble, unit
from stereodel.sphere.frames import tangent_frame
from stereodel.sphere.quaternions import transform


@dataclass(frozen=True)
class TangentPlane:
    """A projection to a plane that touches a sphere, with axes (east, north) at the point of tangency.

    center: (float, float), (lon, lat) in degrees of the point of tangency. At a pole the axes are the limit along
        `lon`: at the north pole north points toward lon + 180°, at the south pole toward lon. A direction (x, y, z) is
        accepted too, with lon 0 at the poles.
    radius: radius R of the sphere, in the unit of the plane. Points of the sphere are directions whatever R is.
    """

    center: tuple[float, ...]
    _: KW_ONLY
    radius: float = 1.0

    def __post_init__(self) -> None:
        center = as_direction_or_lonlat(self.center, "center")
        object.__setattr__(self, "center", tuple(center.tolist()))
        object.__setattr__(self, "radius", as_scalar(self.radius, "radius", low=0.0, open_low=True))

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


def nan_where(outside: np.ndarray[tuple[int, ...], np.dtype[np.bool_]], values: FloatArray) -> FloatArray:
    """NaN in the rows outside the domain of a map."""
    return np.where(outside if values.ndim == outside.ndim else outside[..., None], np.nan, values)
