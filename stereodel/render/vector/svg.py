"""Pages as SVG: exact curves, text as text, balls shaded by gradients, in points from the upper left corner.

Names of items become layers, as Inkscape knows them, and unique ids. A line of text is one run in its own family:
programs that have the font can edit it. For others it is embedded under a name of its own: browsers show the same as
PNG and PDF. What reads no embedded fonts shows another serif font, anchored where the label is. Formulas are runs of
one font and size.
"""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import groupby
from typing import Final, Literal
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from stereodel._arrays import Pixels
from stereodel._extras import of_extra
from stereodel.drawing.page import Ball, Item, Label, Page
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.items import LEGEND, Ramp, xml_name
from stereodel.drawing.page.style import PRINT_DPI
from stereodel.render.vector.outlines import Discs, Drawn, Filled, Outlines, Shape, Shown, ground, shapes
from stereodel.render.vector.paper import Paper, exact, number, numbers, runs, shades
from stereodel.render.vector.type import Face, Glyph, Line, Subset, advance_of, lines_of, subsets

with of_extra("draw"):
    from PIL import Image

LONGEST_PATH: Final = 200_000
"""Length in characters above which lines and dots are split into several paths, as editors redraw whole paths."""

SERIF: Final = "'STIX Two Text','Times New Roman',Times,serif"
"""Fallback fonts for programs that ignore embedded fonts."""

ANCHORS: Final = {"left": (0.0, "start", "end"), "center": (0.5, "middle", "middle"), "right": (1.0, "end", "start")}
"""Of a label's alignments: where lines are anchored, in their widths, and the word for it, also from right to left."""

NAMESPACES: Final = (
    'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
)
"""Illustrator and older programs read links as those of XLink alone."""


def svg(page: Page, pictures: Sequence[Pixels] = ()) -> str:
    """A page as the text of an SVG file; `pictures` hold the whole page for each of `page.pictured`, which clips it."""
    return _SvgSheet(page).text(pictures)


