r"""
Figure 9: Scale factor as a function of φ
=========================================

Left, the tangent sphere in cross-section: the triangles from the north pole to p and to its projection are similar,
with heights R + R sin φ and 2R, so the lift shrinks lengths by s = (R + R sin φ)/2R, φ being the latitude south of
the equator. Right, s and its rate of change along a meridian, ∂s/∂φ = cos φ / 2; along a parallel s is constant.

Chosen by us: φ = 25° on the left.
"""

import numpy as np

from stereodel import RectangleLift, lonlat_to_xyz
from stereodel.drawing import Page, Sketch
from stereodel.render import Figure

RADIUS = 1.0
PHI = 25.0  # degrees south of the equator
STEPS = np.linspace(0.0, 90.0, 181)
EVERY = 10
KNOTS = STEPS[::EVERY]  # of the graph
EXTENT = (-1.4, 4.75, -0.24, 2.2)
ORIGIN, WIDTH, HEIGHT = np.array([2.55, 0.1]), 1.95, 1.75  # the graph's box on the page


def geometry() -> dict:
    """The lifted point and its projection; the lift's scale, its rate and the slope of the rate at the knots."""
    lift = RectangleLift(4 * RADIUS, 0.0)  # only its sphere matters: diagonal 4R
    meridian = lonlat_to_xyz(np.stack([np.full_like(STEPS, 90.0), -STEPS], axis=-1))
    plane = lift.inverse(meridian)
    rate = lift.scale_rate(plane)
    point = lonlat_to_xyz((90.0, -PHI))
    return {
        "point": RADIUS * (point[1:] + [0.0, 1.0]),
        "projected": np.array([lift.inverse(point)[0], 0.0]),
        "scale": lift.scale_factor(plane[::EVERY]),
        "rate": rate[::EVERY],
        "bend": np.gradient(rate, np.radians(STEPS), edge_order=2)[::EVERY],
    }


def draw(g: dict) -> Page:
    """The cross-section beside the graph."""
    sketch = Sketch()
    add_section(sketch, g)
    add_graph(sketch, g)
    return sketch.page(EXTENT)


def add_section(sketch: Sketch, g: dict) -> None:
    """Sphere, plane and the two similar triangles."""
    north, center, south = (0.0, 2 * RADIUS), (0.0, RADIUS), (0.0, 0.0)
    foot = (0.0, float(g["point"][1]))
    sketch.add_polygon([foot, south, g["projected"], g["point"]], name="accent1")
    sketch.add_polygon([north, foot, g["point"]], name="accent2")
    sketch.add_segment((-1.2, 0), (2.1, 0), name="axis").add_circle(center, RADIUS, name="circle")
    sketch.add_segment((-RADIUS, RADIUS), (RADIUS, RADIUS), name="construction")
    sketch.add_segment(north, south, name="axis").add_segment(north, g["projected"], name="ray")
    sketch.add_segment(foot, g["point"], name="chord").add_segment(center, g["point"], name="axis")
    sketch.add_angle(center, g["point"], (RADIUS, RADIUS), 0.34, r"$\varphi$", name="axis")
    sketch.add_points([north, center, south], name="pole").add_points([g["point"], g["projected"]], name="points")
    sketch.add_label(north, "$N$", (0, 5), valign="bottom").add_label(south, "$S$", (0, -5), valign="top")
    sketch.add_label(g["point"], "$p$", (6, 2), align="left").add_label(
        g["projected"], r"$\pi(p)$", (0, -5), valign="top"
    )
    add_dimension(sketch, -1.12, 0.0, 2 * RADIUS, "$2R$")
    add_dimension(sketch, -0.16, foot[1], 2 * RADIUS, r"$R + R\,\sin\varphi$", rotation=90.0)


def add_dimension(sketch: Sketch, x: float, low: float, high: float, text: str, *, rotation: float = 0.0) -> None:
    """A vertical measure with ticks and its name on the left."""
    tick = 0.035
    sketch.add_segment((x, low), (x, high), name="frame")
    for y in (low, high):
        sketch.add_segment((x - tick, y), (x + tick, y), name="frame")
    sketch.add_label(
        (x, (low + high) / 2),
        text,
        (-7, 9 if rotation else 0),
        align="center" if rotation else "right",
        rotation=rotation,
    )


def add_graph(sketch: Sketch, g: dict) -> None:
    """The two curves over φ from 0° to 90°."""
    x = ORIGIN[0] + WIDTH * KNOTS / 90.0
    rise = HEIGHT * np.radians(90.0) / WIDTH  # page slope of a derivative by φ in radians
    for y in (0.5, 1.0):
        sketch.add_segment(ORIGIN + [0, HEIGHT * y], ORIGIN + [WIDTH, HEIGHT * y], name="grid")
    sketch.add_graph(x, ORIGIN[1] + HEIGHT * g["scale"], rise * g["rate"], name="accent1")
    sketch.add_graph(x, ORIGIN[1] + HEIGHT * g["rate"], rise * g["bend"], name="accent2")
    sketch.add_segment(ORIGIN, ORIGIN + [WIDTH, 0], name="axis").add_segment(ORIGIN, ORIGIN + [0, HEIGHT], name="axis")
    for phi in (0, 30, 60, 90):
        sketch.add_segment(ORIGIN + [WIDTH * phi / 90, 0], ORIGIN + [WIDTH * phi / 90, -0.035], name="axis")
        sketch.add_label(ORIGIN + [WIDTH * phi / 90, -0.035], f"${phi}°$", (0, -3), valign="top")
    for value, text in ((0.0, "$0$"), (0.5, "$1/2$"), (1.0, "$1$")):
        sketch.add_segment(ORIGIN + [-0.035, HEIGHT * value], ORIGIN + [0, HEIGHT * value], name="axis")
        sketch.add_label(ORIGIN + [-0.035, HEIGHT * value], text, (-3, 0), align="right")
    sketch.add_label(ORIGIN + [WIDTH, 0], r"$\varphi$", (10, 0), align="left")
    sketch.add_label(ORIGIN + [0.4 * WIDTH, 0.7 * HEIGHT], r"$s = (1 + \sin\varphi)/2$", align="left")
    sketch.add_label(
        ORIGIN + [0.58 * WIDTH, 0.4 * HEIGHT], r"$\partial s/\partial\varphi = \cos\varphi/2$", align="left"
    )


FIGURE = Figure("fig09_scale", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
