"""Fonts of labels: every character in the first that has it, of those requested, STIX, DejaVu Sans and the system's.

Matplotlib 3.11 or newer shapes scripts that join letters or run from right to left; older versions do not.
"""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, Final, cast
from warnings import catch_warnings, filterwarnings, warn

from stereodel._extras import of_extra
from stereodel.drawing.page.items import Label
from stereodel.drawing.page.style import TYPE

FontLike = str | os.PathLike[str] | Sequence[str | os.PathLike[str]]
"""A family, the path of a font file, or several of them in order of preference; the first may begin with a face."""

FILES: Final = (".ttf", ".otf", ".ttc", ".otc")
"""Extensions of font files."""

SHIPPED: Final = "DejaVu Sans"
"""The font with the most characters among those that matplotlib ships on every machine."""

USUAL: Final = "Noto"
"""System fonts whose names begin so come first: they are designed to go together and cover every script."""

SYMBOLS: Final = re.compile(r"(?i)last ?resort|adobe ?blank|^(cm|stix|dejavu|webdings|wingdings|symbol)")
"""System fonts never used as a fallback: fonts of formulas and symbols, and of placeholder boxes."""

FORMULA: Final = re.compile(r"(?<!\\)\$.*?(?<!\\)\$|\\(?=\$)", re.DOTALL)
"""A formula, or an escaped dollar sign."""

FACES: Final = ("bold", "italic", "bold italic")
"""Faces, alone or before a family; of one that has not all of them, the nearest is used."""

NAMED: Final = 12
"""Largest number of characters that a warning names."""


class MissingCharactersWarning(UserWarning):
    """No font has some characters of a picture, which appear as boxes."""


def as_font(font: FontLike | None, name: str = "font") -> tuple[str, ...]:
    """Names of font families, or paths of .ttf, .otf, .ttc or .otc files, in the form stored in labels: after a face.

    Families that are not installed are skipped, as in browsers, if at least one is. Errors have the argument's `name`.

    >>> as_font("DejaVu Serif"), as_font(["Nowhere", "DejaVu Sans"]), as_font(None)
    (('DejaVu Serif',), ('Nowhere', 'DejaVu Sans'), ())
    >>> as_font("italic"), as_font("bold italic DejaVu Sans")
    (('italic',), ('bold italic', 'DejaVu Sans'))
    """
    if font is None:
        return ()
    try:
        families = tuple(os.fspath(one) for one in ((font,) if isinstance(font, str | os.PathLike) else font))
    except TypeError as error:
        raise TypeError(f"{name} is {font!r}; give a family, the path of a font's file, or several of them") from error
    face = next((face for face in reversed(FACES) if families and f"{families[0]} ".startswith(f"{face} ")), "")
    if face:
        families = (*filter(None, [families[0][len(face) + 1 :]]), *families[1:])
    if families and not any(_file(family) for family in families):
        raise ValueError(
            f"{name} is {', '.join(map(repr, families))}, which this machine does not have; give a family "
            "that matplotlib.font_manager.get_font_names() lists, or the path of a .ttf or .otf file"
        )
    return (face, *families) if face else families


def face_of(font: tuple[str, ...]) -> str:
    """Its face, or "" for upright type of normal weight."""
    return font[0] if font and font[0] in FACES else ""


def filled(font: tuple[str, ...], other: tuple[str, ...]) -> tuple[str, ...]:
    """The font, or without families the same face of another, or without anything the other."""
    return (*font, *other[bool(face_of(other)) :]) if font == (face_of(font),) else font or other


def families_of(label: Label) -> list[str]:
    """The families in which a label is set, in matplotlib's form: each character uses the first that has it."""
    return list(_families(*set_text(label), label.font)[0])


def set_text(label: Label) -> tuple[str, bool]:
    """The text of a label as it is set, and whether there are formulas in it: an even number of dollar signs."""
    if not label.formulas:
        return label.text, False
    dollars = label.text.count("$") - label.text.count(r"\$")
    math = dollars > 0 and dollars % 2 == 0
    return (label.text if math else label.text.replace(r"\$", "$")), math


