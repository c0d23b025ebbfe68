"""Well-known binary, least byte first, with NumPy alone.

Source: Open Geospatial Consortium, "Simple feature access, part 1: common architecture", OGC 06-103r4, section 8.2;
the numbers of geometries with heights and measures are those of ISO 13249-3.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, Final

import numpy as np

from stereodel._arrays import BoolArray, Bytes, FloatArray, LongArray, Packed
from stereodel.curves.ragged import Ragged

# Geometry types by their codes; 1000 is added for geometries with heights, 2000 with measures, 3000 with both.
KINDS: Final = {1: "Point", 2: "LineString", 3: "Polygon", 4: "MultiPoint", 5: "MultiLineString", 6: "MultiPolygon"}
POINT: Final = np.dtype([("order", "u1"), ("kind", "<u4"), ("xy", "<f8", 2)])  # 21 bytes, more with heights or measures
LINE: Final = bytes([1, 2, 0, 0, 0])
RING: Final = bytes([1, 3, 0, 0, 0, 1, 0, 0, 0])  # headers, before the number of their points
# Header that turns a single-part geometry into a multi-part one, by the code of its type.
ONE: Final = {kind: bytes([1, kind + 3, 0, 0, 0, 1, 0, 0, 0]) for kind in (1, 2, 3)}


def points(places: FloatArray) -> Packed:
    """Points at places (n, 2)."""
    cells = np.empty(len(places), POINT)
    cells["order"], cells["kind"], cells["xy"] = 1, 1, places
    return cells.view(f"V{POINT.itemsize}").astype(object)


def _of_rows(header: bytes, points: Ragged, *, closed: bool) -> Packed:
    result: Packed = np.full(len(points), None, dtype=object)
    sizes = points.sizes
    for size in np.unique(sizes).tolist():
        rows = np.flatnonzero(sizes == size)
        place = points.offsets[rows, None] + np.arange(size + closed) % size
        head = header + (size + closed).to_bytes(4, "little")
        cells = np.empty((len(rows), len(head) + 16 * (size + closed)), dtype=np.uint8)
        cells[:, : len(head)] = np.frombuffer(head, dtype=np.uint8)
        cells[:, len(head) :] = points.values[place].astype("<f8", copy=False).reshape(len(rows), -1).view(np.uint8)
        result[rows] = cells.view(f"V{cells.shape[1]}")[:, 0].astype(object)
    return result


polygons = partial(_of_rows, RING, closed=True)  # of one ring each, given without its first point again at its end
lines = partial(_of_rows, LINE, closed=False)


def with_holes(shell: bytes, holes: Sequence[bytes]) -> bytes:
    """A polygon of one ring, and those of its holes, as one polygon."""
    return b"".join([shell[:5], (1 + len(holes)).to_bytes(4, "little"), shell[9:], *(hole[9:] for hole in holes)])


def grouped(parts: Packed, owner: LongArray, count: int) -> Packed:
    """A geometry for each owner, (count,), multi-part where it has several parts; None where it has none."""
    order = np.argsort(owner, kind="stable")
    cells = Ragged.grouped(parts[order], owner[order], count)
    result: Packed = np.full(count, None, dtype=object)
    alone = cells.sizes == 1
    result[alone] = cells.values[cells.offsets[:-1][alone]]
    for row in np.flatnonzero(cells.sizes > 1).tolist():
        some = cells.values[cells.offsets[row] : cells.offsets[row + 1]].tolist()
        result[row] = b"".join([ONE[_kind(some[0])][:5], len(some).to_bytes(4, "little"), *some])
    return result


def as_geojson(cell: bytes, decimals: int | None = None, at: int = 0) -> tuple[dict[str, Any], int]:
    """The geometry whose bytes begin at a place, as in RFC 7946, without measures; and where they end."""
    above, kind = divmod(int.from_bytes(cell[at + 1 : at + 5], "little"), 1000)
    numbers, kept = (2, 3, 3, 4)[above], 2 + above % 2
    parts: list[Any] = []
    count, at = (1, at + 5) if kind < 3 else (int.from_bytes(cell[at + 5 : at + 9], "little"), at + 9)
    for number in range(count):
        if kind > 3:
            part, at = as_geojson(cell, decimals, at)
            parts.append(part["coordinates"] if kind in KINDS else part)
            continue
        size, at = (1, at) if kind == 1 else (int.from_bytes(cell[at : at + 4], "little"), at + 4)
        places = np.frombuffer(cell, "<f8", size * numbers, at).reshape(size, numbers)[:, :kept]
        at += 8 * size * numbers
        if kind == 3:  # shells run counterclockwise, holes clockwise
            x, y = (places[:, :2] - places[0, :2]).T
            places = places[:: 1 if (x[:-1] @ y[1:] >= x[1:] @ y[:-1]) == (number == 0) else -1]
        parts.append((places if decimals is None else np.round(places, decimals)).tolist())
    if kind not in KINDS:
        return {"type": "GeometryCollection", "geometries": parts}, at
    return {"type": KINDS[kind], "coordinates": parts if kind > 2 else parts[0] if kind == 2 else parts[0][0]}, at


def xy(content: Bytes, offsets: LongArray, rows: Sequence[int]) -> FloatArray:
    """Coordinates (n, 2) of points whose bytes are `content` from each offset to the next (n + 1,).

    ValueError for the first that is no point gives its number in `rows`.
    """
    if len(offsets) < 2:
        return np.empty((0, 2))
    wrong = np.diff(offsets) < POINT.itemsize
    if not wrong.any():
        cells = content[offsets[:-1, None] + np.arange(POINT.itemsize)].view(POINT).ravel()
        wrong = (cells["order"] != 1) | ~np.isin(cells["kind"], (1, 1001, 2001, 3001))
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
