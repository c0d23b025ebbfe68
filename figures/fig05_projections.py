"""
Figure 5: Normal (left) and oblique stereographic projection
============================================================

Left, the plane touches the sphere at the south pole and rays from the north pole carry points of the sphere to it. Right,
the plane touches at another point and the rays start at its antipode. Circles go to circles in both.

Chosen by us: the points, the tangent point 25° N of the oblique plane, the view.
"""

import numpy as np

from stereodel import Stereographic, lonlat_to_xyz
from stereodel.render import Figure, Page, Scene, View

NORMAL = ((0.0, -90.0), ((20.0, -10.0), (95.0, -35.0), (-75.0, -30.0)))  # tangent point, points: (lon, lat) in degrees
OBLIQUE = ((35.0, -35.0), ((70.0, 20.0), (85.0, -45.0), (-8.0, -22.0)))
VIEW = View(0, 16)
HALF_SIDE = 2.1
PITCH = 4.7


def geometry() -> dict:
    """For each panel: tangent point, centre of projection, points, their images and the corners of the plane, in space."""
    return {f"{name}_{key}": value for name, case in panels().items() for key, value in lay_out(*case).items()}


def panels() -> dict:
    """The two cases by name."""
    return {"normal": NORMAL, "oblique": OBLIQUE}


def lay_out(tangent_point: tuple, points: tuple) -> dict:
    """One panel; a point (x, y) of the plane lies at t + x·east + y·north in space."""
    projection = Stereographic(tangent_point)
    tangent, on_ball = lonlat_to_xyz(tangent_point), lonlat_to_xyz(np.array(points))
    square = HALF_SIDE * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    return {
        "tangent": tangent,
        "points": on_ball,
        "images": projection.in_space(projection.forward(on_ball)),
        "plane": projection.in_space(square),
    }


def draw(g: dict) -> Page:
    """Two panels side by side."""
    items = [
        item
        for number, name in enumerate(panels())
        for item in panel(g, name).layout(VIEW, at=(PITCH * number, 0.0))
    ]
    return Page((-2.3, PITCH + 2.3, -1.9, 1.4), tuple(items), views=(VIEW.matrix,))


def panel(g: dict, name: str) -> Scene:
    """Glass ball, translucent plane, rays from the antipode through the points to the plane."""
    tangent, points, images = (g[f"{name}_{key}"] for key in ("tangent", "points", "images"))
    scene = Scene(look="glass")
    scene.add_flat_polygon(g[f"{name}_plane"], role="plane")
    scene.add_outline(g[f"{name}_plane"], role="plane")
    scene.add_segments(-tangent, images, role="ray")
    scene.add_points(points, role="sites")
    scene.add_points(np.array([-tangent, tangent]), role="pole")
    scene.add_space_points(images, role="points")
    return scene


FIGURE = Figure("fig05_projections", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
