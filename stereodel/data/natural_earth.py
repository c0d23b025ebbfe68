"""Natural Earth: coastlines, land, countries and their borders.

Countries are stored as the arcs that two of them share, so that a border is the same numbers on both sides, and land is
their union: its outline is that of the countries, point by point.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray, IntArray, as_choice, locked
from stereodel.data import stored
from stereodel.data.shapes import Lines, Polygons
from stereodel.data.stored import Texts

RESOLUTIONS: Final = ("50m", "110m")
"""Maps of 1 : 50 and 1 : 110 million."""

DEGREE_DIGITS: Final = 4
"""Digits behind the point of the stored degrees: 11 m."""


@dataclass(frozen=True, eq=False)
class Coastlines(Lines):
    """Coastlines as polylines: line i is ``lonlat[offsets[i]:offsets[i + 1]]``, closed where its ends are equal."""


@dataclass(frozen=True, eq=False)
class Land(Polygons):
    """Land without the oceans, lakes included but for the Caspian Sea."""


@dataclass(frozen=True, eq=False)
class Borders(Lines):
    """Borders between countries, each piece once, in the order of the countries; coasts are not among them."""

    sides: IntArray
    """(m, 2): the countries left and right of each line, as rows of `Countries` of the same resolution."""


@dataclass(frozen=True, eq=False)
class Countries(Polygons):
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
        return {"type": "FeatureCollection", "features": list(self._features())}

    def _features(self) -> Iterator[dict[str, Any]]:
        polygons = [[ring.tolist() for ring in rings] for rings in self.polygons()]
        for k, (start, end) in enumerate(pairwise(self.country_offsets.tolist())):
            codes = {key: str(getattr(self, key)[k]) for key in ("name", "alpha2", "alpha3", "continent")}
            geometry = {"type": "MultiPolygon", "coordinates": polygons[start:end]}
            yield {"type": "Feature", "properties": codes, "geometry": geometry}


@cache
def coastlines(resolution: str = "50m") -> Coastlines:
    """Coastlines of Natural Earth (public domain).

    Parameters
    ----------
    resolution : {"50m", "110m"}, optional
        Made for maps of 1 : 50 or 1 : 110 million.

    Raises
    ------
    ValueError
        For another resolution.

    Examples
    --------
    >>> [len(coastlines(resolution).lines()) for resolution in ("50m", "110m")]
    [1422, 128]
    """
    columns = stored.load(f"coastlines_{_checked(resolution)}")
    degrees = [stored.decimals(columns[key], DEGREE_DIGITS) for key in ("lon", "lat")]
    return Coastlines(locked(np.stack(degrees, axis=-1)), _offsets(stored.integers(columns["sizes"])))


@cache
def land(resolution: str = "50m") -> Land:
    """Land as polygons, after Natural Earth (public domain).

    Parameters
    ----------
    resolution : {"50m", "110m"}, optional
        Made for maps of 1 : 50 or 1 : 110 million.

    Raises
    ------
    ValueError
        For another resolution.

    Examples
    --------
    >>> table = land("110m")
    >>> len(table.polygons()), table.lonlat.shape
    (127, (5137, 2))
    """
    columns = stored.load(f"countries_{_checked(resolution)}")
    return Land(*_polygons(columns, "land"))


@cache
def countries(resolution: str = "50m") -> Countries:
    """Countries as polygons, after Natural Earth (public domain); codes and continents after GeoNames (CC BY 4.0).

    Parameters
    ----------
    resolution : {"50m", "110m"}, optional
        Made for maps of 1 : 50 or 1 : 110 million. The smallest countries are in the first alone.

    Raises
    ------
    ValueError
        For another resolution.

    Examples
    --------
    >>> table = countries()
    >>> int((table.continent == "EU").sum()), len(table.name)
    (50, 241)
    """
    columns = stored.load(f"countries_{_checked(resolution)}")
    name, *codes = (locked(stored.texts(columns[key])) for key in ("name", "alpha2", "alpha3", "continent"))
    sizes, number = (stored.integers(columns[key]) for key in ("country_sizes", "number"))
    return Countries(*_polygons(columns, "country"), _offsets(sizes), name, locked(number), *codes)


@cache
def borders(resolution: str = "50m") -> Borders:
    """Borders between countries, after Natural Earth (public domain).

    Parameters
    ----------
    resolution : {"50m", "110m"}, optional
        Made for maps of 1 : 50 or 1 : 110 million.

    Raises
    ------
    ValueError
        For another resolution.

    Examples
    --------
    >>> sides = countries("110m").name[borders("110m").sides]
    >>> print(np.unique(sides[(sides == "Spain").any(axis=1)]))
    ['France' 'Portugal' 'Spain']
    """
    columns = stored.load(f"countries_{_checked(resolution)}")
    owners = _owners(columns)
    shared = [arc for arc in sorted(owners) if arc >= 0 and ~arc in owners]
    arcs = _arcs(columns)
    lines = [arcs[arc] for arc in shared]
    sides = np.array([(owners[arc], owners[~arc]) for arc in shared], dtype=np.int32)
    return Borders(locked(np.concatenate(lines)), _offsets([len(line) for line in lines]), locked(sides))


def _checked(resolution: str) -> str:
    return as_choice(resolution, RESOLUTIONS, "resolution")


def _offsets(sizes: Any) -> IntArray:
    return locked(np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32))


def _arcs(columns: dict[str, stored.Bytes]) -> list[FloatArray]:
    """The shared lines; coordinates are stored as steps from one point to the next, which are small numbers."""
    steps = np.stack([stored.integers(columns[key]) for key in ("lon", "lat")], axis=-1)
    lonlat = np.cumsum(steps, axis=0) / 10.0**DEGREE_DIGITS
    return np.split(lonlat, np.cumsum(stored.integers(columns["sizes"]))[:-1])


def _polygons(columns: dict[str, stored.Bytes], kind: str) -> tuple[FloatArray, IntArray, IntArray]:
    """Coordinates, offsets of rings and offsets of polygons."""
    arcs = _arcs(columns)
    used, bounds = (
        stored.integers(columns[f"{kind}_arcs"]).tolist(),
        _offsets(stored.integers(columns[f"{kind}_rings"])),
    )
    rings = [_ring(arcs, used[i:j]) for i, j in pairwise(bounds.tolist())]
    polygons = _offsets(stored.integers(columns[f"{kind}_polygons"]))
    return locked(np.concatenate(rings)), _offsets([len(ring) for ring in rings]), polygons


def _ring(arcs: list[FloatArray], used: list[int]) -> FloatArray:
    """Arcs end to end; ~i stands for arc i from its end to its start."""
    parts = [arcs[i] if i >= 0 else arcs[~i][::-1] for i in used]
    return np.concatenate([*(part[:-1] for part in parts), parts[-1][-1:]])


def _owners(columns: dict[str, stored.Bytes]) -> dict[int, int]:
    """The country on the left of each arc, and of each arc backwards, ~i."""
    rings, polygons, sizes = (stored.integers(columns[f"country_{key}"]) for key in ("rings", "polygons", "sizes"))
    ring_country = np.repeat(np.repeat(np.arange(len(sizes)), sizes), polygons)
    used = stored.integers(columns["country_arcs"])
    return dict(zip(used.tolist(), np.repeat(ring_country, rings).tolist(), strict=True))
