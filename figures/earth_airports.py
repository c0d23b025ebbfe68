"""
The airport next to you
=======================

The Voronoi cells of 28 298 airports, five of which share their place with another: every point of the Earth belongs to
its nearest airport. The colour shows the area of the cell on the ellipsoid, from 1.1 km² in Alaska to 13 million km² of
the Southern Ocean. Of the airports that are clearly visible, those of the five largest cells are labelled; the largest
cell of which a part is in sight belongs to an airport beyond the limb.
"""

import numpy as np
from _poster import LATITUDE, captioned, even_ends, spaced, with_legend

from stereodel import SphericalVoronoi, data, earth, lonlat_to_xyz
from stereodel.drawing import ColorScale, Page, View
from stereodel.drawing.page.style import BLACK, WHITE, DotStyle, LineStyle, with_opacity
from stereodel.globe import Globe
from stereodel.render import Figure

VIEW = View(-40, 36)
CLEAR, NAMED = 0.3, 5  # depth on the unit ball from which airports are named, and how many
PLACES = {"TXKF": "Bermuda", "SCIP": "Easter Island"}  # by code: where an airport is whose name tells nobody


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


def largest_in_sight(voronoi: SphericalVoronoi, areas: np.ndarray) -> int:
    """The airport whose cell is the largest that reaches into the hemisphere that is seen: that has a corner there."""
    near = VIEW.depth(voronoi.vertices) > 0
    seen = [near[corners].any() for corners in voronoi.regions]
    return int(np.argmax(np.where(np.array(seen)[voronoi.point_region], areas, 0.0)))


def scale_of(areas: np.ndarray) -> ColorScale:
    """Colours for all areas."""
    return ColorScale("magma", *even_ends(areas), "log")


def draw(g: dict) -> Page:
    """Cells by area, and the coast."""
    globe, areas = Globe(latitude=LATITUDE), g["areas"]
    voronoi = SphericalVoronoi.from_lonlat(g["lonlat"], latitude=LATITUDE)
    scale = scale_of(areas)
    globe.add_cells(voronoi, colors=scale(areas), style=None)
    globe.add_coastlines(style=LineStyle(with_opacity(WHITE, 0.6), 0.4))
    depth = VIEW.depth(lonlat_to_xyz(g["lonlat"], latitude=LATITUDE))
    clear = np.flatnonzero(depth > CLEAR)
    named = clear[np.argsort(-areas[clear])[:NAMED]]
    largest = largest_in_sight(voronoi, areas)
    globe.add_points(g["lonlat"][named], style=DotStyle(BLACK, 1.3, rim=WHITE, rim_width=0.3))
    globe.add_labels(g["lonlat"][named], map(short, named.tolist()), size=7.0, offset=(3.5, 0.0), halo=1.2)
    subtitle = (
        f"{spaced(len(areas))} airports and the part of the Earth that is nearest to each; the largest in sight, "
        f"{areas[largest] / 1e6:.1f} million km², is that of {short(largest)}"
    )
    credit = "Airports: airportsdata. Coast: Natural Earth. Areas on WGS84."
    if depth[largest] <= 0:
        side = "left" if VIEW.project(voronoi.points[largest])[0] < 0 else "right"
        credit += f" {short(largest)} itself lies beyond the {side} limb."
    page = captioned(globe.page(view=VIEW), "The airport next to you", subtitle, credit, ink=BLACK)
    return with_legend(page, scale, "area, km²", ink=BLACK)


FIGURE = Figure("earth_airports", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
