r"""
Claim P7: the facets that Theorem 1 leaves out
==============================================

Left, eight sites in the plane with their Delaunay triangulation. Right, the same sites lifted to a sphere, and the
facets of their convex hull as spherical triangles. Those whose closed bubble does not contain the projection pole o are
kept: they are the triangles of the plane. The others (vermilion), two fewer than the sites on the boundary of the
convex hull in the plane, are left out: they close the hull around the pole and are not triangles of the plane.

One of these is outlined, and dashed in the plane. Its bubble (blue) is empty and contains o. In the plane, the exterior
of the circle is empty, and all other sites are inside.

Chosen by us: the sites and their seed, the size of the sphere, the facet and the view.
"""

import numpy as np
from _sites import in_rectangle

from stereodel import PlanarDelaunay, SphereCircle, SphericalDelaunay, Stereographic, lonlat_to_xyz
from stereodel.drawing import Fill, LineStyle, Page, Scene, Sketch, View
from stereodel.drawing.page.style import BLUE, LINES, PRINT_WIDTH, VERMILION, fainter, with_opacity
from stereodel.drawing.scene.sketch import arc_path
from stereodel.render import Figure
from stereodel.triangulation import planar_part

SITES, HULL, SIDE, MARGIN = 8, 6, 2.0, 0.05
SEED = 2054  # no site is near a line through two others or near the circle, and no facet is narrow
RADIUS = 0.25  # of the sphere, in units of the map
POLE = np.array([0.0, 0.0, 1.0])
VIEW = View(122, 40)
PLANE, SCALE = (-2.4, 0.0), 0.8  # middle and scale of the map on the page
WINDOW = 1.12  # half the side of the map, page units
EXTENT = (-3.58, 1.16, -1.16, 1.16)
KEPT, LEFT_OUT, CIRCLE = LINES["delaunay"], LineStyle(VERMILION, 0.6), LineStyle(BLUE, 1.1)
SHOWN, MISSING = LineStyle(VERMILION, 1.6), LineStyle(VERMILION, 0.9, (3.0, 2.0))
WORDS = {"$o$": (0, 90), "left out": (108, 62), "kept": (119, 5)}  # and where they stand on the sphere, degrees
TINT, WASH = fainter(VERMILION, 0.5), with_opacity(BLUE, 0.12)


def geometry() -> dict:
    """Sites and triangles in the plane; lifts and facets on the sphere, those left out apart; one of their circles."""
    sites = in_rectangle(SITES, HULL, SIDE, SIDE, SEED, margin=MARGIN)
    projection = Stereographic((0, -90), radius=RADIUS)
    lifts = projection.inverse(sites)
    hull = SphericalDelaunay(lifts)
    kept = {frozenset(corners) for corners in planar_part(hull, POLE).tolist()}
    left_out = np.array([corners for corners in hull.simplices.tolist() if frozenset(corners) not in kept])
    circles = [SphereCircle.through(*lifts[corners]) for corners in left_out]
    images = [projection.image_of(circle) for circle in circles]
    shown = int(np.argmin([image.radius for image in images]))
    circle, image = circles[shown], images[shown]
    return {
        "sites": sites,
        "triangles": PlanarDelaunay(sites).simplices,
        "corners": np.unique(PlanarDelaunay(sites).convex_hull),
        "lifts": lifts,
        "facets": hull.simplices,
        "left_out": left_out,
        "shown": left_out[shown],
        "circle": np.append(circle.normal, circle.offset),
        "image": np.append(image.center, image.radius),
    }


def draw(g: dict) -> Page:
    """The plane and the sphere."""
    sketch = Sketch()
    add_plane(sketch, g)
    sketch.add_items(sphere(g).layout(VIEW))
    return sketch.page(EXTENT, width=PRINT_WIDTH)


def add_plane(sketch: Sketch, g: dict) -> None:
    """The map, with what is outside of the circle tinted."""
    middle = np.array(PLANE)
    window = middle + WINDOW * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    x, y, radius = g["image"] * SCALE
    circle = arc_path(middle + [x, y], radius, 0.0, 360.0)
    frame = np.linspace(window, np.roll(window, -1, axis=0), 4, axis=1)
    sketch.add_items([Fill((frame, circle), WASH, "outside")])
    sites = middle + SCALE * g["sites"]
    sketch.add_edges(sites, sides(g["triangles"]), name="delaunay", style=KEPT)
    sketch.add_polyline(sites[g["shown"]], closed=True, name="left_out", style=MISSING)
    sketch.add_circle(middle + [x, y], radius, name="circle", style=CIRCLE)
    sketch.add_points(sites, name="sites")
    sketch.add_polyline(window, closed=True, name="frame")


def sphere(g: dict) -> Scene:
    """The lifted sites on a ball, with the facets that are left out and the bubble of one of them."""
    scene, lifts = Scene(), g["lifts"]
    circle = SphereCircle(g["circle"][:3], float(g["circle"][3]))
    scene.add_cap(circle, name="bubble", color=WASH)
    for corners in g["left_out"]:
        scene.add_patch(lifts[corners], name="left_out", color=TINT)
    scene.add_edges(lifts, sides(g["facets"]), name="delaunay", style=KEPT)
    scene.add_edges(lifts, sides(g["left_out"]), name="left_out", style=LEFT_OUT)
    scene.add_circles([circle], style=CIRCLE)
    scene.add_edges(lifts, sides(g["shown"][None]), name="shown", style=SHOWN)
    scene.add_points(lifts, name="sites")
    scene.add_points(POLE[None], name="pole")
    for word, place in WORDS.items():
        scene.add_label(lonlat_to_xyz(place), word, offset=(6, 5) if place[1] == 90 else (0, 0), size=11.0)
    return scene


def sides(triangles: np.ndarray) -> np.ndarray:
    """Pairs of corners (m, 2), each side once."""
    return np.unique(np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)


FIGURE = Figure("claim_theorem", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
