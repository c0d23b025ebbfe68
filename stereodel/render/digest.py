"""Digests of pixels: two pictures with the same one are the same to the last bit."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import Pixels


class PixelDigest:
    """SHA-256 of a picture of known shape, of which rows are added from the top; `pixel_hash` of the whole."""

    def __init__(self, shape: tuple[int, ...], dtype: npt.DTypeLike = np.uint8) -> None:
        self._digest = hashlib.sha256(f"{shape} {np.dtype(dtype).str}\n".encode())

    def add(self, rows: npt.NDArray[Any]) -> None:
        """Add the next rows."""
        self._digest.update(np.ascontiguousarray(rows).data)

    def passed(self, rows: Iterable[Pixels]) -> Iterator[Pixels]:
        """The rows of a picture as they are, each added on its way."""
        for part in rows:
            self.add(part)
            yield part

    def __str__(self) -> str:
        return self._digest.hexdigest()


def pixel_hash(picture: npt.NDArray[Any]) -> str:
    """SHA-256 of the decoded pixels: of shape, type and values in row order.

    Examples
    --------
    >>> pixel_hash(np.zeros((2, 3, 3), dtype=np.uint8))[:16]
    '541ff73e8d70c4c6'
    """
    digest = PixelDigest(picture.shape, picture.dtype)
    digest.add(picture)
    return str(digest)
