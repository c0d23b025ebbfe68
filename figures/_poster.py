"""What the pictures of real data share: title, credit and legend."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from stereodel.drawing import ColorScale, Label, Page
from stereodel.drawing.scene.legend import described

LATITUDE = "authalic"  # areas of cells are those on the ellipsoid
WORDS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")
EVEN = np.array([1.0, 2.0, 5.0])  # first digits of the ends of a scale


def spaced(number: int, space: str = "\N{NO-BREAK SPACE}") -> str:
    """A number with its thousands apart."""
    return f"{number:,}".replace(",", space)


def in_words(number: float) -> str:
    """A small number, which may have a half, as it is spelled."""
    whole, half = divmod(number, 1.0)
    if half not in (0.0, 0.5) or not 0 <= whole < len(WORDS):
        return f"{number:g}"
    return WORDS[int(whole)] + (" and a half" if half else "")


def on_scale(number: float) -> str:
    """A number beside a scale: millions in words, thousands apart from five digits on."""
    if number >= 1e6:
        return f"{number / 1e6:g} million"
    return spaced(round(number), " ") if number >= 1e4 else f"{number:g}"


def even_ends(values: np.ndarray) -> tuple[float, float]:
    """The nearest numbers 1, 2, 5, 10, 20 … between which all positive values lie."""
    positive = values[values > 0]
    low, high = (10.0 ** np.floor(np.log10(end)) for end in (positive.min(), positive.max()))
    above = [step * high for step in (*EVEN, 10.0) if step * high >= positive.max()]
    return float(max(EVEN[low * EVEN <= positive.min()]) * low), float(above[0])


def decades(scale: ColorScale) -> list[float]:
    """The ends of a scale and the powers of ten between them that leave room for what is written at its upper end."""
    powers = 10.0 ** np.arange(np.ceil(np.log10(scale.low)), np.log10(scale.high))
    return [*powers[powers < scale.high / 4].tolist(), scale.high]


def captioned(
    page: Page, title: str, subtitle: str, credit: str, *, ink: tuple, above: float = 44.0, below: float = 52.0
) -> Page:
    """A page of globes with a title above and a credit below, in strips of so many points."""
    left, right, bottom, top = page.extent
    point = (right - left) / page.width
    edge, faint = left + 10 * point, (*ink[:3], 0.62)
    texts = (
        Label(title, (edge, top + (above - 24) * point), align="left", valign="baseline", size=17.0, color=ink),
        Label(subtitle, (edge, top + (above - 38) * point), align="left", valign="baseline", size=8.5, color=ink),
        Label(credit, (edge, bottom - (below - 7) * point), align="left", valign="baseline", size=6.0, color=faint),
    )
    extent = (left, right, bottom - below * point, top + above * point)
    return replace(page, extent=extent, items=(*page.items, *texts))


def with_legend(
    page: Page,
    scale: ColorScale,
    title: str,
    *,
    ink: tuple,
    at: Sequence[float] = (),
    values: Sequence[float] = (),
    ends: tuple[str, str] | None = None,
) -> Page:
    """The same page with a bar of colours in the strip below a caption's globe, and words at its two ends.

    Numbers stand at its decades, or where asked for. An end beyond which some of the values lie says so.
    """
    ticks = {number: on_scale(number) for number in at or decades(scale)}
    if np.min(values, initial=np.inf) < scale.low:
        ticks[scale.low] = f"≤ {on_scale(scale.low)}"
    if np.max(values, initial=0.0) > scale.high:
        ticks[scale.high] = f"≥ {on_scale(scale.high)}"
    left, right, bottom, _ = page.extent
    width = right - left
    corner, size = (left + 0.22 * width, bottom + 0.073 * width), (0.56 * width, 0.0136 * width)
    bar = scale.legend(corner, size, ticks, title=title, ink=ink, type_size=8.0)
    middle = corner[1] + size[1] / 2
    words = [
        Label(word, (x, middle), (shift, 0.0), align, "center", size=8.0, color=ink)
        for word, x, shift, align in zip(
            ends or (), (corner[0], corner[0] + size[0]), (-6.0, 6.0), ("right", "left"), strict=False
        )
    ]
    return described(replace(page, items=(*page.items, *bar, *words)), {title: scale})
