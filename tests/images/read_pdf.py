"""A reader of PDF files of one page: what they show, as marks. What it does not know it refuses.

Objects and streams are unpacked by pypdf, outlines of embedded fonts by fontTools; operators are read here.
"""

import re
from dataclasses import dataclass, field, replace
from io import BytesIO

import numpy as np
import pypdf
from fontTools.ttLib import TTFont

from tests.images.fonts import glyph_path
from tests.images.marks import Light, Mark, Sheet, levels, path_of, short_numbers, transformed

CAPS = ("butt", "round", "square")
JOINS = ("miter", "round", "bevel")
COMMANDS = {b"m": b"M", b"l": b"L", b"c": b"C", b"h": b"Z"}
PAINTS = {b"S", b"s", b"f", b"F", b"f*", b"B", b"B*", b"b", b"b*", b"n"}

TOKEN = re.compile(
    rb"""\s*(?:
    (?P<path>(?:(?:[-+.\d]+\s+){2}(?:(?:[-+.\d]+\s+){4}c|[ml])(?=\s)\s+|h(?=\s)\s*)+)
    |(?P<number>[-+.\d]+)(?=[\s\[\]/(<]|$)
    |/(?P<name>[^\s/\[\]()<>]*)
    |\((?P<string>(?:[^\\()]|\\[\s\S])*)\)
    |<(?P<hex>[0-9A-Fa-f\s]*)>
    |(?P<bracket>[\[\]])
    |(?P<operator>[A-Za-z'"][A-Za-z0-9*]*)
    )""",
    re.VERBOSE,
)

ESCAPES = {b"n": b"\n", b"r": b"\r", b"t": b"\t", b"b": b"\b", b"f": b"\f"}


@dataclass(frozen=True)
class _State:
    """The graphics state."""

    matrix: np.ndarray = field(default_factory=lambda: np.eye(3))
    fill: tuple = (0.0, 0.0, 0.0)
    light: object = None
    stroke: tuple = (0.0, 0.0, 0.0)
    fill_opacity: float = 1.0
    stroke_opacity: float = 1.0
    width: float = 1.0
    dash: tuple = ()
    cap: int = 0
    join: int = 0
    clips: tuple = ()
    font: object = None
    size: float = 0.0


def read_pdf(file):
    """What a PDF file of one page shows and tells."""
    document = pypdf.PdfReader(file)
    (page,) = document.pages
    left, bottom, right, top = (float(side) for side in page.mediabox)
    assert (left, bottom) == (0.0, 0.0)
    reader = _Reader()
    reader.run(page.get_contents().get_data(), page["/Resources"], _State())
    told = document.metadata or {}
    assert told.keys() <= {"/Title", "/Subject"}
    title = told.get("/Title", "")
    assert bool(title) == ("/ViewerPreferences" in document.root_object)
    return Sheet((right, top), reader.marks, title, told.get("/Subject", ""), reader.texts)


