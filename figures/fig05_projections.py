"""
Figure 5: Normal (left) and oblique stereographic projection
============================================================

Left, the plane touches the sphere at the south pole S, and rays from the north pole N take points p of the sphere to
points π(p) of the plane. Right, the plane touches at another point t, and the rays start at its antipode −t. The
diameter to the point of contact (dashed) is perpendicular to the plane. In both, the circle through the three points
(blue) is mapped to a circle.

Chosen by us: the points, the tangent point of the oblique plane, the view.
"""

import numpy as np

from stereodel import SphereCircle, Stereographic, lonlat_to_xyz
from stereodel.drawing import CircleArc, Page, Scene, Segment, Sketch, Solid, View
from stereodel.drawing.page.style import LINES
from stereodel.render import Figure

PANELS = {  # tangent point; centre and angular radius of the circle; directions of its points, all in degrees
    "normal": ((20.0, -90.0), (10.0, -66.0), 52.0, (118.0, 168.0, 235.0)),
    "oblique": ((100.0, -42.0), (92.0, -32.0), 48.0, (215.0, 285.0, 325.0)),
}
NAMES = {"normal": ("$N$", "$S$"), "oblique": ("$-t$", "$t$")}
LABELS = {  # which of the points is called p; where the four names stand, in points
    "normal": (1, ((-8, 7), (-8, 4), (-6, 6), (-15, 4))),
    "oblique": (2, ((-7, 7), (6, -5), (-8, -5), (-4, -10))),
}
SIDE = {"normal": 1, "oblique": 3}  # the corner of the plane to which a side of the right angle points
CORNER = 0.12  # side of the mark of a right angle
VIEW = View(0, 18)
HALF_SIDE = {"normal": 1.75, "oblique": 1.5}  # of the square of the plane that is drawn
PITCH = 3.85
EXTENT = (-2.27, PITCH + 2.02, -2.47, 1.26)


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
    sketch = Sketch()
    for number, name in enumerate(PANELS):
        sketch.add_scene(panel(g, name), VIEW, at=(PITCH * number, 0.0))
        title = f"{name}: centre of projection {NAMES[name][0]}"
        sketch.add_label((PITCH * number, EXTENT[2]), title, (0, 3), valign="baseline")
    return sketch.page(EXTENT, width=360.0)


def panel(g: dict, name: str) -> Scene:
    """Glass ball, translucent plane, rays from the antipode through the points to the plane."""
    tangent, points, images, plane = (g[f"{name}_{key}"] for key in ("tangent", "points", "images", "plane"))
    scene = Scene(style="glass")
    scene.add_flat_polygon(plane, name="plane")
    scene.add_outline(plane, name="plane")
    scene.add_circles([SphereCircle(g[f"{name}_circle"][:3], float(g[f"{name}_circle"][3]))], name="arc")
    scene.add_curves([CircleArc(*g[f"{name}_image_circle"])], name="arc")
    scene.add_segments(-tangent, tangent[None], name="diameter", style=LINES["construction"])
    scene.add_curves(right_angle(tangent, plane[SIDE[name]] - plane[0]), name="plane")
    scene.add_segments(-tangent, images, name="ray")
    scene.add_points(points, name="sites")
    scene.add_points(tangent[None], name="pole")
    scene.add_points(-tangent[None], name="ring")
    scene.add_space_points(images, name="points")
    p, offsets = LABELS[name]
    places = (-tangent, tangent, points[p], images[p])
    for text, place, offset in zip((*NAMES[name], "$p$", r"$\pi(p)$"), places, offsets, strict=True):
        scene.add_label(place, text, offset=offset, always=True)
    return scene


def right_angle(tangent: np.ndarray, side: np.ndarray) -> list[Segment]:
    """Two sides of a small square between the diameter and a direction of the plane, at the point of contact."""
    along, up = CORNER * side / np.linalg.norm(side), -CORNER * tangent
    return [Segment.between(tangent + along, tangent + along + up), Segment.between(tangent + along + up, tangent + up)]


def solid(g: dict) -> Solid:
    """Both in space."""
    return Solid(draw(g), [panel(g, name).placed(VIEW, at=(PITCH * k, 0.0)) for k, name in enumerate(PANELS)])


FIGURE = Figure("fig05_projections", geometry, draw, in_space=solid)

if __name__ == "__main__":
    FIGURE.main()