def font_properties(families: Iterable[str], size: float, face: str = "") -> Any:
    """Matplotlib's font properties of type of a size in points, independent of the user's settings."""
    with of_extra("draw"):
        from matplotlib.font_manager import FontProperties

    style, weight = (word if word in face else "normal" for word in ("italic", "bold"))
    look: dict[str, Any] = {"style": style, "variant": "normal", "weight": weight, "stretch": "normal"}
    return FontProperties(family=list(families), size=size, **look)


@contextmanager
def quiet_fonts() -> Iterator[None]:
    """Suppress matplotlib's warning for each missing character; `warn_of_missing` gives one for all."""
    with catch_warnings():
        filterwarnings("ignore", message=r"Glyph \d+ .* missing from font")
        yield


def missing_characters(labels: Iterable[Label]) -> frozenset[str]:
    """The characters of labels that no font has."""
    return frozenset().union(*(_families(*set_text(label), label.font)[1] for label in labels))


def warn_of_missing(characters: Iterable[str]) -> None:
    """Give one `MissingCharactersWarning` that names the missing characters, if any."""
    missing = [f"{sign} (U+{ord(sign):04X} {unicodedata.name(sign, 'without a name')})" for sign in sorted(characters)]
    if missing:
        more = f" and {len(missing) - NAMED} more" if len(missing) > NAMED else ""
        told = (
            f"no font here has {', '.join(missing[:NAMED])}{more}; boxes stand in their place: install a font that has "
            "them (those called Noto have most), or name its file with font="
        )
        warn(told, MissingCharactersWarning, stacklevel=2)


@lru_cache(maxsize=4096)
def _families(text: str, math: bool, font: tuple[str, ...]) -> tuple[tuple[str, ...], frozenset[str]]:
    """Families in which a text is set, and the visible characters that none of them has."""
    face = face_of(font)
    chosen = [family for family in font[bool(face) :] if _file(family)] + [str(TYPE["font.family"])]
    signs = set(FORMULA.sub("", text) if math else text)
    left = {a for a in signs if unicodedata.category(a) not in {"Cc", "Cf"} and not "\ufe00" <= a <= "\ufe0f"}
    for family in chosen[:1] if math else chosen:  # matplotlib sets text next to a formula in one font
        left -= _had(family, left, face)
    others = [] if math or not left else [SHIPPED, *_others()]
    for family in sorted(others, key=lambda family: -len(_had(family, left, face))):  # those with most of them first
        found = _had(family, left, face)
        left -= found
        chosen += [family] if found else []
    return tuple(chosen), frozenset(left)


def _others() -> list[str]:
    """The other families of the system, in order of preference."""
    names = {entry.name for entry in _manager().ttflist}
    usable = (family for family in names if not SYMBOLS.search(family) and not family.startswith("."))
    return sorted(usable, key=lambda family: (not family.startswith(USUAL), family))


def _had(family: str, signs: set[str], face: str) -> set[str]:
    """The characters of `signs` that a face of a family has."""
    font = _font(family, face)
    return {sign for sign in signs if font is not None and font.get_char_index(ord(sign))}


@cache
def _font(family: str, face: str) -> Any:
    """The font of a family; None if it has no outlines or cannot be read."""
    with of_extra("draw"):
        from matplotlib.ft2font import FT2Font

    path: Any = _file(family, face)
    if path is None:
        return None
    number = getattr(path, "face_index", 0)  # in a collection, which matplotlib reads since 3.11
    try:
        font = cast(Any, FT2Font)(path, **({"face_index": number} if number else {}))
    except (OSError, RuntimeError):
        return None
    return font if font.scalable else None


@cache
def _file(family: str, face: str = "") -> str | None:
    """The file of a family as found by matplotlib, or the named file; None if there is none."""
    if family.lower().endswith(FILES):
        _take_up(family)
    try:
        return _manager().findfont(font_properties([family], 10.0, face), fallback_to_default=False)
    except ValueError:
        return None


def _take_up(path: str) -> None:
    """Register a font file with matplotlib as a family named by its path."""
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
