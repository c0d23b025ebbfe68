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
    scene = Scene(style="glass")
    scene.add_flat_polygon(vertices, name="chordal")
    scene.add_triangle_patch(*vertices, name="triangle")
    scene.add_segments(vertices, vertices[[1, 2, 0]], name="chord", layer=Layer.LINE)
    scene.add_edges(vertices, sides, name="arc")
    scene.add_points(vertices, name="sites")
    for (name, offset), vertex in zip(NAMES, vertices, strict=True):
        scene.add_label(vertex, name, offset=offset, size=12.0)
    return scene.page(VIEW, extent=(-1.03, 1.03, -1.03, 1.03), width=260.0)


FIGURE = Figure("fig04_triangles", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
