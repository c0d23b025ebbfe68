"""A page with an item of each kind, named after what maps have, in red."""

import numpy as np

from stereodel.drawing.page import Ball, Dots, Fill, Label, Page, Picture, Polygons, Polylines, Stroke, style

RED, BALL = (1.0, 0.0, 0.0, 1.0), Ball((0.0, 0.0), 1.0)
LOOP = np.array([[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]]])
SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 0.0)])
ROWS = np.array([0, 4, 8])


class Painted:
    """A painter without pixels."""

    def arrays(self):
        return {}


def page():
    several = np.array([RED, (0, 0, 1, 1)])
    items = (
        Fill((LOOP,), RED, "ball", BALL),
        Polygons(SQUARE, ROWS[:2], np.array([0]), np.array([RED]), BALL, "land"),
        Polygons(np.concatenate([SQUARE, SQUARE + 2]), ROWS, np.array([0, 1]), several, name="cells"),
        Stroke(LOOP, RED, 1.0, name="limb"),
        Polylines(SQUARE, ROWS[:2], RED, 1.0, "coast"),
        Dots(SQUARE, 2.0, RED, style.WHITE, 0.5, "sites"),
        Label("name", (0.0, 0.0), color=RED, halo=1.0),
        Picture((LOOP,), Painted()),
    )
    return Page((0.0, 4.0, 0.0, 4.0), items)
