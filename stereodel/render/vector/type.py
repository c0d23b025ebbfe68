"""The labels of a page as positioned glyphs, and the fonts that vector files embed for them.

Matplotlib typesets the labels, as for pixels, on a canvas so fine that its rounding is invisible. Files contain
characters, so that text can be searched, copied and read aloud, and of each font only the glyphs used.
"""

from __future__ import annotations

import hashlib
import io
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from typing import Any, Final, Literal, NamedTuple, cast
from unicodedata import bidirectional, category, normalize

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import of_extra
from stereodel.constants import FINEST_OUTLINE
from stereodel.drawing.page import Label, Page
from stereodel.render.vector.agg import drawn, matplotlib_settings
from stereodel.render.vector.outlines import CLOSE, CURVE, LINE, MOVE, RECTANGLE, Outlines

with of_extra("draw"):
    from fontTools.pens.basePen import BasePen
    from fontTools.pens.cu2quPen import Cu2QuPen
    from fontTools.pens.ttGlyphPen import TTGlyphPen
    from fontTools.subset import Options, Subsetter
    from fontTools.ttLib import TTFont, newTable
    from fontTools.ttLib.tables._c_m_a_p import CmapSubtable
    from matplotlib import _text_helpers
    from matplotlib.backend_bases import RendererBase
    from matplotlib.font_manager import fontManager
    from matplotlib.textpath import text_to_path

FINER: Final = 64
"""Pixels per point of the canvas on which type is set: matplotlib rounds sizes in formulas to whole pixels."""

LEFTWARD: Final = ("R", "AL")
"""Unicode's bidirectional classes of right-to-left letters."""

VARIATIONS: Final = ("fvar", "gvar", "avar", "cvar", "HVAR", "VVAR", "MVAR", "STAT", "COLR", "CPAL", "SVG ")
"""Font tables of variable weights, of which the default is used, and of colours, of which labels have one."""

TABLES: Final = ("GSUB", "GPOS", "GDEF", "kern", "DSIG", "FFTM", "MATH", "prop")
"""Font tables that subsets omit: glyphs are positioned explicitly and never substituted."""


class Face(NamedTuple):
    """A font: a file, and the index of the font within it."""

    path: str
    number: int = 0


@dataclass(frozen=True)
class Glyph:
    """A positioned glyph on a line of type, in points."""

    font: Face
    index: int
    text: str
    """The characters that it represents: two for a ligature."""
    size: float
    x: float
    y: float


