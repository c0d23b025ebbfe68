"""Input and output: tables of points in; GeoPandas, GeoJSON, UGRID, grids and meshes out.

Other libraries are imported only when a function needs them; the extras ``draw``, ``geo``, ``grid`` and ``mesh``
install them.
"""

from stereodel.io.formats.geojson import to_geojson
from stereodel.io.formats.names import DataWarning, RenamedColumnWarning
from stereodel.io.grids import Grid
from stereodel.io.inspection import Inspection
from stereodel.io.maps.warping import warp
from stereodel.io.meshes import from_ugrid, to_polydata, to_trimesh, to_ugrid
from stereodel.io.nearest_shapes import nearest_shapes
from stereodel.io.reading import inspect, read_points
from stereodel.io.rows_of import to_geodataframe
from stereodel.io.table import PointTable
from stereodel.io.writing import write

__all__ = [
    "DataWarning",
    "Grid",
    "Inspection",
    "PointTable",
    "RenamedColumnWarning",
    "from_ugrid",
    "inspect",
    "nearest_shapes",
    "read_points",
    "to_geodataframe",
    "to_geojson",
    "to_polydata",
    "to_trimesh",
    "to_ugrid",
    "warp",
    "write",
]
