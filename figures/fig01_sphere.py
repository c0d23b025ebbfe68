"""
Figure 1: Delaunay triangulation and its dual Voronoi diagram on a sphere
=========================================================================

The Delaunay triangulation (gray) of 80 sites, whose edges are arcs of great circles, and the Voronoi diagram (black).
Each Voronoi edge lies on the perpendicular bisector of a Delaunay edge; each Voronoi vertex is the centre of an empty
bubble.

Chosen by us: the number of sites, their seed and the view.
"""

import numpy as np
from _sites import on_sphere

from stereodel import SphericalDelaunay, SphericalVoronoi
from stereodel.drawing import Page, Scene, View
from stereodel.render import Figure

SITES, SEED = 80, 1
VIEW = View(20, 25)


def geometry() -> dict:
    """Sites, Delaunay edges, Voronoi vertices and ridges."""
    sites = on_sphere(SITES, SEED)
    delaunay = SphericalDelaunay(sites)
    voronoi = SphericalVoronoi(delaunay)
    return {
        "sites": sites,
        "edges": delaunay.edges,
        "vertices": voronoi.vertices,
        "ridges": np.array(voronoi.ridge_vertices),
    }


def draw(g: dict) -> Page:
    """Both graphs on an opaque ball."""
    scene = Scene()
    scene.add_edges(g["sites"], g["edges"], name="delaunay")
    scene.add_edges(g["vertices"], g["ridges"], name="voronoi")
    scene.add_points(g["sites"], name="sites")
    return scene.page(VIEW, width=340.0)


FIGURE = Figure("fig01_sphere", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
