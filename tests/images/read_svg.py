"""A reader of SVG files: what they show, as marks. What it does not know it refuses, so that nothing slips through."""

import base64
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace
from io import BytesIO
from unicodedata import normalize

import imageio.v3 as iio
import numpy as np
import pytest
from fontTools.ttLib import TTFont

from tests.images.fonts import glyph_path
from tests.images.marks import Light, Mark, Sheet, levels, path_of, short_numbers, together, transformed

SVG = "{http://www.w3.org/2000/svg}"
SPACE = "{http://www.w3.org/XML/1998/namespace}space"

DEFAULTS = {
    "fill": "#000000",
    "fill-rule": "nonzero",
    "fill-opacity": "1",
    "stroke": "none",
    "stroke-opacity": "1",
    "stroke-width": "1",
    "stroke-dasharray": "none",
    "stroke-dashoffset": "0",
    "stroke-linecap": "butt",
    "stroke-linejoin": "miter",
    "class": "",
    "font-size": "",
}
"""Properties that elements inherit."""

OWN = {"clip-path"}
"""Properties that they do not."""

SILENT = {"title", "desc", "style", "clipPath", "radialGradient"}
"""Elements that show nothing."""

KNOWN = {
    "id",
    "d",
    "transform",
    "role",
    "aria-hidden",
    "aria-labelledby",
    "width",
    "height",
    "viewBox",
    "x",
    "y",
    SPACE,
}
KNOWN |= {"href", "preserveAspectRatio", "text-rendering"}
"""What elements may have beside properties."""

FACE = re.compile(
    r"@font-face\{font-family:'(?P<name>[^']+)';(?P<kind>font-style:\w+;font-weight:\w+);"
    r"src:url\(data:font/woff;base64,(?P<data>[^)]*)\)\}\s*"
    r"\.(?P<style>[\w-]+)\{font-family:'(?P=name)','(?P<family>[^']+)',(?P<others>[^;]+),serif;(?P=kind)\}\s*"
)
"""A font, and the class of what is set in it, or in others of the kind where a program knows no fonts of files."""


@dataclass(frozen=True)
class _State:
    properties: dict
    matrix: np.ndarray
    clips: tuple = ()
    group: str = ""


def read_svg(file):
    """What an SVG file shows and tells."""
    root = ET.parse(file).getroot()
    width, height = (float(re.fullmatch(r"([\d.]+)pt", root.get(name))[1]) for name in ("width", "height"))
    assert [float(n) for n in root.get("viewBox").split()] == [0.0, 0.0, width, height]
    # Upward, as paper is measured.
    flip = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, height], [0.0, 0.0, 1.0]])
    reader = _Reader(root)
    marks = list(reader.children(root, _State(DEFAULTS, flip)))
    assert reader.named.keys() - reader.used <= reader.shown, "definitions that nothing uses"
    return Sheet((width, height), marks, *_told(root), reader.texts)


def _told(root):
    """Title and description: they come first, and the picture says that they are its name."""
    told = [(child.tag.removeprefix(SVG), child) for child in root if child.tag in (f"{SVG}title", f"{SVG}desc")]
    assert [child for _, child in told] == list(root)[: len(told)]
    assert root.get("role") == ("img" if told else None)
    assert (root.get("aria-labelledby") or "").split() == [child.get("id") for _, child in told]
    texts = {kind: child.text for kind, child in told}
    return texts.get("title", ""), texts.get("desc", "")


