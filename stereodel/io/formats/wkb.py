"""Well-known binary, least byte first, with NumPy alone.

Source: Open Geospatial Consortium, "Simple feature access, part 1: common architecture", OGC 06-103r4, section 8.2;
the numbers of geometries with heights and measures are those of ISO 13249-3.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from stereodel._arrays import BoolArray, Bytes, FloatArray, LongArray, Packed
from stereodel.curves.ragged import Ragged

KINDS: Final = {1: "Point", 2: "LineString", 3: "Polygon", 4: "MultiPoint", 5: "MultiLineString", 6: "MultiPolygon"}
"""Geometry types by their codes; 1000 is added for geometries with heights, 2000 with measures, 3000 with both."""

POINT: Final = np.dtype([("order", "u1"), ("kind", "<u4"), ("xy", "<f8", 2)])
"""A point: 21 bytes, and more where it has a height or measure."""

POINTS: Final = (1, 1001, 2001, 3001)
"""Codes of points."""

RING: Final = np.frombuffer(bytes([1, 3, 0, 0, 0, 1, 0, 0, 0]), dtype=np.uint8)
"""Header of a polygon with one ring, before the number of its points."""

ONE: Final = {kind: bytes([1, kind + 3, 0, 0, 0, 1, 0, 0, 0]) for kind in (1, 2, 3)}
"""Header that turns a single-part geometry into a multi-part one, by the code of its type."""


def points(places: FloatArray) -> Packed:
    """Points at places (n, 2)."""
    cells = np.empty(len(places), POINT)
    cells["order"], cells["kind"], cells["xy"] = 1, 1, places
    return cells.view(f"V{POINT.itemsize}").astype(object)


def polygons(rings: Ragged) -> Packed:
    """Polygons of one ring each, given without its first point again at its end."""
    result: Packed = np.full(len(rings), None, dtype=object)
    sizes = rings.sizes
    for size in np.unique(sizes).tolist():
        rows = np.flatnonzero(sizes == size)
        place = rings.offsets[rows, None] + np.append(np.arange(size), 0)
        cells = np.empty((len(rows), len(RING) + 4 + 16 * (size + 1)), dtype=np.uint8)
        cells[:, : len(RING)] = RING
        cells[:, len(RING) : len(RING) + 4] = np.array([size + 1], dtype="<u4").view(np.uint8)
        cells[:, len(RING) + 4 :] = rings.values[place].astype("<f8", copy=False).reshape(len(rows), -1).view(np.uint8)
        result[rows] = cells.view(f"V{cells.shape[1]}")[:, 0].astype(object)
    return result


def xy(content: Bytes, offsets: LongArray, rows: Sequence[int]) -> FloatArray:
    """Coordinates (n, 2) of points whose bytes are `content` from each offset to the next (n + 1,).

    ValueError for the first that is no point gives its number in `rows`.
    """
    if len(offsets) < 2:
        return np.empty((0, 2))
    wrong = np.diff(offsets) < POINT.itemsize
    if not wrong.any():
        cells = content[offsets[:-1, None] + np.arange(POINT.itemsize)].view(POINT).ravel()
        wrong = (cells["order"] != 1) | ~np.isin(cells["kind"], POINTS)
    if wrong.any():
        raise ValueError(f"row {rows[np.flatnonzero(wrong)[0]]}: a Point is needed, not another geometry")
    return np.ascontiguousarray(cells["xy"])


def is_there(binary: Packed) -> BoolArray:
    """Which rows have a geometry."""
    return np.array([cell is not None for cell in binary.tolist()], dtype=np.bool_)


def kinds(binary: Packed) -> list[str]:
    """Types of the geometries, each once, in the order of their codes."""
    found = {_kind(cell) for cell in binary.tolist() if cell is not None}
    return [KINDS.get(kind % 1000, "GeometryCollection") + (" Z" if kind > 1000 else "") for kind in sorted(found)]


def several(binary: Packed) -> list[bytes | None]:
    """Single-part geometries as multi-part ones."""
    return [cell and ONE.get(_kind(cell), b"") + cell for cell in binary.tolist()]


def _kind(cell: bytes) -> int:
    return int.from_bytes(cell[1:5], "little")
