r"""
Figure 13: Relationship of parallels of latitude
================================================

Two spheres in cross-section, of radius R and r = R/S, touch the plane at one point. A point at distance d in the plane
comes from latitude φ on the large sphere and goes to latitude Φ on the small one. Inscribed angles are half the arcs
that they see, hence tan((90° + φ)/2) = d/2R and tan((90° + Φ)/2) = d/2r, and so S tan((90° + φ)/2) = tan((90° + Φ)/2).

Chosen by us: S = 2 and d = 1.6 R.
"""

import numpy as np

from stereodel import Stereographic
from stereodel.render import Figure, Page, Sketch
from stereodel.sphere import angular_distance

RADIUS, S = 2.0, 2.0
DISTANCE = 1.6 * RADIUS
EXTENT = (-2.75, 4.25, -0.75, 4.4)


def geometry() -> dict:
    """Where the ray from each top point to the plane's point meets its circle, and the arcs from the tangent point."""
    radii = np.array([RADIUS, RADIUS / S])
    points = np.array([Stereographic((0, -90), radius=r).inverse((DISTANCE, 0.0)) for r in radii])
    return {
        "radii": radii,
        "points": radii[:, None] * (points[:, 1:] + [0.0, 1.0]),
        "arcs": angular_distance(points, [0.0, 0.0, -1.0]),
    }


def draw(g: dict) -> Page:
    """Both circles, both rays, the arcs that the inscribed angles see."""
    sketch = Sketch().add_segment((EXTENT[0] + 0.2, 0), (EXTENT[1] - 0.15, 0), role="axis")
    target = (DISTANCE, 0.0)
    names = ((r"$(90°\!+\!\varphi)/2$", r"$\varphi$", "$R$"), (r"$(90°\!+\!\Phi)/2$", r"$\Phi$", "$r = R/S$"))
    sketch.add_segment((0, 0), (0, 2 * RADIUS), role="axis")
    for number, (radius, point, arc) in enumerate(zip(g["radii"], g["points"], g["arcs"], strict=True)):
        add_sphere(sketch, float(radius), point, float(arc), f"accent{number + 1}", names[number])
    sketch.add_points([target], role="points").add_points([(0, 0)], role="pole")
    sketch.add_label("$S$", (0, 0), (0, -5), valign="top")
    add_distance(sketch)
    return sketch.page(EXTENT)


def add_sphere(sketch: Sketch, radius: float, point: np.ndarray, arc: float, role: str, names: tuple) -> None:
    """One circle with its ray, its inscribed angle and the arc that the angle sees."""
    inscribed, latitude, size = names
    center, top = (0.0, radius), (0.0, 2 * radius)
    sketch.add_circle(center, radius, role="frame")
    sketch.add_segment(center, (radius, radius), role="construction").add_segment(center, point, role="construction")
    sketch.add_segment(top, (DISTANCE, 0.0), role=role)
    sketch.add_arc(center, radius, -90, -90 + arc, role=role)
    sketch.add_angle(top, (0, 0), (DISTANCE, 0), 0.42, inscribed, role=role, gap=16.0)
    sketch.add_points([top, center], role="pole").add_points([point], role=role)


def add_distance(sketch: Sketch) -> None:
    """The measure d below the plane."""
    y, tick = -0.42, 0.06
    sketch.add_segment((0, y), (DISTANCE, y), role="frame")
    for x in (0.0, DISTANCE):
        sketch.add_segment((x, y - tick), (x, y + tick), role="frame")
    sketch.add_label("$d$", (DISTANCE / 2, y), (0, -4), valign="top")


FIGURE = Figure("fig13_latitudes", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