@dataclass(frozen=True)
class Line:
    """A line of type: glyphs, and the bars of fractions and roots.

    x, y: start on the page, in points from the lower left corner.
    rotation: counterclockwise rotation about the start, in degrees.
    words: the text; "" of a formula.
    """

    glyphs: tuple[Glyph, ...]
    bars: tuple[tuple[float, float, float, float], ...]
    x: float
    y: float
    rotation: float
    words: str = ""
    order: tuple[str, ...] = ()
    """Files of the families in which it is set, in order of preference."""

    @property
    def shaped(self) -> bool:
        """Whether letters join, stack or run from right to left, so that glyphs are not the characters in order."""
        return any(bidirectional(sign) in LEFTWARD or category(sign) in {"Mn", "Mc"} for sign in self.words)

    @property
    def fonts(self) -> list[Face]:
        """Its fonts in the order in which characters look for theirs: of each family before those of the next."""
        used = dict.fromkeys(glyph.font for glyph in self.glyphs)
        return sorted(used, key=lambda font: (*self.order, font.path).index(font.path))

    @property
    def advance(self) -> float:
        """Width from the start to where more type would begin."""
        widths = ((glyph.x, glyph.size * advance_of(glyph.font, glyph.index)) for glyph in self.glyphs)
        return max((x + width for x, width in widths if width), default=0.0)  # marks have no width

    @property
    def leftward(self) -> bool:
        """Whether some words run from right to left."""
        return any(bidirectional(sign) in LEFTWARD for sign in self.words)

    @property
    def begins_leftward(self) -> bool:
        """Whether the first letter with a direction runs from right to left, so that the first word is on the right."""
        strong = (bidirectional(sign) for sign in self.words)
        return next((kind != "L" for kind in strong if kind in {"L", *LEFTWARD}), False)

    @property
    def matrix(self) -> FloatArray:
        """From the line's coordinates to the page's, in points, (2, 3)."""
        turn = np.radians(self.rotation)
        return np.array([[np.cos(turn), -np.sin(turn), self.x], [np.sin(turn), np.cos(turn), self.y]])

    def placed(self, outline: Outlines) -> Outlines:
        """An outline of the line's coordinates on the page, in points."""
        matrix = self.matrix
        return Outlines(outline.points @ matrix[:, :2].T + matrix[:, 2], outline.kinds)

    @property
    def outline(self) -> Outlines:
        """The outlines of all glyphs and bars, in points on the page."""
        nothing = Outlines(np.zeros((0, 2)), np.zeros(0, dtype=np.uint8))
        drawn = ((glyph_outline(glyph.font, glyph.index), glyph) for glyph in self.glyphs)
        letters = (Outlines(o.points * glyph.size + np.array((glyph.x, glyph.y)), o.kinds) for o, glyph in drawn)
        return self.placed(sum((*letters, self.bar_outline), start=nothing))

    @property
    def bar_outline(self) -> Outlines:
        """The bars in the line's coordinates."""
        corners = [[(x, y), (x + w, y), (x + w, y + h), (x, y + h), (x, y)] for x, y, w, h in self.bars]
        return Outlines(np.array(corners).reshape(-1, 2), np.tile(RECTANGLE, len(corners)))


def lines_of(page: Page) -> Iterator[tuple[Label, list[Line]]]:
    """The visible labels of a page with their lines of type."""
    if not page.labels:
        return
    with matplotlib_settings():
        # Text with a halo is drawn as outlines, which are not reported as text.
        bare = replace(page, items=tuple(replace(label, halo=0.0) for label in page.labels))
        canvas = drawn(bare, 72.0 * FINER)
        for label, text in zip(page.labels, canvas.axes[0].texts, strict=True):
            recorder = _Recorder()
            text.draw(recorder)
            if recorder.lines:
                yield label, recorder.lines


class _Recorder(RendererBase):
    """Records the lines as which a text is drawn."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: list[Line] = []

    def flipy(self) -> bool:
        """False: positions are measured upward."""
        return False

    def points_to_pixels(self, points: Any) -> Any:
        """On a canvas of `FINER` pixels a point."""
        return points * FINER

    def draw_text(
        self, gc: Any, x: float, y: float, s: str, prop: Any, angle: float, ismath: Any = False, mtext: Any = None
    ) -> None:
        glyphs, bars = _formula(self, s, prop) if ismath else (_words(s, prop), ())
        glyphs = tuple(glyphs)
        if any(not glyph.text.isspace() for glyph in glyphs) or bars:
            order = tuple(map(str, cast(Any, fontManager)._find_fonts_by_props(prop)))
            self.lines.append(Line(glyphs, bars, x / FINER, y / FINER, angle, "" if ismath else s, order))


def _words(text: str, properties: Any) -> Iterator[Glyph]:
    """Matplotlib's own layout: its public interface gives outlines of characters, but not the characters."""
    size, maker = properties.get_size_in_points(), cast(Any, text_to_path)
    item: Any
    for item in _text_helpers.layout(text, maker._get_font(properties)):
        # Before matplotlib 3.11 all characters were on the baseline, and the name was different.
        index = item.glyph_index if hasattr(item, "glyph_index") else item.glyph_idx
        x, y = (size * (place / maker.FONT_SCALE) for place in (item.x, getattr(item, "y", 0.0)))
        yield Glyph(_face(item.ft_object), index, item.char, size, x, y)


