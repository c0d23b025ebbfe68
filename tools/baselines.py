"""The stored pictures that the image tests compare with, and the only program that writes them.

    python -m tools.baselines --scripts figures --store tests/images/baselines [NAME…]

A case is a figure, or one of three frames of an animation: first, middle, last. Of each the store holds NAME.npz.xz,
the arrays that are drawn and the geometry behind them (T0), its pixel hash in `pixels.json` (T1), NAME.png, the picture
without text at 640 pixels (T2), and in `labels.json` the boxes of the ink of its labels (T3); see
`tools.image`.
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
from stereodel.drawing.page import Page
from stereodel.film import Film
from stereodel.render.figure import Figure
from stereodel.render.rows import pixel_hash
from tools.build import BuildError, find_scripts, load_drawing
from tools.image import (
    TYPE_PIXELS,
    Arrays,
    array_differences,
    compare,
    ink_boxes,
    load_arrays,
    read_picture,
    save_arrays,
    summarised,
)

SIZE: Final = 640
"""Width of the stored pictures in pixels."""

ARRAYS: Final = "npz.xz"
"""Ending of stored arrays."""

HASHES: Final = "pixels.json"
BOXES: Final = "labels.json"

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


@dataclass(frozen=True)
class Store:
    """The folder of stored arrays, hashes, pictures and places of type."""

    folder: Path

    @cached_property
    def hashes(self) -> dict[str, str]:
        """Name → SHA-256 of the stored picture."""
        return self._table(HASHES)

    @cached_property
    def boxes(self) -> dict[str, list[list[float] | None]]:
        """Name → left, bottom, right and top of the ink of each label, in points; None for a label without ink."""
        return self._table(BOXES)

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
        """T3: which labels do not lie where they lay, a line each; empty when all do."""
        if case.name not in self.boxes:
            return [f"T3: {BOXES} has no {case.name}; look at the picture, then run `make baselines`"]
        stored = np.array([box or [np.nan] * 4 for box in self.boxes[case.name]]).reshape(-1, 4)
        if stored.shape != case.ink.shape:
            return [f"T3: {len(stored)} labels expected, {len(case.ink)} found"]
        limit = TYPE_PIXELS * case.page.width / SIZE
        return [
            f"T3: label {number} ({label.text!r}) has its ink {apart.max():.2f} points from where it was"
            for number, (label, apart) in enumerate(zip(case.page.labels, np.abs(stored - case.ink), strict=True))
            if (np.isnan(stored[number]) != np.isnan(case.ink[number])).any() or (apart > limit).any()
        ]

    def write(self, case: Case) -> None:
        """Store a case; its hash and its boxes go into their files with `write_tables`."""
        save_arrays(case.arrays, self.folder / f"{case.name}.{ARRAYS}")
        data = iio.imwrite("<bytes>", case.picture, extension=".png", plugin="pillow", optimize=True)
        _replace(self.folder / f"{case.name}.png", data)
        self.hashes[case.name] = pixel_hash(case.picture)
        self.boxes[case.name] = [None if np.isnan(box).any() else box.round(1).tolist() for box in case.ink]

    def write_tables(self) -> None:
        """Write `pixels.json` and `labels.json`, a line for each case."""
        for file, table in ((HASHES, self.hashes), (BOXES, self.boxes)):
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
            self.boxes.pop(name, None)
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


def _replace(path: Path, data: bytes) -> None:
    with replacing(path) as temporary:
        temporary.write_bytes(data)


if __name__ == "__main__":
    sys.exit(main())
