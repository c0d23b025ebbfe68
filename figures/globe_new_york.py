"""
A New Yorker's globe
====================

What lies within 100 km of Manhattan fills one hemisphere, the rest of the world the other: the conformal map that takes
a bubble of the Earth onto half of it (claim P16 of the paper). Angles are true everywhere; the scale falls as the
square of the distance, so that Boston is still a place, Chicago a suburb, and the other continents are a spot.
Chosen by us: the radius, the labels, and that every dot is an airport with a code of three letters.
"""

import numpy as np
from _poster import captioned

from stereodel import SphereCircle, bubble_to_bubble, data, earth
from stereodel.drawing import Page
from stereodel.drawing.style import BLACK, DARK_GRAY, VERMILION, WHITE, DotStyle
from stereodel.globe import Globe, Panel, hemispheres, panels
from stereodel.render import Figure

NEW_YORK = (-73.98, 40.75)
RADIUS_KM = 100.0
NAMES_RIGHT = {
    "Manhattan": (-73.98, 40.77),
    "JFK": (-73.78, 40.64),
    "Newark": (-74.17, 40.69),
    "Staten Island": (-74.15, 40.57),
    "Princeton": (-74.66, 40.35),
    "West Point": (-73.96, 41.39),
    "Boston": (-71.06, 42.36),
    "Washington": (-77.04, 38.91),
    "Albany": (-73.76, 42.65),
    "Montréal": (-73.57, 45.50),
    "Pittsburgh": (-80.0, 40.44),
    "Toronto": (-79.38, 43.65),
    "New Haven": (-72.93, 41.31),
    "Cape Cod": (-70.05, 41.75),
}
NAMES_LEFT = {
    "Long Island": (-73.16, 40.80),
    "Philadelphia": (-75.16, 39.95),
    "Bermuda": (-64.78, 32.30),
}


def geometry() -> dict:
    """Where the airports are, and the angular radius of the bubble in degrees."""
    table = data.airports()
    return {"airports": table.lonlat[table.iata != ""], "radius": np.degrees(RADIUS_KM / earth.MEAN_RADIUS_KM)}


def draw(g: dict) -> Page:
    """The two hemispheres, seen from above their middles."""
    globe = Globe()
    globe.add_land(resolution="10m")
    globe.add_lakes()
    globe.add_rivers(resolution="10m")
    globe.add_coastlines(resolution="10m")
    globe.add_graticule(15)
    globe.add_points(g["airports"], style=DotStyle(VERMILION, 0.75))
    for names, offset in ((NAMES_RIGHT, (3.0, 0.0)), (NAMES_LEFT, (-3.0, 0.0))):
        globe.add_points(list(names.values()), style=DotStyle(DARK_GRAY, 1.3, rim=WHITE, rim_width=0.3))
        globe.add_labels(list(names.values()), names, size=7.0, offset=offset, halo=1.2)
    lens = bubble_to_bubble(SphereCircle.around(NEW_YORK, g["radius"]), SphereCircle.around(NEW_YORK, 90.0))
    near, far = hemispheres(*NEW_YORK)
    page = panels([Panel(globe, lens, near, "New York"), Panel(globe, lens, far, "everything else")])
    return captioned(
        page,
        "A New Yorker’s globe",
        "Half of it lies within 100 km of Manhattan, the other half is the rest of the world; every angle is true.",
        "Land, rivers, lakes: Natural Earth. Airports: airportsdata.",
        ink=BLACK,
        above=46.0,
        below=16.0,
    )


FIGURE = Figure("globe_new_york", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
