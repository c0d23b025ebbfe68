"""Styles of pages: for a column, for a slide, on a dark background. A style makes a page from a page."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from stereodel.drawing.dark import dark_page
from stereodel.drawing.fonts import FontLike, as_font, in_font
from stereodel.drawing.media import COLUMN, SLIDE, page_for
from stereodel.drawing.page import Page
from stereodel.drawing.style_files import PageStyle

STYLES: Final[Mapping[str, Callable[[Page], Page]]] = {
    "column": lambda page: page_for(page, COLUMN),
    "slide": lambda page: page_for(page, SLIDE),
    "dark": dark_page,
}
"""Name → what makes a page of that style."""

MEDIA: Final = ("column", "slide")
"""Of which a page can be for one."""


Style = str | os.PathLike[str]
"""The name of a style, or a file that holds one."""


def styled(page: Page, *styles: Style, font: FontLike | None = None) -> Page:
    """The same picture in another style, or in several.

    Parameters
    ----------
    page : Page
    *styles : {"column", "slide", "dark"} or path-like
        "column": 8.4 cm wide, for a journal column; text is not smaller than 7 points. "slide": 33.87 × 19.05 cm,
        16 : 9, with heavier lines and larger text, the picture in the middle. "dark": on a dark background, where each
        colour keeps its hue and its contrast; a page that is dark already is unchanged, and so are images made of
        pixels, such as rasters on a globe. The order does not matter.
        A TOML file sets colours, widths and sizes by the names of what is drawn; files come last, in their order.
    font : str, path-like, or sequence of them, optional
        Families of the type, or files of fonts, see `stereodel.drawing.fonts.as_font`, for labels that have none of
        their own: what is 17 cm wide in a serif for a book may be in a sans serif on a slide.

    Returns
    -------
    Page

    Raises
    ------
    FileNotFoundError
        For the file of a font that is not there.
    ValueError
        For another style, for a column and a slide at once, for a file that holds no style, and for fonts that the
        machine does not have.

    Notes
    -----
    In a column and on a slide, text is placed again: above and below the picture it is broken into lines, and the page
    grows; in the picture it moves aside where it would cover other text, and what does not fit is omitted, as on
    maps.

    Examples
    --------
    >>> from stereodel.drawing import Sketch
    >>> page = Sketch().add_circle((0, 0), 1, name="circle").page((-2, 2, -1, 1))
    >>> slide = styled(page, "slide", "dark")
    >>> [round(2.54 * side / 72, 2) for side in (slide.width, slide.height)], round(slide.background[0], 2)
    ([33.87, 19.05], 0.07)
    """
    page = in_font(page, as_font(font))
    for style in as_styles(styles):
        if style in STYLES:
            page = STYLES[style](page)
        else:
            own = PageStyle.of_file(style)
            page = own(styled(page, *own.base))
    return page


def as_styles(styles: Sequence[Style]) -> tuple[str, ...]:
    """Styles, each once and in the order in which they are applied; a ValueError for what `styled` refuses."""
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
    """What draws pages, in other styles: a function of the same arguments, which can be sent to other processes."""

    draw: Callable[..., Any]
    styles: tuple[Style, ...]

    def __post_init__(self) -> None:
        as_styles(self.styles)

    def __call__(self, *arguments: Any) -> Page:
        """The page that `draw` gives, in the styles; a TypeError where it gives pixels."""
        page = self.draw(*arguments)
        if not isinstance(page, Page):
            raise TypeError(f"draw gives {type(page).__name__}, which cannot be styled; let it return a Page")
        return styled(page, *self.styles)
