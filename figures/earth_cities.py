"""
Where people live
=================

The Voronoi cells of all cities and villages of the table whose population is known, 204 228 of 234 908; those at the
same point are combined. The colour shows population density: the inhabitants of a place per km² of its cell on the
ellipsoid. Only the land part of cells that extend into the sea is shown.
"""

from dataclasses import replace

import numpy as np
from _poster import LATITUDE, captioned, spaced, with_legend

from stereodel import SphericalVoronoi, data, earth
from stereodel.drawing import ColorScale, Page, View
from stereodel.drawing.page.style import LineStyle
from stereodel.globe import Globe
from stereodel.render import Figure

VIEW = View(68, 28)
EMBERS = ("#340a5f", "#5c126e", "#801f6c", "#a62d60", "#c83f4b", "#e55c30", "#f78212", "#fcac11", "#f5db4c", "#fcffa4")
"""Those of inferno, but for the black: land without people is no sea."""
SCALE = ColorScale(EMBERS, 0.1, 1e4, "log")  # people per km²
SEA = (0.045, 0.05, 0.065, 1.0)
NIGHT, INK = (0.03, 0.03, 0.045, 1.0), (0.9, 0.88, 0.84, 1.0)


def geometry() -> dict:
    """The places and the density about each, people per km²."""
    table = data.cities()
    known = table.population > 0
    voronoi = SphericalVoronoi.from_lonlat(table.lonlat[known], latitude=LATITUDE)
    people = np.bincount(voronoi.point_region, table.population[known])
    areas = voronoi.areas(radius=earth.AUTHALIC_RADIUS_KM)
    density = np.divide(people, areas, out=np.zeros_like(areas), where=areas > 0)
    return {"lonlat": table.lonlat[known], "density": density}


def draw(g: dict) -> Page:
    """Cells by density, and the coast."""
    globe = Globe(latitude=LATITUDE, limb=LineStyle((0.35, 0.33, 0.36, 1.0), 0.6))
    cells = SphericalVoronoi.from_lonlat(g["lonlat"], latitude=LATITUDE)
    globe.add_cells(cells, colors=SCALE(g["density"]), style=None)
    globe.add_ocean(color=SEA)
    globe.add_coastlines(style=LineStyle((0.333, 0.333, 0.333, 1.0), 0.25))
    subtitle = f"The surroundings of {spaced(len(g['density']))} cities and villages, by the number of their people"
    credit = "Places: GeoNames (CC BY 4.0). Coast: Natural Earth. Areas on WGS84."
    page = captioned(globe.page(view=VIEW), "Where people live", subtitle, credit, ink=INK)
    return replace(with_legend(page, SCALE, "people per km²", ink=INK, values=g["density"]), background=NIGHT)


FIGURE = Figure("earth_cities", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
