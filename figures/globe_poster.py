"""
Mare nostrum: a poster
======================

The Mediterranean three and a half times as large as its part of the globe, with the coasts, rivers, lakes and borders
for maps of 1 : 10 million. ``make poster`` draws it 16 384 pixels across, in tiles.
Chosen by us: focus, magnification, colours, the cities and the seas.
"""

from dataclasses import replace

import numpy as np
from _poster import in_words

from stereodel import MoebiusMap, earth, fisheye
from stereodel.drawing import Label, Page, Stroke
from stereodel.drawing.page.style import DotStyle, LineStyle, with_opacity
from stereodel.globe import Globe
from stereodel.render import Figure

FOCUS = (17.0, 38.5)
MAGNIFICATION = 3.5
MILLION = 10  # of the scale for which coasts and rivers are made
RESOLUTION = f"{MILLION}m"
SEA = (0.14, 0.30, 0.41, 1.0)
LAND = (0.95, 0.90, 0.79, 1.0)
BORDER = (0.62, 0.47, 0.36, 1.0)
INK = (0.18, 0.14, 0.11, 1.0)
CREAM = (0.97, 0.93, 0.83, 1.0)
GOLD = (0.87, 0.74, 0.45, 1.0)
BRONZE = (0.70, 0.55, 0.27, 1.0)
NIGHT = (0.05, 0.09, 0.14, 1.0)

CITIES = {
    "Rome": (12.50, 41.90),
    "Cairo": (31.24, 30.04),
    "Istanbul": (28.98, 41.01),
    "Izmir": (27.14, 38.42),
    "Beirut": (35.50, 33.89),
    "Naples": (14.27, 40.85),
    "Split": (16.44, 43.51),
    "Vienna": (16.37, 48.21),
    "Kyiv": (30.52, 50.45),
    "Moscow": (37.62, 55.76),
    "Berlin": (13.40, 52.52),
    "Paris": (2.35, 48.86),
    "Lisbon": (-9.14, 38.72),
    "Seville": (-5.98, 37.39),
    "Belgrade": (20.46, 44.79),
    "Fès": (-5.00, 34.03),
    "Barcelona": (2.17, 41.39),
    "Madrid": (-3.70, 40.42),
    "Nice": (7.26, 43.70),
    "Venice": (12.34, 45.44),
    "Athens": (23.73, 37.98),
    "London": (-0.13, 51.51),
    "Odesa": (30.72, 46.48),
    "Tunis": (10.17, 36.81),
    "Algiers": (3.06, 36.75),
    "Tripoli": (13.19, 32.89),
    "Benghazi": (20.07, 32.12),
    "Valletta": (14.51, 35.90),
    "Palermo": (13.36, 38.12),
}
SEAS = {
    "Tyrrhenian Sea": (12.4, 39.5),
    "Ionian Sea": (19.4, 36.1),
    "Balearic Sea": (4.9, 40.9),
    "Adriatic": (15.9, 42.6),
    "Levantine Sea": (29.5, 33.9),
    "Black Sea": (34.5, 43.2),
    "Bay of Biscay": (-7.0, 45.9),
    "North Sea": (3.0, 56.4),
}
CITY_TYPE, SEA_TYPE = {"size": 6.2, "halo": 0.9}, {"size": 7.0, "halo": 0.0}
BAR_KM = 200


def draw(g: dict) -> Page:
    """The globe on a dark ground, its title below."""
    globe = Globe(ocean=SEA, limb=LineStyle(GOLD, 0.8))
    globe.add_land(resolution=RESOLUTION, color=LAND)
    globe.add_graticule(10, style=LineStyle(with_opacity(BRONZE, 0.8), 0.25))
    globe.add_lakes(resolution=RESOLUTION, color=SEA)
    globe.add_rivers(resolution=RESOLUTION, style=LineStyle(SEA, 0.22))
    globe.add_borders(resolution=RESOLUTION, style=LineStyle(BORDER, 0.25))
    globe.add_coastlines(resolution=RESOLUTION, style=LineStyle(INK, 0.25))
    globe.add_labels(list(SEAS.values()), SEAS, offset=(0.0, 0.0), font="italic", color=CREAM, movable=True, **SEA_TYPE)
    globe.add_points(list(CITIES.values()), style=DotStyle(INK, 1.1, rim=LAND, rim_width=0.3))
    globe.add_labels(list(CITIES.values()), CITIES, offset=(2.6, 0.0), color=(INK, CREAM), movable=True, **CITY_TYPE)
    lens = fisheye(FOCUS, magnification=MAGNIFICATION)
    return framed(with_scale(globe.page(lens), lens))


def with_scale(page: Page, lens: MoebiusMap) -> Page:
    """The page with a bar of 200 km at the scale of the focus, which lies in the middle."""
    left, right, bottom, top = page.extent
    radius = page.points_per_unit  # points for the radius of the globe
    length = BAR_KM / earth.MEAN_RADIUS_KM * float(lens.scale_factor(lens.focus))
    x, y = (left + right - length) / 2, (bottom + top) / 2 - 0.075
    path = np.array([[[x + share * length, y] for share in (0, 1 / 3, 2 / 3, 1)]])
    ticks = [
        np.array([[[x + end * length, y + share * 4 / radius] for share in (0, 1 / 3, 2 / 3, 1)]]) for end in (0, 1)
    ]
    lines = tuple(Stroke(each, CREAM, 0.5, name="scale") for each in (path, *ticks))
    text = Label(f"{BAR_KM} km", (x + length / 2, y), (0.0, -2.5), valign="top", size=6.2, color=CREAM)
    return replace(page, items=(*page.items, *lines, text))


def framed(page: Page) -> Page:
    """A margin all round, and the title in the middle below."""
    left, right, bottom, top = page.extent
    size, middle = right - left, (left + right) / 2
    margin, foot = 0.05 * size, 0.26 * size

    def line(text: str, below: float, points: float) -> Label:
        return Label(text, (middle, bottom - below * size), valign="baseline", size=points, color=GOLD)

    texts = (
        line("M A R E   N O S T R U M", 0.115, 22.0),
        line(
            f"The Mediterranean through a conformal fisheye: {in_words(MAGNIFICATION)} times as large, "
            "every angle true.",
            0.165,
            8.0,
        ),
        line(
            f"Magnification {MAGNIFICATION:g} about {FOCUS[1]:g}° N, {FOCUS[0]:g}° E. "
            f"Natural Earth, 1 : {MILLION} million.",
            0.215,
            6.0,
        ),
    )
    extent = (left - margin, right + margin, bottom - foot, top + margin)
    return replace(page, extent=extent, items=(*page.items, *texts), background=NIGHT)


FIGURE = Figure("globe_poster", dict, draw)

if __name__ == "__main__":
    FIGURE.main()
