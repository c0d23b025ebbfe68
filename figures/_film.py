"""What the animations share: moments and how long they last, and a strip of words and scales below the picture."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

import numpy as np

from stereodel.drawing import LineStyle, Page, Sketch
from stereodel.drawing.page.style import BLACK, DARK_GRAY, with_opacity
from stereodel.film.shots import eased

T = TypeVar("T")

WIDTH = 180.0  # points; of the pages of films, whose unit is the point
SIZE = 480  # pixels: 192 dots per inch
TYPE_SIZE = 8.0  # points
READING = 2.5  # seconds for a line of words
STEP = 0.07  # seconds of a frame while something moves


def moving(seconds: float, step: float = STEP) -> Iterator[float]:
    """Shares of a way that takes so many seconds, without a jolt at its ends: one for each frame, the ends left out."""
    count = round(seconds / step)
    return (eased(number / count) for number in range(1, count))


def timed(moments: Iterable[tuple[T, float]]) -> tuple[list[T], list[float]]:
    """Shots, and the seconds for which each is shown."""
    shots, seconds = zip(*moments, strict=True)
    return list(shots), list(seconds)


def nearest(values: Sequence[float], value: float, reach: float) -> tuple[int, float]:
    """The number of the nearest of some values, and how near it is: 1 at the value, 0 from `reach` on."""
    apart = np.abs(np.asarray(values) - value)
    number = int(apart.argmin())
    return number, eased(max(0.0, 1.0 - float(apart[number]) / reach))


def faded(style: LineStyle, strength: float) -> LineStyle:
    """A line less opaque: 0 is not there."""
    return LineStyle(with_opacity(style.color, strength * style.color[3]), style.width)


def whole(sketch: Sketch, height: float, *, width: float = WIDTH) -> Page:
    """The page of a film."""
    return sketch.page((0.0, width, 0.0, height), width=width)


def add_words(sketch: Sketch, text: str, y: float, *, strength: float = 1.0, x: float = WIDTH / 2) -> None:
    """A line of words about the middle of the page, less opaque where asked for."""
    if strength > 0:
        ink = with_opacity(BLACK, strength)
        sketch.add_label((x, y), text, valign="baseline", size=TYPE_SIZE, color=ink)


def add_gauge(
    sketch: Sketch, share: float, ticks: Mapping[float, Sequence[str]], y: float, *, left: float, title: Sequence[str]
) -> None:
    """A scale as wide as the page but for `left` and its like, with a marker; of the title and each tick some lines."""
    right = WIDTH - 12.0
    sketch.add_segment((left, y), (right, y), name="axis")
    for at, texts in ticks.items():
        x = left + (right - left) * at
        sketch.add_segment((x, y - 2.0), (x, y + 2.0), name="axis")
        add_column(sketch, x, y, texts)
    add_column(sketch, left - 10.0, y, title, align="right")
    sketch.add_points([(left + (right - left) * share, y)], name="points")


def add_column(sketch: Sketch, x: float, y: float, texts: Sequence[str], **options: str) -> None:
    """Lines of type below a scale."""
    for row, text in enumerate(texts):
        place = (x, y - 10.0 - 9.5 * row)
        sketch.add_label(place, text, valign="baseline", size=TYPE_SIZE, color=DARK_GRAY, **options)
