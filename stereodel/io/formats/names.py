"""Names of columns: finding longitude and latitude, renaming those that collide; names of arguments in messages."""

from __future__ import annotations

import json
import os
import re
import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from importlib import resources
from itertools import count
from types import MappingProxyType
from typing import Any, Final, TypeVar

from stereodel._arrays import DataWarning as DataWarning

T = TypeVar("T")

NAMES_SHOWN, NAME_SHOWN = 30, 40  # number of columns, and characters of a name, that a message shows
# What people write in tables: the page reads the same list.
WORDS: Final = json.loads(resources.files(__package__).joinpath("words.json").read_text(encoding="utf-8"))
# Words for each in English, German, French, Spanish, Portuguese, Italian, Russian, Chinese, Japanese and Arabic.
NAMES: Final = {axis: tuple(WORDS[axis]) for axis in ("lon", "lat")}
# Words that are both coordinates where there are no others: *Länge* and *Breite* are also length and width.
UNSURE: Final = {axis: set(WORDS[f"unsure_{axis}"]) for axis in NAMES}
BESIDE: Final = frozenset(WORDS["beside"])  # what may stand beside a word that is unsure
# A name in which a word for longitude stands before one for latitude, as in lonlat and Länge/Breite.
LON_FIRST: Final = re.compile(rf"({'|'.join(NAMES['lon'])}|länge).*({'|'.join(NAMES['lat'])}|breite)", re.I | re.S)
IDEOGRAPHS: Final = "\u3040"  # from here on a name is not written in words
SPELLING: Final[ContextVar[Mapping[str, str]]] = ContextVar("SPELLING", default=MappingProxyType({}))


def spelled(argument: str, value: str = "") -> str:
    """An argument in a message as the caller types it: ``crs``, with a value ``crs=…``; in the command ``--crs``."""
    return SPELLING.get().get(argument, argument + value)


def left_out(option: str = "skip_missing") -> str:
    """What to do about rows without a value, or about those that are wrong."""
    return f"leave such rows out with {spelled(option, '=True')}"


def anew() -> str:
    """What to do about results of a run that are not what they were."""
    return f"begin anew with {spelled('resume', '=False')}"


@contextmanager
def spelling(options: Mapping[str, str]) -> Iterator[None]:
    """A context in which messages name options in place of these arguments."""
    token = SPELLING.set(options)
    try:
        yield
    finally:
        SPELLING.reset(token)


@contextmanager
def naming(source: Any) -> Iterator[None]:
    """Begin errors with the name of the file, unless it stands there already."""
    try:
        yield
    except (ValueError, TypeError) as error:
        if not isinstance(source, str | os.PathLike) or str(error).startswith(os.fspath(source)):
            raise
        kind = next(each for each in (NoPointError, ValueError, TypeError) if isinstance(error, each))
        raise kind(f"{os.fspath(source)}: {error}") from error


def find_lonlat(names: Sequence[str], lon: str | None = None, lat: str | None = None) -> tuple[str, str]:
    """Names of the columns of longitude and latitude; ValueError lists the columns if none or more than one matches.

    Names that are not given are guessed, ignoring case: one that is a word of `NAMES` is preferred to one that contains
    such a word (``decimalLongitude``, ``lat_deg``), and that to ``x`` and ``y``.
    """
    found = [_find(names, kind, given) for kind, given in (("lon", lon), ("lat", lat))]
    if found[0] == found[1]:
        both = f"{spelled('lon')} and {spelled('lat')} are both the column {found[0]!r}"
        advice = "; a first line such as sep=~ says what separates columns" if len(names) == 1 else ""
        raise ValueError(f"{both}; the columns are {listed(names)}{advice}")
    return found[0], found[1]


def has_lonlat(names: Sequence[str]) -> bool:
    """Whether columns of longitude and latitude can be found by their names."""
    with suppress(ValueError):
        return bool(find_lonlat(names))
    return False


class NoPointError(ValueError):
    """A row has another geometry than a point."""


class RenamedColumnWarning(DataWarning):
    """A column is written under another name because its own is taken."""


def note(what: str, option: str = "") -> None:
    """Say in a `DataWarning` what is guessed or left out, and with which option to say it otherwise."""
    advice = f"; {spelled(option, '=')} says it if that is wrong" if option else ""
    warnings.warn(f"{what}{advice}", DataWarning, stacklevel=3)


def beside(taken: Iterable[str], columns: Mapping[str, T], *, any_case: bool = False) -> dict[str, T]:
    """Columns under names that are not taken; a warning lists those that were renamed.

    A name that is taken, ignoring case, gets the first free number appended: ``lon`` becomes ``lon_1``. With `any_case`
    the names of `columns` also differ from each other in more than case, as databases require.
    """
    reserved = {name.casefold() for name in taken}
    used: set[str] = set()
    result: dict[str, T] = {}
    renamed: list[str] = []

    def is_free(name: str) -> bool:
        return name.casefold() not in reserved and (name.casefold() if any_case else name) not in used

    for name, values in columns.items():
        free = name
        if not is_free(name):
            free = next(new for k in count(1) if is_free(new := f"{name}_{k}") and new not in columns)
            renamed.append(f"{name!r} {'is written ' if not renamed else ''}as {free!r}")
        used.add(free.casefold() if any_case else free)
        result[free] = values
    if renamed:
        said = " and ".join(renamed)
        whose = "their names are" if len(renamed) > 1 else "its name is"
        warnings.warn(f"column {said}, because {whose} taken", RenamedColumnWarning, stacklevel=2)
    return result


def index_columns(frame: Any) -> dict[str, Any]:
    """The levels of a frame's index by name, as GeoPandas writes them: an unnamed index of integers is left out."""
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
            raise ValueError(f"{spelled(kind)} is {given!r}, which is not one of the columns {listed(names)}")
        return same[0]
    sure, meant = NAMES[kind], NAMES[kind][0]
    plain = {name: name.strip().casefold() for name in names}
    ways: tuple[Callable[[str], bool], ...] = (
        lambda name: plain[name] in sure,
        lambda name: any(word in plain[name] and (word > IDEOGRAPHS or word in words(name)) for word in sure),
        lambda name: plain[name] in UNSURE[kind] or set() < words(name) - BESIDE <= UNSURE[kind],
    )
    for fits in ways:
        matching = [name for name in names if fits(name)]
        if len(matching) == 1:
            return matching[0]
        if matching:
            raise ValueError(f"{listed(matching)} may all be the {meant}; say which with {spelled(kind, '=')}")
    advice = f"say which with {spelled(kind, '=')}, the columns are {listed(names)}"
    raise ValueError(f"no column looks like the {meant}; {advice}")


def words(name: str) -> set[str]:
    """Words of a column name in lower case, split at punctuation and where a capital follows a small letter."""
    return set(re.split(r"[\W\d_]+", re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).casefold())) - {""}


def check_different(names: Iterable[str]) -> None:
    """A ValueError for a name that several columns have."""
    if repeated := sorted(name for name, times in Counter(names).items() if times > 1):
        raise ValueError(f"there are several columns with the name {listed(repeated)}; give each another one")


def listed(names: Sequence[str]) -> str:
    """Names for a message, shortened in number and length."""
    shown = [repr(name if len(name) <= NAME_SHOWN else name[: NAME_SHOWN - 1] + "…") for name in names[:NAMES_SHOWN]]
    more = [f"and {len(names) - len(shown)} more"] if len(names) > len(shown) else []
    return ", ".join(shown + more) if names else "none at all"
