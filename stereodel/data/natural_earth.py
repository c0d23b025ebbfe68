"""Natural Earth: coastlines, land, countries and their borders, rivers, lakes.

Countries are stored as the arcs that two of them share, so that a border is the same numbers on both sides, and land is
their union: its outline is that of the countries, point by point. At 1 : 10 million there is land without countries.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Any, Final

import numpy as np

from stereodel._arrays import BoolArray, Bytes, FloatArray, IntArray, Texts, as_choice, locked
from stereodel._docs import shared
from stereodel._notebook import Displayed
from stereodel.data import stored


@dataclass(frozen=True, eq=False)
class EarthLines(Displayed):
    """Polylines, straight in longitude and latitude: line i is ``lonlat[offsets[i]:offsets[i + 1]]``.

    It is closed where its ends are equal.
    """

    lonlat: FloatArray
    """(n, 2): longitude and geodetic latitude in degrees."""
    offsets: IntArray
    """(m + 1,)."""

    def lines(self) -> list[FloatArray]:
        """The polylines, each (k, 2)."""
        return np.split(self.lonlat, self.offsets[1:-1])

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """All lines as GeoJSON: one MultiLineString."""
        return {"type": "MultiLineString", "coordinates": [line.tolist() for line in self.lines()]}


@dataclass(frozen=True, eq=False)
class EarthPolygons(Displayed):
    """Polygons as GeoJSON has them: sides straight in longitude and latitude, cut along ±180°.

    Ring i is ``lonlat[ring_offsets[i]:ring_offsets[i + 1]]``, its first point again at its end; polygon j has the rings
    from ``polygon_offsets[j]`` up to ``polygon_offsets[j + 1]``: its outline counterclockwise, then holes clockwise.
    """

    lonlat: FloatArray
    """(n, 2): longitude and geodetic latitude in degrees."""
    ring_offsets: IntArray
    """(r + 1,)."""
    polygon_offsets: IntArray
    """(p + 1,)."""

    def polygons(self) -> list[list[FloatArray]]:
        """The polygons, each a list of rings (k, 2), the outline first."""
        rings = np.split(self.lonlat, self.ring_offsets[1:-1])
        return [rings[i:j] for i, j in pairwise(self.polygon_offsets.tolist())]

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """All polygons as GeoJSON: one MultiPolygon."""
        return {
            "type": "MultiPolygon",
            "coordinates": [[ring.tolist() for ring in polygon] for polygon in self.polygons()],
        }


STORED: Final = {
    "coastlines": {"10m": "land_10m", "50m": "coastlines_50m", "110m": "coastlines_110m"},
    "land": {"10m": "land_10m", "50m": "countries_50m", "110m": "countries_110m"},
    "countries": {"50m": "countries_50m", "110m": "countries_110m"},
    "borders": {"10m": "borders_10m", "50m": "countries_50m", "110m": "countries_110m"},
    "rivers": {"10m": "rivers_10m", "50m": "rivers_50m", "110m": "rivers_110m"},
    "lakes": {"10m": "lakes_10m", "50m": "lakes_50m", "110m": "lakes_110m"},
}
"""The file that holds each set for maps of 1 : 10, 1 : 50 and 1 : 110 million."""

DEGREE_DIGITS: Final = 4
"""Decimals of the stored degrees: 11 m."""

WATER_DIGITS: Final = 3
"""The same of rivers, lakes and the borders at 1 : 10 million: 111 m."""


_SHARED = {
    "parameters": """
        Parameters
        ----------
        resolution : {"10m", "50m", "110m"}, optional
            Made for maps of 1 : 10, 1 : 50 or 1 : 110 million.

        Raises
        ------
        ValueError
            For another resolution.
        """,
}


@dataclass(frozen=True, eq=False)
class Borders(EarthLines):
    """Borders between countries, each piece once, in the order of the countries; coasts are not among them."""

    sides: IntArray
    """(m, 2): the countries left and right of each line, as rows of `Countries` of the same resolution; −1 at "10m"."""


@dataclass(frozen=True, eq=False)
class Rivers(EarthLines):
    """Rivers as polylines, in the order of their ranks; a river has one or more, and goes on through lakes."""

    name: Texts
    """(m,): name of the river or the lake, empty where the source has none."""
    rank: IntArray
    """(m,): from 0 for the largest on, as Natural Earth has it: a map of twice the scale shows about one rank more."""
    in_lake: BoolArray
    """(m,): whether the line is one through a lake."""


@dataclass(frozen=True, eq=False)
class Countries(EarthPolygons):
    """Countries: country k has the polygons from ``country_offsets[k]`` up to ``country_offsets[k + 1]``.

    They are those of Natural Earth, which draws who controls a place, not who claims it.
    """

    country_offsets: IntArray
    """(c + 1,)."""
    name: Texts
    """(c,): short English names."""
    number: IntArray
    """(c,): ISO 3166-1 numbers, 0 where there is none."""
    alpha2: Texts
    """(c,): ISO 3166-1 codes of two letters, empty where there is none."""
    alpha3: Texts
    """(c,): ISO 3166-1 codes of three letters, empty where there is none."""
    continent: Texts
    """(c,): AF, AN, AS, EU, NA, OC or SA, as GeoNames has it; empty where there is no code of the country."""

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """A GeoJSON FeatureCollection, a feature for each country: `geopandas.GeoDataFrame.from_features` takes it."""
        polygons = super().__geo_interface__["coordinates"]
        features = [
            {
                "type": "Feature",
                "properties": {key: str(getattr(self, key)[k]) for key in ("name", "alpha2", "alpha3", "continent")},
                "geometry": {"type": "MultiPolygon", "coordinates": polygons[start:end]},
            }
            for k, (start, end) in enumerate(pairwise(self.country_offsets.tolist()))
        ]
        return {"type": "FeatureCollection", "features": features}


@cache
@shared(**_SHARED)
def coastlines(resolution: str = "50m") -> EarthLines:
    """Coastlines of Natural Earth (public domain).

    {parameters}

    Examples
    --------
    >>> [len(coastlines(resolution).lines()) for resolution in ("10m", "50m", "110m")]
    [6841, 1422, 128]
    """
    if resolution == "10m":
        outlines = land("10m")
        rings = np.split(outlines.lonlat, outlines.ring_offsets[1:-1])
        return EarthLines(*_joined([coast for ring in rings for coast in coasts(ring)]))
    columns = _columns("coastlines", resolution)
    degrees = [stored.decimals(columns[key], DEGREE_DIGITS) for key in ("lon", "lat")]
    return EarthLines(locked(np.stack(degrees, axis=-1)), _offsets(stored.integers(columns["sizes"])))


@cache
@shared(**_SHARED)
def land(resolution: str = "50m") -> EarthPolygons:
    """Land as polygons, with the lakes in it except the Caspian Sea, after Natural Earth (public domain).

    {parameters}

    Examples
    --------
    >>> table = land("110m")
    >>> len(table.polygons()), table.lonlat.shape
    (127, (5137, 2))
    """
    return EarthPolygons(*_polygons(_columns("land", resolution), "land"))


@cache
@shared(**_SHARED)
def countries(resolution: str = "50m") -> Countries:
    """Countries as polygons, after Natural Earth (public domain); codes and continents after GeoNames (CC BY 4.0).

    The smallest countries are in "50m" alone; there is no "10m".

    {parameters}

    Examples
    --------
    >>> table = countries()
    >>> int((table.continent == "EU").sum()), len(table.name)
    (50, 241)
    """
    columns = _columns("countries", resolution)
    name, *codes = (locked(stored.texts(columns[key])) for key in ("name", "alpha2", "alpha3", "continent"))
    sizes, number = (stored.integers(columns[key]) for key in ("country_sizes", "number"))
    return Countries(*_polygons(columns, "country"), _offsets(sizes), name, locked(number), *codes)


@cache
@shared(**_SHARED)
def borders(resolution: str = "50m") -> Borders:
    """Borders between countries, after Natural Earth (public domain).

    {parameters}

    Examples
    --------
    >>> sides = countries("110m").name[borders("110m").sides]
    >>> print(np.unique(sides[(sides == "Spain").any(axis=1)]))
    ['France' 'Portugal' 'Spain']
    """
    columns = _columns("borders", resolution)
    if resolution == "10m":
        lonlat, offsets = _lines(columns)
        return Borders(lonlat, offsets, locked(np.full((len(offsets) - 1, 2), -1, dtype=np.int32)))
    # The country on the left of each arc, and of each arc backwards, ~i.
    rings, polygons, sizes = (stored.integers(columns[f"country_{key}"]) for key in ("rings", "polygons", "sizes"))
    ring_country = np.repeat(np.repeat(np.arange(len(sizes)), sizes), polygons)
    used = stored.integers(columns["country_arcs"])
    owners = dict(zip(used.tolist(), np.repeat(ring_country, rings).tolist(), strict=True))
    shared = [arc for arc in sorted(owners) if arc >= 0 and ~arc in owners]
    arcs = _arcs(columns, DEGREE_DIGITS)
    sides = np.array([(owners[arc], owners[~arc]) for arc in shared], dtype=np.int32)
    return Borders(*_joined([arcs[arc] for arc in shared]), locked(sides))


@cache
@shared(**_SHARED)
def rivers(resolution: str = "50m") -> Rivers:
    """Rivers, and the ways on through lakes, after Natural Earth (public domain).

    {parameters}

    Examples
    --------
    >>> print(*rivers("110m").name[:5], sep=", ")
    Lena, Chang (Yangtze), Nile, Amazon, Mississippi
    """
    columns = _columns("rivers", resolution)
    name = locked(stored.texts(columns["name"]))
    rank, in_lake = (stored.integers(columns[key]) for key in ("rank", "in_lake"))
    return Rivers(*_lines(columns), name, locked(rank), locked(in_lake.astype(bool)))


@cache
@shared(**_SHARED)
def lakes(resolution: str = "50m") -> EarthPolygons:
    """Lakes as polygons, natural ones and reservoirs, after Natural Earth (public domain).

    The latter two resolutions lie on a grid of 0.036° by 0.018°. Holes of `land` are not among them.

    {parameters}

    Examples
    --------
    >>> [len(lakes(resolution).polygons()) for resolution in ("10m", "50m", "110m")]
    [1352, 280, 25]
    """
    return EarthPolygons(*_polygons(_columns("lakes", resolution), "lakes", WATER_DIGITS))


def _columns(kind: str, resolution: str) -> dict[str, Bytes]:
    """The stored columns of a set, by name."""
    return stored.load(STORED[kind][as_choice(resolution, tuple(STORED[kind]), "resolution")])


def _offsets(sizes: Any) -> IntArray:
    return locked(np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32))


def _joined(lines: list[FloatArray]) -> tuple[FloatArray, IntArray]:
    return locked(np.concatenate(lines)), _offsets([len(line) for line in lines])


def _lonlat(columns: dict[str, Bytes], digits: int) -> FloatArray:
    """Coordinates, stored as steps from one point to the next, which are small numbers."""
    steps = np.stack([stored.integers(columns[key]) for key in ("lon", "lat")], axis=-1)
    return np.cumsum(steps, axis=0) / 10.0**digits


def _lines(columns: dict[str, Bytes]) -> tuple[FloatArray, IntArray]:
    """Coordinates and offsets of lines."""
    return locked(_lonlat(columns, WATER_DIGITS)), _offsets(stored.integers(columns["sizes"]))


def _arcs(columns: dict[str, Bytes], digits: int) -> list[FloatArray]:
    """The lines that rings are made of."""
    return np.split(_lonlat(columns, digits), np.cumsum(stored.integers(columns["sizes"]))[:-1])


def _polygons(
    columns: dict[str, Bytes], kind: str, digits: int = DEGREE_DIGITS
) -> tuple[FloatArray, IntArray, IntArray]:
    """Coordinates, offsets of rings and offsets of polygons."""
    arcs = _arcs(columns, digits)
    used = stored.integers(columns[f"{kind}_arcs"]).tolist()
    bounds = _offsets(stored.integers(columns[f"{kind}_rings"]))
    rings = [end_to_end(arcs, used[i:j]) for i, j in pairwise(bounds.tolist())]
    return *_joined(rings), _offsets(stored.integers(columns[f"{kind}_polygons"]))


def coasts(ring: FloatArray, east: float = 180.0, south: float = -90.0) -> list[FloatArray]:
    """A ring without its sides along the edges of the map, from these degrees on."""
    on_edge = (np.abs(ring[:, 0]) >= east) | (ring[:, 1] <= south)
    cut = np.flatnonzero(on_edge[:-1] & on_edge[1:])
    bounds = [-1, *cut.tolist(), len(ring) - 1]
    return [ring[i + 1 : j + 1] for i, j in pairwise(bounds) if j - i > 1]


def end_to_end(arcs: list[Any], used: list[int]) -> Any:
    """Arcs end to end; ~i stands for arc i from its end to its start."""
    parts = [arcs[i] if i >= 0 else arcs[~i][::-1] for i in used]
    return np.concatenate([*(part[:-1] for part in parts), parts[-1][-1:]])
