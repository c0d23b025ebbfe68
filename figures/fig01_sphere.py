"""
Figure 1: Delaunay triangulation and its dual Voronoi diagram on a sphere
=========================================================================

The Delaunay triangulation (gray) of 60 sites, whose edges are arcs of great circles, and the Voronoi diagram (black).
Each Voronoi edge lies on the perpendicular bisector of a Delaunay edge; each Voronoi vertex is the centre of an empty
bubble. One is marked: the bubble (orange) of a triangle (heavy gray) has the three vertices on its rim, no site inside,
and a Voronoi vertex (red) at its centre.

Chosen by us: the number of sites, their seed, the view and the triangle.
"""

import numpy as np
from _legend import PAGE_WIDTH, with_graphs
from _sites import on_sphere

from stereodel import SphereCircle, SphericalDelaunay, SphericalVoronoi, lonlat_to_xyz
from stereodel.drawing import LineStyle, Page, Scene, Solid, View
from stereodel.drawing.page.style import DOTS, FILLS, GRAY, LINES
from stereodel.render import Figure

SITES, SEED = 60, 52
VIEW = View(55, 30)
MARKED = (63.8, 39.7)  # degrees: a point of the triangle that is marked
HEAVY = LineStyle(GRAY, 2.0)


def geometry() -> dict:
    """Sites, Delaunay edges, Voronoi vertices and ridges, one triangle and its circumcircle."""
    sites = on_sphere(SITES, SEED)
    delaunay = SphericalDelaunay(sites)
    voronoi = SphericalVoronoi(delaunay)
    triangle = delaunay.simplices[delaunay.find_simplex(lonlat_to_xyz(MARKED))]
    circle = SphereCircle.through(*sites[triangle])
    return {
        "sites": sites,
        "edges": delaunay.edges,
        "vertices": voronoi.vertices,
        "ridges": np.array(voronoi.ridge_vertices),
        "triangle": triangle,
        "circle": np.append(circle.normal, circle.offset),
    }


def scene(g: dict) -> Scene:
    """Both graphs on an opaque ball, one triangle of them with its bubble."""
    circle = SphereCircle(g["circle"][:3], float(g["circle"][3]))
    scene = Scene()
    scene.add_cap(circle, name="small_bubble")
    scene.add_edges(g["sites"], g["edges"], name="delaunay")
    scene.add_edges(g["sites"], np.stack([g["triangle"], np.roll(g["triangle"], -1)], 1), name="triangle", style=HEAVY)
    scene.add_edges(g["vertices"], g["ridges"], name="voronoi")
    scene.add_circles([circle], name="bubble", style=LINES["accent2"])
    scene.add_points(g["sites"], name="sites")
    scene.add_points([circle.center], name="points")
    return scene


def draw(g: dict) -> Page:
    """The near side, with a legend."""
    marked = {"empty bubble of a triangle": FILLS["small_bubble"], "its centre, a Voronoi vertex": DOTS["points"]}
    return with_graphs(scene(g).page(VIEW, width=PAGE_WIDTH), marked)


def solid(g: dict) -> Solid:
    """All of it in space."""
    return Solid(draw(g), [scene(g).placed(VIEW)])


FIGURE = Figure("fig01_sphere", geometry, draw, in_space=solid)

if __name__ == "__main__":
    FIGURE.main()
