r"""
Claims P5 and P6: right and wrong signs about a plane, flat and curved
======================================================================

Three points of the sphere (black) and many others: which of these are above the plane through the first? Those inside
their circle are. Each is tested in double precision, by the sign of Ax + By + Cz + D. The value is uncertain within a
strip about the plane (yellow), which is as thick as rounding makes it, whatever the size of the region. Above, the
plane from the side, with heights exaggerated: a region whose circle has a radius of 6 cm on the Earth does not rise out
of the strip. All its signs are uncertain and many are wrong (vermilion). Right, the same region lifted to a hemisphere
of a small sphere, as the paper proposes: all signs are right.

Chosen by us: the place and the sizes, the points on the circle, and the grid of the others.
"""

import numpy as np

from stereodel import RectangleLift, Stereographic, in_bubble
from stereodel.constants import UNIT_ROUNDOFF
from stereodel.drawing import DotStyle, Page, Sketch, with_legend
from stereodel.drawing.page.style import BLUE, GRAY, ORANGE, PRINT_WIDTH, VERMILION, fainter
from stereodel.earth import MEAN_RADIUS_KM
from stereodel.render import Figure

PLACE = (18.0, 52.0)  # degrees
NAMES = ("60 cm", "30 cm", "6 cm", "6 cm, lifted")
SIZES = np.array([60.0, 30.0, 6.0]) / (1e5 * MEAN_RADIUS_KM)  # radii of the circles in radians
THREE = np.array([[0.28, 0.96], [-0.96, -0.28], [0.8, -0.6]])  # in radii of the circle
REACH, STEP = 1.5, 0.044  # of the points about the centre, in radii of the circle, and from one to the next
STRIP = 4 * UNIT_ROUNDOFF  # half its thickness above the middle of the circle
ACROSS = np.linspace(-1.25, 1.25, 51)  # what is seen of the sphere from the side, in radii of the circle
PITCH, RADIUS, THICK, LENGTH = 4.25, 1.25, 0.1, 1.9  # cm: of panels, of the circle, of half the strip and the plane
SIDE = np.array([0.0, 3.0])  # the plane from the side, above the middle of the circle
EXTENT = (-2.0, 3 * PITCH + 2.0, -2.95, 4.3)
KINDS = {"above the plane": BLUE, "below": fainter(GRAY, 0.45), "uncertain": fainter(ORANGE, 0.4), "wrong": VERMILION}


def geometry() -> dict:
    """The grid; of each panel the kinds of its points, as numbers, and heights of the sphere over the plane, cm."""
    rows = np.arange(-REACH, REACH, STEP * np.sqrt(0.75))
    grid = np.array([[x + STEP / 2 * (k % 2), y] for k, y in enumerate(rows) for x in np.arange(-REACH, REACH, STEP)])
    grid = grid[np.hypot(*grid.T) < REACH]
    projection, places = Stereographic(PLACE), np.vstack([THREE, grid])
    flat = [projection.inverse(size * places) for size in SIZES]
    plane = projection.forward(flat[-1])
    lift = RectangleLift.fit(plane)
    radius = 1 / np.sin(np.radians(lift.sphere.angular_radius(SIZES[-1])))  # of the small sphere
    return {
        "grid": grid,
        "kinds": np.array([*(kinds(region, region) for region in flat), kinds(lift.forward(plane), flat[-1])]),
        "flat": THICK * SIZES[:, None] ** 2 * (1 - ACROSS**2) / (2 * STRIP),
        "curved": RADIUS * (np.sqrt(radius**2 - ACROSS**2) - np.sqrt(radius**2 - 1)),
    }


def kinds(tested: np.ndarray, true: np.ndarray) -> np.ndarray:
    """The number in `KINDS` of each point after the first three: the determinant in doubles, and the truth."""
    a, b, c, p = (*tested[:3], tested[3:])
    value = (np.cross(b - a, c - a) * (p - a)).sum(axis=-1)
    sides = [(a, b, c), (a, b, p), (b, c, p), (c, a, p)]
    areas = sum(np.linalg.norm(np.cross(y - x, z - x), axis=-1) for x, y, z in sides)
    # A rounded unit vector is up to two roundings above or below the sphere, and areas say how much that changes.
    uncertain = np.abs(value) <= 2 * UNIT_ROUNDOFF * areas
    exact = in_bubble(*true[:3, None], true[3:])
    return np.where(np.sign(value) != exact, 3, np.where(uncertain, 2, exact < 0))


def draw(g: dict) -> Page:
    """Three flat regions and a curved one."""
    sketch = Sketch()
    for number, (name, profile) in enumerate(zip(NAMES, [*g["flat"], g["curved"]], strict=True)):
        at = np.array([PITCH * number, 0.0])
        add_side(sketch, at + SIDE, THICK * (number < len(SIZES)), profile)
        add_points(sketch, at, g["grid"], g["kinds"][number])
        foot, wrong = at - [0.0, 2.0], int((g["kinds"][number] == 3).sum())
        sketch.add_label(foot, name, (0, -3), valign="top", size=10.0)
        sketch.add_label(foot, f"{wrong} of {len(g['grid'])} wrong", (0, -17), valign="top", color=VERMILION)
    return with_legend(sketch.page(EXTENT, width=PRINT_WIDTH), KINDS, columns=4, indent=30.0)


def add_side(sketch: Sketch, at: np.ndarray, thick: float, profile: np.ndarray) -> None:
    """The plane with its strip, and the sphere."""
    ends = at + LENGTH * np.array([[-1, 0], [1, 0]])
    strip = np.vstack([ends - [0.0, thick], ends[::-1] + [0.0, thick]])
    sketch.add_polygon(strip, name="strip", color=KINDS["uncertain"])
    sketch.add_segment(*ends, name="construction")
    sketch.add_graph(at[0] + RADIUS * ACROSS, at[1] + profile, name="arc")
    sketch.add_points(at + RADIUS * np.array([[-1, 0], [1, 0]]), name="sites")


def add_points(sketch: Sketch, at: np.ndarray, grid: np.ndarray, kinds: np.ndarray) -> None:
    """The points in the colours of their kinds, the circle and the three on it."""
    for kind, (name, color) in enumerate(KINDS.items()):
        if (kinds == kind).any():
            style = DotStyle(color, 0.55 if kind < 2 else 0.74)
            sketch.add_points(at + RADIUS * grid[kinds == kind], name=name.split()[0], style=style)
    sketch.add_circle(at, RADIUS, name="axis").add_points(at + RADIUS * THREE, name="sites")


FIGURE = Figure("claim_signs", geometry, draw, renderer="agg")

if __name__ == "__main__":
    FIGURE.main()
