"""The stored pictures that the image tests compare with, and the only program that writes them.

    python -m tools.baselines --scripts figures --store tests/images/baselines [NAME…]

A case is a figure, or one of three frames of an animation: first, middle, last. Of each the store holds NAME.npz.xz,
the arrays that are drawn and the geometry behind them (T0), its pixel hash in `pixels.json` (T1), NAME.png, the picture
without text at 640 pixels (T2), and in `labels.json` the box and the pixel hash of the ink of each label, and what set
them (T3); see `tools.image`.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Final, Literal

import imageio.v3 as iio
import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Pixels
from stereodel._files import replacing
from stereodel.drawing.page import Label, Page
from stereodel.film import Film
from stereodel.render.figure import Figure
from stereodel.render.rows import pixel_hash
from tools.build import BuildError, find_scripts, load_drawing
from tools.fields import item_of
from tools.image import (
    TYPE_PIXELS,
    Arrays,
    array_differences,
    compare,
    ink_boxes,
    ink_hashes,
    load_arrays,
    read_picture,
    save_arrays,
    set_with,
    summarised,
)

SIZE: Final = 640
"""Width of the stored pictures in pixels."""

ARRAYS: Final = "npz.xz"
"""Ending of stored arrays."""

HASHES: Final = "pixels.json"
LABELS: Final = "labels.json"

FRAMES: Final = ("first", "middle", "last")
"""Frames of an animation that are kept."""


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
            {**self.page.arrays(), **{f"geometry_{key}": np.asarray(a) for key, a in self.geometry.items()}}
        )

    @cached_property
    def picture(self) -> Pixels:
        """What T1 and T2 compare: the picture without text."""
        return self.page.pixels(size=SIZE, text=False, renderer=self.renderer)

    @cached_property
    def ink(self) -> FloatArray:
        """What T3 compares: where the ink of each label lies, (n, 4)."""
        return ink_boxes(self.page)

    @cached_property
    def ink_hashes(self) -> list[str]:
        """What T3 compares where type is set with the same libraries: the hash of the picture of each label."""
        return ink_hashes(self.page, SIZE)


@dataclass(frozen=True, eq=False)
class Lettering:
    """A label as it was stored and as it is.

    Parameters
    ----------
    text : str
        Of today's.
    stored, found : (4,) array
        Left, bottom, right and top of its ink, in points from the lower left; NaN where there is none.
    wrong : str
        How it differs; empty when it does not.
    """

    text: str
    stored: FloatArray
    found: FloatArray
    wrong: str


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
        differences = array_differences(load_arrays(path), case.arrays)
        texts = {number: label.text for number, label in _numbered(case.page)}
        return [f"T0: {item_of(name, texts)}: {wrong}" for name, wrong in differences.items()]

    def looks_otherwise(self, case: Case) -> list[str]:
        """T1, and T2 where T1 differs: what is wrong with the pixels; empty when nothing is."""
        path = self.folder / f"{case.name}.png"
        if case.name not in self.hashes or not path.is_file():
            return [f"T1: {path.name} or its hash is missing; look at the picture, then run `make baselines`"]
        if pixel_hash(case.picture) == self.hashes[case.name]:
            return []
        stored = read_picture(path)
        if stored.shape != case.picture.shape:
            (height, width), (rows, columns) = stored.shape[:2], case.picture.shape[:2]
            return [f"T2: {columns} × {rows} pixels, expected {width} × {height}"]
        found = compare(stored, case.picture)
        return [] if found.passes else [f"T2: {found}"]

    def set_otherwise(self, case: Case) -> list[str]:
        """T3: which labels are not what they were, a line each; empty when all are."""
        if case.name not in self.labels:
            return [f"T3: {LABELS} has no {case.name}; look at the picture, then run `make baselines`"]
        if (count := len(self.labels[case.name]["boxes"])) != len(case.page.labels):
            return [f"T3: {count} labels expected, {len(case.page.labels)} found"]
        if self.exact_type(case) and case.ink_hashes == self.labels[case.name]["hashes"]:
            return []
        found = zip(_numbered(case.page), self.lettering(case), strict=True)
        return [f'T3: label {number} ("{label.text}") {found.wrong}' for (number, label), found in found if found.wrong]

    def exact_type(self, case: Case) -> bool:
        """Whether the stored type was set with the libraries of today, so that its pixels are compared."""
        return self.labels.get(case.name, {}).get("set_with") == set_with()

    def lettering(self, case: Case) -> list[Lettering]:
        """Each label of a case beside the stored one of its place in the order."""
        entry = self.labels.get(case.name, {"boxes": [], "hashes": []})
        stored = np.array([box or [np.nan] * 4 for box in entry["boxes"]]).reshape(-1, 4)
        limit = TYPE_PIXELS * case.page.width / SIZE
        exact, letterings = self.exact_type(case), []
        for at, (label, found) in enumerate(zip(case.page.labels, case.ink, strict=True)):
            box, wrong = np.full(4, np.nan), "is new"
            if at < len(stored):
                box = stored[at]
                other = exact and case.ink_hashes[at] != entry["hashes"][at]
                wrong = _moved(box, found, limit) or ("looks otherwise where it was" if other else "")
            letterings.append(Lettering(label.text, box, found, wrong))
        return letterings

    def write(self, case: Case) -> None:
        """Store a case; its hash and its labels go into their files with `write_tables`."""
        save_arrays(case.arrays, self.folder / f"{case.name}.{ARRAYS}")
        data = iio.imwrite("<bytes>", case.picture, extension=".png", plugin="pillow", optimize=True)
        _replace(self.folder / f"{case.name}.png", data)
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
            _replace(self.folder / file, ("{\n" + ",\n".join(lines) + "\n}\n").encode())

    def forget_others(self, names: Iterable[str]) -> list[str]:
        """Remove what belongs to none of `names`, and say what."""
        kept = set(names)
        files = {path.name.partition(".")[0] for kind in (ARRAYS, "png") for path in self.folder.glob(f"*.{kind}")}
        stale = sorted(files | set(self.hashes))
        stale = [name for name in stale if name not in kept]
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
    """Draw and store the cases of all scripts, or of those whose name begins with one of `names`.

    Yields
    ------
    str
        What was done, a line for each case.
    """
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


def _numbered(page: Page) -> list[tuple[int, Label]]:
    """The labels of a page with their numbers among its items."""
    return [(number, item) for number, item in enumerate(page.items) if isinstance(item, Label)]


def _moved(stored: FloatArray, found: FloatArray, limit: float) -> str:
    """How the ink of a label lies otherwise by more than a limit, in points; empty when it does not."""
    if np.isnan(stored).any() or np.isnan(found).any():
        return "" if np.array_equal(stored, found, equal_nan=True) else "has ink where it had none, or none any more"
    apart = float(np.abs(stored - found).max())
    return f"has its ink {apart:.2f} points from where it was" if apart > limit else ""


def _replace(path: Path, data: bytes) -> None:
    with replacing(path) as temporary:
        temporary.write_bytes(data)


if __name__ == "__main__":
    sys.exit(main())
