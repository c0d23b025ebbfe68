"""
Claim P22: terrain as a triangulated irregular network
======================================================

A relief stored as 400 points with heights. They were selected in rounds from a grid of 145 by 97, where the error of
the network was largest, so that they are dense where the terrain is rough. Left, the map: the facets of the Delaunay
triangulation lit from the upper left, its edges, and contours of the function that is linear on each triangle, 125 m
apart. Right, the same facets in space, heights exaggerated six times.

No depth buffer is used. The facets are painted from back to front in the order of the circumcentres of
their triangles along the line of sight: across an edge the circumcentre of the Delaunay triangle in front is never
behind that of the other. So a Delaunay network can be painted from every side, whatever its heights.

Chosen by us: the relief, a formula rather than a real place, the number of points, and the view.
"""

import numpy as np
from _terrain import add_facets, add_key, brightness, contour_style, keep_points, relief, tint

from stereodel import PlanarDelaunay
from stereodel.drawing import LineStyle, Page, Sketch
from stereodel.drawing.page.style import PRINT_WIDTH
from stereodel.interpolation import contours
from stereodel.render import Figure

WIDTH, HEIGHT, COLUMNS, ROWS = 3.0, 2.0, 145, 97
POINTS, SEED, WAVELENGTH = 400, 19, 1.6
STEP = 0.125  # between contours
KM, METRES = 20.0, 1000.0  # a unit of the map, and one of height
STEEP = 0.3
"""Units of the map for a unit of height, in the light and in space."""

LIGHT = np.array([-1.0, 1.0, 1.1]) / np.sqrt(3.21)
AZIMUTH, ELEVATION = 24.0, 27.0  # degrees: where the viewer stands, from the south to the east, and how high
BASE = -0.75  # height of the foot of the block
SCALE, MAP, BLOCK = 2.55, (4.05, 3.65), (12.75, 3.6)  # cm for a unit of the map; the middles of both panels
EXTENT = (0.0, 17.0, 0.0, 6.3)
KEY, BAR, WORDS = (0.25, 0.52), np.array([6.0, 1.5]), (12.75, 0.63)
WALLS = (0.86, 0.83, 0.79, 1.0), (0.75, 0.71, 0.67, 1.0)


def geometry() -> dict:
    """The points that are kept, their heights, the triangles and the pieces of the contours."""
    rng = np.random.default_rng(SEED)
    x, y = np.meshgrid(np.linspace(0, WIDTH, COLUMNS), np.linspace(0, HEIGHT, ROWS))
    inside = (x > 0) & (x < WIDTH) & (y > 0) & (y < HEIGHT)
    plane = np.column_stack([x.ravel(), y.ravel()])
    plane += inside.reshape(-1, 1) * rng.uniform(-0.008, 0.008, plane.shape) - [WIDTH / 2, HEIGHT / 2]
    heights = relief(np.column_stack([plane, np.zeros(len(plane))]), WAVELENGTH, SEED)
    row, column = np.divmod(np.arange(len(plane)), COLUMNS)
    posts = np.isin(row, (0, ROWS - 1)) & (column % 12 == 0) | np.isin(column, (0, COLUMNS - 1)) & (row % 12 == 0)
    kept = keep_points(PlanarDelaunay, plane, heights, np.flatnonzero(posts), POINTS)
    network = PlanarDelaunay(plane[kept])
    levels = np.arange(np.ceil(heights.min() / STEP), heights.max() / STEP) * STEP
    lines = contours(network, heights[kept], levels.round(6))
    return {
        "points": plane[kept],
        "heights": heights[kept],
        "triangles": network.simplices,
        "order": np.argsort(network.circumcenters @ toward()[:2], kind="stable"),
        "levels": np.array([line.level for line in lines]),
        "sizes": np.array([len(line.points) for line in lines]),
        "contours": np.concatenate([line.points for line in lines]),
    }


def toward() -> np.ndarray:
    """Unit vector to the viewer of the block."""
    azimuth, elevation = np.radians([AZIMUTH, ELEVATION])
    return np.array([np.cos(elevation) * np.sin(azimuth), -np.cos(elevation) * np.cos(azimuth), np.sin(elevation)])


def block_place(points: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """Where points of the map with heights lie on the page, seen by the viewer."""
    azimuth, elevation = np.radians([AZIMUTH, ELEVATION])
    right = points @ [np.cos(azimuth), np.sin(azimuth)]
    back = points @ [-np.sin(azimuth), np.cos(azimuth)]
    up = np.sin(elevation) * back + np.cos(elevation) * STEEP * heights
    return np.array(BLOCK) + 0.88 * SCALE * np.stack([right, up], axis=-1)


def map_place(points: np.ndarray) -> np.ndarray:
    """Where points lie on the map."""
    return np.array(MAP) + SCALE * points


def draw(g: dict) -> Page:
    """The map and the block."""
    sketch = Sketch()
    light = brightness(np.column_stack([g["points"], STEEP * g["heights"]])[g["triangles"]], LIGHT)
    on_map, on_block = map_place(g["points"]), block_place(g["points"], g["heights"])
    add_facets(sketch, g, on_map, light)
    for points, level in zip(np.split(g["contours"], np.cumsum(g["sizes"])[:-1]), g["levels"], strict=True):
        sketch.add_polyline(map_place(points), name="contour", style=contour_style(level))
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [WIDTH / 2, HEIGHT / 2]
    sketch.add_polyline(map_place(corners), closed=True, name="frame")
    add_facets(sketch, g, on_block, light)
    add_walls(sketch, g)
    add_key(sketch, KEY, (-0.25, 1.9), (0.0, 0.5, 1.0, 1.5), METRES, "m above the sea")
    halo = {"halo": 1.5, "halo_color": tint(-0.12, 1.0)}
    sketch.add_dimension(BAR, BAR + [SCALE / 2, 0.0], f"{KM / 2:g} km", name="frame", **halo)
    sketch.add_label(WORDS, f"heights exaggerated {1000 * KM * STEEP / METRES:g} times")
    return sketch.page(EXTENT, width=PRINT_WIDTH)


def add_walls(sketch: Sketch, g: dict) -> None:
    """The two sides of the block that face the viewer, in front of everything."""
    for axis, side in ((0, -1 if AZIMUTH < 0 else 1), (1, -1)):
        half = (WIDTH, HEIGHT)[axis] / 2
        on_side = np.flatnonzero(g["points"][:, axis] == side * half)
        on_side = on_side[np.argsort(g["points"][on_side, 1 - axis])]
        points, heights = g["points"][on_side], g["heights"][on_side]
        foot = block_place(points[[-1, 0]], np.full(2, BASE))
        outline = np.concatenate([block_place(points, heights), foot])
        sketch.add_polygon(outline, name="wall", color=WALLS[axis])
        sketch.add_polyline(outline, closed=True, name="wall", style=LineStyle((0.2, 0.18, 0.16, 1.0), 0.5))


FIGURE = Figure("claim_terrain", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
