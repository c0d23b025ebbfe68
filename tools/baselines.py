"""The nets under the pictures, and the stored pictures that they compare with, which nothing else writes.

    python -m tools.baselines --scripts figures --store tests/images/baselines [NAME…]

A case is a figure, or one of three frames of an animation: first, middle, last. Of each there are four nets.

T0. The arrays that are drawn and the geometry behind them, in NAME.npz.xz: integers and text equal, floats within
    `GOLDEN_ERROR`.
T1. The SHA-256 of the pixels of the picture without text, in `pixels.json`.
T2. The pixels themselves, in NAME.png at 640 pixels: a few may differ, in the whole picture and in each part of it,
    because another processor may round another way.
T3. The text, label by label, in `labels.json`: its pixels where the libraries that set it are those of the stored one
    (`Case.ink_hashes`), elsewhere its place (`Case.ink`), which may differ by a pixel.

What each of them lets pass stands here and not among the tolerances of the library, which know nothing of its tests.
"""

from __future__ import annotations

import argparse
import io
import json
import lzma
import math
import os
import platform
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Final, Literal

import imageio.v3 as iio
import numpy as np
import numpy.typing as npt
from matplotlib import ft2font

from stereodel._arrays import FloatArray, Pixels
from stereodel._extras import installed_version
from stereodel._tasks.whole_files import write_whole
from stereodel.drawing.page import Dots, Fill, Item, Label, Page, Picture, Polylines, Stroke
from stereodel.film import Film
from stereodel.render.figure import Figure
from stereodel.render.pixel_rows import LabelLayer, pixel_hash
from tools.build import BuildError, find_scripts, load_drawing

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

WHOLE: Final = ("path", "centers", "points", "offsets", "owner", "colors", "ends")
"""Fields of items and of what paints them that are stored as they are, each under its name."""

PACKING: Final = [{"id": lzma.FILTER_LZMA2, "preset": 9, "lc": 0, "lp": 3, "pb": 3}]
"""Of stored arrays, for numbers of eight bytes: 3 % smaller than what is usual."""

SIZE: Final = 640
"""Width of the stored pictures in pixels."""

ARRAYS: Final = "npz.xz"
"""Ending of stored arrays."""

HASHES: Final = "pixels.json"
LABELS: Final = "labels.json"

FRAMES: Final = ("first", "middle", "last")
"""Frames of an animation that are kept."""


@dataclass(frozen=True)
class Comparison:
    """How pixels differ: visibly, by more than `PIXEL_LEVELS`, and at all; shares, and counts in the worst tile.

    column, row: the left upper pixel of that tile.
    """

    visible: float
    any: float
    column: int
    row: int
    tile_visible: int
    tile_any: int

    @property
    def passes(self) -> bool:
        """Whether the difference is no more than rounding, in the whole picture and in each part of it."""
        whole = self.visible <= PIXEL_SHARE_VISIBLE and self.any <= PIXEL_SHARE_ANY
        return whole and self.tile_visible <= TILE_VISIBLE and self.tile_any <= TILE_ANY

    def __str__(self) -> str:
        shares = f"{self.visible:.4%} of the pixels differ by more than {PIXEL_LEVELS} levels, {self.any:.4%} at all"
        end = PIXEL_TILE - 1
        tile = f"columns {self.column} to {self.column + end}, rows {self.row} to {self.row + end}"
        return f"{shares}; most of them in {tile}: {self.tile_visible} and {self.tile_any}"


def compare(expected: Pixels, actual: Pixels) -> Comparison:
    """How a picture (h, w, c) differs from the expected one; another shape differs everywhere.

    Examples
    --------
    >>> white = np.full((10, 10, 3), 255, dtype=np.uint8)
    >>> dotted = white.copy()
    >>> dotted[0, 0] = 0
    >>> compare(white, dotted)
    Comparison(visible=0.01, any=0.01, column=0, row=0, tile_visible=1, tile_any=1)
    """
    if expected.shape != actual.shape:
        return Comparison(1.0, 1.0, 0, 0, PIXEL_TILE**2, PIXEL_TILE**2)
    levels = levels_apart(expected, actual)
    different = np.stack([levels > PIXEL_LEVELS, levels > 0])
    padded = np.pad(different, ((0, 0), (0, PIXEL_TILE - 1), (0, PIXEL_TILE - 1)))
    tiles = np.lib.stride_tricks.sliding_window_view(padded, (PIXEL_TILE, PIXEL_TILE), axis=(1, 2))
    half = PIXEL_TILE // 2
    counts = tiles[:, ::half, ::half].sum(axis=(3, 4))
    excess = np.maximum(counts[0] / TILE_VISIBLE, counts[1] / TILE_ANY)
    row, column = (int(at) for at in np.unravel_index(np.argmax(excess), excess.shape))
    shares, worst = different.mean(axis=(1, 2)).tolist(), counts[:, row, column].tolist()
    return Comparison(*shares, half * column, half * row, *worst)


