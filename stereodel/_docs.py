"""Decorators of what is public: docstrings that share parts, and calls whose message says what to write instead."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import wraps
from inspect import cleandoc, signature
from textwrap import indent
from typing import ParamSpec, TypeVar

_P = ParamSpec("_P")
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


def by_name(advice: str) -> Callable[[Callable[_P, _T]], Callable[_P, _T]]:
    """Decorate a function whose options are often given by position; the message of a TypeError ends with `advice`.

    Examples
    --------
    >>> @by_name("magnification= is a keyword")
    ... def lens(focus, *, magnification): ...
    >>> lens((10, 50), 4)
    Traceback (most recent call last):
        ...
    TypeError: lens() takes 1 argument by position, got 2; magnification= is a keyword
    """

    def decorated(function: Callable[_P, _T]) -> Callable[_P, _T]:
        parameters = signature(function).parameters.values()
        positional = [p for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)]
        limit, own = len(positional), int(positional[0].name in ("self", "cls"))

        @wraps(function)
        def called(*args: _P.args, **options: _P.kwargs) -> _T:
            if len(args) > limit:
                expected, given = limit - own, len(args) - own
                raise TypeError(
                    f"{function.__name__}() takes {expected} argument{'s' if expected > 1 else ''} by position, "
                    f"got {given}; {advice}"
                )
            return function(*args, **options)

        return called

    return decorated
