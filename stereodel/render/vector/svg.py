"""Pages as SVG: exact curves, text as text, balls shaded by gradients, in points from the upper left corner.

Names of items become unique ids. Glyphs are positioned individually, in embedded fonts: browsers show the same as PNG
and PDF, and can find and select the text. Programs that do not use them show another serif font in the same places.
"""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import Final
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from stereodel._arrays import Pixels
from stereodel._extras import of_extra
from stereodel.drawing.page import Ball, Label, Page
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.style import PRINT_DPI
from stereodel.render.vector.outlines import Discs, Drawn, Filled, Outlines, Shape, Shown, ground, shapes
from stereodel.render.vector.paper import BRIGHTNESS, OFFSETS, Paper, exact, number, numbers, runs
from stereodel.render.vector.type import Face, Glyph, Line, ShapedSubset, Subset, lines_of, subsets

with of_extra("draw"):
    from PIL import Image

LONGEST_PATH: Final = 200_000
"""Length in characters above which lines and dots are split into several paths, as editors redraw whole paths."""

SERIF: Final = "'STIX Two Text','Times New Roman',Times,serif"
"""Fallback fonts for programs that ignore embedded fonts."""


def svg(page: Page, pictures: Sequence[Pixels] = ()) -> str:
    """A page as the text of an SVG file; `pictures` hold the whole page for each of `page.pictured`, which clips it."""
    return _SvgSheet(page).text(pictures)