class _Reader:
    def __init__(self):
        self.marks = []
        self.fonts, self.texts = {}, []

    def run(self, content, resources, state):
        """Carry out the operators of a stream."""
        stack, operands = [], []
        commands, numbers, clipping = b"", [], False
        text = np.eye(3)
        for kind, token in _tokens(content):
            if kind == "path":
                commands += b"".join(COMMANDS[letter] for letter in re.findall(rb"[mlch]", token))
                assert short_numbers(token.decode()), "a number has more than three decimals"
                numbers.append(np.fromstring(re.sub(rb"[mlch]", b" ", token), sep=" "))
                continue
            if kind != "operator":
                operands.append(token)
                continue
            match token, operands:
                case b"q", []:
                    stack.append(state)
                case b"Q", []:
                    state = stack.pop()
                case b"cm", _:
                    state = replace(state, matrix=state.matrix @ _matrix(operands))
                case b"w" | b"J" | b"j", [number]:
                    state = replace(state, **{{b"w": "width", b"J": "cap", b"j": "join"}[token]: number})
                case b"d", [list() as dash, phase]:
                    assert phase == 0
                    state = replace(state, dash=tuple(dash))
                case b"g" | b"rg", _:
                    state = replace(state, fill=tuple(operands * (3 // len(operands))), light=None)
                case b"G" | b"RG", _:
                    state = replace(state, stroke=tuple(operands * (3 // len(operands))))
                case b"cs", ["Pattern"]:
                    pass
                case b"scn", [name]:
                    state = replace(state, light=_light(resources["/Pattern"][f"/{name}"].get_object()))
                case b"gs", [name]:
                    state = _with_settings(state, resources["/ExtGState"][f"/{name}"])
                case b"W", []:
                    clipping = True
                case _, [] if token in PAINTS:
                    path = path_of(commands, np.concatenate([np.zeros(0), *numbers]))
                    path = transformed(path, state.matrix)
                    self.paint(token, path, state)
                    if clipping:
                        state = replace(state, clips=(*state.clips, path))
                    commands, numbers, clipping = b"", [], False
                case b"Do", [name]:
                    self.show(resources["/XObject"][f"/{name}"].get_object(), state)
                case b"BT", []:
                    self.texts.append("")
                    text = np.eye(3)
                case b"ET", []:
                    pass
                case b"Tf", [name, size]:
                    state = replace(state, font=self.font(resources["/Font"].raw_get(f"/{name}")), size=size)
                case b"Tm", _:
                    text = _matrix(operands)
                case b"TJ", [list() as strings]:
                    text = self.write(strings, text, state)
                case _:
                    raise NotImplementedError(f"operator {token!r} with {operands}")
            operands = []
        assert stack == []
        assert operands == []
        assert commands == b""

    def paint(self, operator, path, state):
        """Fill, then stroke."""
        if len(path.pieces) == 0:
            return
        if operator in (b"s", b"b", b"b*"):
            raise NotImplementedError("paths that are closed when they are painted")
        if operator[:1] in (b"f", b"F", b"B"):
            color = levels(*state.fill, state.fill_opacity)
            even_odd = operator[1:] == b"*"
            self.marks.append(Mark("fill", color, path, even_odd=even_odd, clips=state.clips, light=state.light))
        if operator[:1] in (b"S", b"B") and state.width > 0:
            scale = float(np.sqrt(abs(np.linalg.det(state.matrix))))
            self.marks.append(
                Mark(
                    "stroke",
                    levels(*state.stroke, state.stroke_opacity),
                    path,
                    width=state.width * scale,
                    dash=tuple(length * scale for length in state.dash),
                    cap=CAPS[int(state.cap)],
                    join=JOINS[int(state.join)],
                    clips=state.clips,
                )
            )

    def show(self, thing, state):
        """An image."""
        assert thing["/Subtype"] == "/Image"
        assert state.fill_opacity == 1
        pixels = np.asarray(thing.decode_as_image().convert("RGBA"))
        assert state.matrix[0, 1] == state.matrix[1, 0] == 0
        # The unit square, its upper side the first row.
        (left, bottom), (right, top) = (np.array([[0.0, 0.0, 1.0], [1.0, 1.0, 1.0]]) @ state.matrix.T)[:, :2]
        if top < bottom:
            bottom, top, pixels = top, bottom, pixels[::-1]
        assert left < right
        self.marks.append(Mark("image", place=(left, bottom, right, top), pixels=pixels, clips=state.clips))

    def font(self, reference):
        if reference.idnum not in self.fonts:
            self.fonts[reference.idnum] = _Font(reference.get_object())
        return self.fonts[reference.idnum]

    def write(self, strings, text, state):
        """Outlines of glyphs as fills; returns where the text goes on."""
        for part in strings:
            if not isinstance(part, bytes):
                text = text @ _matrix([1.0, 0.0, 0.0, 1.0, -part / 1000 * state.size, 0.0])
                continue
            for code in np.frombuffer(part, dtype=">u2").tolist():
                size = np.diag([state.size, state.size, 1.0])
                self.texts[-1] += state.font.text(code)
                path = transformed(state.font.outline(code), state.matrix @ text @ size)
                if len(path.pieces):
                    color = levels(*state.fill, state.fill_opacity)
                    self.marks.append(Mark("fill", color, path, clips=state.clips))
                text = text @ _matrix([1.0, 0.0, 0.0, 1.0, state.font.width(code) / 1000 * state.size, 0.0])
        return text


class _Font:
    """A TrueType font of characters of two bytes."""

    def __init__(self, font):
        assert font["/Subtype"] == "/Type0"
        assert font["/Encoding"] == "/Identity-H"
        (descendant,) = (entry.get_object() for entry in font["/DescendantFonts"])
        assert descendant["/Subtype"] == "/CIDFontType2"
        self.missing_width = float(descendant.get("/DW", 1000))
        self.widths = {}
        runs = iter(descendant["/W"])
        for first in runs:
            for number, width in enumerate(next(runs)):
                self.widths[int(first) + number] = float(width)
        assert descendant["/CIDToGIDMap"] == "/Identity"
        self.texts = _texts(font["/ToUnicode"].get_object().get_data().decode())
        self.file = TTFont(BytesIO(descendant["/FontDescriptor"].get_object()["/FontFile2"].get_object().get_data()))
        assert re.fullmatch(r"/[A-Z]{6}\+.+", font["/BaseFont"])
        self.outlines = {}

    def width(self, code):
        return self.widths.get(code, self.missing_width)

    def text(self, code):
        return self.texts[code]

    def outline(self, code):
        """The outline of a character at size 1."""
        if code not in self.outlines:
            self.outlines[code] = glyph_path(self.file, self.file.getGlyphName(code))
        return self.outlines[code]


def _texts(cmap):
    """The characters that glyphs stand for."""
    blocks = re.findall(r"(\d+) beginbfchar\n(.*?)endbfchar", cmap, re.DOTALL)
    pairs = [pair for _, block in blocks for pair in re.findall(r"<([0-9A-F]{4})> <((?:[0-9A-F]{4})+)>\n", block)]
    assert sum(int(count) for count, _ in blocks) == len(pairs)
    return {int(code, 16): bytes.fromhex(text).decode("utf-16-be") for code, text in pairs}


def _light(pattern):
    """A radial gradient whose colours are linear between the offsets."""
    assert pattern["/PatternType"] == 2
    assert "/Matrix" not in pattern
    shading = pattern["/Shading"]
    assert (shading["/ShadingType"], shading["/ColorSpace"]) == (3, "/DeviceRGB")
    assert [bool(end) for end in shading["/Extend"]] == [True, True]
    fx, fy, least, cx, cy, radius = map(float, shading["/Coords"])
    assert least == 0
    function = shading["/Function"]
    parts = list(function["/Functions"])
    assert [part["/N"] for part in parts] == [1] * len(parts)
    assert list(function["/Encode"]) == [0, 1] * len(parts)
    ends = np.array([[[float(n) for n in part[name]] for name in ("/C0", "/C1")] for part in parts])
    assert (ends[1:, 0] == ends[:-1, 1]).all()
    offsets = np.array([0.0, *map(float, function["/Bounds"]), 1.0])
    return Light(np.array([fx, fy]), np.array([cx, cy]), radius, offsets, np.vstack([ends[:, 0], ends[-1:, 1]]))


def _tokens(content):
    """Operands and operators of a stream; what builds paths comes in one piece."""
    place, array = 0, None
    end = len(content.rstrip())
    while place < end:
        found = TOKEN.match(content, place)
        assert found, f"cannot read {content[place : place + 40]!r}"
        place, kind, token = found.end(), found.lastgroup, found[found.lastgroup]
        if kind == "bracket":
            if token == b"[":
                array = []
            else:
                yield "operand", array
                array = None
            continue
        if kind not in ("path", "operator"):
            kind, token = "operand", _operand(kind, token)
        if array is None:
            yield kind, token
        else:
            array.append(token)


def _operand(kind, token):
    match kind:
        case "number":
            return float(token)
        case "name":
            return token.decode()
        case "hex":
            return bytes.fromhex(token.decode())
    return re.sub(rb"\\([0-7]{1,3}|[\s\S])", _unescaped, token)


def _unescaped(found):
    escaped = found[1]
    return bytes([int(escaped, 8)]) if escaped.isdigit() else ESCAPES.get(escaped, escaped)


def _matrix(numbers):
    matrix = np.eye(3)
    matrix[:2] = np.array(numbers, dtype=np.float64).reshape(3, 2).T
    return matrix


def _with_settings(state, settings):
    unknown = settings.keys() - {"/Type", "/CA", "/ca"}
    assert not unknown, f"settings {unknown}"
    return replace(state, stroke_opacity=float(settings["/CA"]), fill_opacity=float(settings["/ca"]))
