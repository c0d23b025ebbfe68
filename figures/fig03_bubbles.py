"""
Figure 3: Every circle on a sphere bounds two bubbles
=====================================================

Every circle is the intersection of the sphere with a plane. It bounds a smaller bubble (orange) and a larger one
(blue). Right, a cross-section with the bubbles outlined in their colours. The Delaunay condition on the sphere is that
one bubble is empty, the one on the outer side of the plane, to which its normal n points. Then the plane contains a
facet of the convex hull, and all other sites lie on its inner side, as does the centre O.

Chosen by us: a circle of angular radius 42° about (30° E, 32° N).
"""

import numpy as np

from stereodel import SphereCircle, lonlat_to_xyz
from stereodel.drawing import Page, Scene, Sketch, Solid, View
from stereodel.drawing.page import Beziers, Fill
from stereodel.drawing.page.style import FILLS, LINES
from stereodel.drawing.scene.sketch import arc_path
from stereodel.render import Figure

CENTER, RADIUS = (30.0, 32.0), 42.0  # degrees
VIEW = View(12, 14)
BELOW = (2.0, -38.0)  # where the large bubble is labelled
SECTION = np.array([2.5, 0.0])  # its centre
REACH, NORMAL = 0.95, 0.6  # half the length of the plane that is drawn, length of its normal
BAND = 0.09  # width of the tints round the section
EXTENT = (-1.03, 4.42, -1.32, 1.24)


def geometry() -> dict:
    """The circle: normal and offset."""
    circle = SphereCircle.around(CENTER, RADIUS)
    return {"normal": circle.normal, "offset": np.array(circle.offset), "below": lonlat_to_xyz(BELOW)}


def draw(g: dict) -> Page:
    """The two tints, the circle between them, their names; the plane from the side."""
    sketch = Sketch().add_scene(ball(g), VIEW)
    add_section(sketch, circle_of(g))
    return sketch.page(EXTENT, width=360.0)


def circle_of(g: dict) -> SphereCircle:
    """The circle between the bubbles."""
    return SphereCircle(g["normal"], float(g["offset"]))


def ball(g: dict) -> Scene:
    """Both bubbles, each with its name in its middle."""
    circle, scene = circle_of(g), Scene()
    scene.add_cap(circle, side="outside", name="large_bubble")
    scene.add_cap(circle, side="inside", name="small_bubble")
    scene.add_circles([circle], name="circle")
    scene.add_label(circle.offset * circle.normal, "small bubble", always=True)
    scene.add_label(g["below"], "large bubble")
    return scene


def add_section(sketch: Sketch, circle: SphereCircle) -> None:
    """The sphere cut along the axis of the circle, which points as it does on the left."""
    across = VIEW.project(circle.normal)
    across /= np.hypot(*across)
    along = np.array([-across[1], across[0]])
    half, turn = circle.angular_radius, float(np.degrees(np.arctan2(across[1], across[0])))
    middle = SECTION + circle.offset * across
    add_tints(sketch, turn, half, float(np.degrees(np.arccos(circle.offset / (1.0 + BAND)))))
    sketch.add_segment(middle - REACH * along, middle + REACH * along, name="slicing_plane", style=LINES["circle"])
    sketch.add_arrow(middle, middle + NORMAL * across, name="normal", style=LINES["axis"])
    rim = np.sin(np.radians(half)) * along
    sketch.add_points([middle - rim, middle + rim], name="sites").add_points([SECTION], name="vertices")
    beside = np.radians(turn - half / 2)
    sketch.add_label(SECTION, "$O$", (-7, -6))
    sketch.add_label(middle + NORMAL * across, r"$\mathbf{n}$", (7, 2))
    sketch.add_label(middle - REACH * along, "slicing plane", (-4, -3), align="left", valign="top")
    sketch.add_label(SECTION + [np.cos(beside), np.sin(beside)], "small bubble", (10, 5), align="left")
    sketch.add_label(SECTION - [0.0, 1.0], "large bubble", (0, -9), valign="top")


def add_tints(sketch: Sketch, turn: float, half: float, wider: float) -> None:
    """Both arcs of the section, edged: the plane cuts them at `half` and their edges at `wider` degrees from `turn`."""
    for kind, inner, outer in (
        ("large", (turn + half, turn + 360.0 - half), (turn + wider, turn + 360.0 - wider)),
        ("small", (turn - half, turn + half), (turn - wider, turn + wider)),
    ):
        sketch.add_items([Fill((band(inner, outer),), FILLS[f"{kind}_bubble"], f"{kind}_bubble")])
        sketch.add_arc(SECTION, 1.0, *inner, name=kind, style=LINES["limb"])


def band(inner: tuple[float, float], outer: tuple[float, float]) -> Beziers:
    """What lies between the section and a wider arc about it, each from one direction to another in degrees."""
    near, far = arc_path(SECTION, 1.0, *inner), arc_path(SECTION, 1.0 + BAND, *outer)[::-1, ::-1]
    ends = [np.linspace(near[-1, -1], far[0, 0], 4), np.linspace(far[-1, -1], near[0, 0], 4)]
    return np.concatenate([near, ends[:1], far, ends[1:]])


def solid(g: dict) -> Solid:
    """The ball in space."""
    return Solid(draw(g), [ball(g).placed(VIEW)])


FIGURE = Figure("fig03_bubbles", geometry, draw, in_space=solid)

if __name__ == "__main__":
    FIGURE.main()
