"""Inspection: what reading a table understands of it, without doing anything with it."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from stereodel._arrays import Column
from stereodel.io.formats import Content, Wanted
from stereodel.io.formats.columns import MISSING, far
from stereodel.io.formats.names import DataWarning, listed, spelled
from stereodel.io.table import PointTable, located

SHOWN: Final = 5
"""Rows that are left out, and values, that a text shows."""


@dataclass(frozen=True)
class Inspection:
    r"""What `inspect` found; as a text by ``print``, as JSON by ``json.dumps(inspection.found)``.

    Attributes
    ----------
    found : dict
        ``file``, ``format``; of text ``encoding``, ``separator``, ``header`` (its row), ``thousands`` (marks by
        column); ``columns``, each with its type, range or examples, and number of missing values; ``place``, the
        columns or the notation that say where a point is; ``crs``; ``rows``; ``left_out``, what is wrong by row;
        ``duplicates``, the points that have another one at their place; ``far``, values by column far outside all
        others, and how many there are; ``extent``, west, south, east, north; ``notes``; ``options``, which say aloud
        what was understood; and ``problem``, why the table cannot be read with these options, if it cannot.

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

    def __str__(self) -> str:
        return "\n".join(f"{name.replace('_', ' '):12}{line}".rstrip() for name, line in _lines(self.found))


def summary(name: str, content: Content, wanted: Wanted, kind: str) -> Inspection:
    """What was understood of a file's content, and what reading it says."""
    found: dict[str, Any] = {"file": name, "format": kind}
    notes: list[str] = []
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", DataWarning)
        table, problem = None, ""
        try:
            table = located(content, wanted, name)
        except (ValueError, ImportError) as error:
            problem = str(error)
        notes += [str(each.message) for each in said]
    columns = content.columns() if table is None else dict(table.columns)
    found |= {key: value for key, value in content.understood.items() if value not in ("", {})}
    if table is not None:
        found |= {"crs": table.crs, "rows": len(table), "left_out": dict(content.invalid), **_of_places(table)}
    found["columns"] = {key: _of_column(np.asarray(values)) for key, values in columns.items()}
    outside = {key: far(values.astype(float)) for key, values in _numeric(columns).items()}
    found["far"] = {key: values for key, values in outside.items() if values}
    found |= {"notes": notes, "options": _options(found, wanted), "problem": problem}
    return Inspection(found)


def _numeric(columns: Mapping[str, Any]) -> dict[str, Column]:
    return {key: np.asarray(each) for key, each in columns.items() if np.asarray(each).dtype.kind in "iuf"}


def _of_places(table: PointTable) -> dict[str, Any]:
    if not len(table):
        return {}
    (west, south), (east, north) = table.places.min(axis=0).tolist(), table.places.max(axis=0).tolist()
    alike = len(table) - len(np.unique(table.points(), axis=0))
    swapped = table.surface == "sphere" and max(abs(west), abs(east)) <= 90 < max(abs(south), abs(north))
    return {"duplicates": alike, "extent": [west, south, east, north], "swapped": swapped}


def _of_column(values: Column) -> dict[str, Any]:
    if values.dtype.kind in "iuf":
        known = values[np.isfinite(values)]
        whole = "integer" if values.dtype.kind in "iu" else "number"
        ends = [known.min().item(), known.max().item()] if len(known) else []
        return {"type": whole, "range": ends, "missing": len(values) - len(known)}
    cells = ["" if cell is None else str(cell) for cell in values.ravel().tolist()]
    known_cells = [cell for cell in cells if cell.strip().lower() not in MISSING]
    examples = list(dict.fromkeys(known_cells))[:SHOWN]
    kind = {"M": "time", "b": "boolean"}.get(values.dtype.kind, "text")
    return {"type": kind, "examples": examples, "missing": len(cells) - len(known_cells)}


def _options(found: Mapping[str, Any], wanted: Wanted) -> dict[str, Any]:
    """Arguments that say what was understood."""
    result: dict[str, Any] = {}
    if found.get("encoding", "utf-8-sig") not in ("utf-8-sig", "utf-16"):
        result["encoding"] = found["encoding"]
    place = found.get("place", "").split(": ")[0].split(", ")
    if place != [""] and wanted.plane is None:
        result |= dict(zip(("lon", "lat"), place if len(place) > 1 else place * 2, strict=False))
    if wanted.plane is not None:
        result["plane"] = list(wanted.plane)
    if wanted.crs is not None:
        result["crs"] = wanted.crs
    marks = set(found.get("thousands", {}).values())
    if marks:
        result["decimal"] = "," if marks == {"."} else "."
    sentinels = sorted({value for values in found["far"].values() for value in values})
    if sentinels:
        result["missing"] = sentinels
    if found.get("left_out"):
        result["skip_invalid"] = True
    return result


def _said(name: str, value: Any) -> str:
    """An argument with its value, as it is typed in Python or on the command line."""
    option = spelled(name)
    if option == name:
        return f"{name}={value!r}"
    if value is True:
        return option
    parts = [f"{each:.12g}" if isinstance(each, float) else str(each) for each in np.atleast_1d(value).tolist()]
    return f"{option} {' '.join(parts)}" if name == "plane" else " ".join(f"{option}={each}" for each in parts)


def _lines(found: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The lines of the text: what is not there is left out."""
    lines = [(name, str(found[name])) for name in ("file", "format", "encoding", "separator") if found.get(name)]
    if "header" in found:
        lines.append(("header", f"row {found['header']}"))
    lines += [("thousands", f"{key}: {mark!r}") for key, mark in found.get("thousands", {}).items()]
    lines += [(name, str(found[name])) for name in ("place", "crs", "rows", "duplicates") if found.get(name)]
    left = found.get("left_out", {})
    lines += [("left out", f"row {row}: {why}") for row, why in sorted(left.items())[:SHOWN]]
    if len(left) > SHOWN:
        lines.append(("", f"and {len(left) - SHOWN} more"))
    if "extent" in found:
        lines.append(("extent", ", ".join(f"{end:.9g}" for end in found["extent"])))
    if found.get("swapped"):
        lines.append(("swapped?", "the longitudes look like latitudes, and the other way round"))
    for number, (name, each) in enumerate(found["columns"].items()):
        gaps = f", {each['missing']} missing" if each["missing"] else ""
        values = listed(each["examples"]) if "examples" in each else " to ".join(f"{end:.9g}" for end in each["range"])
        lines.append(("columns" if not number else "", f"{name}: {each['type']}, {values}{gaps}"))
    lines += [("far outside", f"{key}: {each}") for key, each in found["far"].items()]
    lines += [("note", note) for note in found["notes"]]
    lines.append(("options", " ".join(_said(*each) for each in found["options"].items()) or "none are needed"))
    return lines + [("problem", found["problem"])] * bool(found["problem"])
