r"""
Claim P22: the least angles of Delaunay's triangles and of others
=================================================================

The points of the terrain and their heights, with three triangulations: that of Delaunay; that of Delaunay after the map
was stretched to twice its width, as longitudes and latitudes are at 60° N; and one that sweeps over the map and joins
each point to those on its left. Narrow triangles join heights that are far apart, and the relief is torn. Below, the
share of triangles that have an angle smaller than a given one. No triangulation of the points has a larger least angle
than that of Delaunay.

Chosen by us: the relief, and the other triangulations.
"""

import numpy as np
from _chart import Chart, fraction
from _terrain import add_facets, brightness
from claim_terrain import HEIGHT, LIGHT, STEEP
from claim_terrain import geometry as terrain

from stereodel import PlanarDelaunay, orient2d
from stereodel.drawing import LineStyle, Page, Sketch
from stereodel.drawing.page.style import BLUE, DARK_GRAY, PRINT_WIDTH, VERMILION
from stereodel.render import Figure

NARROW = 10  # degrees
STRETCH = np.array([2.0, 1.0])
COLORS = {"Delaunay": BLUE, "stretched": DARK_GRAY, "sweep": VERMILION}
SCALE, FIRST, PITCH = 1.8, np.array([2.8, 8.05]), 5.7  # cm for a unit of the map; the first one, and to the next
CHART = Chart((1.35, 1.1), (15.0, 3.8), (0.0, 60.0), (0.0, 1.0))
EXTENT = (0.0, 17.0, 0.0, 9.95)


def geometry() -> dict:
    """Points, heights, and of each triangulation the triangles and their least angles in order, degrees."""
    g = terrain()
    points = g["points"]
    found = {"points": points, "heights": g["heights"]}
    triangles = (g["triangles"], PlanarDelaunay(STRETCH * points).simplices, swept(points))
    for name, corners in zip(COLORS, triangles, strict=True):
        found |= {f"{name}_triangles": corners, f"{name}_angles": np.sort(least_angles(points[corners]))}
    return found


def swept(points: np.ndarray) -> np.ndarray:
    """Triangles (m, 3): from left to right each point is joined to the edges of the hull so far that it sees."""
    found = []
    for side in (1, -1):
        chain: list[int] = []
        for point in np.lexsort(points.T[::-1]).tolist():
            while len(chain) > 1 and side * orient2d(*points[[*chain[-2:], point]]) < 0:
                found.append([*chain[-2:], point][::-side])
                chain.pop()
            chain.append(point)
    return np.array(found)


def least_angles(corners: np.ndarray) -> np.ndarray:
    """The least angle of each triangle (m, 3, 2) in degrees."""
    ahead = np.roll(corners, -1, axis=1) - corners
    unit = ahead / np.linalg.norm(ahead, axis=2, keepdims=True)
    return np.degrees(np.arccos((-unit * np.roll(unit, 1, axis=1)).sum(axis=2)).min(axis=1))


def draw(g: dict) -> Page:
    """Three maps over a chart."""
    sketch = Sketch()
    for number, (name, color) in enumerate(COLORS.items()):
        triangles, angles = g[f"{name}_triangles"], g[f"{name}_angles"]
        middle = FIRST + [PITCH * number, 0.0]
        add_map(sketch, g, triangles, middle)
        foot = middle - [0.0, SCALE * HEIGHT / 2]
        sketch.add_label(foot, name, (0, -4), valign="top", size=10.0, color=color)
        narrow = f"{np.count_nonzero(angles < NARROW)} of {len(angles)} with an angle below ${NARROW}°$"
        sketch.add_label(foot, narrow, (0, -18), valign="top")
        share = np.arange(1, len(angles) + 1) / len(angles)
        sketch.add_polyline(CHART.place(np.column_stack([angles, share])), name=name, style=LineStyle(color, 1.3))
    CHART.add_frame(sketch)
    CHART.add_x_ticks(sketch, {x: f"${x}°$" for x in range(0, 61, 10)}, "least angle of a triangle")
    CHART.add_y_ticks(sketch, {x: fraction(x) for x in (0, 0.5, 1)}, "share of triangles")
    return sketch.page(EXTENT, width=PRINT_WIDTH)


def add_map(sketch: Sketch, g: dict, triangles: np.ndarray, middle: np.ndarray) -> None:
    """The facets of one triangulation in the light of the terrain."""
    space = np.column_stack([g["points"], STEEP * g["heights"]])[triangles]
    facets = {"heights": g["heights"], "triangles": triangles, "order": range(len(triangles))}
    add_facets(sketch, facets, middle + SCALE * g["points"], brightness(space, LIGHT))


FIGURE = Figure("claim_angles", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
