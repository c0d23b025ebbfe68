"""
Figure 7: Rectangular region prior to inverse stereographic projection to hemisphere
====================================================================================

A rectangular map with its sites, Delaunay triangulation (gray) and Voronoi diagram (black). The blue circle is the
footprint of the sphere that will be attached at the centre: its diameter is half the diagonal of the rectangle.

Chosen by us: sides 3 : 2, the number of sites and their seed.
"""

import numpy as np
from _rectangle import CORNERS, HEIGHT, WIDTH, lift, sites

from stereodel import PlanarDelaunay, PlanarVoronoi
from stereodel.drawing import Page, Sketch
from stereodel.render import Figure

MARGIN = 0.05


def geometry() -> dict:
    """Sites, Delaunay edges, Voronoi edges inside the rectangle, and the radius of the tangent sphere."""
    points = sites()
    delaunay = PlanarDelaunay(points)
    ridges, _ = PlanarVoronoi(delaunay).segments((-WIDTH / 2, -HEIGHT / 2, WIDTH / 2, HEIGHT / 2))
    return {"sites": points, "edges": delaunay.edges, "ridges": ridges, "radius": np.array(lift().sphere.radius)}


def draw(g: dict) -> Page:
    """The map, the diagonal and the footprint."""
    sketch = Sketch().add_edges(g["sites"], g["edges"], name="delaunay").add_segments(g["ridges"], name="voronoi")
    sketch.add_circle((0, 0), float(g["radius"]), name="footprint")
    sketch.add_points(g["sites"], name="sites")
    sketch.add_polyline(CORNERS, closed=True, name="outline")
    half = np.array([WIDTH, HEIGHT]) / 2 + MARGIN
    return sketch.page((-half[0], half[0], -half[1], half[1]))


FIGURE = Figure("fig07_rectangle", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
