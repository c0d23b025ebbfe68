"""
Figure 2: Delaunay triangulation and Voronoi diagram in the plane
=================================================================

The Delaunay triangulation (gray) of 60 sites in a rectangle and its dual Voronoi diagram (black). Each Voronoi vertex
is the circumcentre of a Delaunay triangle and each Voronoi edge lies on the perpendicular bisector of a Delaunay
edge, so either can be constructed from the other in linear time.

Chosen by us: the number of sites, their seed, the oval on which those of the hull lie, and the frame, which clips the
unbounded Voronoi edges.
"""

from _legend import PAGE_WIDTH, with_graphs
from _sites import in_rectangle

from stereodel import PlanarDelaunay, PlanarVoronoi
from stereodel.drawing import Page, Sketch
from stereodel.render import Figure

SITES, HULL, SEED = 60, 25, 39
WIDTH, HEIGHT, MARGIN = 3.0, 2.0, 0.08
FRAME = (-WIDTH / 2, -HEIGHT / 2, WIDTH / 2, HEIGHT / 2)


def geometry() -> dict:
    """Sites, Delaunay edges, and the Voronoi edges as the frame cuts them."""
    sites = in_rectangle(SITES, HULL, WIDTH, HEIGHT, SEED, margin=MARGIN)
    delaunay = PlanarDelaunay(sites)
    ridges, _ = PlanarVoronoi(delaunay).segments(FRAME)
    return {"sites": sites, "edges": delaunay.edges, "ridges": ridges}


def draw(g: dict) -> Page:
    """Delaunay below, Voronoi above, sites on top."""
    left, bottom, right, top = FRAME
    sketch = Sketch().add_edges(g["sites"], g["edges"], name="delaunay").add_segments(g["ridges"], name="voronoi")
    sketch.add_points(g["sites"], name="sites")
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    sketch.add_polyline(corners, closed=True, name="frame")
    return with_graphs(sketch.page((left - 0.02, right + 0.02, bottom - 0.02, top + 0.02), width=PAGE_WIDTH))


FIGURE = Figure("fig02_plane", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
