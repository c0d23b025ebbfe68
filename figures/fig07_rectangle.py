"""
Figure 7: Rectangular region prior to inverse stereographic projection to hemisphere
====================================================================================

A rectangular map with its sites, Delaunay triangulation (gray) and Voronoi diagram (black). The dashed circle is the
outline of the sphere that will be attached at the centre, seen from above: its diameter is half the diagonal D of the
rectangle, so that its radius R, from its centre to the dot on its rim, is a quarter of D.

Chosen by us: sides 3 : 2, the number of sites, their seed and the oval on which those of the hull lie.
"""

from dataclasses import replace

import numpy as np
from _legend import PAGE_WIDTH, with_graphs
from _rectangle import CORNERS, HEIGHT, WIDTH, lift, sites

from stereodel import PlanarDelaunay, PlanarVoronoi
from stereodel.drawing import Page, Sketch
from stereodel.drawing.page.style import LINES, VERMILION
from stereodel.render import Figure

MARGIN = 0.05
THIN = {"Delaunay triangulation": LINES["delaunay"].scaled(0.65), "Voronoi diagram": LINES["voronoi"].scaled(0.65)}
DELAUNAY, VORONOI = THIN.values()
DIAGONAL, RADIUS = (replace(LINES["footprint"], dash=None, width=width) for width in (0.8, 1.8))
LETTERS = {"$D$": -0.87, "$R$": 0.39}  # where they stand on the diagonal, as parts of its upper half


def geometry() -> dict:
    """Sites, Delaunay edges, Voronoi edges inside the rectangle, and the radius of the tangent sphere."""
    points = sites()
    delaunay = PlanarDelaunay(points)
    ridges, _ = PlanarVoronoi(delaunay).segments((-WIDTH / 2, -HEIGHT / 2, WIDTH / 2, HEIGHT / 2))
    return {"sites": points, "edges": delaunay.edges, "ridges": ridges, "radius": np.array(lift().sphere.radius)}


def draw(g: dict) -> Page:
    """The map, the diagonal and the footprint."""
    sketch = Sketch().add_edges(g["sites"], g["edges"], name="delaunay", style=DELAUNAY)
    sketch.add_segments(g["ridges"], name="voronoi", style=VORONOI)
    sketch.add_points(g["sites"], name="sites")
    sketch.add_polyline(CORNERS, closed=True, name="outline")
    sketch.add_circle((0, 0), float(g["radius"]), name="footprint")
    sketch.add_dimension(-CORNERS[2], CORNERS[2], "", name="diagonal", style=DIAGONAL)
    sketch.add_segment((0, 0), CORNERS[2] / 2, name="diagonal", style=RADIUS)
    sketch.add_points([(0, 0), CORNERS[2] / 2], name="points")
    for text, place in LETTERS.items():
        sketch.add_label(place * CORNERS[2], text, (-2, 3), valign="bottom", color=VERMILION, halo=1.5)
    half = np.array([WIDTH, HEIGHT]) / 2 + MARGIN
    page = sketch.page((-half[0], half[0], -half[1], half[1]), width=PAGE_WIDTH)
    return with_graphs(page, THIN | {"sphere of radius $R = D/4$": LINES["footprint"], "diagonal $D$": DIAGONAL})


FIGURE = Figure("fig07_rectangle", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
