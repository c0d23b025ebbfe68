"""
Figure 4: A spherical triangle and its chordal plane triangle
=============================================================

The sides of a spherical triangle are arcs of great circles (blue). The plane triangle below it has the same vertices
and chords for sides (red): a facet of the convex hull. The Delaunay triangulation of points on the sphere is
the convex hull of the points.

Chosen by us: the three vertices and the view.
"""

import numpy as np

from stereodel import lonlat_to_xyz
from stereodel.drawing import Layer, Page, Scene, View
from stereodel.render import Figure

VERTICES = np.array([[-42.0, -18.0], [48.0, -12.0], [4.0, 58.0]])  # degrees
VIEW = View(26, 12)
NAMES = (("$a$", (-8, -6)), ("$b$", (9, -5)), ("$c$", (3, 9)))


def geometry() -> dict:
    """Three points of the sphere, counterclockwise."""
    return {"vertices": lonlat_to_xyz(VERTICES)}


def draw(g: dict) -> Page:
    """The chordal triangle inside a glass ball, the spherical one on it."""
    vertices, sides = g["vertices"], np.array([[0, 1], [1, 2], [2, 0]])
    scene = Scene(look="glass")
    scene.add_flat_polygon(vertices, role="chordal")
    scene.add_triangle_patch(*vertices, role="triangle")
    scene.add_segments(vertices, vertices[[1, 2, 0]], role="chord", layer=Layer.LINE)
    scene.add_edges(vertices, sides, role="arc")
    scene.add_points(vertices, role="sites")
    for (name, offset), vertex in zip(NAMES, vertices, strict=True):
        scene.add_label(name, vertex, offset=offset, size=12.0)
    return Page((-1.03, 1.03, -1.03, 1.03), scene.layout(VIEW), width=260.0, views=(VIEW.matrix,))


FIGURE = Figure("fig04_triangles", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
