"""
The airport next to you
=======================

The Voronoi cells of 28 298 airports, five of which share their place with another: every point of the Earth belongs to
its nearest airport. The colour shows the area of the cell on the ellipsoid, from a few km² in the United States to 13
million km² of the Southern Ocean. The airports of the five largest cells that are clearly visible are labelled.
"""

import numpy as np
from _poster import LATITUDE, captioned, spaced, with_legend

from stereodel import SphericalVoronoi, data, earth, lonlat_to_xyz
from stereodel.drawing import ColorScale, Page, View
from stereodel.drawing.style import BLACK, WHITE, DotStyle, LineStyle, with_opacity
from stereodel.globe import Globe
from stereodel.render import Figure

VIEW = View(-40, 36)
IN_SIGHT, NAMED = 0.3, 5  # depth on the unit ball, and how many of the largest cells are named
PLACES = {"TXKF": "Bermuda"}  # by code of the airport: its place where its name tells nobody where it is
SCALE = ColorScale("magma", 10.0, 1e7, log=True)  # km²
TICKS = {1e1: "10", 1e2: "100", 1e3: "1000", 1e4: "10 000", 1e5: "100 000", 1e6: "1 million", 1e7: "10 million"}


def geometry() -> dict:
    """The airports and the areas of their cells in km²; those of the second airport of a place are empty."""
    lonlat = data.airports().lonlat
    voronoi = SphericalVoronoi.from_lonlat(lonlat, latitude=LATITUDE)
    return {"lonlat": lonlat, "areas": voronoi.areas(radius=earth.AUTHALIC_RADIUS_KM)}


def short(airport: int) -> str:
    """The name of an airport without the words that all have, or its place."""
    table = data.airports()
    name = str(table.name[airport]).replace(" International", "").removesuffix(" Airport")
    return PLACES.get(str(table.icao[airport]), name)


def draw(g: dict) -> Page:
    """Cells by area, and the coast."""
    globe = Globe(latitude=LATITUDE)
    globe.add_cells(SphericalVoronoi.from_lonlat(g["lonlat"], latitude=LATITUDE), colors=SCALE(g["areas"]), style=None)
    globe.add_coastlines(style=LineStyle(with_opacity(WHITE, 0.6), 0.4))
    seen = np.flatnonzero(VIEW.depth(lonlat_to_xyz(g["lonlat"], latitude=LATITUDE)) > IN_SIGHT)
    named = seen[np.argsort(-g["areas"][seen])[:NAMED]]
    largest = named[0]
    globe.add_points(g["lonlat"][named], style=DotStyle(BLACK, 1.3, rim=WHITE, rim_width=0.3))
    globe.add_labels(g["lonlat"][named], map(short, named.tolist()), size=7.0, offset=(3.5, 0.0), halo=1.2)
    subtitle = (
        f"{spaced(len(g['areas']))} airports and the part of the Earth that is nearest to each; the largest "
        f"in sight, {g['areas'][largest] / 1e6:.1f} million km², is that of {short(largest)}"
    )
    credit = "Airports: airportsdata. Coast: Natural Earth. Areas on WGS84."
    page = captioned(globe.page(view=VIEW), "The airport next to you", subtitle, credit, ink=BLACK)
    return with_legend(page, SCALE, TICKS, "area, km²", ink=BLACK)


FIGURE = Figure("earth_airports", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