def set_with() -> str:
    """What the pixels of type depend on beside the page: versions of matplotlib and of its FreeType, and processor."""
    matplotlib = installed_version("matplotlib")
    return f"matplotlib {matplotlib}, FreeType {ft2font.__freetype_version__}, {platform.machine()}"


def array_differences(expected: Arrays, actual: Arrays, *, tolerance: float = GOLDEN_ERROR) -> dict[str, str]:
    """What differs between two sets of named arrays: name → what is wrong with it in a few words.

    Floats may differ by `tolerance` times the largest number of the expected array, or times 1 if that is larger.

    Examples
    --------
    >>> array_differences({"n": np.arange(3)}, {"n": np.array([0, 1, 3]), "x": np.ones(2)})
    {'n': '1 of 3 entries differ, first at (2,): 2 expected, 3 found', 'x': 'not expected'}
    """
    found = {}
    for name in sorted({*expected, *actual}):
        if name not in actual:
            found[name] = "missing"
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
    """Store named arrays of numbers and text as NumPy's .npz, packed by LZMA: the same arrays give the same bytes.

    All arrays are packed as one, so that what occurs twice is stored once: in a third of the space that
    `numpy.savez_compressed` takes, which packs each by itself.
    """
    members = io.BytesIO()
    np.savez(members, **arrays)  # type: ignore[arg-type]
    write_whole(path, lzma.compress(members.getvalue(), filters=PACKING))
    return Path(path)


def load_arrays(path: str | os.PathLike[str]) -> dict[str, npt.NDArray[Any]]:
    """The arrays that `save_arrays` stored."""
    members = io.BytesIO(lzma.decompress(Path(path).read_bytes()))
    with np.load(members, allow_pickle=False) as archive:
        return dict(archive)


def read_picture(path: str | os.PathLike[str]) -> Pixels:
    """The pixels of a picture file, (h, w, 3)."""
    return np.asarray(iio.imread(Path(path)))[..., :3]


def levels_apart(expected: Pixels, actual: Pixels) -> npt.NDArray[np.int16]:
    """Largest difference of any channel, (h, w)."""
    return np.abs(expected.astype(np.int16) - actual.astype(np.int16)).max(axis=-1)


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


def page_arrays(page: Page) -> dict[str, npt.NDArray[Any]]:
    """Everything drawn as named arrays: every visible change alters a number."""
    named = {
        "page": np.array([*page.extent, page.width, *page.background]),
        "views": np.array(page.views).reshape(-1, 3, 3),
    }
    for number, item in enumerate(page.items):
        prefix = f"{number:04d}_{type(item).__name__.lower()}_{item.name}"
        named.update({f"{prefix}_{key}": np.asarray(value) for key, value in item_arrays(item).items()})
    return named


def item_arrays(item: Item) -> dict[str, Any]:
    """Everything that is drawn of an item; of a raster, which no figure has, its outline alone."""
    parts = (item, getattr(item, "painter", None))
    told = {key: getattr(part, key) for part in parts for key in WHOLE if hasattr(part, key)}
    if ball := getattr(item, "ball", None):
        told["ball"] = [*ball.center, ball.radius]
    match item:
        case Stroke():
            told["style"] = [*item.color, item.width, *(item.dash or (0.0, 0.0)), item.cap == "round", item.closed]
        case Fill():
            told |= {"path": np.concatenate(item.paths), "sizes": [*map(len, item.paths)], "style": item.color}
        case Dots():
            told["style"] = [item.radius, *item.color, *item.rim, item.rim_width]
        case Polylines():
            told["style"] = [*item.color, item.width]
        case Picture():
            told["outline"] = np.concatenate(item.outline)
        case Label():
            halo = [item.halo] if item.halo else []
            halo += item.halo_color if item.halo and item.halo_color != Label.halo_color else ()
            told["place"] = [*item.anchor, *item.offset, item.size, *item.color, item.rotation, *halo]
            told["text"] = [item.text, item.align, item.valign, *item.font, *([] if item.formulas else ["plain"])]
    return told


