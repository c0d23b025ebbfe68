"""Scales from numbers to colours and to areas of dots, and their legends."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_choice, as_floats, as_scalar
from stereodel._numbers import as_doubles
from stereodel.drawing.page.colors import Color, ColorLike, as_color, color_map
from stereodel.drawing.page.items import Fill, Item, Label, Picture, Ramp, Stroke, straight
from stereodel.drawing.page.style import BLACK, LABEL_SIZE, LengthLike, as_length
from stereodel.drawing.page.ticks import (
    MOST_TICKS,
    Kind,
    Scheme,
    class_limits,
    round_numbers,
    rounded_ends,
    to_digits,
    written,
)

MISSING: Final[Color] = (0.66, 0.66, 0.66, 1.0)
"""Colour of missing values: a gray between those of sea and land and that of lines."""

USUAL, DIVERGING = "YlGnBu", "RdBu_r"
"""Maps of colours by default, and by default on both sides of a centre."""

KEY: Final = (4.0, 2.5)
"""Distance of the key of missing values from the bar, and its width, in heights of the bar."""


def _bent(numbers: FloatArray, threshold: float) -> FloatArray:
    """Linear up to the threshold, and logarithmic beyond with the same slope there."""
    beyond = np.log(np.maximum(np.abs(numbers) / threshold, 1.0))
    return np.clip(numbers / threshold, -1.0, 1.0) + np.sign(numbers) * beyond


KINDS: Final[Mapping[Kind, tuple[str, Callable[[FloatArray, float], Any]]]] = {
    "linear": ("linear", lambda numbers, _: numbers),
    "log": ("logarithmic", lambda numbers, low: np.log(numbers / low)),
    "symlog": ("symmetrically logarithmic", _bent),
    "sqrt": ("by square roots", lambda numbers, _: np.sign(numbers) * np.sqrt(np.abs(numbers))),
}
"""How numbers are spread along a scale, in words and by its lower end or its threshold."""


@dataclass(frozen=True)
class ColorScale:
    """A scale from numbers to colours.

    Parameters
    ----------
    colors : str or sequence of color-like
        Name of a matplotlib colour map, such as "viridis", "magma" or "cividis", whose lightness increases uniformly;
        or colours, between which others are mixed. As many colours as there are classes are those of the classes.
    low, high : float
        Numbers with the first and the last colour; numbers beyond them are clipped.
    kind : {"linear", "log", "symlog", "sqrt"}
        How numbers are spread: evenly; by their logarithms; linearly up to a threshold and logarithmically beyond it,
        with the same slope there; by the roots of their amounts.
    center : float, optional
        Number with the middle colour. Numbers as far above it as below have colours as far from the middle one.
    threshold : float, optional
        Of a symmetric logarithm, which needs one.
    missing : color-like
        Colour of missing values, NaN.
    missing_key : str
        Text of the key of missing values in a legend, which has none without it.
    edges : sequence of float
        Limits of classes, from `low` to `high`; see `ColorScale.classes`.
    scheme : str
        How the classes were made, for descriptions.

    Examples
    --------
    >>> scale = ColorScale("viridis", 1.0, 1e4, "log")
    >>> print(scale([1.0, 1e2, 1e9]).round(2)[:, :3])
    [[0.27 0.   0.33]
     [0.13 0.57 0.55]
     [0.99 0.91 0.14]]
    >>> print(*scale.ticks.values())
    1 10 100 1 000 10 000
    """

    colors: str | Sequence[ColorLike]
    low: float
    high: float
    kind: Kind = "linear"
    _: KW_ONLY
    center: float | None = None
    threshold: float | None = None
    missing: ColorLike = MISSING
    missing_key: str = ""
    edges: Sequence[float] = ()
    scheme: str = ""

    def __post_init__(self) -> None:
        if not len(self.colors):
            raise ValueError("colors is empty; give the name of a colour map of matplotlib, or colours")
        if not isinstance(self.colors, str):
            object.__setattr__(self, "colors", tuple(as_color(color, "colors") for color in self.colors))
        color_map(self.colors)
        object.__setattr__(self, "missing", as_color(self.missing, "missing"))
        as_choice(self.kind, tuple(KINDS), "kind")
        as_scalar(self.low, "low", low=0.0 if self.kind == "log" else -np.inf, open_low=True)
        as_scalar(self.high, "high", low=self.low, open_low=True)
        if self.center is not None:
            as_scalar(self.center, "center", low=self.low, high=self.high)
        if (self.kind == "symlog") != (self.threshold is not None):
            raise ValueError(f"kind is {self.kind!r} and threshold {self.threshold}; 'symlog' alone needs a threshold")
        if self.threshold is not None:
            as_scalar(self.threshold, "threshold", low=0.0, open_low=True)
        if len(self.edges):
            edges = tuple(class_limits(np.zeros(0), self.edges, 1).tolist())
            if (edges[0], edges[-1]) != (self.low, self.high):
                raise ValueError(f"edges lead from {edges[0]} to {edges[-1]}, not from {self.low} to {self.high}")
            object.__setattr__(self, "edges", edges)

    @classmethod
    def of(
        cls,
        values: npt.ArrayLike,
        colors: str | Sequence[ColorLike] | None = None,
        kind: Kind = "linear",
        *,
        limits: tuple[float, float] | None = None,
        center: float | None = None,
        threshold: float | None = None,
    ) -> ColorScale:
        """A scale for values, NaN where one is missing, with round numbers about them as its limits.

        Parameters
        ----------
        values : array_like
            Logarithms take no notice of those that are not positive.
        colors : str or sequence of color-like, optional
            By default from light yellow to dark blue, and with a centre from blue to red.
        kind, center, threshold
            As for `ColorScale`.
        limits : (float, float), optional
            Numbers with the first and the last colour, as they are.

        Examples
        --------
        >>> print(*ColorScale.of([5.3e6, 21e6]).ticks.values())
        5 M 10 M 15 M 20 M 25 M
        """
        if limits is None:
            numbers = as_doubles(values, "values")
            numbers = numbers[np.isfinite(numbers) & ((numbers > 0) | (kind != "log"))]
            if len(numbers) == 0:
                raise ValueError(f"values has no {'positive ' * (kind == 'log')}number for a scale; give limits")
            low, high = float(numbers.min()), float(numbers.max())
            if center is not None:
                as_scalar(center, "center", low=0.0 if kind == "log" else -np.inf, open_low=True)
                low, high = min(low, center), max(high, center)
            limits = rounded_ends(low, high if high > low else low + max(1.0, abs(low)), kind)
        return cls(_usual(colors, center), *limits, kind, center=center, threshold=threshold)

    @classmethod
    def classes(
        cls,
        values: npt.ArrayLike,
        scheme: Scheme | Sequence[float] = "quantiles",
        count: int = 5,
        colors: str | Sequence[ColorLike] | None = None,
        *,
        center: float | None = None,
    ) -> ColorScale:
        """A scale of classes, each in one colour, which contain their lower limits, the last one both.

        Parameters
        ----------
        values : array_like
            Numbers, NaN where one is missing; at least two that differ.
        scheme : {"equal", "quantiles", "natural"} or sequence of float
            Classes of equal widths; of equal numbers of values; natural breaks, which make the sum of squared
            deviations from the means of the classes as small as can be (Fisher and Jenks); or limits of your own.
        count : int
            Number of classes; fewer if limits would be equal.
        colors, center
            As for `ColorScale.of`. Classes beyond the centre have colours on its sides of the middle one.

        Examples
        --------
        >>> ColorScale.classes([1, 2, 2, 3, 10, 11, 50], "natural", 3).edges
        (1.0, 6.0, 30.0, 50.0)
        """
        numbers = as_doubles(values, "values")
        limits = class_limits(numbers[np.isfinite(numbers)], scheme, count)
        said = scheme if isinstance(scheme, str) else ""
        return cls(_usual(colors, center), *limits[[0, -1]].tolist(), center=center, edges=limits.tolist(), scheme=said)

    def place(self, values: npt.ArrayLike) -> FloatArray:
        """Positions of numbers between `low` (0) and `high` (1), clipped; all classes are as long."""
        numbers = np.clip(as_doubles(values, "values"), self.low, self.high)
        if self.edges:
            return np.interp(numbers, self.edges, np.linspace(0.0, 1.0, len(self.edges)))
        (_, spread), bend = KINDS[self.kind], self.threshold or self.low
        low, high = spread(np.array([self.low, self.high]), bend)
        return np.asarray((spread(numbers, bend) - low) / (high - low))

    def __call__(self, values: npt.ArrayLike) -> FloatArray:
        """Colours (..., 4): red, green, blue and opacity in [0, 1]."""
        numbers = as_doubles(values, "values")
        known = np.isfinite(numbers)
        colors = np.where(known[..., None], self._shades(np.where(known, numbers, self.low)), self.missing)
        return np.asarray(colors, dtype=np.float64)

    @property
    def ticks(self) -> dict[float, str]:
        """Round numbers on the scale, or the limits of its classes, and their texts."""
        return self.at_most(max(MOST_TICKS, len(self.edges)))

    def at_most(self, most: int) -> dict[float, str]:
        """Ticks with at most so many texts; all limits of classes are ticks."""
        if self.edges:
            texts, stride = written(to_digits(self.edges), "log"), -(-len(self.edges) // most)
            return {edge: "" if k % stride else texts[k] for k, edge in enumerate(self.edges)}
        numbers = round_numbers(self.low, self.high, self.kind, self.threshold, most)
        if self.center is not None:
            away = np.abs(self.place(numbers) - self.place(self.center)) > 0.06  # as far as texts need
            numbers = sorted([*np.array(numbers)[away].tolist(), float(self.center)])
        return dict(zip(numbers, written(numbers, self.kind), strict=True))

    @property
    def description(self) -> str:
        """What the scale does, in words."""
        texts = list(self.ticks.values())
        if self.edges:
            how = f" ({self.scheme})" if self.scheme else ""
            said = f"colours of {len(self.edges) - 1} classes{how} with the limits {', '.join(texts)}"
        else:
            low, high = written(to_digits([self.low, self.high]), self.kind)
            said = f"colours, {KINDS[self.kind][0]} from {low} to {high}"
            said += f", linear up to {written([self.threshold])[0]}" if self.threshold is not None else ""
        said += f", centred on {written([self.center])[0]}" if self.center is not None else ""
        return said + (f"; {self.missing_key} in gray" if self.missing_key else "")

    def legend(
        self,
        corner: tuple[float, float],
        size: tuple[float, float],
        ticks: Mapping[float, str] | None = None,
        *,
        title: str = "",
        ink: ColorLike = BLACK,
        type_size: float = LABEL_SIZE,
    ) -> tuple[Item, ...]:
        """A horizontal bar with numbers, by default `ticks`, below it, and a title above.

        `corner` is the lower left one of the bar, `size` its width and height, in page units; `type_size` is in points.
        """
        (x, y), (width, height), ink = corner, size, as_color(ink, "ink")
        box = np.array([(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)])
        shades = self.shades(256)
        bars: list[Item] = [Picture((straight(box),), Ramp((x, x + width), shades), "scale")]
        if self.edges:
            wide = width / (len(self.edges) - 1)
            bars = [_box(x + k * wide, x + (k + 1) * wide, y, y + height, as_color(c)) for k, c in enumerate(shades)]
        marks: list[Item] = []

        def mark(at: float, text: str) -> None:
            foot = y - 0.35 * height
            marks.append(Stroke(straight(np.array([(at, y), (at, foot)])), ink, 0.5, cap="butt", name="tick"))
            if text:
                marks.append(Label(text, (at, foot), (0.0, -2.0), "center", "top", type_size, ink))

        for number, text in (self.ticks if ticks is None else ticks).items():
            mark(x + width * float(self.place(number)), text)
        if self.missing_key:
            left = x + width + KEY[0] * height
            bars.append(_box(left, left + KEY[1] * height, y, y + height, as_color(self.missing)))
            mark(left + KEY[1] * height / 2, self.missing_key)
        if title:
            marks.append(Label(title, (x + width / 2, y + height), (0.0, 4.0), "center", "bottom", type_size, ink))
        return (*bars, *marks)

    def shades(self, count: int) -> FloatArray:
        """Colours (m, 4) along the scale: those of its classes, or of so many parts."""
        return self._class_shades if self.edges else self._mixed(self._share((np.arange(count) + 0.5) / count))

    def _share(self, place: FloatArray) -> FloatArray:
        """Where between the first colour (0) and the last (1) places on the scale have theirs."""
        if self.center is None:
            return place
        middle = self.place(self.center)
        return np.asarray(0.5 + 0.5 * (place - middle) / max(middle, 1 - middle))

    def _shades(self, numbers: FloatArray) -> FloatArray:
        if not self.edges:
            return self._mixed(self._share(self.place(numbers)))
        number = np.searchsorted(self.edges, numbers, "right") - 1
        return np.asarray(self._class_shades[np.clip(number, 0, len(self.edges) - 2)])

    @property
    def _class_shades(self) -> FloatArray:
        """Colours of the classes, (n, 4), those in the middle of as many parts of the map."""
        count = len(self.edges) - 1
        if not isinstance(self.colors, str) and len(self.colors) == count:
            return np.array(self.colors)
        if self.center is None:
            return self._mixed((np.arange(count) + 0.5) / count)
        below, above = (np.array(self.edges[1:]) <= self.center), (np.array(self.edges[:-1]) >= self.center)
        steps: FloatArray = np.asarray(np.cumsum(above) - np.cumsum(below[::-1])[::-1], dtype=np.float64)
        return self._mixed(0.5 + steps / (2 * np.abs(steps).max() + 1))

    def _mixed(self, share: FloatArray) -> FloatArray:
        """Colours (..., 4) at shares of the way from the first to the last."""
        return np.asarray(color_map(self.colors)(share), dtype=np.float64)


@dataclass(frozen=True)
class SizeScale:
    """A scale from amounts to diameters of dots, whose areas are in proportion to the amounts.

    Parameters
    ----------
    high : float
        Amount of the dot with the diameter `largest`, positive; larger amounts have larger dots.
    largest : float or str
        Diameter in points, or with a unit, such as "8mm".
    color : color-like, optional
        Colour of the dots in a legend; without it circles are empty.

    Examples
    --------
    >>> scale = SizeScale(16e6, "8mm")
    >>> print((scale([1e6, 4e6, 16e6]) / 72 * 25.4).round(9), *scale.ticks.values())
    [2. 4. 8.] 10 M 2 M 0.5 M
    """

    high: float
    largest: LengthLike = 24.0
    color: ColorLike | None = None

    def __post_init__(self) -> None:
        as_scalar(self.high, "high", low=0.0, open_low=True)
        object.__setattr__(self, "largest", as_length(self.largest, "largest"))
        if self.color is not None:
            object.__setattr__(self, "color", as_color(self.color))

    def __call__(self, amounts: npt.ArrayLike) -> FloatArray:
        """Diameters in points of amounts (...) that are not negative."""
        numbers = as_floats(amounts, "amounts")
        if (numbers < 0).any():
            raise ValueError(f"amounts has {numbers.min():g}; an area cannot be negative")
        return np.asarray(as_length(self.largest, "largest") * np.sqrt(numbers / self.high))

    @property
    def ticks(self) -> dict[float, str]:
        """The largest round number up to `high`, one of about a fifth and one of a twentieth of it, and their texts."""
        numbers = round_numbers(self.high / 200, self.high, "log", None, 7)[::-2][:3]
        return dict(zip(numbers, written(numbers), strict=True))

    @property
    def description(self) -> str:
        """What the scale does, in words."""
        return f"areas of dots in proportion to the amount, {written(to_digits([self.high]))[0]} the largest"


def _usual(colors: str | Sequence[ColorLike] | None, center: float | None) -> str | Sequence[ColorLike]:
    return colors if colors is not None else USUAL if center is None else DIVERGING


def _box(left: float, right: float, bottom: float, top: float, color: Color) -> Fill:
    corners = np.array([(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)])
    return Fill((straight(corners),), color, "scale")
