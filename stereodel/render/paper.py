"""Numbers in vector files: positions on paper in thousandths of a point, and paths."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from stereodel._arrays import Bytes, FloatArray, Indices
from stereodel.constants import FINEST_PLACE
from stereodel.drawing.page import Page
from stereodel.render.shapes import CLOSE, CURVE, LINE, MOVE, Outline

PLACES = round(1 / FINEST_PLACE)
"""Steps of coordinates in a point."""

LETTERS = {MOVE: "M", LINE: "l", CURVE: "c"}
"""Letters of commands in SVG."""


@dataclass(frozen=True, eq=False)
class Paper:
    """The map from page coordinates to a sheet, in points.

    corner: (2,), page coordinates of the origin of the sheet.
    scale: (2,), points per page unit, right and along the sheet's second axis.
    """

    corner: FloatArray
    scale: FloatArray

    @classmethod
    def downward(cls, page: Page) -> Paper:
        """With the origin in the upper left corner, as in SVG."""
        scale = page.points_per_unit
        return cls(np.array([page.extent[0], page.extent[3]]), np.array([scale, -scale]))

    @classmethod
    def upward(cls, page: Page) -> Paper:
        """With the origin in the lower left corner, as in PDF."""
        scale = page.points_per_unit
        return cls(np.array([page.extent[0], page.extent[2]]), np.array([scale, scale]))

    def points(self, places: Any) -> FloatArray:
        """Places (..., 2) of the page, in points."""
        placed: FloatArray = (np.asarray(places) - self.corner) * self.scale
        return placed

    def placed(self, outline: Outline) -> Outline:
        """An outline of the page, in points."""
        return Outline(self.points(outline.points), outline.kinds)


def number(value: float) -> str:
    """A number to three decimals, as short as possible.

    >>> [number(value) for value in (12.0, 0.25, -0.0004, 1 / 3, -1.5)]
    ['12', '.25', '0', '.333', '-1.5']
    """
    return _written(round(float(value) * PLACES))


def numbers(values: Iterable[float]) -> str:
    """Numbers separated by spaces."""
    return " ".join(map(number, values))


def exact(*values: float) -> str:
    """Numbers other than positions, to six decimals, separated by spaces; without exponents, which PDF lacks.

    >>> exact(0.5, 1.0, 6.1e-17, 2 / 3, -10.0)
    '0.5 1 0 0.666667 -10'
    """
    return " ".join(f"{round(float(value), 6) + 0.0:.6f}".rstrip("0").rstrip(".") for value in values)


def _written(steps: int) -> str:
    whole, rest = divmod(abs(steps), PLACES)
    sign = "-" if steps < 0 else ""
    return f"{sign}{whole or ''}.{rest:03d}".rstrip("0") if rest else f"{sign}{whole}"


def commands(outline: Outline, pattern: Mapping[int, str]) -> str:
    """An outline in points as path commands, without pieces of length zero and those drawn by closing.

    pattern: commands for `MOVE`, `LINE`, `CURVE` and `CLOSE`, with a placeholder for each number.

    >>> square = np.array([(0, 0), (1, 0), (1, 0.0001), (1, 1), (0, 1), (0, 0), (0, 0)], dtype=float)
    >>> kinds = np.array([MOVE, LINE, LINE, LINE, LINE, LINE, CLOSE], dtype=np.uint8)
    >>> commands(Outline(square, kinds), {MOVE: "M%s %s", LINE: "L%s %s", CLOSE: "Z"})
    'M0 0L1 0L1 1L0 1Z'
    """
    steps, kinds = _seen(np.rint(outline.points * PLACES).astype(np.int64), outline.kinds)
    third = np.flatnonzero(kinds == CURVE)[2::3]  # of the points of a curve, which are one command
    begins = np.delete(np.arange(len(kinds)), np.concatenate([third - 1, third]))
    text = list(map(_written, steps.ravel().tolist()))
    parts = []
    for place, kind in zip((2 * begins).tolist(), kinds[begins].tolist(), strict=True):
        count = {CLOSE: 0, CURVE: 6}.get(kind, 2)
        parts.append(pattern[kind] % tuple(text[place : place + count]))
    return "".join(parts)


def runs(outline: Outline) -> list[str]:
    """The runs of an outline in points as compact relative SVG commands.

    Positions are rounded before they are subtracted, so that errors do not accumulate.

    >>> square = np.array([(10, 5), (11, 5), (11, 5.25), (10.5, 5.25), (10, 5)], dtype=float)
    >>> runs(Outline(square, np.array([MOVE, LINE, LINE, LINE, CLOSE], dtype=np.uint8)))
    ['M10 5l1 0l0 .25l-.5 0Z']
    """
    steps, kinds = _seen(np.rint(outline.points * PLACES).astype(np.int64), outline.kinds)
    third = np.flatnonzero(kinds == CURVE)[2::3]
    before = np.arange(len(kinds)) - 1
    before[third - 1], before[third] = third - 3, third - 3
    away = steps - np.where((kinds == MOVE)[:, None], 0, steps[before])
    text = list(map(_written, away.ravel().tolist()))
    parts: list[list[str]] = []
    # The control points of a curve follow its letter, as does its end.
    inner = np.zeros(len(kinds), dtype=bool)
    inner[third], inner[third - 1] = True, True
    for place, (kind, follows) in enumerate(zip(kinds.tolist(), inner.tolist(), strict=True)):
        if kind == MOVE:
            parts.append([])
        if kind == CLOSE:
            parts[-1].append("Z")
            continue
        x, y = text[2 * place : 2 * place + 2]
        parts[-1].append(_beside(parts[-1][-1], x) if follows else f"{LETTERS[kind]}{x}")
        parts[-1].append(_beside(x, y))
    return ["".join(run) for run in parts]


def _beside(before: str, number: str) -> str:
    """A number after another, separated by a space where necessary."""
    apart = number[0] == "-" or (number[0] == "." and "." in before)
    return number if apart else f" {number}"


def _seen(steps: Indices, kinds: Bytes) -> tuple[Indices, Bytes]:
    """The visible part of a path in whole steps."""
    move, line = kinds == MOVE, kinds == LINE
    still = np.zeros(len(kinds), dtype=bool)
    still[1:] = (steps[1:] == steps[:-1]).all(axis=1)
    kept = ~(line & still)
    third = np.flatnonzero(kinds == CURVE)[2::3]
    idle = third[still[third] & still[third - 1] & still[third - 2]]
    kept[np.concatenate([idle, idle - 1, idle - 2])] = False
    run, first = np.cumsum(move) - 1, np.flatnonzero(move)
    moves = np.bincount(run, weights=kept & (line | (kinds == CURVE)), minlength=len(first)) > 0
    # A line back to the start is drawn by closing.
    back = np.flatnonzero(line[:-1] & (kinds[1:] == CLOSE) & (steps[:-1] == steps[first[run[1:]]]).all(axis=1))
    kept[back] = False
    kept &= moves[run]
    return steps[kept], kinds[kept]
