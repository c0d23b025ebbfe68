r"""
Claim P24: the image of an edge is not the edge between the images
==================================================================

The same sites in the plane (left) and lifted to a sphere that touches it (right, from below). Plane and sphere have the
same triangles, but not the same edges. Edges of the sphere (blue) are arcs of great circles; in the plane their images
are arcs of circles. Edges of the plane (vermilion) are segments; on the sphere their lifts are arcs of circles through
the projection pole. What lies between both curves of an edge is tinted. The curves coincide only where the great circle
passes through the point of contact (ring), which is one of the sites.

Chosen by us: the other sites and their seed, and the size of the sphere.
"""

import numpy as np
from _arcs import from_rows, rows_through
from _sites import in_rectangle

from stereodel import PlanarDelaunay, Stereographic
from stereodel.drawing import CircleArc, Fill, LineStyle, Page, Scene, Sketch, Stroke, View, with_legend
from stereodel.drawing.page.style import BLUE, PRINT_WIDTH, VERMILION, with_opacity
from stereodel.drawing.scene.sketch import arc_through
from stereodel.render import Figure

SITES, HULL, SIDE, SEED, MARGIN = 15, 8, 2.0, 12, 0.05
RADIUS = 0.68  # of the sphere, in units of the map
VIEW = View(0, -90)
BALL, SCALE = (2.26, 0.0), 1.03
ROUND, FLAT = LineStyle(BLUE, 1.5), LineStyle(VERMILION, 0.8)
BETWEEN = with_opacity(BLUE, 0.16)
EXTENT = (-1.08, 3.32, -1.08, 1.08)
LEGEND = {"edges of the sphere, and their images": ROUND, "edges of the plane, and their lifts": FLAT}


def geometry() -> dict:
    """Sites and edges; the lifts of segments, and the images of the middles of great-circle arcs."""
    sites = in_rectangle(SITES, HULL, SIDE, SIDE, SEED, margin=MARGIN)
    contact = np.hypot(*sites.T).argmin()
    sites[contact] = 0.0
    edges = PlanarDelaunay(sites).edges
    clockwise = np.linalg.det(sites[edges]) < 0  # about the point of contact: what is between both curves on the left
    edges = np.where(clockwise[:, None], edges, edges[:, ::-1])
    projection = Stereographic((0, -90), radius=RADIUS)
    lifts, middles = projection.inverse(sites), projection.inverse(sites[edges].mean(axis=1))
    starts, ends = np.moveaxis(lifts[edges], 1, 0)
    return {
        "sites": sites,
        "lifts": lifts,
        "edges": edges,
        "bent": ~(edges == contact).any(axis=1),
        "lifted": rows_through(starts, middles, ends),
        "middles": projection.forward(starts + ends),
    }


def draw(g: dict) -> Page:
    """The plane and the sphere."""
    sketch, pairs = Sketch(), g["sites"][g["edges"]]
    paths = [arc_through(a, middle, b) for (a, b), middle in zip(pairs, g["middles"], strict=True)]
    sketch.add_items([Fill((path,), BETWEEN, "between") for path in paths])
    sketch.add_items([Stroke(path, ROUND.color, ROUND.width, name="round") for path in paths])
    sketch.add_segments(pairs, name="flat", style=FLAT)
    sketch.add_points(g["sites"], name="sites").add_points((0, 0), name="ring")
    sketch.add_scene(ball(g), VIEW, at=BALL, scale=SCALE)
    return with_legend(sketch.page(EXTENT, width=PRINT_WIDTH), LEGEND, columns=2, indent=40.0)


def ball(g: dict) -> Scene:
    """Both curves of each edge on the ball."""
    scene, lifted = Scene(), from_rows(g["lifted"])
    for k in np.flatnonzero(g["bent"]):
        back = CircleArc.great(*g["lifts"][g["edges"][k, ::-1]])
        scene.add_region([lifted[k], back], name="between", color=BETWEEN)
    scene.add_edges(g["lifts"], g["edges"], name="round", style=ROUND)
    scene.add_arcs(lifted, name="flat", style=FLAT)
    scene.add_points(g["lifts"], name="sites")
    scene.add_points([[0, 0, -1]], name="ring")
    return scene


FIGURE = Figure("claim_edges", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