def _formula(renderer: Any, text: str, properties: Any) -> tuple[Iterable[Glyph], tuple[Any, ...]]:
    parsed = renderer._text2path.mathtext_parser.parse(text, 72.0 * FINER, properties)
    glyphs = []
    for font, size, code, *index, x, y in parsed.glyphs:  # before matplotlib 3.11 the code alone
        number = index[0] if index else font.get_char_index(code)
        glyphs.append(Glyph(_face(font), number, chr(code), size, x / FINER, y / FINER))
    return glyphs, tuple(tuple(float(side) / FINER for side in bar) for bar in parsed.rects)


def _face(font: Any) -> Face:
    return Face(font.fname, getattr(font, "face_index", 0))  # before matplotlib 3.11 the first of a file's fonts alone


# Fonts


def _opened(face: Face) -> Any:
    return TTFont(face.path, fontNumber=face.number, recalcTimestamp=False)


_font = cache(_opened)
"""Fonts that are only read."""


@cache
def advance_of(face: Face, index: int) -> float:
    """The advance width of a glyph of a font, at size 1."""
    font = _font(face)
    return float(font["hmtx"][font.getGlyphName(index)][0] / font["head"].unitsPerEm)


@cache
def glyph_outline(face: Face, index: int) -> Outlines:
    """The outline of a glyph of a font, at size 1."""
    font = _font(face)
    glyphs = font.getGlyphSet()
    pen = _Pen(glyphs)
    glyphs[font.getGlyphName(index)].draw(pen)
    points = np.array(pen.points, dtype=np.float64).reshape(-1, 2) / font["head"].unitsPerEm
    return Outlines(points, np.array(pen.kinds, dtype=np.uint8))


class _Pen(BasePen):  # type: ignore[misc]
    """Records an outline, with quadratic curves as cubics."""

    def __init__(self, glyphs: Any) -> None:
        super().__init__(glyphs)
        self.points: list[tuple[float, float]] = []
        self.kinds: list[int] = []

    def _moveTo(self, pt: tuple[float, float]) -> None:
        self._add(MOVE, pt)

    def _lineTo(self, pt: tuple[float, float]) -> None:
        self._add(LINE, pt)

    def _curveToOne(self, *pts: tuple[float, float]) -> None:
        self._add(CURVE, *pts)

    def _closePath(self) -> None:
        self._add(CLOSE, self.points[-1])

    def _add(self, kind: int, *points: tuple[float, float]) -> None:
        self.points += points
        self.kinds += [kind] * len(points)


@dataclass(frozen=True, eq=False)
class Subset:
    """The subset of a font used in a file, as a font; `glyphs` has the characters of each glyph by its index.

    shaped: whether programs shape its text, by the rules for joining and stacking letters, which it then includes.
    """

    font: Face
    shaped: bool = False
    glyphs: dict[int, str] = field(default_factory=dict)

    @property
    def face(self) -> Any:
        """The whole font."""
        return _font(self.font)

    @property
    def family(self) -> str:
        """The family of the font."""
        return str(self.face["name"].getBestFamilyName())

    @property
    def name(self) -> str:
        """The PostScript name, with a six-letter prefix that distinguishes subsets, as PDF requires."""
        digest = hashlib.sha256(repr(sorted(self.glyphs.items())).encode()).digest()
        letters = "".join(chr(ord("A") + byte % 26) for byte in digest[:6])
        own = self.face["name"].getDebugName(6) or self.family
        return f"{letters}+{re.sub('[^A-Za-z0-9-]', '', own)}"

    @cached_property
    def codes(self) -> dict[int, str]:
        """The one character mapped to each glyph: its own, unless it has several or another glyph already has it."""
        codes: dict[int, str] = {}
        for index, text in sorted(self.glyphs.items()):
            own = text if len(text) == 1 else _ligature(self.font, index, text)
            taken = codes.values()
            # Private use characters of Unicode, for glyphs without a character of their own.
            free = (chr(code) for code in range(0xE000, 0xF900) if chr(code) not in {*taken, *self.glyphs.values()})
            codes[index] = own if own and own not in taken else next(free)
        return codes

    def file(self, flavor: Literal["woff"] | None = None) -> bytes:
        """The font file, TrueType or WOFF; glyphs keep their indices unless programs shape the text."""
        options = Options(hinting=False, notdef_outline=True)
        if self.shaped:
            options.drop_tables += (*VARIATIONS, "FFTM")
            return _bytes(_subset(self.font, options, text="".join(self.glyphs.values())), flavor)
        options.layout_features, options.retain_gids = [], True
        options.drop_tables += (*TABLES, *VARIATIONS)
        font = _subset(self.font, options, gids=sorted(self.glyphs))
        font["cmap"] = _character_map({ord(code): font.getGlyphName(index) for index, code in self.codes.items()})
        return _bytes(font, flavor)


