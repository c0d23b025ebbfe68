"""The Earth's size: radii of WGS84 in kilometres, for areas and distances.

On a sphere of radius r an angle of δ radians is r·δ long and a cell of Ω steradians has the area r²·Ω. With
`AUTHALIC_RADIUS_KM` and ``latitude="authalic"``, areas are those of the ellipsoid; `MEAN_RADIUS_KM` suits distances.

Source: National Geospatial-Intelligence Agency, "World Geodetic System 1984", NGA.STND.0036 (2014), for the two
defining numbers; H. Moritz, "Geodetic Reference System 1980", Journal of Geodesy 74 (2000), for the radii derived.

Examples
--------
>>> from stereodel import SphericalVoronoi
>>> diagram = SphericalVoronoi.from_lonlat([(-78.5, -0.2), (10.0, 48.4), (135.8, 35.0)], latitude="authalic")
>>> areas = diagram.areas(radius=AUTHALIC_RADIUS_KM)
>>> print(f"{areas.sum() / 1e6:.3f} million km²")
510.066 million km²
"""

from __future__ import annotations

import math
from typing import Final

EQUATORIAL_RADIUS_KM: Final = 6378.137
"""Semi-major axis a of WGS84, which defines it."""

INVERSE_FLATTENING: Final = 298.257223563
"""1/f of WGS84, which defines it."""

FLATTENING: Final = 1 / INVERSE_FLATTENING
"""f = (a − b)/a."""

POLAR_RADIUS_KM: Final = EQUATORIAL_RADIUS_KM * (1 - FLATTENING)
"""Semi-minor axis b = 6356.7523 km."""

MEAN_RADIUS_KM: Final = (2 * EQUATORIAL_RADIUS_KM + POLAR_RADIUS_KM) / 3
"""(2a + b)/3 = 6371.0088 km, the mean of the three semi-axes."""

_E: Final = math.sqrt(FLATTENING * (2 - FLATTENING))

AUTHALIC_RADIUS_KM: Final = EQUATORIAL_RADIUS_KM * math.sqrt((1 + (1 - _E**2) * math.atanh(_E) / _E) / 2)
"""6371.0072 km: the sphere of this radius has the area of the ellipsoid, 510 065 621.7 km²."""
