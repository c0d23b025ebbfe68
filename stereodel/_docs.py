"""Docstrings of families: what several objects have in common is written once and put into each when it is defined."""

from __future__ import annotations

import re
from collections.abc import Callable
from inspect import cleandoc
from textwrap import indent
from typing import TypeVar

_T = TypeVar("_T")
_LINE = re.compile(r"^( *)\{(\w+)\}$", re.MULTILINE)


def shared(**parts: str) -> Callable[[_T], _T]:
    """Decorate a class or function: in its docstring a line ``{name}`` becomes the text of that name, indented alike.

    A text may itself use those before it.

    Examples
    --------
    >>> @shared(unit="In metres.")
    ... def depth(place):
    ...     '''Of the sea.
    ...
    ...     {unit}
    ...     '''
    >>> print(depth.__doc__)
    Of the sea.
    <BLANKLINE>
    In metres.
    """
    texts: dict[str, str] = {}

    def filled(text: str) -> str:
        return _LINE.sub(lambda line: indent(texts[line[2]], line[1]), cleandoc(text))

    def fill(target: _T) -> _T:
        if target.__doc__ is not None:  # as under `python -OO`
            target.__doc__ = filled(target.__doc__)
        return target

    for name, text in parts.items():
        texts[name] = filled(text)

    return fill
