"""
A New Yorker's globe
====================

The region within 100 km of Manhattan fills one hemisphere, the rest of the world the other, under the conformal map
that takes a bubble of the Earth onto half of it (claim P16 of the paper). Angles are preserved everywhere; the scale
falls with the square of the distance, so that Boston is still well apart, while Chicago and the other continents are
close to the antipode of New York.
Chosen by us: the radius, the labels, and that every dot is an airport with a three-letter code; where dots would touch,
only those nearer to New York are drawn.
"""

from dataclasses import replace

import numpy as np
from _poster import captioned

from stereodel import MoebiusMap, SphereCircle, bubble_to_bubble, data, earth, lonlat_to_xyz
from stereodel.drawing import Dots, Label, Page, Stroke, View
from stereodel.drawing.page import Item
from stereodel.drawing.page.labels import haloed
from stereodel.drawing.page.style import BLACK, DARK_GRAY, VERMILION, WHITE, DotStyle
from stereodel.globe import Globe, Panel, hemispheres, panels
from stereodel.render import Figure

NEW_YORK = (-73.98, 40.75)
RADIUS_KM = 100.0
MILLION = 10  # of the scale for which coasts and rivers are made
APART = 0.028  # between dots, radii of the globes
AIRPORT = DotStyle(VERMILION, 0.75)
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
FAR = {
    "Europe": ((5.0, 48.0), (-0.30, 0.085), "right"),
    "Africa": ((18.0, 5.0), (-0.38, 0.0), "right"),
    "South America": ((-60.0, -10.0), (-0.10, -0.28), "right"),
    "Asia": ((95.0, 45.0), (-0.06, -0.195), "right"),
    "California": ((-120.0, 37.0), (0.30, -0.20), "left"),
}
"""Where it is, where its name stands in radii from the middle of the globe, and on which side."""


def lens_of(radius: float) -> MoebiusMap:
    """The map that takes the bubble about New York onto a hemisphere."""
    return bubble_to_bubble(SphereCircle.around(NEW_YORK, radius), SphereCircle.around(NEW_YORK, 90.0))


def geometry() -> dict:
    """Where airports are that keep their distance through the lens, and the angular radius of the bubble in degrees."""
    table = data.airports()
    radius = np.degrees(RADIUS_KM / earth.MEAN_RADIUS_KM)
    lonlat = table.lonlat[table.iata != ""]
    images = lens_of(radius)(lonlat_to_xyz(lonlat))
    # From New York outward: those that are nearer win.
    kept: list[int] = []
    for row in np.argsort(-images @ lonlat_to_xyz(NEW_YORK), kind="stable").tolist():
        if not kept or (np.sum((images[kept] - images[row]) ** 2, axis=1) > APART**2).all():
            kept.append(row)
    return {"airports": lonlat[kept], "radius": radius}


def draw(g: dict) -> Page:
    """The two hemispheres, seen from above their middles."""
    globe = Globe()
    globe.add_land(resolution=f"{MILLION}m")
    globe.add_lakes()
    globe.add_rivers(resolution=f"{MILLION}m")
    globe.add_coastlines(resolution=f"{MILLION}m")
    globe.add_graticule(15)
    globe.add_points(g["airports"], style=AIRPORT)
    for names, offset in ((NAMES_RIGHT, (3.0, 0.0)), (NAMES_LEFT, (-3.0, 0.0))):
        globe.add_points(list(names.values()), style=DotStyle(DARK_GRAY, 1.3, rim=WHITE, rim_width=0.3))
        globe.add_labels(list(names.values()), names, size=7.0, offset=offset, halo=1.2)
    lens = lens_of(g["radius"])
    near, far = hemispheres(*NEW_YORK)
    page = panels([Panel(globe, lens, near, "New York"), Panel(globe, lens, far, "everything else")])
    page = haloed(replace(page, items=(*page.items, *leaders(page, lens, far))))
    scale = float(lens.scale_factor(lonlat_to_xyz(NEW_YORK)))
    page = captioned(
        page,
        "A New Yorker’s globe",
        f"Half of it lies within {RADIUS_KM:g} km of Manhattan, the other half is the rest of the world; every "
        "angle is true.",
        f"Land, rivers, lakes: Natural Earth, made for 1 : {MILLION} million and here, in the middle of New York, "
        f"enlarged {scale:.0f} times. Airports: airportsdata.",
        ink=BLACK,
        above=46.0,
        below=16.0,
    )
    return replace(page, items=(*page.items, *legend(page)))


def leaders(page: Page, lens: MoebiusMap, view: View) -> list[Item]:
    """Names of what is too small to be written on, at lines that lead to it."""
    middle = np.array([3 * page.extent[1] / 4, page.extent[1] / 4])
    items: list[Item] = []
    for name, (lonlat, end, align) in FAR.items():
        place = middle + view.project(lens(lonlat_to_xyz(lonlat)))
        tip = middle + end
        path = (place + np.linspace(0.0, 1.0, 4)[:, None] * (tip - place))[None]
        items.append(Stroke(path, DARK_GRAY, 0.4, name="leader"))
        shift = {"left": (2.0, 0.0), "right": (-2.0, 0.0)}[align]
        items.append(Label(name, tuple(tip.tolist()), shift, align, "center", size=7.0, halo=1.2, on_ground=True))
    return items


def legend(page: Page) -> list[Item]:
    """What a dot is, at the right of the subtitle."""
    point = 1 / page.points_per_unit
    x, y = page.extent[1] - 78 * point, page.extent[3] - 35 * point
    text = Label("airport with a code", (x, y), (5.0, 0.0), "left", "center", size=7.0)
    return [Dots(np.array([[x, y]]), 1.2, AIRPORT.color, name="legend"), text]


FIGURE = Figure("globe_new_york", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
