"""
Equal circles through a fisheye
===============================

Tissot's circles, 250 km in radius on the Earth, before and after a conformal map that magnifies the surroundings of a
place three times. Under the map every circle of the globe remains a circle, and every right angle of the graticule a
right angle; only sizes change, by factors from three to, on the far side, a third. Circles look like ellipses near the
limb because of the orthographic view, on the left as on the right.
Chosen by us: the place, one of the circles' centres; the magnification; one circle about every 10°.
"""

import numpy as np
from _poster import captioned, in_words

from stereodel import earth, fisheye
from stereodel.drawing import Page, View
from stereodel.drawing.page.style import BLACK
from stereodel.globe import Globe, Panel, panels
from stereodel.render import Figure

FOCUS = (0.0, 40.0)
MAGNIFICATION = 3.0
RADIUS_KM = 250.0
SPACING = 10  # degrees
VIEW = View(*FOCUS)
NUMBERED = ((0.0, 40.0), (-360 / 28, 40.0), (180 / 23, 50.0))  # of 28 and 23 circles on a parallel


def geometry() -> dict:
    """The angular radius of the circles in degrees."""
    return {"radius": np.degrees(RADIUS_KM / earth.MEAN_RADIUS_KM)}


def draw(g: dict) -> Page:
    """The same globe twice, the second time through the lens."""
    globe = Globe()
    globe.add_land()
    globe.add_graticule(SPACING)
    globe.add_coastlines()
    globe.add_tissot(SPACING, g["radius"])
    globe.add_labels(NUMBERED, map(str, range(1, len(NUMBERED) + 1)), offset=(0.0, 0.0), size=7.5, halo=1.0)
    lens = fisheye(FOCUS, magnification=MAGNIFICATION)
    magnified = f"magnified {in_words(MAGNIFICATION)} times"
    page = panels([Panel(globe, view=VIEW, title="without a lens"), Panel(globe, lens, VIEW, magnified)])
    return captioned(
        page,
        f"Circles of {RADIUS_KM:.0f} km stay circles",
        f"Orange: all that lies within that distance of a place, one about every {SPACING}°. The numbers mark the same "
        f"{in_words(len(NUMBERED))} circles on both globes.",
        "Land and coast: Natural Earth.",
        ink=BLACK,
        above=46.0,
        below=16.0,
    )


FIGURE = Figure("globe_tissot", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
