"""
The airport next to you
=======================

The Voronoi cells of 28 298 airports, five of which share their place with another: every point of the Earth belongs to
the airport that is nearest to it. The colour is the area of the cell on the ellipsoid, from a few km² in the United
States to 13 million km² of the Southern Ocean.
"""

import numpy as np
from _poster import LATITUDE, captioned, spaced, with_legend

from stereodel import SphericalVoronoi, data, earth
from stereodel.drawing import ColorScale, Page, View
from stereodel.drawing.style import BLACK, WHITE, LineStyle
from stereodel.globe import Globe
from stereodel.render import Figure

VIEW = View(-40, 36)
SCALE = ColorScale("magma", 10.0, 1e7, log=True)  # km²
TICKS = {1e1: "10", 1e2: "100", 1e3: "1000", 1e4: "10 000", 1e5: "100 000", 1e6: "1 million", 1e7: "10 million"}


def geometry() -> dict:
    """The airports and the areas of their cells in km²; those of the second airport of a place are empty."""
    lonlat = data.airports().lonlat
    voronoi = SphericalVoronoi.from_lonlat(lonlat, latitude=LATITUDE)
    return {"lonlat": lonlat, "areas": voronoi.areas(radius=earth.AUTHALIC_RADIUS_KM)}


def draw(g: dict) -> Page:
    """Cells by area, and the coast."""
    globe = Globe(latitude=LATITUDE)
    globe.add_cells(SphericalVoronoi.from_lonlat(g["lonlat"], latitude=LATITUDE), colors=SCALE(g["areas"]), style=None)
    globe.add_coastlines(style=LineStyle(WHITE, 0.3))
    largest = np.argmax(g["areas"])
    subtitle = (
        f"{spaced(len(g['areas']))} airports and the part of the Earth that is nearest to each; the largest, "
        f"{g['areas'][largest] / 1e6:.1f} million km², is that of {data.airports().name[largest]}"
    )
    credit = "Airports: airportsdata. Coast: Natural Earth. Areas on WGS84."
    page = captioned(globe.page(view=VIEW), "The airport next to you", subtitle, credit, ink=BLACK)
    return with_legend(page, SCALE, TICKS, "area, km²", ink=BLACK)


FIGURE = Figure("earth_airports", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
