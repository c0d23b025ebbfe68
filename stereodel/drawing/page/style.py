"""The house style: colours, line widths, dots, tints and fonts of every picture.

Widths and radii are in points (1/72 inch) for a picture that is printed 17 cm wide. The accents have the hues of Okabe
and Ito's palette, which can be distinguished with any colour vision, and lightnesses that remain distinct when printed
in gray. The type is STIX, which matplotlib ships and which includes mathematics.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Final, TypeVar

from stereodel._arrays import as_scalar
from stereodel.drawing.page.colors import Color, ColorLike, as_color

T = TypeVar("T")

PRINT_WIDTH: Final = 17.0 / 2.54 * 72.0
"""Width of a figure in print, points: 17 cm."""

PRINT_DPI: Final = 300
"""Pixels per inch of a picture in print."""

LABEL_SIZE: Final = 9.0
"""Height of type in points."""


def _hex(code: str, opacity: float = 1.0) -> Color:
    red, green, blue = (int(code[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return (red, green, blue, opacity)


WHITE: Final = _hex("#ffffff")
BLACK: Final = _hex("#000000")
GRAY: Final = _hex("#7a7a7a")
DARK_GRAY: Final = _hex("#3d3d3d")
GRID_GRAY: Final = _hex("#8f959b")
BLUE: Final = _hex("#005a94")
VERMILION: Final = _hex("#c64e00")
GREEN: Final = _hex("#00a075")
ORANGE: Final = _hex("#e69f00")
SKY: Final = _hex("#56b4e9")

FAINT: Final = 0.62
"""Share of white mixed into colours on the far side of a transparent ball, in [0, 1]."""


def fainter(color: Color, amount: float = FAINT) -> Color:
    """A colour mixed with white."""
    red, green, blue, opacity = color
    return (red + (1 - red) * amount, green + (1 - green) * amount, blue + (1 - blue) * amount, opacity)


def with_opacity(color: Color, opacity: float) -> Color:
    """The same colour at another opacity."""
    return (*color[:3], opacity)


@dataclass(frozen=True, init=False)
class LineStyle:
    """The style of a line.

    Parameters
    ----------
    color : color-like
        Colour in any form accepted by `as_color`.
    width : float
        In points.
    dash : (float, float), optional
        Length of dash and gap in points.

    Raises
    ------
    ValueError
        If the colour is invalid or the width negative.

    Examples
    --------
    >>> LineStyle("black", 0.5).scaled(2)
    LineStyle(color=(0.0, 0.0, 0.0, 1.0), width=1.0, dash=None)
    """

    color: Color
    width: float
    dash: tuple[float, float] | None = None

    def __init__(self, color: ColorLike, width: float, dash: tuple[float, float] | None = None) -> None:
        object.__setattr__(self, "color", as_color(color))
        object.__setattr__(self, "width", as_scalar(width, "width", low=0.0))
        object.__setattr__(self, "dash", dash)

    def scaled(self, weight: float) -> LineStyle:
        """The same line for a smaller or larger picture."""
        return replace(self, width=weight * self.width)

    @property
    def hidden(self) -> LineStyle:
        """The same line on the far side of a transparent ball: fainter and a little thinner."""
        return replace(self, color=fainter(self.color), width=0.8 * self.width)


@dataclass(frozen=True, init=False)
class DotStyle:
    """The style of a dot.

    Parameters
    ----------
    color : color-like
        Colour in any form accepted by `as_color`.
    radius : float
        In points, including the rim.
    rim : color-like
        Colour of the rim, which lies inside the radius.
    rim_width : float
        In points; 0 for none.

    Raises
    ------
    ValueError
        If a colour is invalid, or the radius or width negative.
    """

    color: Color
    radius: float
    rim: Color = WHITE
    rim_width: float = 0.0

    def __init__(self, color: ColorLike, radius: float, rim: ColorLike = WHITE, rim_width: float = 0.0) -> None:
        object.__setattr__(self, "color", as_color(color))
        object.__setattr__(self, "radius", as_scalar(radius, "radius", low=0.0))
        object.__setattr__(self, "rim", as_color(rim, "rim"))
        object.__setattr__(self, "rim_width", as_scalar(rim_width, "rim_width", low=0.0))

    def scaled(self, weight: float) -> DotStyle:
        """The same dot for a smaller or larger picture."""
        return replace(self, radius=weight * self.radius, rim_width=weight * self.rim_width)

    @property
    def hidden(self) -> DotStyle:
        """The same dot on the far side of a transparent ball."""
        return replace(self, color=fainter(self.color), radius=0.85 * self.radius)


LINES: Final[Mapping[str, LineStyle]] = {
    "delaunay": LineStyle(GRAY, 0.8),
    "voronoi": LineStyle(BLACK, 0.9),
    "graticule": LineStyle(GRID_GRAY, 0.4),
    "fine": LineStyle(BLACK, 0.56),
    "limb": LineStyle(DARK_GRAY, 1.2),
    "circle": LineStyle(BLACK, 1.1),
    "arc": LineStyle(BLUE, 1.2),
    "chord": LineStyle(VERMILION, 1.1),
    "ray": LineStyle(VERMILION, 0.7),
    "plane": LineStyle(DARK_GRAY, 0.6),
    "frame": LineStyle(DARK_GRAY, 0.6),
    "axis": LineStyle(BLACK, 0.6),
    "outline": LineStyle(BLACK, 1.1),
    "footprint": LineStyle(VERMILION, 1.1, (4.0, 2.5)),
    "construction": LineStyle(DARK_GRAY, 0.5, (3.0, 2.0)),
    "accent1": LineStyle(BLUE, 1.2),
    "accent2": LineStyle(VERMILION, 1.2),
    "accent3": LineStyle(GREEN, 1.2),
    "covered1": LineStyle(BLUE, 2.6),
    "covered2": LineStyle(VERMILION, 2.6),
    "covered3": LineStyle(GREEN, 2.6),
}
"""Line styles by name. On a ball no line is wider than the limb, which covers their ends."""

DOTS: Final[Mapping[str, DotStyle]] = {
    "sites": DotStyle(BLACK, 2.0, rim_width=0.5),
    "points": DotStyle(VERMILION, 2.4, rim_width=0.5),
    "vertices": DotStyle(BLACK, 1.2),
    "pole": DotStyle(BLACK, 2.2, rim_width=0.5),
    "ring": DotStyle(WHITE, 2.6, rim=BLACK, rim_width=0.9),
    "accent1": DotStyle(BLUE, 2.4, rim_width=0.5),
    "accent2": DotStyle(VERMILION, 2.4, rim_width=0.5),
    "accent3": DotStyle(GREEN, 2.4, rim_width=0.5),
}
"""Dot styles by name."""

FILLS: Final[Mapping[str, Color]] = {
    "ball": _hex("#f4f6f8"),
    "glass": _hex("#dfe7ee", 0.3),
    "small_bubble": _hex("#f8d79f"),
    "large_bubble": _hex("#a3c8e5"),
    "triangle": with_opacity(SKY, 0.37),
    "chordal": with_opacity(ORANGE, 0.65),
    "plane": _hex("#9db4c8", 0.28),
    "facet": _hex("#c9d3dc"),
    "visible": _hex("#f0a35e"),
    "new": _hex("#6fb7e0"),
    "cell": with_opacity(SKY, 0.25),
    "accent1": with_opacity(BLUE, 0.27),
    "accent2": with_opacity(VERMILION, 0.16),
    "accent3": with_opacity(GREEN, 0.25),
}
"""Tints of regions by name."""

MAP_LINES: Final[Mapping[str, LineStyle]] = {
    "limb": LineStyle(DARK_GRAY, 0.6),
    "coast": LineStyle((0.25, 0.33, 0.40, 1.0), 0.45),
    "borders": LineStyle((0.55, 0.48, 0.45, 1.0), 0.35),
    "rivers": LineStyle((0.36, 0.58, 0.74, 1.0), 0.35),
    "graticule": LineStyle(GRID_GRAY, 0.25),
    "line": LineStyle(BLACK, 0.5),
    "outline": LineStyle(DARK_GRAY, 0.4),
    "parting": LineStyle(WHITE, 0.4),  # of regions by value, of which some are dark
}
"""Default line styles of globes."""

MAP_DOT: Final = DotStyle(VERMILION, 1.8, rim=WHITE, rim_width=0.4)
"""Default dot style of globes."""

MAP_FILLS: Final[Mapping[str, Color]] = {
    "ocean": (0.780, 0.860, 0.915, 1.0),
    "land": (0.957, 0.937, 0.890, 1.0),
    "area": with_opacity(ORANGE, 0.5),  # a hue different from sea and land, which both show through
    "circle": with_opacity(VERMILION, 0.30),
}
"""Default tints of globes."""

HALO: Final = 1.6
"""Width in points of halos on globes."""

HALO_OPACITY: Final = 0.8
"""Opacity of halos, which have the colour of the ground: lines under them are dimmed, not interrupted."""

TYPE: Final[Mapping[str, Any]] = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": LABEL_SIZE,
    "axes.unicode_minus": True,
    "lines.scale_dashes": False,  # dashes are in points, whatever the width
    "text.usetex": False,
    "text.hinting": "no_hinting",
    "text.antialiased": True,
    "path.simplify": False,
}
"""matplotlib settings with which every page is drawn; the fonts are those that matplotlib ships."""


def line(name: str, style: LineStyle | None = None) -> LineStyle:
    """The style of a line: the one given, otherwise that of its name; ValueError if the name has none."""
    return _look_up(LINES, name, "line", "style") if style is None else style


def dot(name: str, style: DotStyle | None = None) -> DotStyle:
    """The style of a dot, as for `line`."""
    return _look_up(DOTS, name, "dot", "style") if style is None else style


def fill(name: str, color: ColorLike | None = None) -> Color:
    """The colour of a region, as for `line`."""
    return _look_up(FILLS, name, "fill", "color") if color is None else as_color(color)


def _look_up(table: Mapping[str, T], name: str, kind: str, remedy: str) -> T:
    if name not in table:
        raise ValueError(f"name {name!r} has no {kind} style; give {remedy}=, or one of the names {', '.join(table)}")
    return table[name]


LengthLike = float | str
"""A number of points, 1/72 inch, or a text such as "17cm", "8.4 cm", "120mm", "6.5in", "480pt"."""

POINTS: Final[Mapping[str, float]] = {"pt": 1.0, "mm": 72 / 25.4, "cm": 72 / 2.54, "in": 72.0}
"""Units in points."""

_LENGTH: Final = re.compile(r"\s*((?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(pt|mm|cm|in|)\s*", re.IGNORECASE)


def as_length(value: LengthLike, name: str) -> float:
    """A positive length in points, from points or a number with one of the units pt, mm, cm and in.

    >>> as_length("1in", "width"), as_length("2.54 cm", "width"), as_length(72, "width")
    (72.0, 72.0, 72.0)
    """
    if not isinstance(value, str):
        return as_scalar(value, name, low=0.0, open_low=True)
    found = _LENGTH.fullmatch(value)
    number = float(found[1]) if found else 0.0
    if found is None or not number > 0:
        raise ValueError(f"{name} is {value!r}; give a length with a unit, {', '.join(POINTS)}, such as 17cm")
    return number * POINTS[found[2].lower() or "pt"]
