"""Fonts of labels: those that are asked for, STIX, and for characters that these lack what else there is.

Every character is set in the first font that has it, of the families that a label names, STIX, which matplotlib ships,
and where these do not do, DejaVu Sans, which it ships too, and the other fonts of the machine. Matplotlib 3.11 or newer
joins letters and sets words from right to left where their script asks for it; older ones do not.
"""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from difflib import get_close_matches
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, Final
from warnings import catch_warnings, filterwarnings, warn

from stereodel._extras import of_extra
from stereodel.drawing.page import Label, Page
from stereodel.drawing.style import TYPE

FontLike = str | os.PathLike[str] | Sequence[str | os.PathLike[str]]
"""A family, the path of a font's file, or several of them, the first of which matters most."""

FILES: Final = (".ttf", ".otf", ".ttc", ".otc")
"""Endings of the files of fonts."""

SHIPPED: Final = "DejaVu Sans"
"""The font with the most characters of those that matplotlib ships: it is there on every machine."""

USUAL: Final = "Noto"
"""Fonts of the machine that begin so come first: they are made to go together, and there is one for every script."""

SYMBOLS: Final = re.compile(r"(?i)last ?resort|adobe ?blank|^(cm|stix|dejavu|webdings|wingdings|symbol)")
"""Fonts of the machine that stand in for nothing: those of formulas and signs, and those of boxes for characters."""

FORMULA: Final = re.compile(r"(?<!\\)\$.*?(?<!\\)\$|\\(?=\$)", re.DOTALL)
"""A formula, or what makes of a dollar sign a dollar."""

NAMED: Final = 12
"""Characters that a warning names, at most."""


class MissingCharactersWarning(UserWarning):
    """No font has some characters of a picture, and boxes stand in their place."""


def as_font(font: FontLike | None, name: str = "font") -> tuple[str, ...]:
    """Families and files of fonts, as a label holds them.

    Parameters
    ----------
    font : str, path-like, or sequence of them, optional
        Names of families, or paths of files ending in .ttf, .otf, .ttc or .otc. Families that the machine does not have
        are passed over, as browsers do, if there is one that it has.
    name : str
        By which messages call it.

    Raises
    ------
    FileNotFoundError
        For the path of a file that is not there.
    TypeError
        For what is neither text nor path.
    ValueError
        For a file that is no font, and where no family is known here.

    Examples
    --------
    >>> as_font("DejaVu Serif"), as_font(["Nowhere", "DejaVu Sans"]), as_font(None)
    (('DejaVu Serif',), ('Nowhere', 'DejaVu Sans'), ())
    """
    if font is None:
        return ()
    try:
        families = tuple(os.fspath(one) for one in ((font,) if isinstance(font, str | os.PathLike) else font))
    except TypeError as error:
        raise TypeError(f"{name} is {font!r}; give a family, the path of a font's file, or several of them") from error
    if families and not any(_file(family) for family in families):
        known = sorted({entry.name for entry in _manager().ttflist})
        close = [match for family in families for match in get_close_matches(family, known)]
        similar = f" (similar: {', '.join(dict.fromkeys(close))})" if close else ""
        raise ValueError(
            f"{name} is {', '.join(map(repr, families))}, which this machine does not have{similar}; give a family "
            "that matplotlib.font_manager.get_font_names() lists, or the path of a .ttf or .otf file"
        )
    return families


def in_font(page: Page, font: tuple[str, ...]) -> Page:
    """A page whose labels are in a font, but for those that name one of their own."""
    if not font:
        return page
    items = (replace(item, font=font) if isinstance(item, Label) and not item.font else item for item in page.items)
    return replace(page, items=tuple(items))


def families_of(label: Label) -> list[str]:
    """The families in which a label is set, as matplotlib takes them: for each character the first that has it."""
    return list(_families(*set_text(label), label.font)[0])


def set_text(label: Label) -> tuple[str, bool]:
    r"""The text of a label as it is set, and whether there are formulas in it: an even number of dollar signs.

    Examples
    --------
    >>> set_text(Label("$x$", (0, 0))), set_text(Label("$5", (0, 0))), set_text(Label("$x$", (0, 0), formulas=False))
    (('$x$', True), ('$5', False), ('$x$', False))
    """
    if not label.formulas:
        return label.text, False
    dollars = label.text.count("$") - label.text.count(r"\$")
    math = dollars > 0 and dollars % 2 == 0
    return (label.text if math else label.text.replace(r"\$", "$")), math


def font_properties(label: Label) -> Any:
    """The type of a label as matplotlib describes it, whatever the user has set."""
    with of_extra("draw"):
        from matplotlib.font_manager import FontProperties

    return FontProperties(
        family=families_of(label), style="normal", variant="normal", weight="normal", stretch="normal", size=label.size
    )


