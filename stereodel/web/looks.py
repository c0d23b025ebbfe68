"""What the owner of a page says of its places: title, source, values, colours, sizes, isolines, legend.

Colours, sizes and legends are those of pictures, by the same scales; `script/rooms/owner.ts` reads them.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Indices
from stereodel.curves.ragged import Ragged
from stereodel.drawing.page.colors import ColorLike, as_color
from stereodel.drawing.page.scales import ColorScale, SizeScale
from stereodel.drawing.page.style import MAP_DOT, DotStyle, LengthLike, LineStyle, as_length
from stereodel.drawing.page.ticks import MOST_TICKS
from stereodel.drawing.scene.by_value import DotLooks, ScaleLike
from stereodel.drawing.scene.legend import LegendEntry
from stereodel.interpolation import contours
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation import SphericalDelaunay
from stereodel.web.contents import packed, packed_places

PIXELS: Final = 96 / 72
"""Of CSS in a point."""

BAR, LETTER = 270.0, 7.5
"""Width of a legend's bar, and of a letter of its numbers, in pixels of CSS."""

BY_VALUE: Final = 3.0
"""Radius in points of dots whose colours are to be told apart, where it is not given."""

SHADES: Final = 64
"""Steps of a bar without classes."""

MOST_CONTOURED: Final = 20_000
"""Number of places up to which isolines are carried."""

ISOLINE_DIGITS: Final = 3
"""Decimals of isolines in degrees: 110 m, a pixel at 60 times the size of a globe of 1200 pixels."""


@dataclass(frozen=True, eq=False)
class Looks:
    """What `web` is told of its places; see there."""

    title: str = ""
    source: str = ""
    size: LengthLike | npt.ArrayLike | None = None
    color: ColorLike | npt.ArrayLike | None = None
    values: npt.ArrayLike | None = None
    scale: ScaleLike | None = None
    legend: str = ""
    size_legend: str = ""

    @property
    def said(self) -> list[str]:
        """Names of what is said."""
        return [
            name for name, part in vars(self).items() if part is not None and not (isinstance(part, str) and not part)
        ]

    def blocks(self, lonlat: FloatArray, latitude: Latitude) -> dict[str, str]:
        """Contents of the page by name; none where nothing is said."""
        if not self.said:
            return {}
        title = {"title": f", title={self.title!r}"} if self.title else {}
        told: dict[str, Any] = {"title": self.title, "source": self.source, "lines": title}
        lines: dict[str, str] = {}
        if self.size is not None or self.color is not None or self.values is not None:
            given = (self.size, self.color, self.values, self.scale, self.legend, None, self.size_legend)
            dots = DotLooks.of(len(lonlat), replace(MAP_DOT, radius=BY_VALUE), *given)
            colors = np.array([dots.style.color]) if dots.colors is None else dots.colors
            inks, number = np.unique(np.round(colors * 255) / 255, axis=0, return_inverse=True)
            told |= {
                "inks": [_css(ink) for ink in inks],
                "ink": np.broadcast_to(number.ravel(), len(lonlat)).tolist(),
                "radii": np.round(np.array(dots.radii(len(lonlat))) * PIXELS, 2).tolist(),
                "legend": [_entry(title, entry) for title, entry in dots.entries.items()],
                "columns": (columns := self._columns()),
                "lines": title | self._lines(dots, columns, inks, number.ravel()),
            }
            scales = [entry for entry in dots.entries.values() if isinstance(entry, ColorScale)]
            if scales and len(lonlat) <= MOST_CONTOURED:
                lines = _isolines(lonlat, np.asarray(self.values, dtype=np.float64), scales[0], latitude)
        return {"owner": packed(json.dumps(told).encode("utf-8", "replace"))} | lines

    def _lines(self, dots: DotLooks, columns: list[dict[str, Any]], inks: FloatArray, ink: Indices) -> dict[str, str]:
        """Parts of the lines of Python that draw these looks in pixels, from a table with the columns of the page."""
        scales = {type(entry): entry for entry in dots.entries.values()}
        color, amounts = scales.get(ColorScale), scales.get(SizeScale)
        if color is not None:
            lines = {"scale": repr(color), "valued": json.dumps(columns[0]["title"], ensure_ascii=False)}
            points = {"values": "values", "scale": "scale", "legend": repr(self.legend or "value")}
        elif dots.colors is not None:
            lines, points = {"shades": f"np.array({inks.round(4).tolist()})[{ink.tolist()}]"}, {"color": "shades"}
        else:
            lines, points = {"shades": f"[{dots.style.color}] * len(places)"}, {"color": str(dots.style.color)}
        points["size"] = repr(round(2 * dots.style.radius * PIXELS, 2))
        if isinstance(amounts, SizeScale):
            title = columns[-1]["title"]
            points["size"], points["size_legend"] = f"table.column({title!r})", repr(self.size_legend or "size")
            points["size_scale"] = f"SizeScale({amounts.high!r}, {as_length(amounts.largest, 'largest') * PIXELS!r})"
        return lines | {"points": ", ".join(f"{name}={value}" for name, value in points.items())}

    def _columns(self) -> list[dict[str, Any]]:
        """Values by title, those of both scales once if they are the same; what is missing is null."""
        columns: dict[str, list[Any]] = {}
        for title, values in ((self.legend or "value", self.values), (self.size_legend or "size", self.size)):
            if values is None or isinstance(values, str) or np.ndim(values) == 0:
                continue
            listed = [None if value is None or value != value else value for value in np.asarray(values).tolist()]
            if listed not in columns.values():
                columns[f"{title} (size)" if title in columns else title] = listed
        return [{"title": title, "values": values} for title, values in columns.items()]


