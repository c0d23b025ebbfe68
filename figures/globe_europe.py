"""
Europe, airport by airport
==========================

The Voronoi cells of the airports with a three-letter code, through a fisheye over Europe: every place belongs to the
airport nearest to it on the Earth, whatever the lens does to the picture. The colour shows the area of the cell on the
ellipsoid. The sides of cells are arcs of great circles; their images are circular arcs and drawn as such.
Chosen by us: focus and magnification, and which airports are labelled.
"""

import numpy as np
from _poster import LATITUDE, captioned, in_words, on_scale, with_legend

from stereodel import SphericalVoronoi, data, earth, fisheye
from stereodel.drawing import ColorScale, Page
from stereodel.drawing.page.style import BLACK, WHITE, DotStyle, LineStyle, with_opacity
from stereodel.globe import Globe
from stereodel.render import Figure

FOCUS = (11.0, 49.0)
MAGNIFICATION = 4.0
SCALE = ColorScale("YlGnBu", 1e3, 1e6, "log")  # km²
LABELLED = [
    *("FRA", "LHR", "CDG", "AMS", "MAD", "FCO", "IST", "ZRH", "VIE", "CPH", "ARN", "OSL", "HEL", "WAW", "PRG", "BUD"),
    *("ATH", "LIS", "DUB", "KEF", "BCN", "SVO", "MXP", "BEG", "OTP", "SOF", "KBP", "RIX", "EDI", "BGO", "PMI"),
]
MEASURED = ("LHR", "FRA", "WAW", "PMI", "BUD")  # labelled with the area of their cells


def geometry() -> dict:
    """The airports with a code, and the areas of their cells in km²."""
    table = data.airports()
    coded = table.iata != ""
    voronoi = SphericalVoronoi.from_lonlat(table.lonlat[coded], latitude=LATITUDE)
    areas = voronoi.areas(radius=earth.AUTHALIC_RADIUS_KM)
    return {"lonlat": table.lonlat[coded], "iata": table.iata[coded], "areas": areas}


def named(code: str, area: float) -> str:
    """A code, and the area of the cell in km² to two digits where it is asked for."""
    return f"{code}, {on_scale(float(f'{area:.1e}'))} km²" if code in MEASURED else code


def draw(g: dict) -> Page:
    """Cells by area, coast and borders, and the codes of large airports."""
    globe = Globe(latitude=LATITUDE)
    cells = SphericalVoronoi.from_lonlat(g["lonlat"], latitude=LATITUDE)
    globe.add_cells(cells, colors=SCALE(g["areas"]), style=LineStyle(with_opacity(WHITE, 0.45), 0.2))
    globe.add_borders(style=LineStyle((0.1, 0.1, 0.1, 0.75), 0.35), resolution="50m")
    globe.add_coastlines(style=LineStyle(BLACK, 0.5), resolution="50m")
    rows = [int(np.flatnonzero(g["iata"] == code)[0]) for code in LABELLED]
    labelled = g["lonlat"][rows]
    texts = [named(code, g["areas"][row]) for code, row in zip(LABELLED, rows, strict=True)]
    globe.add_points(labelled, style=DotStyle(BLACK, 1.5, rim=WHITE, rim_width=0.4))
    globe.add_labels(labelled, texts, size=7.5, offset=(3.5, 0.0), halo=1.3)
    letters = in_words(len(g["iata"][0]))
    page = captioned(
        globe.page(fisheye(FOCUS, magnification=MAGNIFICATION)),
        "Europe, airport by airport",
        f"The part of the Earth that is nearest to each airport with a code of {letters} letters; the middle of "
        f"Europe is {in_words(MAGNIFICATION)} times as large.",
        "Airports: airportsdata. Coast and borders: Natural Earth. Areas on WGS84.",
        ink=BLACK,
    )
    return with_legend(page, SCALE, "area, km²", ink=BLACK, values=g["areas"])


FIGURE = Figure("globe_europe", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
