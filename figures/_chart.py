"""A rectangle of the page with two scales: what the charts of the claims are drawn in."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from stereodel.drawing import Sketch

TICK = 0.09
"""Length of the marks of a scale, cm."""


def fraction(value: float) -> str:
    """A number beside a scale as a formula, with a stroke where it is not whole."""
    return f"${Fraction(value).limit_denominator(100)}$"


@dataclass(frozen=True)
class Chart:
    """Where a chart lies on a page whose unit is the centimetre, and what its sides stand for.

    Parameters
    ----------
    corner, size : (float, float)
        Lower left corner, width and height, cm.
    x, y : (float, float)
        Values at the left and right, and at the lower and upper side.
    """

    corner: tuple[float, float]
    size: tuple[float, float]
    x: tuple[float, float]
    y: tuple[float, float]

    def place(self, points: npt.ArrayLike) -> np.ndarray:
        """Where values (..., 2) lie on the page."""
        low = np.array([self.x[0], self.y[0]])
        span = np.array([self.x[1], self.y[1]]) - low
        return np.array(self.corner) + np.array(self.size) * (np.asarray(points) - low) / span

    def add_frame(self, sketch: Sketch) -> None:
        """The lower and the left side."""
        (x, y), (width, height) = self.corner, self.size
        sketch.add_polyline([(x, y + height), (x, y), (x + width, y)], name="axis")

    def add_level(self, sketch: Sketch, value: float, *, name: str, upright: bool = False) -> None:
        """A line across the chart where the second value, or with `upright` the first, is a given one."""
        ends = [(value, end) for end in self.y] if upright else [(end, value) for end in self.x]
        sketch.add_segment(*self.place(ends), name=name)

    def add_x_ticks(self, sketch: Sketch, texts: Mapping[float, str], title: str) -> None:
        """Marks below, with what is written at each and below all of them."""
        for value, text in texts.items():
            x, y = self.place((value, self.y[0]))
            sketch.add_segment((x, y), (x, y - TICK), name="axis")
            sketch.add_label((x, y - TICK), text, (0, -3), valign="top")
        middle = (self.corner[0] + self.size[0] / 2, self.corner[1] - TICK)
        sketch.add_label(middle, title, (0, -17), valign="top")

    def add_y_ticks(
        self, sketch: Sketch, texts: Mapping[float, str], title: str, *, right: bool = False, gap: float = 30.0
    ) -> None:
        """Marks on the left, or on the right, and a title along them, `gap` points away."""
        side, out = (self.x[1], 1) if right else (self.x[0], -1)
        for value, text in texts.items():
            x, y = self.place((side, value))
            sketch.add_segment((x, y), (x + out * TICK, y), name="axis")
            sketch.add_label((x + out * TICK, y), text, (3 * out, 0), align="left" if right else "right")
        middle = (self.corner[0] + right * self.size[0] + out * TICK, self.corner[1] + self.size[1] / 2)
        sketch.add_label(middle, title, (out * gap, 0), rotation=90.0)


def steps(edges: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """Corners (2n + 2, 2) of the outline of a histogram of n bins, from the axis to the axis."""
    x = np.repeat(edges, 2)
    y = np.concatenate([[0.0], np.repeat(heights, 2), [0.0]])
    return np.column_stack([x, y])
