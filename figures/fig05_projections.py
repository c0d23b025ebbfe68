"""
Figure 5: Normal (left) and oblique stereographic projection
============================================================

Left, the plane touches the sphere at the south pole and rays from the north pole carry points of the sphere to it.
Right, the plane touches at another point and the rays start at its antipode. The circle through the three points
(blue) goes to a circle in both.

Chosen by us: the points, the tangent point of the oblique plane, the view.
"""

import numpy as np

from stereodel import SphereCircle, Stereographic, lonlat_to_xyz
from stereodel.drawing import CircleArc, Page, Scene, View
from stereodel.render import Figure

PANELS = {  # tangent point; centre and angular radius of the circle; directions of its points, all in degrees
    "normal": ((0.0, -90.0), (10.0, -66.0), 52.0, (118.0, 168.0, 235.0)),
    "oblique": ((100.0, -42.0), (92.0, -32.0), 48.0, (215.0, 285.0, 325.0)),
}
NAMES = {"normal": ("$N$", "$S$"), "oblique": ("$-t$", "$t$")}
VIEW = View(0, 18)
HALF_SIDE = {"normal": 1.75, "oblique": 1.5}  # of the square of the plane that is drawn
PITCH = 3.55


def geometry() -> dict:
    """For each panel: tangent point, points, their images, the corners of the plane and the two circles, in space."""
    return {
        f"{name}_{key}": value
        for name, case in PANELS.items()
        for key, value in lay_out(*case, HALF_SIDE[name]).items()
    }


def lay_out(tangent_point: tuple, center: tuple, radius: float, directions: tuple, half_side: float) -> dict:
    """One panel."""
    projection = Stereographic(tangent_point)
    circle = SphereCircle.around(center, radius)
    on_ball = circle.sample(360)[np.array(directions, dtype=int)]
    image = projection.image_of(circle)
    square = half_side * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    rim = projection.in_space(image.center + image.radius * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))
    return {
        "tangent": lonlat_to_xyz(tangent_point),
        "points": on_ball,
        "images": projection.in_space(projection.forward(on_ball)),
        "plane": projection.in_space(square),
        "circle": np.append(circle.normal, circle.offset),
        "image_circle": np.array([rim[0], rim[1] - rim[0], rim[2] - rim[0]]),  # centre and two radii
    }


def draw(g: dict) -> Page:
    """Two panels side by side."""
    items = [
        item for number, name in enumerate(PANELS) for item in panel(g, name).layout(VIEW, at=(PITCH * number, 0.0))
    ]
    return Page((-1.82, PITCH + 2.02, -2.24, 1.2), tuple(items), views=(VIEW.matrix,))


def panel(g: dict, name: str) -> Scene:
    """Glass ball, translucent plane, rays from the antipode through the points to the plane."""
    tangent, points, images = (g[f"{name}_{key}"] for key in ("tangent", "points", "images"))
    scene = Scene(style="glass")
    scene.add_flat_polygon(g[f"{name}_plane"], name="plane")
    scene.add_outline(g[f"{name}_plane"], name="plane")
    scene.add_circles([SphereCircle(g[f"{name}_circle"][:3], float(g[f"{name}_circle"][3]))], name="arc")
    scene.add_curves([CircleArc(*g[f"{name}_image_circle"])], name="arc")
    scene.add_segments(-tangent, images, name="ray")
    scene.add_points(points, name="sites")
    scene.add_points(np.array([-tangent, tangent]), name="pole")
    scene.add_space_points(images, name="points")
    for text, point, offset in zip(NAMES[name], (-tangent, tangent), ((-7, 6), (6, -8)), strict=True):
        scene.add_label(point, text, offset=offset, always=True)
    scene.add_label(points[1], "$p$", offset=(-7, 3), always=True)
    scene.add_label(images[1], r"$\pi(p)$", offset=(0, -9))
    return scene


FIGURE = Figure("fig05_projections", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
