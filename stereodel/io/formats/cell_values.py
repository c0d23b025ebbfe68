"""Cells of columns for formats that have fewer types than columns: what they hold instead, and what they refuse."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from stereodel.io.formats.names import listed

UNWRITABLE: Final = {
    "kml": re.compile("[\x00-\x08\x0b-\x1f\ufffe\uffff\ud800-\udfff]"),
    **dict.fromkeys(("gpkg", "fgb", "shp"), re.compile("[\x00\ud800-\udfff]")),
}
"""Characters that text of a format cannot have: those that XML lacks or changes, and the end of text in GDAL."""
HALVES: Final = re.compile("[\ud800-\udfff]")
"""Halves of characters, which UTF-8 lacks."""

LARGEST: Final = {"shp": 1e23, "kml": 1.797693134862315e308}
"""From here on a number has more digits than a shapefile's field, or GDAL's 15 digits of it are infinite."""


def plain_cells(values: Any) -> list[Any]:
    """The values of a column as JSON has them, None for missing and infinite ones."""
    array = np.asarray(values)
    return [plain(cell) for cell in (array if array.dtype.kind in "mM" else array.tolist())]


def plain(cell: Any) -> Any:
    """One value: dates are text as in ISO 8601, bytes are hexadecimal, durations and other objects as `str` says."""
    if cell is None or isinstance(cell, bool | int | str):
        return cell
    if isinstance(cell, float | np.floating):
        return float(cell) if np.isfinite(cell) else None
    if isinstance(cell, np.datetime64 | np.timedelta64):
        return None if np.isnat(cell) else str(cell)
    if isinstance(cell, np.bool_ | np.integer):
        return cell.item()
    if isinstance(cell, bytes):
        return cell.hex().upper()
    if isinstance(cell, Mapping):
        return {str(name): plain(part) for name, part in cell.items()}
    if isinstance(cell, list | tuple | set | np.ndarray):
        return [plain(part) for part in cell]
    if type(cell).__name__ == "NAType" or cell != cell:  # missing values of pandas and NumPy
        return None
    return cell.isoformat() if hasattr(cell, "isoformat") else str(cell)


def as_text(cell: Any) -> Any:
    """A plain value as text, lists and mappings as JSON; None stays."""
    if isinstance(cell, list | dict):
        return json.dumps(cell, ensure_ascii=False, allow_nan=False)
    return cell if cell is None else str(cell)


def check_held(columns: Mapping[str, Any], kind: str) -> None:
    """Raise ValueError that names the column for text or numbers that a format cannot hold."""
    pattern = UNWRITABLE.get(kind, HALVES)
    wrong = [name for name in columns if pattern.search(name)]
    if wrong:
        raise ValueError(f"the column name {listed(wrong[:1])} has a character that .{kind} cannot hold")
    for name, values in columns.items():
        array = np.asarray(values)
        if array.dtype.kind in "UO":
            said = next((cell for cell in array.ravel().tolist() if type(cell) is str and pattern.search(cell)), None)
            if said is not None:
                raise ValueError(
                    f"column {name!r} has the text {listed([said])}, with a character that .{kind} cannot hold; "
                    "replace it, or choose another format"
                )
        if kind in LARGEST and array.dtype.kind == "f":
            sizes = np.abs(array.astype(np.float64))
            beyond = np.isfinite(sizes) & (sizes >= LARGEST[kind])
            if beyond.any():
                raise ValueError(
                    f"column {name!r} has the number {array[beyond][0]}, which .{kind} cannot hold; "
                    "choose another format"
                )
