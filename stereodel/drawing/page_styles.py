"""Styles of pages: for a column, for a slide, on a dark background. A style turns a page into another page."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from stereodel.drawing.dark import dark_page
from stereodel.drawing.fonts import FontLike, as_font, in_font
from stereodel.drawing.ground import haloed
from stereodel.drawing.media import COLUMN, SLIDE, page_for
from stereodel.drawing.page import Page
from stereodel.drawing.style_files import PageStyle

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
