"""
Claim P22: a planet as a triangulated irregular network
=======================================================

A network on the sphere: 450 points of a planet of radius 3000 km with heights. Left, the Delaunay triangulation, with
tints, edges and contours, 2 km apart, on the sphere; all lines are arcs of great circles. Right, the planet rotated,
with its facets in space and heights exaggerated 60 times. Light comes from the upper left, wherever one stands.

The facets are painted from back to front in the order of n·v / d, where v is the direction to the viewer and n·x = d
the plane of the facet of the convex hull, before any point was raised. From a facet to the one in front of it across an
edge this value grows, because the hull is convex and contains the centre, and raising points along their rays does not
change which facet is in front.

Chosen by us: the relief, a formula rather than a real planet, the number of points, and the views.
"""

import numpy as np
from _terrain import EDGE, add_facets, add_key, brightness, contour_style, cut_at_sea, keep_points, relief, tint

from stereodel import SphericalDelaunay
from stereodel.drawing import CircleArc, Page, Scene, Sketch, View
from stereodel.drawing.page.style import PRINT_WIDTH
from stereodel.interpolation import contours
from stereodel.render import Figure

POINTS, FIRST, CANDIDATES = 450, 120, 9000
SEED, WAVELENGTH = 11, 1.3
STEP = 0.4  # between contours
STEEP = 0.1
"""Radii for a unit of height."""
RADIUS_KM, KM = 3000.0, 5.0  # and km for that unit

VIEW, SIDEWAYS = View(35, 20), View(75, -12)
LIGHT = np.array([-1.0, 1.0, 1.4]) / np.sqrt(3.96)  # on the whole of the body in space: right, up, toward the viewer
RADIUS, PLACES = 3.75, np.array([[3.95, 5.05], [12.75, 5.05]])  # of the globes on the page, and their middles, cm
EXTENT, KEY, WORDS = (0.0, 17.0, 0.0, 9.15), (1.4, 0.55), (12.75, 0.62)


def geometry() -> dict:
    """The points that are kept, their heights, the facets from back to front, and the contours."""
    directions = np.concatenate([spiral(FIRST), spiral(CANDIDATES)])
    heights = relief(directions, WAVELENGTH, SEED)
    kept = keep_points(SphericalDelaunay, directions, heights, np.arange(FIRST), POINTS)
    points, network = directions[kept], SphericalDelaunay(directions[kept])
    levels = np.arange(np.ceil(heights.min() / STEP), heights.max() / STEP) * STEP
    lines = contours(network, heights[kept], levels)
    normals = network.circumcenters
    offsets = np.einsum("ij,ij->i", normals, points[network.simplices[:, 0]])
    return {
        "points": points,
        "heights": heights[kept],
        "triangles": network.simplices,
        "middles": normals,
        "edges": network.edges,
        "order": np.argsort(normals @ SIDEWAYS.matrix[2] / offsets, kind="stable"),
        "levels": np.array([line.level for line in lines]),
        "sizes": np.array([len(line.points) for line in lines]),
        "contours": np.concatenate([line.points for line in lines]),
    }


def spiral(count: int) -> np.ndarray:
    """Evenly spread directions (count, 3): each has the same area between its parallels and those of the next."""
    turn = np.arange(count)
    z, lon = 1 - (2 * turn + 1) / count, turn * np.pi * (3 - np.sqrt(5))
    reach = np.sqrt(1 - z * z)
    return np.column_stack([reach * np.cos(lon), reach * np.sin(lon), z])


def draw(g: dict) -> Page:
    """The network on the sphere and its facets in space."""
    at = tuple(PLACES[0].tolist())
    sketch = Sketch().add_items(globe(g).layout(VIEW, at=at, scale=RADIUS))
    lamps = (local_light(g["middles"], SIDEWAYS) + SIDEWAYS.matrix.T @ LIGHT) / 2  # relief, and that it is round
    light = brightness(raised(g)[g["triangles"]], lamps)
    add_facets(sketch, g, PLACES[1] + RADIUS * SIDEWAYS.project(raised(g)), light)
    add_key(sketch, KEY, (-0.5, 1.8), (-0.4, 0.0, 0.4, 0.8, 1.2, 1.6), KM, "km")
    sketch.add_label(WORDS, f"heights exaggerated {STEEP * RADIUS_KM / KM:g} times")
    return sketch.page(EXTENT, width=PRINT_WIDTH)


def raised(g: dict) -> np.ndarray:
    """The points in space."""
    return g["points"] * (1 + STEEP * g["heights"][:, None])


def globe(g: dict) -> Scene:
    """Tints, edges and contours on the side of the sphere that is seen."""
    scene, points, toward = Scene(), g["points"], VIEW.matrix[2]
    light = brightness(raised(g)[g["triangles"]], local_light(g["middles"], VIEW))
    for facet, triangle in enumerate(g["triangles"]):
        if (points[triangle] @ toward > 0).any():
            for polygon, height in cut_at_sea(points[triangle], g["heights"][triangle]):
                sides = [CircleArc.great(a, b) for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True)]
                scene.add_region(sides, name="facet", color=tint(height, light[facet]))
    near = (points @ toward)[g["edges"]].max(axis=1) > 0
    scene.add_edges(points, g["edges"][near], name="delaunay", style=EDGE)
    for line, level in zip(np.split(g["contours"], np.cumsum(g["sizes"])[:-1]), g["levels"], strict=True):
        pairs = np.column_stack([np.arange(len(line) - 1), np.arange(1, len(line))])
        pairs = pairs[(line @ toward)[pairs].max(axis=1) > 0]
        scene.add_edges(line, pairs, name="contour", style=contour_style(level))
    return scene


def local_light(up: np.ndarray, view: View) -> np.ndarray:
    """Light from the upper left of the page as it falls at points (m, 3) of a map wrapped round the ball."""
    right, top, _ = view.matrix
    along = (top - right) - (up @ (top - right))[:, None] * up
    light = along / np.linalg.norm(along, axis=1, keepdims=True) + up
    return light / np.linalg.norm(light, axis=1, keepdims=True)


FIGURE = Figure("claim_planet", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
