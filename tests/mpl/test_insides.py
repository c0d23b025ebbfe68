"""Which side of a ring is its inside: places asked one by one, on the map, against Shapely."""

import numpy as np
import pytest
import shapely
from matplotlib.path import Path

from stereodel import MoebiusMap, great_circle_points, lonlat_to_xyz, xyz_to_lonlat
from stereodel.curves.ragged import Ragged
from stereodel.drawing.view import View
from stereodel.mpl.insides import on_the_left
from stereodel.mpl.transforms import LonLatToPage


def followed(ring, straight):
    if straight:
        return ring
    arcs = [
        xyz_to_lonlat(great_circle_points(a, b, 300))
        for a, b in zip(*(lonlat_to_xyz(p) for p in (ring[:-1], ring[1:])), strict=True)
    ]
    line = np.concatenate(arcs)
    return np.column_stack([np.unwrap(line[:, 0], period=360), line[:, 1]])


@pytest.mark.parametrize("straight", [True, False])
def test_places_are_inside_where_they_are_on_the_map(straight):
    """Triangles with long oblique edges, in both directions, far north, where great circles bulge."""
    rng = np.random.default_rng(7)
    for _ in range(60):
        ring = np.column_stack([rng.uniform(-60, 60, 3), rng.uniform(20, 75, 3)])
        ring = np.vstack([ring, ring[:1]])
        shape = shapely.Polygon(followed(ring, straight))
        for spot in np.column_stack([rng.uniform(-60, 60, 8), rng.uniform(20, 80, 8)]):
            if shape.exterior.distance(shapely.Point(spot)) < 0.5:
                continue
            _, held = on_the_left(Ragged.of([ring]), np.zeros(1, dtype=int), 1, spot, straight=straight)
            assert held.tolist() == [shape.contains(shapely.Point(spot))], (ring, spot)


def test_a_great_circle_beyond_the_third_corner():
    """On the map its chord runs south of the corner, the great circle north of it: the other way round."""
    ring = np.array([(-60, 60), (60, 60), (0, 70), (-60, 60)], dtype=float)
    path = LonLatToPage(MoebiusMap.identity(), View(0, 72)).transform_path(Path(ring, closed=True))
    x, y = path.vertices.T
    assert 0.001 < np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) / 2 < 0.2