class _SvgSheet:
    """A page being written."""

    def __init__(self, page: Page) -> None:
        self.page, self.paper = page, Paper.of(page, downward=True)
        self.names = {"title": 1, "desc": 1}  # ids, and how many begin so
        self.gradients: dict[tuple[Ball | Ramp, Sequence[float]], str] = {}

    def text(self, pictures: Sequence[Pixels]) -> str:
        page = self.page
        sides = number(page.width), number(page.height)
        told = [(name, text) for name, text in (("title", page.title), ("desc", page.description)) if text]
        labels = f' role="img" aria-labelledby="{" ".join(name for name, _ in told)}"' if told else ""
        lettering = list(lines_of(page))
        fonts = subsets(line for _, lines in lettering for line in lines if not line.words)
        shaped = subsets((line for _, lines in lettering for line in lines if line.words), shaped=True)
        rest, layers = iter(pictures), groupby(page.without_labels().items, key=_layer)
        written = (line for label, its in lettering for line in self.label(label, its, fonts, shaped))
        lines = [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<svg {NAMESPACES} width="{sides[0]}pt" height="{sides[1]}pt" '
            f'viewBox="0 0 {sides[0]} {sides[1]}"{labels}>',
            *(f'<{name} id="{name}">{escape(text)}</{name}>' for name, text in told),
            *([_sheet([*fonts.values(), *shaped.values()])] if fonts or shaped else []),
            *self.layer("ground", (line for shape in ground(page) for line in self.shape(shape))),
            *(line for name, items in layers for line in self.layer(name, self.items(items, rest))),
            *self.layer("labels", written),
            "</svg>",
        ]
        return "\n".join(lines) + "\n"

    def name(self, wanted: str) -> str:
        """An id that no other element has."""
        name = stem = xml_name(wanted) or "item"
        while name in self.names:
            self.names[stem] += 1
            name = f"{stem}-{self.names[stem]}"
        self.names[name] = 1
        return name

    def layer(self, name: str, content: Iterable[str]) -> Iterator[str]:
        """A layer, unless it is empty."""
        own, lines = f"{name or 'item'}-layer", list(content)
        if lines:
            yield f'<g id="{self.name(own)}" inkscape:groupmode="layer" inkscape:label={quoteattr(name or "item")}>'
            yield from lines
            yield "</g>"

    def items(self, items: Iterable[Item], pictures: Iterator[Pixels]) -> Iterator[str]:
        """Items of one name; parts with names of their own each by itself."""
        for tagged, group in groupby(items, key=lambda item: item.tags is not None):
            some = tuple(group)
            alone = ((told, (part,)) for item in some for told, part in item.parts())
            parts = alone if tagged else [(None, some)]
            for told, its in parts:
                drawn = list(shapes(replace(self.page, items=its), PRINT_DPI, pictures))
                if grouped := told is not None and len(drawn) > 1:  # a dot and its rim
                    yield f"<g {self.attributes(told, its[0].name)}>"
                yield from (line for shape in drawn for line in self.shape(shape, None if grouped else told))
                if grouped:
                    yield "</g>"

    def attributes(self, told: Mapping[str, str] | None, name: str) -> str:
        """The attributes of an element, whose id is `name` unless it is told another."""
        own = {"id": name, **(told or {})}
        own["id"] = self.name(own["id"])
        return " ".join(f"{key}={quoteattr(text)}" for key, text in own.items())

    def path(self, outline: Outlines) -> str:
        return "".join(runs(self.paper.placed(outline)))

    def discs(self, discs: Discs) -> list[str]:
        """Each disc as two semicircles."""
        radius, across = number(discs.radius), number(2 * discs.radius)
        halves = f"a{radius} {radius} 0 1 0 {across} 0a{radius} {radius} 0 1 0 -{across} 0Z"
        corners = self.paper.points(discs.centers) - [discs.radius, 0.0]
        return [f"M{numbers(corner)}{halves}" for corner in corners.tolist()]

    def split(self, named: str, paint: str, found: list[str], *, whole: bool) -> Iterator[str]:
        """Runs of one style as a path, or as several in a group unless they must stay together."""
        paths = ["".join(found)] if whole else _parted(found)
        if len(paths) == 1:
            yield f'<path {named} {paint} d="{paths[0]}"/>'
            return
        yield f"<g {named} {paint}>"
        yield from (f'<path d="{path}"/>' for path in paths)
        yield "</g>"

    def shape(self, shape: Shape, told: Mapping[str, str] | None = None) -> Iterator[str]:
        named = self.attributes(told, shape.name)
        match shape:
            case Discs():
                found, opaque = self.discs(shape), shape.color[3] == 1
                yield from self.split(named, _paint("fill", shape.color), found, whole=not opaque)
            case Filled():
                paint = _paint("fill", shape.color)
                if shape.light:
                    look = (shape.light, shape.color[:3])
                    if look not in self.gradients:
                        self.gradients[look] = self.name(f"{shape.name}-light")
                        yield self.gradient(self.gradients[look], shape.light, shape.color)
                    paint = f'fill="url(#{self.gradients[look]})"{_opacity("fill", shape.color)}'
                rule = ' fill-rule="evenodd"' if shape.even_odd else ""
                yield f'<path {named} {paint}{rule} d="{self.path(shape.outline)}"/>'
            case Drawn():
                dash = f' stroke-dasharray="{numbers(shape.dash)}"' if shape.dash else ""
                paint = (
                    f'fill="none" {_paint("stroke", shape.color)} stroke-width="{exact(shape.width)}"{dash} '
                    f'stroke-linecap="{shape.cap}" stroke-linejoin="round"'
                )
                # Transparent lines of separate paths would be darker where they cross.
                whole = shape.color[3] < 1
                yield from self.split(named, paint, runs(self.paper.placed(shape.outline)), whole=whole)
            case Shown():
                clip = self.name(f"{shape.name}-outline")
                left, right, bottom, top = shape.extent
                (x, y), (end, low) = self.paper.points([(left, top), (right, bottom)]).tolist()
                box = f'x="{number(x)}" y="{number(y)}" width="{number(end - x)}" height="{number(low - y)}"'
                yield f'<clipPath id="{clip}"><path d="{self.path(shape.outline)}"/></clipPath>'
                yield (
                    f'<image {named} clip-path="url(#{clip})" {box} preserveAspectRatio="none" '
                    f'xlink:href="data:image/png;base64,{_png(shape.pixels)}"/>'
                )

    def gradient(self, name: str, light: Ball | Ramp, color: Color) -> str:
        """A colour shaded by a ball, or the colours of a ramp."""
        stops = (f'<stop offset="{exact(at)}" stop-color="{_hex(shade)}"/>' for at, shade in shades(light, color))
        if isinstance(light, Ball):
            (fx, fy), (cx, cy), radius = self.paper.shading(light)
            places, kind = {"cx": cx, "cy": cy, "r": radius, "fx": fx, "fy": fy}, "radialGradient"
        else:
            (x1, y1), (x2, y2) = self.paper.points([(x, 0.0) for x in light.ends])
            places, kind = {"x1": x1, "y1": y1, "x2": x2, "y2": y2}, "linearGradient"
        told = " ".join(f'{key}="{number(value)}"' for key, value in places.items())
        return f'<{kind} id="{name}" gradientUnits="userSpaceOnUse" {told}>{"".join(stops)}</{kind}>'

    def label(
        self, label: Label, lines: Iterable[Line], fonts: dict[Face, Subset], shaped: dict[Face, Subset]
    ) -> Iterator[str]:
        """A label: halo, lines of type and bars."""
        name, lines = self.name(label.name), list(lines)
        shown = quoteattr(" ".join(label.text.split()))
        yield f'<g id="{name}" inkscape:label={shown} {_paint("fill", label.color)}>'
        if label.halo:  # the same type once more; opaque strokes, as those of letters would be darker where they meet
            words = self.name(f"{name}-words")
            yield (
                f'<use xlink:href="#{words}" aria-hidden="true" fill="none" stroke-width="{exact(2 * label.halo)}" '
                f'stroke="{_hex(label.halo_color)}" stroke-linejoin="round" opacity="{exact(label.halo_color[3])}"/>'
            )
            yield f'<g id="{words}">'
        for line in lines:
            yield self.words(line, label.align, shaped) if line.words else self.line(line, fonts)
            if line.bars:
                yield f'<path d="{self.typed(line.placed(line.bar_outline))}"/>'
        yield "</g>" * (2 if label.halo else 1)

    def typed(self, outline: Outlines) -> str:
        """A path from an outline in points from the lower left corner."""
        return "".join(runs(Outlines(outline.points * [1, -1] + [0, self.page.height], outline.kinds)))

    def words(self, line: Line, align: Literal["left", "center", "right"], fonts: dict[Face, Subset]) -> str:
        """A line of type as one run, which programs set by the rules of its script, anchored as its label is aligned.

        Each family comes before its embedded font, and both before the next: so is the font of each character found.
        """
        share, *words = ANCHORS[align]
        x, y = line.matrix @ [share * line.advance, 0.0, 1.0]
        anchor = words[line.begins_leftward]  # text that starts on the right ends on the left
        way = (' direction="rtl"' * line.begins_leftward) + f' text-anchor="{anchor}"' * (anchor != "start")
        families = (_quoted(name) for font in line.fonts for name in (fonts[font].family, fonts[font].name))
        return (
            f'<text xml:space="preserve" text-rendering="geometricPrecision" x="{number(x)}" '
            f'y="{number(self.page.height - y)}" {_family(families)}{_look(fonts[line.fonts[0]])} '
            f'font-size="{exact(line.glyphs[0].size)}"{way}{self.turn(line, x, y)}>{escape(line.words)}</text>'
        )

    def turn(self, line: Line, x: float, y: float) -> str:
        """The attribute that rotates a line of type about a place on it."""
        if not line.rotation:
            return ""
        return f' transform="rotate({exact(-line.rotation)} {numbers((x, self.page.height - y))})"'

    def line(self, line: Line, fonts: dict[Face, Subset]) -> str:
        """A formula as runs of one font and size that begin where they must; some glyphs have codes of their own."""
        spans: list[list[Glyph]] = []
        style, pen = None, 0.0
        for glyph in line.glyphs:
            own = (glyph.font, glyph.size, glyph.y)
            if own != style or abs(glyph.x - pen) > 0.02:  # points
                spans.append([])
                style, pen = own, glyph.x
            spans[-1].append(glyph)
            pen += glyph.size * advance_of(glyph.font, glyph.index)
        written = "".join(self.span(glyphs, line, fonts[glyphs[0].font]) for glyphs in spans)
        # By default, browsers move letters to whole pixels.
        return (
            f'<text xml:space="preserve" text-rendering="geometricPrecision"{self.turn(line, line.x, line.y)}>'
            f"{written}</text>"
        )

    def span(self, glyphs: Sequence[Glyph], line: Line, font: Subset) -> str:
        """A run of a formula; here the embedded font comes first, as no other has its codes."""
        x, y = line.x + glyphs[0].x, self.page.height - line.y - glyphs[0].y
        text = "".join(font.codes[glyph.index] for glyph in glyphs)
        families = _family(map(_quoted, (font.name, font.family)))
        return (
            f'<tspan {families}{_look(font)} font-size="{exact(glyphs[0].size)}" x="{number(x)}" y="{number(y)}">'
            f"{escape(text)}</tspan>"
        )


