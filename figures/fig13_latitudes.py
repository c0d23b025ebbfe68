r"""
Figure 13: Relationship of parallels of latitude
================================================

Two spheres in cross-section, of radius R and r = R/S, touch the plane at one point. A point at distance d in the plane
is the image of latitude φ on the large sphere and is lifted to latitude Φ on the small one. Inscribed angles are half
the arcs that they subtend, hence tan((90° + φ)/2) = d/2R and tan((90° + Φ)/2) = d/2r, and so S tan((90° + φ)/2) =
tan((90° + Φ)/2).

Chosen by us: S = 2.5 and d = 1.6 R.
"""

import numpy as np

from stereodel import Stereographic
from stereodel.drawing import Page, Sketch
from stereodel.drawing.page.style import BLACK, BLUE, VERMILION, LineStyle, line
from stereodel.render import Figure
from stereodel.sphere import angular_distance

RADIUS, S = 2.0, 2.5
DISTANCE = 1.6 * RADIUS
EXTENT = (-2.15, 4.75, -0.72, 4.42)
NAMES = (
    (r"$(90°\!+\!\varphi)/2$", r"$\varphi$", "$R$", (0, 7)),
    (r"$(90°\!+\!\Phi)/2$", r"$\Phi$", "$r = R/S$", (0, -8)),
)
"""Of each circle: the inscribed angle, the latitude, the radius and where that stands."""
EQUATIONS = (
    (r"$\tan((90°\!+\!\varphi)/2) = d/2R$", BLUE),
    (r"$\tan((90°\!+\!\Phi)/2) = d/2r$", VERMILION),
    (r"$S\,\tan((90°\!+\!\varphi)/2) = \tan((90°\!+\!\Phi)/2)$", BLACK),
)
ROOM, LEAD, LEFT = 1.0, 0.16, {"align": "right"}  # beside the axis for a name; of a line outside the circle; page units
CORNER, ROW = (2.05, 4.1), 16.0  # of the equations: upper left corner; height of a row, points


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
    """Both circles, both rays, the arcs that the inscribed angles see, and what follows."""
    sketch = Sketch().add_segment((EXTENT[0] + 0.1, 0), (EXTENT[1] - 0.1, 0), name="axis")
    target = (DISTANCE, 0.0)
    sketch.add_segment((0, 0), (0, 2 * RADIUS), name="axis")
    for number, (radius, point, arc) in enumerate(zip(g["radii"], g["points"], g["arcs"], strict=True)):
        add_sphere(sketch, float(radius), point, float(arc), f"accent{number + 1}", NAMES[number])
    sketch.add_points([target], name="points").add_points([(0, 0)], name="pole")
    sketch.add_dimension((DISTANCE, -0.3), (0.0, -0.3), "$d$", name="frame")
    for number, (text, color) in enumerate(EQUATIONS):
        sketch.add_label(CORNER, text, (0, -ROW * number), align="left", valign="baseline", color=color)
    return sketch.page(EXTENT, width=360.0)


def add_sphere(sketch: Sketch, radius: float, point: np.ndarray, arc: float, name: str, names: tuple) -> None:
    """One circle with its ray, its inscribed angle and the arc that the angle sees."""
    inscribed, latitude, size, beside = names
    center, top, equator = (0.0, radius), (0.0, 2 * radius), (radius, radius)
    color = line(name).color
    sketch.add_circle(center, radius, name="frame")
    sketch.add_segment(center, equator, name="construction").add_segment(center, point, name="construction")
    sketch.add_segment(top, (DISTANCE, 0.0), name=name)
    sketch.add_arc(center, radius, -90, -90 + arc, name=f"covered{name[-1]}")
    sketch.add_angle(top, (0, 0), (DISTANCE, 0), 0.5 * radius, "", name=name)
    add_name(sketch, radius, inscribed, color)
    first, second = (point, equator) if arc < 90 else (equator, point)
    sketch.add_angle(center, first, second, 0.62 * radius, latitude, name="frame", gap=7.0, color=color)
    sketch.add_label((0.4 * radius, radius), size, beside)
    sketch.add_label(top, "$N$", (-5, 4), align="right", valign="bottom")
    sketch.add_points([top, center], name="pole").add_points([point], name=name)


def add_name(sketch: Sketch, radius: float, text: str, color: tuple) -> None:
    """The name of an inscribed angle beside it, or left of a circle that has no room for it, at a line to it."""
    foot, chord = (0.0, 1.5 * radius), np.sqrt(0.75) * radius  # half the circle's, at the height of the angle's arc
    if chord < ROOM:
        tip, leader = (-chord - LEAD, foot[1]), LineStyle(color, 0.5)
        sketch.add_segment(tip, foot, name="construction", style=leader).add_label(
            tip, text, (-2, 0), **LEFT, color=color
        )
    else:
        sketch.add_label(foot, text, (-4, 0), **LEFT, color=color)


FIGURE = Figure("fig13_latitudes", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
