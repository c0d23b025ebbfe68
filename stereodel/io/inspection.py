"""Inspection: what reading a table understands of it, without doing anything with it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from shlex import quote
from typing import Any, ClassVar, Final

import numpy as np

from stereodel._arrays import Column
from stereodel._notebook import Displayed
from stereodel.io.formats import Content, Wanted
from stereodel.io.formats.columns import MISSING, OTHER, doubles, far
from stereodel.io.formats.names import listed, spelled
from stereodel.io.table import located

SHOWN: Final = 5  # rows that are left out, and values, that a text shows


@dataclass(frozen=True)
class Inspection(Displayed):
    r"""What `inspect` found; as a text by ``print`` and in notebooks, as JSON by ``json.dumps(inspection.found)``.

    Attributes
    ----------
    found : dict
        ``file``, ``format``; of text ``encoding``, ``separator``, ``header`` (its line, None without), ``thousands``
        (marks by column); ``columns``, each with its type, range or examples, and number of missing values; ``place``,
        the columns that say where a point is, and ``notation`` of one that has both coordinates; ``crs``; ``rows``;
        ``left_out``, what is wrong by row; ``swapped``, whether the axes seem to be; ``duplicates``, the points that
        have another one at their place; ``far``, values by column far outside all others, and how many there are;
        ``extent``, west, south, east, north; ``notes``; ``options``, which say aloud what was understood; and
        ``problem``, why the table cannot be read with these options, if it cannot.

    Examples
    --------
    >>> import io
    >>> from stereodel.io import inspect
    >>> print(inspect(io.StringIO("name;Länge;Breite\nUlm;9,99;48,4\nKiel;10,1;54,3")))
    format      csv
    encoding    utf-8-sig
    separator   ;
    header      row 1
    place       Länge, Breite
    crs         EPSG:4326
    rows        2
    extent      9.99, 48.4, 10.1, 54.3
    columns     name: text, 'Ulm', 'Kiel'
    options     lon='Länge' lat='Breite'
    """

    found: dict[str, Any]
    _mimes: ClassVar[Any] = lambda it: ({"text/plain": str(it)}, {})

    def __str__(self) -> str:
        said = {
            SHOWN_AS.get(name, name): LINES.get(name, _text)(value)
            for name, value in self.found.items()
            if value or name in ALWAYS
        }
        return "\n".join(f"{name:12}{text}".replace("\n", "\n" + " " * 12) for name, text in said.items())


def summary(name: str, content: Content, wanted: Wanted, kind: str) -> Inspection:
    """What was understood of a file's content; what is said while it is read is a warning."""
    found: dict[str, Any] = {"file": name, "format": kind}
    table, problem = None, ""
    try:
        table = located(content, wanted, name)
    except (ValueError, ImportError) as error:
        problem = str(error)
    found |= {key: value for key, value in content.understood.items() if value not in ("", {})}
    columns = {key: np.asarray(each) for key, each in (content.columns() if table is None else table.columns).items()}
    if table is not None:
        found |= {"crs": table.crs, "rows": len(table), "left_out": dict(sorted(content.invalid.items()))}
        problem = "no row has a place" if found["left_out"] and not len(table) else ""
        two = len(found.get("place", ())) == 2 and wanted.plane is None and wanted.crs is None
        found["swapped"] = two and _swapped(content, found["place"])
    if table is not None and len(table):
        found["duplicates"] = len(table) - len(np.unique(table.points(), axis=0))
        found["extent"] = [*table.places.min(axis=0).tolist(), *table.places.max(axis=0).tolist()]
    found["columns"] = {key: _of_column(values) for key, values in columns.items()}
    outside = {key: far(values.astype(float)) for key, values in columns.items() if values.dtype.kind in "iuf"}
    found["far"] = {key: values for key, values in outside.items() if values}
    return Inspection(found | {"options": _options(found, wanted), "problem": problem})


def _swapped(content: Content, place: Sequence[str]) -> bool:
    """Whether more rows have a place only if the longitude is the latitude than have one as they are."""
    columns = content.columns()
    lon, lat = (np.abs(doubles(np.asarray(columns[name]), decimal=True)[0]) for name in place)
    return bool(((lon <= 90) & (lat > 90) & (lat <= 360)).sum() > (lat <= 90).sum())


