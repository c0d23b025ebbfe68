"""
Figure 6: Inverse stereographic projections in cross-section
============================================================

One segment of the plane, lifted to three tangent spheres by rays from their top points. The smaller the radius R, the
larger the angular extent of the lifted segment, which is given below each arc: the radius determines how much curvature
the lift adds. One ray of each sphere is shown in its colour.

Chosen by us: a segment of length 3.2 and the radii 2, 1 and 1/2.
"""

import numpy as np

from stereodel import Stereographic
from stereodel.drawing import Page, Sketch
from stereodel.drawing.page.colors import as_color
from stereodel.drawing.page.style import BLUE, VERMILION, line
from stereodel.render import Figure
from stereodel.sphere import angular_distance

HALF_LENGTH = 1.6
RADII = (2.0, 1.0, 0.5)
NAMES = {0.5: "½"}  # of radii that are not written with digits
INKS = (BLUE, VERMILION, as_color("#00805e"))  # of type, which needs more contrast than lines: the green is darker
HEIGHTS = (2.7, 1.28, 0.36)  # where they stand
EXTENT = (-2.35, 2.35, -0.3, 4.15)


def geometry() -> dict:
    """Where the ends of the segment land on each circle, in the page, and how wide the covered arcs are."""
    ends = np.array([[-HALF_LENGTH, 0.0], [HALF_LENGTH, 0.0]])
    lifted = np.array([Stereographic((0, -90), radius=radius).inverse(ends) for radius in RADII])
    # The plane's x axis points along y in space, up is z; the page's plane is the line y = 0.
    section = np.array(RADII)[:, None, None] * (lifted[..., 1:] + [0.0, 1.0])
    south = np.array([0.0, 0.0, -1.0])
    extents = angular_distance(lifted, south).sum(axis=1)
    return {"ends": ends, "lifted": section, "extents": extents}


def draw(g: dict) -> Page:
    """Circles, projection lines from each top point, covered arcs thick, radii and extents written."""
    sketch = Sketch()
    sketch.add_segment((EXTENT[0] + 0.1, 0), (EXTENT[1] - 0.1, 0), name="axis")
    for number, radius in enumerate(RADII):
        add_sphere(sketch, number, radius, g)
    sketch.add_segment(*g["ends"], name="outline").add_points(g["ends"], name="pole")
    sketch.add_label((EXTENT[1] - 0.1, 0), "plane", (0, -8), align="right")
    return sketch.page(EXTENT, width=340.0)


def add_sphere(sketch: Sketch, number: int, radius: float, g: dict) -> None:
    """One tangent sphere in cross-section with the lift of the segment."""
    center, top = (0.0, radius), (0.0, 2 * radius)
    name = f"accent{number + 1}"
    half = g["extents"][number] / 2
    first, last = g["ends"]
    sketch.add_circle(center, radius, name="frame")
    sketch.add_segment(top, first, name="construction").add_segment(top, last, name=name, style=line(name).scaled(0.7))
    sketch.add_arc(center, radius, -90 - half, -90 + half, name=f"covered{number + 1}")
    sketch.add_points(g["lifted"][number], name=name).add_points(top, name="pole")
    place, color = (0.0, HEIGHTS[number]), INKS[number]
    sketch.add_label(place, f"$R = {NAMES.get(radius, f'{radius:g}')}$", (0, 6), color=color)
    sketch.add_label(place, f"${g['extents'][number]:.1f}°$", (0, -6), color=color)


FIGURE = Figure("fig06_sphere_size", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
