"""
Animation: the fisheye grows from 1 to 20
=========================================

A globe with the graticule at 5° (gray) and a fine grid at 1/2° about 40° N (black) while the magnification S of the
fisheye runs from 1 to 20 and back, in equal ratios. The focus stays where it is; every line stays a circle.
"""

from functools import partial

import numpy as np

from stereodel import fisheye
from stereodel.drawing import Label, Page, Scene, View
from stereodel.film import Film
from stereodel.sphere import SphereArc, graticule, graticule_patch

FOCUS = (0.0, 40.0)  # degrees
COARSE, FINE, HALF_WIDTH = 5.0, 0.5, 1.5  # degrees
LARGEST, STEPS = 20.0, 28
VIEW = View(0, 22)


def magnifications() -> np.ndarray:
    """Up to the largest and back; sin² eases both turns."""
    phase = np.arange(2 * STEPS) / (2 * STEPS)
    return LARGEST ** (np.sin(np.pi * phase) ** 2)


def frame(magnification: float, coarse: list[SphereArc], fine: list[SphereArc]) -> Page:
    """The globe with both grids at one magnification."""
    bend = fisheye(FOCUS, magnification=magnification)
    scene = Scene()
    for arcs, name in ((coarse, "graticule"), (fine, "fine")):
        scene.add_arcs((bend.image_of(arc) for arc in arcs), name=name)
    caption = Label(f"$S = {magnification:.1f}$", (-1.0, 0.99), align="left", valign="top")
    return Page((-1.04, 1.04, -1.04, 1.04), (*scene.layout(VIEW), caption), width=150.0, views=(VIEW.matrix,))


def film() -> Film:
    """One shot for each magnification."""
    coarse, fine = graticule(COARSE), graticule_patch(FOCUS, HALF_WIDTH, FINE)
    return Film(partial(frame, coarse=coarse, fine=fine), magnifications().tolist(), seconds=0.08, size=480)


if __name__ == "__main__":
    film().main()
