"""What a notebook shows of an object: a picture, a table or a film, bounded in bytes and time; and a short `repr`.

A class derives from `Displayed` and says in `_mimes` what shows it, or which module enters that there when loaded, so
that nothing here or below knows what draws. No output has a script.
"""

from __future__ import annotations

import re
import sys
import tempfile
import time
from base64 import b64encode
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass, replace
from hashlib import sha256
from html import escape
from importlib import import_module
from pathlib import Path
from reprlib import Repr
from typing import Any, ClassVar

import numpy as np

from stereodel.constants import (
    MOST_FRAME_PIXELS,
    MOST_SHOWN_BYTES,
    MOST_SHOWN_NUMBERS,
    MOST_SHOWN_SECONDS,
    SHOWN_PIXELS,
    SHOWN_TABLE,
)

Mimes = tuple[dict[str, str], dict[str, dict[str, int]]]
"""Data by MIME type, and how large pictures are shown."""


class Brief(Repr):
    """Arrays by shape and type, objects that hold more by their class."""

    def repr_ndarray(self, array: Any, level: int) -> str:
        return str(array.tolist()) if array.size <= self.maxlist else f"{array.shape} {array.dtype}"

    repr_mappingproxy = Repr.repr_dict

    def repr_instance(self, value: object, level: int) -> str:
        if is_dataclass(value) or isinstance(value, Displayed):
            return f"{type(value).__name__}(…)"
        return getattr(value, "__qualname__", "") or super().repr_instance(value, level)


class Displayed:
    """Has a `repr` of one line unless it writes its own, and is shown in notebooks by what `_mimes` makes of it."""

    _mimes: ClassVar[Any] = staticmethod(lambda: ({}, {}))

    def __init_subclass__(cls, **given: Any) -> None:
        super().__init_subclass__(**given)
        if cls.__repr__ is Displayed.__repr__:
            cls.__repr__ = Displayed.__repr__  # type: ignore[method-assign]  # or a dataclass would write another

    def __repr__(self) -> str:
        names = [each.name for each in fields(self)] if is_dataclass(self) else vars(self)
        parts = (f"{name}={Brief().repr(getattr(self, name))}" for name in names if not name.startswith("_"))
        return f"{type(self).__name__}({', '.join(parts)})"

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> Mimes:
        shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
        if shell is not None and "image/png" not in shell.display_formatter.active_types:
            return {}, {}  # IPython on a terminal asks, too, but shows nothing but text
        try:
            if isinstance(self._mimes, str):
                import_module(self._mimes)
            mimes: Mimes = self._mimes()
        except (ImportError, OSError, OverflowError) as error:  # OSError: there is no OpenGL
            return {"text/plain": f"{self!r}: not drawn here, as {error}"}, {}
        return mimes


def drawn(page_of: Callable[[Any], Any], most: int | None = None) -> Callable[[Any], Mimes]:
    """Displayed as a page: SVG, or PNG where that would be too long; nothing of more than `most` points."""

    def made(it: Any) -> Mimes:
        if most is not None and len(it.points) > most:
            raise OverflowError(f"{len(it.points)} points are more than {most}; `diagram_page` draws any number")
        if _numbers(it) > 16 * MOST_SHOWN_NUMBERS or _numbers(page := page_of(it)) > MOST_SHOWN_NUMBERS:
            raise OverflowError(f"it has more than {MOST_SHOWN_NUMBERS} coordinates; `save` draws any number")
        wide = round(min(page.width / 72 * 96, SHOWN_PIXELS * min(1.0, page.width / page.height))) or 1
        shown = {"width": wide, "height": page.pixels_up(wide)}
        svg = _saved(page, "page.svg") if 4 * _numbers(page) <= MOST_SHOWN_BYTES else b""  # it has more than 4 for each
        if 0 < len(svg) <= MOST_SHOWN_BYTES:
            sides = 'width="{width}" height="{height}"'.format(**shown)
            return {"image/svg+xml": re.sub('width="[^"]+" height="[^"]+"', sides, _alone(svg.decode()), count=1)}, {}
        shaded = page.pictured or any(type(it).__name__ == "Ball" or getattr(it, "ball", None) for it in page.items)
        size, renderer = 2 * wide, "gl" if shaded else "agg"
        while len(png := _saved(page, "page.png", size=size, renderer=renderer)) > MOST_SHOWN_BYTES:
            size //= 2
        return {"image/png": b64encode(png).decode()}, {"image/png": shown}

    return made