class _SvgSheet:
    """A page being written."""

    def __init__(self, page: Page) -> None:
        self.page, self.paper = page, Paper.of(page, downward=True)
        self.names: set[str] = set()

    def text(self, pictures: Sequence[Pixels]) -> str:
        page = self.page
        sides = number(page.width), number(page.height)
        told = [(name, text) for name, text in (("title", page.title), ("desc", page.description)) if text]
        self.names.update(("title", "desc"))
        labels = f' role="img" aria-labelledby="{" ".join(name for name, _ in told)}"' if told else ""
        lettering = list(lines_of(page))
        fonts = subsets(line for _, lines in lettering for line in lines if not line.words)
        shaped = subsets((line for _, lines in lettering for line in lines if line.words), ShapedSubset)
        lines = [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{sides[0]}pt" height="{sides[1]}pt" '
            f'viewBox="0 0 {sides[0]} {sides[1]}"{labels}>',
            *(f'<{name} id="{name}">{escape(text)}</{name}>' for name, text in told),
            *([_sheet(fonts.values(), shaped.values())] if fonts or shaped else []),
            *(line for shape in ground(page) for line in self.shape(shape)),
            *(line for shape in shapes(page, PRINT_DPI, pictures) for line in self.shape(shape)),
            *(line for label, its in lettering for line in self.label(label, its, fonts, shaped)),
            "</svg>",
        ]
        return "\n".join(lines) + "\n"

    def name(self, wanted: str) -> str:
        """An id that no other element has."""
        stem = "-".join(wanted.split()) or "item"
        name, count = stem, 1
        while name in self.names:
            count += 1
            name = f"{stem}-{count}"
        self.names.add(name)
        return name

    def path(self, outline: Outlines) -> str:
        return "".join(runs(self.paper.placed(outline)))

    def discs(self, discs: Discs) -> list[str]:
        """Each disc as two semicircles."""
        radius, across = number(discs.radius), number(2 * discs.radius)
        halves = f"a{radius} {radius} 0 1 0 {across} 0a{radius} {radius} 0 1 0 -{across} 0Z"
        corners = self.paper.points(discs.centers) - [discs.radius, 0.0]
        return [f"M{numbers(corner)}{halves}" for corner in corners.tolist()]

    def split(self, name: str, paint: str, found: list[str], *, whole: bool) -> Iterator[str]:
        """Runs of one style as a path, or as several in a group unless they must stay together."""
        paths = ["".join(found)] if whole else _parted(found)
        if len(paths) == 1:
            yield f'<path id={quoteattr(name)} {paint} d="{paths[0]}"/>'
            return
        yield f"<g id={quoteattr(name)} {paint}>"
        yield from (f'<path d="{path}"/>' for path in paths)
        yield "</g>"

    def shape(self, shape: Shape) -> Iterator[str]:
        match shape:
            case Discs():
                found, opaque = self.discs(shape), shape.color[3] == 1
                yield from self.split(self.name(shape.name), _paint("fill", shape.color), found, whole=not opaque)
            case Filled():
                name = self.name(shape.name)
                paint = _paint("fill", shape.color)
                if shape.ball:
                    light = self.name(f"{name}-light")
                    yield self.gradient(light, shape.ball, shape.color)
                    paint = f'fill="url(#{light})"{_opacity("fill", shape.color)}'
                rule = ' fill-rule="evenodd"' if shape.even_odd else ""
                yield f'<path id={quoteattr(name)} {paint}{rule} d="{self.path(shape.outline)}"/>'
            case Drawn():
                dash = f' stroke-dasharray="{numbers(shape.dash)}"' if shape.dash else ""
                paint = (
                    f'fill="none" {_paint("stroke", shape.color)} stroke-width="{exact(shape.width)}"{dash} '
                    f'stroke-linecap="{shape.cap}" stroke-linejoin="round"'
                )
                # Transparent lines of separate paths would be darker where they cross.
                whole = shape.color[3] < 1
                yield from self.split(self.name(shape.name), paint, runs(self.paper.placed(shape.outline)), whole=whole)
            case Shown():
                name = self.name(shape.name)
                clip = self.name(f"{name}-outline")
                left, right, bottom, top = shape.extent
                (x, y), (end, low) = self.paper.points([(left, top), (right, bottom)]).tolist()
                box = f'x="{number(x)}" y="{number(y)}" width="{number(end - x)}" height="{number(low - y)}"'
                yield f'<clipPath id={quoteattr(clip)}><path d="{self.path(shape.outline)}"/></clipPath>'
                yield (
                    f'<image id={quoteattr(name)} clip-path="url(#{clip})" {box} preserveAspectRatio="none" '
                    f'href="data:image/png;base64,{_png(shape.pixels)}"/>'
                )

    def gradient(self, name: str, ball: Ball, color: Color) -> str:
        """A colour shaded by a ball."""
        (fx, fy), (cx, cy), radius = self.paper.shading(ball)
        stops = "".join(
            f'<stop offset="{exact(offset)}" stop-color="{_hex((red, green, blue, 1.0))}"/>'
            for offset, level in zip(OFFSETS, BRIGHTNESS, strict=True)
            for red, green, blue in [[level * value for value in color[:3]]]
        )
        return (
            f'<radialGradient id={quoteattr(name)} gradientUnits="userSpaceOnUse" cx="{number(cx)}" cy="{number(cy)}" '
            f'r="{number(radius)}" fx="{number(fx)}" fy="{number(fy)}">{stops}</radialGradient>'
        )

    def label(
        self, label: Label, lines: Iterable[Line], fonts: dict[Face, Subset], shaped: dict[Face, Subset]
    ) -> Iterator[str]:
        """A label: halo, lines of type and bars."""
        name, lines = self.name(label.name), list(lines)
        yield f"<g id={quoteattr(name)} {_paint('fill', label.color)}>"
        if label.halo:
            halo = "".join(self.typed(line.outline) for line in lines)
            yield (
                f'<path id={quoteattr(self.name(f"{name}-halo"))} aria-hidden="true" fill="none" '
                f'{_paint("stroke", label.halo_color)} stroke-width="{exact(2 * label.halo)}" stroke-linejoin="round" '
                f'd="{halo}"/>'
            )
        for line in lines:
            yield self.words(line, shaped) if line.words else self.line(line, fonts)
            if line.bars:
                yield f'<path d="{self.typed(line.placed(line.bar_outline))}"/>'
        yield "</g>"

    def typed(self, outline: Outlines) -> str:
        """A path from an outline in points from the lower left corner."""
        return "".join(runs(Outlines(outline.points * [1, -1] + [0, self.page.height], outline.kinds)))

    def words(self, line: Line, fonts: dict[Face, Subset]) -> str:
        """A line of type that programs shape themselves by the rules of its script, from its left end."""
        x, y = line.x, self.page.height - line.y
        used = dict.fromkeys(glyph.font for glyph in line.glyphs)
        families = ",".join(f"'{fonts[font].name}'" for font in fonts if font in used)
        own = ",".join(_quoted(fonts[font].family) for font in used)
        # Text that starts on the right ends on the left.
        way = ' direction="rtl" text-anchor="end"' if line.begins_leftward else ""
        return (
            f'<text xml:space="preserve" text-rendering="geometricPrecision" x="{number(x)}" y="{number(y)}" '
            f'font-family={quoteattr(f"{families},{own},{SERIF}")} font-size="{exact(line.glyphs[0].size)}"{way}'
            f"{self.turn(line)}>{escape(line.words)}</text>"
        )

    def turn(self, line: Line) -> str:
        """The attribute that rotates a line of type about its start."""
        if not line.rotation:
            return ""
        place = numbers((line.x, self.page.height - line.y))
        return f' transform="rotate({exact(-line.rotation)} {place})"'

    def line(self, line: Line, fonts: dict[Face, Subset]) -> str:
        """A line of type with each character positioned, grouped by font and size."""
        x, y = line.x, self.page.height - line.y
        spans, order = [], list(fonts)

        def together(glyph: Glyph) -> tuple[Face, float, int]:
            # Characters beyond 16 bits would count as two positions.
            return glyph.font, glyph.size, id(glyph) * (fonts[glyph.font].codes[glyph.index] > "\uffff")

        for (font, size, _), group in groupby(line.glyphs, key=together):
            glyphs = list(group)
            text = "".join(fonts[font].codes[glyph.index] for glyph in glyphs)
            heights = [number(y - glyph.y) for glyph in glyphs]
            spans.append(
                f'<tspan class="type-{1 + order.index(font)}" font-size="{exact(size)}" '
                f'x="{numbers(x + glyph.x for glyph in glyphs)}" '
                f'y="{heights[0] if len(set(heights)) == 1 else " ".join(heights)}">{escape(text)}</tspan>'
            )
        # By default, browsers move letters to whole pixels.
        return (
            f'<text xml:space="preserve" text-rendering="geometricPrecision"{self.turn(line)}>{"".join(spans)}</text>'
        )


