"""Numbers as text for a page, unpacked by its script: deflate, then base64, which all browsers decode natively.

`script/contents.ts` reads this format.
"""

from __future__ import annotations

import base64
import zlib

import numpy as np
import numpy.typing as npt

from stereodel._arrays import Bytes, FloatArray
from stereodel.curves.ragged import Ragged

SEVEN_BITS = 0x7F
GOES_ON = 0x80


def packed(content: bytes) -> str:
    """Bytes as text.

    >>> packed(b"Ulm")
    'eNoLzckFAAJHAS8='
    """
    return base64.b64encode(zlib.compress(content, 9)).decode("ascii")


def packed_places(places: Ragged, digits: int) -> str:
    """Rows of longitude and latitude in degrees, rounded to `digits` decimals, as packed numbers of `varints`.

    They are digits, number of rows, size of each row, then the steps of all longitudes and of all latitudes from one
    place to the next, in units of the last digit. A negative step s is written as −2s − 1, any other as 2s. Integers
    divided by a power of ten give the doubles nearest to the decimals.
    """
    units = np.rint(places.values * 10.0**digits).astype(np.int64)
    steps = np.diff(units, axis=0, prepend=np.zeros((1, 2), dtype=np.int64)).T.ravel()
    zigzag = np.where(steps < 0, -2 * steps - 1, 2 * steps)
    return packed(varints(np.concatenate([[digits, len(places)], places.sizes, zigzag])).tobytes())


def packed_doubles(values: FloatArray) -> str:
    """Doubles stored exactly: the lowest byte of all, then the second lowest of all, and so on.

    Grouped in this way, high bytes are similar and compress well.
    """
    planes = np.ascontiguousarray(values, dtype="<f8").reshape(-1, 1).view(np.uint8).T
    return packed(planes.tobytes())


def varints(numbers: npt.NDArray[np.int64]) -> Bytes:
    """Non-negative integers, seven bits per byte, lowest first; the eighth bit marks that more bytes follow.

    >>> varints(np.array([5, 300])).tolist()
    [5, 172, 2]
    """
    rest = numbers.astype(np.uint64)
    groups, more = [], []
    while True:
        groups.append((rest & np.uint64(SEVEN_BITS)).astype(np.uint8))
        rest = rest >> np.uint64(7)
        more.append(rest > 0)
        if not more[-1].any():
            break
    lengths = 1 + np.sum(more, axis=0)
    table = np.stack(groups, axis=1) | np.where(np.stack(more, axis=1), GOES_ON, 0).astype(np.uint8)
    return table[np.arange(len(groups)) < lengths[:, None]]
