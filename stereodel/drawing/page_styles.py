"""Styles of pages: for a column, for a slide, on a dark background. A style turns a page into another page.

For a medium other than print at full width the picture is laid out again for the size at which it is viewed. Lengths in
page units scale with the page, lengths in points (lines, dots, type) scale less, and labels are placed again
(`stereodel.drawing.type_room`).

On a dark background colours keep their hue and the contrast that they have on white. A luminance Y becomes Y' with
(Y' + 0.05)(Y + 0.05) = (G + 0.05)(1 + 0.05), where G is the luminance of the background. White becomes the background,
black becomes white, and the contrast of any two colours, a quotient of such sums, is unchanged. The picture is not
inverted: hues are kept, and the shading of a ball, which is not a colour of the page, still comes from above.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.drawing.colorimetry import FLARE, contrast, luminance, with_luminance
from stereodel.drawing.colors import Color
from stereodel.drawing.fonts import FontLike, as_font, in_font
from stereodel.drawing.ground import haloed
from stereodel.drawing.page import Dots, Fill, Item, Label, Page, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.style import BLACK, WHITE
from stereodel.drawing.style_files import PageStyle
from stereodel.drawing.type_room import Box, clear_labels, set_anew

GROUND: Final[Color] = (0.07, 0.07, 0.07, 1.0)
"""The dark background. White has contrast 18.7 on it, against 21 of black on white; lower contrasts are kept."""


def dark_page(page: Page) -> Page:
    """A page on a dark background; a page that is already dark is unchanged.

    Images, such as rasters on a globe, keep their pixels.
    """
    ground = dark_color((*page.background[:3], 1.0))
    if contrast(page.background[:3], WHITE[:3]) > contrast(page.background[:3], BLACK[:3]):
        return page
    return replace(page, background=ground, items=tuple(map(_dark_item, page.items)))


def dark_color(color: Color) -> Color:
    """The dark counterpart of a colour on white.

    >>> [round(part, 2) for part in dark_color((1.0, 1.0, 1.0, 1.0))]
    [0.07, 0.07, 0.07, 1.0]
    """
    red, green, blue, opacity = dark_colors(np.array([color]))[0].tolist()
    return (red, green, blue, opacity)


def dark_colors(colors: FloatArray) -> FloatArray:
    """The dark counterparts (n, 4) of colours (n, 4) on white; opacity is unchanged.

    A transparent colour composited on the dark background equals the counterpart of its composite on white, as far as
    such a colour exists.
    """
    several, which = np.unique(colors, axis=0, return_inverse=True)
    opacity = several[:, 3:]
    over_white = 1 - opacity * (1 - several[:, :3])
    ground = luminance(GROUND[:3]) + FLARE
    target = ground * (1 + FLARE) / (luminance(over_white) + FLARE) - FLARE
    seen = with_luminance(over_white, np.clip(target, 0.0, 1.0))
    own = (seen - (1 - opacity) * np.array(GROUND[:3])) / np.where(opacity > 0, opacity, 1.0)
    found = np.concatenate([np.clip(own, 0.0, 1.0), opacity], axis=1)
    return np.asarray(found[which.ravel()])


def _dark_item(item: Item) -> Item:
    match item:
        case Dots():
            return replace(item, color=dark_color(item.color), rim=dark_color(item.rim))
        case Label():
            return replace(item, color=dark_color(item.color), halo_color=dark_color(item.halo_color))
        case Polygons():
            return replace(item, colors=dark_colors(item.colors))
        case Stroke() | Polylines() | Fill():
            return replace(item, color=dark_color(item.color))
        case Picture():
            return item


CENTIMETRE: Final = 72.0 / 2.54
"""Units in points."""

ROUNDS: Final = 12
"""Largest number of times that a picture is reduced to make room for type."""


@dataclass(frozen=True)
class Medium:
    """A medium, and how lengths in points change with the scale s of the picture.

    width, height: of the page in points; without height it has that of the picture.
    margin: around the picture in points.
    line, type_size: factor a and power p: widths of lines and radii of dots, and sizes of type, are multiplied by a sᵖ.
    least_type: smallest size of type in points.
    """

    width: float
    height: float | None
    margin: float
    line: tuple[float, float]
    type_size: tuple[float, float]
    least_type: float


COLUMN: Final = Medium(8.4 * CENTIMETRE, None, 0.0, (1.0, 1 / 3), (1.0, 1 / 2), 7.0)
"""A journal column. Lines of a picture 17 cm wide get 0.79 of their width, 9-point type becomes 7-point."""

SLIDE: Final = Medium(33.87 * CENTIMETRE, 19.05 * CENTIMETRE, 24.0, (1.25, 1.0), (1.15, 1.0), 12.0)
"""A 16:9 slide, viewed from a distance."""


def page_for(page: Page, medium: Medium) -> Page:
    """A page laid out for a medium, with the picture centred; labels without room are left out."""
    free = medium.width - 2 * medium.margin
    high = None if medium.height is None else medium.height - 2 * medium.margin
    scale = free / page.width if high is None else min(free / page.width, high / page.height)
    clear = clear_labels(page)
    items = tuple(_scaled(item, medium, scale) for item in page.items)
    unit = scale * page.points_per_unit
    for _ in range(ROUNDS):
        room = _spread(page.extent, free / unit, 0.0)
        placed, extent = set_anew(items, page.extent, unit, (room[0], room[1]), clear)
        needed = max(
            unit * (extent[1] - extent[0]) / free, 0.0 if high is None else unit * (extent[3] - extent[2]) / high
        )
        if needed <= 1:
            break
        unit /= needed
    extent = _spread(extent, medium.width / unit, 0.0 if medium.height is None else medium.height / unit)
    return replace(page, items=placed, extent=extent, width=medium.width)


def _spread(extent: Box, width: float, height: float) -> Box:
    """An extent with the same centre, at least this wide and high."""
    left, right, bottom, top = extent
    across, up = max(0.0, width - (right - left)) / 2, max(0.0, height - (top - bottom)) / 2
    return (left - across, right + across, bottom - up, top + up)


def _scaled(item: Item, medium: Medium, scale: float) -> Item:
    """An item with its lengths in points scaled for a medium."""
    (line, line_power), (type_size, type_power) = medium.line, medium.type_size
    weight = line * scale**line_power
    match item:
        case Stroke():
            dash = item.dash and (weight * item.dash[0], weight * item.dash[1])
            return replace(item, width=weight * item.width, dash=dash)
        case Polylines():
            return replace(item, width=weight * item.width)
        case Dots():
            return replace(item, radius=weight * item.radius, rim_width=weight * item.rim_width)
        case Label():
            size = max(medium.least_type, type_size * scale**type_power * item.size)
            ratio = size / item.size
            offset = (ratio * item.offset[0], ratio * item.offset[1])
            return replace(item, size=size, offset=offset, halo=ratio * item.halo)
        case _:
            return item


STYLES: Final[Mapping[str, Callable[[Page], Page]]] = {
    "column": lambda page: page_for(page, COLUMN),
    "slide": lambda page: page_for(page, SLIDE),
    "dark": dark_page,
}
"""Functions that apply a style, by name."""

MEDIA: Final = ("column", "slide")
"""Styles that exclude each other."""


Style = str | os.PathLike[str]
"""The name of a style, or a style file."""


def styled(page: Page, *styles: Style, font: FontLike | None = None) -> Page:
    """The same picture in another style, or in several.

    Parameters
    ----------
    page : Page
    *styles : {"column", "slide", "dark"} or path-like
        "column": 8.4 cm wide, for a journal column; text is not smaller than 7 points. "slide": 33.87 × 19.05 cm,
        16 : 9, with heavier lines and larger text, and the picture centred. "dark": on a dark background, where each
        colour keeps its hue and its contrast; a page that is dark already is unchanged, and so are images made of
        pixels, such as rasters on a globe. The order does not matter.
        A TOML file sets colours, widths and sizes by the names of what is drawn; files are applied last, in order.
    font : str, path-like, or sequence of them, optional
        Font families or font files, see `stereodel.drawing.fonts.as_font`, for labels without a font of their own, for
        instance a sans serif on a slide.

    Returns
    -------
    Page

    Raises
    ------
    FileNotFoundError
        If a font file does not exist.
    ValueError
        If a style is unknown, column and slide are combined, a file is not a style, or a font family is not installed.

    Notes
    -----
    In a column and on a slide, text is placed again: above and below the picture it is broken into lines, and the page
    grows; in the picture it moves aside where it would overlap other text, and labels that do not fit are omitted, as
    on maps.

    Halos of a globe's labels without a colour of their own have that of the ground in the new style.

    Examples
    --------
    >>> from stereodel.drawing import Sketch
    >>> page = Sketch().add_circle((0, 0), 1, name="circle").page((-2, 2, -1, 1))
    >>> slide = styled(page, "slide", "dark")
    >>> [round(2.54 * side / 72, 2) for side in (slide.width, slide.height)], round(slide.background[0], 2)
    ([33.87, 19.05], 0.07)
    """
    page = in_font(page, as_font(font))
    return haloed(_in_styles(page, as_styles(styles))) if styles else page


def _in_styles(page: Page, styles: Sequence[str]) -> Page:
    for style in styles:
        if style in STYLES:
            page = STYLES[style](page)
        else:
            own = PageStyle.of_file(style)
            page = own(_in_styles(page, as_styles(own.base)))
    return page


def as_styles(styles: Sequence[Style]) -> tuple[str, ...]:
    """Styles without repeats, in the order of application; ValueError as for `styled`."""
    given = [os.fspath(style) for style in styles]
    files = [style for style in given if style.lower().endswith(".toml")]
    for name in given:
        if name not in STYLES and name not in files:
            raise ValueError(f"style is {name!r}; give {', '.join(STYLES)} or a file .toml")
    chosen = tuple(name for name in STYLES if name in given)
    if len(set(chosen) & set(MEDIA)) > 1:
        raise ValueError(f"styles {' and '.join(MEDIA)} both set the size of the page; give one of them")
    return (*chosen, *dict.fromkeys(files))


@dataclass(frozen=True)
class StyledDraw:
    """A picklable function that draws pages with the same arguments as `draw`, in other styles."""

    draw: Callable[..., Any]
    styles: tuple[Style, ...]

    def __post_init__(self) -> None:
        as_styles(self.styles)

    def __call__(self, *arguments: Any) -> Page:
        """The page returned by `draw`, in the styles; TypeError if it returns pixels."""
        page = self.draw(*arguments)
        if not isinstance(page, Page):
            raise TypeError(f"draw gives {type(page).__name__}, which cannot be styled; let it return a Page")
        return styled(page, *self.styles)
