"""Small real sets that come with the library: airports, cities, stars, coastlines.

Each is read when first asked for, checked against its SHA-256, and never changes afterwards. Where they are from and
under which licences: `sources`, and README.md in this folder.
"""

from stereodel.data.sets import Airports, Cities, Coastlines, Stars, airports, cities, coastlines, sources, stars

__all__ = ["Airports", "Cities", "Coastlines", "Stars", "airports", "cities", "coastlines", "sources", "stars"]