@dataclass(frozen=True, eq=False)
class Case:
    """One picture to compare: a page, the geometry behind it, and what draws it."""

    name: str
    page: Page
    geometry: Arrays
    renderer: Literal["gl", "agg"] = "gl"

    @cached_property
    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """What T0 compares: the arrays of the page, and the geometry under names that begin with "geometry"."""
        return summarised(
            {**page_arrays(self.page), **{f"geometry_{key}": np.asarray(a) for key, a in self.geometry.items()}}
        )

    @cached_property
    def picture(self) -> Pixels:
        """What T1 and T2 compare: the picture without text."""
        return self.page.pixels(size=SIZE, text=False, renderer=self.renderer)

    @cached_property
    def ink(self) -> FloatArray:
        """What T3 compares: where the ink of each label lies, left, bottom, right and top in points, (n, 4).

        Halos too, as far as it is at least half as strong as where it is strongest; NaN where a label leaves no ink.
        """
        width_px = max(1, round(INK_PER_POINT * self.page.width))
        boxes = np.full((len(self.page.labels), 4), np.nan)
        for box, layer in zip(boxes, self._label_layers(width_px), strict=True):
            reach = [(max(0, math.floor(first)), math.ceil(last)) for _, first, last in layer.placed]
            top, bottom = (min(layer.height, row) for row in (reach or [(0, 0)])[0])
            opacity = layer.rows(top, bottom)[..., 3] if top < bottom else np.zeros((0, 0), dtype=np.uint8)
            if opacity.any():
                rows, columns = np.nonzero(opacity >= opacity.max() / 2)
                low, high = layer.height - top - rows.max() - 1, layer.height - top - rows.min()
                box[:] = np.array([columns.min(), low, columns.max() + 1, high]) * (self.page.width / width_px)
        return boxes

    @cached_property
    def ink_hashes(self) -> list[str]:
        """What T3 compares where type is set with the same libraries: the hash of the picture of each label."""
        return [pixel_hash(layer.rows()) for layer in self._label_layers(SIZE)]

    def _label_layers(self, width_px: int) -> Iterator[LabelLayer]:
        return (LabelLayer(replace(self.page, items=(label,)), width_px) for label in self.page.labels)


@dataclass(frozen=True)
class Store:
    """The folder of stored arrays, hashes, pictures and places of type."""

    folder: Path

    @cached_property
    def hashes(self) -> dict[str, str]:
        """Name → SHA-256 of the stored picture."""
        return self._table(HASHES)

    @cached_property
    def labels(self) -> dict[str, dict[str, Any]]:
        """Name → what set the type and, of each label, the box of its ink in points, None without ink, and its hash."""
        return self._table(LABELS)

    def otherwise(self, case: Case) -> list[str]:
        """What all nets find, the coarse ones first, which can be seen."""
        return [*self.looks_otherwise(case), *self.set_otherwise(case), *self.drawn_otherwise(case)]

    def drawn_otherwise(self, case: Case) -> list[str]:
        """T0: what differs in the arrays, a line each; empty when nothing does."""
        path = self.folder / f"{case.name}.{ARRAYS}"
        if not path.is_file():
            return [f"T0: {path.name} is missing; look at the picture, then run `make baselines`"]
        return [f"T0: {name}: {wrong}" for name, wrong in array_differences(load_arrays(path), case.arrays).items()]

    def looks_otherwise(self, case: Case) -> list[str]:
        """T1, and T2 where T1 differs: what is wrong with the pixels; empty when nothing is."""
        path = self.folder / f"{case.name}.png"
        if case.name not in self.hashes or not path.is_file():
            return [f"T1: {path.name} or its hash is missing; look at the picture, then run `make baselines`"]
        if pixel_hash(case.picture) == self.hashes[case.name]:
            return []
        found = compare(read_picture(path), case.picture)
        return [] if found.passes else [f"T2: {found}"]

    def set_otherwise(self, case: Case) -> list[str]:
        """T3: which labels are not what they were, a line each; empty when all are."""
        if case.name not in self.labels:
            return [f"T3: {LABELS} has no {case.name}; look at the picture, then run `make baselines`"]
        stored, exact = self.labels[case.name], self.exact_type(case)
        if (count := len(stored["boxes"])) != len(case.page.labels):
            return [f"T3: {count} labels expected, {len(case.page.labels)} found"]
        numbered = [(number, item) for number, item in enumerate(case.page.items) if isinstance(item, Label)]
        found = []
        for k, (number, label) in enumerate(numbered):
            if exact and case.ink_hashes[k] == stored["hashes"][k]:
                continue
            box = np.array(stored["boxes"][k] or [np.nan] * 4)
            wrong = _moved(box, case.ink[k], TYPE_PIXELS * case.page.width / SIZE)
            if wrong or exact:
                found.append(f'T3: label {number} ("{label.text}") {wrong or "looks otherwise where it was"}')
        return found

    def exact_type(self, case: Case) -> bool:
        """Whether the stored type was set with the libraries of today, so that its pixels are compared."""
        return self.labels.get(case.name, {}).get("set_with") == set_with()

    def write(self, case: Case) -> None:
        """Store a case; its hash and its labels go into their files with `write_tables`."""
        save_arrays(case.arrays, self.folder / f"{case.name}.{ARRAYS}")
        data = iio.imwrite("<bytes>", case.picture, extension=".png", plugin="pillow", optimize=True)
        write_whole(self.folder / f"{case.name}.png", data)
        self.hashes[case.name] = pixel_hash(case.picture)
        self.write_labels(case)

    def write_labels(self, case: Case) -> None:
        """Store the labels of a case, which another version of what sets type may set otherwise."""
        boxes = [None if np.isnan(box).any() else box.round(1).tolist() for box in case.ink]
        self.labels[case.name] = {"set_with": set_with(), "boxes": boxes, "hashes": case.ink_hashes}

    def write_tables(self) -> None:
        """Write `pixels.json` and `labels.json`, a line for each case."""
        for file, table in ((HASHES, self.hashes), (LABELS, self.labels)):
            lines = [f" {json.dumps(name)}: {json.dumps(entry)}" for name, entry in sorted(table.items())]
            write_whole(self.folder / file, "{\n" + ",\n".join(lines) + "\n}\n")

    def forget_others(self, names: Iterable[str]) -> list[str]:
        """Remove what belongs to none of `names`, and say what."""
        files = {path.name.partition(".")[0] for kind in (ARRAYS, "png") for path in self.folder.glob(f"*.{kind}")}
        stale = sorted((files | set(self.hashes)) - set(names))
        for name in stale:
            self.hashes.pop(name, None)
            self.labels.pop(name, None)
            for kind in (ARRAYS, "png"):
                (self.folder / f"{name}.{kind}").unlink(missing_ok=True)
        return stale

    def _table(self, file: str) -> dict[str, Any]:
        path = self.folder / file
        return dict(json.loads(path.read_text(encoding="utf-8"))) if path.is_file() else {}


