"""Cells with equal values as one feature: what they have together, and their polygons without the sides between them.

Dissolved are the cells as they are drawn, before they are clipped, since there neighbours share all points of their
sides, also where the map is cut. So a union is a question of which sides occur twice, and no crossing is computed: what
remains has the points of the cells, to the bit.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from fractions import Fraction
from itertools import pairwise
from math import fsum
from typing import Any

import numpy as np

from stereodel._arrays import Column, FloatArray, Geometries, Indices, Packed
from stereodel.constants import DISSOLVE_LOSS
from stereodel.curves.ragged import Ragged
from stereodel.io.formats.columns import as_text, plain
from stereodel.io.formats.map_rows import packed, shapely, unpacked
from stereodel.io.formats.names import listed, spelled
from stereodel.io.maps.clipping import areal


def dividing(name: str, columns: Mapping[str, Column], what: str) -> Column:
    """The column by which cells are dissolved; ValueError if there is none, or if something else is asked for."""
    if what != "cells" or name not in columns:
        of = f"cells, not for {what}" if what != "cells" else f"one of columns, which are {listed([*columns])}"
        raise ValueError(f"{spelled('dissolve')} is {name!r}, but it is for {of}")
    return columns[name]


def codes_of(values: Any) -> Indices:
    """A number for each of the values, the same for equal ones, from 0 in the order of their first; missing is one."""
    known: dict[Any, int] = {}
    cells = np.asarray(values).tolist()
    keys = (cell if isinstance(cell, str | int | float) and cell == cell else as_text(plain(cell)) for cell in cells)
    return np.array([known.setdefault(key, len(known)) for key in keys], dtype=np.intp)


def grouped(codes: Indices, chosen: Any = True, count: int = 0) -> Ragged:
    """The rows of each of `count` codes, in their order; of those chosen, and none whose code is negative."""
    some = np.flatnonzero(chosen & (codes >= 0))
    rows = some[np.argsort(codes[some], kind="stable")]
    return Ragged.grouped(rows, codes[rows], count)


def added(values: FloatArray, groups: Ragged) -> FloatArray:
    """Sums of the values of each group, rounded once."""
    cells = values[groups.values].tolist()
    try:
        return np.array([fsum(cells[begin:end]) for begin, end in pairwise(groups.offsets.tolist())])
    except OverflowError as error:
        raise ValueError("a sum is beyond the largest double; divide the values by a power of ten") from error


def averaged(values: FloatArray, groups: Ragged) -> FloatArray:
    """Means of the values of each group, NaN for an empty one; rounded once, from sums in twice the precision."""
    cells, high = values[groups.values].tolist(), added(values, groups).tolist()
    parts = zip(pairwise(groups.offsets.tolist()), high, strict=True)
    rest = (Fraction(total) + Fraction(fsum([*cells[a:b], -total])) if a < b else 0 for (a, b), total in parts)
    return np.array([float(total / n) if n else np.nan for total, n in zip(rest, groups.sizes.tolist(), strict=True)])


def merged(cells: Mapping[str, Any], groups: Ragged) -> dict[str, Column]:
    """Columns of groups of cells: the first point of each, the number of cells, and their area together."""
    first = cells["point"][groups.values[groups.offsets[:-1]]]
    return {"point": first, "cells": groups.sizes, "area": added(cells["area"], groups)}


def cell_columns(diagram: Any, radius: float, by: Any = None) -> dict[str, Column]:
    """The cells of a diagram without their shapes: their points and areas, or those of equal values together."""
    kept = np.flatnonzero(diagram.is_kept)
    cells = {"point": kept, "area": diagram.areas(radius=radius)[kept]}
    return cells if by is None else merged(cells, grouped(codes_of(by[kept])))


def dissolved(binary: Packed, groups: Ragged) -> Packed:
    """The polygons of each group as one."""
    result: Packed = binary[groups.values[groups.offsets[:-1]]]
    for k in np.flatnonzero(groups.sizes > 1).tolist():
        parts = shapely.get_parts(unpacked(binary[groups.values[groups.offsets[k] : groups.offsets[k + 1]]]))
        result[k] = packed(areal(np.array([_union(parts)], dtype=object)))[0]
    return result


def _union(parts: Geometries) -> Any:
    """Polygons that share all points of their sides as one.

    Cells narrower than a micrometre may cross others: where that is found, their union is an overlay.
    """
    whole = shapely.area(parts).sum()
    with suppress(shapely.errors.GEOSException):
        union = shapely.coverage_union_all(parts)
        if shapely.is_valid(union) and abs(shapely.area(union) - whole) <= DISSOLVE_LOSS * whole:
            return union
    return shapely.union_all(parts)
