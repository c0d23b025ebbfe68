"""Places as people write them in cells: degrees with minutes, seconds and letters, and both coordinates in one cell."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Final, NamedTuple

from stereodel._arrays import Column
from stereodel.io.formats.columns import texts

# Characters of word processors in place of those of the keyboard.
PLAIN: Final = str.maketrans({"\N{MINUS SIGN}": "-", "\xa0": " ", "\u202f": " ", "\u2009": " "})
PART: Final = r"[0-9]+(?:[.,][0-9]*)?"
# An angle, such as `10°59'07"E`, `170 41.4 W`, `-12:30`, `N 48.5` and `10d30m`.
ANGLE: Final = re.compile(
    rf"(?P<before>[NSEW])?\s*(?P<sign>[-+])?\s*(?P<degrees>{PART})"
    rf"(?:\s*(?:[°º˚d:]|deg|\s)\s*(?:(?P<minutes>{PART})(?:\s*(?:['′’‘´m:]|min|\s)\s*"
    rf"(?:(?P<seconds>{PART})\s*(?:\"|″|”|“|''|’’|′′|s|sec)?)?)?)?)?\s*(?P<after>[NSEW])?"
)
LETTERS: Final = {"longitude": "EW", "latitude": "NS"}
NEGATIVE: Final = "SW"

NUMBER: Final = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
# A point of well-known text, also extended by the number of its coordinate system.
WKT: Final = re.compile(
    rf"(?:SRID\s*=\s*(?P<srid>[0-9]+)\s*;)?\s*POINT\s*(?:ZM|Z|M)?\s*"
    rf"\(\s*(?P<x>{NUMBER})\s+(?P<y>{NUMBER})(?:\s+{NUMBER})*\s*\)",
    re.IGNORECASE,
)
# What stands between both coordinates of a cell, the surest first.
BETWEEN: Final = tuple(re.compile(each) for each in (r"[;/|]", r",\s", r",", r"(?<=[NSEW])\s*(?=[-+0-9])", r"\s+"))
COMMA: Final = re.compile(r"[-+]?[0-9]+,[0-9]+")  # a number with a decimal comma, or two whole ones
WELL_KNOWN: Final = "well-known text"

LOOKED_AT: Final = 20  # cells from which it is known whether a column has both coordinates


class Angle(NamedTuple):
    """An angle in degrees, and what it is by its letter, "longitude", "latitude" or nothing."""

    degrees: float
    axis: str


class Both(NamedTuple):
    """Both coordinates of a column's cells, as text where they are plain numbers, "" where there are none."""

    x: Column
    y: Column
    how: str
    """What the column was read as: `WELL_KNOWN`, "latitude, longitude" or "longitude, latitude"."""
    crs: str | None


def angle(cell: str) -> Angle | None:
    r"""The angle that a cell says, as the nearest double; None if it says none.

    >>> angle("10°59'07\"E"), angle("48 24.5 S")
    (Angle(degrees=10.985277777777778, axis='longitude'), Angle(degrees=-48.40833333333333, axis='latitude'))
    """
    found = ANGLE.fullmatch(cell.translate(PLAIN).strip())
    if found is None:
        return None
    parts = [found[name] for name in ("degrees", "minutes", "seconds") if found[name]]
    letter = "".join(found[name] for name in ("before", "after") if found[name])
    numbers = [Fraction(part.replace(",", ".").rstrip(".")) for part in parts]
    whole = all(part.isdecimal() for part in parts[:-1])
    if len(letter) > 1 or (letter and found["sign"]) or not whole or any(number >= 60 for number in numbers[1:]):
        return None
    size = float(sum((number / 60**power for power, number in enumerate(numbers)), Fraction(0)))
    axis = next((axis for axis, known in LETTERS.items() if letter and letter in known), "")
    return Angle(-size if found["sign"] == "-" or (letter and letter in NEGATIVE) else size, axis)


def both(values: Column, name: str) -> Both | None:
    """Both coordinates of every cell of a column, where its first ones have two; None where they have not.

    A cell is a point of well-known text, or two angles. Letters say which is which; without them latitude comes first,
    unless the name of the column says otherwise or the first number is beyond 90. A cell that is neither is kept as it
    is, to be told as wrong.
    """
    if values.dtype.kind not in "UO":
        return None
    cells = ["" if cell is None or cell != cell else str(cell).translate(PLAIN).strip() for cell in values.tolist()]
    known = [cell for cell in cells if cell]
    if known and all(WKT.fullmatch(cell) for cell in known[:LOOKED_AT]):
        return _well_known(cells)
    if not known or not all(_pair(cell) for cell in known[:LOOKED_AT]):
        return None
    pairs = [_pair(cell) for cell in cells]
    beyond = any(abs(pair[0].degrees) > 90 and not pair[0].axis for pair in pairs if pair)
    lon_first = beyond or re.search("(lon|lng).*lat", name, re.IGNORECASE | re.DOTALL) is not None
    x, y = list(cells), list(cells)
    for row, pair in enumerate(pairs):
        if pair is not None:
            said = pair[0].axis == "latitude" or pair[1].axis == "longitude"
            lon, lat = pair[::-1] if said or not (lon_first or pair[0].axis or pair[1].axis) else pair
            x[row], y[row] = repr(lon.degrees), repr(lat.degrees)
    return Both(texts(x), texts(y), "longitude, latitude" if lon_first else "latitude, longitude", None)


def _well_known(cells: list[str]) -> Both:
    points = [WKT.fullmatch(cell) for cell in cells]
    systems = {point["srid"] for point in points if point is not None} - {None, "4326"}
    if len(systems) > 1:
        raise ValueError(f"the points are in several coordinate systems, {', '.join(sorted(systems))}")
    both = zip(cells, points, strict=True)
    x, y = zip(*((cell, cell) if point is None else point.group("x", "y") for cell, point in both), strict=True)
    return Both(texts(x), texts(y), WELL_KNOWN, f"EPSG:{systems.pop()}" if systems else None)


def _pair(cell: str) -> tuple[Angle, Angle] | None:
    """The two angles of a cell, at most one of either axis."""
    if COMMA.fullmatch(cell):
        return None
    for between in BETWEEN:
        parts = between.split(cell.strip("()[]{}"))
        if len(parts) == 2 and parts[1]:
            first, second = angle(parts[0]), angle(parts[1])
            if first and second and (first.axis != second.axis or not first.axis):
                return first, second
    return None