def _layer(item: Item) -> str:
    """The layer of an item: its name; outlines are in that of what they are around, and a legend is one."""
    return LEGEND.rstrip("-") if item.name.startswith(LEGEND) else item.name.removesuffix("-outline")


def _parted(found: list[str]) -> list[str]:
    """Runs joined into texts of at most `LONGEST_PATH` characters, except runs that are longer themselves."""
    if not found:
        return [""]
    ends = np.cumsum([len(run) for run in found])
    parts = np.split(np.array(found, dtype=object), 1 + np.flatnonzero(np.diff(ends // LONGEST_PATH)))
    return ["".join(part) for part in parts]


def _sheet(fonts: Iterable[Subset]) -> str:
    """The fonts of a file, which are right for text of any weight: no program is to make them bolder."""
    rules = []
    for font in fonts:
        data = base64.b64encode(font.file("woff")).decode()
        look = f"font-style:{'italic' if font.face['head'].macStyle & 2 else 'normal'};font-weight:1 1000"
        rules.append(f"@font-face{{font-family:'{font.name}';{look};src:url(data:font/woff;base64,{data})}}")
    return "<style>" + "\n".join(rules) + "</style>"


def _family(names: Iterable[str]) -> str:
    return f"font-family={quoteattr(','.join([*names, SERIF]))}"


def _look(font: Subset) -> str:
    """The attributes of fonts that are bold or italic."""
    look = font.face["head"].macStyle
    return ' font-weight="bold"' * bool(look & 1) + ' font-style="italic"' * bool(look & 2)


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
