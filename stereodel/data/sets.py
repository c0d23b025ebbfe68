"""Tables of points and what their columns mean, a picture of the whole Earth from space; where every set is from."""

from __future__ import annotations

import io
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import numpy as np

from stereodel._arrays import Bytes, FloatArray, IntArray, Pixels, Texts, locked
from stereodel._extras import of_extra
from stereodel._notebook import Displayed
from stereodel.data import stored

DEGREE_DIGITS: Final = {"airports": 6, "cities": 5, "stars": 5}
"""Decimals of the stored degrees: for airports and cities all that the sources have."""

MAGNITUDE_DIGITS: Final = 2
"""Decimals of magnitudes and colour indices of stars."""


@dataclass(frozen=True, eq=False)
class Airports(Displayed):
    """Airports, landing strips and some seaplane bases of the world, in the order of their codes."""

    lonlat: FloatArray
    """(n, 2): longitude and geodetic latitude in degrees. Five places are held by two airports each."""
    icao: Texts
    """(n,): location indicators of four letters, or identifiers made up by the source where there is none."""
    iata: Texts
    """(n,): codes of three letters, empty for most."""
    name: Texts
    """(n,)."""
    country: Texts
    """(n,): ISO 3166-1 codes of two letters."""


@dataclass(frozen=True, eq=False)
class Cities(Displayed):
    """Places of more than 500 people, and seats of administrations, in the order of their GeoNames numbers."""

    lonlat: FloatArray
    """(n, 2): longitude and geodetic latitude in degrees, duplicates included."""
    population: IntArray
    """(n,): people; 0 where unknown."""


@dataclass(frozen=True, eq=False)
class Stars(Displayed):
    """The stars of the Hipparcos catalogue, new reduction, in the order of their numbers."""

    lonlat: FloatArray
    """(n, 2): right ascension in [0, 360) and declination in degrees, ICRS, epoch J1991.25."""
    hip: IntArray
    """(n,): number in the catalogue."""
    magnitude: FloatArray
    """(n,): magnitude Hp, smaller is brighter."""
    color_index: FloatArray
    """(n,): B − V, magnitudes; blue stars are below 0, red ones above 1."""


def sources() -> dict[str, dict[str, Any]]:
    """Where each set is from: name → source, licence, package and version, number of rows, file and its SHA-256.

    Examples
    --------
    >>> sources()["stars"]["rows"], sources()["cities"]["licence"]
    (117955, 'CC BY 4.0')
    """
    return {name: dict(entry) for name, entry in stored.table().items()}


@cache
def airports() -> Airports:
    """28 298 airports, after `airportsdata` (MIT licence).

    Examples
    --------
    >>> from stereodel import SphericalDelaunay
    >>> table = airports()
    >>> cells = SphericalDelaunay.from_lonlat(table.lonlat, latitude="geodetic")
    >>> nearest = cells.nearest(lonlat=(10.0, 48.4))
    >>> print(table.name[nearest], table.country[nearest], len(cells.duplicates))
    Erbach Airport DE 5
    """
    columns = stored.load("airports")
    words = (locked(stored.texts(columns[key])) for key in ("icao", "iata", "name", "country"))
    return Airports(_lonlat(columns, "airports"), *words)


@cache
def cities() -> Cities:
    """234 908 populated places with the number of their people (GeoNames, CC BY 4.0).

    Examples
    --------
    >>> table = cities()
    >>> len(table.lonlat), len(np.unique(table.lonlat, axis=0))
    (234908, 234799)
    """
    columns = stored.load("cities")
    return Cities(_lonlat(columns, "cities"), locked(stored.integers(columns["population"])))


@cache
def stars() -> Stars:
    """117 955 stars of the Hipparcos catalogue (ESA; F. van Leeuwen, 2007).

    Examples
    --------
    >>> table = stars()
    >>> brightest = table.magnitude.argmin()
    >>> print(table.hip[brightest], table.magnitude[brightest], table.lonlat[brightest])  # Sirius
    32349 -1.09 [101.28854 -16.71314]
    """
    columns = stored.load("stars")
    fractions = (locked(stored.decimals(columns[key], MAGNITUDE_DIGITS)) for key in ("magnitude", "color_index"))
    return Stars(_lonlat(columns, "stars"), locked(stored.integers(columns["hip"])), *fractions)


def _lonlat(columns: dict[str, Bytes], kind: str) -> FloatArray:
    degrees = (stored.decimals(columns[key], DEGREE_DIGITS[kind]) for key in ("lon", "lat"))
    return locked(np.stack(list(degrees), axis=-1))


@cache
def blue_marble() -> Pixels:
    """The Earth without clouds, in a northern winter: NASA's Blue Marble, Next Generation, with the sea floor's relief.

    Returns
    -------
    (1024, 2048, 3) array of uint8
        Red, green, blue on an equirectangular map: rows from north to south, columns from 180° W to 180° E; pixel
        (i, j) covers latitudes from 90° − i · 180°/1024 down and longitudes from j · 360°/2048 − 180° on. Pixels are
        those that the installed pillow decodes from a JPEG file.

    Examples
    --------
    >>> picture = blue_marble()
    >>> picture.shape
    (1024, 2048, 3)
    >>> red, green, blue = picture[512, 0].tolist()  # the Pacific
    >>> blue > 2 * red
    True
    """
    with of_extra("draw"):
        from PIL import Image

    with Image.open(io.BytesIO(stored.read("blue_marble"))) as picture:
        return locked(np.asarray(picture.convert("RGB")).copy())
