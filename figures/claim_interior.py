r"""
Claim P16: any bubble onto any other, with any interior point where it is wanted
================================================================================

Left, a bubble and a point p in it that is not its centre c. There is one conformal map f that sends the bubble onto the
southern hemisphere and p to the south pole S, but for a rotation about the pole. Right, the hemisphere with a grid of
parallels and meridians whose cells are squares, the more nearly the smaller they are. Left, what is mapped onto it:
through p circles that are perpendicular to the rim, and circles about p. One sector is vermilion. The centre c is not
sent to the pole.

Chosen by us: the bubble, the point, the rotation and the number of sectors.
"""

import numpy as np
from _arcs import from_rows, rows_through

from stereodel import SphereCircle, bubble_to_bubble, lonlat_to_xyz
from stereodel.drawing import Page, Scene, Sketch, View
from stereodel.drawing.page.style import BLUE, PRINT_WIDTH, VERMILION, fainter
from stereodel.render import Figure

BUBBLE = SphereCircle.around((15.0, 25.0), 58.0)
P = (-14.0, 5.0)  # degrees
SOUTH = SphereCircle.around((0.0, -90.0), 90.0)
SECTORS, RINGS = 24, 10
TURN = 30.0  # degrees
PITCH = 2.35
VIEWS = {"bubble": View(6, 22), "hemisphere": View(20, -58)}
NAMES = {"bubble": ("$p$", "$c$"), "hemisphere": ("$S$", "$f(c)$")}
EXTENT = (-1.03, PITCH + 1.03, -1.03, 1.03)


def geometry() -> dict:
    """Sides of cells of the grid, four each, in the bubble and on the hemisphere; p and c and their images."""
    conformal = bubble_to_bubble(BUBBLE, SOUTH, P, (0.0, -90.0), turn=TURN)
    corners, points = grid(), np.array([lonlat_to_xyz(P), BUBBLE.center])
    ends = np.roll(corners, -1, axis=1)
    sides = [lonlat_to_xyz(places.reshape(-1, 2)) for places in (corners, (corners + ends) / 2, ends)]
    return {
        "bubble_sides": rows_through(*map(conformal.inverse(), sides)),
        "hemisphere_sides": rows_through(*sides),
        "bubble_points": points,
        "hemisphere_points": conformal(points),
    }


def grid() -> np.ndarray:
    """Corners of every other cell of the hemisphere in degrees, (n, 4, 2), counterclockwise; by sectors."""
    step = 2 * np.pi / SECTORS
    lats = np.degrees(2 * np.arctan(np.exp(-step * np.arange(RINGS + 1)))) - 90.0
    sector, ring = np.divmod(np.arange(SECTORS * RINGS), RINGS)
    sector, ring = sector[(sector + ring) % 2 == 0], ring[(sector + ring) % 2 == 0]
    west, east = 360 / SECTORS * sector, 360 / SECTORS * (sector + 1)
    outer, inner = lats[ring], lats[ring + 1]
    return np.stack([east, outer, west, outer, west, inner, east, inner], axis=-1).reshape(-1, 4, 2)


def draw(g: dict) -> Page:
    """The bubble and the hemisphere."""
    sketch = Sketch()
    for number, (name, view) in enumerate(VIEWS.items()):
        at = np.array([PITCH * number, 0.0])
        sketch.add_scene(ball(g, name), view, at=tuple(at))
        for place, text in zip(g[f"{name}_points"], NAMES[name], strict=True):
            sketch.add_label(at + view.project(place), text, (0, -10), halo=2.0)
    return sketch.page(EXTENT, width=PRINT_WIDTH)


def ball(g: dict, name: str) -> Scene:
    """A ball with the cells of the grid."""
    scene, sides = Scene(), from_rows(g[f"{name}_sides"])
    for k in range(0, len(sides), 4):
        color = fainter(VERMILION, 0.1) if k < 2 * RINGS else fainter(BLUE, 0.5)
        scene.add_region(sides[k : k + 4], name="cell", color=color)
    scene.add_circles([BUBBLE if name == "bubble" else SOUTH])
    scene.add_points(g[f"{name}_points"][:1], name="points")
    scene.add_points(g[f"{name}_points"][1:], name="ring")
    return scene


FIGURE = Figure("claim_interior", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
