r"""
Claim P8: why circles become circles
====================================

Left, the sphere cut by the plane of symmetry of a circle with diameter AB, whose image has the diameter A'B'. The
tangent at N is parallel to the plane of projection, so its angle with NA (vermilion) is also the angle at A'. By the
theorem of inscribed angles it is the angle at B, too. In the same way the blue angles are equal, and the triangles NAB
and NB'A' are similar.

Right, a point P of the image and its foot M on A'B'. The plane through P parallel to the circle cuts the cone of rays
in a circle (dashed) with diameter DE, so that PM² = DM · ME. The triangles A'MD and EMB' have the same angles. Hence DM
· ME = A'M · MB', which says that P lies on the circle with diameter A'B'.

Chosen by us: the circle, the point P and the views.
"""

import re

import numpy as np

from stereodel.drawing import CircleArc, LineStyle, Page, Scene, Segment, Sketch, View
from stereodel.drawing.page.style import BLUE, PRINT_WIDTH, VERMILION, with_opacity
from stereodel.render import Figure

DIRECTIONS = np.radians([-146.0, -12.0])  # of A and B on the section
SHARE = 0.6  # of the way from A' to B', that from A' to M
VIEW = View(-75, 21)
RIGHT = (4.3, 0.0)
ANGLE = 0.34  # radius of the sectors
TANGENT, MORE = np.array([1.2, 0.0]), np.array([0.45, 0.0])  # half the tangent, what the plane has beside A' and B'
EXTENT = (-1.6, 6.62, -1.72, 1.28)
PLANE = np.array([[-1.4, -1.5, -1], [2.0, -1.5, -1], [2.0, 1.5, -1], [-1.4, 1.5, -1]])
SECTION = {"N": (0, 9), "A": (-9, -1), "B": (10, 3), "A'": (-6, -9), "B'": (7, -9)}
"""Names of points and their offsets, in points."""

INSIDE = {"N": (0, 10), "A": (11, -6), "B": (10, 4), "D": (-9, 7), "E": (14, 4), "M": (8, 6), "P": (-8, 8)}
SPACE = INSIDE | {"A'": (-9, -5), "B'": (10, -4)}
ANGLES = {VERMILION: ("N-A", "A'B'N", "BNA"), BLUE: ("NB+", "B'NA'", "ABN")}
"""Of each colour three angles: vertex, first and second arm; - and + are the ends of the tangent."""


def geometry() -> dict:
    """The points by their names, in space; the section is the plane of the first and the last coordinate."""
    north = np.array([0.0, 0.0, 1.0])
    a, b = np.stack([np.cos(DIRECTIONS), np.zeros(2), np.sin(DIRECTIONS)], axis=1)
    image_a, image_b = (north + 2 * (point - north) / (1 - point[2]) for point in (a, b))
    foot = image_a + SHARE * (image_b - image_a)
    away = np.array([b[2] - a[2], 0.0, a[0] - b[0]])  # normal of the circle
    reach = (foot - north) @ away / ((a - north) @ away)
    height = np.sqrt(np.linalg.norm(foot - image_a) * np.linalg.norm(image_b - foot))
    named = {"N": north, "A": a, "B": b, "A'": image_a, "B'": image_b, "M": foot, "P": foot - [0.0, height, 0.0]}
    return named | {"D": north + reach * (a - north), "E": north + reach * (b - north)}


def draw(g: dict) -> Page:
    """The section and the space."""
    sketch = Sketch()
    add_section(sketch, {name: point[[0, 2]] for name, point in g.items()})
    sketch.add_scene(space(g), VIEW, at=RIGHT)
    add_names(sketch, SPACE, {name: RIGHT + VIEW.project(point) for name, point in g.items()})
    return sketch.page(EXTENT, width=PRINT_WIDTH)


def add_section(sketch: Sketch, at: dict) -> None:
    """Equal angles in one colour."""
    at = at | {"-": at["N"] - TANGENT, "+": at["N"] + TANGENT}
    for color, angles in ANGLES.items():
        for vertex, first, last in (re.findall(".'?", angle) for angle in angles):
            style = LineStyle(color, 0.6)
            corners = (at[vertex], at[first], at[last])
            sketch.add_angle(*corners, ANGLE, "", name="angle", style=style, fill=with_opacity(color, 0.4))
    sketch.add_circle((0, 0), 1.0, name="limb").add_segment(at["-"], at["+"], name="construction")
    sketch.add_segment(at["A'"] - MORE, at["B'"] + MORE, name="outline")
    sketch.add_segments([[at["N"], at["A'"]], [at["N"], at["B'"]]], name="axis")
    sketch.add_segment(at["A"], at["B"], name="arc").add_segment(at["A'"], at["B'"], name="chord")
    sketch.add_points([at[name] for name in SECTION], name="sites")
    add_names(sketch, SECTION, at)


def add_names(sketch: Sketch, offsets: dict, at: dict) -> None:
    """Points by their names, as formulas with close primes."""
    for name, offset in offsets.items():
        sketch.add_label(at[name], f"${name}$".replace("'", r"\!'"), offset)


def space(g: dict) -> Scene:
    """Ball, plane, rays, both circles and the one that is parallel to the first."""
    scene = Scene(style="glass")
    scene.add_flat_polygon(PLANE)
    scene.add_outline(PLANE)
    for a, b, name in (("A", "B", "arc"), ("A'", "B'", "chord"), ("D", "E", "construction")):
        half = (g[b] - g[a]) / 2
        circle = CircleArc((g[a] + g[b]) / 2, half, np.array([0.0, np.linalg.norm(half), 0.0]))
        scene.add_curves([circle, Segment.between(g[a], g[b])], name=name)
    scene.add_segments(g["N"], np.array([g["A'"], g["B'"], g["P"]]), name="axis")
    scene.add_segments(g["M"], g["P"][None], name="axis")
    scene.add_space_points(np.array([g[name] for name in SPACE]), name="vertices")
    return scene


FIGURE = Figure("claim_inscribed", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
