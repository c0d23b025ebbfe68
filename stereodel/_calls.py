"""Calls with more arguments by position than there are: the message says what to write instead."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import ParamSpec, TypeVar

_P = ParamSpec("_P")
_T = TypeVar("_T")


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
