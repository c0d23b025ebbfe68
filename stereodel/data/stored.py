"""How a set is stored: whole numbers as planes of bytes and texts as lines, in an npz archive, compressed by xz.

Numbers of the same size have nearly the same high bytes; side by side these compress to little, while in place every
fourth byte would look like noise. Decimal fractions are stored as the integers that they are multiples of: a quotient
of two exact doubles is the double nearest to the decimal fraction, the same as reading its text.
"""

from __future__ import annotations

import hashlib
import io
import json
import lzma
from functools import cache
from importlib import resources
from typing import Any, Final

import numpy as np

from stereodel._arrays import Bytes, FloatArray, IntArray, Texts

TABLE: Final = "sources.json"
"""Name of the file that says where each set is from."""


@cache
def table() -> dict[str, dict[str, Any]]:
    """Source, licence, version, checksum and size of each set by name."""
    text = resources.files("stereodel.data").joinpath(TABLE).read_text(encoding="utf-8")
    return dict(json.loads(text))


def read(name: str) -> bytes:
    """The file of a set; OSError if it is not the one that the table names."""
    entry = table()[name]
    packed = resources.files("stereodel.data").joinpath(entry["file"]).read_bytes()
    if hashlib.sha256(packed).hexdigest() != entry["sha256"]:
        raise OSError(f"stereodel/data/{entry['file']} is not what its SHA-256 says; install stereodel again")
    return packed


def load(name: str) -> dict[str, Bytes]:
    """The stored arrays of a set."""
    with np.load(io.BytesIO(lzma.decompress(read(name)))) as archive:
        return dict(archive)


def integers(planes: Bytes) -> IntArray:
    """A column of integers."""
    return np.ascontiguousarray(planes.T).view("<i4")[:, 0].astype(np.int32)


def decimals(planes: Bytes, digits: int) -> FloatArray:
    """A column of decimal fractions with `digits` decimals."""
    return integers(planes) / 10.0**digits


def texts(lines: Bytes) -> Texts:
    """A column of texts."""
    return np.array(lines.tobytes().decode().split("\n"))
