"""What the owner of a page says of its places: title, source, values, colours, sizes, isolines, legend.

Colours, sizes and legends are those of pictures, by the same scales; `script/rooms/owner.ts` reads them.
"""

from __future__ import annotations

import json
import re
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Indices
from stereodel.curves.ragged import Ragged
from stereodel.drawing.page import Page
from stereodel.drawing.page.colors import ColorLike, as_color
from stereodel.drawing.page.scales import ColorScale, SizeScale
from stereodel.drawing.page.style import MAP_DOT, LengthLike, as_length
from stereodel.drawing.scene.by_value import DotLooks, ScaleLike
from stereodel.drawing.scene.legend import LegendEntry, with_legend
from stereodel.interpolation import contours
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation import SphericalDelaunay
from stereodel.web.contents import packed, packed_places

PIXELS: Final = 96 / 72
"""Of CSS in a point."""

LEGEND: Final = 202.5
"""Width of a legend in points, that of the page's margin: lengths in it are those of the drawing."""

BY_VALUE: Final = 3.0
"""Radius in points of dots whose colours are to be told apart, where it is not given."""

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
            name for name, part in vars(self).items() if not (part is None or (isinstance(part, str) and part == ""))
        ]

    def blocks(self, lonlat: FloatArray, latitude: Latitude) -> dict[str, str]:
        """Contents of the page by name; none where nothing is said."""
        if not self.said:
            return {}
        dots, entries = self.dots(len(lonlat))
        scales = [entry for entry in entries.values() if isinstance(entry, ColorScale)]
        lines: dict[str, str] = {}
        if scales and len(lonlat) <= MOST_CONTOURED:
            lines = _isolines(lonlat, np.asarray(self.values, dtype=np.float64), scales[0], latitude)
        title = {"title": f", title={self.title!r}"} if self.title else {}
        told = {"title": self.title, "source": self.source, "legend": legend(entries)} | dots
        told["lines"] = title | dots.get("lines", {})
        return {"owner": packed(json.dumps(told).encode("utf-8", "replace"))} | lines

    def dots(self, count: int) -> tuple[dict[str, Any], dict[str, LegendEntry]]:
        """Inks, radii and values of so many places, if anything is said of them, and what a legend says."""
        if self.size is None and self.color is None and self.values is None:
            return {}, {}
        given = (self.size, self.color, self.values, self.scale, self.legend, None, self.size_legend)
        dots = DotLooks.of(count, replace(MAP_DOT, radius=BY_VALUE), *given)
        colors = np.array([dots.style.color]) if dots.colors is None else dots.colors
        inks, number = np.unique(np.round(colors * 255) / 255, axis=0, return_inverse=True)
        told = {
            "inks": [css(ink) for ink in inks],
            "ink": np.broadcast_to(number.ravel(), count).tolist(),
            "radii": np.round(np.array(dots.radii(count)) * PIXELS, 2).tolist(),
            "columns": (columns := self._columns()),
            "lines": self._lines(dots, columns, inks, number.ravel()),
        }
        return told, dots.entries

    def _lines(
        self, dots: DotLooks, columns: list[tuple[str, list[Any]]], inks: FloatArray, ink: Indices
    ) -> dict[str, str]:
        """Parts of the lines of Python that draw these looks in pixels, from a table with the columns of the page."""
        scales = {type(entry): entry for entry in dots.entries.values()}
        color, amounts = scales.get(ColorScale), scales.get(SizeScale)
        if color is not None:
            lines = {"scale": repr(color), "valued": json.dumps(columns[0][0], ensure_ascii=False)}
            points = {"values": "values", "scale": "scale", "legend": repr(self.legend or "value")}
        elif dots.colors is not None:
            lines, points = {"shades": f"np.array({inks.round(4).tolist()})[{ink.tolist()}]"}, {"color": "shades"}
        else:
            lines, points = {"shades": f"[{dots.style.color}] * len(places)"}, {"color": str(dots.style.color)}
        points["size"] = repr(round(2 * dots.style.radius * PIXELS, 2))
        if isinstance(amounts, SizeScale):
            title = columns[-1][0]
            points["size"], points["size_legend"] = f"table.column({title!r})", repr(self.size_legend or "size")
            points["size_scale"] = f"SizeScale({amounts.high!r}, {as_length(amounts.largest, 'largest') * PIXELS!r})"
        return lines | {"points": ", ".join(f"{name}={value}" for name, value in points.items())}

    def _columns(self) -> list[tuple[str, list[Any]]]:
        """Titles and values, those of both scales once if they are called the same; what is missing is null."""
        named = ((self.legend or "value", self.values), (self.size_legend or "size", self.size))
        columns = {
            title: np.asarray(values).tolist() for title, values in named if values is not None and np.ndim(values)
        }
        return [(title, [None if each != each else each for each in column]) for title, column in columns.items()]


def _isolines(lonlat: FloatArray, values: FloatArray, scale: ColorScale, latitude: Latitude) -> dict[str, str]:
    """Isolines at the ticks of a scale, as rows of places."""
    levels = [tick for tick in scale.ticks if scale.low < tick < scale.high]
    found = contours(SphericalDelaunay.from_lonlat(lonlat, latitude=latitude), values, levels)
    if not found:
        return {}
    offsets = np.cumsum([0, *(len(line.points) for line in found)])
    return {"isolines": packed_places(Ragged(np.concatenate([line.lonlat for line in found]), offsets), ISOLINE_DIGITS)}


def css(color: ColorLike) -> str:
    """A colour as CSS writes it."""
    red, green, blue, opacity = as_color(color)
    return f"rgb({round(255 * red)} {round(255 * green)} {round(255 * blue)} / {opacity:.3g})"


def legend(entries: Mapping[str, LegendEntry]) -> str:
    """The legend of pictures as SVG, whose type and lines have the ink and the font of what is around it."""
    if not entries:
        return ""
    from stereodel.render.vector.svg import svg

    blank = Page((0.0, 1.0, -0.001, 0.0), width=LEGEND, background=(0.0, 0.0, 0.0, 0.0))
    text = svg(with_legend(blank, entries))
    own = f"legend-{zlib.crc32(text.encode()):x}-"  # other than those of another legend in the same document
    for pattern, other in (
        (r'(?s)<\?xml.*?\?>\s*|<style>.*?</style>\s*| (font-family|inkscape:\w+)="[^"]*"', ""),
        ('stroke="#(000000|3d3d3d)"', 'stroke="currentColor"'),
        ("<text ", '<text fill="currentColor" '),
        (r'( id="|url\(#|labelledby=")', rf"\1{own}"),
    ):
        text = re.sub(pattern, other, text)
    return text
