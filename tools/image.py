"""Comparing pictures and the numbers behind them: what the golden tests use.

Four nets. T0 compares the arrays that are drawn: integers and text equal, floats within `GOLDEN_ERROR`. T1 compares
the SHA-256 of the pixels of the picture without text. T2 compares the pixels themselves with a stored picture and lets
a few of them differ, in the whole picture and in each part of it, because another processor may round another way. T3
compares the places of the text (`stereodel.render.text.ink_boxes`), and lets them differ by a pixel.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import imageio.v3 as iio
import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray
from stereodel._files import replacing
from stereodel.constants import (
    GOLDEN_ERROR,
    PIXEL_LEVELS,
    PIXEL_SHARE_ANY,
    PIXEL_SHARE_VISIBLE,
    PIXEL_TILE,
    TILE_ANY,
    TILE_VISIBLE,
)

Pixels = npt.NDArray[np.uint8]
Arrays = Mapping[str, npt.NDArray[Any]]

LARGE: Final = 500_000
"""Numbers in the arrays of one picture beyond which only a summary is stored."""

SAMPLES: Final = 1000
"""Numbers kept of each row of a summary."""

MISSING: Final = "missing"
"""The difference of a name that only one side has."""


@dataclass(frozen=True)
class Comparison:
    """How two pictures differ.

    Parameters
    ----------
    visible : float
        Share of pixels of which a channel differs by more than `PIXEL_LEVELS`.
    any : float
        Share of pixels that differ at all.
    worst : Tile
        The part of the picture, `PIXEL_TILE` pixels wide and high, that differs most.
    """

    visible: float
    any: float
    worst: Tile

    @property
    def passes(self) -> bool:
        """Whether the difference is no more than rounding, in the whole picture and in each part of it."""
        return self.visible <= PIXEL_SHARE_VISIBLE and self.any <= PIXEL_SHARE_ANY and self.worst.excess <= 1

    def __str__(self) -> str:
        shares = f"{self.visible:.4%} of the pixels differ by more than {PIXEL_LEVELS} levels, {self.any:.4%} at all"
        return f"{shares}; {self.worst}"


@dataclass(frozen=True)
class Tile:
    """How many pixels differ in a part of a picture whose left upper pixel is in `column` and `row`."""

    column: int
    row: int
    visible: int
    any: int

    @property
    def excess(self) -> float:
        """The larger of the counts, each in terms of what may be."""
        return max(self.visible / TILE_VISIBLE, self.any / TILE_ANY)

    def __str__(self) -> str:
        across = f"columns {self.column} to {self.column + PIXEL_TILE - 1}"
        down = f"rows {self.row} to {self.row + PIXEL_TILE - 1}"
        return f"most of them in {across}, {down}: {self.visible} and {self.any}"


def compare(expected: Pixels, actual: Pixels) -> Comparison:
    """How a picture differs from the expected one; another shape differs everywhere.

    Parameters
    ----------
    expected, actual : (h, w, c) uint8 arrays

    Examples
    --------
    >>> white = np.full((10, 10, 3), 255, dtype=np.uint8)
    >>> dotted = white.copy()
    >>> dotted[0, 0] = 0
    >>> compare(white, dotted)
    Comparison(visible=0.01, any=0.01, worst=Tile(column=0, row=0, visible=1, any=1))
    """
    if expected.shape != actual.shape:
        return Comparison(1.0, 1.0, Tile(0, 0, PIXEL_TILE**2, PIXEL_TILE**2))
    levels = _levels_apart(expected, actual)
    visible, different = levels > PIXEL_LEVELS, levels > 0
    return Comparison(float(np.mean(visible)), float(np.mean(different)), _worst_tile(visible, different))


def difference_picture(expected: Pixels, actual: Pixels) -> Pixels:
    """Where two pictures differ: red beyond `PIXEL_LEVELS`, orange below, over the expected one in pale gray.

    Pictures of different shapes are compared in their common upper left corner.
    """
    height, width = np.minimum(expected.shape[:2], actual.shape[:2])
    expected, actual = expected[:height, :width, :3], actual[:height, :width, :3]
    levels = _levels_apart(expected, actual)
    gray = (191 + expected.mean(axis=-1) / 4).astype(np.uint8)
    picture = np.stack([gray, gray, gray], axis=-1)
    picture[levels > 0] = (240, 160, 0)
    picture[levels > PIXEL_LEVELS] = (220, 0, 0)
    return picture


def array_differences(expected: Arrays, actual: Arrays, *, tolerance: float = GOLDEN_ERROR) -> dict[str, str]:
    """What differs between two sets of named arrays.

    Parameters
    ----------
    expected, actual : mapping of str to array
    tolerance : float
        Largest difference of floats, relative to the largest number of the expected array, or to 1 if that is larger.

    Returns
    -------
    dict
        Name → what is wrong with it in a few words; empty when nothing is.

    Examples
    --------
    >>> array_differences({"n": np.arange(3)}, {"n": np.array([0, 1, 3]), "x": np.ones(2)})
    {'n': '1 of 3 entries differ, first at (2,): 2 expected, 3 found', 'x': 'not expected'}
    """
    found = {}
    for name in sorted({*expected, *actual}):
        if name not in actual:
            found[name] = MISSING
        elif name not in expected:
            found[name] = "not expected"
        elif wrong := _array_difference(expected[name], actual[name], tolerance):
            found[name] = wrong
    return found


def summarised(arrays: Arrays) -> dict[str, npt.NDArray[Any]]:
    """Named arrays as they are if they are small together; else what a few numbers tell of them.

    Numbers of items of one kind and name (whose names begin with a number each) are joined. Of each such row are kept:
    how many they are, their sum, the sum of their squares, and every so many-th of them in the order of their size, so
    that another order of rows does not count. Texts are kept as they are.

    Examples
    --------
    >>> large = {f"{k:04d}_stroke_coast_path": np.full((2000, 4, 2), k / 8) for k in range(40)}
    >>> {name: array.shape for name, array in summarised(large).items()}
    {'stroke_coast_path_totals': (3,), 'stroke_coast_path_samples': (1000,)}
    """
    if sum(array.size for array in arrays.values()) <= LARGE:
        return dict(arrays)
    found = {name: array for name, array in arrays.items() if array.dtype.kind not in "biuf"}
    rows: dict[str, list[npt.NDArray[Any]]] = {}
    for name, array in arrays.items():
        if name not in found:
            number, _, rest = name.partition("_")
            rows.setdefault(rest if number.isdigit() else name, []).append(array.ravel().astype(np.float64))
    for name, parts in rows.items():
        row = np.sort(np.concatenate(parts))
        found[f"{name}_totals"] = np.array([row.size, math.fsum(row), math.fsum(row**2)])
        found[f"{name}_samples"] = row[:: -(-row.size // SAMPLES) or 1]
    return found


def save_arrays(arrays: Arrays, path: str | os.PathLike[str]) -> Path:
    """Store named arrays of numbers and text in a compressed .npz file; the same arrays always give the same bytes.

    All floats lie in one member and all integers in another, each array once however often it occurs.
    """
    target = Path(path)
    store = _Store()
    index = {name: store.put(np.asarray(array)) for name, array in arrays.items()}
    # LZMA makes files half as large as NumPy's own savez_compressed; np.load reads both.
    with replacing(target) as temporary, zipfile.ZipFile(temporary, "w") as archive:
        for name, values in {"index": np.array(json.dumps(index)), **store.members()}.items():
            member = zipfile.ZipInfo(f"{name}.npy")
            member.compress_type = zipfile.ZIP_LZMA
            with archive.open(member, "w") as file:
                np.lib.format.write_array(file, values)
    return target


def load_arrays(path: str | os.PathLike[str]) -> dict[str, npt.NDArray[Any]]:
    """The arrays that `save_arrays` stored."""
    with np.load(path, allow_pickle=False) as archive:
        members = dict(archive)  # the archive itself would unpack a member each time that it is asked for
    index = json.loads(members["index"].item())
    return {name: _Store.get(members, *entry) for name, entry in index.items()}


def read_picture(path: str | os.PathLike[str]) -> Pixels:
    """The pixels of a picture file, (h, w, 3)."""
    picture: Pixels = np.asarray(iio.imread(Path(path)))[..., :3]
    return picture


class _Store:
    """Arrays laid end to end by kind: "f" floats, "i" integers and truth values; text ("U") stays in the index.

    Columns lie in one piece, because the x of neighbours have more in common than x and y of a point.
    """

    def __init__(self) -> None:
        self.parts: dict[str, list[npt.NDArray[Any]]] = {"f": [], "i": []}
        self.sizes = {"f": 0, "i": 0}
        self.known: dict[bytes, list[Any]] = {}

    def put(self, array: npt.NDArray[Any]) -> list[Any]:
        """Where an array lies: [type, shape, first place or the text itself]."""
        entry: list[Any] = [array.dtype.str, list(array.shape)]
        if array.dtype.kind == "U":
            return [*entry, array.tolist()]
        if array.dtype.kind not in "fiub":
            raise TypeError(f"arrays hold numbers or text, got {array.dtype}")
        key = hashlib.sha256(json.dumps(entry).encode() + array.tobytes()).digest()
        if key not in self.known:
            kind = "f" if array.dtype.kind == "f" else "i"
            self.known[key] = [*entry, self.sizes[kind]]
            self.parts[kind].append(array.ravel(order="F").astype(np.float64 if kind == "f" else np.int64))
            self.sizes[kind] += array.size
        return self.known[key]

    def members(self) -> dict[str, npt.NDArray[Any]]:
        return {
            kind: np.concatenate([np.zeros(0, "f8" if kind == "f" else "i8"), *a]) for kind, a in self.parts.items()
        }

    @staticmethod
    def get(members: Mapping[str, Any], dtype: str, shape: list[int], place: Any) -> npt.NDArray[Any]:
        kind = np.dtype(dtype).kind
        if kind == "U":
            return np.array(place, dtype=dtype).reshape(shape)
        values = members["f" if kind == "f" else "i"][place : place + math.prod(shape)]
        return np.asarray(values).astype(dtype).reshape(shape, order="F")


def _worst_tile(visible: BoolArray, different: BoolArray) -> Tile:
    """The tile with the largest excess, the first of several."""
    counts = [_in_tiles(where) for where in (visible, different)]
    excess = np.maximum(counts[0] / TILE_VISIBLE, counts[1] / TILE_ANY)
    row, column = (int(at) for at in np.unravel_index(np.argmax(excess), excess.shape))
    half = PIXEL_TILE // 2
    return Tile(half * column, half * row, *(int(count[row, column]) for count in counts))


def _in_tiles(where: BoolArray) -> npt.NDArray[np.intp]:
    """How often it is true in each tile; tiles begin at each multiple of half their side, the last may be cut off."""
    half = PIXEL_TILE // 2
    height, width = where.shape
    whole = np.pad(where, ((0, -height % half + half), (0, -width % half + half)))
    blocks = whole.reshape(len(whole) // half, half, -1, half).sum(axis=(1, 3))
    counts: npt.NDArray[np.intp] = blocks[:-1, :-1] + blocks[1:, :-1] + blocks[:-1, 1:] + blocks[1:, 1:]
    return counts


def _levels_apart(expected: Pixels, actual: Pixels) -> npt.NDArray[np.int16]:
    """Largest difference of any channel, (h, w)."""
    apart: npt.NDArray[np.int16] = np.abs(expected.astype(np.int16) - actual.astype(np.int16)).max(axis=-1)
    return apart


def _array_difference(expected: npt.NDArray[Any], actual: npt.NDArray[Any], tolerance: float) -> str:
    """What is wrong with an array; empty when nothing is."""
    if expected.shape != actual.shape:
        return f"shape {expected.shape} expected, {actual.shape} found"
    if expected.dtype.kind != actual.dtype.kind:
        return f"type {expected.dtype} expected, {actual.dtype} found"
    if expected.dtype.kind == "f":
        scale = max(1.0, float(np.max(np.abs(expected), initial=0.0, where=np.isfinite(expected))))
        wrong = ~np.isclose(actual, expected, rtol=0.0, atol=tolerance * scale, equal_nan=True)
    else:
        wrong = expected != actual
    if not wrong.any():
        return ""
    first = tuple(int(i) for i in np.argwhere(wrong)[0])
    count = f"{int(wrong.sum())} of {wrong.size} entries differ"
    return f"{count}, first at {first}: {expected[first]} expected, {actual[first]} found"
