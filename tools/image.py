"""Comparing pictures and the numbers behind them: what the golden tests use.

Four nets. T0 compares the arrays that are drawn: integers and text equal, floats within `GOLDEN_ERROR`. T1 compares
the SHA-256 of the pixels of the picture without text. T2 compares the pixels themselves with a stored picture and lets
a few of them differ, in the whole picture and in each part of it, because another processor may round another way. T3
compares the text, label by label: its pixels where the libraries that set it are those of the stored one
(`ink_hashes`), elsewhere its place (`ink_boxes`), which may differ by a pixel. What each of them lets pass stands here
and not among the tolerances of the library, which know nothing of its tests.
"""

from __future__ import annotations

import io
import lzma
import math
import os
import platform
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import imageio.v3 as iio
import numpy as np
import numpy.typing as npt
from matplotlib import ft2font

from stereodel._arrays import BoolArray, FloatArray, Pixels
from stereodel._files import replacing
from stereodel.drawing.page import Page
from stereodel.render.provenance import library_version
from stereodel.render.rows import LabelLayer, pixel_hash
from tools.fields import fields_of, place_in

Arrays = Mapping[str, npt.NDArray[Any]]

GOLDEN_ERROR: Final = 1e-12
"""How far a drawn number may be from the stored one, relative to the largest of its array, or to 1 if that is larger.

Mathematical libraries and processors round sines and fused sums in other ways; a change that a reader could see is
1e-5 or more.
"""

PIXEL_LEVELS: Final = 8
"""Levels of 255 by which a pixel may differ before it counts as visibly other."""

PIXEL_SHARE_VISIBLE: Final = 1e-4
"""Share of the pixels of a picture that may be visibly other: one missing hairline of a small picture is more."""

PIXEL_SHARE_ANY: Final = 1e-3
"""Share of the pixels of a picture that may differ at all; a processor without AVX moves 5e-5 of them, by one level."""

PIXEL_TILE: Final = 32
"""Side in pixels of the tiles in which differences are counted too, so that a small one is not lost in a large picture.

Tiles begin at each multiple of half a side: whatever is no larger than that lies in one of them.
"""

TILE_VISIBLE: Final = 4
"""Pixels of a tile that may be visibly other: rounding moves single ones, the smallest dot without its rim has nine."""

TILE_ANY: Final = 8
"""Pixels of a tile that may differ at all: as many as another processor moves in a picture; a line across it has 32."""

TYPE_PIXELS: Final = 1.0
"""Pixels of a stored picture by which the ink of a label may lie elsewhere: versions of FreeType round otherwise."""

INK_PER_POINT: Final = 10
"""Pixels per point at which ink is measured: a twentieth of a point is less than a reader can see."""

LARGE: Final = 500_000
"""Numbers in the arrays of one picture beyond which only a summary is stored."""

SAMPLES: Final = 1000
"""Numbers kept of each row of a summary."""

PACKING: Final = [{"id": lzma.FILTER_LZMA2, "preset": 9, "lc": 0, "lp": 3, "pb": 3}]
"""Of stored arrays, for numbers of eight bytes: 3 % smaller than what is usual."""

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
    levels = levels_apart(expected, actual)
    visible, different = levels > PIXEL_LEVELS, levels > 0
    return Comparison(float(np.mean(visible)), float(np.mean(different)), _worst_tile(visible, different))


def ink_boxes(page: Page) -> FloatArray:
    """Where the ink of each label lies, halos too: left, bottom, right and top in points from the lower left, (n, 4).

    As far as it is at least half as strong as where it is strongest; NaN where a label leaves no ink.
    """
    width_px = max(1, round(INK_PER_POINT * page.width))
    boxes = np.full((len(page.labels), 4), np.nan)
    for box, label in zip(boxes, page.labels, strict=True):
        layer = LabelLayer(replace(page, items=(label,)), width_px)
        top, bottom = layer.span
        opacity = layer.rows(top, bottom)[..., 3] if top < bottom else np.zeros((0, 0), dtype=np.uint8)
        if opacity.any():
            rows, columns = np.nonzero(opacity >= opacity.max() / 2)
            low, high = layer.height - top - rows.max() - 1, layer.height - top - rows.min()
            box[:] = np.array([columns.min(), low, columns.max() + 1, high]) * (page.width / width_px)
    return boxes


def ink_hashes(page: Page, width_px: int) -> list[str]:
    """SHA-256 of the picture of each label alone, on a page `width_px` pixels wide."""
    return [pixel_hash(LabelLayer(replace(page, items=(label,)), width_px).rows()) for label in page.labels]


def set_with() -> str:
    """What the pixels of type depend on beside the page: versions of matplotlib and of its FreeType, and processor."""
    return f"matplotlib {library_version('matplotlib')}, FreeType {ft2font.__freetype_version__}, {platform.machine()}"


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
        elif wrong := _array_difference(name, expected[name], actual[name], tolerance):
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
    """Store named arrays of numbers and text as NumPy's .npz, packed by LZMA: the same arrays give the same bytes.

    All arrays are packed as one, so that what occurs twice is stored once: in a third of the space that
    `numpy.savez_compressed` takes, which packs each by itself.
    """
    target = Path(path)
    for name, array in arrays.items():
        if np.asarray(array).dtype.kind not in "fiubU":
            raise TypeError(f"arrays hold numbers or text, got {np.asarray(array).dtype} as {name!r}")
    members = io.BytesIO()
    np.savez(members, **arrays)  # type: ignore[arg-type]
    with replacing(target) as temporary:
        temporary.write_bytes(lzma.compress(members.getvalue(), filters=PACKING))
    return target


def load_arrays(path: str | os.PathLike[str]) -> dict[str, npt.NDArray[Any]]:
    """The arrays that `save_arrays` stored."""
    members = io.BytesIO(lzma.decompress(Path(path).read_bytes()))
    with np.load(members, allow_pickle=False) as archive:
        return dict(archive)


def read_picture(path: str | os.PathLike[str]) -> Pixels:
    """The pixels of a picture file, (h, w, 3)."""
    picture: Pixels = np.asarray(iio.imread(Path(path)))[..., :3]
    return picture


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


def levels_apart(expected: Pixels, actual: Pixels) -> npt.NDArray[np.int16]:
    """Largest difference of any channel, (h, w)."""
    apart: npt.NDArray[np.int16] = np.abs(expected.astype(np.int16) - actual.astype(np.int16)).max(axis=-1)
    return apart


def _array_difference(name: str, expected: npt.NDArray[Any], actual: npt.NDArray[Any], tolerance: float) -> str:
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
    if len(fields_of(name)) >= len(wrong):
        named = zip(fields_of(name), wrong, expected, actual, strict=False)
        return "; ".join(
            f"{field} is {_told(found)}, expected {_told(wanted)}" for field, other, wanted, found in named if other
        )
    first = tuple(int(i) for i in np.argwhere(wrong)[0])
    count = f"{int(wrong.sum())} of {wrong.size} entries differ"
    return f"{count}, first {place_in(name, first)}: {expected[first]} expected, {actual[first]} found"


def _told(value: Any) -> str:
    """A number to as many digits as are compared, or a text."""
    return f"{value:.12g}" if isinstance(value, float) else str(value)
