"""How a set of stereodel/data is packed into its file, which `stereodel.data.stored` reads."""

from __future__ import annotations

import io
import lzma
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt


def dump(columns: Mapping[str, Sequence[int] | npt.NDArray[np.integer[Any]] | Sequence[str]]) -> bytes:
    """The file of a set: columns of integers of 32 bits, or of texts without line breaks."""
    packed: dict[str, Any] = {}
    for name, values in columns.items():
        array = np.asarray(values)
        if array.dtype.kind == "U":
            packed[name] = np.frombuffer("\n".join(array.tolist()).encode(), dtype=np.uint8)
        else:
            packed[name] = np.ascontiguousarray(array.astype("<i4")[:, None].view(np.uint8).T)
    archive = io.BytesIO()
    np.savez(archive, **packed)
    return lzma.compress(archive.getvalue(), preset=9 | lzma.PRESET_EXTREME)
