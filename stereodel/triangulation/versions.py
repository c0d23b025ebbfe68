"""Objects that change while several threads hold them: what they were at a moment is a version, which never changes.

What a user holds refers to a version: an object of the same class that stands for one state. A query takes the version
once and asks nothing else, so it never mixes two. A change makes a new version and puts it in the place of the old one.
Queries take no lock; they look whether somebody else has it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Generic, Never, NoReturn, Self, TypeVar, cast, overload

_T = TypeVar("_T")


class Versioned:
    """An object with versions.

    Subclasses make their first version and `_hold` it, change things by ``with self._change(): self._put(...)``, and
    begin each query with ``self._present()``. What follows from a version is a `kept` property.
    """

    _version: Self | None = None  # None: this is a version itself
    _turn: threading.Lock  # held by who makes a change; versions have none

    def _hold(self, version: Self) -> None:
        """Set the first version."""
        self._turn = threading.Lock()
        self._version = version

    def _present(self) -> Self:
        """The version to ask."""
        if self._version is not None and self._turn.locked():
            raise _in_change()
        return self._latest()

    def _latest(self) -> Self:
        """The version, in a change too."""
        version = self._version
        return version if version is not None else self

    @contextmanager
    def _change(self) -> Iterator[None]:
        """Keep other threads out; refuse if one of them is making a change."""
        if not self._turn.acquire(blocking=False):
            raise _in_change()
        try:
            yield
        finally:
            self._turn.release()

    def _put(self, version: Self) -> None:
        """Make `version` the present one."""
        self._version = version

    def __copy__(self) -> Self:
        """An object of its own that shares the present version."""
        twin = type(self).__new__(type(self))
        twin.__dict__.update(self.__dict__)
        twin._hold(self._present())
        return twin


def _in_change() -> RuntimeError:
    return RuntimeError(
        "another thread is changing this triangulation; let one wait for the other by a lock, or query a copy"
    )


class kept(Generic[_T]):  # noqa: N801  # a decorator, like `property`
    """A read-only property that is computed once for a version and kept with it."""

    def __init__(self, compute: Callable[[Any], _T]) -> None:
        self._compute = compute
        self._name = compute.__name__
        self.__doc__ = compute.__doc__

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: Versioned, owner: type) -> _T: ...
    def __get__(self, instance: Versioned | None, owner: type) -> Self | _T:
        if instance is None:
            return self
        version = instance._present()
        values = version.__dict__
        if self._name not in values:
            # One step, whatever other threads do: the first that comes decides what all have from then on.
            values.setdefault(self._name, self._compute(version))
        return cast(_T, values[self._name])

    def __set__(self, instance: Versioned, value: Never) -> NoReturn:
        raise AttributeError(f"{self._name} cannot be set")
