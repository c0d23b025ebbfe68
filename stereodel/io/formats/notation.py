"""Places as people write them in cells: degrees with minutes, seconds and letters, and both coordinates in one cell."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from fractions import Fraction
from typing import Any, Final, NamedTuple

from stereodel._arrays import Column
from stereodel.io.formats.columns import MISSING, texts
from stereodel.io.formats.names import LON_FIRST, WORDS, note, words

# Characters of word processors and other scripts in place of those of the keyboard.
PLAIN: Final = {ord(zero) + digit: str(digit) for zero in WORDS["zeros"] for digit in range(10)} | str.maketrans(
    WORDS["printed"], WORDS["typed"], WORDS["unseen"]
)
# Points of the compass, by axis and sign. O is east in German and west in Romance languages, see `with_letters`.
COMPASS: Final = {
    "E": ("longitude", 1.0),
    "W": ("longitude", -1.0),
    "O": ("longitude", math.nan),
    "N": ("latitude", 1.0),
    "S": ("latitude", -1.0),
}
POINTS: Final = {
    word.casefold(): point
    for letter, point in COMPASS.items()
    for word in (letter, *WORDS["compass"].get(letter, "").split())
}
WORD: Final = rf"(?i:{'|'.join(re.escape(word) for word in POINTS if len(word) > 1)})|[NSEWO]"
LONE_O: Final = re.compile(r"(?<![^\W\d])O(?![^\W\d])")
# What it is by other words of its column, or by the language of the column's name.
SAYS_O: Final = {
    "E": {"W", "West", "Süd", "länge", "laenge", "längengrad", "laengengrad"},
    "W": {"E", "Est", "Este", "Sur", "Sul", "longitud", "longitudine"},
}
O_IS: Final = "has an O, which is east in German and west in French, Spanish and Italian; write E or W in its place"
# The name of a column of such letters behind that of the degrees, as of NMEA and Exif.
LETTERED: Final = re.compile(WORDS["lettered"], re.IGNORECASE)
LONGEST: Final = 200  # characters of a cell that may be a place
PART: Final = r"[0-9]+(?:[.,][0-9]*)?"
# An angle, such as `10°59'07"E`, `170 41.4 W`, `-12:30`, `N 48.5`, `10d30m` and `9,5° Ost`.
ANGLE: Final = re.compile(
    rf"(?P<before>{WORD})?\s*(?P<sign>[-+])?\s*(?P<degrees>[0-9]{{1,3}}(?:[.,][0-9]*)?)"
    rf"(?:\s*(?:[°º˚d:度]|deg(?:rees?)?|\s)\s*(?:(?P<minutes>{PART})(?:\s*(?:['′’‘´m:分]|min|\s)\s*"
    rf"(?:(?P<seconds>{PART})\s*(?:\"|″|”|“|''|’’|′′|秒|s|sec)?)?)?)?)?\s*(?P<after>{WORD})?"
)

NUMBER: Final = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
# A point of well-known text, also extended by the number of its coordinate system.
WKT: Final = re.compile(
    rf"(?![^\0]{{{LONGEST}}})(?:SRID\s*=\s*(?P<srid>[0-9]+)\s*;)?\s*(?:MULTI)?POINT\s*(?:ZM|Z|M)?\s*"
    rf"(?:EMPTY|\(+\s*(?P<x>{NUMBER})\s+(?P<y>{NUMBER})(?:\s+{NUMBER})*\s*\)+)",
    re.IGNORECASE,
)
# What stands between both coordinates of a cell, the surest first.
BETWEEN: Final = tuple(
    re.compile(each)
    for each in (r"[;/|]", r",\s", r",", r"(?<=[^\W\d])\s*(?=[-+0-9])", rf"(?<=[^\s\w]|\d)\s*(?={WORD})", r"\s+")
)
COMMA: Final = re.compile(r"[-+]?[0-9]+,[0-9]+")  # a number with a decimal comma, or two whole ones
WELL_KNOWN: Final = "well-known text"

LOOKED_AT: Final = 20  # cells from which it is known whether a column has both coordinates

Both = tuple[Column, Column, str, str | None]  # x, y, what they were read as, and coordinate system, None for degrees


class Angle(NamedTuple):
    """An angle in degrees, and what it is by its letter, "longitude", "latitude" or nothing."""

    degrees: float
    axis: str


def angle(cell: str) -> Angle | None:
    r"""The angle that a cell says, as the nearest double; None if it says none.

    >>> angle("10°59'07\"E"), angle("48 24.5 S")
    (Angle(degrees=10.985277777777778, axis='longitude'), Angle(degrees=-48.40833333333333, axis='latitude'))
    """
    found = ANGLE.fullmatch(" ".join(cell[:LONGEST].translate(PLAIN).split()))  # as runs of blanks take long
    if found is None or len(cell) > LONGEST:
        return None
    parts = [found[name] for name in ("degrees", "minutes", "seconds") if found[name]]
    said = [found[name] for name in ("before", "after") if found[name]]
    numbers = [Fraction(part.replace(",", ".").rstrip(".")) for part in parts]
    whole = all(part.isdecimal() for part in parts[:-1])
    if len(said) > 1 or (said and found["sign"]) or not whole or any(number >= 60 for number in numbers[1:]):
        return None
    size = float(sum((number / 60**power for power, number in enumerate(numbers)), Fraction(0)))
    axis, way = POINTS[said[0].casefold()] if said else ("", -1.0 if found["sign"] == "-" else 1.0)
    return Angle(way * size, axis)


def with_letters(columns: Mapping[str, Column], name: str, axis: str = "") -> Column:
    """A column of angles, with the letters of a column behind it, and E or W for an O where words say which it is."""
    values, names = columns[name], [*columns]
    beside = [each for each in names[names.index(name) + 1 :][:1] if axis and LETTERED.fullmatch(each)]
    if not beside and (values.dtype.kind not in "UO" or "O" not in "".join(map(str, values.tolist()))):
        return values
    cells, letters = ([_written(cell) for cell in columns[key].tolist()] for key in (name, *beside, name)[:2])
    axes, read, told = {POINTS.get(each.casefold(), ("",))[0] for each in letters if each}, cells, ""
    if beside and axes == {axis} and "-" not in "".join(cells):
        read = [cell and f"{cell} {letter}".strip() for cell, letter in zip(cells, letters, strict=True)]
        told = f"column {beside[0]!r} is read as the points of the compass of {name!r}"
    said = words(name).union(re.findall(r"[^\W\d]+", "\n".join(read)))
    ways = [way for way, by in SAYS_O.items() if by & said]
    if "O" in said and len(ways) == 1:
        read = [LONE_O.sub(ways[0], cell) for cell in read]
        told += f"{told and '; '}column {name!r}: O is read as {ways[0]}, by its name or other words"
    if told:
        note(f"{told}; write letters beside the numbers to say it")
    return texts(read) if told else values


def _written(cell: Any) -> str:
    """What a cell says, with the characters of the keyboard; "" for nothing."""
    text = str(cell).translate(PLAIN).strip()
    return "" if text.lower() in MISSING else text


def both(values: Column, name: str) -> Both | None:
    """Both coordinates of every cell of a column, where its first ones have two; None where they have not.

    A cell is a point of well-known text, or two angles. Letters say which is which; without them latitude comes first,
    unless the name of the column says otherwise or the first number is beyond 90. A cell that is neither is kept as it
    is, to be told as wrong.
    """
    if values.dtype.kind not in "UO":
        return None
    cells = [_written(cell) for cell in values.tolist()]
    known = [cell for cell in cells if cell]
    if known and all(WKT.fullmatch(cell) for cell in known[:LOOKED_AT]):
        return _well_known(cells)
    if not known or not all(_pair(cell) for cell in known[:LOOKED_AT]):
        return None
    cells = with_letters({name: texts(cells)}, name).tolist()
    pairs = [_pair(cell) for cell in cells]
    beyond = any(abs(pair[0].degrees) > 90 and not pair[0].axis for pair in pairs if pair)
    lon_first = beyond or LON_FIRST.search(name) is not None
    x, y = list(cells), list(cells)
    for row, pair in enumerate(pairs):
        if pair is not None:
            said = pair[0].axis == "latitude" or pair[1].axis == "longitude"
            lon, lat = pair[::-1] if said or not (lon_first or pair[0].axis or pair[1].axis) else pair
            x[row], y[row] = (cells[row] if each.degrees != each.degrees else repr(each.degrees) for each in (lon, lat))
    return texts(x), texts(y), "longitude, latitude" if lon_first else "latitude, longitude", None


def _well_known(cells: list[str]) -> Both:
    points = [WKT.fullmatch(cell) for cell in cells]
    systems = {point["srid"] for point in points if point is not None} - {None, "4326"}
    if len(systems) > 1:
        raise ValueError(f"the points are in several coordinate systems, {', '.join(sorted(systems))}")
    both = zip(cells, points, strict=True)
    x, y = zip(*((cell, cell) if point is None else point.groups("")[1:3] for cell, point in both), strict=True)
    return texts(x), texts(y), WELL_KNOWN, f"EPSG:{systems.pop()}" if systems else None


def is_place(cell: str) -> bool:
    """Whether a line has both coordinates, and no more."""
    return bool(WKT.fullmatch(cell.strip()) or _pair(cell.strip()))


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
