"""Names of columns: which are longitude and latitude, and what becomes of two with one name."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable, Mapping, Sequence
from itertools import count
from typing import Any, TypeVar

T = TypeVar("T")

NAMES_SHOWN, NAME_SHOWN = 30, 40
"""Columns, and letters of the name of one, that a message lists."""

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


def has_lonlat(names: Sequence[str]) -> bool:
    """Whether names are those of longitude and latitude without asking."""
    try:
        find_lonlat(names)
    except ValueError:
        return False
    return True


class RenamedColumnWarning(UserWarning):
    """A column is written under another name, because its own belongs to something else there."""


def beside(taken: Iterable[str], columns: Mapping[str, T], *, any_case: bool = False) -> dict[str, T]:
    """Columns under names that are free beside others; a warning tells which were renamed.

    A name that is taken, in any case, gets the first free number behind it: ``lon`` becomes ``lon_1``.

    Parameters
    ----------
    taken : iterable of str
        Names that belong to something else, such as the places.
    columns : mapping
        What came with the points.
    any_case : bool
        Whether the columns must differ in more than the case of letters among themselves, too, as in databases.

    Examples
    --------
    >>> import warnings
    >>> with warnings.catch_warnings(record=True) as said:
    ...     warnings.simplefilter("always")
    ...     beside(["lon", "lat"], {"name": 1, "Lon": 2, "lon_1": 3})
    {'name': 1, 'Lon_1': 2, 'lon_1': 3}
    >>> print(said[0].message)
    column 'Lon' is written as 'Lon_1', because its name is taken
    """
    reserved = {name.casefold() for name in taken}
    used: set[str] = set()
    result: dict[str, T] = {}
    renamed: list[str] = []

    def key(name: str) -> str:
        return name.casefold() if any_case else name

    def is_free(name: str) -> bool:
        return name.casefold() not in reserved and key(name) not in used

    for name, values in columns.items():
        free = name
        if not is_free(name):
            free = next(new for k in count(1) if is_free(new := f"{name}_{k}") and new not in columns)
            renamed.append(f"{name!r} {'is written ' if not renamed else ''}as {free!r}")
        used.add(key(free))
        result[free] = values
    if renamed:
        said = " and ".join(renamed)
        whose = "their names are" if len(renamed) > 1 else "its name is"
        warnings.warn(f"column {said}, because {whose} taken", RenamedColumnWarning, stacklevel=2)
    return result


def index_columns(frame: Any) -> dict[str, Any]:
    """The levels of a frame's index by name, as GeoPandas writes them: not whole numbers without a name."""
    index = frame.index
    if index.nlevels == 1 and index.name is None and index.dtype.kind in "iu":
        return {}
    levels = index.to_frame(index=False)
    names = [name or ("index" if index.nlevels == 1 else f"level_{k}") for k, name in enumerate(index.names)]
    return {str(name): levels.iloc[:, k] for k, name in enumerate(names)}


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
    """Names for a message, which has room for so many of such lengths."""
    shown = [repr(name if len(name) <= NAME_SHOWN else name[: NAME_SHOWN - 1] + "…") for name in names[:NAMES_SHOWN]]
    more = [f"and {len(names) - len(shown)} more"] if len(names) > len(shown) else []
    return ", ".join(shown + more) if names else "none at all"
