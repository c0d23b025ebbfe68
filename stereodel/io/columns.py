"""Which columns of a table are longitude and latitude."""

from __future__ import annotations

import re
from collections.abc import Sequence

NAMES = {
    "lon": ({"lon", "lng", "long", "longitude"}, {"x"}),
    "lat": ({"lat", "latitude"}, {"y"}),
}
"""Words for each, surest first."""


def find_lonlat(names: Sequence[str], lon: str | None = None, lat: str | None = None) -> tuple[str, str]:
    """Names of the columns of longitude and latitude.

    Parameters
    ----------
    names : sequence of str
    lon, lat : str, optional
        What the caller says; else they are guessed: a name that is one of the words lon, lng, long, longitude, lat,
        latitude, in any case, comes before one that has such a word in it (``decimalLongitude``, ``lat_deg``), and that
        before ``x`` and ``y``.

    Raises
    ------
    ValueError
        Listing the columns, where there is none or more than one.
    """
    found = [_find(names, kind, given) for kind, given in (("lon", lon), ("lat", lat))]
    if found[0] == found[1]:
        raise ValueError(f"lon and lat are both the column {found[0]!r}; the columns are {listed(names)}")
    return found[0], found[1]


def _find(names: Sequence[str], kind: str, given: str | None) -> str:
    if given is not None:
        same = [name for name in names if name == given] or [n for n in names if n.lower() == str(given).lower()]
        if len(same) != 1:
            raise ValueError(f"{kind} is {given!r}, which is not one of the columns {listed(names)}")
        return same[0]
    sure, unsure = NAMES[kind]
    meant = max(sure, key=len)
    plain = {name: name.strip().lower() for name in names}
    for matching in (
        [name for name in names if plain[name] in sure],
        [name for name in names if sure & words(name)],
        [name for name in names if plain[name] in unsure],
    ):
        if len(matching) == 1:
            return matching[0]
        if matching:
            raise ValueError(f"{listed(matching)} may all be the {meant}; say which with {kind}=")
    raise ValueError(f"no column looks like the {meant}; say which with {kind}=, the columns are {listed(names)}")


def words(name: str) -> set[str]:
    """Words of a column's name in lower case, split at signs and where a capital follows a small letter."""
    return set(re.split(r"[^a-z]+", re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).lower()))


def listed(names: Sequence[str]) -> str:
    """Names for a message."""
    return ", ".join(map(repr, names)) if names else "none at all"
