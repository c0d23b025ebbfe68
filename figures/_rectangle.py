"""The rectangle of Figures 7 and 8, its sites and its lift."""

from collections.abc import Callable

import numpy as np
from _sites import in_rectangle

from stereodel import RectangleLift
from stereodel.sphere import SphereArc, SphereCircle

WIDTH, HEIGHT = 3.0, 2.0  # map units
SITES, HULL, SEED, MARGIN = 48, 21, 113, 0.08
CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [WIDTH / 2, HEIGHT / 2]


def sites() -> np.ndarray:
    """Sites spread over the rectangle, (n, 2)."""
    return in_rectangle(SITES, HULL, WIDTH, HEIGHT, SEED, margin=MARGIN)


def lift() -> RectangleLift:
    """The tangent sphere whose diameter is half the diagonal."""
    return RectangleLift(WIDTH, HEIGHT)


def lifted_sides(raised: Callable[[np.ndarray], np.ndarray]) -> list[SphereArc]:
    """The images of the four sides on a sphere: each the arc of the circle through its lifted ends and middle."""
    ends = np.stack([CORNERS, np.roll(CORNERS, -1, axis=0)], axis=1)
    return [
        SphereArc(SphereCircle.through(start, middle, end), start, end)
        for start, middle, end in raised(np.stack([ends[:, 0], ends.mean(axis=1), ends[:, 1]], axis=1))
    ]