def subsets(lines: Iterable[Line], *, shaped: bool = False) -> dict[Face, Subset]:
    """The subset of each font used by lines of type."""
    used: dict[Face, Subset] = {}
    for line in lines:
        for glyph in line.glyphs:
            used.setdefault(glyph.font, Subset(glyph.font, shaped)).glyphs.setdefault(glyph.index, glyph.text)
    return used


def _subset(face: Face, options: Any, **kept: Any) -> Any:
    font, subsetter = _opened(face), Subsetter(options)
    subsetter.populate(**kept)
    subsetter.subset(font)
    return font


def _bytes(font: Any, flavor: Literal["woff"] | None) -> bytes:
    """A font as a file with TrueType outlines."""
    if "glyf" not in font:
        _to_truetype(font)
    font.flavor = flavor
    buffer = io.BytesIO()
    font.save(buffer)
    return buffer.getvalue()


def _to_truetype(font: Any) -> None:
    """Replace the cubic outlines of a font by quadratic ones within `FINEST_OUTLINE` of its size."""
    drawn, order = font.getGlyphSet(), font.getGlyphOrder()
    glyphs = {}
    for name in order:
        pen = TTGlyphPen(None)
        # TrueType outlines have the opposite direction.
        drawn[name].draw(Cu2QuPen(pen, FINEST_OUTLINE * font["head"].unitsPerEm, reverse_direction=True))
        glyphs[name] = pen.glyph()
    font["loca"], table = newTable("loca"), newTable("glyf")
    table.glyphOrder, table.glyphs, font["glyf"] = order, glyphs, table
    for name in order:
        glyphs[name].recalcBounds(table)
        font["hmtx"][name] = (font["hmtx"][name][0], getattr(glyphs[name], "xMin", 0))
    maxp = font["maxp"]
    maxp.tableVersion, maxp.maxZones, maxp.maxTwilightPoints, maxp.maxStorage = 0x00010000, 1, 0, 0
    maxp.maxFunctionDefs = maxp.maxInstructionDefs = maxp.maxStackElements = maxp.maxSizeOfInstructions = 0
    maxp.maxComponentElements = 0
    font["post"].formatType, font["post"].glyphOrder, font["post"].extraNames = 3.0, None, []
    for tag in {"CFF ", "CFF2", "VORG"} & set(font.keys()):
        del font[tag]
    font.sfntVersion = "\0\1\0\0"


def _ligature(face: Face, index: int, text: str) -> str:
    """The character of a ligature, such as U+FB01 for f and i; empty if there is none."""
    font = _font(face)
    name = font.getGlyphName(index)
    codes = (chr(code) for code, glyph in font.getBestCmap().items() if glyph == name)
    return next((code for code in codes if normalize("NFKC", code) == text), "")


def _character_map(glyphs: dict[int, str]) -> Any:
    """The font table from characters to glyphs, for all of Unicode."""
    entry = CmapSubtable.newSubtable(12)
    entry.platformID, entry.platEncID, entry.language, entry.cmap = 3, 10, 0, glyphs
    table = newTable("cmap")
    table.tableVersion, table.tables = 0, [entry]
    return table