class _Reader:
    def __init__(self, root):
        ids = [element.get("id") for element in root.iter() if element.get("id") is not None]
        assert len(ids) == len(set(ids)), "an id stands twice"
        assert all(re.fullmatch(r"[^\s]+", name) for name in ids)
        self.named = {element.get("id"): element for element in root.iter() if element.get("id")}
        self.used = set((root.get("aria-labelledby") or "").split())
        self.shown = {name for name, element in self.named.items() if element.tag.removeprefix(SVG) not in SILENT}
        self.groups = 0
        self.fonts, self.texts = {}, []
        for sheet in root.iter(f"{SVG}style"):
            faces = list(FACE.finditer(sheet.text + "\n"))
            assert "".join(face[0] for face in faces) == sheet.text + "\n"
            self.fonts |= {face["style"]: TTFont(BytesIO(base64.b64decode(face["data"])), lazy=False) for face in faces}

    def children(self, element, state):
        for child in element:
            yield from self.marks(child, state)

    def marks(self, element, state):
        """Marks of an element and of what it holds."""
        kind = element.tag.removeprefix(SVG)
        if not isinstance(element.tag, str) or kind in SILENT:
            return
        outside, state = state, self.state_in(element, state)
        match kind:
            case "g" if all(child.tag == f"{SVG}path" and child.keys() == ["d"] for child in element):
                # Long lines of one style are several paths.
                whole = ET.Element(f"{SVG}path", {"d": "".join(child.get("d") for child in element)})
                yield from self.path_marks(whole, replace(state, group=outside.group))
            case "g":
                yield from self.children(element, state)
            case "text":
                assert element.get("text-rendering") == "geometricPrecision"
                self.texts.append("")
                yield from self.children(element, state)
            case "tspan":
                yield from self.type_marks(element, state)
            case "path":
                yield from self.path_marks(element, state)
            case "image":
                yield self.image_mark(element, state)
            case _:
                raise NotImplementedError(f"element {element.tag}")

    def state_in(self, element, state):
        """What holds in an element: properties of its own over those that it inherits."""
        own = {name: value for name, value in element.attrib.items() if name not in KNOWN}
        unknown = own.keys() - DEFAULTS.keys() - OWN
        assert not unknown, f"properties {unknown}"
        group = state.group
        if element.tag == f"{SVG}g" and element.get("id"):
            self.groups += 1
            group = f"{element.get('id')}#{self.groups}"
        matrix = state.matrix @ _transform(element.get("transform", ""))
        clips = state.clips
        if "clip-path" in own:
            clips += (self.clip(own["clip-path"], matrix),)
        properties = {**state.properties, **{name: value for name, value in own.items() if name in DEFAULTS}}
        return _State(properties, matrix, clips, group)

    def referred(self, reference):
        """The element that url(#name) means."""
        (name,) = re.fullmatch(r"url\(#([^)]*)\)", reference).groups()
        self.used.add(name)
        return self.named[name]

    def clip(self, reference, matrix):
        shapes = list(self.referred(reference))
        assert all(child.tag == f"{SVG}path" for child in shapes)
        return together(transformed(_path(s.get("d")), matrix) for s in shapes)

    def light(self, reference, matrix):
        element = self.referred(reference)
        assert element.tag == f"{SVG}radialGradient"
        assert element.get("gradientUnits") == "userSpaceOnUse"
        given = {name: element.get(name) for name in ("cx", "cy", "r", "fx", "fy")}
        assert all(map(short_numbers, given.values()))
        assert element.keys() - given.keys() == {"id", "gradientUnits"}
        cx, cy, radius, fx, fy = map(float, given.values())
        (focus, center) = (np.array([[fx, fy, 1.0], [cx, cy, 1.0]]) @ matrix.T)[:, :2]
        assert all(stop.tag == f"{SVG}stop" and stop.keys() == ["offset", "stop-color"] for stop in element)
        offsets = np.array([float(stop.get("offset")) for stop in element])
        colors = np.array([_color(stop.get("stop-color"), 1.0)[:3] for stop in element]) / 255
        return Light(focus, center, radius, offsets, colors)

    def type_marks(self, element, state):
        """A glyph for each character, in the place that is given for it."""
        font, size = self.fonts[state.properties["class"]], float(state.properties["font-size"])
        assert list(element) == []
        x, y = (element.get(name).split() for name in "xy")
        assert short_numbers(" ".join(x + y))
        assert len(x) == len(element.text)
        assert len(y) in (1, len(x))
        color = _color(state.properties["fill"], float(state.properties["fill-opacity"]))
        for code, left, low in zip(element.text, x, y * (len(x) // len(y)), strict=True):
            self.texts[-1] += normalize("NFKC", code) if code in "\ufb00\ufb01\ufb02\ufb03\ufb04" else code
            glyph = glyph_path(font, font.getBestCmap()[ord(code)])
            place = np.array([[size, 0.0, float(left)], [0.0, -size, float(low)], [0.0, 0.0, 1.0]])
            path = transformed(glyph, state.matrix @ place)
            if len(path.pieces):
                yield Mark("fill", color, path, clips=state.clips, group=state.group)

    def path_marks(self, element, state):
        """A path is filled, then stroked."""
        style, path = state.properties, transformed(_path(element.get("d")), state.matrix)
        if len(path.pieces) == 0:
            return
        if style["fill"] != "none":
            opacity, light = float(style["fill-opacity"]), None
            if style["fill"].startswith("url"):
                light, color = self.light(style["fill"], state.matrix), levels(0, 0, 0, opacity)
            else:
                color = _color(style["fill"], opacity)
            even_odd = style["fill-rule"] == "evenodd"
            yield Mark("fill", color, path, even_odd=even_odd, clips=state.clips, group=state.group, light=light)
        if style["stroke"] != "none":
            dash = style["stroke-dasharray"]
            yield Mark(
                "stroke",
                _color(style["stroke"], float(style["stroke-opacity"])),
                path,
                width=float(style["stroke-width"]),
                dash=() if dash == "none" else tuple(float(n) for n in dash.split()),
                cap=style["stroke-linecap"],
                join=style["stroke-linejoin"],
                clips=state.clips,
                group=state.group,
            )

    def image_mark(self, element, state):
        kind, data = element.get("href").split(",", 1)
        assert kind == "data:image/png;base64"
        assert element.get("preserveAspectRatio") == "none"
        pixels = iio.imread(BytesIO(base64.b64decode(data)), extension=".png", mode="RGBA")
        x, y, w, h = (float(element.get(name, "0")) for name in ("x", "y", "width", "height"))
        corners = np.array([[x, y + h, 1.0], [x + w, y, 1.0]]) @ state.matrix.T
        (left, bottom), (right, top) = corners[:, :2]
        assert left < right and bottom < top and state.matrix[0, 1] == state.matrix[1, 0] == 0  # noqa: PT018
        return Mark("image", place=(left, bottom, right, top), pixels=pixels, clips=state.clips, group=state.group)


def _path(text):
    """A path of commands with a letter each: M absolute, l and c relative, two halves of a circle by a."""
    assert re.fullmatch(r"(M[^MlcaZ]+|[lca][^MlcaZ]+|Z)*", text), f"a path begins with {text[:80]!r}"
    assert short_numbers(text), "a number has more than three decimals"
    commands, numbers, here = [], [], np.zeros(2)
    for letter, rest in re.findall(r"([MlcaZ])([^MlcaZ]*)", text):
        values = np.array([float(n) for n in re.findall(r"-?(?:\d+\.?\d*|\.\d+)", rest)])
        if letter == "Z":
            commands.append("Z")
            continue
        if letter == "a":
            found = _half_circle(here, values)
        else:
            found = values.reshape(-1, 2) + (0 if letter == "M" else here)
            assert len(found) == {"M": 1, "l": 1, "c": 3}[letter], "a command has other numbers than it takes"
        commands += ["C"] * (len(found) // 3) if letter in "ac" else [{"M": "M", "l": "L"}[letter]]
        numbers.append(found)
        here = found[-1]
    return path_of("".join(commands).encode(), np.concatenate([np.zeros((0, 2)), *numbers]).ravel())


def _half_circle(start, values):
    """Half a circle, clockwise downwards, as four cubics (12, 2)."""
    radius, other, *flags, across, up = values
    assert (radius, flags, up) == (other, [0, 1, 0], 0)
    assert abs(across) == pytest.approx(2 * radius, abs=2e-3)
    center, way = start + [across / 2, 0], np.array([np.sign(across), 1.0]) * radius
    reach = 4 / 3 * np.tan(np.pi / 16)
    points = []
    for t in np.arange(4) * (np.pi / 4):
        (a, b), u = ([(-np.cos(s), np.sin(s)) for s in (t, t + np.pi / 4)]), t + np.pi / 4
        points += [a + reach * np.array([np.sin(t), np.cos(t)]), b - reach * np.array([np.sin(u), np.cos(u)]), b]
    return center + np.array(points) * way * [1, np.sign(across)]


def _color(code, opacity):
    (digits,) = re.fullmatch(r"#([0-9a-f]{6})", code).groups()
    return levels(*(int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4)), opacity)


def _transform(text):
    """A rotation about a place, which is all that files have."""
    if not text:
        return np.eye(3)
    turn, x, y = map(float, re.fullmatch(r"rotate\(([-.\d]+) ([-.\d]+) ([-.\d]+)\)", text).groups())
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    return np.array([[c, -s, x - c * x + s * y], [s, c, y - s * x - c * y], [0.0, 0.0, 1.0]])
