"""
Claim P2: a facet whose empty bubble is larger than a hemisphere
================================================================

The paper says that of the two bubbles of a facet the smaller one is empty. That is so unless all sites lie in an open
hemisphere. Then their convex hull does not contain the centre O, and some facets close it on the side of O. One of them
is tinted. Its plane cuts the sphere in a circle (black). All other sites lie in the smaller bubble (orange); empty is
the larger one (blue), on the outer side of the facet, to which its normal n points. Right, the same from the direction
in which the plane of the facet is a line: hull and sites lie on one side of it, O on the other.

Chosen by us: the sites and their seed, the facet, which has the largest empty bubble of all, and the views.
"""

import numpy as np
from _sites import in_cap

from stereodel import SphereCircle, SphericalDelaunay
from stereodel.drawing import Page, Scene, Sketch, View
from stereodel.drawing.page.style import FILLS, LINES, PRINT_WIDTH, fainter, with_opacity
from stereodel.render import Figure
from stereodel.sphere import xyz_to_lonlat

MIDDLE, REACH = (-150.0, -24.0), 62.0  # degrees: the sites lie in this cap
SITES, SEED = 16, 5
TURN, TILT = 46.0, 12.0  # degrees from the right view to the left one
RIGHT, BEYOND, NORMAL = np.array([2.8, 0.0]), 1.1, 0.9
EXTENT = (-1.05, 3.85, -1.19, 1.03)


def geometry() -> dict:
    """Sites and facets of their hull, the largest facet that closes it and its circle, whose inside is empty."""
    sites = in_cap(SITES, SEED, MIDDLE, REACH)
    hull = SphericalDelaunay(sites)
    circles = [SphereCircle.through(*sites[corners]) for corners in hull.simplices]
    shown = int(np.argmin([circle.offset for circle in circles]))
    return {
        "sites": sites,
        "facets": hull.simplices,
        "shown": np.array(shown),
        "circle": np.append(circles[shown].normal, circles[shown].offset),
    }


def circle_of(g: dict) -> SphereCircle:
    """The circle of the facet."""
    return SphereCircle(g["circle"][:3], float(g["circle"][3]))


def ball(g: dict, view: View) -> list[Scene]:
    """A glass ball with both bubbles, and of the hull in it the facets that face the viewer, lit from there."""
    circle, glass = circle_of(g), Scene(style="glass")
    faces, hull = Scene(style="none"), Scene(style="none")
    glass.add_cap(circle, name="large_bubble", color=with_opacity(FILLS["large_bubble"], 0.45))
    glass.add_cap(circle, side="outside", name="small_bubble", color=with_opacity(FILLS["small_bubble"], 0.6))
    glass.add_circles([circle])
    corners = g["sites"][g["facets"]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    light = view.depth(normals) / np.linalg.norm(normals, axis=1)
    for facet in np.flatnonzero(light > 0):
        name = "visible" if facet == g["shown"] else "facet"
        faces.add_flat_polygon(corners[facet], name=name, color=fainter(FILLS[name], 0.6 * light[facet]))
        hull.add_outline(corners[facet], name="delaunay")
    hull.add_outline(corners[g["shown"]], name="chord")
    hull.add_space_points(g["sites"][np.unique(g["facets"][light > 0])], name="sites")
    return [glass, faces, hull]


def draw(g: dict) -> Page:
    """Through the larger bubble, and along the plane of the facet."""
    circle, sketch = circle_of(g), Sketch()
    lon, _ = xyz_to_lonlat(circle.normal)
    along = View(lon - 90.0, 0.0)
    for at, view in ((np.zeros(2), View(lon - TURN, TILT)), (RIGHT, along)):
        for scene in ball(g, view):
            sketch.add_scene(scene, view, at=tuple(at))
        foot, tip = at + view.project([circle.offset * circle.normal, (circle.offset + NORMAL) * circle.normal])
        sketch.add_arrow(foot, tip, name="normal", style=LINES["axis"]).add_points(at, name="vertices")
        sketch.add_label(tip, r"$\mathbf{n}$", (8, 3)).add_label(at, "$O$", (5, -9))
    across = along.project(circle.normal)
    reach = BEYOND * np.array([-across[1], across[0]])
    sketch.add_segment(foot - reach, foot + reach, name="circle")
    sketch.add_label(foot + reach, "plane of the facet", (-4, 0), align="right")
    sketch.add_label(RIGHT + [0.3, 0.55], "larger bubble: empty")
    sketch.add_label(RIGHT - [0.96, 0.3], "smaller bubble:", (-6, 6), align="right")
    sketch.add_label(RIGHT - [0.96, 0.3], "all other sites", (-6, -6), align="right")
    return sketch.page(EXTENT, width=PRINT_WIDTH)


FIGURE = Figure("claim_closing", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
