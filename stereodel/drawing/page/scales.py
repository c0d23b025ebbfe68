"""Colour scales for numbers: perceptually uniform, linear or logarithmic, and their legends."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_floats, as_scalar
from stereodel.drawing.page.colors import Color, ColorLike, as_color, color_map
from stereodel.drawing.page.items import Item, Label, Picture, Ramp, Stroke, straight
from stereodel.drawing.page.style import BLACK, LABEL_SIZE

STEPS = 256
"""Number of steps of a legend."""

CATEGORIES: Final[Sequence[Color]] = (
    (0.902, 0.624, 0.000, 1.0),
    (0.000, 0.620, 0.451, 1.0),
    (0.800, 0.475, 0.655, 1.0),
    (0.000, 0.353, 0.580, 1.0),
    (0.941, 0.894, 0.259, 1.0),
    (0.776, 0.306, 0.000, 1.0),
    (0.337, 0.706, 0.914, 1.0),
    (0.480, 0.480, 0.480, 1.0),
)
"""Colours of categories in order: the hues of Okabe and Ito's palette, first those farthest from sea and land."""

TICKS: Final = 5
"""Default number of ticks of a legend."""


@dataclass(frozen=True)
class ColorScale:
    """A scale from numbers to colours.

    Parameters
    ----------
    name : str or sequence of color-like
        Name of a matplotlib colour map, such as "viridis", "magma" or "cividis", whose lightness increases uniformly;
        or colours, between which others are mixed.
    low, high : float
        Numbers with the first and the last colour; numbers beyond them are clipped.
    log : bool
        Whether the scale is logarithmic.

    Raises
    ------
    ValueError
        If the map or a colour is unknown, the limits are out of order, or a logarithmic scale does not begin above 0.

    Examples
    --------
    >>> scale = ColorScale("viridis", 1.0, 1e4, log=True)
    >>> print(scale([1.0, 1e2, 1e9]).round(2))
    [[0.27 0.   0.33]
     [0.13 0.57 0.55]
     [0.99 0.91 0.14]]
    """

    name: str | Sequence[ColorLike]
    low: float
    high: float
    log: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.name, str):
            object.__setattr__(self, "name", tuple(as_color(color, "name") for color in self.name))
        color_map(self.name)
        as_scalar(self.low, "low", low=0.0 if self.log else -np.inf, open_low=True)
        as_scalar(self.high, "high", low=self.low, open_low=True)

    def place(self, values: npt.ArrayLike) -> FloatArray:
        """Positions of numbers between `low` (0) and `high` (1), clipped."""
        numbers = np.clip(as_floats(values, "values"), self.low, self.high)
        if self.log:
            return np.asarray(np.log(numbers / self.low) / np.log(self.high / self.low))
        return (numbers - self.low) / (self.high - self.low)

    def __call__(self, values: npt.ArrayLike) -> FloatArray:
        """Colours (..., 3), sRGB in [0, 1]."""
        return np.asarray(color_map(self.name)(self.place(values)), dtype=np.float64)[..., :3]

    @property
    def ticks(self) -> dict[float, str]:
        """Numbers evenly spaced from about `low` to about `high`, of two or more digits, and their texts."""
        numbers, digits = self._at(np.linspace(0.0, 1.0, TICKS)), 2
        while len({f"{number:.{digits}g}" for number in numbers}) < TICKS and digits < 15:
            digits += 1
        written = [np.format_float_positional(float(f"{number:.{digits}g}"), trim="-") for number in numbers]
        return {float(text): text for text in written}

    def legend(
        self,
        corner: tuple[float, float],
        size: tuple[float, float],
        ticks: Mapping[float, str],
        *,
        title: str = "",
        ink: ColorLike = BLACK,
        type_size: float = LABEL_SIZE,
    ) -> tuple[Item, ...]:
        """A horizontal bar with ticks.

        Parameters
        ----------
        corner, size : (float, float)
            Lower left corner, width and height of the bar in page units.
        ticks : mapping of float to str
            Numbers and the texts below them.
        title : str
            Text above the bar.
        ink : color-like
            Colour of lines and text.
        type_size : float
            Size of the text, points.
        """
        (x, y), (width, height), ink = corner, size, as_color(ink, "ink")
        colors = np.insert(self(self._at((np.arange(STEPS) + 0.5) / STEPS)), 3, 1.0, axis=1)
        box = np.array([(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)])
        bar = Picture((straight(box),), Ramp((x, x + width), colors), "scale")
        marks: list[Item] = []
        for number, text in ticks.items():
            at, foot = x + width * float(self.place(number)), y - 0.35 * height
            marks.append(Stroke(straight(np.array([(at, y), (at, foot)])), ink, 0.5, cap="butt", name="tick"))
            marks.append(Label(text, (at, foot), (0.0, -2.0), "center", "top", type_size, ink))
        if title:
            marks.append(Label(title, (x + width / 2, y + height), (0.0, 4.0), "center", "bottom", type_size, ink))
        return (bar, *marks)

    def _at(self, place: FloatArray) -> FloatArray:
        """The numbers at positions from 0 to 1."""
        if self.log:
            return np.asarray(self.low * (self.high / self.low) ** place)
        return self.low + (self.high - self.low) * place


def category_colors(words: Sequence[str], name: str) -> dict[str, Color]:
    """A colour for each word, distinguishable with any colour vision; ValueError if there are too many words."""
    if len(words) > len(CATEGORIES):
        raise ValueError(
            f"{name} has {len(words)} different words, but {len(CATEGORIES)} colours are told apart at most"
        )
    return dict(zip(words, CATEGORIES, strict=False))


def usual_scale(values: FloatArray) -> ColorScale:
    """Viridis from the smallest to the largest of one or more numbers."""
    low, high = float(values.min()), float(values.max())
    return ColorScale("viridis", low, high if high > low else low + 1.0)
