"""
Figure 8: Inverse stereographic projection to hemisphere (as seen through a transparent plane)
==============================================================================================

The sites of Figure 7 lifted to the tangent sphere whose diameter is half the diagonal of the rectangle. Only vertices
are lifted: Delaunay edges are rebuilt as great-circle arcs, Voronoi edges as perpendicular bisectors of them. The
sides of the rectangle become arcs of circles (red) whose ends, the lifted corners (red dots), lie on the equator
(dashed). One ray is shown, from a lifted corner to the corner; the plane touches the sphere at the south pole S.

Chosen by us: the view from below, tilted so that the plane is seen as a sheet.
"""

import numpy as np
from _arcs import from_rows, to_rows
from _rectangle import CORNERS, lift, lifted_sides, sites

from stereodel import PlanarDelaunay, SphericalVoronoi
from stereodel.drawing import Page, Scene, Solid, View
from stereodel.drawing.page.style import DOTS, LINES
from stereodel.render import Figure
from stereodel.sphere import SphereCircle

VIEW = View(0, -78)
SOUTH = np.array([0.0, 0.0, -1.0])
SHOWN = 2  # the corner whose ray is drawn


def geometry() -> dict:
    """Lifted sites, sides and corners, planar edges, Voronoi diagram of the sphere, equator, the plane's corners."""
    raised = lift()
    points = sites()
    lifted = raised.forward(points)
    voronoi = SphericalVoronoi(lifted)
    return {
        "radius": np.array(raised.sphere.radius),
        "lifted": lifted,
        "edges": PlanarDelaunay(points).edges,
        "vertices": voronoi.vertices,
        "ridges": np.array(voronoi.ridge_vertices),
        "sides": to_rows(lifted_sides(raised.forward)),
        "corners": raised.forward(CORNERS),
        "equator": np.array([0.0, 0.0, -1.0, 0.0]),  # normal and offset
        "plane": raised.sphere.in_space(CORNERS),
    }


def scene(g: dict) -> Scene:
    """The ball behind the plane."""
    radius = float(g["radius"])
    scene = Scene(radius=radius)
    scene.add_edges(g["lifted"], g["edges"], name="delaunay")
    scene.add_edges(g["vertices"], g["ridges"], name="voronoi")
    scene.add_circles(
        [SphereCircle(g["equator"][:3], float(g["equator"][3]))], name="equator", style=LINES["construction"]
    )
    scene.add_arcs(from_rows(g["sides"]), name="chord")
    scene.add_points(g["lifted"], name="sites")
    scene.add_points(g["corners"], name="points")
    scene.add_flat_polygon(g["plane"], name="plane")
    scene.add_outline(g["plane"], name="plane")
    scene.add_segments(radius * g["corners"][SHOWN], g["plane"][[SHOWN]], name="ray", style=LINES["chord"])
    scene.add_space_points(g["plane"][[SHOWN]], name="corner", style=DOTS["points"])
    scene.add_points(SOUTH[None], name="ring")
    scene.add_label(radius * SOUTH, "$S$", offset=(3, -9), always=True)
    return scene


def draw(g: dict) -> Page:
    """What is seen through the plane."""
    return scene(g).page(VIEW, extent=(-1.56, 1.56, -1.22, 0.95), width=340.0)


def solid(g: dict) -> Solid:
    """All of it in space."""
    return Solid(draw(g), [scene(g).placed(VIEW)])


FIGURE = Figure("fig08_hemisphere", geometry, draw, in_space=solid)

if __name__ == "__main__":
    FIGURE.main()
