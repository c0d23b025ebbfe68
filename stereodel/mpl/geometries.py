"""User geometries as matplotlib paths in degrees."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.path import Path

from stereodel._arrays import FloatArray
from stereodel.io.reading import shapes_of
from stereodel.mpl.transforms import compounds


def paths_of(geometries: Any) -> tuple[list[Path], FloatArray]:
    """A path for each polygon and line in the order of their features, rings closed; and all points, (n, 2).

    `geometries` is any source for `stereodel.io.reading.shapes_of`.
    """
    shapes = shapes_of(geometries)
    polygons = compounds(shapes.rings, shapes.ring_polygon, len(shapes.polygon_feature), closed=True)
    lines = compounds(shapes.lines, np.arange(len(shapes.lines)), len(shapes.lines), closed=False)
    order = np.argsort(np.concatenate([shapes.polygon_feature, shapes.line_feature]), kind="stable")
    paths = polygons + lines
    return [paths[k] for k in order.tolist()], shapes.points
