"""What the numbers in the arrays of a page are called, so that a difference can be told in words.

`stereodel.drawing.Page.arrays` names an array after the number, the kind and the name of an item and what it holds of
it, and puts the fields of a style side by side.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Final


def _color(what: str) -> tuple[str, ...]:
    return tuple(f"{what} {part}" for part in ("red", "green", "blue", "opacity"))


FIELDS: Final[Mapping[tuple[str, str], tuple[str, ...]]] = {
    ("page", ""): ("left", "right", "bottom", "top", "width", *_color("background")),
    ("stroke", "style"): (*_color("colour"), "width", "dash length", "dash gap", "round ends", "closed"),
    ("polylines", "style"): (*_color("colour"), "width"),
    ("fill", "style"): _color("colour"),
    ("fill", "ball"): ("ball x", "ball y", "ball radius"),
    ("polygons", "ball"): ("ball x", "ball y", "ball radius"),
    ("dots", "style"): ("radius", *_color("colour"), *_color("rim"), "rim width"),
    ("label", "place"): (
        *("anchor x", "anchor y", "offset x", "offset y", "size", *_color("colour"), "rotation"),
        *("halo", *_color("halo colour")),
    ),
    ("label", "text"): ("text", "align", "valign"),
}
"""Kind of an item and what an array holds of it → the fields in their order."""

ROWS: Final[Mapping[str, tuple[str, ...]]] = {
    "path": ("curve", "control point"),
    "outline": ("curve", "control point"),
    "points": ("point",),
    "centers": ("dot",),
    "colors": ("region",),
    "sizes": ("loop",),
    "offsets": ("line",),
    "owner": ("loop",),
}
"""What an array holds → what its axes count, but for the last of those that have `COLUMNS`."""

COLUMNS: Final[Mapping[str, tuple[str, ...]]] = {
    **dict.fromkeys(("path", "outline", "points", "centers"), ("x", "y")),
    "colors": _color("colour"),
}
"""What an array holds → what is side by side in its last axis."""


def item_of(name: str, texts: Mapping[int, str] | None = None) -> str:
    """The item that an array belongs to, in words, labels with their texts; the name where it belongs to none.

    Examples
    --------
    >>> item_of("0003_stroke_limb_style"), item_of("0012_label_label_place", {12: "north"}), item_of("geometry_sites")
    ('stroke 3 (limb), style', 'label 12 ("north"), place', 'geometry_sites')
    """
    number, kind, called, key = _parts(name)
    if not number:
        return name
    title = f'"{texts[int(number)]}"' if texts and int(number) in texts else called
    return f"{kind} {int(number)}{f' ({title})' if title not in ('', kind) else ''}, {key}"


def fields_of(name: str) -> tuple[str, ...]:
    """Names of the entries of an array that holds fields side by side; none for any other.

    Examples
    --------
    >>> fields_of("0012_label_label_place")[2:5]
    ('offset x', 'offset y', 'size')
    """
    _, kind, _, key = _parts(name)
    return FIELDS.get((kind, key), ())


def place_in(name: str, index: tuple[int, ...]) -> str:
    """Where an entry of an array is.

    Examples
    --------
    >>> place_in("0003_stroke_limb_path", (5, 0, 1)), place_in("geometry_sites", (4, 2))
    ('in y of curve 5, control point 0', 'at (4, 2)')
    """
    key = _parts(name)[3]
    rows, columns = ROWS.get(key, ()), COLUMNS.get(key, ())
    if len(index) != len(rows) + bool(columns) or not rows:
        return f"at {index}"
    counted = ", ".join(f"{row} {number}" for row, number in zip(rows, index, strict=False))
    return f"in {columns[index[-1]]} of {counted}" if columns else f"in {counted}"


def _parts(name: str) -> tuple[str, str, str, str]:
    """Number, kind and name of an item, and what of it; of the page itself the kind alone."""
    found = re.fullmatch(r"(\d+)_([a-z]+)_(.*)_([a-z]+)", name)
    number, kind, called, key = found.groups() if found else ("", name, "", "")
    return number, kind, called, key
