"""A reader of SVG files: what they show, as marks. What it does not know it refuses, so that nothing slips through."""

import base64
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace
from io import BytesIO

import imageio.v3 as iio
import numpy as np

from tests.images.marks import Mark, levels, path_of, together, transformed

SVG = "{http://www.w3.org/2000/svg}"
LINK = "{http://www.w3.org/1999/xlink}href"

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
}
"""Properties that elements inherit."""

OWN = {"opacity", "clip-path", "image-rendering"}
"""Properties that they do not."""

SILENT = {"metadata", "defs", "title", "desc"}
"""Elements that show nothing."""


@dataclass(frozen=True)
class _State:
    look: dict
    matrix: np.ndarray
    opacity: float = 1.0
    clips: tuple = ()
    group: str = ""


def read_svg(file):
    """Width and height of the page in points, and its marks in order."""
    root = ET.parse(file).getroot()
    width, height = (float(re.fullmatch(r"([\d.]+)pt", root.get(name))[1]) for name in ("width", "height"))
    assert [float(n) for n in root.get("viewBox").split()] == [0.0, 0.0, width, height]
    # Upward, as paper is measured.
    flip = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, height], [0.0, 0.0, 1.0]])
    return (width, height), list(_Reader(root).children(root, _State(DEFAULTS, flip)))


class _Reader:
    def __init__(self, root):
        self.named = {element.get("id"): element for element in root.iter() if element.get("id")}
        self.paths = {}
        self.groups = 0
        (sheet,) = [element.text for element in root.iter(f"{SVG}style")]
        (rules,) = re.fullmatch(r"\s*\*\s*\{([^{}]*)\}\s*", sheet).groups()
        self.for_all = _properties(rules)

    def children(self, element, state):
        for child in element:
            yield from self.marks(child, state)

    def marks(self, element, state):
        """Marks of an element and of what it holds."""
        kind = element.tag.removeprefix(SVG)
        if not isinstance(element.tag, str) or kind in SILENT:
            return
        state = self.state_in(element, state)
        match kind:
            case "g":
                yield from self.children(element, state)
            case "use":
                shift = _transform(f"translate({element.get('x', '0')} {element.get('y', '0')})")
                used = self.named[element.get(LINK).removeprefix("#")]
                yield from self.marks(used, replace(state, matrix=state.matrix @ shift))
            case "path":
                yield from self.path_marks(element, state)
            case "image":
                yield self.image_mark(element, state)
            case _:
                raise NotImplementedError(f"element {element.tag}")

    def state_in(self, element, state):
        """What holds in an element: properties of its own over those of the sheet over those that it inherits."""
        attributes = {name: element.get(name) for name in [*DEFAULTS, *OWN] if element.get(name) is not None}
        own = {**attributes, **self.for_all, **_properties(element.get("style", ""))}
        unknown = own.keys() - DEFAULTS.keys() - OWN
        assert not unknown, f"properties {unknown}"
        group = state.group
        if element.tag == f"{SVG}g" and element.get("id"):
            self.groups += 1
            group = f"{element.get('id')}#{self.groups}"
        matrix = state.matrix @ _transform(element.get("transform", ""))
        clips = state.clips
        if own.get("clip-path", "none") != "none":
            clips += (self.clip(own["clip-path"], matrix),)
        look = {**state.look, **{name: value for name, value in own.items() if name in DEFAULTS}}
        return _State(look, matrix, state.opacity * float(own.get("opacity", 1)), clips, group)

    def clip(self, reference, matrix):
        (name,) = re.fullmatch(r"url\(#([^)]*)\)", reference).groups()
        shapes = [child for child in self.named[name] if child.tag == f"{SVG}path"]
        assert len(shapes) == len(self.named[name])
        return together(transformed(self.path(s), matrix @ _transform(s.get("transform", ""))) for s in shapes)

    def path(self, element):
        """The path of an element in its own units."""
        if element not in self.paths:
            self.paths[element] = _path(element.get("d", ""))
        return self.paths[element]

    def path_marks(self, element, state):
        """A path is filled, then stroked."""
        look, path = state.look, transformed(self.path(element), state.matrix)
        if len(path.pieces) == 0:
            return
        if look["fill"] != "none":
            color = _color(look["fill"], state.opacity * float(look["fill-opacity"]))
            even_odd = look["fill-rule"] == "evenodd"
            yield Mark("fill", color, path, even_odd=even_odd, clips=state.clips, group=state.group)
        if look["stroke"] != "none" and float(look["stroke-width"]) > 0:
            scale = float(np.sqrt(abs(np.linalg.det(state.matrix))))
            dash = look["stroke-dasharray"]
            assert float(look["stroke-dashoffset"]) == 0
            yield Mark(
                "stroke",
                _color(look["stroke"], state.opacity * float(look["stroke-opacity"])),
                path,
                width=float(look["stroke-width"]) * scale,
                dash=() if dash == "none" else tuple(float(n) * scale for n in re.split(r"[,\s]+", dash.strip())),
                cap=look["stroke-linecap"],
                join=look["stroke-linejoin"],
                clips=state.clips,
                group=state.group,
            )

    def image_mark(self, element, state):
        kind, data = element.get(LINK).split(",", 1)
        assert kind == "data:image/png;base64"
        pixels = iio.imread(BytesIO(base64.b64decode(data)), extension=".png", mode="RGBA")
        x, y, w, h = (float(element.get(name, "0")) for name in ("x", "y", "width", "height"))
        corners = np.array([[x, y + h, 1.0], [x + w, y, 1.0]]) @ state.matrix.T
        (left, bottom), (right, top) = corners[:, :2]
        assert left < right and bottom < top and state.matrix[0, 1] == state.matrix[1, 0] == 0  # noqa: PT018
        assert state.opacity == 1
        return Mark("image", place=(left, bottom, right, top), pixels=pixels, clips=state.clips, group=state.group)


def _path(text):
    """A path of absolute commands, with or without their letter repeated."""
    commands = re.findall(r"[A-Za-z]", text)
    assert set(commands) <= set("MLQCZz"), f"commands {set(commands)} of a path"
    numbers = np.fromstring(re.sub(r"[A-Za-z,]", " ", text), sep=" ")
    return path_of("".join(commands).upper().encode(), numbers)


def _properties(text):
    pairs = [rule.split(":", 1) for rule in text.split(";") if rule.strip()]
    return {name.strip(): value.strip() for name, value in pairs}


def _color(code, opacity):
    (digits,) = re.fullmatch(r"#([0-9a-f]{6})", code).groups()
    return levels(*(int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4)), opacity)


def _transform(text):
    matrix = np.eye(3)
    for name, inside in re.findall(r"(\w+)\s*\(([^)]*)\)", text):
        numbers = [float(n) for n in re.split(r"[,\s]+", inside.strip())]
        step = np.eye(3)
        match name:
            case "matrix":
                step[:2] = np.array(numbers).reshape(3, 2).T
            case "translate":
                step[:2, 2] = [*numbers, 0.0][:2]
            case "scale":
                step[0, 0], step[1, 1] = (numbers * 2)[:2]
            case "rotate":
                assert len(numbers) == 1
                turn = np.radians(numbers[0])
                step[:2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
            case _:
                raise NotImplementedError(f"transform {name}")
        matrix = matrix @ step
    return matrix
