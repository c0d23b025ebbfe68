"""Style sheets: a page on a dark background, or in the colours, widths and sizes of a TOML file.

On a dark background colours keep their hue and the contrast that they have on white: a luminance Y becomes Y' with
(Y' + 0.05)(Y + 0.05) = (G + 0.05)(1 + 0.05), where G is that of the background, so the contrast of any two is
unchanged. A file identifies the parts of a page by their names, which are ids in SVG: "ball", "land", "coast" ….
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray, as_scalar
from stereodel.drawing.page.colors import FLARE, Color, as_color, contrast, luminance, with_luminance
from stereodel.drawing.page.fonts import FontLike, as_font, filled
from stereodel.drawing.page.items import LEGEND, Item, Label
from stereodel.drawing.page.labels import haloed
from stereodel.drawing.page.page import Page
from stereodel.drawing.page.style import BLACK, WHITE, as_length

DARK: Final = "dark"
"""The style that has a name; all others are files."""

Style = str | os.PathLike[str]
"""The name of a style, or a style file."""


def styled(page: Page, *styles: Style, font: FontLike | None = None) -> Page:
    """The same picture in another style, or in several.

    Parameters
    ----------
    page : Page
    *styles : "dark" or path-like
        "dark": on a dark background, where each colour keeps its hue and its contrast; a page that is dark already is
        unchanged, and so are images made of pixels, such as rasters on a globe.
        A TOML file sets colours, widths and sizes by the names of what is drawn; files are applied after "dark", in
        order.
    font : str, path-like, or sequence of them, optional
        Font families or font files, see `stereodel.drawing.page.fonts.as_font`, for labels without a font of their own.

    Returns
    -------
    Page

    Raises
    ------
    FileNotFoundError
        If a font file does not exist.
    ValueError
        If a style is unknown, a file is not a style, or a font family is not installed.

    Notes
    -----
    Halos of a globe's labels without a colour of their own have that of the ground in the new style.

    Examples
    --------
    >>> from stereodel.drawing import Sketch
    >>> page = Sketch().add_circle((0, 0), 1, name="circle").page((-2, 2, -1, 1))
    >>> [round(part, 2) for part in styled(page, "dark").background]
    [0.07, 0.07, 0.07, 1.0]
    """
    if own := as_font(font):
        items = (replace(item, font=filled(item.font, own)) if isinstance(item, Label) else item for item in page.items)
        page = replace(page, items=tuple(items))
    for style in as_styles(styles):
        page = dark_page(page) if style == DARK else StyleSheet.of_file(style)(page)
    return haloed(page) if styles else page


def as_styles(styles: Sequence[Style]) -> tuple[str, ...]:
    """Styles without repeats, in the order of application; ValueError as for `styled`."""
    given = dict.fromkeys(os.fspath(style) for style in styles)
    for name in given:
        if name != DARK and not name.lower().endswith(".toml"):
            raise ValueError(f"style is {name!r}; give {DARK} or a file .toml")
    return tuple(sorted(given, key=lambda name: name != DARK))


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


GROUND: Final[Color] = (0.07, 0.07, 0.07, 1.0)
"""The dark background. White has contrast 18.7 on it, against 21 of black on white; lower contrasts are kept."""


def dark_page(page: Page) -> Page:
    """A page on a dark background; one that is already dark is unchanged, as are the pixels of images."""
    ground = dark_color((*page.background[:3], 1.0))
    if contrast(page.background[:3], WHITE[:3]) > contrast(page.background[:3], BLACK[:3]):
        return page
    return replace(page, background=ground, items=tuple(item.recoloured(dark_colors) for item in page.items))


def dark_color(color: Color) -> Color:
    """The dark counterpart of a colour on white."""
    return as_color(dark_colors(np.array([color]))[0])


def dark_colors(colors: FloatArray) -> FloatArray:
    """The dark counterparts (n, 4) of colours (n, 4) on white; opacity is unchanged."""
    # A transparent colour on the dark background equals the counterpart of what it is on white, as far as one exists.
    several, which = np.unique(colors, axis=0, return_inverse=True)
    opacity = several[:, 3:]
    over_white = 1 - opacity * (1 - several[:, :3])
    ground = luminance(GROUND[:3]) + FLARE
    target = ground * (1 + FLARE) / (luminance(over_white) + FLARE) - FLARE
    seen = with_luminance(over_white, np.clip(target, 0.0, 1.0))
    own = (seen - (1 - opacity) * np.array(GROUND[:3])) / np.where(opacity > 0, opacity, 1.0)
    found = np.concatenate([np.clip(own, 0.0, 1.0), opacity], axis=1)
    return np.asarray(found[which.ravel()])


Changes = Mapping[str, Any]
"""New values for fields of an item."""


def _width(value: Any, name: str) -> float:
    """A length that may be 0."""
    return as_length(value, name) if isinstance(value, str) else as_scalar(value, name, low=0.0)


READERS: Final[Mapping[str, Mapping[str, Callable[[Any, str], Any]]]] = {
    "fills": {"color": as_color},
    "lines": {"color": as_color, "width": _width},
    "dots": {"color": as_color, "radius": _width, "rim": as_color, "rim_width": _width},
    "labels": {"color": as_color, "font": as_font, "size": as_length, "halo": _width, "halo_color": as_color},
}
"""Tables of a file with their keys, and the function that parses the value of each."""


@dataclass(frozen=True)
class StyleSheet:
    """Colours, widths and sizes of the parts of a page, by name; other parts are unchanged.

    background: its colour; None leaves it.
    looks: what changes, by table and name; of labels all alike, under "". Regions with several colours keep them.
    """

    background: Color | None
    looks: Mapping[str, Mapping[str, Changes]]

    @classmethod
    def of_file(cls, path: str | os.PathLike[str]) -> StyleSheet:
        """The style in a TOML file; ValueError, naming file and key, if it is not TOML or a key or value is invalid."""
        source = Path(path)
        try:
            table = tomllib.loads(source.read_text(encoding="utf-8"))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise ValueError(f"{source}: is not TOML: {error}") from error
        try:
            _known(table, ("background", *READERS), "")
            ground = as_color(table["background"], "background") if "background" in table else None
            looks = {kind: _parts(table, kind) for kind in READERS}
        except (ValueError, TypeError) as error:
            raise ValueError(f"{source}: {error}") from error
        return cls(ground, looks)

    def __call__(self, page: Page) -> Page:
        """A page in this style."""
        background = page.background if self.background is None else self.background
        items = tuple(item.restyled(self._changes(item)) for item in page.items)
        return replace(page, background=background, items=items)

    def _changes(self, item: Item) -> Changes:
        name = "" if item._kind == "labels" else item.name.removeprefix(LEGEND)
        return self.looks.get(item._kind, {}).get(name, {})


def _table(parts: Mapping[str, Any], name: str, within: str = "") -> Mapping[str, Any]:
    found = parts.get(name, {})
    if not isinstance(found, Mapping):
        raise ValueError(f"{within}{name} is {found!r}, but must be a table, such as [{within}{name}]")
    return found


def _parts(table: Mapping[str, Any], kind: str) -> Mapping[str, Changes]:
    """Changes by the names of the parts."""
    given = _table(table, kind)
    if kind == "labels":
        return {"": _read(kind, given, "labels.")}
    if kind == "fills":
        return {name: {"color": as_color(value, f"fills.{name}")} for name, value in given.items()}
    return {name: _read(kind, _table(given, name, f"{kind}."), f"{kind}.{name}.") for name in given}


def _known(given: Mapping[str, Any], keys: Collection[str], within: str) -> None:
    for key in given:
        if key not in keys:
            raise ValueError(f"{within}{key} is not a key of styles; give {', '.join(keys)}")


def _read(kind: str, given: Mapping[str, Any], within: str) -> Changes:
    readers = READERS[kind]
    _known(given, readers, within)
    return {key: readers[key](value, f"{within}{key}") for key, value in given.items()}
