"""Numbers in vector files: positions on paper in thousandths of a point, paths, and the light on a ball.

Pixels of a ball are shaded individually (`shaders/flat.frag`); no gradient of SVG or PDF has that form. Theirs have
circles about (1 − s) f + s c with radii s r. The brightness at some s was fitted to that of pixels by least squares,
and focus f and centre c, on the axis toward the light, are those with the smallest maximum difference.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from stereodel._arrays import Bytes, FloatArray, Indices
from stereodel.constants import FINEST_PLACE
from stereodel.drawing.page import Ball, Page
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.items import Ramp
from stereodel.render.vector.outlines import CLOSE, CURVE, LINE, MOVE, Outlines

PLACES = round(1 / FINEST_PLACE)
"""Steps of coordinates in a point."""

LETTERS = {MOVE: "M", LINE: "l", CURVE: "c"}
"""Letters of commands in SVG."""

OPERATORS = {MOVE: "%s %s m\n", LINE: "%s %s l\n", CURVE: "%s %s %s %s %s %s c\n", CLOSE: "h\n"}
"""Operators of paths in PDF."""

FOCUS: Final = (-0.5065010061498, 0.6512155793355)
CENTER: Final = (-0.0755619216634, 0.0971510421386)
RADIUS: Final = 1.1230769230769
"""Focus and last circle of the gradient of a ball of radius 1 about the origin, x right, y up."""

OFFSETS: Final = tuple((1 - np.linspace(1, 0, 16) ** 2).tolist())
"""Values of s at which the gradient has a colour, linear in between; denser outward, where the light falls fastest."""

BRIGHTNESS: Final = (
    *(0.999774020676, 0.999819360051, 0.999717811412, 0.998594678003, 0.996769412056, 0.993667249597),
    *(0.987585330386, 0.978637510039, 0.965910292070, 0.948961894674, 0.927751505350, 0.900897965188),
    *(0.869737269067, 0.836397025612, 0.792378351642, 0.777423867800),
)
"""Factors on a colour there."""


@dataclass(frozen=True, eq=False)
class Paper:
    """The map from page coordinates to a sheet, in points.

    corner: (2,), page coordinates of the origin of the sheet.
    scale: (2,), points per page unit, right and along the sheet's second axis.
    """

    corner: FloatArray
    scale: FloatArray

    @classmethod
    def of(cls, page: Page, *, downward: bool) -> Paper:
        """With the origin in the upper left corner, as in SVG, or the lower left one, as in PDF."""
        left, _, bottom, top = page.extent
        down = -1 if downward else 1
        return cls(np.array([left, top if downward else bottom]), page.points_per_unit * np.array([1, down]))

    def points(self, places: Any) -> FloatArray:
        """Places (..., 2) of the page, in points."""
        return (np.asarray(places) - self.corner) * self.scale

    def placed(self, outline: Outlines) -> Outlines:
        """An outline of the page, in points."""
        return Outlines(self.points(outline.points), outline.kinds)

    def shading(self, ball: Ball) -> tuple[FloatArray, FloatArray, float]:
        """Focus, centre and radius of the gradient of a ball, in points."""
        focus, center = self.points(np.array(ball.center) + ball.radius * np.array([FOCUS, CENTER]))
        return focus, center, RADIUS * ball.radius * float(self.scale[0])


def shades(light: Ball | Ramp, color: Color) -> Sequence[tuple[float, Color]]:
    """Colours of the gradient of a ball of some colour, or of a ramp, at places from 0 to 1, linear in between."""
    if isinstance(light, Ramp):
        return light.stops
    red, green, blue, opacity = color
    levels = zip(OFFSETS, BRIGHTNESS, strict=True)
    return [(at, (level * red, level * green, level * blue, opacity)) for at, level in levels]


def number(value: float) -> str:
    """A number to three decimals, as short as possible: .25, 0, -1.5."""
    return _written(round(float(value) * PLACES))


def numbers(values: Iterable[float]) -> str:
    """Numbers separated by spaces."""
    return " ".join(map(number, values))


def exact(*values: float) -> str:
    """Numbers other than positions, to six decimals, separated by spaces; without exponents, which PDF lacks."""
    return " ".join(f"{round(float(value), 6) + 0.0:.6f}".rstrip("0").rstrip(".") for value in values)


def _written(steps: int) -> str:
    whole, rest = divmod(abs(steps), PLACES)
    sign = "-" if steps < 0 else ""
    return f"{sign}{whole or ''}.{rest:03d}".rstrip("0") if rest else f"{sign}{whole}"


def commands(outline: Outlines) -> str:
    """An outline in points as the path of a PDF, without pieces of length zero and those drawn by closing."""
    steps, kinds, third = _seen(outline)  # the three points of a curve are one command
    begins = np.delete(np.arange(len(kinds)), np.concatenate([third - 1, third]))
    text = list(map(_written, steps.ravel().tolist()))
    parts = []
    for place, kind in zip((2 * begins).tolist(), kinds[begins].tolist(), strict=True):
        count = {CLOSE: 0, CURVE: 6}.get(kind, 2)
        parts.append(OPERATORS[kind] % tuple(text[place : place + count]))
    return "".join(parts)


def runs(outline: Outlines) -> list[str]:
    """The runs of an outline in points as compact relative SVG commands.

    Positions are rounded before they are subtracted, so that errors do not accumulate.
    """
    steps, kinds, third = _seen(outline)
    before = np.arange(len(kinds)) - 1
    before[third - 1], before[third] = third - 3, third - 3
    away = steps - np.where((kinds == MOVE)[:, None], 0, steps[before])
    text = list(map(_written, away.ravel().tolist()))
    parts: list[list[str]] = []
    # The second control point of a curve follows its letter, as does its end.
    inner = {*third.tolist(), *(third - 1).tolist()}
    for place, kind in enumerate(kinds.tolist()):
        if kind == MOVE:
            parts.append([])
        if kind == CLOSE:
            parts[-1].append("Z")
            continue
        x, y = text[2 * place : 2 * place + 2]
        parts[-1].append(_beside(parts[-1][-1], x) if place in inner else f"{LETTERS[kind]}{x}")
        parts[-1].append(_beside(x, y))
    return ["".join(run) for run in parts]


def _beside(before: str, number: str) -> str:
    """A number after another, separated by a space where necessary."""
    apart = number[0] == "-" or (number[0] == "." and "." in before)
    return number if apart else f" {number}"


def _seen(outline: Outlines) -> tuple[Indices, Bytes, Indices]:
    """The visible part of a path in whole steps, kinds of its points, and where its curves end."""
    steps, kinds = np.rint(outline.points * PLACES).astype(np.int64), outline.kinds
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
    return steps[kept], kinds[kept], np.flatnonzero(kinds[kept] == CURVE)[2::3]
