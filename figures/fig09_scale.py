r"""
Figure 9: Scale factor as a function of φ
=========================================

Left, the tangent sphere in cross-section: the triangles from the north pole to p and to its projection are similar,
with heights R + R sin φ and 2R, so the lift shrinks lengths by s = (R + R sin φ)/2R, φ being the latitude south of
the equator. Right, s and its rate of change along a meridian, ∂s/∂φ = cos φ / 2; along a parallel s is constant.

Chosen by us: φ = 25° on the left, which the dots on the curves mark on the right.
"""

import numpy as np
from _chart import fraction

from stereodel import RectangleLift, lonlat_to_xyz
from stereodel.drawing import Page, Sketch
from stereodel.drawing.page.style import line
from stereodel.render import Figure

RADIUS = 1.0
PHI = 25.0  # degrees south of the equator
KNOTS = np.linspace(0.0, 90.0, 37)  # of the graph; φ is one
EXTENT = (-1.42, 4.78, -0.3, 2.28)
ORIGIN, WIDTH, HEIGHT = np.array([2.55, 0.0]), 1.95, 2.0  # the graph's box on the page
ACROSS = {value: f"${value:g}°$" for value in (0.0, PHI, 60.0, 90.0)}
TEXTS = {
    "scale": (np.array([0.85, 1.35]), r"$s = (1 + \sin\varphi)/2$"),
    "rate": (np.array([1.02, 0.86]), r"$\partial s/\partial\varphi = (\cos\varphi)/2$"),
}
UP = {value: fraction(value) for value in (0.0, 0.5, 1.0)}


def geometry() -> dict:
    """The lifted point and its projection; the lift's scale and its rate at the knots."""
    lift = RectangleLift(4 * RADIUS, 0.0)  # only its sphere matters: diagonal 4R
    meridian = lift.inverse(lonlat_to_xyz(np.stack([np.full_like(KNOTS, 90.0), -KNOTS], axis=-1)))
    point = lonlat_to_xyz((90.0, -PHI))
    return {
        "point": RADIUS * (point[1:] + [0.0, 1.0]),
        "projected": np.array([lift.inverse(point)[0], 0.0]),
        "scale": lift.scale_factor(meridian),
        "rate": lift.scale_rate(meridian),
    }


def draw(g: dict) -> Page:
    """The cross-section beside the graph."""
    sketch = Sketch()
    add_section(sketch, g)
    add_graph(sketch, g)
    return sketch.page(EXTENT, width=360.0)


def add_section(sketch: Sketch, g: dict) -> None:
    """Sphere, plane and the two similar triangles."""
    north, center, south = (0.0, 2 * RADIUS), (0.0, RADIUS), (0.0, 0.0)
    foot = (0.0, float(g["point"][1]))
    sketch.add_polygon([foot, south, g["projected"], g["point"]], name="accent1")
    sketch.add_polygon([north, foot, g["point"]], name="accent2")
    sketch.add_segment((-1.2, 0), (1.75, 0), name="axis").add_circle(center, RADIUS, name="circle")
    sketch.add_segment(center, (RADIUS, RADIUS), name="construction")
    sketch.add_segment(north, south, name="axis").add_segment(north, g["projected"], name="ray")
    sketch.add_segment(foot, g["point"], name="chord").add_segment(center, g["point"], name="axis")
    sketch.add_angle(center, g["point"], (RADIUS, RADIUS), 0.34, r"$\varphi$", name="axis")
    sketch.add_points([north, center, south], name="pole").add_points([g["point"], g["projected"]], name="points")
    sketch.add_label(north, "$N$", (0, 5), valign="bottom")
    sketch.add_label(south, "$S$", (0, -5), valign="top")
    sketch.add_label(g["point"], "$p$", (6, 2), align="left")
    sketch.add_label(g["projected"], r"$\pi(p)$", (0, -5), valign="top")
    sketch.add_dimension((-1.18, 0.0), (-1.18, 2 * RADIUS), "$2R$", name="frame")
    sketch.add_dimension((-0.14, foot[1]), (-0.14, 2 * RADIUS), r"$R + R\,\sin\varphi$", name="frame")


def add_graph(sketch: Sketch, g: dict) -> None:
    """The two curves over φ from 0° to 90°, and φ of the cross-section on both."""
    sketch.add_axes(ORIGIN, WIDTH, HEIGHT, ACROSS, UP, name="axis")
    x, at = ORIGIN[0] + WIDTH * KNOTS / 90.0, int(np.searchsorted(KNOTS, PHI))
    curves = {name: ORIGIN[1] + HEIGHT * g[name] for name in TEXTS}
    sketch.add_segment((x[at], ORIGIN[1]), (x[at], curves["scale"][at]), name="construction")
    for number, (curve, (place, text)) in enumerate(TEXTS.items()):
        name = f"accent{number + 1}"
        sketch.add_graph(x, curves[curve], name=name).add_points((x[at], curves[curve][at]), name=name)
        sketch.add_label(ORIGIN + place, text, align="left", color=line(name).color)
    sketch.add_label(ORIGIN + [WIDTH, 0], r"$\varphi$", (8, 0), align="left")


FIGURE = Figure("fig09_scale", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