def cases_of(script: Path) -> list[Case]:
    """The cases of one script: its figure, or three frames of its animation."""
    drawing: Figure | Film[Any] = load_drawing(script)
    if isinstance(drawing, Figure):
        geometry = drawing.geometry()
        return [Case(drawing.name, drawing.draw(geometry), geometry, drawing.renderer)]
    chosen = (0, len(drawing) // 2, len(drawing) - 1)
    return [Case(f"{script.stem}_{which}", drawing.page(at), {}) for which, at in zip(FRAMES, chosen, strict=True)]


def case_names(script: Path) -> list[str]:
    """The names of a script's cases, without loading it: those of its file."""
    return [f"{script.stem}_{which}" for which in FRAMES] if script.stem.startswith("anim_") else [script.stem]


def write_baselines(scripts: Path, folder: Path, names: Sequence[str] = ()) -> Iterator[str]:
    """Draw and store the cases of all scripts, or of those whose name begins with one of `names`; a line for each."""
    folder.mkdir(parents=True, exist_ok=True)
    store = Store(folder)
    for script in find_scripts(scripts, names):
        for case in cases_of(script):
            known = case.name in store.hashes
            changed = store.otherwise(case)
            if changed:
                store.write(case)
            elif not store.exact_type(case):
                store.write_labels(case)
            yield f"{case.name}: {('changed' if known else 'new') if changed else 'as it was'}"
    for name in store.forget_others(n for script in find_scripts(scripts) for n in case_names(script)):
        yield f"{name}: removed, no script draws it"
    store.write_tables()


def main(arguments: Sequence[str] | None = None) -> int:
    """Write baselines from the command line; exit code 0, or 2 when there is nothing to draw or nowhere to write."""
    parser = argparse.ArgumentParser(prog="tools.baselines", description="Store the pictures of the tests.")
    parser.add_argument("names", nargs="*", help="beginnings of script names, e.g. fig03; all by default")
    parser.add_argument("--scripts", type=Path, default=Path("figures"), help="folder of the scripts (%(default)s)")
    parser.add_argument("--store", type=Path, required=True, help="folder of the baselines")
    options = parser.parse_args(arguments)
    try:
        for line in write_baselines(options.scripts, options.store, options.names):
            print(line, flush=True)
    except (BuildError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


def _moved(stored: FloatArray, found: FloatArray, limit: float) -> str:
    """How the ink of a label lies otherwise by more than a limit, in points; empty when it does not."""
    if np.isnan(stored).any() or np.isnan(found).any():
        return "" if np.array_equal(stored, found, equal_nan=True) else "has ink where it had none, or none any more"
    apart = float(np.abs(stored - found).max())
    return f"has its ink {apart:.2f} points from where it was" if apart > limit else ""


if __name__ == "__main__":
    sys.exit(main())