def _isolines(lonlat: FloatArray, values: FloatArray, scale: ColorScale, latitude: Latitude) -> dict[str, str]:
    """Isolines at the ticks of a scale, as rows of places."""
    levels = [tick for tick in scale.ticks if scale.low < tick < scale.high]
    found = contours(SphericalDelaunay.from_lonlat(lonlat, latitude=latitude), values, levels)
    if not found:
        return {}
    offsets = np.cumsum([0, *(len(line.points) for line in found)])
    return {"isolines": packed_places(Ragged(np.concatenate([line.lonlat for line in found]), offsets), ISOLINE_DIGITS)}


def _css(color: ColorLike) -> str:
    """A colour as CSS writes it."""
    red, green, blue, opacity = as_color(color)
    return f"rgb({round(255 * red)} {round(255 * green)} {round(255 * blue)} / {opacity:.3g})"


def _entry(title: str, entry: LegendEntry) -> dict[str, Any]:
    """An entry of a legend: a bar with numbers below it, circles with theirs, or a dot."""
    if isinstance(entry, ColorScale):
        ticks = [[round(float(entry.place(at)), 4), text] for at, text in _fitting(entry).items()]
        missing = entry.missing_key and [entry.missing_key, _css(entry.missing)]
        return {
            "title": title,
            "bar": [_css(tuple(shade)) for shade in entry.shades(SHADES)],
            "ticks": ticks,
            "missing": missing,
        }
    if isinstance(entry, SizeScale):
        circles = [[round(float(entry(at)) * PIXELS / 2, 2), text] for at, text in entry.ticks.items()]
        return {"title": title, "circles": circles, "ink": None if entry.color is None else _css(entry.color)}
    return {"title": title, "ink": _css(entry.color if isinstance(entry, LineStyle | DotStyle) else entry)}


def _fitting(scale: ColorScale) -> Mapping[float, str]:
    """As many ticks as have room for their texts below the bar."""
    for most in range(max(MOST_TICKS, len(scale.edges)), 1, -1):
        ticks = scale.at_most(most)
        shown = {at: len(text) * LETTER for at, text in ticks.items() if text}
        widths = np.array([*shown.values()])
        if (np.diff(scale.place([*shown])) * BAR >= (widths[1:] + widths[:-1]) / 2 + LETTER).all():
            break
    return ticks
