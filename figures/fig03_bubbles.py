"""
Figure 3: Every circle on a sphere bounds two bubbles
=====================================================

Any circle is where a plane slices through the sphere. It bounds a smaller bubble (orange) and a larger one (blue).
The Delaunay condition on the sphere is that one of them is empty: the one on the outer side of the facet.

Chosen by us: a circle of angular radius 42° about (30° E, 32° N).
"""

import numpy as np

from stereodel import SphereCircle, lonlat_to_xyz
from stereodel.drawing import Page, Scene, View
from stereodel.render import Figure

CENTER, RADIUS = (30.0, 32.0), 42.0  # degrees
VIEW = View(12, 14)
BELOW = (2.0, -38.0)  # where the large bubble is labelled


def geometry() -> dict:
    """The circle: normal and offset."""
    circle = SphereCircle.around(CENTER, RADIUS)
    return {"normal": circle.normal, "offset": np.array(circle.offset), "below": lonlat_to_xyz(BELOW)}


def draw(g: dict) -> Page:
    """The two tints, the circle between them, their names."""
    circle = SphereCircle(g["normal"], float(g["offset"]))
    scene = Scene()
    scene.add_cap(circle, side="outside", name="large_bubble")
    scene.add_cap(circle, side="inside", name="small_bubble")
    scene.add_circles([circle], name="circle")
    scene.add_label(circle.center, "small bubble", size=12.0)
    scene.add_label(g["below"], "large bubble", size=12.0)
    return scene.page(VIEW, extent=(-1.03, 1.03, -1.03, 1.03), width=260.0)


FIGURE = Figure("fig03_bubbles", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
