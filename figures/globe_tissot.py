"""
Equal circles through a fisheye
===============================

Tissot's circles, 250 km in radius on the Earth, before and after a conformal map that shows the surroundings of a place
three times as large. Through the lens every circle of the globe is a circle of the globe, and every right angle of the
graticule is a right angle; only sizes change, from three times to, on the far side, a third. That circles look like
ellipses near the limb is the view's doing, on the left as on the right.
Chosen by us: the place, one of the circles' centres; the magnification; one circle about every 10°.
"""

import numpy as np

from stereodel import earth, fisheye
from stereodel.drawing import Page, View
from stereodel.globe import Globe, Panel, panels
from stereodel.render import Figure

FOCUS = (0.0, 40.0)
MAGNIFICATION = 3.0
RADIUS_KM = 250.0
VIEW = View(*FOCUS)


def geometry() -> dict:
    """The angular radius of the circles in degrees."""
    return {"radius": np.degrees(RADIUS_KM / earth.MEAN_RADIUS_KM)}


def draw(g: dict) -> Page:
    """The same globe twice, the second time through the lens."""
    globe = Globe()
    globe.add_land()
    globe.add_graticule(10)
    globe.add_coastlines()
    globe.add_tissot(10, g["radius"])
    lens = fisheye(FOCUS, magnification=MAGNIFICATION)
    return panels([Panel(globe, view=VIEW, title="without a lens"), Panel(globe, lens, VIEW, "magnified three times")])


FIGURE = Figure("globe_tissot", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
