"""The rectangle of Figures 7 and 8, its sites and its lift."""

import numpy as np
from _sites import in_rectangle

from stereodel import RectangleLift

WIDTH, HEIGHT = 3.0, 2.0  # map units
SITES, SEED, MARGIN = 48, 8, 0.06
CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [WIDTH / 2, HEIGHT / 2]


def sites() -> np.ndarray:
    """Sites spread over the rectangle, (n, 2)."""
    return in_rectangle(SITES, WIDTH, HEIGHT, SEED, margin=MARGIN)


def lift() -> RectangleLift:
    """The tangent sphere whose diameter is half the diagonal."""
    return RectangleLift(WIDTH, HEIGHT)
