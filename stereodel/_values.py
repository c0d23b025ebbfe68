"""Values that hold arrays, which have no truth of their own."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Hashable


class Keyed(ABC):
    """Values of a class, equal exactly where their keys are."""

    @property
    @abstractmethod
    def _key(self) -> Hashable:
        """What tells values apart."""

    def __eq__(self, other: object) -> bool:
        return self._key == other._key if isinstance(other, type(self)) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._key)
