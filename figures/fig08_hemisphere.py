"""
Figure 8: Inverse stereographic projection to hemisphere (as seen through a transparent plane)
==============================================================================================

The sites of Figure 7 lifted to the tangent sphere whose diameter is half the diagonal of the rectangle. Only vertices
are lifted: Delaunay edges are rebuilt as great-circle arcs, Voronoi edges as perpendicular bisectors of them. The
rectangle is drawn thin in the plane, which touches the sphere at the south pole S. Its sides become arcs of circles
(heavy red) whose ends, the lifted corners (red dots), lie on the equator (dashed). From the two that are in sight, rays
(dashed red) lead on to their corners; the others are behind the sphere.

Chosen by us: the view, from 55° below the equator, and that the plane goes on a little beyond the rectangle.
"""

import numpy as np
from _arcs import from_rows, to_rows
from _rectangle import CORNERS, lift, lifted_sides, sites

from stereodel import PlanarDelaunay, SphericalVoronoi
from stereodel.drawing import LineStyle, Page, Scene, Solid, View
from stereodel.drawing.page.style import DOTS, FILLS, LINES, VERMILION, with_opacity
from stereodel.render import Figure
from stereodel.sphere import SphereCircle

VIEW = View(66, -55)
SOUTH = np.array([0.0, 0.0, -1.0])
SHOWN = [1, 2]  # the corners whose rays are drawn
RECTANGLE, RAY = LineStyle(VERMILION, 0.6), LineStyle(VERMILION, 0.7, (3.0, 2.0))
SHEETS = 1.0 + 0.025 * np.arange(4)  # sizes of the sheets, one on the other, that are the plane: its edge is soft


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


def scene(g: dict, sizes: np.ndarray = SHEETS) -> Scene:
    """The ball behind the plane, which is sheets of these sizes."""
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
    tint = with_opacity(FILLS["plane"], FILLS["plane"][3] / len(sizes))
    for size in sizes:
        scene.add_flat_polygon(size * g["plane"] + (1 - size) * radius * SOUTH, name="plane", color=tint)
    scene.add_outline(g["plane"], name="rectangle", style=RECTANGLE)
    scene.add_segments(radius * g["corners"][SHOWN], g["plane"][SHOWN], name="ray", style=RAY)
    scene.add_space_points(g["plane"][SHOWN], name="corner", style=DOTS["points"])
    scene.add_points(SOUTH[None], name="ring")
    scene.add_label(radius * SOUTH, "$S$", offset=(3, -9), always=True)
    return scene


def draw(g: dict) -> Page:
    """What is seen through the plane."""
    return scene(g).page(VIEW, extent=(-1.66, 1.66, -2.1, 1.07), width=340.0)


def solid(g: dict) -> Solid:
    """All of it in space, where sheets in one plane would flicker: a single one."""
    return Solid(draw(g), [scene(g, SHEETS[:1]).placed(VIEW)])


FIGURE = Figure("fig08_hemisphere", geometry, draw, in_space=solid)

if __name__ == "__main__":
    FIGURE.main()
