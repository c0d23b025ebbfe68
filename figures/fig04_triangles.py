"""
Figure 4: A spherical triangle and its chordal plane triangle
=============================================================

The sides of a spherical triangle are arcs of great circles (blue), each in a plane through the centre O of the sphere.
The plane triangle below it (hatched) has the same vertices and chords as sides (red): a facet of the convex hull. The
Delaunay triangulation of points on the sphere is the convex hull of the points.

Chosen by us: the three vertices and the view.
"""

import numpy as np

from stereodel import lonlat_to_xyz
from stereodel.drawing import Layer, LineStyle, Page, Scene, Sketch, Solid, View
from stereodel.drawing.page.style import BLACK, LINES, MAP_LINES, VERMILION
from stereodel.render import Figure
from stereodel.sphere import graticule

VERTICES = np.array([[-28.0, -18.0], [56.0, -12.0], [10.0, 60.0]])  # degrees
VIEW = View(26, 12)
NAMES = (("$a$", (-9, -4), 0.0), ("$b$", (9, -5), 0.0), ("$c$", (3, 9), 0.0), ("$O$", (-9, 7), 1.0))
SPACING = 30  # degrees
GRATICULE = MAP_LINES["graticule"].scaled(1.3)  # darker than usual: it is seen through the ball
RADIUS = LineStyle(BLACK, 0.9, LINES["construction"].dash)  # seen through the triangle
HATCH, LINES_OF_HATCH = LineStyle(VERMILION, 0.4), 24
HALO = (0.80, 0.90, 0.96, 1.0)  # as the triangle on the ball


def geometry() -> dict:
    """Three points of the sphere, counterclockwise."""
    return {"vertices": lonlat_to_xyz(VERTICES)}


def scene(g: dict) -> Scene:
    """The chordal triangle inside a glass ball, the spherical one on it."""
    vertices, sides = g["vertices"], np.array([[0, 1], [1, 2], [2, 0]])
    a, b, c = vertices
    steps = np.linspace(0, 1, LINES_OF_HATCH + 2)[1:-1, None]
    scene = Scene(style="glass")
    scene.add_arcs(graticule(SPACING), name="graticule", style=GRATICULE)
    scene.add_segments(np.zeros(3), vertices, name="radius", style=RADIUS)
    scene.add_segments(a + steps * (c - a), b + steps * (c - b), name="hatch", style=HATCH)
    scene.add_patch(vertices, name="triangle")
    scene.add_segments(vertices, vertices[[1, 2, 0]], name="chord", layer=Layer.LINE)
    scene.add_edges(vertices, sides, name="arc")
    scene.add_points(vertices, name="sites")
    scene.add_space_points(np.zeros((1, 3)), name="vertices")
    return scene


def draw(g: dict) -> Page:
    """All of it, with the names of the points."""
    sketch, vertices = Sketch().add_scene(scene(g), VIEW), g["vertices"]
    for (name, offset, halo), place in zip(NAMES, VIEW.project([*vertices, np.zeros(3)]), strict=True):
        sketch.add_label(place, name, offset, halo=halo, halo_color=HALO)
    return sketch.page((-1.03, 1.03, -1.03, 1.03), width=260.0)


def solid(g: dict) -> Solid:
    """All of it in space."""
    return Solid(draw(g), [scene(g).placed(VIEW)])


FIGURE = Figure("fig04_triangles", geometry, draw, in_space=solid)

if __name__ == "__main__":
    FIGURE.main()
