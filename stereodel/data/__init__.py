"""Small real data sets that come with the library: airports, cities, stars, and a map of the Earth.

Each is read on first use, checked against its SHA-256, and never changes afterwards. For their origins and
licences, see `sources`, and README.md in this folder.
"""

from stereodel.data.natural_earth import (
    Borders,
    Countries,
    EarthLines,
    EarthPolygons,
    Rivers,
    borders,
    coastlines,
    countries,
    lakes,
    land,
    rivers,
)
from stereodel.data.sets import Airports, Cities, Stars, airports, blue_marble, cities, sources, stars

__all__ = [
    "Airports",
    "Borders",
    "Cities",
    "Countries",
    "EarthLines",
    "EarthPolygons",
    "Rivers",
    "Stars",
    "airports",
    "blue_marble",
    "borders",
    "cities",
    "coastlines",
    "countries",
    "lakes",
    "land",
    "rivers",
    "sources",
    "stars",
]
