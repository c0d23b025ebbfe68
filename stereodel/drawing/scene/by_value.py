"""Colours and sizes by value: of dots, and of all else that has one value a part."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Final, cast

import numpy as np
import numpy.typing as npt

from stereodel._arrays import DataWarning, FloatArray, Indices, as_values
from stereodel.drawing.page import Dots, Item, Stroke
from stereodel.drawing.page.colors import Color, ColorLike, as_color, as_colors
from stereodel.drawing.page.items import Tags
from stereodel.drawing.page.scales import MISSING, ColorScale, SizeScale
from stereodel.drawing.page.style import DARK_GRAY, DotStyle, LengthLike, as_length, with_opacity
from stereodel.drawing.page.ticks import to_digits, written
from stereodel.drawing.scene.legend import EDGE, LegendEntry
from stereodel.drawing.scene.sketch import arc_path

ScaleLike = ColorScale | Callable[[FloatArray], ColorScale]
"""A scale, or what makes one of values, such as `ColorScale.of`."""

NO_VALUE: Final = "no value"
"""Key of missing values."""

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
"""Colours of words in order: the hues of Okabe and Ito's palette, first those farthest from sea and land."""


def colors_of(
    values: npt.ArrayLike, count: int, scale: ScaleLike | None, title: str
) -> tuple[FloatArray, Mapping[str, LegendEntry]]:
    """Colours (n, 4) of numbers or words, and their entries in a legend; each word has a colour of its own.

    Numbers beyond the scale are said in a `DataWarning`.
    """
    if (given := np.asarray(values)).dtype.kind in "OU" and given.shape == (count,):
        words = [word if word not in (None, "") else NO_VALUE for word in given.tolist()]
        if all(isinstance(word, str) for word in words):
            different, most = sorted({*words} - {NO_VALUE}), len(CATEGORIES)
            if len(different) > most:
                said = f"{len(different)} different words, but {most} colours are told apart at most"
                raise ValueError(f"column {title!r} has {said}")
            shades = dict(zip(different, CATEGORIES, strict=False)) | {NO_VALUE: MISSING}
            return np.array([shades[word] for word in words]), {word: shades[word] for word in shades if word in words}
    numbers = as_values(values, count, "values")
    known = numbers[np.isfinite(numbers)]
    chosen = scale if isinstance(scale, ColorScale) else (scale or ColorScale.of)(known)
    if beyond := int(((known < chosen.low) | (known > chosen.high)).sum()):
        ends = " to ".join(written(to_digits([chosen.low, chosen.high]), "log"))
        said = f"{beyond} of {count} values of {title!r} are beyond its scale, {ends}, and have the colours of its ends"
        warnings.warn(said, DataWarning, stacklevel=4)
    if len(known) < count:
        chosen = replace(chosen, missing_key=chosen.missing_key or NO_VALUE)
    return chosen(numbers), {title: chosen}


@dataclass(frozen=True, eq=False)
class DotLooks:
    """How dots look, one by one or all alike.

    style: the style of all, with the radius if `diameters` is None, and the colour if `colors` is.
    diameters: of each, in points; NaN for those that are not drawn.
    colors: of each, (n, 4).
    entries: what a legend says.
    """

    style: DotStyle
    diameters: FloatArray | None = None
    colors: FloatArray | None = None
    entries: dict[str, LegendEntry] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        count: int,
        style: DotStyle,
        size: LengthLike | npt.ArrayLike | None = None,
        color: ColorLike | npt.ArrayLike | None = None,
        values: npt.ArrayLike | None = None,
        scale: ScaleLike | None = None,
        legend: str = "",
        size_scale: SizeScale | None = None,
        size_legend: str = "",
    ) -> DotLooks:
        """The looks of so many dots, as `Globe.add_points` takes them."""
        if color is not None and values is not None:
            raise ValueError("color and values both say the colours of points; give one of them")
        entries: dict[str, LegendEntry] = {}
        colors = diameters = None
        if values is not None:
            colors, told = colors_of(values, count, scale, legend or "value")
            entries |= told
        elif color is not None:
            colors = as_colors(cast(ColorLike, color), count, "color")
            if len(colors) == 0 or (colors == colors[0]).all():
                style, colors = replace(style, color=as_color(colors[0]) if count else style.color), None
        if colors is not None:  # light colours stand out by their edge
            style = replace(style, rim=DARK_GRAY, rim_width=min(style.rim_width, EDGE / 2))
        if size is None or isinstance(size, str) or np.ndim(size) == 0:
            if size is not None:
                radius = as_length(cast(LengthLike, size), "size") / 2
                style = replace(style, radius=radius, rim_width=min(style.rim_width, radius / 3))
            if legend and values is None:
                entries[legend] = style
            return cls(style, None, colors, entries)
        amounts = as_values(cast(npt.ArrayLike, size), count, "size")
        negative, missing = int((amounts < 0).sum()), int(np.isnan(amounts).sum())
        if negative or missing:
            said = f"of {count} values of {size_legend or 'size'!r} {negative} are negative and {missing} missing"
            warnings.warn(f"{said}; points have no area for them and are not drawn", DataWarning, stacklevel=3)
        there = amounts >= 0
        if size_scale is None and not (amounts > 0).any():
            raise ValueError("size has no positive value; the areas of points are in proportion to them")
        chosen = SizeScale(float(amounts[there].max())) if size_scale is None else size_scale
        diameters = np.full(count, np.nan)
        diameters[there] = chosen(amounts[there])
        if colors is None:
            tint = with_opacity(style.color, 0.6) if style.color[3] == 1 else style.color  # so that those below show
            style, chosen = replace(style, color=tint, rim=with_opacity(style.color, 1.0)), replace(chosen, color=tint)
        title = size_legend or "size"
        entries[f"{title} (size)" if title in entries else title] = chosen
        return cls(style, diameters, colors, entries)

    def radii(self, count: int) -> list[float]:
        """Those of so many dots, in points; 0 where none is drawn."""
        return [self.style.radius] * count if self.diameters is None else np.nan_to_num(self.diameters / 2).tolist()

    def items(
        self, centers: FloatArray, rows: Indices, point: float, name: str, tags: Tags | None = None
    ) -> Iterator[Item]:
        """Dots of some rows at centres (n, 2), `point` being that length on the page; of sizes by value large first."""
        style, diameters = self.style, self.diameters
        colors = np.array([style.color]) if self.colors is None else self.colors[rows]
        told = () if self.colors is None else ("color",)
        if diameters is None:
            several, which = np.unique(colors, axis=0, return_inverse=True)
            for k, color in enumerate(several):
                some = rows[np.broadcast_to(which.ravel() == k, rows.shape)]
                look = style.radius, as_color(color), style.rim, style.rim_width
                yield Dots(centers[some], *look, name, told=told, tags=tags and tags.some(some))
            return
        order = rows[np.argsort(-diameters[rows], kind="stable")]
        for k in order[diameters[order] > 0].tolist():
            radius, edge = diameters[k] / 2, min(EDGE, diameters[k] / 4)
            color = style.color if self.colors is None else as_color(self.colors[k])
            named = tags and tags.some(np.array([k]))
            yield Dots(centers[k : k + 1], radius, color, name=name, told=("radius", *told), tags=named)
            around = arc_path(centers[k], (radius - edge / 2) * point, 0.0, 360.0)
            yield Stroke(around, style.rim, edge, closed=True, name=f"{name}-outline")
