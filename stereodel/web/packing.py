"""Numbers as texts that a page carries and its script unpacks: deflate, then base64, which all browsers have built in.

`script/contents.ts` reads what is written here.
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

    Examples
    --------
    >>> packed(b"Ulm")
    'eNoLzckFAAJHAS8='
    """
    return base64.b64encode(zlib.compress(content, 9)).decode("ascii")


def packed_places(places: Ragged, digits: int) -> str:
    """Rows of longitude and latitude, degrees, rounded to so many digits behind the point.

    Parameters
    ----------
    places : Ragged
        Values (n, 2).
    digits : int

    Returns
    -------
    str
        Packed numbers of `varints`: digits, number of rows, size of each row, then the steps of all longitudes and of
        all latitudes from one place to the next, in units of the last digit. A negative step s is written as −2s − 1
        and another one as 2s. Quotients by a power of ten of whole numbers are the doubles that the digits mean.
    """
    units = np.rint(places.values * 10.0**digits).astype(np.int64)
    steps = np.diff(units, axis=0, prepend=np.zeros((1, 2), dtype=np.int64)).T.ravel()
    zigzag = np.where(steps < 0, -2 * steps - 1, 2 * steps)
    return packed(varints(np.concatenate([[digits, len(places)], places.sizes, zigzag])).tobytes())


def packed_doubles(values: FloatArray) -> str:
    """Numbers as they are: of all the eight bytes from the lowest on, the first of each, then the second, and so on.

    Side by side, high bytes are nearly the same and compress well.
    """
    planes = np.ascontiguousarray(values, dtype="<f8").reshape(-1, 1).view(np.uint8).T
    return packed(planes.tobytes())


def varints(numbers: npt.NDArray[np.int64]) -> Bytes:
    """Numbers from 0 on, seven bits a byte from the lowest on; the eighth bit says that the number goes on.

    Examples
    --------
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