def _of_column(values: Column) -> dict[str, Any]:
    if values.dtype.kind in "iuf":
        known = values[np.isfinite(values)]
        ends = [known.min().item(), known.max().item()] if len(known) else []
        whole = "number" if values.dtype.kind == "f" else "integer"
        return {"type": whole, "range": ends, "missing": len(values) - len(known)}
    cells = ["" if cell is None else str(cell) for cell in values.ravel().tolist()]
    given = [cell for cell in cells if cell.strip().lower() not in MISSING]
    kind = {"M": "time", "b": "boolean"}.get(values.dtype.kind, "text")
    return {"type": kind, "examples": list(dict.fromkeys(given))[:SHOWN], "missing": len(cells) - len(given)}


def _options(found: Mapping[str, Any], wanted: Wanted) -> dict[str, Any]:
    """Arguments that say what was understood, and those that were given."""
    result = {name: value for name, value in vars(wanted).items() if value and name not in NOT_SAID}
    if found.get("encoding") not in (None, "utf-8-sig", "utf-16"):
        result["encoding"] = found["encoding"]
    if "place" in found and wanted.plane is None:
        result |= {"lon": found["place"][0], "lat": found["place"][-1]}
    if marks := set(found.get("thousands", {}).values()):
        result["decimal"] = OTHER[min(marks)]
    if (found.get("header") or 1) > 1:
        result["skip_rows"] = found["header"] - 1
    sentinels = sorted({value for values in found["far"].values() for value in values})
    if sentinels or wanted.sentinels:
        result["missing"] = [*wanted.sentinels, *sentinels]
    if found.get("left_out") and found["rows"]:
        gaps = all(why.endswith(" is missing") for why in found["left_out"].values())
        result["skip_missing" if gaps else "skip_invalid"] = True
    return result | ({"plane": list(wanted.plane)} if wanted.plane else {})


def _typed(options: Mapping[str, Any]) -> str:
    """Arguments with their values, as they are typed in Python or on the command line."""
    parts: list[str] = []
    for name, value in options.items():
        option = spelled(name)
        several = [f"{each:.12g}" if isinstance(each, float) else str(each) for each in np.atleast_1d(value).tolist()]
        if option == name:
            parts.append(f"{name}={value!r}")
        elif value is True or name == "plane":
            parts += [option, *(map(quote, several) if name == "plane" else [])]
        else:
            parts += [quote(f"{option}={each}") for each in several]
    return " ".join(parts) or "none are needed"


def _text(value: Any) -> str:
    """A value as text, lists with commas."""
    if isinstance(value, list):
        return ", ".join(map(_text, value))
    return f"{value:.9g}" if isinstance(value, float) else str(value)


def _of_columns(columns: Mapping[str, Mapping[str, Any]]) -> str:
    lines = []
    for name, each in columns.items():
        values = listed(each["examples"]) if "examples" in each else " to ".join(map(_text, each["range"]))
        lines.append(f"{name}: {each['type']}, {values}" + (f", {each['missing']} missing" if each["missing"] else ""))
    return "\n".join(lines)


def _of_rows(rows: Mapping[int, str]) -> str:
    more = [f"and {len(rows) - SHOWN} more"] if len(rows) > SHOWN else []
    return "\n".join([f"row {row}: {why}" for row, why in [*rows.items()][:SHOWN]] + more)


# Texts of what was found, `_text` for the rest; nothing is said where there is nothing, but `ALWAYS`.
LINES: Final[dict[str, Callable[[Any], str]]] = {
    "header": lambda row: f"row {row}" if row else "none",
    "thousands": lambda marks: "\n".join(f"{name}: {mark!r}" for name, mark in marks.items()),
    "left_out": _of_rows,
    "swapped": lambda _: "the longitudes look like latitudes, and the other way round",
    "columns": _of_columns,
    "far": lambda far: "\n".join(f"{k}: {_text(end)} ({n})" for k, ends in far.items() for end, n in ends.items()),
    "notes": "\n".join,
    "options": _typed,
}
ALWAYS: Final = ("header", "rows", "options")
SHOWN_AS: Final = {"left_out": "left out", "swapped": "swapped?", "far": "far outside", "notes": "note"}

NOT_SAID: Final = ("skip_invalid", "progress")  # what inspection gives reading itself