def _saved(it: Any, name: str, **options: Any) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        return bytes(it.save(Path(folder, name), **options).read_bytes())


def _numbers(value: Any) -> int:
    """How many coordinates an object and its parts have: what drawing it takes time for."""
    if isinstance(value, np.ndarray):
        return value.size * (value.dtype.kind == "f")
    held = vars(value).values() if is_dataclass(value) or isinstance(value, Displayed) else value
    return sum(map(_numbers, held)) if held is not value or isinstance(value, list | tuple) else 0


def _alone(svg: str) -> str:
    """An SVG whose ids and classes no other of the same document has: VS Code puts all into one."""
    mark = f"s{sha256(svg.encode()).hexdigest()[:8]}-"
    names = re.compile(r'(?<= id=")|(?<=url\(#)|(?<=href="#)|(?<=labelledby=")|(?<= )(?=desc")')
    # Within tags and style sheets alone: text stays as it is.
    return re.sub(r"<style>.*?</style>|<[^>]*>", lambda tag: names.sub(mark, tag[0]), svg, flags=re.DOTALL)


def playing(film: Any) -> Mimes:
    """A film in a video element, or its first frame where drawing all would take too long."""
    shot, frames, start, video = replace(film, size=min(film.size, SHOWN_PIXELS)), [], 0.0, b""
    for number in range(len(film)):
        frames.append(shot.picture(number))
        start = start or time.monotonic()  # the first frame loads what draws
        spent = (time.monotonic() - start) / max(number, 1) * len(film)
        pixels = frames[0].size // 3 * len(film)  # of which so many take as long
        if spent > MOST_SHOWN_SECONDS or pixels > MOST_FRAME_PIXELS:
            break
    first, wide = frames[0], min(frames[0].shape[1], SHOWN_PIXELS)
    if len(frames) == len(film):
        video = _saved(film.of_pictures(frames, seconds=film.times.tolist()), "film.mp4", progress=False)
    while len(png := _saved(film.of_pictures([first]), "first.png", progress=False)) > MOST_SHOWN_BYTES:
        first = first[::2, ::2].copy()
    poster = f"data:image/png;base64,{b64encode(png).decode()}"
    if 0 < len(video) <= 4 * MOST_SHOWN_BYTES:
        source = f'poster="{poster}" src="data:video/mp4;base64,{b64encode(video).decode()}"'
        return {"text/html": f'<video controls loop muted playsinline width="{wide}" {source}></video>'}, {}
    said = f"The first of {len(film)} frames, {film.duration:g} s; <code>save</code> writes them all."
    return {"text/html": f'<img width="{wide}" alt="First frame" src="{poster}"><p>{said}</p>'}, {}


def tabular(count: Callable[[Any], int], take: Callable[[Any, Any], Mapping[str, Any]]) -> Callable[[Any], Mimes]:
    """Displayed as a table of `count(it)` rows, of which `take(it, numbers)` gives columns: the first and last rows."""
    most, broad, letters = SHOWN_TABLE

    def row(cells: Any, kind: str) -> str:
        texts = [f"{cell:.9g}" if isinstance(cell, float) else str(cell) for cell in cells]
        short = [text if len(text) <= letters else f"{text[: letters - 1]}…" for text in texts]
        return "<tr>" + "".join(f"<{kind}>{escape(text)}</{kind}>" for text in short) + "</tr>"

    def made(it: Any) -> Mimes:
        total = count(it)
        columns = take(it, np.arange(total) if total <= most else np.r_[: most // 2, total - most // 2 : total])
        names = list(columns)[:broad]
        body = [row(cells, "td") for cells in zip(*(columns[name] for name in names), strict=True)]
        if total > most:
            body.insert(most // 2, row("…" * len(names), "td"))
        table = f'<table border="1" class="dataframe">{row(names, "th")}{"".join(body)}</table>'
        return {"text/html": f"{table}<p>{total} rows × {len(columns)} columns</p>"}, {}

    return made