def _parted(found: list[str]) -> list[str]:
    """Runs joined into texts of at most `LONGEST_PATH` characters, except runs that are longer themselves."""
    if not found:
        return [""]
    ends = np.cumsum([len(run) for run in found])
    parts = np.split(np.array(found, dtype=object), 1 + np.flatnonzero(np.diff(ends // LONGEST_PATH)))
    return ["".join(part) for part in parts]


def _sheet(fonts: Iterable[Subset], shaped: Iterable[Subset]) -> str:
    """The fonts of a file, with a class for each font whose glyphs are positioned."""

    def brought(font: Subset, kind: str) -> str:
        data = base64.b64encode(font.file("woff")).decode()
        return f"@font-face{{font-family:'{font.name}';{kind};src:url(data:font/woff;base64,{data})}}"

    rules = []
    for number_, font in enumerate(fonts, start=1):
        look = font.face["head"].macStyle
        kind = f"font-style:{'italic' if look & 2 else 'normal'};font-weight:{'bold' if look & 1 else 'normal'}"
        family = escape(_quoted(font.family))
        rules += [brought(font, kind), f".type-{number_}{{font-family:'{font.name}',{family},{SERIF};{kind}}}"]
    rules += [brought(font, "font-style:normal;font-weight:normal") for font in shaped]
    return "<style>" + "\n".join(rules) + "</style>"


def _quoted(family: str) -> str:
    """The name of a family, quoted for style sheets."""
    return "'" + family.replace("\\", "").replace("'", "\\'") + "'"


def _png(pixels: Pixels) -> str:
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, format="png", optimize=True)
    return base64.b64encode(buffer.getvalue()).decode()


def _paint(what: str, color: Color) -> str:
    return f'{what}="{_hex(color)}"{_opacity(what, color)}'


def _opacity(what: str, color: Color) -> str:
    return "" if color[3] == 1 else f' {what}-opacity="{exact(color[3])}"'


def _hex(color: Color) -> str:
    return "#" + "".join(f"{int(np.floor(255 * value + 0.5)):02x}" for value in color[:3])
