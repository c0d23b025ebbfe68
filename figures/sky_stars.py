"""
Every star its own sky
======================

The Voronoi cells of the 117 955 stars of the Hipparcos catalogue, on the half of the sky about the galactic anticentre,
seen from inside, the galactic equator across the middle. Small cells are light: the Milky Way and Orion are visible by
the number of their stars alone. The colour shows the area of a cell, smoothed: eight times in turn, each takes the mean
of itself and its neighbours. The stars brighter than magnitude 4.5 are drawn in their own colours, with faint lines for
some constellations.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
from _poster import captioned, spaced, with_legend

from stereodel import SphericalVoronoi, data, lonlat_to_xyz
from stereodel.drawing import ColorScale, Page, View
from stereodel.drawing.page.style import DotStyle, LineStyle, with_opacity
from stereodel.globe import Globe
from stereodel.render import Figure

CENTER, POLE = (266.40499, -28.93617), (192.85948, 27.12825)  # of the galaxy, ICRS
VIEW = View(180, 0)
SCALE = ColorScale("bone_r", 0.14, 0.64, "log")  # square degrees
TICKS = (0.15, 0.2, 0.3, 0.4, 0.6)
BRIGHT, SMOOTHED = 4.5, 8
NIGHT, INK = (0.02, 0.022, 0.035, 1.0), (0.9, 0.9, 0.92, 1.0)
NAMES = {
    "above": {24608: "Capella", 21421: "Aldebaran", 37279: "Procyon", 37826: "Pollux"},
    "right": {32349: "Sirius", 27989: "Betelgeuse", 30438: "Canopus", 17702: "Pleiades"},
    "below": {24436: "Rigel"},
}
FIGURES = {
    "Orion": [(27989, 26207, 25336, 25930, 24436, 27366, 26727, 27989), (25930, 26311, 26727), (27989, 25336)],
    "Auriga": [(24608, 28360, 28380, 25428, 23015, 24608)],
    "Taurus": [(25428, 20889, 20205, 21421, 26451)],
    "Gemini": [(36850, 37826)],
    "Canis Major": [(30324, 32349, 34444, 33579), (34444, 35904)],
    "Canis Minor": [(37279, 36188)],
    "Perseus": [(14328, 15863, 17358, 18532), (15863, 14576)],
    "Cassiopeia": [(8886, 6686, 4427, 3179, 746)],
}
"""Constellations about the anticentre, from star to star by their numbers in the catalogue."""
NAMED = {"Orion": (36.0, 0.0), "Auriga": (0.0, 0.0)}
"""Those that are named, and how far from their middle, points."""
OFFSETS = {"above": (0.0, 5.0), "right": (5.0, 0.0), "below": (0.0, -5.0)}


def galactic() -> np.ndarray:
    """Rows: centre, galactic longitude 90° reversed, because the sky is seen from inside, and pole."""
    pole, center = lonlat_to_xyz(POLE), lonlat_to_xyz(CENTER)
    across = np.cross(pole, center)
    across /= np.linalg.norm(across)
    return np.stack([np.cross(across, pole), -across, pole])


def geometry() -> dict:
    """Cells and areas in square degrees, places, magnitudes and colours of the stars."""
    table = data.stars()
    voronoi = SphericalVoronoi(lonlat_to_xyz(table.lonlat) @ galactic().T)
    areas = np.degrees(np.degrees(voronoi.areas()))
    for _ in range(SMOOTHED):
        areas = mean_with_neighbors(areas, voronoi.ridge_points)
    return {
        "points": voronoi.points,
        "areas": areas,
        "magnitude": table.magnitude,
        "color_index": table.color_index,
    }


def mean_with_neighbors(values: np.ndarray, pairs: np.ndarray) -> np.ndarray:
    """Of each cell and those that share a ridge with it."""
    total, count = values.copy(), np.ones(len(values))
    for own, other in (pairs.T, pairs.T[::-1]):
        total += np.bincount(own, values[other], minlength=len(values))
        count += np.bincount(own, minlength=len(values))
    return total / count


def star_color(index: float) -> tuple:
    """A tint after the colour index B − V: blue below 0, white, orange above 1.5."""
    stops = np.array([(0.66, 0.76, 1.0), (0.95, 0.96, 1.0), (1.0, 0.93, 0.8), (1.0, 0.72, 0.45)])
    return (*(float(np.interp(index, (-0.2, 0.25, 0.7, 1.6), channel)) for channel in stops.T), 1.0)


def figure_lines(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where the lines of the constellations begin and end."""
    row = {hip: number for number, hip in enumerate(data.stars().hip.tolist())}
    pairs = [(a, b) for lines in FIGURES.values() for line in lines for a, b in pairwise(line)]
    first, last = np.array([(row[a], row[b]) for a, b in pairs]).T
    return points[first], points[last]


def draw(g: dict) -> Page:
    """Cells by area, bright stars by magnitude and colour, the names of the brightest."""
    globe = Globe(limb=LineStyle((0.4, 0.42, 0.5, 1.0), 0.6))
    globe.add_cells(SphericalVoronoi(g["points"]), colors=SCALE(g["areas"]), style=None)
    globe.add_great_circles(*figure_lines(g["points"]), style=LineStyle(with_opacity(INK, 0.35), 0.6), name="figures")
    for star in np.flatnonzero(g["magnitude"] < BRIGHT):
        radius = 0.55 + 0.5 * (BRIGHT - g["magnitude"][star])
        look = DotStyle(star_color(g["color_index"][star]), radius, rim=NIGHT, rim_width=0.3)
        globe.add_points(g["points"][star], style=look)
    for place, names in NAMES.items():
        stars = [int(np.flatnonzero(data.stars().hip == hip)[0]) for hip in names]
        globe.add_labels(g["points"][stars], names.values(), offset=OFFSETS[place], size=8.0, color=INK, halo=0.0)
    for name, offset in NAMED.items():
        stars = np.isin(data.stars().hip, np.concatenate(FIGURES[name]))
        middle, text = g["points"][stars].mean(axis=0), rf"$\mathit{{{name}}}$"
        globe.add_labels(middle, [text], offset=offset, size=11.0, color=INK, halo=0.0, formulas=True)
    count = spaced(len(g["areas"]))
    subtitle = f"{count} stars of the Hipparcos catalogue, each with the part of the sky that is nearest to it"
    credit = (
        "Stars: Hipparcos, the new reduction (ESA; F. van Leeuwen, 2007). "
        "Seen from inside, the galactic anticentre in the middle, galactic north up."
    )
    page = captioned(globe.page(view=VIEW), "Every star its own sky", subtitle, credit, ink=INK)
    page = with_legend(page, SCALE, "area, square degrees", ink=INK, at=TICKS, ends=("dense", "sparse"))
    return replace(page, background=NIGHT)


FIGURE = Figure("sky_stars", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
