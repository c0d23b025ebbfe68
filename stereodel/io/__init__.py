"""Files and neighbours: tables of points in; GeoPandas, GeoJSON, UGRID, meshes and pictures out.

Every other library is imported when a function needs it; the extras ``geo``, ``grid`` and ``mesh`` bring them.
"""

from stereodel.io.frames import to_geodataframe
from stereodel.io.reading import from_geodataframe, read_points
from stereodel.io.tables import PointTable

__all__ = ["PointTable", "from_geodataframe", "read_points", "to_geodataframe"]