@contextmanager
def quiet_fonts() -> Iterator[None]:
    """Without matplotlib's warning for each character that no font has: `warn_of_missing` gives one for all."""
    with catch_warnings():
        filterwarnings("ignore", message=r"Glyph \d+ .* missing from font")
        yield


def missing_characters(labels: Iterable[Label]) -> frozenset[str]:
    """The characters of labels that no font has."""
    return frozenset().union(*(_families(*set_text(label), label.font)[1] for label in labels))


def warn_of_missing(characters: Iterable[str]) -> None:
    """One `MissingCharactersWarning` that names characters which no font has, if there are any."""
    missing = sorted(characters)
    if missing:
        told = ", ".join(
            f"{sign} (U+{ord(sign):04X} {unicodedata.name(sign, 'without a name')})" for sign in missing[:NAMED]
        )
        more = f" and {len(missing) - NAMED} more" if len(missing) > NAMED else ""
        warn(
            f"no font here has {told}{more}; boxes stand in their place: install a font that has them (those called "
            "Noto have most), or name its file with font=",
            MissingCharactersWarning,
            stacklevel=2,
        )


@lru_cache(maxsize=4096)
def _families(text: str, math: bool, font: tuple[str, ...]) -> tuple[tuple[str, ...], frozenset[str]]:
    """Families in which a text is set, and the characters that none of them has."""
    chosen = [family for family in font if _file(family)] + [str(TYPE["font.family"])]
    if math:  # matplotlib sets the words beside a formula in one font
        return tuple(chosen), _lacking(frozenset(FORMULA.sub("", text)), chosen[:1])
    missing = _lacking(frozenset(text), chosen)
    if missing:
        more = _supplements(missing)
        chosen, missing = chosen + list(more), _lacking(missing, more)
    return tuple(chosen), missing


def _lacking(text: frozenset[str], families: Iterable[str]) -> frozenset[str]:
    """The characters of a text that are to be seen and that no family has."""
    lacking = {
        sign for sign in text if unicodedata.category(sign) not in {"Cc", "Cf"} and not "\ufe00" <= sign <= "\ufe0f"
    }
    for family in families:
        if lacking:
            lacking -= _had(family, lacking)
    return frozenset(lacking)


@lru_cache(maxsize=256)
def _supplements(missing: frozenset[str]) -> tuple[str, ...]:
    """As few other families as have characters that can be had."""
    chosen, left = [], set(missing)
    others = [SHIPPED, *_others()]
    while left:
        most = max(others, key=lambda family: len(_had(family, left)))  # the first of several
        found = _had(most, left)
        if not found:
            break
        chosen.append(most)
        left -= found
    return tuple(chosen)


def _others() -> list[str]:
    """The other families of the machine, in the order in which they are asked."""
    names = {entry.name for entry in _manager().ttflist}
    usable = (family for family in names if not SYMBOLS.search(family) and not family.startswith("."))
    return sorted(usable, key=lambda family: (not family.startswith(USUAL), family))


def _had(family: str, signs: set[str]) -> set[str]:
    """Those of some characters that a family has."""
    face = _face(family)
    return {sign for sign in signs if face is not None and face.get_char_index(ord(sign))}


@cache
def _face(family: str) -> Any:
    """The font of a family; None where it has no outlines, or cannot be read."""
    with of_extra("draw"):
        from matplotlib.ft2font import FT2Font

    path: Any = _file(family)
    if path is None:
        return None
    number = getattr(path, "face_index", 0)  # in a collection, which matplotlib reads since 3.11
    try:
        open_font: Any = FT2Font
        face = open_font(path, **({"face_index": number} if number else {}))
    except (OSError, RuntimeError):
        return None
    return face if face.scalable else None


@cache
def _file(family: str) -> str | None:
    """The upright file of a family, as matplotlib finds it, or the file that is named; None where there is none."""
    with of_extra("draw"):
        from matplotlib.font_manager import FontProperties

    if family.lower().endswith(FILES):
        _take_up(family)
    upright = FontProperties(family=[family], style="normal", variant="normal", weight="normal", stretch="normal")
    try:
        return _manager().findfont(upright, fallback_to_default=False)
    except ValueError:
        return None


def _take_up(path: str) -> None:
    """Let matplotlib know a font's file, as a family by the name of its path, of which it has one."""
    if not Path(path).is_file():
        raise FileNotFoundError(f"font {path} is not there; give the path of a .ttf or .otf file, or a family")
    manager = _manager()
    if any(entry.name == path for entry in manager.ttflist):
        return
    before = len(manager.ttflist)
    try:
        manager.addfont(path)
    except (OSError, RuntimeError) as error:
        raise ValueError(f"font {path} is not a font that can be read: {error}") from error
    first = replace(manager.ttflist[before], name=path, style="normal", variant="normal", weight=400, stretch="normal")
    manager.ttflist[before:] = [first]


def _manager() -> Any:
    with of_extra("draw"):
        from matplotlib.font_manager import fontManager

    return fontManager
