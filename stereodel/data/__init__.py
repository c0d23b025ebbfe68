"""Small real sets that come with the library: airports, cities, stars; coastlines, land, countries and borders.

Each is read when first asked for, checked against its SHA-256, and never changes afterwards. Where they are from and
under which licences: `sources`, and README.md in this folder.
"""

from stereodel.data.natural_earth import Borders, Coastlines, Countries, Land, borders, coastlines, countries, land
from stereodel.data.sets import Airports, Cities, Stars, airports, cities, sources, stars

__all__ = [
    "Airports",
    "Borders",
    "Cities",
    "Coastlines",
    "Countries",
    "Land",
    "Stars",
    "airports",
    "borders",
    "cities",
    "coastlines",
    "countries",
    "land",
    "sources",
    "stars",
]
