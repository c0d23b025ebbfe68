"""
A New Yorker's globe
====================

The region within 100 km of Manhattan fills one hemisphere, the rest of the world the other, under the conformal map
that takes a bubble of the Earth onto half of it (claim P16 of the paper). Angles are preserved everywhere; the scale
falls with the square of the distance, so that Boston is still well apart, while the other continents are close to the
antipode of New York. The small globe shows these: the same map of a larger bubble, whose circle is drawn on the second
globe, too.
Chosen by us: the radii, the labels, and that every dot is an airport with a three-letter code; where dots would touch,
only those nearer to New York are drawn.
"""

from dataclasses import replace

import numpy as np
from _poster import captioned

from stereodel import MoebiusMap, SphereCircle, bubble_to_bubble, data, earth, lonlat_to_xyz
from stereodel.curves.chart import Chart
from stereodel.drawing import Dots, Label, LineStyle, Page, Stroke, View
from stereodel.drawing.page import Item
from stereodel.drawing.page.items import straight
from stereodel.drawing.page.labels import haloed
from stereodel.drawing.page.style import BLACK, DARK_GRAY, VERMILION, WHITE, DotStyle
from stereodel.globe import Globe, Panel, hemispheres, panels
from stereodel.render import Figure

NEW_YORK = (-73.98, 40.75)
RADIUS_KM = 100.0
FAR_KM = 4000.0  # what is farther is on the small globe
MILLION = 10  # of the scale for which coasts and rivers are made
APART = 0.028  # between dots, radii of the globes
INSET, INSET_AT = 0.32, (-0.41, -0.48)  # its radius, and where it stands from the middle of a globe, radii of that
AIRPORT = DotStyle(VERMILION, 0.75)
PLACE = DotStyle(DARK_GRAY, 1.3, rim=WHITE, rim_width=0.3)
EDGE = LineStyle(DARK_GRAY, 0.5)
LEADER = (DARK_GRAY, 0.3)
NAMES = {
    "Manhattan": (-73.98, 40.77),
    "JFK": (-73.78, 40.64),
    "Newark": (-74.17, 40.69),
    "Staten Island": (-74.15, 40.57),
    "Long Island": (-73.16, 40.80),
    "Princeton": (-74.66, 40.35),
    "West Point": (-73.96, 41.39),
    "Boston": (-71.06, 42.36),
    "Washington": (-77.04, 38.91),
    "Albany": (-73.76, 42.65),
    "Montréal": (-73.57, 45.50),
    "Pittsburgh": (-80.0, 40.44),
    "Toronto": (-79.38, 43.65),
    "New Haven": (-72.93, 41.31),
    "Philadelphia": (-75.16, 39.95),
    "Cape Cod": (-70.05, 41.75),
    "Bermuda": (-64.78, 32.30),
}
FAR = {
    "Europe": (20.0, 53.0),
    "Africa": (20.0, 8.0),
    "South America": (-62.0, -28.0),
    "Asia": (95.0, 45.0),
    "Australia": (134.0, -25.0),
}


def degrees(distance: float) -> float:
    """The angle at the middle of the Earth of a distance in kilometres."""
    return float(np.degrees(distance / earth.MEAN_RADIUS_KM))


def lens_of(radius: float) -> MoebiusMap:
    """The map that takes a bubble about New York, of a radius in degrees, onto a hemisphere."""
    return bubble_to_bubble(SphereCircle.around(NEW_YORK, radius), SphereCircle.around(NEW_YORK, 90.0))


def geometry() -> dict:
    """Where airports are that keep their distance through the lens, and the angular radius of the bubble in degrees."""
    table = data.airports()
    lonlat = table.lonlat[table.iata != ""]
    images = lens_of(degrees(RADIUS_KM))(lonlat_to_xyz(lonlat))
    # From New York outward: those that are nearer win.
    kept: list[int] = []
    for row in np.argsort(-images @ lonlat_to_xyz(NEW_YORK), kind="stable").tolist():
        if not kept or (np.sum((images[kept] - images[row]) ** 2, axis=1) > APART**2).all():
            kept.append(row)
    return {"airports": lonlat[kept], "radius": degrees(RADIUS_KM)}


def draw(g: dict) -> Page:
    """The two hemispheres, seen from above their middles."""
    globe = Globe()
    globe.add_land(resolution=f"{MILLION}m")
    globe.add_lakes()
    globe.add_rivers(resolution=f"{MILLION}m")
    globe.add_coastlines(resolution=f"{MILLION}m")
    globe.add_graticule(15)
    globe.add_circles([SphereCircle.around(NEW_YORK, degrees(FAR_KM))], color=None, style=EDGE)
    globe.add_points(g["airports"], style=AIRPORT)
    globe.add_points(list(NAMES.values()), style=PLACE)
    globe.add_labels(list(NAMES.values()), NAMES, size=7.0, offset=(3.0, 0.0), halo=1.2, movable=True)
    lens = lens_of(g["radius"])
    near, far = hemispheres(*NEW_YORK)
    page = panels([Panel(globe, lens, near, "New York"), Panel(globe, lens, far, "everything else")])
    middle = np.array([3 * page.extent[1] / 4, page.extent[1] / 4])
    page = haloed(replace(page, items=(*page.items, *inset(middle, lens, far, page.points_per_unit))))
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


def inset(middle: np.ndarray, lens: MoebiusMap, view: View, unit: float) -> list[Item]:
    """A small globe of what is far, and lines to it from the circle that it magnifies, about the middle of a globe."""
    globe = Globe(limb=EDGE)
    globe.add_land(resolution="110m")
    globe.add_coastlines(resolution="110m", style=LineStyle(DARK_GRAY, 0.3))
    globe.add_labels(list(FAR.values()), FAR, size=6.0, offset=(0.0, 0.0), halo=1.0, font="italic", movable=True)
    at = tuple((middle + INSET_AT).tolist())
    chart = Chart(lens_of(degrees(FAR_KM)), view, at, INSET, 0.02 / unit, unit)
    ring = np.hypot(*view.project(lens(lonlat_to_xyz((NEW_YORK[0], NEW_YORK[1] - degrees(FAR_KM))))))
    # Lines that touch both circles, at the ends of parallel radii.
    ahead = np.angle(complex(*INSET_AT)) + np.array([1, -1]) * np.arccos((ring - INSET) / np.hypot(*INSET_AT))
    radii = np.stack([np.cos(ahead), np.sin(ahead)], axis=1)
    ends = np.stack([middle + ring * radii, at + INSET * radii], axis=1)
    text = Label(f"beyond {FAR_KM:g} km", at, (0.75 * INSET * unit, -0.9 * INSET * unit), "left", size=7.0)
    return [*(Stroke(straight(line), *LEADER, name="leader") for line in ends), *globe.items(chart), text]


def legend(page: Page) -> list[Item]:
    """What a dot is, at the right of the subtitle."""
    point = 1 / page.points_per_unit
    x, y = page.extent[1] - 78 * point, page.extent[3] - 35 * point
    text = Label("airport with a code", (x, y), (5.0, 0.0), "left", "center", size=7.0)
    return [Dots(np.array([[x, y]]), 1.2, AIRPORT.color, name="legend"), text]


FIGURE = Figure("globe_new_york", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
